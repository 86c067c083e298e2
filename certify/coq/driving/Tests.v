(* SPDX-License-Identifier: Apache-2.0 *)
(* Tests of driving/Statement.v: the cells of a finished contact are the law, no more and no less; where no contact
   would penetrate, the run ends at once; without (H) there need not be a solution. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.existence Require Import Law.
From Stiction.driving Require Import Rational Statement Local.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Cells.
Variables (R : realFieldType) (m fN fF aN aF : R).
Hypothesis m0 : 0 <= m.
(* (15), (16) hold where and only where the contact is in one of the cells that it has *)
Lemma cells_are_the_law : law m fN fF aN aF <-> exists t, [/\ finished t, ok m t & closed m fN fF aN aF t].
Proof.
split=> [[[n0 a0 na] [le op sl]]|[t [fin okt cl]]]; last first.
  have [le n0] := closedK okt cl; split; split=> //; move: cl; rewrite /closed /on /hval;
  case: t fin okt => //= _ okt /and4P [/andP [/eqP e1 /eqP e2] i1 i2 i3]; rewrite ?e1 ?e2 ?mul0r ?mulr0 //.
  - by apply: mulr_le0_ge0; [rewrite -oppr_ge0 | move/eqP: e2; rewrite subr_eq0 => /eqP <-; rewrite mulr_ge0].
  - move/eqP: e2; rewrite addr_eq0 => /eqP e2; have -> : fF = - (m * fN) by rewrite e2 opprK.
    by rewrite mulrN oppr_le0 mulr_ge0 // mulr_ge0.
  - by rewrite ?normr0 ?mulr0 ?subrr ?mulr0.
  - by move/eqP: e2; rewrite subr_eq0 => /eqP <-; rewrite ger0_norm ?mulr_ge0 // subrr mulr0.
  - move/eqP: e2; rewrite addr_eq0 => /eqP e2; have -> : fF = - (m * fN) by rewrite e2 opprK.
    by rewrite normrN ger0_norm ?mulr_ge0 // subrr mulr0.
  - by rewrite (eqP okt) mul0r normr0 subrr mulr0.
move/eqP: na; rewrite mulf_eq0 => /orP [/eqP fz|/eqP az].
  have fFz : fF = 0 by move: le; rewrite fz mulr0 normr_le0 => /eqP.
  by exists cB; split=> //; rewrite /closed /on /hval /= fz fFz !eqxx a0 lexx.
move: m0; rewrite le_eqVlt => /orP [/eqP mz|mp].
  have fFz : fF = 0 by move: le; rewrite -mz mul0r normr_le0 => /eqP.
  by exists cZ; split; rewrite /= -?mz // /closed /on /hval /= az fFz !eqxx n0 lexx.
case: (ltgtP aF 0) => [neg|pos|z].
- have e : m * fN = `|fF| by move/eqP: sl; rewrite mulf_eq0 (lt_eqF neg) subr_eq0 => /eqP.
  have f0 : 0 <= fF by move: op; rewrite nmulr_rle0.
  by exists cP; split=> //; rewrite /closed /on /hval /= az e (ger0_norm f0) subrr !eqxx n0 oppr_ge0 (ltW neg) lexx.
- have e : m * fN = `|fF| by move/eqP: sl; rewrite mulf_eq0 (gt_eqF pos) subr_eq0 => /eqP.
  have f0 : fF <= 0 by move: op; rewrite pmulr_rle0.
  by exists cM; split=> //; rewrite /closed /on /hval /= az e (ler0_norm f0) addNr !eqxx n0 (ltW pos) lexx.
exists cS; split=> //; rewrite /closed /on /hval /= az z !eqxx subr_ge0 lexx andbT /=.
by move: le; rewrite ler_norml -subr_ge0 opprK addrC => /andP [-> ->].
Qed.
End Cells.

(* no contact would penetrate: f = 0 at once *)
Lemma nothing_to_drive (R : realFieldType) n (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R) :
  (forall j, 0 <= aN (MF A) (beps b) 0 j) -> complete_driving A b mu = Some 0.
Proof.
move=> h; rewrite /complete_driving /first; case: pickP => // i /andP [neg _].
by move: neg; rewrite ltNge h.
Qed.

(* a contact of infinitely heavy bodies that approach one another *)
Lemma hypothesis_needed (R : realFieldType) (mu : 'I_1 -> R) :
  ~ exists g, solution (0 : 'M[R]_(1 + 1)) (col_mx (const_mx (-1)) 0) mu g.
Proof.
move=> [g /(_ 0) [[_ + _] _]]; by rewrite /aN /xN /acc mul0mx add0r col_mxEu mxE ler0N1.
Qed.
