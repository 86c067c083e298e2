(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that the reading `paper` loops on a family of two contacts (search/adversary/frontiers.md, 4, at mu = 1):
   positive definite matrices A(eta) whose condition number tends to K(1) = 3 + 2 sqrt(2), below which there are no
   folds. *)
From Coq Require Import QArith ZArith List Bool Arith Lia Lqa.
From Stiction.loops Require Import Statement Loop Laws Symbolic.
Import ListNotations.
Local Open Scope Q_scope.

(* The same, over rational functions of t = eta. *)
Definition poly_ (c d : Q) := reduced (Function [c; d] [1]).
Definition member_t hi t : problem (functions hi t) :=
  @Problem (functions hi t)
    [[poly_ 1 0; poly_ 1 1; poly_ 0 0; poly_ 0 4];
     [poly_ 1 1; poly_ 3 0; poly_ 0 (-(4)); poly_ 0 0];
     [poly_ 0 0; poly_ 0 (-(4)); poly_ 1 0; poly_ 1 1];
     [poly_ 0 4; poly_ 0 0; poly_ 1 1; poly_ 3 0]]
    [poly_ 0 1; poly_ 1 0; poly_ 0 (-(1)); poly_ 1 0] [poly_ 1 0; poly_ 1 0].

(* ---- A recurrence, found by computation over any field --------------------------------------------------------- *)

Section Search.

Context {F : field} (p : problem F) (pol : policy) (eqb : state F -> state F -> bool).
Hypothesis eqb_eq : forall x y, eqb x y = true -> x = y.

Fixpoint recurs n (seen : list (state F)) (x : state F) : bool :=
  if existsb (eqb x) seen then true else
  match n with O => false | S n => match next p pol x with Going y => recurs n (x :: seen) y | End _ => false end end.

Lemma recurs_sound n : forall k seen x, drives p pol k = Going x ->
  (forall y, In y seen -> exists i, (i < k)%nat /\ drives p pol i = Going y) ->
  recurs n seen x = true -> never_ends p pol.
Proof.
  assert (found : forall k seen x, drives p pol k = Going x ->
    (forall y, In y seen -> exists i, (i < k)%nat /\ drives p pol i = Going y) ->
    existsb (eqb x) seen = true -> never_ends p pol).
  { intros k seen x Hx Hs E. apply existsb_exists in E as [y [Hy E]]. apply eqb_eq in E. subst y.
    destruct (Hs x Hy) as [i [L Hi]]. apply (recurrence_never_ends p pol i (k - i) x); [lia | exact Hi|].
    now replace (i + (k - i))%nat with k by lia. }
  induction n as [|n IH]; intros k seen x Hx Hs H; cbn [recurs] in H;
  destruct (existsb (eqb x) seen) eqn:E; try exact (found k seen x Hx Hs E); try discriminate.
  destruct (next p pol x) as [y|e] eqn:N; [|discriminate].
  apply (IH (S k) (x :: seen) y); [cbn [drives]; now rewrite Hx | | exact H].
  intros z [<-|Hz]; [exists k; split; [lia | exact Hx]|]. destruct (Hs z Hz) as [i [L Hi]].
  exists i. split; [lia | exact Hi].
Qed.

Lemma recurs_never_ends n : recurs n [] (start p) = true -> never_ends p pol.
Proof. apply (recurs_sound n 0 [] (start p) eq_refl). intros y []. Qed.

End Search.

Definition function_eqb (x y : function) := list_eqb Q_eqb (upper x) (upper y) && list_eqb Q_eqb (lower x) (lower y).
Lemma function_eqb_eq x y : function_eqb x y = true -> x = y.
Proof.
  destruct x, y. unfold function_eqb. simpl. rewrite andb_true_iff. intros [H1 H2].
  apply (list_eqb_eq _ Q_eqb_eq) in H1. apply (list_eqb_eq _ Q_eqb_eq) in H2. congruence.
Qed.
Definition states_eqb hi t (x y : state (functions hi t)) :=
  list_eqb function_eqb (f (point_of x)) (f (point_of y)) &&
  list_eqb function_eqb (a (point_of x)) (a (point_of y)) &&
  list_eqb set_beq (sets (point_of x)) (sets (point_of y)) &&
  option_eqb (last x) (last y) && option_eqb (next_driven x) (next_driven y).
