(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves the statements of Statement.v: every problem with static friction has a solution, in space under Coulomb's
   law, with friction in polygons, and in the plane. *)
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import reals.
From mathcomp Require Import ring.
From Stiction.existence Require Import Law Dot Edge Parity Limit Plane Finite Polygon Approx Ultra Cluster
  Coulomb Statement.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Lemma dotp_mul (R : rcfType) m (x y : 'cV[R]_m) : (x^T *m y) 0 0 = dotp x y.
Proof. by rewrite mxE; apply: eq_bigr => i _; rewrite mxE. Qed.

Section Rows.
Variable R : realType.
Lemma laws (m fN fX fY aX aY : R) : length fX fY <= m * fN -> fX * aX + fY * aY <= - (1 * length aX aY * (m * fN)) ->
  coulomb_law m fN fX fY aX aY /\ baraff_law m fN fX fY aX aY.
Proof.
move=> c p; set s := m * fN in c p *; rewrite mul1r in p.
have s0 : 0 <= s by apply: le_trans c; exact: len_ge0.
have slide : ~ (aX = 0 /\ aY = 0) -> fX = - s * (aX / length aX aY) /\ fY = - s * (aY / length aX aY).
  move=> az; have lp : 0 < length aX aY.
    by rewrite lt_neqAle len_ge0 andbT eq_sym; apply/eqP => /len_eq0.
  pose u := aX / length aX aY; pose v := aY / length aX aY.
  have uv : u ^+ 2 + v ^+ 2 = 1.
    by rewrite /u /v !exprMn -mulrDl -len_sqr exprVn divff // expf_neq0 // gt_eqF.
  have pu : fX * u + fY * v <= - s.
    rewrite -(ler_pmul2r lp) mulrDl /u /v -!mulrA !mulVf ?gt_eqF // !mulr1 (le_trans p) //.
    by rewrite mulNr mulrC.
  have z : length (fX + s * u) (fY + s * v) = 0.
    apply/eqP; rewrite eq_le len_ge0 andbT; apply: le_len => //; rewrite expr0n /=.
    have -> : (fX + s * u) ^+ 2 + (fY + s * v) ^+ 2 =
      (fX ^+ 2 + fY ^+ 2) + (s * (fX * u + fY * v)) *+ 2 + s ^+ 2 * (u ^+ 2 + v ^+ 2) by ring.
    have c2 : fX ^+ 2 + fY ^+ 2 <= s ^+ 2 by rewrite -len_sqr ler_pexpn2r ?nnegrE ?len_ge0.
    have sp : s * (fX * u + fY * v) <= - (s ^+ 2) by rewrite expr2 -mulrN ler_wpmul2l.
    rewrite uv mulr1; apply: le_trans (_ : s ^+ 2 + (- (s ^+ 2)) *+ 2 + s ^+ 2 <= _).
      by rewrite ler_add2r ler_add // ler_muln2r.
    by rewrite le_eqVlt; apply/orP; left; apply/eqP; ring.
  have [zx zy] := len_eq0 z.
  by split; rewrite mulNr; apply/eqP; rewrite -addr_eq0 ?zx ?zy.
split; first split=> //.
  by have [az|az] := altP ((aX, aY) =P (0, 0));
    [left; case: az | right; apply: slide => -[x y]; rewrite x y eqxx in az].
split=> // [|az].
  by rewrite (le_trans p) // oppr_le0 mulr_ge0 // len_ge0.
have [-> ->] := slide az; have e x : - s * x = s * - x by rewrite mulNr mulrN.
rewrite !e lenZ //; suff -> : length (- (aX / length aX aY)) (- (aY / length aX aY)) = 1 by rewrite mulr1.
have lp : length aX aY != 0 by apply/eqP => /len_eq0.
by rewrite [length (- _) _]/length !sqrrN !exprMn -mulrDl -len_sqr exprVn divff ?sqrtr1 // expf_neq0.
Qed.


Variable n : nat.
Implicit Types (A : 'M[R]_(n + (n + n))) (b : 'cV[R]_(n + (n + n))) (mu : 'I_n -> R).
Lemma obeys_solution A b mu f : let a := A *m f + b in obeys 1 mu f a ->
  solution A b mu (usubmx f) (usubmx (dsubmx f)) (dsubmx (dsubmx f))
    (usubmx a) (usubmx (dsubmx a)) (dsubmx (dsubmx a)).
Proof.
rewrite /=; set a := A *m f + b => h; split=> [|i]; first by rewrite !vsubmxK.
have [nl [h1 h2]] := h i; have [c w] := laws h1 h2; move: nl c w; rewrite /nor /tx /ty.
by rewrite ![usubmx _ i 0]mxE ![dsubmx _ i 0]mxE ![dsubmx _ _ 0]mxE.
Qed.
Lemma obeys_exists A b mu : (exists f, obeys 1 mu f (A *m f + b)) ->
  exists fN fX fY aN aX aY, solution A b mu fN fX fY aN aX aY.
Proof.
move=> [f hf]; exists (usubmx f), (usubmx (dsubmx f)), (dsubmx (dsubmx f)).
set a := A *m f + b in hf; exists (usubmx a), (usubmx (dsubmx a)), (dsubmx (dsubmx a)); exact: obeys_solution.
Qed.
End Rows.

(* A positive semidefinite, symmetric or not: it is enough that b does no negative work on the solutions of the law
   with b = 0 *)
Theorem coulomb_solution_exists_nonsymmetric : coulomb_without_symmetry.
Proof.
move=> R n A b mu psd mu0 safe; apply/obeys_exists/solution_S => // [f|v ov]; first by rewrite -dotp_mul.
rewrite -[A *m v]addr0 in ov; have := safe _ _ _ _ _ _ (obeys_solution ov).
by rewrite !vsubmxK dotp_mul.
Qed.

(* so if A is positive definite, symmetric or not, there is a solution for every b *)
Theorem coulomb_solution_exists_definite : coulomb_definite.
Proof.
move=> R n A b mu pd mu0; apply/obeys_exists/solution_S => // [f|v ov].
  have [->|/pd/ltW] := altP (f =P 0); first by rewrite mulmx0 dotp0.
  by rewrite dotp_mul.
have [->|/pd] := altP (v =P 0); first by rewrite dotpC dotp0.
by rewrite dotp_mul ltNge (obeys_power ler01 ov).
Qed.

(* hypothesis (H): b does no negative work on the forces of the friction cones that accelerate nothing *)
Theorem coulomb_solution_exists_H : coulomb_has_a_solution_under_H.
Proof.
move=> R n A b mu sym psd mu0 safe.
have psd' f : 0 <= dotp f (A *m f) by rewrite -dotp_mul.
have safe' v : cone mu v -> A *m v = 0 -> 0 <= dotp v b.
  move=> cv Av; have := safe (usubmx v) (usubmx (dsubmx v)) (dsubmx (dsubmx v)).
  rewrite /= !vsubmxK dotp_mul; apply=> // i; rewrite !mxE; exact: cv.
exact/obeys_exists/(solution_H psd' sym mu0 safe').
Qed.

(* inertial bodies (W symmetric positive semidefinite), contact Jacobian J, loads F, and gaps >= 0 that are allowed to
   close: every scene at rest, every step of a time-stepping scheme without penetration *)
Theorem scene_solution_exists : scenes_have_a_solution.
Proof.
move=> R n d J W F gap mu sym psd gap0 mu0.
have work x : (x^T *m (J *m W *m J^T *m x)) 0 0 = dotp (J^T *m x) (W *m (J^T *m x)).
  by rewrite dotp_mul -!mulmxA -{1}[J]trmxK dotp_adj.
apply: coulomb_solution_exists_H => //.
- by rewrite /symmetric !trmx_mul trmxK sym mulmxA.
- by move=> f; rewrite work -dotp_mul.
move=> vN vX vY cv v Av.
have psd' x : 0 <= dotp x (W *m x) by rewrite -dotp_mul.
have Wv : W *m (J^T *m v) = 0 by apply: (psd_kernel sym psd'); rewrite -work Av mulmx0 mxE.
rewrite dotp_mul dotpD -{1}[J]trmxK dotp_adj (sym_dotp sym) Wv [dotp 0 _]dotpC dotp0 add0r.
rewrite dotp_col dotp0 addr0; apply: dotp_ge0 => // i; by case: (cv i).
Qed.

(* b in range(A) *)
Theorem coulomb_solution_exists : coulomb_has_a_solution.
Proof.
move=> R n A b mu sym psd [c bc] mu0; apply: coulomb_solution_exists_H => // vN vX vY _ v Av.
by rewrite dotp_mul bc sym_dotp // Av dotpC dotp0.
Qed.

(* moreover: one constant, for all loads in the range of A and all coefficients up to M,
   bounds the forces of some solution *)
Theorem coulomb_solution_bounded : coulomb_has_a_bounded_solution.
Proof.
move=> R n A M sym psd; have psd' f : 0 <= dotp f (A *m f) by rewrite -dotp_mul.
have [C C0 hC] := solution_bounded psd' sym M; exists C => // b mu bA hmu.
have [f fs fC] := hC mu b hmu bA; do 6!eexists; split; first exact: (obeys_solution fs).
by apply: le_trans fC; apply: ler_sum => i _; rewrite mxE.
Qed.

(* friction in a polygon *)
Theorem polygon_solution_exists : polygons_have_a_solution.
Proof.
move=> R n K dx dy A b mu sym psd mu0 safe.
have psd' f : 0 <= dotp f (A *m f) by rewrite -dotp_mul.
have safe' v : polygonal_itself mu dx dy v (A *m v) -> 0 <= dotp v b.
  move=> h.
  have le : dotp v (A *m v) <= 0.
    rewrite dotp_rows -oppr_ge0 -sumrN sumr_ge0 // => i _; rewrite oppr_ge0.
    by have [[_ _ ->] [_ _]] := h i; rewrite add0r.
  have Av : A *m v = 0 by apply: (psd_kernel sym psd'); apply/eqP; rewrite eq_le le psd'.
  have := safe (usubmx v) (usubmx (dsubmx v)) (dsubmx (dsubmx v)).
  rewrite /= !vsubmxK dotp_mul; apply=> // i; have [[v0 _ _] [P _ _]] := h i; by rewrite !mxE.
have [f hf] := polygon_itself_solution psd' mu0 safe'; set a := A *m f + b in hf.
exists (usubmx f), (usubmx (dsubmx f)), (dsubmx (dsubmx f)), (usubmx a), (usubmx (dsubmx a)), (dsubmx (dsubmx a)).
split=> [|i]; first by rewrite !vsubmxK.
by have := hf i; rewrite /nor /tx /ty ![usubmx _ i 0]mxE ![dsubmx _ i 0]mxE ![dsubmx _ _ 0]mxE.
Qed.

(* the plane *)
Theorem plane_solution_exists : plane_has_a_solution.
Proof.
by move=> R n A b mu sym psd [c ->] mu0; exact: static_solution_exists.
Qed.
