(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that checks by computation are right: symmetric, positive definite, well formed; and that the algorithm's
   own test of the conditions is the law of Statement.v. *)
From Coq Require Import QArith Qabs ZArith List Bool Arith Lia Lqa.
From Stiction.loops Require Import Statement Loop.
Import ListNotations.
Local Open Scope Q_scope.

(* ---- Sums ------------------------------------------------------------------------------------------------------ *)

Lemma sum_ext n g h : (forall i, (i < n)%nat -> g i == h i) -> sum n g == sum n h.
Proof. induction n; intro H; simpl; [reflexivity|]. rewrite IHn, (H n) by auto. reflexivity. Qed.
Lemma sum_plus n g h : sum n (fun i => g i + h i) == sum n g + sum n h.
Proof. induction n; simpl; [reflexivity|]. rewrite IHn. ring. Qed.
Lemma sum_scale n c g : sum n (fun i => c * g i) == c * sum n g.
Proof. induction n; simpl; [ring|]. rewrite IHn. ring. Qed.
Lemma sum_zero n : sum n (fun _ => 0) == 0.
Proof. induction n; simpl; [reflexivity|]. rewrite IHn. ring. Qed.
Lemma sum_swap n m (g : nat -> nat -> Q) :
  sum n (fun i => sum m (fun j => g i j)) == sum m (fun j => sum n (fun i => g i j)).
Proof. induction n; simpl; [symmetry; apply sum_zero|]. rewrite IHn. symmetry. apply sum_plus. Qed.
Lemma sum_first n g : sum (S n) g == g O + sum n (fun i => g (S i)).
Proof.
  induction n; [simpl; ring|]. change (sum (S (S n)) g) with (sum (S n) g + g (S n)). rewrite IHn. simpl. ring.
Qed.
Lemma sum_nonnegative n g : (forall i, (i < n)%nat -> 0 <= g i) -> 0 <= sum n g.
Proof. induction n; intro H; simpl; [lra|]. assert (0 <= sum n g) by auto. assert (0 <= g n) by auto. lra. Qed.
Lemma sum_positive n g k : (k < n)%nat -> (forall i, (i < n)%nat -> 0 <= g i) -> 0 < g k -> 0 < sum n g.
Proof.
  induction n; intros L H P; [lia|]. simpl. assert (0 <= sum n g) by (apply sum_nonnegative; auto).
  assert (0 <= g n) by auto. destruct (Nat.eq_dec k n) as [->|N]; [lra|].
  assert (0 < sum n g) by (apply IHn; auto; lia). lra.
Qed.
Lemma sum_single n g k : (k < n)%nat -> (forall i, (i < n)%nat -> i <> k -> g i == 0) -> sum n g == g k.
Proof.
  induction n; intros L H; [lia|]. simpl. destruct (Nat.eq_dec k n) as [->|N].
  - rewrite (sum_ext n g (fun _ => 0)) by (intros; apply H; lia). rewrite sum_zero. ring.
  - rewrite IHn, (H n) by (auto; lia). ring.
Qed.

