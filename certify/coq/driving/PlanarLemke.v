(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that Lemke's method solves static friction in the plane with any positive covering vector (over R(W), so
   also one graded by an infinite W), for any A symmetric positive semidefinite and any b in its range. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.driving Require Import Rational Statement.
From Stiction.existence Require Import Law Edge Parity Limit Plane.
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
apply: basic_solution => // i; have := nn i.
by rewrite -map_invmx -map_mxM mxE -(rmorph0 (emb_rmorphism R)) emb_le.
Qed.
End Cover.

Section Planar.
Variables (R : realFieldType) (n : nat) (A : 'M[R]_(n + n)) (c : 'cV[R]_(n + n)) (mu : 'rV[R]_n).
Hypothesis sym : A^T = A.
Hypothesis psd : forall f, 0 <= dotp f (A *m f).
Hypothesis mu0 : forall i, 0 <= mu 0 i.
Let b := A *m c.
Notation M := (Plane.M A mu).
Notation q := ((E R n)^T *m b).
(* forces and accelerations that a solution of the LCP stands for *)
Definition f_of (z : 'cV[R]_((n + n) + (n + n))) : 'cV[R]_(n + n) := E R n *m z.
Definition obeys_law (f : 'cV[R]_(n + n)) := forall i, let a := A *m f + b in
  law (mu 0 i) (f (lshift n i) 0) (f (rshift n i) 0) (a (lshift n i) 0) (a (rshift n i) 0).
Lemma lcp_law w z : lcp_solution M q w z -> obeys_law (f_of z).
Proof.
move=> [w0 z0 we wz] i.
have [N [P [Q [L ze]]]] := mkK z; have [wN [wP [wQ [wL wE]]]] := mkK w.
rewrite ze in z0 we wz *; rewrite wE in w0 we wz.
have [N0 P0 Q0 L0] := mk_nonneg z0; have [wN0 wP0 wQ0 wL0] := mk_nonneg w0.
rewrite /f_of Ez; set a := A *m col_mx N (P - Q) + b.
have : mk wN wP wQ wL = (E R n)^T *m a + S mu *m mk N P Q L.
  by rewrite we /Plane.M mulmxDl -!mulmxA Ez /a mulmxDr addrAC.
rewrite -[a in _ *m a]vsubmxK ETa Sz /mk !add_col_mx addr0 => /eq_col_mx [/eq_col_mx [eN eP] /eq_col_mx [eQ eL]].
have cN : N i 0 * wN i 0 = 0 by have := wz (lshift _ (lshift _ i)); rewrite !col_mxEu mulrC.
have cP : P i 0 * wP i 0 = 0 by have := wz (lshift _ (rshift _ i)); rewrite !col_mxEu !col_mxEd mulrC.
have cQ : Q i 0 * wQ i 0 = 0 by have := wz (rshift _ (lshift _ i)); rewrite !col_mxEd !col_mxEu mulrC.
have cL : L i 0 * wL i 0 = 0 by have := wz (rshift _ (rshift _ i)); rewrite !col_mxEd mulrC.
have aF : a (rshift n i) 0 = dsubmx a i 0 by rewrite [dsubmx a i 0]mxE.
have xP : wP i 0 = a (rshift n i) 0 + L i 0 by rewrite aF eP mxE.
have xQ : wQ i 0 = L i 0 - a (rshift n i) 0 by rewrite aF eQ mxE [X in X + _]mxE addrC.
have xL : wL i 0 = mu 0 i * N i 0 - P i 0 - Q i 0 by rewrite eL add0r /muN mul_diag_mx !mxE.
have xN : wN i 0 = a (lshift n i) 0 by rewrite eN [usubmx a i 0]mxE.
rewrite col_mxEu col_mxEd; have -> : (P - Q) i 0 = P i 0 - Q i 0 by rewrite !mxE.
by apply: (law_of (L := L i 0)) => //; rewrite -?xP -?xQ -?xL -?xN //.
Qed.

(* any covering vector, e.g. ones; any graded one *)
Theorem planar_lemke (d : 'cV[ratfun R]_((n + n) + (n + n))) : (forall i, 0 < d i 0) ->
  exists s, lemke_lex (MF M) d (qF q) = Solved s /\ obeys_law (f_of (z_basic M q s)).
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
  exists s, lemke_lex (MF M) graded (qF q) = Solved s /\ obeys_law (f_of (z_basic M q s)).
Proof. exact: planar_lemke graded_gt0. Qed.
End Planar.