Lemma states_eqb_eq hi t x y : states_eqb hi t x y = true -> x = y.
Proof.
  destruct x as [[f1 a1 s1] l1 n1], y as [[f2 a2 s2] l2 n2]. unfold states_eqb. simpl.
  rewrite !andb_true_iff. intros [[[[H1 H2] H3] H4] H5].
  apply (list_eqb_eq _ function_eqb_eq) in H1. apply (list_eqb_eq _ function_eqb_eq) in H2.
  apply (list_eqb_eq _ internal_set_dec_bl) in H3. apply option_eqb_eq in H4. apply option_eqb_eq in H5.
  simpl in *. congruence.
Qed.

(* ---- From functions of t to numbers ---------------------------------------------------------------------------- *)

Lemma member_shows hi t (Ht : 0 < t < hi) :
  problem_R (functions hi t) rationals (over_functions hi t Ht) (member_t hi t) (member t).
Proof.
  assert (P : forall c d y, y == c + t * d -> stands_for t (poly_ c d) y).
  { intros c d y E. apply reduced_sound. split; [cbn; lra|]. unfold value. cbn [upper lower at_t]. rewrite E. field. }
  assert (V : forall l m, Forall2 (stands_for t) l m -> list_R function Q (stands_for t) l m)
    by (intros; now apply list_to_R).
  constructor.
  - change (list_R (list function) (list Q) (list_R function Q (stands_for t))
      (A (member_t hi t)) (matrix t)). unfold matrix.
    repeat (constructor; [apply V; repeat (apply Forall2_cons; [apply P; ring|]); apply Forall2_nil|]). constructor.
  - apply V. repeat (apply Forall2_cons; [apply P; ring|]). apply Forall2_nil.
  - apply V. repeat (apply Forall2_cons; [apply P; ring|]). apply Forall2_nil.
Qed.

Lemma never_ends_at hi t pol : 0 < t < hi -> never_ends (member_t hi t) pol -> never_ends (member t) pol.
Proof.
  intros Ht H k. destruct (H k) as [x Hx].
  assert (E : forall (F : field) (p : problem F), drives p pol k = further p pol k (start p))
    by (intros; apply (further_drives p pol k 0 (start p) eq_refl)).
  rewrite E in *. 
  pose proof (start_R _ _ (over_functions hi t Ht) _ _ (member_shows hi t Ht)) as S.
  pose proof (further_R _ _ (over_functions hi t Ht) _ _ (member_shows hi t Ht) pol pol (policy_R_refl pol) k k
    (nat_R_refl k) _ _ S) as R.
  rewrite Hx in R. destruct (result_going _ _ _ R) as [y [Ey _]]. exists y. exact Ey.
Qed.

Definition small : Q := 1 # 1000.
Definition all_recur n t :=
  forallb (fun pol => recurs (member_t small t) pol (states_eqb small t) n [] (start (member_t small t))).

Lemma paper_recurs t : all_recur 14 t [paper] = true.
Proof. vm_compute. reflexivity. Qed.

Theorem paper_never_ends eta : 0 < eta < small -> never_ends (member eta) paper.
Proof.
  intro H. apply (never_ends_at small eta paper H).
  pose proof (paper_recurs eta) as R. unfold all_recur in R. cbn [forallb] in R. rewrite andb_true_r in R.
  exact (recurs_never_ends _ _ _ (states_eqb_eq small eta) 14 R).
Qed.

(* ---- Condition numbers ----------------------------------------------------------------------------------------- *)

Lemma quadratic_4 M x : quadratic 4 M x ==
  x 0%nat * (entry M 0 0 * x 0%nat + entry M 0 1 * x 1%nat + entry M 0 2 * x 2%nat + entry M 0 3 * x 3%nat) +
  x 1%nat * (entry M 1 0 * x 0%nat + entry M 1 1 * x 1%nat + entry M 1 2 * x 2%nat + entry M 1 3 * x 3%nat) +
  x 2%nat * (entry M 2 0 * x 0%nat + entry M 2 1 * x 1%nat + entry M 2 2 * x 2%nat + entry M 2 3 * x 3%nat) +
  x 3%nat * (entry M 3 0 * x 0%nat + entry M 3 1 * x 1%nat + entry M 3 2 * x 2%nat + entry M 3 3 * x 3%nat).
Proof. unfold quadratic. cbn [sum]. ring. Qed.

(* p u^2 + 2 s u v + q v^2 >= (det / trace) (u^2 + v^2) *)
Lemma form_2 p q s d u v : 0 < p + q -> d * (p + q) == p * q - s * s -> 0 < p - d -> 
  d * (u * u + v * v) <= p * (u * u) + 2 * s * (u * v) + q * (v * v).