(* ---- The check of A = L D L' ----------------------------------------------------------------------------------- *)

Definition all_below n (t : nat -> bool) := forallb t (seq 0 n).
Lemma all_below_holds n t : all_below n t = true -> forall i, (i < n)%nat -> t i = true.
Proof. unfold all_below. rewrite forallb_forall. intros H i L. apply H, in_seq. lia. Qed.

Definition check_symmetric n M := all_below n (fun i => all_below n (fun j => Qeq_bool (entry M i j) (entry M j i))).
Lemma check_symmetric_sound n M : check_symmetric n M = true -> symmetric n M.
Proof.
  intros H i j Hi Hj. apply Qeq_bool_eq.
  exact (all_below_holds n _ (all_below_holds n _ H i Hi) j Hj).
Qed.

(* L is unit lower triangular, D > 0, A = L D L'. *)
Definition check_definite n M L (D : list Q) :=
  all_below n (fun k => negb (Qle_bool (nth k D 0) 0) && Qeq_bool (entry L k k) 1
                        && all_below k (fun i => Qeq_bool (entry L i k) 0)) &&
  all_below n (fun i => all_below n (fun j =>
    Qeq_bool (entry M i j) (sum n (fun k => entry L i k * nth k D 0 * entry L j k)))).

Lemma last_nonzero n (x : nat -> Q) : (exists i, (i < n)%nat /\ ~ x i == 0) ->
  exists m, (m < n)%nat /\ ~ x m == 0 /\ forall i, (m < i < n)%nat -> x i == 0.
Proof.
  induction n; intros [i [L H]]; [lia|]. destruct (Qeq_dec (x n) 0) as [E|N].
  - destruct IHn as [m [Lm [Nm Z]]].
    { exists i. split; [|exact H]. destruct (Nat.eq_dec i n) as [->|]; [contradiction | lia]. }
    exists m. repeat split; [lia | exact Nm|]. intros k Hk.
    destruct (Nat.eq_dec k n) as [->|]; [exact E | apply Z; lia].
  - exists n. repeat split; [lia | exact N | lia].
Qed.

Lemma square_nonnegative (q : Q) : 0 <= q * q.
Proof. destruct (Qlt_le_dec q 0); nra. Qed.
Lemma square_positive (q : Q) : ~ q == 0 -> 0 < q * q.
Proof. intro H. destruct (Q_dec q 0) as [[?|?]|?]; [nra | nra | contradiction]. Qed.

Theorem check_definite_sound n M L D : check_definite n M L D = true -> positive_definite n M.
Proof.
  unfold check_definite. rewrite andb_true_iff. intros [H1 H2] x Hx.
  assert (HD : forall k, (k < n)%nat -> 0 < nth k D 0).
  { intros k Hk. apply (all_below_holds n _ H1) in Hk. rewrite !andb_true_iff, negb_true_iff in Hk.
    destruct Hk as [[Hk _] _]. apply Qnot_le_lt. intro G. apply Qle_bool_iff in G. congruence. }
  assert (HL : forall k, (k < n)%nat -> entry L k k == 1 /\ forall i, (i < k)%nat -> entry L i k == 0).
  { intros k Hk. apply (all_below_holds n _ H1) in Hk. rewrite !andb_true_iff in Hk. destruct Hk as [[_ E] Z].
    split; [now apply Qeq_bool_eq|]. intros i Hi. apply Qeq_bool_eq. exact (all_below_holds k _ Z i Hi). }
  set (y k := sum n (fun i => entry L i k * x i)).
  assert (E : quadratic n M x == sum n (fun k => nth k D 0 * (y k * y k))).
  { unfold quadratic.
    rewrite (sum_ext n _ (fun i => sum n (fun k => x i * entry L i k * nth k D 0 * y k))).
    - rewrite sum_swap. apply sum_ext. intros k Hk.
      rewrite (sum_ext n _ (fun i => (nth k D 0 * y k) * (entry L i k * x i))) by (intros; ring).
      rewrite sum_scale. fold (y k). ring.
    - intros i Hi. rewrite <- sum_scale.
      rewrite (sum_ext n _ (fun j => sum n (fun k => x i * entry L i k * nth k D 0 * (entry L j k * x j)))).
      + rewrite sum_swap. apply sum_ext. intros k Hk. now rewrite sum_scale.
      + intros j Hj.
        rewrite (Qeq_bool_eq _ _ (all_below_holds n _ (all_below_holds n _ H2 i Hi) j Hj)).
        rewrite (sum_ext n (fun k => x i * entry L i k * nth k D 0 * (entry L j k * x j))
                           (fun k => (x i * x j) * (entry L i k * nth k D 0 * entry L j k))) by (intros; ring).
        rewrite sum_scale. ring. }
  rewrite E. destruct (last_nonzero n x Hx) as [m [Lm [Nm Z]]].
  assert (Y : y m == x m).
  { unfold y. rewrite (sum_single n _ m Lm).
    - destruct (HL m Lm) as [-> _]. ring.
    - intros i Hi N. destruct (HL m Lm) as [_ Zm]. destruct (Nat.lt_ge_cases i m).
      + rewrite Zm by assumption. ring.
      + rewrite Z by lia. ring. }
  apply (sum_positive n _ m Lm).
  - intros i Hi. pose proof (square_nonnegative (y i)). pose proof (HD i Hi). nra.
  - rewrite Y. pose proof (square_positive (x m) Nm). pose proof (HD m Lm). nra.
Qed.

Definition check_well_formed (p : problem rationals) :=
  Nat.eqb (length (b p)) (2 * length (mu p)) && Nat.eqb (length (A p)) (length (b p)) &&
  forallb (fun r : list Q => Nat.eqb (length r) (length (b p))) (A p) && forallb (Qle_bool 0) (mu p).
Lemma check_well_formed_sound p : check_well_formed p = true -> well_formed p.
Proof.
  unfold check_well_formed, well_formed. rewrite !andb_true_iff, !Nat.eqb_eq, !forallb_forall.
  intros [[[H1 H2] H3] H4]. repeat split; auto.
  - intros r Hr. apply Nat.eqb_eq, H3, Hr.
  - intros m Hm. apply Qle_bool_iff, H4, Hm.
Qed.

(* ---- The algorithm's own test is the law ----------------------------------------------------------------------- *)

Lemma negative_spec (x : rationals) : negative x = true <-> (x : Q) < 0.
Proof.
  unfold negative, Qlt. destruct x as [n d]. simpl.
  destruct (Z.compare_spec n 0); split; intros; try discriminate; auto; lia.
Qed.
Lemma is0_spec (x : rationals) : is0 x = true <-> (x : Q) == 0.
Proof.
  unfold is0, Qeq. destruct x as [n d]. simpl.
  destruct (Z.compare_spec n 0); split; intros; try discriminate; auto; lia.
Qed.
Lemma abs_spec (x : rationals) : (abs x : Q) == Qabs x.
Proof.
  unfold abs. destruct (negative x) eqn:E.
  - apply negative_spec in E. change (Qred (- x) == Qabs x). rewrite Qred_correct. symmetry. apply Qabs_neg. lra.
  - assert (~ (x : Q) < 0) by (rewrite <- negative_spec; congruence). symmetry. apply Qabs_pos. lra.
Qed.
Lemma dot_sum : forall r g : list Q, (@dot rationals r g : Q) == sum (length r) (fun j => nth j r 0 * nth j g 0).
Proof.
  unfold dot. induction r as [|u r IH]; intros [|v g]; try reflexivity.
  - rewrite (sum_ext _ _ (fun _ => 0)), sum_zero; [reflexivity|]. intros [|j] _; simpl; ring.
  - change (length (u :: r)) with (S (length r)). rewrite sum_first.
    change (Qred (Qred (u * v) + @dot rationals r g) == u * v + sum (length r) (fun j => nth j r 0 * nth j g 0)).
    rewrite !Qred_correct. unfold dot. rewrite IH. reflexivity.
Qed.

Lemma tests_spec (m fN fF aN aF xN xF slack : Q) : xN == aN -> xF == aF -> slack == m * fN - Qabs fF ->
  (negb (negative fN) && negb (negative xN) && (is0 fN || is0 xN) = true /\
   negb (negative slack) && (is0 xF || is0 fF || negb (eqb (negative xF) (negative fF))) &&
   (is0 xF || is0 slack) = true) <->
  law m fN fF aN aF.
Proof.
  intros EN EF ES. unfold law.
  assert (neg : forall x : Q, negative x = false <-> 0 <= x).
  { intro x. rewrite <- not_true_iff_false, negative_spec.
    split; intro; [now apply Qnot_lt_le | now apply Qle_not_lt]. }
  rewrite !andb_true_iff, !orb_true_iff, !negb_true_iff, !is0_spec, eqb_false_iff, !neg, EN, ES.
  assert (zero_product : forall x y : Q, (x == 0 \/ y == 0) <-> x * y == 0).
  { intros x y. split; [intros [-> | ->]; ring | apply Qmult_integral]. }
  assert (opposed : (xF == 0 \/ fF == 0) \/ negative xF <> negative fF <-> xF * fF <= 0).
  { split.
    - intros [[E | E] | N]; [rewrite E; lra | rewrite E; lra|].
      destruct (negative xF) eqn:E1, (negative fF) eqn:E2; try congruence.
      + apply negative_spec in E1. apply neg in E2. nra.
      + apply neg in E1. apply negative_spec in E2. nra.
    - intro H. destruct (Qeq_dec xF 0) as [?|N1]; [tauto|]. destruct (Qeq_dec fF 0) as [?|N2]; [tauto|]. right.
      intro E.
      destruct (negative xF) eqn:E1; symmetry in E.
      + apply negative_spec in E1, E. nra.
      + apply neg in E1, E. assert (0 < xF) by (apply Qnot_le_lt; intro; apply N1, Qle_antisym; assumption).
        assert (0 < fF) by (apply Qnot_le_lt; intro; apply N2, Qle_antisym; assumption). nra. }
  rewrite opposed, EF, !zero_product.
  assert (Hs : 0 <= m * fN - Qabs fF <-> Qabs fF <= m * fN) by (split; intro; lra).
  rewrite Hs. tauto.
Qed.

Section Law.

Variables (p : problem rationals) (g : list Q).
Hypothesis W : well_formed p.
Let a_ i := sum (length (b p)) (fun j => entry (A p) i j * nth j g 0) + nth i (b p) 0.
Let s := @Point rationals g (accelerations p g) [].

Lemma acceleration i : (i < length (b p))%nat -> (nth i (accelerations p g) 0 : Q) == a_ i.
Proof.
  destruct W as [_ [WA [Wr _]]]. intro Hi. unfold accelerations.
  set (h rb := Qred (fst rb + snd rb)).
  assert (L : length (times p g) = length (b p)) by (unfold times; now rewrite map_length).
  rewrite (nth_indep _ 0 (h (0, 0))) by (rewrite map_length, combine_length, L; simpl in *; lia).
  rewrite map_nth, combine_nth by exact L. unfold h. rewrite Qred_correct. simpl. unfold a_.
  apply Qplus_inj_r. unfold times.
  rewrite (nth_indep _ 0 (@dot rationals [] g)) by (rewrite map_length; simpl in *; lia).
  rewrite (map_nth (fun r => @dot rationals r g)).
  assert (Ln : @length Q (nth i (A p) []) = length (b p)) by (apply Wr, nth_In; simpl in *; lia).
  pose proof (dot_sum (nth i (A p) []) g) as E. rewrite Ln in E. exact E.
Qed.

Lemma tests_are_law c : (c < length (mu p))%nat ->
  negb (violated p s (2 * c)) && negb (violated p s (S (2 * c))) = true <->
  law (nth c (mu p) 0) (nth (2 * c) g 0) (nth (S (2 * c)) g 0) (a_ (2 * c)) (a_ (S (2 * c))).
Proof.
  intro Hc. destruct W as [Wb _].
  assert (Ev : Nat.even (2 * c) = true) by (apply Nat.even_spec; now exists c).
  assert (Od : Nat.even (S (2 * c)) = false) by (rewrite Nat.even_succ, <- Nat.negb_even, Ev; reflexivity).
  assert (D : Nat.div2 (S (2 * c)) = c) by (rewrite Nat.div2_succ_double; reflexivity).
  unfold violated, is_normal, normal_of, contact_of. rewrite Ev, Od, D.
  assert (T : forall x y, negb (negb x) && negb (x && negb y) = true <-> x = true /\ y = true)
    by (intros [] []; simpl; intuition discriminate).
  rewrite T. clear T.
  assert (aN := acceleration (2 * c) ltac:(simpl in *; lia)).
  assert (aF := acceleration (S (2 * c)) ltac:(simpl in *; lia)).
  unfold normal_holds, friction_holds, mu_of, normal_of, contact_of, at_. rewrite D. unfold s. simpl f. simpl a.
  apply tests_spec; [exact aN | exact aF|].
  change (Qred (Qred (nth c (mu p) 0 * nth (2 * c) g 0) + Qred (- abs (nth (S (2 * c)) g 0)))
          == nth c (mu p) 0 * nth (2 * c) g 0 - Qabs (nth (S (2 * c)) g 0)).
  rewrite !Qred_correct, abs_spec. reflexivity.
Qed.

Theorem obeys_iff_solution : obeys p g = true <-> solution p g.
Proof.
  unfold obeys, solution. rewrite forallb_forall. destruct W as [Wb _]. fold s. split.
  - intros H c Hc. apply (tests_are_law c Hc). rewrite andb_true_iff. split; apply H, in_seq; simpl in *; lia.
  - intros H i Hi. apply in_seq in Hi.
    assert (Hc : (Nat.div2 i < length (mu p))%nat)
      by (rewrite Nat.div2_div; apply Nat.div_lt_upper_bound; simpl in *; lia).
    pose proof (proj2 (tests_are_law _ Hc) (H _ Hc)) as T. apply andb_true_iff in T. destruct T as [HN HF].
    destruct (Nat.Even_or_Odd i) as [[c ->] | [c ->]].
    + rewrite Nat.div2_double in HN. exact HN.
    + rewrite Nat.add_1_r in *. rewrite Nat.div2_succ_double in HF. exact HF.
Qed.

End Law.
