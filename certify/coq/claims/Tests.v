(* SPDX-License-Identifier: Apache-2.0 *)
(* Tests of claims/Statement.v: its law of a static contact in the plane, in squared lengths, is (15), (16), and that up
   to k = 1 in space Coulomb's; witnesses of every claim are taken, and altered ones refused. *)
From Coq Require Import QArith.
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Stiction.existence Require Law.
From Stiction.claims Require Import Numbers Statement Claims.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.

Section Plane.
Local Open Scope ring_scope.
Variables (R : realFieldType) (mu : Q) (fN fF aN aF : R).
Hypothesis mu0 : 0 <= of_Q R mu.
Lemma planar_law : law (Static mu) fN [:: fF] aN [:: aF] <-> Law.law (of_Q R mu) fN fF aN aF.
Proof.
rewrite /Law.law /Law.normal_conditions /= !addr0; set limit := of_Q R mu * fN.
have pos : 0 <= fN -> 0 <= limit by exact: mulr_ge0.
move: limit pos => limit pos.
have squares : 0 <= fN -> (fF * fF <= limit * limit <-> `|fF| <= limit).
  move=> f0; have l0 := pos f0.
  have e : fF * fF = `|fF| * `|fF| by rewrite -normrM ger0_norm // -expr2 sqr_ge0.
  split; first by rewrite e => /(le_of_squares l0).
  by move=> h; rewrite e; apply: ler_pmul.
have equal : 0 <= fN -> (fF * fF = limit * limit <-> limit - `|fF| = 0).
  move=> f0; have l0 := pos f0.
  split=> [h|/eqP]; last by rewrite subr_eq0 => /eqP ->; rewrite -normrM ger0_norm // -expr2 sqr_ge0.
  apply/eqP; rewrite subr_eq0 eq_sym; have := congr1 Num.norm h; rewrite !normrM (ger0_norm l0) => /eqP.
  by rewrite -!expr2 eqr_expn2.
have zero : is_zero [:: aF] <-> aF = 0.
  by split=> [z|-> u]; [apply: z; rewrite mem_head | rewrite inE => /eqP].
split=> [[[h1 h2 h3] h4 h5 h6]|[[h1 h2 h3] [h4 h5 h6]]].
  split; first by split.
  split; [by apply/squares | by rewrite mulrC |].
  by case: h6 => [/zero ->|/(equal h1) ->]; rewrite ?mul0r ?mulr0.
split; [by split | by apply/squares | by rewrite mulrC |].
move/eqP: h6; rewrite mulf_eq0 => /orP [/eqP e|/eqP e]; [by left; apply/zero | by right; apply/(equal h1)].
Qed.
End Plane.

Section Space.
Local Open Scope ring_scope.
Variables (R : realFieldType) (mu : Q) (fN fx fy aN ax ay : R).
Let limit := of_Q R mu * fN.
(* Up to k = 1 it is Coulomb's law: friction is opposite to the acceleration, and at its limit. *)
Lemma coulomb_law : coulomb_up_to 1 (Static mu) fN [:: fx; fy] aN [:: ax; ay] <->
  [/\ does_not_sink fN aN, fx * fx + fy * fy <= limit * limit &
      ax = 0 /\ ay = 0 \/
      (exists t, [/\ 0 <= t, fx = - (t * ax) & fy = - (t * ay)]) /\ fx * fx + fy * fy = limit * limit].
Proof.
have one : of_Q R 1 = 1 by rewrite /of_Q /of_Z /= divr1.
rewrite /= one mul1r !addr0 -/limit.
set power := fx * ax + fy * ay; set a2 := ax * ax + ay * ay; set f2 := fx * fx + fy * fy; set l2 := limit * limit.
have a0 : 0 <= a2 by rewrite addr_ge0 // -expr2 sqr_ge0.
have zero : a2 = 0 -> ax = 0 /\ ay = 0.
  move/eqP; rewrite paddr_eq0 -?expr2 ?sqr_ge0 // !sqrf_eq0.
  by case/andP => /eqP -> /eqP ->.
have lagrange : f2 * a2 = power * power + (fx * ay - fy * ax) * (fx * ay - fy * ax).
  by rewrite /f2 /a2 /power; ring.
split=> [[sink inside opposed most]|[sink inside h]].
- split=> //; have [/zero e|an] := eqVneq a2 0; [by left | right].
  have ap : 0 < a2 by rewrite lt_neqAle eq_sym an.
  have cross0 : (fx * ay - fy * ax) * (fx * ay - fy * ax) <= 0.
    rewrite -(ler_add2l (power * power)) -lagrange addr0.
    by apply: le_trans most; rewrite ler_wpmul2r.
  have cross : fx * ay - fy * ax = 0.
    by apply/eqP; rewrite -sqrf_eq0 eq_le expr2 cross0 /= -expr2 sqr_ge0.
  split.
    exists (- (power / a2)); split; first by rewrite oppr_ge0 pmulr_lle0 // invr_gt0.
      apply: (mulIf an); rewrite [_ * ax]mulNr opprK mulrAC divfK //.
      have -> : fx * a2 = power * ax + ay * (fx * ay - fy * ax) by rewrite /a2 /power; ring.
      by rewrite cross mulr0 addr0.
    apply: (mulIf an); rewrite [_ * ay]mulNr opprK mulrAC divfK //.
    have -> : fy * a2 = power * ay - ax * (fx * ay - fy * ax) by rewrite /a2 /power; ring.
    by rewrite cross mulr0 subr0.
  apply/eqP; rewrite eq_le inside /= -(ler_pmul2r ap).
  by apply: (le_trans most); rewrite lagrange cross mulr0 addr0.
- case: h => [[ex ey]|[[t [t0 ex ey]] e]].
    have p : power = 0 by rewrite /power ex ey !mulr0 addr0.
    have a : a2 = 0 by rewrite /a2 ex ey !mulr0 addr0.
    by split=> //; rewrite p ?a ?mulr0.
  have p : power = - (t * a2) by rewrite /power /a2 ex ey; ring.
  split=> //; first by rewrite p oppr_le0 mulr_ge0.
  have cross : fx * ay - fy * ax = 0 by rewrite ex ey; ring.
  by rewrite -e lagrange cross mulr0 addr0.
Qed.
End Space.

Local Open Scope Q_scope.

(* corpus/two-contact-cycle.json *)
Definition two := Problem 2 [:: Static 1; Static 1]
  [:: [:: 7; -(2); -(6); 0]; [:: -(2); 9; -(1); -(7)]; [:: -(6); -(1); 7; 3]; [:: 0; -(7); 3; 7]]
  [:: 2; -(1); -(2); 2].
Example solved : check_solution two [:: 1; -(6 # 7); 25 # 14; -(25 # 14)] = true.
Proof. by vm_compute. Qed.
Example not_solved : check_solution two [:: 1; -(6 # 7); 25 # 14; -(24 # 14)] = false /\
  check_solution two [:: 1; -(6 # 7); 25 # 14] = false /\ check_solution two [:: 0; 0; 0; 0] = false.
Proof. by vm_compute. Qed.
Definition L := [:: [:: 1; 0; 0; 0]; [:: -(2 # 7); 1; 0; 0]; [:: -(6 # 7); -(19 # 59); 1; 0];
  [:: 0; -(49 # 59); 22 # 29; 1]].
Example semidefinite : check_psd two L [:: 7; 59 # 7; 58 # 59; 18 # 29] = true.
Proof. by vm_compute. Qed.
Example not_semidefinite : check_psd two L [:: 7; 59 # 7; 58 # 59; 17 # 29] = false /\
  check_psd (Problem 2 [:: Static 1] [:: [:: -(1); 0]; [:: 0; 1]] [:: 0; 0])
    [:: [:: 1; 0]; [:: 0; 1]] [:: -(1); 1] = false.
Proof. by vm_compute. Qed.

(* corpus/no-solution-scripted-wedge.json *)
Definition wedge := Problem 2 [:: Static 1] [:: [:: 1; -(1)]; [:: -(1); 1]] [:: -(1); 0].
Definition prefixes := [:: ([:: Break], [:: 1; 0]); ([:: Stick], [:: 1; 1]); ([:: SlipPlus], [:: 1; 1]);
  ([:: SlipMinus], [:: 1; 0])].
Example unsolvable : check_no_solution wedge prefixes = true.
Proof. by vm_compute. Qed.
Example solvable : check_no_solution wedge (behead prefixes) = false /\
  check_no_solution wedge (([:: Break], [:: 0; 1]) :: behead prefixes) = false /\
  check_no_solution two prefixes = false /\ check_no_solution two [:: ([::], [:: 1; 0; 0; 0])] = false.
Proof. by vm_compute. Qed.

(* (H), in the plane and in space *)
Definition resting d := Problem d [:: Static (1 # 2); Frictionless]
  (nseq d.+1 (nseq d.+1 0)) (3 :: (if d is 3%nat then [:: 1; 1] else [:: -(1)]) ++ [:: 2]).
Example hypothesis : check_H (resting 2) (nseq 3 0) = true /\ check_H (resting 3) (nseq 4 0) = true.
Proof. by vm_compute. Qed.
Example no_hypothesis : check_H wedge [:: 0; 0] = false /\ check_H two [:: 0; 0; 0; 0] = false /\
  check_H (Problem 2 [:: Sliding 0 [:: 1]] [:: [:: 1; 0]; [:: 0; 1]] [:: 1; 0]) [:: 0; 0] = false.
Proof. by vm_compute. Qed.

(* in space *)
Definition pushed b := Problem 3 [:: Static (1 # 2)] [:: [:: 1; 0; 0]; [:: 0; 1; 0]; [:: 0; 0; 1]] b.
Example slips : check_coulomb (pushed [:: -(1); -(3); -(4)]) 1 [:: 1; 3 # 10; 4 # 10] = true /\
  check_coulomb (pushed [:: -(1); -(3); -(4)]) (1 # 2) [:: 1; 1 # 2; 0] = true /\
  check_coulomb (pushed [:: -(1); 1 # 2; 0]) 1 [:: 1; -(1 # 2); 0] = true.
Proof. by vm_compute. Qed.
Example no_coulomb : check_coulomb (pushed [:: -(1); -(3); -(4)]) 1 [:: 1; 1 # 2; 0] = false /\
  check_coulomb (pushed [:: -(1); -(3); -(4)]) 1 [:: 1; 3 # 10; 5 # 10] = false /\
  check_coulomb (pushed [:: -(1); 3; 4]) 1 [:: 1; 3 # 10; 4 # 10] = false /\
  check_coulomb (pushed [:: -(1); -(3); -(4)]) 0 [:: 1; 3 # 10; 4 # 10] = false /\
  check_coulomb (pushed [:: -(1); -(3); -(4)]) 2 [:: 1; 3 # 10; 4 # 10] = false /\
  check_coulomb two 1 [:: 1; -(6 # 7); 25 # 14; -(25 # 14)] = false.
Proof. by vm_compute. Qed.

(* what is no problem *)
Example ill_formed : check_well_formed (Problem 2 [:: Static (-(1))] [:: [:: 1; 0]; [:: 0; 1]] [:: 1; 0]) = false /\
  check_well_formed (Problem 2 [:: Static 1] [:: [:: 1]; [:: 0; 1]] [:: 1; 0]) = false /\
  check_well_formed (Problem 2 [:: Sliding 1 [:: 2]] [:: [:: 1; 0]; [:: 0; 1]] [:: 1; 0]) = false /\
  check_well_formed (Problem 4 [:: Frictionless] [:: [:: 1]] [:: 1]) = false.
Proof. by vm_compute. Qed.