Proof.
  intros T E P.
  assert (S : (p - d) * (q - d) - s * s == d * d)
    by (setoid_replace ((p - d) * (q - d) - s * s) with (p * q - s * s - d * (p + q) + d * d) by ring;
        rewrite <- E; ring).
  assert (G : 0 <= (p - d) * ((p - d) * (u * u) + 2 * s * (u * v) + (q - d) * (v * v))).
  { setoid_replace ((p - d) * ((p - d) * (u * u) + 2 * s * (u * v) + (q - d) * (v * v)))
      with (((p - d) * u + s * v) * ((p - d) * u + s * v) + ((p - d) * (q - d) - s * s) * (v * v)) by ring.
    rewrite S. pose proof (square_nonnegative ((p - d) * u + s * v)). pose proof (square_nonnegative (d * v)). nra. }
  assert (0 <= (p - d) * (u * u) + 2 * s * (u * v) + (q - d) * (v * v)).
  { destruct (Qlt_le_dec ((p - d) * (u * u) + 2 * s * (u * v) + (q - d) * (v * v)) 0); [nra | assumption]. }
  lra.
Qed.

Lemma both_forms p q s d e x0 x1 x2 x3 : 0 < p + q -> d * (p + q) == p * q - s * s -> 0 < p - d -> 0 < e ->
  5 * e < d ->
  0 < x0 * x0 + x1 * x1 + x2 * x2 + x3 * x3 ->
  forall r v w z : Q, -e <= r <= e -> -e <= z <= e -> - (4 * e) <= v <= 4 * e -> - (4 * e) <= w <= 4 * e ->
  0 < (p * (x0 * x0) + 2 * s * (x0 * x1) + q * (x1 * x1)) + (p * (x2 * x2) + 2 * s * (x2 * x3) + q * (x3 * x3))
      + 2 * r * (x0 * x1) + 2 * z * (x2 * x3) + 2 * v * (x0 * x3) + 2 * w * (x1 * x2).
Proof.
  intros T E P He Hd N r v w z Hr Hz Hv Hw.
  pose proof (form_2 p q s d x0 x1 T E P). pose proof (form_2 p q s d x2 x3 T E P).
  assert (B : forall k b y y' : Q, 0 <= k -> - k <= b <= k -> - (k * (y * y + y' * y')) <= 2 * b * (y * y')).
  { intros k b y y' Hk [Hb1 Hb2].
    pose proof (square_nonnegative (y + y')) as S1. pose proof (square_nonnegative (y - y')) as S2.
    assert (0 <= (k + b) * ((y + y') * (y + y'))) by nra. assert (0 <= (k - b) * ((y - y') * (y - y'))) by nra. lra. }
  pose proof (B e r x0 x1 ltac:(lra) Hr). pose proof (B e z x2 x3 ltac:(lra) Hz).
  pose proof (B (4 * e) v x0 x3 ltac:(lra) Hv). pose proof (B (4 * e) w x1 x2 ltac:(lra) Hw).
  assert (0 < (d - 5 * e) * (x0 * x0 + x1 * x1 + x2 * x2 + x3 * x3)) by nra. lra.
Qed.

Lemma some_square x : (exists i, (i < 4)%nat /\ ~ x i == 0) ->
  0 < x 0%nat * x 0%nat + x 1%nat * x 1%nat + x 2%nat * x 2%nat + x 3%nat * x 3%nat.
Proof.
  intros [i [Hi N]]. pose proof (square_positive (x i) N).
  pose proof (square_nonnegative (x 0%nat)). pose proof (square_nonnegative (x 1%nat)).
  pose proof (square_nonnegative (x 2%nat)). pose proof (square_nonnegative (x 3%nat)).
  destruct i as [|[|[|[|i]]]]; [lra | lra | lra | lra | lia].
Qed.

(* K(1) = 3 + 2 sqrt(2) is the root c > 1 of c + 1/c = 6. *)
Theorem condition_numbers c : 1 < c -> 6 < c + / c -> exists eta0, 0 < eta0 /\
  forall eta, 0 < eta < eta0 -> condition_below 4 (matrix eta) c.
