(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves the same for every q: q + (e, e^2, ...) is nondegenerate for small e,
   and signs of polynomials near 0 are those at 0. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.existence Require Import Law Dot Edge Parity.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Eventually.
Variable R : realFieldType.
Definition ev (C : R -> Prop) := exists2 b, 0 < b & forall e, 0 < e -> e < b -> C e.
Lemma ev_and C D : ev C -> ev D -> ev (fun e => C e /\ D e).
Proof.
move=> [b b0 hb] [c c0 hc]; exists (Num.min b c); first by rewrite lt_minr b0.
by move=> e e0; rewrite lt_minr => /andP [eb ec]; split; [apply: hb | apply: hc].
Qed.
Lemma ev_all (T : finType) (C : T -> R -> Prop) : (forall x, ev (C x)) -> ev (fun e => forall x, C x e).
Proof.
move=> h; suff [b b0 hb] : ev (fun e => forall x, x \in enum T -> C x e).
  by exists b => // e e0 eb x; apply: hb => //; rewrite mem_enum.
elim: (enum T) => [|x s IH]; first by exists 1 => //; exact: ltr01.
have [b b0 hb] := ev_and (h x) IH; exists b => // e e0 eb y.
by have [p r] := hb e e0 eb; rewrite inE => /orP [/eqP ->|/r].
Qed.
Lemma bound (P : {poly R}) : exists2 c, 0 <= c & forall e, 0 < e -> e < 1 -> `|P.[e]| <= c.
Proof.
elim/poly_ind: P => [|P a [c c0 h]]; first by exists 0 => // e _ _; rewrite horner0 normr0.
exists (c + `|a|); first by rewrite addr_ge0.
move=> e e0 e1; rewrite hornerMXaddC; apply: le_trans (ler_norm_add _ _) _.
rewrite ler_add2r normrM -[c]mulr1; apply: ler_pmul => //; first exact: h.
by rewrite gtr0_norm // ltW.
Qed.
Lemma near0 (P : {poly R}) : P != 0 -> ev (fun e => P.[e] != 0 /\ (P.[0] < 0 -> P.[e] < 0)).
Proof.
elim/poly_ind: P => [|P a IH]; first by rewrite eqxx.
case: (altP (a =P 0)) => [->|a0] nz.
  have P0 : P != 0 by apply: contraNneq nz => ->; rewrite mul0r add0r.
  have [b b0 h] := IH P0; exists b => // e e0 eb; rewrite !hornerMXaddC !addr0 mulr0 ltxx.
  by split=> //; rewrite mulf_neq0 //; [case: (h e e0 eb) | rewrite gt_eqF].
have [c c0 h] := bound P.
have a1 : 0 < `|a| by rewrite normr_gt0.
have c1 : 0 < c + 1 by rewrite ltr_paddl.
exists (Num.min 1 (`|a| / (c + 1))); first by rewrite lt_minr ltr01 divr_gt0.
move=> e e0; rewrite lt_minr => /andP [e1 eb]; rewrite !hornerMXaddC mulr0 add0r.
have small : `|P.[e] * e| < `|a|.
  rewrite normrM (gtr0_norm e0); apply: le_lt_trans (_ : (c + 1) * e < _).
    by rewrite ler_pmul2r // (le_trans (h e e0 e1)) // ler_addl ler01.
  by rewrite mulrC -ltr_pdivl_mulr.
split; first by apply: contraTneq small => /eqP; rewrite addr_eq0 => /eqP ->; rewrite normrN ltxx.
move=> an; move: small; rewrite (ltr0_norm an) => small.
by rewrite -ltr_subr_addr sub0r; exact: le_lt_trans (ler_norm _) small.
Qed.
End Eventually.

