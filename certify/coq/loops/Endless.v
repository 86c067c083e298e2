(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that on corpus/endless/without-repetition.json under resume=round the run never ends and no state stands
   twice (search/adversary/frontiers.md, 5).

   f(t) is the line through the forces after 5 drives (t = 0) and after 13 (t = 1). For all t in (0, limit) eight
   drives lead from f(t) to f(1 + alpha t), with the same sets: Coq runs them once, over rational functions of t. *)
From Coq Require Import QArith ZArith List Bool Arith Lia Lqa.
From Stiction.loops Require Import Statement Loop Laws Invariant Symbolic.
Import ListNotations.
Local Open Scope Q_scope.
Local Notation the_problem := endless_problem.
Local Notation pol := endless_policy.

Definition alpha : Q := 1549 # 8932.
Definition limit : Q := 8932 # 7383.                     (* 1 / (1 - alpha), the fixed point *)

(* ---- The round, once for all t --------------------------------------------------------------------------------- *)

Definition after n := match drives the_problem pol n with Going x => x | End _ => start the_problem end.
Definition line (u v : list Q) :=
  map (fun xy => reduced (Function [fst xy; Qred (snd xy - fst xy)] [1])) (combine u v).

Definition problem_t hi t : problem (functions hi t) :=
  @Problem (functions hi t)
    (map (map constant) (A the_problem)) (map constant (b the_problem)) (map constant (mu the_problem)).
Definition X_parts : symbolic := Eval vm_compute in
  let x := point_of (after 5) in let y := point_of (after 13) in
  (line (f x) (f y), line (a x) (a y), sets x, last (after 5), next_driven (after 5)).

Definition Y_parts : symbolic := Eval vm_compute in
  match parts (further (problem_t limit 0) pol 8 (whole limit 0 X_parts)) with
    Some y => y | None => ([], [], [], None, None) end.

Lemma round_of_all t : further (problem_t limit t) pol 8 (whole limit t X_parts) = Going (whole limit t Y_parts).
Proof. apply parts_whole. vm_compute. reflexivity. Qed.

(* ---- What a symbolic state says of a state over Q -------------------------------------------------------------- *)

Definition shows t (s : symbolic) (x : state rationals) : Prop :=
  let '(f_, a_, s, l, d) := s in
  Forall2 (stands_for t) f_ (f (point_of x)) /\ Forall2 (stands_for t) a_ (a (point_of x)) /\
  s = sets (point_of x) /\ l = last x /\ d = next_driven x.

Lemma problem_shows hi t (Ht : 0 < t < hi) :
  problem_R (functions hi t) rationals (over_functions hi t Ht) (problem_t hi t) the_problem.
Proof.
  assert (C : forall l : list Q, list_R function Q (stands_for t) (map constant l) l).
  { induction l as [|c l IH]; simpl; constructor; [|exact IH]. split; [simpl; lra | unfold value; simpl; field]. }
  constructor; [|exact (C _)|exact (C _)].
  change (list_R (list function) (list Q) (list_R function Q (stands_for t))
            (map (map constant) (A the_problem)) (A the_problem)).
  induction (A the_problem) as [|r l IH]; simpl; constructor; [exact (C _) | exact IH].
Qed.

Lemma shows_R hi t Ht s x : shows t s x ->
  state_R (functions hi t) rationals (over_functions hi t Ht) (whole hi t s) x.
