(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that a state that stands again makes a run endless, that a check of a start and a period by computation is
   right, and that the list of policies has all of them, none twice. *)
From Coq Require Import QArith List Bool Arith Lia NArith.
From Stiction.loops Require Import Statement.
Import ListNotations.
Local Open Scope nat_scope.

(* ---- The run never ends, if a state recurs --------------------------------------------------------------------- *)

Section Periodic.

Context {F : field} (p : problem F) (pol : policy).

Lemma drives_shift i j m : drives p pol i = drives p pol j -> drives p pol (i + m) = drives p pol (j + m).
Proof. intro H. induction m; [now rewrite !Nat.add_0_r | rewrite !Nat.add_succ_r; simpl; now rewrite IHm]. Qed.

Lemma drives_before k m x : drives p pol (m + k) = Going x -> exists y, drives p pol k = Going y.
Proof.
  revert x. induction m; simpl; [eauto | intros x].
  destruct (drives p pol (m + k)) eqn:E; [eauto | discriminate].
Qed.

(* Every state of the run is one of the first s + period. *)
Lemma one_of_the_first s period : 0 < period -> drives p pol (s + period) = drives p pol s ->
  forall k, exists j, j < s + period /\ drives p pol k = drives p pol j.
Proof.
  intros Hp H. induction k as [k IH] using lt_wf_ind.
  destruct (Nat.lt_ge_cases k (s + period)) as [L | G]; [now exists k|].
  destruct (IH (k - period)) as [j [L E]]; [lia|]. exists j. split; [exact L|]. rewrite <- E.
  replace k with (s + period + (k - s - period)) at 1 by lia.
  replace (k - period) with (s + (k - s - period)) by lia. now apply drives_shift.
Qed.

(* The soundness lemma: the state (forces, accelerations, sets, and what the policy remembers) after s drives
   stands again after s + period drives. *)
Theorem recurrence_never_ends s period x : 0 < period ->
  drives p pol s = Going x -> drives p pol (s + period) = Going x -> never_ends p pol.
Proof.
  intros Hp Hs Hr k. destruct (one_of_the_first s period Hp) with (k := k) as [j [L E]]; [congruence|].
  rewrite E. apply (drives_before j (s + period - j) x). now replace (s + period - j + j) with (s + period) by lia.
Qed.

End Periodic.

(* ---- Never ends, and never stands at a solution: a check by computation, over Q -------------------------------- *)

Definition Q_eqb (x y : Q) := Z.eqb (Qnum x) (Qnum y) && Pos.eqb (Qden x) (Qden y).
Fixpoint list_eqb {T} (eqb : T -> T -> bool) (x y : list T) :=
  match x, y with [], [] => true | u :: x, v :: y => eqb u v && list_eqb eqb x y | _, _ => false end.
Definition option_eqb (x y : option nat) :=
  match x, y with None, None => true | Some i, Some j => Nat.eqb i j | _, _ => false end.
Definition state_eqb (x y : state rationals) :=
  list_eqb Q_eqb (f (point_of x)) (f (point_of y)) && list_eqb Q_eqb (a (point_of x)) (a (point_of y)) &&
  list_eqb set_beq (sets (point_of x)) (sets (point_of y)) &&
  option_eqb (last x) (last y) && option_eqb (next_driven x) (next_driven y).

Lemma Q_eqb_eq x y : Q_eqb x y = true -> x = y.
Proof.
  destruct x, y; unfold Q_eqb; simpl; rewrite andb_true_iff, Z.eqb_eq, Pos.eqb_eq. now intros [-> ->].
Qed.
Lemma list_eqb_eq {T} (eqb : T -> T -> bool) : (forall x y, eqb x y = true -> x = y) ->
  forall x y, list_eqb eqb x y = true -> x = y.
Proof.
  intro H. induction x as [|u x IH]; destruct y as [|v y]; simpl; try discriminate; [reflexivity|].
  rewrite andb_true_iff. intros [E1 E2]. f_equal; auto.
Qed.
Lemma option_eqb_eq x y : option_eqb x y = true -> x = y.
Proof. destruct x, y; simpl; try discriminate; [rewrite Nat.eqb_eq; now intros -> | reflexivity]. Qed.
Lemma state_eqb_eq x y : state_eqb x y = true -> x = y.
Proof.
  destruct x as [[f1 a1 s1] l1 n1], y as [[f2 a2 s2] l2 n2]. unfold state_eqb. simpl.
  rewrite !andb_true_iff. intros [[[[H1 H2] H3] H4] H5].
  apply (list_eqb_eq _ Q_eqb_eq) in H1. apply (list_eqb_eq _ Q_eqb_eq) in H2.
  apply (list_eqb_eq _ internal_set_dec_bl) in H3. apply option_eqb_eq in H4. apply option_eqb_eq in H5. congruence.
