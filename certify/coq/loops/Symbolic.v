(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that runs on numbers that depend on a parameter t can be made for all t of an interval at once.

   Statement.v has the algorithm over any `field`; so the plugin paramcoq derives (`next_R`, a lemma that Coq checks)
   that runs over two fields that are related step by step are related. One field is Q, the other (`functions hi t`)
   is that of rational functions of t, whose signs are decided for all t in (0, hi). *)
From Coq Require Import QArith ZArith List Bool Arith Lia Lqa.
From Stiction.loops Require Import Statement.
From Param Require Import Param.
Import ListNotations.
Local Open Scope Q_scope.

(* ---- The relation lemma ---------------------------------------------------------------------------------------- *)

(* n drives from x on *)
Fixpoint further {F : field} (p : problem F) pol n (x : state F) : result (state F) :=
  match n with O => Going x | S n => match next p pol x with Going y => further p pol n y | End e => End e end end.

Ltac by_cases := intros; repeat match goal with x : _ |- _ = _ => destruct x; reflexivity; fail end.
Global Parametricity Tactic := ((by_cases; fail) || auto).
Parametricity nat. Parametricity bool. Parametricity comparison.
Parametricity Nat.add as Nat_add_R.
Parametricity Nat.mul as Nat_mul_R.
Parametricity Nat.eqb as Nat_eqb_R.
Parametricity Recursive further.
Parametricity Recursive start.

Lemma nat_R_refl n : nat_R n n.
Proof. induction n; constructor; assumption. Qed.
Lemma policy_R_refl pol : policy_R pol pol.
Proof. destruct pol as [[] [] [] [] [] [] [] [] []]; repeat constructor. Qed.
Lemma comparison_R_eq c d : c = d -> comparison_R c d.
Proof. intros <-. destruct c; constructor. Qed.

(* ---- Polynomials in t: coefficients of 1, t, t^2, ... ---------------------------------------------------------- *)

Definition poly := list Q.
Fixpoint at_t (p : poly) (t : Q) : Q := match p with [] => 0 | c :: p => c + t * at_t p t end.
Fixpoint padd (p q : poly) : poly :=
  match p, q with [], _ => q | _, [] => p | c :: p, d :: q => Qred (c + d) :: padd p q end.
Definition pscale (c : Q) (p : poly) : poly := map (fun x => Qred (c * x)) p.
Fixpoint pmul (p q : poly) : poly := match p with [] => [] | c :: p => padd (pscale c q) (0 :: pmul p q) end.
(* without zeros at the end *)
Fixpoint trim (p : poly) : poly :=
  match p with [] => [] | c :: p => match trim p with [] => if Qeq_bool c 0 then [] else [c] | q => c :: q end end.

Lemma at_padd t : forall p q, at_t (padd p q) t == at_t p t + at_t q t.
Proof. induction p as [|c p IH]; destruct q as [|d q]; cbn [at_t padd]; try ring. rewrite IH, Qred_correct. ring. Qed.
Lemma at_pscale t c p : at_t (pscale c p) t == c * at_t p t.
Proof. unfold pscale. induction p as [|d p IH]; cbn [at_t map]; [ring|]. rewrite IH, Qred_correct. ring. Qed.
Lemma at_pmul t q : forall p, at_t (pmul p q) t == at_t p t * at_t q t.
Proof.
  induction p as [|c p IH]; cbn [at_t pmul]; [ring|]. rewrite at_padd, at_pscale. cbn [at_t]. rewrite IH. ring.
Qed.
Lemma at_trim t : forall p, at_t (trim p) t == at_t p t.
Proof.
  induction p as [|c p IH]; simpl; [reflexivity|]. destruct (trim p) as [|d q]; simpl in *.
  - rewrite <- IH. destruct (Qeq_bool c 0) eqn:E; simpl; [apply Qeq_bool_eq in E; rewrite E; ring | ring].
  - rewrite IH. reflexivity.
Qed.

(* The sign of a polynomial that has one on all of (0, hi): its first coefficient outweighs all of the other sign. *)
Fixpoint against (hi : Q) (p : poly) : Q :=      (* a bound of -t p(t) *)
  match p with [] => 0 | c :: p => Qred (hi * ((if Qle_bool 0 c then 0 else - c) + against hi p)) end.
