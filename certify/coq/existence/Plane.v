(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that every static problem of the plane, (15) and (16), with A symmetric positive semidefinite and b in its
   range has a solution, over any ordered field. *)
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Stiction.existence Require Import Law Dot Edge Parity Limit.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Static.
Variables (R : realFieldType) (n : nat) (A : 'M[R]_(n + n)) (c : 'cV[R]_(n + n)) (mu : 'I_n -> R).
Hypothesis sym : A^T = A.
Hypothesis psd : forall f, 0 <= dotp f (A *m f).
Hypothesis mu0 : forall i, 0 <= mu i.
Let b := A *m c.

Notation V := ('cV[R]_n).
Definition E : 'M[R]_(n + n, (n + n) + (n + n)) := row_mx 1%:M (block_mx 0 0 (- 1%:M) 0).
Definition S : 'M[R]_((n + n) + (n + n)) :=
  block_mx 0 (block_mx 0 0 0 1%:M) (block_mx 0 0 (diag_mx (\row_i mu i)) (- 1%:M)) (block_mx 0 1%:M (- 1%:M) 0).
Definition M := E^T *m A *m E + S.
Definition mk (N P Q L : V) := col_mx (col_mx N P) (col_mx Q L).
Lemma mkK z : exists N P Q L, z = mk N P Q L.
Proof.
exists (usubmx (usubmx z)), (dsubmx (usubmx z)), (usubmx (dsubmx z)), (dsubmx (dsubmx z)).
by rewrite /mk !vsubmxK.
Qed.
Lemma Ez N P Q L : E *m mk N P Q L = col_mx N (P - Q).
Proof.
by rewrite mul_row_col mul1mx mul_block_col !mul0mx !addr0 mulNmx mul1mx add_col_mx addr0.
Qed.
Lemma ETa (aN aF : V) : E^T *m col_mx aN aF = mk aN aF (- aF) 0.
Proof.
rewrite tr_row_mx trmx1 tr_block_mx !trmx0 linearN /= trmx1 mul_col_mx mul1mx mul_block_col !mul0mx.
by rewrite !add0r mulNmx mul1mx.
Qed.
Definition muN (N : V) : V := diag_mx (\row_i mu i) *m N.
Lemma Sz N P Q L : S *m mk N P Q L = mk 0 L L (muN N - P - Q).
Proof.
rewrite /mk /S mul_block_col mul0mx add0r !mul_block_col !mul0mx !add0r !addr0 !mulNmx !mul1mx add_col_mx.
by rewrite add0r.
Qed.
Lemma mk_nonneg N P Q L : nonneg (mk N P Q L) -> [/\ nonneg N, nonneg P, nonneg Q & nonneg L].
Proof.
move=> h; split=> i.
- by have := h (lshift _ (lshift _ i)); rewrite !col_mxEu.
- by have := h (lshift _ (rshift _ i)); rewrite col_mxEu col_mxEd.
- by have := h (rshift _ (lshift _ i)); rewrite col_mxEd col_mxEu.
- by have := h (rshift _ (rshift _ i)); rewrite !col_mxEd.
Qed.
Lemma muN_nonneg N : nonneg N -> nonneg (muN N).
Proof. by move=> h i; rewrite /muN mul_diag_mx !mxE mulr_ge0. Qed.
Lemma dotM z z' : dotp z (M *m z') = dotp (E *m z) (A *m (E *m z')) + dotp z (S *m z').
Proof. by rewrite mulmxDl dotpD -!mulmxA dotp_adj. Qed.
Lemma dotS N P Q L N' P' Q' L' : dotp (mk N P Q L) (S *m mk N' P' Q' L') =
  dotp P L' + (dotp Q L' + (dotp L (muN N') - dotp L P' - dotp L Q')).
Proof. by rewrite Sz !dotp_col dotp0 add0r !dotpD !dotpN. Qed.

Lemma dotS_self N P Q L : dotp (mk N P Q L) (S *m mk N P Q L) = dotp L (muN N).
Proof. rewrite dotS (dotpC P) (dotpC Q); ring. Qed.
Lemma copos z : nonneg z -> 0 <= dotp z (M *m z).
Proof.
have [N [P [Q [L ->]]]] := mkK z => /mk_nonneg [hN hP hQ hL].
rewrite dotM addr_ge0 // dotS_self; exact: dotp_ge0 (muN_nonneg hN).
Qed.

Lemma raysM z z' : nonneg z -> nonneg z' -> nonneg (M *m z) -> dotp z (M *m z) = 0 ->
  0 <= dotp z (E^T *m b) /\ 0 <= dotp z (M *m z') + dotp z' (M *m z).
Proof.
have [N [P [Q [L ->]]]] := mkK z; have [N' [P' [Q' [L' ->]]]] := mkK z'.
move=> hz hz' _ e; have [hN hP hQ hL] := mk_nonneg hz; have [hN' hP' hQ' hL'] := mk_nonneg hz'.
set f := E *m mk N P Q L.
have Af : A *m f = 0.
  apply: (psd_kernel sym psd); move: e; rewrite dotM -/f => e.
  apply: (proj1 (sum0 (psd f) _ e)).
  rewrite dotS_self; exact: dotp_ge0 (muN_nonneg hN).
split; first by rewrite dotp_adj -/f /b -{1}sym dotp_adj Af dotpC dotp0.
rewrite !dotM -/f Af dotp0 add0r -{1}sym dotp_adj Af dotpC dotp0 add0r !dotS.
have -> : dotp P L' + (dotp Q L' + (dotp L (muN N') - dotp L P' - dotp L Q')) +
   (dotp P' L + (dotp Q' L + (dotp L' (muN N) - dotp L' P - dotp L' Q))) = dotp L (muN N') + dotp L' (muN N).
  rewrite (dotpC P) (dotpC Q) (dotpC P') (dotpC Q').
  ring.
apply: addr_ge0; apply: dotp_ge0 => //; exact: muN_nonneg.
Qed.

Lemma law_of (m N P Q L aN aF : R) : 0 <= N -> 0 <= P -> 0 <= Q -> 0 <= L -> 0 <= aN -> N * aN = 0 ->
  0 <= aF + L -> P * (aF + L) = 0 -> 0 <= L - aF -> Q * (L - aF) = 0 ->
  0 <= m * N - P - Q -> L * (m * N - P - Q) = 0 -> law m N (P - Q) aN aF.
Proof.
move=> N0 P0 Q0 L0 a0 na p1 p2 q1 q2 c1 c2; split=> //.
have le : P + Q <= m * N by rewrite -subr_ge0 opprD addrA.
have slack : L != 0 -> m * N = P + Q.
  by move=> h; move/eqP: c2; rewrite mulf_eq0 (negbTE h) /= -addrA -opprD subr_eq0 => /eqP.
split.
- apply: le_trans (ler_norm_sub _ _) _; by rewrite !ger0_norm.
- have e1 : P * aF = - (P * L) by apply/eqP; rewrite -subr_eq0 opprK -mulrDr p2.
  have e2 : Q * aF = Q * L by apply/eqP; rewrite eq_sym -subr_eq0 -mulrBr q2.
  by rewrite mulrC mulrBl e1 e2 -opprD oppr_le0 addr_ge0 // mulr_ge0.
case: (ltgtP aF 0) => [neg|pos|->]; last by rewrite mul0r.
- have Q00 : Q = 0.
    by move/eqP: q2; rewrite mulf_eq0 => /orP [/eqP //|]; rewrite gt_eqF // subr_gt0 (lt_le_trans neg).
  have Ln : L != 0 by rewrite gt_eqF // (lt_le_trans _ (_ : - aF <= L)) ?oppr_gt0 // -subr_ge0 opprK addrC.
  by rewrite (slack Ln) Q00 subr0 addr0 ger0_norm // subrr mulr0.
have P00 : P = 0.
  by move/eqP: p2; rewrite mulf_eq0 => /orP [/eqP //|]; rewrite gt_eqF // ltr_paddr.
have Ln : L != 0 by rewrite gt_eqF // (lt_le_trans pos) // -subr_ge0.
by rewrite (slack Ln) P00 sub0r add0r normrN ger0_norm // subrr mulr0.
Qed.

(* what a solution of the complementarity problem stands for *)
Lemma lcp_law (a0 : 'cV[R]_(n + n)) w z : lcp_solution M (E^T *m a0) w z -> solution A a0 mu (E *m z).
Proof.
move=> [w0 z0 we wz] i; rewrite /aN /aF /xN /xF /acc.
have [N [P [Q [L ze]]]] := mkK z; have [wN [wP [wQ [wL wE]]]] := mkK w.
rewrite ze in z0 we wz *; rewrite wE in w0 we wz.
have [N0 P0 Q0 L0] := mk_nonneg z0; have [wN0 wP0 wQ0 wL0] := mk_nonneg w0.
rewrite Ez; set a := A *m col_mx N (P - Q) + a0.
have : mk wN wP wQ wL = E^T *m a + S *m mk N P Q L.
  by rewrite we /M mulmxDl -!mulmxA Ez /a mulmxDr addrAC.
rewrite -[a in E^T *m a]vsubmxK ETa Sz /mk !add_col_mx addr0 => /eq_col_mx [/eq_col_mx [eN eP] /eq_col_mx [eQ eL]].
have cN : N i 0 * wN i 0 = 0 by have := wz (lshift _ (lshift _ i)); rewrite !col_mxEu mulrC.
have cP : P i 0 * wP i 0 = 0 by have := wz (lshift _ (rshift _ i)); rewrite !col_mxEu !col_mxEd mulrC.
have cQ : Q i 0 * wQ i 0 = 0 by have := wz (rshift _ (lshift _ i)); rewrite !col_mxEd !col_mxEu mulrC.
have cL : L i 0 * wL i 0 = 0 by have := wz (rshift _ (rshift _ i)); rewrite !col_mxEd mulrC.
have aF : a (rshift n i) 0 = dsubmx a i 0 by rewrite [dsubmx a i 0]mxE.
have xP : wP i 0 = a (rshift n i) 0 + L i 0 by rewrite aF eP mxE.
have xQ : wQ i 0 = L i 0 - a (rshift n i) 0 by rewrite aF eQ mxE [X in X + _]mxE addrC.
have xL : wL i 0 = mu i * N i 0 - P i 0 - Q i 0 by rewrite eL add0r /muN mul_diag_mx !mxE.
have xN : wN i 0 = a (lshift n i) 0 by rewrite eN [usubmx a i 0]mxE.
rewrite col_mxEu col_mxEd; have -> : (P - Q) i 0 = P i 0 - Q i 0 by rewrite !mxE.
by apply: (law_of (L := L i 0)) => //; rewrite -?xP -?xQ -?xL -?xN //.
Qed.

Theorem static_solution_exists : exists f, solution A b mu f.
Proof.
have d0 i : 0 < (const_mx 1 : 'cV[R]_((n + n) + (n + n))) i 0 by rewrite mxE ltr01.
by have [w [z /lcp_law s]] := lcp_solvable d0 copos raysM; exists (E *m z).
Qed.
End Static.