Qed.

Lemma list_eqb_refl {T} (eqb : T -> T -> bool) : (forall x, eqb x x = true) -> forall x, list_eqb eqb x x = true.
Proof. intro H. induction x as [|u x IH]; simpl; [reflexivity | now rewrite H, IH]. Qed.
Lemma state_eqb_refl x : state_eqb x x = true.
Proof.
  assert (o : forall x, option_eqb x x = true) by (intros [n|]; simpl; [apply Nat.eqb_refl | reflexivity]).
  assert (q : forall x, Q_eqb x x = true)
    by (intros [n d]; unfold Q_eqb; simpl; now rewrite Z.eqb_refl, Pos.eqb_refl).
  unfold state_eqb. rewrite !o, !(list_eqb_refl _ q). simpl. rewrite !andb_true_r.
  apply list_eqb_refl. intros []; reflexivity.
Qed.

Section Check.

Variable p : problem rationals.

(* The states from x on, n drives long or to the end. *)
Fixpoint orbit pol n (x : state rationals) : list (state rationals) :=
  x :: match n with
       | O => []
       | S n => match next p pol x with Going y => orbit pol n y | End _ => [] end
       end.

Lemma orbit_drives pol n : forall i x k y, drives p pol i = Going x ->
  nth_error (orbit pol n x) k = Some y -> drives p pol (i + k) = Going y.
Proof.
  induction n as [|n IH]; intros i x [|k] y Hx Hk; simpl in Hk.
  - rewrite Nat.add_0_r. congruence.
  - destruct k; discriminate.
  - rewrite Nat.add_0_r. congruence.
  - destruct (next p pol x) as [z|e] eqn:E.
    + rewrite <- Nat.add_succ_comm. apply (IH (S i) z); [simpl; now rewrite Hx | exact Hk].
    + destruct k; discriminate.
Qed.

(* `start` and `period` are those of readings.md, 2: the first state at the top of the main loop that stands again. *)
Definition at_top (x : state rationals) := match next_driven x with None => true | Some _ => false end.
Fixpoint distinct (l : list (state rationals)) :=
  match l with [] => true | x :: t => forallb (fun y => negb (state_eqb x y)) t && distinct t end.

