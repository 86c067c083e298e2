(* SPDX-License-Identifier: Apache-2.0 *)
(* Tests of Law.v and Statement.v: without its hypothesis on b the statement is false; a solution is one, and what is
   none is refused; the statement can be read over Coq's own real numbers. *)
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import reals Rstruct.
From mathcomp Require Import ring.
From Coq Require Rdefinitions.
From Stiction.existence Require Import Law Statement Theorems.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

(* a contact of infinitely heavy bodies that approach one another: no forces help *)
Lemma hypothesis_needed (R : realType) (mu : 'I_1 -> R) :
  ~ exists fN fX fY aN aX aY, solution 0 (col_mx (const_mx (-1)) 0) mu fN fX fY aN aX aY.
Proof.
move=> [fN [fX [fY [aN [aX [aY []]]]]]]; rewrite mul0mx add0r => /eq_col_mx [-> _] /(_ 0) [[_ + _] _ _].
by rewrite mxE ler0N1.
Qed.

(* one contact, A = identity, b = (-1, 3, 4), mu = 1: f = (1, -3/5, -4/5) is a solution, f = (1, 0, 0) is not *)
Section One.
Variable R : realType.
Let b : 'cV[R]_(1 + (1 + 1)) := col_mx (const_mx (-1)) (col_mx (const_mx 3%:R) (const_mx 4%:R)).
Lemma frictionless_is_not_a_solution (aN aX aY : 'cV[R]_1) : ~ solution 1%:M b (fun _ => 1) (const_mx 1) 0 0 aN aX aY.
Proof.
move=> []; rewrite mul1mx /b !add_col_mx => /eq_col_mx [_ /eq_col_mx [-> _]] /(_ 0) [_ _ [_ _]].
rewrite /length !mxE !add0r expr0n /= addr0 sqrtr0 mulr1 => h.
have /h /eqP : ~ (3%:R = 0 :> R /\ aY 0 0 = 0) by case=> /eqP; rewrite pnatr_eq0.
by rewrite eq_sym oner_eq0.
Qed.
Lemma opposed_friction_is_a_solution : solution 1%:M b (fun _ => 1)
  (const_mx 1) (const_mx (- (3%:R / 5%:R))) (const_mx (- (4%:R / 5%:R)))
  0 (const_mx (12%:R / 5%:R)) (const_mx (16%:R / 5%:R)).
Proof.
have l1 : length (- (3%:R / 5%:R)) (- (4%:R / 5%:R)) = 1 :> R.
  by rewrite /length (_ : _ + _ = 1 ^+ 2) ?sqrtr_sqr ?normr1 //; field.
have l4 : length (12%:R / 5%:R : R) (16%:R / 5%:R) = 4%:R.
  by rewrite /length (_ : _ + _ = 4%:R ^+ 2) ?sqrtr_sqr ?normr_nat //; field.
split=> [|i].
  rewrite mul1mx /b !add_col_mx; congr col_mx; last congr col_mx; apply/matrixP => i j; rewrite !mxE; by field.
rewrite !mxE; split.
- by split; rewrite ?ler01 ?mulr0.
- by split; [rewrite l1 mulr1 | right; rewrite l4; split; field].
split; rewrite ?l1 ?mulr1 //; rewrite -subr_ge0.
by rewrite (_ : _ - _ = 4%:R) ?ler0n //; field.
Qed.
End One.

Definition over_Coq_reals := @coulomb_solution_exists [realType of Rdefinitions.R].

(* the plane: b = (-1, 1), A = identity, mu = 1/2: f = (1, -1/2) is a solution, f = (1, 0) and f = (1, 1/2) are not *)
Section Plane.
Variable R : realFieldType.
Let half : R := 1 / 2%:R.
Lemma sliding_obeys : law half 1 (- half) 0 half.
Proof.
have h0 : 0 < half by rewrite /half divr_gt0 ?ltr01 ?ltr0n.
rewrite /law /normal_conditions normrN (gtr0_norm h0) !mulr1 mulr0 subrr mulr0; split; split=> //; rewrite ?ler01 //.
by rewrite mulrN oppr_le0 mulr_ge0 // ltW.
Qed.
Lemma no_friction_does_not : ~ law half 1 0 0 1.
Proof.
case=> _ [_ _]; rewrite normr0 subr0 mul1r mulr1 => /eqP.
by rewrite /half mulf_eq0 oner_eq0 invr_eq0 pnatr_eq0.
Qed.
Lemma friction_along_the_slip_does_not : ~ law half 1 half 0 1.
Proof. by case=> _ [_]; rewrite mul1r leNgt /half divr_gt0 ?ltr0n ?ltr01. Qed.
Lemma no_penetration : ~ law half 0 0 (-1) 0. Proof. by case=> [[_]]; rewrite ler0N1. Qed.
Lemma no_pulling : ~ law half (-1) 0 0 0. Proof. by case=> [[]]; rewrite ler0N1. Qed.
End Plane.