Section Solve.
Variables (R : realFieldType) (n : nat) (M : 'M[R]_n) (q : 'cV[R]_n).
Definition qe (e : R) : 'cV[R]_n := q + \col_i e ^+ i.+1.
Definition pol (p : 'rV[R]_n) : {poly R} := ((p *m q) 0 0)%:P + \sum_i p 0 i *: 'X^(i.+1).
Lemma polE p e : (pol p).[e] = (p *m qe e) 0 0.
Proof.
rewrite /pol hornerD hornerC horner_sum mulmxDr !mxE; congr (_ + _); apply: eq_bigr => i _.
by rewrite hornerZ hornerXn mxE.
Qed.
Lemma pol0 p : (pol p).[0] = (p *m q) 0 0.
Proof.
rewrite /pol hornerD hornerC horner_sum big1 ?addr0 // => i _.
by rewrite hornerZ hornerXn expr0n /= mulr0.
Qed.
Lemma pol_neq0 p : p != 0 -> pol p != 0.
Proof.
move=> /eqP h; apply/eqP => z; apply: h; apply/matrixP => i j; rewrite ord1 mxE.
have := congr1 (fun x : {poly R} => x`_(j.+1)) z; rewrite coef0 coefD coefC add0r coef_sum.
rewrite (bigD1 j) //= coefZ coefXn eqxx mulr1 big1 ?addr0 // => k kj.
by rewrite coefZ coefXn eqSS eq_sym (negbTE (kj : nat_of_ord k != nat_of_ord j)) mulr0.
Qed.
End Solve.

Section Nondegenerate.
Variables (R : realFieldType) (n : nat) (M : 'M[R]_n) (d q : 'cV[R]_n).
Definition nd_at e := forall s u, nonneg u -> H M d s *m u = qe q e -> forall k l, u k 0 = 0 -> u l 0 = 0 -> k = l.
Lemma nondegenerate : ev nd_at.
Proof.
have h (x : {ffun 'I_n -> bool} * 'I_n.+1 * 'I_n.+1) : ev (fun e => forall u, H M d x.1.1 *m u = qe q e ->
    u x.1.2 0 = 0 -> u x.2 0 = 0 -> x.1.2 = x.2).
  case: x => [[s k] l] /=; case: (altP (k =P l)) => [->|kl]; first by exists 1; rewrite ?ltr01.
  have [p p0 hp] := annihilate (H M d s) kl.
  have [b b0 hb] := near0 (pol_neq0 q p0); exists b => // e e0 eb u Hu uk ul.
  have [+ _] := hb e e0 eb; rewrite polE -Hu mulmxA mxE big1 ?eqxx // => j _.
  case: (altP (j =P k)) => [->|jk]; first by rewrite uk mulr0.
  by case: (altP (j =P l)) => [->|jl]; [rewrite ul mulr0 | rewrite hp // mul0r].
have [b b0 hb] := ev_all h; exists b => // e e0 eb s u _ Hu k l uk ul.
exact: (hb e e0 eb (s, k, l) u Hu uk ul).
Qed.

Hypothesis d0 : forall i, 0 < d i 0.
Hypothesis copositive : forall z, nonneg z -> 0 <= dotp z (M *m z).
Hypothesis rays : forall z z', nonneg z -> nonneg z' -> nonneg (M *m z) -> dotp z (M *m z) = 0 ->
  0 <= dotp z q /\ 0 <= dotp z (M *m z') + dotp z' (M *m z).

Notation G s := (col' ord0 (H M d s)).

Theorem lcp_solvable : exists w z, lcp_solution M q w z.
Proof.
(* e small: nondegenerate, and no coordinate of a solution changes its sign on the way to 0 *)
have h (x : {ffun 'I_n -> bool} * 'I_n) : ev (fun e => G x.1 \in unitmx ->
    (invmx (G x.1) *m q) x.2 0 < 0 -> (invmx (G x.1) *m qe q e) x.2 0 < 0).
  case: x => s j /=; case: (boolP (G s \in unitmx)) => gu; last by exists 1; rewrite ?ltr01.
  have r0 : row j (invmx (G s)) != 0.
    apply/eqP => z; have := congr1 (fun x : 'rV[R]_n => x *m G s) z.
    rewrite -row_mul mulVmx // mul0mx => /matrixP /(_ 0 j); rewrite !mxE eqxx => /eqP; by rewrite oner_eq0.
  have [b b0 hb] := near0 (pol_neq0 q r0); exists b => // e e0 eb _.
  have [_] := hb e e0 eb; rewrite pol0 polE -!row_mul !mxE; exact.
have [b b0 hb] := ev_and nondegenerate (ev_all h).
pose e := b / 2%:R; have e0 : 0 < e by rewrite divr_gt0 ?ltr0n.
have eb : e < b by rewrite ltr_pdivr_mulr ?ltr0n // ltr_pmulr // ltr1n.
have [nde sg] := hb e e0 eb.
have raysE z z' : nonneg z -> nonneg z' -> nonneg (M *m z) -> dotp z (M *m z) = 0 ->
    0 <= dotp z (qe q e) /\ 0 <= dotp z (M *m z') + dotp z' (M *m z).
  move=> hz hz' hM e1; have [r1 r2] := rays hz hz' hM e1; split=> //.
  rewrite dotpD addr_ge0 //; apply: dotp_ge0 => // i; by rewrite mxE exprn_ge0 // ltW.
have [s sv] := solvable d0 nde copositive raysE.
have [u ul] := elimT (is_vertexP nde s ord0) sv.
have [Hu u00 up] := ul.
have gu : G s \in unitmx := basis_unit nde ul.
pose y := invmx (G s) *m q.
have yu j : (invmx (G s) *m qe q e) j 0 = u (lift ord0 j) 0.
  by rewrite -Hu -{1}(padl_of u00) padlE mulKmx // mxE.
have y0 : nonneg y.
  move=> j; rewrite leNgt; apply/negP => yn; have := sg (s, j) gu yn; rewrite /= yu.
  by rewrite ltNge ltW // up // eq_sym neq_lift.
exists (wof s (padl ord0 y)), (zof s (padl ord0 y)).
by apply: (basic_solution (d := d)) y0 _; rewrite mulKVmx.
Qed.
End Nondegenerate.
