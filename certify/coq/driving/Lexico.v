(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that Lemke's method ends in a solution where q has ties: over R(X), for q + (e, e^2, ...), e = 1/X
   infinitesimal. The basis in which it ends is one of a solution for q itself.
   d may be over R(X) for some R: graded. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.existence Require Import Law Dot Edge Parity.
From Stiction.driving Require Import Rational Statement Path Lemke Eval.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Lexico.
Variables (R : realFieldType) (n : nat) (M : 'M[R]_n) (d q : 'cV[R]_n).
Notation F := (ratfun R).
Notation sel := {ffun 'I_n -> bool}.
Notation eps := (Statement.eps R).
Definition dF : 'cV[F]_n := map_mx (@emb R) d.
Definition qeps : 'cV[F]_n := qF q + \col_i eps ^+ i.+1.
Lemma eps_gt0 : 0 < eps. Proof. by rewrite invr_gt0 X_gt0. Qed.
Lemma eps_small c : 0 < c -> eps < emb c.
Proof.
move=> c0; rewrite /Statement.eps -[emb c]invrK; rewrite ltf_pinv ?posrE ?X_gt0 ?invr_gt0 ?emb_gt0 //.
by have := X_large c^-1; rewrite fmorphV.
Qed.
Lemma H_map s : H (MF M) dF s = map_mx (@emb R) (H M d s).
Proof.
apply/matrixP => i k; rewrite !mxE; case: unliftP => [j _|_]; last by rewrite rmorphN.
by case: (s j); rewrite ?rmorphN ?mxE // rmorph_nat.
Qed.

(* nondegenerate *)
Lemma transcendental (p : 'rV[R]_n) : (map_mx (@emb R) p *m qeps) 0 0 = 0 -> p = 0.
Proof.
rewrite /qeps mulmxDr !mxE => e; apply/matrixP => i j; rewrite ord1 mxE.
pose P : {poly R} := (p *m q) 0 0 *: 'X^n + \sum_i p 0 i *: 'X^(n - i.+1).
have P0 : P = 0.
  apply: pf_inj; rewrite rmorph0 -[RHS](mulr0 (X R ^+ n)) -e.
  rewrite rmorphD rmorph_sum /= mulrDr; congr (_ + _).
    rewrite -mul_polyC rmorphM rmorphX /= mulrC; congr (_ * _).
    rewrite -/(emb _) mxE rmorph_sum; apply: eq_bigr => k _; by rewrite !mxE rmorphM.
  rewrite mulr_sumr; apply: eq_bigr => k _; rewrite !mxE -mul_polyC rmorphM rmorphX /= -/(X R) -/(emb _) mulrCA;
    congr (_ * _).
  by rewrite /Statement.eps exprVn -expfB_cond //; rewrite gt_eqF ?X_gt0 //= add0n ltn_ord.
have := congr1 (fun Q : {poly R} => Q`_(n - j.+1)) P0; rewrite coef0 coefD coefZ coefXn.
have -> : (n - j.+1 == n)%N = false by apply/negbTE; rewrite neq_ltn ltn_subrL /= (leq_ltn_trans _ (ltn_ord j)).
rewrite mulr0 add0r coef_sum (bigD1 j) //= coefZ coefXn eqxx mulr1 big1 ?addr0 // => k kj.
rewrite coefZ coefXn; have -> : (n - j.+1 == n - k.+1)%N = false; last by rewrite mulr0.
apply/negbTE; apply: contra kj => /eqP e2; apply/eqP/val_inj => /=.
have : (n - (n - j.+1) = n - (n - k.+1))%N by rewrite e2.
by rewrite !subKn ?ltn_ord // => -[].
Qed.
Lemma ndF s (u : 'cV[F]_n.+1) : nonneg u -> H (MF M) dF s *m u = qeps -> forall k l, u k 0 = 0 -> u l 0 = 0 -> k = l.
Proof.
move=> _ Hu k l uk ul; apply/eqP; apply: contraT => kl; have [p p0 hp] := annihilate (H M d s) kl.
case/negP: p0; apply/eqP/transcendental; rewrite -Hu H_map mulmxA -map_mxM mxE big1 // => j _.
rewrite mxE; case: (altP (j =P k)) => [->|jk]; first by rewrite uk mulr0.
case: (altP (j =P l)) => [->|jl]; first by rewrite ul mulr0.
by rewrite hp // rmorph0 mul0r.
Qed.

Hypothesis d0 : forall i, 0 < d i 0.
Lemma dF0 i : 0 < dF i 0. Proof. by rewrite mxE emb_gt0. Qed.

(* the basis matrix of a set of basic z's, and its basic solution *)
Definition basis (s : sel) : 'M[R]_n := \matrix_(i, j) if s j then - M i j else (i == j)%:R.
Definition basic (s : sel) : 'cV[R]_n := invmx (basis s) *m q.
Definition z_basic (s : sel) : 'cV[R]_n := \col_j if s j then basic s j 0 else 0.
Definition w_basic (s : sel) : 'cV[R]_n := \col_j if s j then 0 else basic s j 0.
Lemma basisE c s : col' ord0 (H M c s) = basis s.
Proof. by apply/matrixP => i j; rewrite !mxE liftK. Qed.
Lemma basic_lcp s : basis s \in unitmx -> nonneg (basic s) -> lcp_solution M q (w_basic s) (z_basic s).
Proof.
move=> un nn; have e k : padl ord0 (basic s) (lift ord0 k) 0 = basic s k 0 by rewrite [LHS]mxE liftK.
have -> : w_basic s = wof s (padl ord0 (basic s)) by apply/matrixP => i j; rewrite [LHS]mxE [RHS]mxE e.
have -> : z_basic s = zof s (padl ord0 (basic s)) by apply/matrixP => i j; rewrite [LHS]mxE [RHS]mxE e.
by apply: (basic_solution (d := 0)); rewrite ?basisE ?mulKVmx.
Qed.
Lemma small_sum (c : 'I_n -> R) (y : R) : 0 < emb y + \sum_i emb (c i) * eps ^+ i.+1 -> 0 <= y.
Proof.
move=> h; rewrite leNgt; apply/negP => yn.
pose C := \sum_i `|c i| + 1.
have C0 : 0 < C by rewrite ltr_paddl ?ltr01 // sumr_ge0.
have le : \sum_i emb (c i) * eps ^+ i.+1 <= emb C * eps.
  rewrite rmorphD mulrDl rmorph_sum mulr_suml /= ler_paddr ?rmorph1 ?mul1r ?(ltW eps_gt0) //.
  apply: ler_sum => i _; apply: le_trans (_ : emb `|c i| * eps ^+ i.+1 <= _).
    by rewrite ler_wpmul2r ?exprn_ge0 ?(ltW eps_gt0) // emb_le ler_norm.
  rewrite ler_wpmul2l //; first by rewrite -(rmorph0 (emb_rmorphism R)) emb_le.
  rewrite exprS ler_pimulr ?(ltW eps_gt0) // exprn_ile1 ?(ltW eps_gt0) //.
  by have := eps_small ltr01; rewrite rmorph1 => /ltW.
have : 0 < emb y + emb C * eps by apply: lt_le_trans h _; rewrite ler_add2l.
rewrite -ltr_subl_addl sub0r -rmorphN mulrC -ltr_pdivr_mulr ?emb_gt0 // -fmorph_div.
apply/negP; rewrite -leNgt ltW // eps_small // divr_gt0 // oppr_gt0; done.
Qed.
Lemma vertex_basic s : is_vertex (MF M) dF qeps s ord0 -> basis s \in unitmx /\ nonneg (basic s).
Proof.
move=> v; have ul := vertexC ndF v; have := basis_unit (@ndF) ul.
have eH : col' ord0 (H (MF M) dF s) = map_mx (@emb R) (basis s).
  by rewrite H_map -(basisE d); apply/matrixP => i j; rewrite !mxE.
rewrite eH map_unitmx => un; split=> // j.
have [_ _ /(_ (lift ord0 j))] := ul; rewrite eq_sym neq_lift mxE liftK eH => /(_ isT).
rewrite -map_invmx mulmxDr mxE [X in _ + X]mxE => h; apply: (small_sum (c := fun i => invmx (basis s) j i)).
move: h; rewrite -map_mxM mxE; congr (0 < _ + _); apply: eq_bigr => i _; by rewrite !mxE.
Qed.

Hypothesis copositive : forall z, nonneg z -> 0 <= dotp z (M *m z).
Hypothesis rays : forall z z', nonneg z -> nonneg z' -> nonneg (M *m z) -> dotp z (M *m z) = 0 ->
  0 <= dotp z q /\ 0 <= dotp z (M *m z') + dotp z' (M *m z).
(* Lemke's method, ties told by infinitesimals *)
Definition lemke_lex := lemke (MF M) dF qeps (2 ^ n).-1 (s0 n) (first dF qeps).
Theorem lemke_lex_ends_in_a_solution :
  exists s,
    [/\ lemke_lex = Solved s, basis s \in unitmx, nonneg (basic s) & lcp_solution M q (w_basic s) (z_basic s)].
Proof.
have raysE z z' : nonneg z -> nonneg z' -> nonneg (MF M *m z) -> dotp z (MF M *m z) = 0 ->
    0 <= dotp z qeps /\ 0 <= dotp z (MF M *m z') + dotp z' (MF M *m z).
  move=> hz hz' hM e; have [r1 r2] := raysF rays hz hz' hM e; split=> //.
  rewrite dotpD addr_ge0 //; apply: dotp_ge0 => // i; by rewrite mxE exprn_ge0 // ltW // eps_gt0.
have := lemke_ends dF0 ndF; have [s [e _]] := lemke_ends_in_a_solution dF0 ndF (copositiveF copositive) raysE.
rewrite e => /vertex_basic [un nn]; exists s; split=> //; exact: basic_lcp.
Qed.
End Lexico.