(* The laws (15), (16) at every contact, for the forces alone (5.1): the algorithm's own test, with a = A f + b. *)
Definition accelerations (g : list rationals) : list rationals :=
  map (fun rb => Qred (fst rb + snd rb)) (combine (times p g) (b p)).
Definition obeys (g : list rationals) :=
  forallb (fun i => negb (violated p (@Point rationals g (accelerations g) []) i)) (rows p).

(* What it says. *)
Definition cycles pol s period := 0 < period /\
  (exists x, drives p pol s = Going x /\ drives p pol (s + period) = Going x /\ at_top x = true) /\
  forall i j x y, i < j -> j < s + period -> drives p pol i = Going x -> drives p pol j = Going y ->
    at_top x = true -> at_top y = true -> x <> y.

Definition loops pol (start_period : nat * nat) : bool :=
  let '(s, period) := start_period in
  let o := orbit pol (s + period) (start p) in
  negb (Nat.eqb period 0) && Nat.eqb (length o) (S (s + period)) &&
  match nth_error o s, nth_error o (s + period) with
  | Some x, Some y => at_top x && state_eqb x y
  | _, _ => false
  end &&
  distinct (filter at_top (firstn (s + period) o)) &&
  forallb (fun x => negb (obeys (f (point_of x)))) o.

Lemma loops_recurs pol s period : loops pol (s, period) = true ->
  0 < period /\ exists x, drives p pol s = Going x /\ drives p pol (s + period) = Going x.
Proof.
  unfold loops. rewrite !andb_true_iff. intros [[[[H1 _] H2] _] _]. split.
  { destruct period; [discriminate | lia]. }
  destruct (nth_error _ s) as [x|] eqn:Hx; [|discriminate].
  destruct (nth_error _ (s + period)) as [y|] eqn:Hy; [|discriminate].
  apply andb_true_iff in H2 as [_ H2]. apply state_eqb_eq in H2. subst y. exists x.
  split; [now apply (orbit_drives pol (s + period) 0 (start p))
        | now apply (orbit_drives pol (s + period) 0 (start p))].
Qed.

Lemma distinct_holds l : distinct l = true -> forall i j x y, i < j ->
  nth_error l i = Some x -> nth_error l j = Some y -> x <> y.
Proof.
  induction l as [|z l IH]; simpl; intros H i j x y L Hi Hj; [destruct i; discriminate|].
  apply andb_true_iff in H as [H1 H2]. destruct j as [|j]; [lia|]. destruct i as [|i]; simpl in *.
  - injection Hi as ->. rewrite forallb_forall in H1. specialize (H1 y (nth_error_In l j Hj)).
    intros ->. now rewrite state_eqb_refl in H1.
  - exact (IH H2 i j x y ltac:(lia) Hi Hj).
Qed.

Lemma distinct_filter l : distinct (filter at_top l) = true -> forall i j x y, i < j ->
  nth_error l i = Some x -> nth_error l j = Some y -> at_top x = true -> at_top y = true -> x <> y.
Proof.
  intros H i j x y L Hi Hj Tx Ty.
  assert (position : forall (l : list (state rationals)) i x, nth_error l i = Some x -> at_top x = true ->
            nth_error (filter at_top l) (length (filter at_top (firstn i l))) = Some x).
  { clear. induction l as [|z l IH]; intros [|i] x H T; simpl in *; try discriminate.
    - injection H as ->. now rewrite T.
    - destruct (at_top z); simpl; now apply IH. }
  assert (before : forall (l : list (state rationals)) i j x, i < j -> nth_error l i = Some x -> at_top x = true ->
            length (filter at_top (firstn i l)) < length (filter at_top (firstn j l))).
  { clear. induction l as [|z l IH]; intros [|i] [|j] x L H T; simpl in *; try discriminate; try lia.
    - injection H as ->. rewrite T. simpl. lia.
    - pose proof (IH i j x ltac:(lia) H T). destruct (at_top z); simpl; lia. }
  exact (distinct_holds _ H _ _ _ _ (before l i j x L Hi Tx) (position l i x Hi Tx) (position l j y Hj Ty)).
Qed.

Theorem loops_cycles pol s period : loops pol (s, period) = true -> cycles pol s period.
Proof.
  intro H. destruct (loops_recurs pol s period H) as [Hp [x [Hs Hr]]].
  unfold loops in H. rewrite !andb_true_iff in H. destruct H as [[[[_ Hl] Hx] Hd] _]. apply Nat.eqb_eq in Hl.
  assert (state_at : forall k y, k < S (s + period) -> drives p pol k = Going y ->
            nth_error (orbit pol (s + period) (start p)) k = Some y).
  { intros k y L Hk. destruct (nth_error (orbit pol (s + period) (start p)) k) as [z|] eqn:E.
    - pose proof (orbit_drives pol (s + period) 0 (start p) k z eq_refl E) as E'. simpl in E'. congruence.
    - apply nth_error_None in E. lia. }
  split; [exact Hp|]. split.
  - exists x. repeat split; try assumption. rewrite (state_at s x) in Hx by (lia || assumption).
    destruct (nth_error _ (s + period)); [now apply andb_true_iff in Hx as [Hx _] | discriminate].
  - intros i j y z L Lj Hi Hj Ty Tz.
    assert (within : forall k u, k < s + period -> drives p pol k = Going u ->
              nth_error (firstn (s + period) (orbit pol (s + period) (start p))) k = Some u).
    { intros k u Lk Hk. rewrite <- (state_at k u) by (lia || assumption).
      rewrite <- (firstn_skipn (s + period) (orbit pol (s + period) (start p))) at 2.
      rewrite nth_error_app1; [reflexivity|]. rewrite firstn_length. lia. }
    exact (distinct_filter _ Hd i j y z L (within i y ltac:(lia) Hi) (within j z ltac:(lia) Hj) Ty Tz).
Qed.

Theorem loops_never_ends pol sp : loops pol sp = true -> never_ends p pol.
Proof.
  destruct sp as [s period]. intro H. destruct (loops_recurs pol s period H) as [Hp [x [Hs Hr]]].
  exact (recurrence_never_ends p pol s period x Hp Hs Hr).
Qed.

(* Nor does it ever stand at a solution without noticing. *)
Theorem loops_never_obeys pol sp : loops pol sp = true ->
  forall k x, drives p pol k = Going x -> obeys (f (point_of x)) = false.
Proof.
  destruct sp as [s period]. intros H k x Hk. destruct (loops_recurs pol s period H) as [Hp [z [Hs Hr]]].
  destruct (one_of_the_first p pol s period Hp) with (k := k) as [j [L E]]; [congruence|].
  unfold loops in H. rewrite !andb_true_iff in H. destruct H as [[[[_ Hl] _] _] Ho].
  apply Nat.eqb_eq in Hl. rewrite forallb_forall in Ho.
  destruct (nth_error (orbit pol (s + period) (start p)) j) as [y|] eqn:Hy.
  - pose proof (orbit_drives pol (s + period) 0 (start p) j y eq_refl Hy) as Hj. simpl in Hj.
    rewrite E, Hj in Hk. injection Hk as <-. apply negb_true_iff, Ho, (nth_error_In _ j Hy).
  - apply nth_error_None in Hy. lia.
Qed.

End Check.

(* ---- All policies ---------------------------------------------------------------------------------------------- *)

Theorem all_policies_complete : policies_complete.
Proof.
  intro pol. destruct pol as [s r ad fi gu dr re ti ap]. unfold all_policies.
  repeat (apply in_flat_map; eexists; split; [shelve|]).
  apply in_map_iff. exists ap. split; [reflexivity|]. destruct ap; simpl; tauto.
  Unshelve.
  all: match goal with |- In ?x _ => destruct x; simpl; tauto end.
Qed.

Theorem all_policies_length : length all_policies = 1536.
Proof. vm_compute. reflexivity. Qed.

(* A number for each policy: none stands twice. *)
Definition number (pol : policy) : nat :=
  let digit base d n := n * base + d in
  digit 2 (match apex pol with kept => 0 | _ => 1 end)
 (digit 2 (match ties pol with by_sets => 0 | _ => 1 end)
 (digit 2 (match rezero pol with rescan => 0 | _ => 1 end)
 (digit 2 (match drop pol with drop_contact => 0 | _ => 1 end)
 (digit 3 (match give_up pol with first => 0 | previous => 1 | second => 2 end)
 (digit 2 (match file pol with unfiled => 0 | _ => 1 end)
 (digit 2 (match admit pol with lazy => 0 | _ => 1 end)
 (digit 2 (match resume pol with restart => 0 | _ => 1 end)
          (match scan pol with lowest => 0 | normals_first => 1 | most_violated => 2 | highest => 3 end)))))))).
Theorem all_policies_distinct : NoDup all_policies.
Proof.
  apply (NoDup_map_inv number). replace (map number all_policies) with (seq 0 1536) by (vm_compute; reflexivity).
  apply seq_NoDup.
Qed.
Theorem all_policies_counted : policies_counted.
Proof. split; [exact all_policies_length | exact all_policies_distinct]. Qed.

(* ---- A table: a start and a period for each of a list of policies ---------------------------------------------- *)

Definition expand (t : list (nat * (nat * nat))) := flat_map (fun nx => repeat (snd nx) (fst nx)) t.
Definition table_holds p (policies : list policy) (t : list (nat * nat)) :=
  Nat.eqb (length t) (length policies) && forallb (fun x => loops p (fst x) (snd x)) (combine policies t).

Lemma in_combine_fst {S T} : forall (x : list S) (y : list T), length y = length x ->
  forall u, In u x -> exists v, In (u, v) (combine x y).
Proof.
  induction x as [|w x IH]; destruct y as [|v y]; simpl; intros L u Hu; try discriminate; [contradiction|].
  destruct Hu as [-> | Hu]; [exists v; now left|]. destruct (IH y ltac:(lia) u Hu) as [z Hz]. exists z. now right.
Qed.

Lemma table_holds_loops p policies t : table_holds p policies t = true -> forall pol, In pol policies ->
  exists sp, In (pol, sp) (combine policies t) /\ loops p pol sp = true.
Proof.
  unfold table_holds. rewrite andb_true_iff, Nat.eqb_eq, forallb_forall. intros [L H] pol Hpol.
  destruct (in_combine_fst policies t L pol Hpol) as [sp Hsp]. exists sp. split; [exact Hsp | exact (H _ Hsp)].
Qed.

Theorem table_never_ends p policies t : table_holds p policies t = true ->
  forall pol, In pol policies -> never_ends p pol.
Proof.
  intros H pol Hpol. destruct (table_holds_loops p policies t H pol Hpol) as [sp [_ Hsp]].
  exact (loops_never_ends p pol sp Hsp).
Qed.

Theorem table_never_obeys p policies t : table_holds p policies t = true -> forall pol, In pol policies ->
  forall k x, drives p pol k = Going x -> obeys p (f (point_of x)) = false.
Proof.
  intros H pol Hpol. destruct (table_holds_loops p policies t H pol Hpol) as [sp [_ Hsp]].
  exact (loops_never_obeys p pol sp Hsp).
Qed.

Theorem table_cycles p policies t : table_holds p policies t = true ->
  forall pol s period, In (pol, (s, period)) (combine policies t) -> cycles p pol s period.
Proof.
  unfold table_holds. rewrite andb_true_iff, forallb_forall. intros [_ H] pol s period Hin.
  apply loops_cycles. exact (H _ Hin).
Qed.