Fixpoint sign_on (hi : Q) (p : poly) : option comparison :=
  match p with
  | [] => Some Eq
  | c :: q => match (Qnum c ?= 0)%Z with
              | Eq => sign_on hi q
              | Gt => if Qle_bool (against hi q) c then Some Gt else None
              | Lt => if Qle_bool (against hi (pscale (- (1)) q)) (- c) then Some Lt else None
              end
  end.

Definition sign_of (x : Q) : comparison := (Qnum x ?= 0)%Z.
Lemma sign_of_spec x : match sign_of x with Lt => x < 0 | Eq => x == 0 | Gt => 0 < x end.
Proof. unfold sign_of, Qlt, Qeq. destruct x as [n d]. simpl. destruct (Z.compare_spec n 0); lia. Qed.
Lemma sign_of_unique x c : match c with Lt => x < 0 | Eq => x == 0 | Gt => 0 < x end -> sign_of x = c.
Proof. pose proof (sign_of_spec x). destruct (sign_of x), c; intros; try reflexivity; lra. Qed.
Lemma sign_of_Qeq x y : x == y -> sign_of x = sign_of y.
Proof. intro E. apply sign_of_unique. pose proof (sign_of_spec y). destruct (sign_of y); lra. Qed.

Section Interval.

Variables hi t : Q.
Hypothesis Ht : 0 < t < hi.

Lemma against_bounds p : 0 <= against hi p /\ - against hi p <= t * at_t p t /\
  (0 < against hi p -> - against hi p < t * at_t p t).
Proof.
  induction p as [|c p [I0 [I1 I2]]]; cbn [against at_t]; [repeat split; lra|].
  rewrite Qred_correct. set (m := (if Qle_bool 0 c then 0 else - c)).
  assert (M : 0 <= m /\ - m <= c).
  { unfold m. destruct (Qle_bool 0 c) eqn:E; [apply Qle_bool_iff in E; lra|].
    assert (~ 0 <= c) by (rewrite <- Qle_bool_iff; congruence). lra. }
  set (s := t * at_t p t) in *. set (g := against hi p) in *.
  assert (0 <= m + g) by lra. assert (- (m + g) <= c + s) by lra.
  assert (P : 0 <= hi * (m + g)) by nra.
  repeat split; [exact P | nra|]. intro Q.
  assert (0 < m + g) by (destruct (Qlt_le_dec 0 (m + g)); [assumption | nra]). nra.
Qed.

Lemma sign_on_sound : forall p c, sign_on hi p = Some c -> sign_of (at_t p t) = c.
Proof.
  induction p as [|d p IH]; cbn [sign_on at_t]; intros c H; [now injection H as <-|].
  pose proof (sign_of_spec d) as S. unfold sign_of in S. destruct (Qnum d ?= 0)%Z.
  - rewrite <- (IH c H). apply IH in H. apply sign_of_unique. pose proof (sign_of_spec (at_t p t)).
    set (v := at_t p t) in *. destruct (sign_of v); nra.
  - destruct (Qle_bool _ _) eqn:E; [|discriminate]. injection H as <-. apply Qle_bool_iff in E. apply sign_of_unique.
    destruct (against_bounds (pscale (- (1)) p)) as [B0 [B1 B2]]. rewrite at_pscale in B1, B2.
    set (g := against hi (pscale (- (1)) p)) in *. set (v := at_t p t) in *.
    assert (t * v == - (t * (- (1) * v))) by ring. destruct (Qlt_le_dec 0 g) as [G|G]; [specialize (B2 G)|]; lra.
  - destruct (Qle_bool _ _) eqn:E; [|discriminate]. injection H as <-. apply Qle_bool_iff in E. apply sign_of_unique.
    destruct (against_bounds p) as [B0 [B1 B2]].
    set (g := against hi p) in *. set (v := at_t p t) in *.
    destruct (Qlt_le_dec 0 g) as [G|G]; [specialize (B2 G)|]; lra.
Qed.

End Interval.

(* ---- Rational functions of t ----------------------------------------------------------------------------------- *)

Record function := Function { upper : poly; lower : poly }.
Definition value (x : function) t := at_t (upper x) t / at_t (lower x) t.
Definition constant c := Function [c] [1].

