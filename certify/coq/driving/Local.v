(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves, of the cells of one contact (Statement.v), what their facets are, that equations are counted right, and
   that along a ray in a cell no force works against an acceleration. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.driving Require Import Statement.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Notation s0 := (None : slot). Notation s1 := (Some false : slot). Notation s2 := (Some true : slot).

Section Local.
Variables (R : realFieldType) (m fN fF aN aF : R).
Notation ev := (Statement.ev m fN fF aN aF).
Notation lval := (Statement.lval m fN fF aN aF).
Notation on := (Statement.on m fN fF aN aF).
Notation inn := (Statement.inn m fN fF aN aF).
Notation fac := (Statement.fac m fN fF aN aF).
Notation cnt := (Statement.cnt m fN fF aN aF).
Definition need t : nat := if driven t then 1%N else 2%N.

Ltac crunch := rewrite /Statement.fac /Statement.inn /Statement.on /Statement.lval /=
  ?ltr01 ?oner_eq0 ?oppr_gt0 ?oppr_eq0 ?subr_eq0 ?addr_eq0 ?eqxx ?andbT ?andbF.
Lemma fB k : fac cB k = [&& k == s0, fN == 0, fF == 0 & aN == 0].
Proof. by case: k => [[]|]; crunch => //=; rewrite ?andbF //= -!andbA. Qed.
Lemma fZ k : fac cZ k = [&& k == s0, fN == 0, fF == 0 & aN == 0].
Proof. by case: k => [[]|]; crunch => //=; case: (fN == 0); case: (fF == 0); case: (aN == 0). Qed.
Lemma fP0 : fac cP s0 = [&& fN == 0, fF == 0, aN == 0 & aF < 0].
Proof.
crunch; case: (altP (fN =P 0)) => [->|_]; rewrite /= ?andbF // mulr0 [0 == fF]eq_sym.
by case: (fF == 0); case: (aN == 0).
Qed.
Lemma fM0 : fac cM s0 = [&& fN == 0, fF == 0, aN == 0 & 0 < aF].
Proof.
crunch; case: (altP (fN =P 0)) => [->|_]; rewrite /= ?andbF // mulr0 [0 == - fF]eq_sym oppr_eq0.
by case: (fF == 0); case: (aN == 0).
Qed.
Lemma fP1 : fac cP s1 = [&& aN == 0, aF == 0, m * fN == fF & 0 < fN].
Proof. by crunch; case: (aN == 0); case: (aF == 0); case: (m * fN == fF). Qed.
Lemma fM1 : fac cM s1 = [&& aN == 0, aF == 0, m * fN == - fF & 0 < fN].
Proof. by crunch; case: (aN == 0); case: (aF == 0); case: (m * fN == - fF). Qed.
Lemma fP2 : fac cP s2 = false. Proof. by crunch. Qed.
Lemma fM2 : fac cM s2 = false. Proof. by crunch. Qed.
Lemma fS0 : 0 < m -> fac cS s0 = [&& aN == 0, aF == 0, m * fN == fF & 0 < fN].
Proof.
move=> m0; crunch; case: (aN == 0); case: (aF == 0) => //=; case: eqP => //= <-.
by rewrite -mulr2n pmulrn_lgt0 // pmulr_rgt0.
Qed.
Lemma fS1 : 0 < m -> fac cS s1 = [&& aN == 0, aF == 0, m * fN == - fF & 0 < fN].
Proof.
move=> m0; crunch; case: (aN == 0); case: (aF == 0) => //=; case: (altP (m * fN =P - fF)) => //= e.
by rewrite -e -mulr2n pmulrn_lgt0 // pmulr_rgt0.
Qed.
Lemma fS2 : fac cS s2 = false. Proof. by crunch. Qed.
Lemma fN0 : fac dN s0 = [&& fN == 0, fF == 0 & aN < 0].
Proof. by crunch; case: (fN == 0); case: (fF == 0). Qed.
Lemma fN1 : fac dN s1 = [&& fF == 0, aN == 0 & 0 < fN].
Proof. by crunch; case: (fF == 0); case: (aN == 0). Qed.
Lemma fN2 : fac dN s2 = false. Proof. by crunch. Qed.
Lemma fDP0 : 0 < m -> fac dP s0 = [&& fF == 0, aN == 0, 0 < fN & aF < 0].
Proof.
move=> m0; crunch; case: (altP (fF =P 0)) => [->|_]; rewrite /= ?andbF // ?subr0 pmulr_rgt0 //; by case: (aN == 0).
Qed.
Lemma fDM0 : 0 < m -> fac dM s0 = [&& fF == 0, aN == 0, 0 < fN & 0 < aF].
Proof.
move=> m0; crunch; case: (altP (fF =P 0)) => [->|_]; rewrite /= ?andbF // addr0 pmulr_rgt0 //; by case: (aN == 0).
Qed.
Lemma fDP1 : 0 < m -> fac dP s1 = [&& aN == 0, m * fN == fF, 0 < fN & aF < 0].
Proof.
move=> m0; crunch; case: (aN == 0) => //=; case: eqP => //= <-; by rewrite pmulr_rgt0.
Qed.
Lemma fDM1 : 0 < m -> fac dM s1 = [&& aN == 0, m * fN == - fF, 0 < fN & 0 < aF].
Proof.
move=> m0; crunch; case: (aN == 0) => //=; case: (altP (m * fN =P - fF)) => //= e.
by rewrite -oppr_gt0 -e pmulr_rgt0.
Qed.
Lemma fDP2 : fac dP s2 = [&& aN == 0, aF == 0, 0 < fF & fF < m * fN].
Proof. by crunch; rewrite subr_gt0; case: (aN == 0); case: (aF == 0). Qed.
Lemma fDM2 : fac dM s2 = [&& aN == 0, aF == 0, fF < 0 & - fF < m * fN].
Proof. by crunch; rewrite -[fF in _ + fF]opprK subr_gt0; case: (aN == 0); case: (aF == 0). Qed.
Lemma fO k : fac Later k = false.
Proof. by case: k => [[]|]; crunch. Qed.
Lemma iB : inn cB = [&& fN == 0, fF == 0 & 0 < aN].
Proof. by crunch; case: (fN == 0); case: (fF == 0). Qed.
Lemma iS : inn cS = [&& aN == 0, aF == 0, fF < m * fN & - fF < m * fN].
Proof. by crunch; rewrite subr_gt0 -[fF in _ + fF]opprK subr_gt0 -!andbA. Qed.
Lemma iP : inn cP = [&& aN == 0, m * fN == fF, 0 < fN & aF < 0].
Proof. by crunch; rewrite -!andbA. Qed.
Lemma iM : inn cM = [&& aN == 0, m * fN == - fF, 0 < fN & 0 < aF].
Proof. by crunch; rewrite -!andbA. Qed.
Lemma iZ : inn cZ = [&& aN == 0, fF == 0 & 0 < fN].
Proof. by crunch; rewrite -!andbA. Qed.
Lemma iO : inn Later = (fN == 0) && (fF == 0).
Proof. by crunch. Qed.

(* counting *)
Lemma cnt2 : (fN == 0) && (fF == 0) -> cnt = addn (addn 2 (aN == 0)) (aF == 0).
Proof. by rewrite /Statement.cnt => ->. Qed.
Definition zeros t k := lval t k == 0.
Lemma cnt_on t : ok m t -> on t -> (need t + zeros t s0 + zeros t s1 + zeros t s2 <= cnt)%N.
Proof.
rewrite /zeros /Statement.cnt /Statement.on /Statement.lval /need; case: t => /=;
  rewrite ?oner_eq0 ?oppr_eq0 ?subr_eq0 ?addr_eq0 ?eqxx.
- by move=> m0 /andP [-> ->]; case: (aN == 0); case: (aF == 0).
- move=> m0 /andP [-> ->]; case: (altP (m * fN =P fF)) => e1; case: (altP (m * fN =P - fF)) => e2.
  + have fF0 : fF == 0.
      by have := e1; rewrite e2 => /eqP; rewrite eq_sym -addr_eq0 -mulr2n mulrn_eq0.
    have fN0 : fN == 0 by move/eqP: e1; rewrite (eqP fF0) mulf_eq0 (gt_eqF m0).
    by rewrite fN0 fF0.
  + by case: ifP; rewrite ?orbT.
  + by case: ifP; rewrite ?orbT.
  + by rewrite -[X in (_ <= X)%N]addnA; exact: leq_addl.
- move=> m0 /andP [-> /eqP <-]; case: (altP (fN =P 0)) => [->|h]; rewrite ?mulr0 ?eqxx /=; first by case: (aF == 0).
  by rewrite ?orbT; case: (aF == 0).
- move=> m0 /andP [-> /eqP e]; have e' : fF = - (m * fN) by rewrite e opprK.
  rewrite e' oppr_eq0 opprK eqxx ?orbT.
  by case: (altP (fN =P 0)) => [->|h]; rewrite ?mulr0 ?eqxx /=; case: (aF == 0).
- by move=> m0 /andP [-> ->]; rewrite andbT ?orbT; case: (fN == 0); case: (aF == 0).
- by move=> m0; rewrite andbT => ->; rewrite andbT ?orbT; case: (fN == 0); case: (aN == 0); case: (aF == 0).
- move=> m0; rewrite andbT => ->; case: (altP (fF =P 0)) => [->|h].
    rewrite oppr0 ?orbT andbT mulf_eq0 (gt_eqF m0) /=; by case: (fN == 0); case: (aF == 0).
  by rewrite andbF; case: (m * fN == fF); case: (m * fN == - fF); case: (fN == 0); case: (aF == 0).
- move=> m0; rewrite andbT => ->; case: (altP (fF =P 0)) => [->|h].
    rewrite oppr0 ?orbT andbT mulf_eq0 (gt_eqF m0) /=; by case: (fN == 0); case: (aF == 0).
  by rewrite andbF; case: (m * fN == fF); case: (m * fN == - fF); case: (fN == 0); case: (aF == 0).
- by move=> m0 /andP [-> ->]; rewrite !addn0 -addnA leq_addr.
Qed.
End Local.

(* cells are cones, in the friction cone, along which no two accelerations and forces agree *)
Section Cones.
Variables (R : realFieldType) (m : R).
Definition hval (fN fF aN aF : R) t k := if ineq t k is Some c then ev m fN fF aN aF c else 0.
Definition closed (fN fF aN aF : R) t :=
  [&& on m fN fF aN aF t, 0 <= hval fN fF aN aF t s0, 0 <= hval fN fF aN aF t s1 & 0 <= hval fN fF aN aF t s2].
Lemma closedK fN fF aN aF t : ok m t -> closed fN fF aN aF t -> `|fF| <= m * fN /\ 0 <= fN.
Proof.
rewrite /closed /on /hval; case: t => /= m0 /and4P [/andP [/eqP e1 /eqP e2] i1 i2 i3].
- by rewrite e1 e2 normr0 mulr0.
- have i1' : fF <= m * fN by rewrite -subr_ge0.
  have i2' : - (m * fN) <= fF by rewrite -subr_ge0 opprK addrC.
  split; first by rewrite ler_norml i1' i2'.
  by have := le_trans i2' i1'; rewrite -subr_ge0 opprK -mulr2n pmulrn_lge0 // pmulr_rge0.
- by move/eqP: e2; rewrite subr_eq0 => /eqP <-; rewrite ger0_norm // mulr_ge0 // ltW.
- move/eqP: e2; rewrite addr_eq0 => /eqP e2; have -> : fF = - (m * fN) by rewrite e2 opprK.
  by rewrite normrN ger0_norm // mulr_ge0 // ltW.
- by rewrite e2 normr0 (eqP m0) mul0r.
- by rewrite e1 normr0 mulr_ge0.
- have i2' : fF <= m * fN by rewrite -subr_ge0.
  by rewrite ger0_norm // -(pmulr_rge0 _ m0) (le_trans i1).
- have i2' : - fF <= m * fN by rewrite -subr_ge0 opprK.
  have n0 : fF <= 0 by rewrite -oppr_ge0.
  by rewrite ler0_norm // -(pmulr_rge0 _ m0) (le_trans i1).
- by rewrite e1 e2 normr0 mulr0.
Qed.
Lemma mono vN vF gN gF fN fF aN aF t : ok m t -> closed vN vF gN gF t -> closed fN fF aN aF t ->
  vN * aN + vF * aF <= 0.
Proof.
rewrite /closed /on /hval;
  case: t => /= m0 /and4P [/andP [/eqP e1 /eqP e2] i1 i2 i3] /and4P [/andP [/eqP d1 /eqP d2] j1 j2 j3].
- by rewrite e1 e2 !mul0r addr0.
- by rewrite d1 d2 !mulr0 addr0.
- move/eqP: e2; rewrite subr_eq0 => /eqP <-; rewrite d1 mulr0 add0r; apply: mulr_ge0_le0; last by rewrite -oppr_ge0.
  by rewrite mulr_ge0 // ltW.
- move/eqP: e2; rewrite addr_eq0 => /eqP e2; have -> : vF = - (m * vN) by rewrite e2 opprK.
  by rewrite d1 mulr0 add0r mulNr oppr_le0 !mulr_ge0 // ltW.
- by rewrite d1 e2 mulr0 mul0r addr0.
- by rewrite e1 mul0r addr0; apply: mulr_ge0_le0 => //; rewrite -oppr_ge0.
- by rewrite d1 mulr0 add0r; apply: mulr_ge0_le0 => //; rewrite -oppr_ge0.
- by rewrite d1 mulr0 add0r; apply: mulr_le0_ge0 => //; rewrite -oppr_ge0.
- by rewrite e1 e2 !mul0r addr0.
Qed.
End Cones.