Proof.
  destruct s as [[[[f_ a_] s] l] d], x as [[f' a' s'] l' d']. simpl. intros [Hf [Ha [-> [-> ->]]]].
  constructor; [constructor | apply option_to_R | apply option_to_R].
  - exact (list_to_R (stands_for t) _ _ Hf).
  - exact (list_to_R (stands_for t) _ _ Ha).
  - apply sets_to_R.
Qed.
Lemma R_shows hi t Ht s x : state_R (functions hi t) rationals (over_functions hi t Ht) (whole hi t s) x ->
  shows t s x.
Proof.
  destruct s as [[[[f_ a_] s] l] d], x as [[f' a' s'] l' d']. simpl. intro R.
  inversion R as [p q P l1 l2 L d1 d2 D]. subst. inversion P as [f1 f2 Rf a1 a2 Ra s1 s2 Rs]. subst.
  repeat split.
  - exact (list_of_R (stands_for t) _ _ Rf).
  - exact (list_of_R (stands_for t) _ _ Ra).
  - exact (sets_of_R _ _ Rs).
  - exact (option_of_R _ _ L).
  - exact (option_of_R _ _ D).
Qed.

(* A round, for every t in (0, limit). *)
Lemma round t x : 0 < t < limit -> shows t X_parts x ->
  exists y, further the_problem pol 8 x = Going y /\ shows t Y_parts y.
Proof.
  intros Ht H.
  pose proof (further_R _ _ (over_functions limit t Ht) _ _ (problem_shows limit t Ht) pol pol (policy_R_refl pol) 8 8
    (nat_R_refl 8)
    _ x (shows_R limit t Ht _ x H)) as R.
  rewrite round_of_all in R. destruct (result_going _ _ _ R) as [y [E HY]]. exists y.
  split; [exact E | exact (R_shows limit t Ht Y_parts y HY)].
Qed.

(* f(t) to f(1 + alpha t) *)
Lemma shift t x : shows t Y_parts x -> shows (1 + alpha * t) X_parts x.
Proof.
  assert (S : forall u v, (forall y, at_t u t == y -> at_t v (1 + alpha * t) == y) ->
    forall y, stands_for t (Function u [1]) y -> stands_for (1 + alpha * t) (Function v [1]) y).
  { intros u v H y [_ E]. unfold stands_for, value in *. cbn [upper lower at_t] in *. split; [lra|].
    rewrite (H (at_t u t)) by reflexivity. rewrite E. field. }
  assert (F : forall (us vs : list function) ys, Forall2 (stands_for t) us ys ->
    Forall2 (fun u v => forall y, stands_for t u y -> stands_for (1 + alpha * t) v y) us vs ->
    Forall2 (stands_for (1 + alpha * t)) vs ys).
  { intros us vs ys H. revert vs. induction H; intros vs G; inversion G; subst; constructor; auto. }
  unfold shows, X_parts, Y_parts. intros [Hf [Ha H]].
  split; [|split; [|exact H]]; (eapply F; [eassumption|]);
  repeat first [apply Forall2_nil | apply Forall2_cons; [apply S; intros y E; cbn [at_t] in *; unfold alpha; lra|]].
Qed.

(* ---- The run --------------------------------------------------------------------------------------------------- *)

Fixpoint t_ (k : nat) : Q := match k with O => 1 | S k => 1 + alpha * t_ k end.
Lemma t_inside k : 0 < t_ k < limit.
Proof. induction k; simpl; unfold alpha, limit in *; lra. Qed.
Lemma t_increases i j : (i < j)%nat -> t_ i < t_ j.
Proof.
  assert (one : forall k, t_ k < t_ (S k))
    by (intro k; pose proof (t_inside k); simpl; unfold alpha, limit in *; lra).
  induction 1; [apply one | pose proof (one m); lra].
Qed.

Lemma rounds k : exists x, drives the_problem pol (13 + 8 * k) = Going x /\ shows (t_ k) X_parts x.
Proof.
  induction k as [|k [x [Hx Sx]]].
  - exists (after 13). split; [vm_compute; reflexivity|]. unfold shows, X_parts. simpl t_.
    set (y := after 13). vm_compute in y. subst y. cbn [point_of f a sets last next_driven].
    repeat split; try reflexivity; repeat constructor; try (vm_compute; discriminate); vm_compute; reflexivity.
  - destruct (round (t_ k) x (t_inside k) Sx) as [y [Hy Sy]]. exists y.
    split; [|exact (shift _ _ Sy)]. replace (13 + 8 * S k)%nat with (13 + 8 * k + 8)%nat by lia.
    rewrite (further_drives _ _ 8 _ x Hx). exact Hy.
Qed.

Theorem never_ends : never_ends the_problem pol.
Proof.
  intro k. destruct (rounds k) as [x [Hx _]].
  apply (drives_before the_problem pol k (13 + 8 * k - k) x).
  now replace (13 + 8 * k - k + k)%nat with (13 + 8 * k)%nat by lia.
Qed.

(* ---- No state stands twice ------------------------------------------------------------------------------------- *)

Lemma is_well_formed : well_formed the_problem.
Proof. apply check_well_formed_sound. vm_compute. reflexivity. Qed.

Lemma nothing_pending (p : problem rationals) q : rezero q = rescan ->
  forall k x, drives p q k = Going x -> next_driven x = None.
Proof.
  intros Hq k x. destruct k as [|k]; cbn [drives]; [intro H; now injection H as <-|].
  destruct (drives p q k) as [y|e]; [|discriminate].
  assert (G : forall d g s, snd (drive_from p q d g s) = Going x -> next_driven x = None).
  { intros d g s. unfold drive_from. destruct (drive p q d g s) as [pvs [u|e]]; intro H; [|discriminate].
    injection H as <-. rewrite Hq. now destruct g. }
  unfold next, next_with_pivots. destruct (next_driven y); [apply G|].
  destruct (find_violated _ _ _ _); [apply G | discriminate].
Qed.

Lemma Forall2_Qeq_sym l m : Forall2 Qeq l m -> Forall2 Qeq m l.
Proof. induction 1; constructor; [now symmetry | assumption]. Qed.
Lemma Forall2_Qeq_trans l m n : Forall2 Qeq l m -> Forall2 Qeq m n -> Forall2 Qeq l n.
Proof.
  intro H. revert n. induction H; intros n G; inversion G; subst; constructor; [etransitivity; eassumption | auto].
Qed.
Lemma Forall2_Qeq_refl l : Forall2 Qeq l l.
Proof. induction l; constructor; [reflexivity | assumption]. Qed.
Lemma same_trans x y z : same_state x y -> same_state y z -> same_state x z.
Proof.
  intros [F1 [E1 G1]] [F2 [E2 G2]]. split; [exact (Forall2_Qeq_trans _ _ _ F1 F2) | split; congruence].
Qed.

Lemma accelerations_equal p g h : Forall2 Qeq g h -> Forall2 Qeq (accelerations p g) (accelerations p h).
Proof.
  intro H. assert (D : forall r : list Q, (@dot rationals r g : Q) == dot r h).
  { intro r. revert r. induction H as [|x y l m E _ IH]; intros [|u r]; try reflexivity.
    change (Qred (Qred (u * x) + @dot rationals r l) == Qred (Qred (u * y) + @dot rationals r m)).
    now rewrite !Qred_correct, IH, E. }
  unfold accelerations, times. generalize (b p) as c.
  induction (A p) as [|r M IH]; intros [|d c]; cbn [map combine]; constructor.
  - change (Qred (@dot rationals r g + d) == Qred (@dot rationals r h + d)). now rewrite !Qred_correct, D.
  - apply IH.
Qed.

Lemma same_goes_on i j x y : drives the_problem pol i = Going x -> drives the_problem pol j = Going y ->
  same_state x y ->
  forall m x', drives the_problem pol (i + m) = Going x' ->
  exists y', drives the_problem pol (j + m) = Going y' /\ same_state x' y'.
Proof.
  intros Hx Hy Hs m x' Hx'. pose proof (nothing_pending _ pol eq_refl i x Hx) as Nx.
  pose proof (nothing_pending _ pol eq_refl j y Hy) as Ny.
  pose proof (drives_ok the_problem pol is_well_formed i x Hx) as [_ Ax].
  pose proof (drives_ok the_problem pol is_well_formed j y Hy) as [_ Ay].
  rewrite (further_drives _ _ m i x Hx) in Hx'. rewrite (further_drives _ _ m j y Hy).
  assert (P : problem_R rationals rationals over_equal the_problem the_problem).
  { assert (V : forall l : list Q, list_R Q Q Qeq l l) by (intro; apply list_to_R, Forall2_Qeq_refl).
    constructor; [|exact (V _)|exact (V _)].
    change (list_R (list Q) (list Q) (list_R Q Q Qeq) (A the_problem) (A the_problem)).
    induction (A the_problem) as [|r l IH]; constructor; [exact (V r) | exact IH]. }
  assert (Q : state_R rationals rationals over_equal x y).
  { destruct x as [[f1 a1 s1] l1 n1], y as [[f2 a2 s2] l2 n2]. simpl in *.
    destruct Hs as [F [E1 E2]]. simpl in *. subst.
    constructor; [constructor | apply option_to_R | apply option_to_R].
    - exact (list_to_R Qeq _ _ F).
    - apply (list_to_R Qeq). apply (Forall2_Qeq_trans _ _ _ Ax). apply Forall2_Qeq_sym, (Forall2_Qeq_trans _ _ _ Ay).
      apply accelerations_equal, Forall2_Qeq_sym, F.
    - apply sets_to_R. }
  pose proof (further_R _ _ over_equal _ _ P pol pol (policy_R_refl pol) m m (nat_R_refl m) x y Q) as R.
  rewrite Hx' in R. destruct (result_going _ _ _ R) as [y' [E R']]. exists y'. split; [exact E|].
  destruct x' as [[f1 a1 s1] l1 n1], y' as [[f2 a2 s2] l2 n2].
  inversion R' as [p1 p2 RP o1 o2 RL d1 d2 RD]. subst. inversion RP as [g1 g2 Rf b1 b2 Ra u1 u2 Rs]. subst.
  repeat split; simpl; [exact (list_of_R Qeq _ _ Rf) | exact (sets_of_R _ _ Rs) | exact (option_of_R _ _ RL)].
Qed.

Theorem no_state_twice i j x y : (i < j)%nat ->
  drives the_problem pol i = Going x -> drives the_problem pol j = Going y -> ~ same_state x y.
Proof.
  intros L Hx Hy Hs.
  (* then the state after n >= i drives is that after n + q (j - i) *)
  assert (again : forall q n u, (i <= n)%nat -> drives the_problem pol n = Going u ->
            exists v, drives the_problem pol (n + q * (j - i)) = Going v /\ same_state u v).
  { induction q as [|q IH]; intros n u Ln Hu.
    - exists u. rewrite Nat.add_0_r. split; [exact Hu|]. repeat split. apply Forall2_Qeq_refl.
    - destruct (same_goes_on i j x y Hx Hy Hs (n - i) u) as [w [Hw Sw]];
      [now replace (i + (n - i))%nat with n by lia|].
      destruct (IH (j + (n - i))%nat w ltac:(lia) Hw) as [v [Hv Sv]]. exists v.
      replace (n + S q * (j - i))%nat with (j + (n - i) + q * (j - i))%nat by lia.
      split; [exact Hv | exact (same_trans _ _ _ Sw Sv)]. }
  destruct (rounds i) as [u [Hu Su]]. destruct (rounds j) as [w [Hw Sw]].
  destruct (again 8%nat (13 + 8 * i)%nat u ltac:(lia) Hu) as [v [Hv Sv]].
  replace (13 + 8 * i + 8 * (j - i))%nat with (13 + 8 * j)%nat in Hv by lia.
  assert (v = w) by congruence. subst v. pose proof (t_increases i j L).
  (* the first force is c + d t with d > 0 *)
  unfold shows, X_parts in Su, Sw. destruct Su as [Fu _], Sw as [Fw _], Sv as [Fv _].
  destruct (f (point_of u)) as [|u0 us]; [inversion Fu|]. destruct (f (point_of w)) as [|w0 ws]; [inversion Fw|].
  inversion Fu as [|? ? ? ? [_ Eu] _ E1 E2]. inversion Fw as [|? ? ? ? [_ Ew] _ E3 E4].
  inversion Fv as [|? ? ? ? Ev _ E5 E6].
  unfold value in Eu, Ew. cbn [upper lower at_t] in Eu, Ew.
  rewrite Eu, Ew in Ev. assert (R : forall s n : Q, n / (1 + s * 0) == n) by (intros; field). rewrite !R in Ev. lra.
Qed.

(* A is symmetric and positive definite. *)
Definition L : list (list Q) := [[1 # 1; 0 # 1; 0 # 1; 0 # 1; 0 # 1; 0 # 1];
  [0 # 1; 1 # 1; 0 # 1; 0 # 1; 0 # 1; 0 # 1];
  [-1 # 1; -1 # 4; 1 # 1; 0 # 1; 0 # 1; 0 # 1];
  [3 # 2; 0 # 1; 8 # 31; 1 # 1; 0 # 1; 0 # 1];
  [1 # 2; 0 # 1; 20 # 31; -49 # 309; 1 # 1; 0 # 1];
  [0 # 1; 0 # 1; -44 # 31; -24 # 103; -27 # 46; 1 # 1]].
Definition D : list Q := [2 # 1; 4 # 1; 31 # 4; 309 # 62; 46 # 309; 3 # 46].

Theorem endless_without_repetition : endless_run_without_repetition.
Proof.
  split; [exact is_well_formed|]. split; [apply check_symmetric_sound; vm_compute; reflexivity|].
  split; [apply (check_definite_sound _ _ L D); vm_compute; reflexivity|].
  split; [exact never_ends | exact no_state_twice].
Qed.