(* A common factor g of both is taken out; what `divide` proposes is checked. *)
Fixpoint divide_steps (n : nat) (p q : poly) : poly * poly :=      (* highest coefficient first *)
  match n, p, q with
  | S n, c :: p', d :: q' =>
    let k := Qred (c / d) in
    let r := map (fun xy => Qred (fst xy - k * snd xy)) (combine p' (q' ++ repeat 0 (length p'))) in
    let '(quotient, rest) := divide_steps n r q in (k :: quotient, rest)
  | _, _, _ => ([], p)
  end.
Definition divide (p q : poly) : poly * poly :=
  let n := (S (length p) - length q)%nat in
  let '(quotient, rest) := divide_steps n (rev p) (rev q) in (rev quotient, trim (rev rest)).
Fixpoint euclid (n : nat) (p q : poly) : poly :=
  match n, q with O, _ | _, [] => p | S n, _ => euclid n q (snd (divide p q)) end.
Definition same (p q : poly) := forallb (fun c => Qeq_bool c 0) (padd p (pscale (- (1)) q)).

Definition reduced (x : function) : function :=
  let u := trim (upper x) in let l := trim (lower x) in
  match l with
  | [c] => Function (pscale (/ c) u) [1]
  | _ =>
    let g := euclid (length u + length l) u l in
    let u' := fst (divide u g) in let l' := fst (divide l g) in
    match rev l' with
    | c :: _ =>
      let u' := pscale (/ c) u' in let l' := pscale (/ c) l' in let g := pscale c g in
      if same u (pmul u' g) && same l (pmul l' g) then Function u' l' else Function u l
    | [] => Function u l
    end
  end.

Lemma same_sound p q t : same p q = true -> at_t p t == at_t q t.
Proof.
  unfold same. intro H. assert (Z : at_t (padd p (pscale (- (1)) q)) t == 0).
  { induction (padd p (pscale (- (1)) q)) as [|c r IH]; [reflexivity|]. simpl in *.
    apply andb_true_iff in H as [H1 H2].
    apply Qeq_bool_eq in H1. rewrite H1, IH by exact H2. ring. }
  rewrite at_padd, at_pscale in Z. lra.
Qed.

(* x stands for y at t *)
Definition stands_for t (x : function) (y : Q) := ~ at_t (lower x) t == 0 /\ y == value x t.

Lemma reduced_sound t x y : stands_for t x y -> stands_for t (reduced x) y.
Proof.
  intros [N E]. unfold reduced, stands_for, value in *.
  rewrite <- (at_trim t (lower x)) in N, E. rewrite <- (at_trim t (upper x)) in E.
  set (u := trim (upper x)) in *. set (l := trim (lower x)) in *. clearbody u l.
  assert (G : forall u' l' g, same u (pmul u' g) && same l (pmul l' g) = true ->
    ~ at_t l' t == 0 /\ y == at_t u' t / at_t l' t).
  { intros u' l' g H. apply andb_true_iff in H as [H1 H2]. apply (same_sound _ _ t) in H1, H2.
    rewrite at_pmul in H1, H2. rewrite H1, H2 in E. rewrite H2 in N.
    assert (~ at_t l' t == 0) by (intro Z; apply N; rewrite Z; ring).
    assert (~ at_t g t == 0) by (intro Z; apply N; rewrite Z; ring).
    split; [assumption|]. rewrite E. field. auto. }
  assert (K : ~ at_t (lower (Function u l)) t == 0 /\
              y == at_t (upper (Function u l)) t / at_t (lower (Function u l)) t)
    by (split; assumption).
  assert (H0 : forall g, let u' := fst (divide u g) in let l' := fst (divide l g) in
    let r := match rev l' with
    | c :: _ => if same u (pmul (pscale (/ c) u') (pscale c g)) && same l (pmul (pscale (/ c) l') (pscale c g))
                then Function (pscale (/ c) u') (pscale (/ c) l') else Function u l
    | [] => Function u l end in
    ~ at_t (lower r) t == 0 /\ y == at_t (upper r) t / at_t (lower r) t).
  { intro g. simpl. destruct (rev (fst (divide l g))) as [|c r]; [exact K|].
    destruct (same u _ && same l _) eqn:T; [exact (G _ _ _ T) | exact K]. }
  destruct l as [|c [|d l]]; [exact (H0 _) | | exact (H0 _)].
  cbn [at_t upper lower] in N, E |- *. rewrite at_pscale. split; [lra|]. rewrite E. field.
  intro Z. apply N. rewrite Z. ring.
Qed.

Definition fadd x y :=
  reduced (Function (padd (pmul (upper x) (lower y)) (pmul (upper y) (lower x))) (pmul (lower x) (lower y))).
Definition fmul x y := reduced (Function (pmul (upper x) (upper y)) (pmul (lower x) (lower y))).
Definition fopp x := Function (pscale (- (1)) (upper x)) (lower x).

Definition sign_product (c d : comparison) :=
  match c, d with Eq, _ | _, Eq => Eq | Lt, Lt | Gt, Gt => Gt | _, _ => Lt end.
Definition decided hi (x : function) : option comparison :=
  match sign_on hi (upper x), sign_on hi (lower x) with
  | Some c, Some (Lt as d) | Some c, Some (Gt as d) => Some (sign_product c d)
  | _, _ => None
  end.
(* What cannot be decided for all t is that of this t: a run whose signs are all decided does not depend on t. *)
Definition fsign hi t (x : function) : comparison :=
  match decided hi x with Some c => c | None => sign_of (value x t) end.
Definition finv hi t (x : function) : function :=
  match fsign hi t x with Eq => constant 0 | _ => reduced (Function (lower x) (upper x)) end.

Definition functions hi t : field :=
  Field function (constant 0) (constant 1) fadd fmul fopp (finv hi t) (fsign hi t).

Section Related.

Variables hi t : Q.
Hypothesis Ht : 0 < t < hi.

Lemma fsign_sound x y : stands_for t x y -> fsign hi t x = sign_of y.
Proof.
  intros [N E]. rewrite (sign_of_Qeq _ _ E). unfold fsign, decided.
  destruct (sign_on hi (upper x)) as [c|] eqn:U; [|reflexivity].
  destruct (sign_on hi (lower x)) as [d|] eqn:L; [|reflexivity].
  apply (sign_on_sound hi t Ht) in U, L. unfold value.
  assert (Q : forall a b : Q, ~ b == 0 -> sign_of (a / b) = sign_product (sign_of a) (sign_of b)).
  { intros a b Hb. apply sign_of_unique.
    assert (R : a / b * b == a) by (field; exact Hb). set (q := a / b) in *.
    pose proof (sign_of_spec a). pose proof (sign_of_spec b).
    destruct (sign_of a), (sign_of b); simpl; try contradiction;
    try (destruct (Qlt_le_dec 0 q)); try (destruct (Qlt_le_dec q 0)); try assumption; try nra.
    all: try (assert (q * b == 0) by lra; destruct (Qmult_integral _ _ H1); [assumption | contradiction]). }
  destruct d; try reflexivity; symmetry; rewrite (Q _ _ N), U, L; reflexivity.
Qed.

Definition over_functions : field_R (functions hi t) rationals.
Proof.
  apply (field_R_Field_R function Q (stands_for t)).
  - split; [simpl; lra | unfold value; simpl; field].
  - split; [simpl; lra | unfold value; simpl; field].
  - intros x y [Nx Ex] u v [Nu Ev]. apply reduced_sound. split; unfold value in *; cbn [upper lower].
    + rewrite at_pmul. intro Z. apply Qmult_integral in Z. tauto.
    + rewrite Qred_correct, at_padd, !at_pmul, Ex, Ev. field. auto.
  - intros x y [Nx Ex] u v [Nu Ev]. apply reduced_sound. split; unfold value in *; cbn [upper lower].
    + rewrite at_pmul. intro Z. apply Qmult_integral in Z. tauto.
    + rewrite Qred_correct, !at_pmul, Ex, Ev. field. auto.
  - intros x y [Nx Ex]. split; unfold value in *; cbn [fopp upper lower]; [exact Nx|].
    rewrite at_pscale, Qred_correct, Ex. field. exact Nx.
  - intros x y H. pose proof (fsign_sound x y H) as S. destruct H as [Nx Ex]. unfold finv. rewrite S.
    pose proof (sign_of_spec y) as Y. destruct (sign_of y).
    + split; [simpl; lra|]. unfold value. cbn [constant upper lower at_t]. rewrite Qred_correct, Y.
      transitivity 0; [reflexivity | field].
    + apply reduced_sound. unfold value in Ex.
      assert (~ at_t (upper x) t == 0) by (intro Z; rewrite Z in Ex; unfold Qdiv in Ex; lra).
      split; [assumption|]. unfold value. cbn [upper lower]. rewrite Qred_correct, Ex. field. auto.
    + apply reduced_sound. unfold value in Ex.
      assert (~ at_t (upper x) t == 0) by (intro Z; rewrite Z in Ex; unfold Qdiv in Ex; lra).
      split; [assumption|]. unfold value. cbn [upper lower]. rewrite Qred_correct, Ex. field. auto.
  - intros x y H. apply comparison_R_eq. exact (fsign_sound x y H).
Defined.

End Related.

(* Q related to itself by ==: equal states go on equally, however their numbers are written. *)
Definition over_equal : field_R rationals rationals.
Proof.
  apply (field_R_Field_R Q Q Qeq).
  - reflexivity.
  - reflexivity.
  - intros x y E u v G. rewrite !Qred_correct, E, G. reflexivity.
  - intros x y E u v G. rewrite !Qred_correct, E, G. reflexivity.
  - intros x y E. rewrite !Qred_correct, E. reflexivity.
  - intros x y E. rewrite !Qred_correct, E. reflexivity.
  - intros x y E. apply comparison_R_eq. exact (sign_of_Qeq x y E).
Defined.

(* ---- Tools ----------------------------------------------------------------------------------------------------- *)

Definition symbolic := (list function * list function * list set * option nat * option nat)%type.
(* A state of functions without its field, for computation. *)
Definition parts {hi t} (r : result (state (functions hi t))) : option symbolic :=
  match r with
  | Going x => Some (f (point_of x), a (point_of x), sets (point_of x), last x, next_driven x)
  | End _ => None
  end.
Definition whole hi t (x : symbolic) : state (functions hi t) :=
  let '(f_, a_, s, l, d) := x in State (@Point (functions hi t) f_ a_ s) l d.
Lemma parts_whole hi t (r : result (state (functions hi t))) x : parts r = Some x -> r = Going (whole hi t x).
Proof. destruct r as [[[f_ a_ s] l d]|e]; simpl; intro H; [now injection H as <- | discriminate]. Qed.

Lemma result_going {S T} (R : S -> T -> Type) x r : result_R S T R (Going x) r -> {y & (r = Going y) * R x y}%type.
Proof. intro H. inversion H as [u v HR|]. subst. exists v. split; [reflexivity | exact HR]. Qed.

Lemma further_drives {F : field} (p : problem F) q : forall n i x, drives p q i = Going x ->
  drives p q (i + n) = further p q n x.
Proof.
  induction n; intros i x H; simpl; [now rewrite Nat.add_0_r|].
  rewrite <- Nat.add_succ_comm. destruct (next p q x) as [y|e] eqn:E.
  - apply IHn. simpl. now rewrite H.
  - assert (G : forall m, drives p q (S i + m) = End e).
    { induction m; [rewrite Nat.add_0_r; simpl; now rewrite H|].
      rewrite Nat.add_succ_r. cbn [drives]. now rewrite IHm. }
    apply G.
Qed.

Lemma list_to_R {S T} (R : S -> T -> Prop) : forall l m, Forall2 R l m -> list_R S T R l m.
Proof.
  induction l as [|x l IH]; intros [|y m] H; try (exfalso; inversion H; fail); constructor.
  - inversion H; assumption.
  - apply IH. inversion H; assumption.
Qed.
Lemma list_of_R {S T} (R : S -> T -> Prop) l m : list_R S T R l m -> Forall2 R l m.
Proof. induction 1; constructor; assumption. Qed.
Lemma sets_to_R (s : list set) : list_R set set set_R s s.
Proof. induction s as [|[] s IH]; constructor; try assumption; constructor. Qed.
Lemma sets_of_R s u : list_R set set set_R s u -> s = u.
Proof. induction 1 as [|x y H s u _ IH]; [reflexivity|]. subst. destruct H; reflexivity. Qed.
Lemma option_to_R (o : option nat) : option_R nat nat nat_R o o.
Proof. destruct o; constructor. apply nat_R_refl. Qed.
Lemma nat_of_R n m : nat_R n m -> n = m.
Proof. induction 1; congruence. Qed.
Lemma option_of_R o u : option_R nat nat nat_R o u -> o = u.
Proof. destruct 1 as [n m H|]; [f_equal; now apply nat_of_R | reflexivity]. Qed.