Proof.
  intros Hc H6. set (l := 4 / (c + 1)). assert (Hl : l * (c + 1) == 4) by (unfold l; field; lra).
  assert (L0 : 0 < l) by nra.
  assert (H6' : 6 * c < c * c + 1).
  { assert (c * (c + / c) == c * c + 1) by (field; lra). nra. }
  assert (Det : 0 < l * l - 4 * l + 2).
  { assert (D1 : (l * l - 4 * l + 2) * ((c + 1) * (c + 1)) == 2 * (c * c + 1 - 6 * c)).
    { setoid_replace ((l * l - 4 * l + 2) * ((c + 1) * (c + 1)))
        with ((l * (c + 1)) * (l * (c + 1)) - 4 * (l * (c + 1)) * (c + 1) + 2 * ((c + 1) * (c + 1))) by ring.
      rewrite Hl. ring. }
    destruct (Qlt_le_dec 0 (l * l - 4 * l + 2)) as [?|G]; [assumption|].
    assert (0 < (c + 1) * (c + 1)) by nra. nra. }
  assert (L1 : l < 1) by nra.
  set (d := (l * l - 4 * l + 2) / (4 - 2 * l)).
  assert (Hd : d * (4 - 2 * l) == l * l - 4 * l + 2) by (unfold d; field; lra).
  assert (D0 : 0 < d) by nra.
  exists (d / 5). assert (F : d / 5 * 5 == d) by field. set (eta0 := d / 5) in *.
  split; [nra|]. intros eta [E0 E1].
  exists l, (4 - l). split; [exact L0|]. split; [lra|].
  split; intros x Hx; apply some_square in Hx; rewrite quadratic_4.
  - pose proof (both_forms (1 - l) (3 - l) 1 d eta (x 0%nat) (x 1%nat) (x 2%nat) (x 3%nat)) as G.
    specialize (G ltac:(lra) ltac:(lra) ltac:(nra) E0 ltac:(lra) Hx
      eta (4 * eta) (- (4 * eta)) eta ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
    eapply Qlt_le_trans; [exact G|]. apply Qle_lteq. right.
    unfold shifted, entry, matrix. cbn [nth map seq Nat.eqb]. ring.
  - pose proof (both_forms (3 - l) (1 - l) (-(1)) d eta (x 0%nat) (x 1%nat) (x 2%nat) (x 3%nat)) as G.
    specialize (G ltac:(lra) ltac:(lra) ltac:(nra) E0 ltac:(lra) Hx
      (- eta) (- (4 * eta)) (4 * eta) (- eta) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
    eapply Qlt_le_trans; [exact G|]. apply Qle_lteq. right.
    unfold shifted, entry, matrix. cbn [nth map seq Nat.eqb]. ring.
Qed.

Lemma matrix_symmetric eta : symmetric 4 (matrix eta).
Proof.
  intros i j Hi Hj. unfold entry, matrix.
  destruct i as [|[|[|[|i]]]]; [| | | |lia]; (destruct j as [|[|[|[|j]]]]; [| | | |lia]); reflexivity.
Qed.
Lemma member_well_formed eta : well_formed (member eta).
Proof.
  split; [reflexivity|]. split; [reflexivity|]. split.
  - intros r [<-|[<-|[<-|[<-|[]]]]]; reflexivity.
  - intros m [<-|[<-|[]]]; discriminate.
Qed.

(* Policies that never end on members with a small eta never end at condition numbers below any c > K(1). *)
Lemma near_K (policies : policy -> Prop) :
  (forall pol eta, policies pol -> 0 < eta < small -> never_ends (member eta) pol) -> loops_near_K policies.
Proof.
  intros N c Hc H6. destruct (condition_numbers c Hc H6) as [e0 [E0 H]].
  exists (if Qlt_le_dec e0 small then e0 else small).
  split; [destruct (Qlt_le_dec e0 small); [exact E0 | reflexivity]|].
  intros eta [L U]. split; [apply member_well_formed|]. split; [apply matrix_symmetric|].
  assert (eta < e0 /\ eta < small) as [U1 U2].
  { destruct (Qlt_le_dec e0 small) as [G|G];
    split; [exact U | eapply Qlt_trans; eassumption | eapply Qlt_le_trans; eassumption | exact U]. }
  split; [apply H; split; assumption | intros pol P; apply N; [exact P | split; assumption]].
Qed.

(* For every c > K(1) = 3 + 2 sqrt(2) there are problems of condition number below c on which `paper` never ends. *)
Theorem loops_near_K : paper_loops_near_K.
Proof. apply near_K. intros pol eta ->. apply paper_never_ends. Qed.
