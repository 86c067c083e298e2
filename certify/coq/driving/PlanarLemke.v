(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that Lemke's method solves static friction in the plane with any positive covering vector (over R(W), so
   also one graded by an infinite W), for any A symmetric positive semidefinite and any b in its range. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.driving Require Import Rational Statement.
From Stiction.existence Require Import Law Dot Edge Parity Limit Plane.
From Stiction.driving Require Import Path Lemke Eval Lexico.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

(* a covering vector over R(W) *)
Section Cover.
Variables (R : realFieldType) (n : nat) (M : 'M[R]_n) (q : 'cV[R]_n) (d : 'cV[ratfun R]_n).
Hypothesis d0 : forall i, 0 < d i 0.
Hypothesis copositive : forall z, nonneg z -> 0 <= dotp z (M *m z).
Hypothesis rays : forall z z', nonneg z -> nonneg z' -> nonneg (M *m z) -> dotp z (M *m z) = 0 ->
  0 <= dotp z q /\ 0 <= dotp z (M *m z') + dotp z' (M *m z).
Lemma basis_map s : basis (MF M) s = map_mx (@emb R) (basis M s).
Proof. by apply/matrixP => i j; rewrite !mxE; case: (s j); rewrite ?rmorphN ?mxE // rmorph_nat. Qed.
Theorem lemke_cover_ends_in_a_solution :
  exists s, lemke_lex (MF M) d (qF q) = Solved s /\ lcp_solution M q (w_basic M q s) (z_basic M q s).
Proof.
have [s [e un nn _]] := lemke_lex_ends_in_a_solution d0 (copositiveF copositive) (raysF rays).
exists s; split=> //; move: un nn; rewrite /basic basis_map map_unitmx => un nn.
apply: basic_lcp => // i; have := nn i.
by rewrite -map_invmx -map_mxM mxE -(rmorph0 (emb_rmorphism R)) emb_le.
Qed.
End Cover.

Section Planar.
Variables (R : realFieldType) (n : nat) (A : 'M[R]_(n + n)) (c : 'cV[R]_(n + n)) (mu : 'I_n -> R).
Hypothesis sym : A^T = A.
Hypothesis psd : forall f, 0 <= dotp f (A *m f).
Hypothesis mu0 : forall i, 0 <= mu i.
Let b := A *m c.
Notation M := (Plane.M A mu).
Notation q := ((E R n)^T *m b).
(* the forces that a solution of the LCP stands for *)
Definition f_of (z : 'cV[R]_((n + n) + (n + n))) : 'cV[R]_(n + n) := E R n *m z.

(* any covering vector, e.g. ones; any graded one *)
Theorem planar_lemke (d : 'cV[ratfun R]_((n + n) + (n + n))) : (forall i, 0 < d i 0) ->
  exists s, lemke_lex (MF M) d (qF q) = Solved s /\ solution A b mu (f_of (z_basic M q s)).
Proof.
move=> d0; have [s [e l]] := lemke_cover_ends_in_a_solution d0 (copos psd mu0) (raysM c sym psd mu0).
by exists s; split=> //; exact: lcp_law l.
Qed.

(* the covering vector of equivalence.md: W^v in the rows of variable v = 1, 2, ... (normal of contact 1, its
   friction, normal of contact 2, ...), W infinitely large; 1/W in multiplier rows *)
Notation W := (X R).
Definition graded : 'cV[ratfun R]_((n + n) + (n + n)) :=
  mk (\col_i W ^+ (i : nat).*2.+1) (\col_i W ^+ (i : nat).*2.+2) (\col_i W ^+ (i : nat).*2.+2) (\col_i W^-1).
Lemma graded_gt0 i : 0 < graded i 0.
Proof.
rewrite /graded /mk mxE; case: splitP => j _; rewrite mxE; case: splitP => k _; rewrite mxE ?exprn_gt0 ?invr_gt0 //;
  exact: X_gt0.
Qed.
Theorem graded_lemke_ends_in_a_solution :
  exists s, lemke_lex (MF M) graded (qF q) = Solved s /\ solution A b mu (f_of (z_basic M q s)).
Proof. exact: planar_lemke graded_gt0. Qed.
End Planar.
