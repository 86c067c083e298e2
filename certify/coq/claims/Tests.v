(* SPDX-License-Identifier: Apache-2.0 *)
(* Tests of claims/Statement.v: its law of a static contact in the plane, in squared lengths, is (15), (16); witnesses
   of every claim are taken, and altered ones refused. *)
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

(* what is no problem *)
Example ill_formed : check_well_formed (Problem 2 [:: Static (-(1))] [:: [:: 1; 0]; [:: 0; 1]] [:: 1; 0]) = false /\
  check_well_formed (Problem 2 [:: Static 1] [:: [:: 1]; [:: 0; 1]] [:: 1; 0]) = false /\
  check_well_formed (Problem 2 [:: Sliding 1 [:: 2]] [:: [:: 1; 0]; [:: 0; 1]] [:: 1; 0]) = false /\
  check_well_formed (Problem 4 [:: Frictionless] [:: [:: 1]] [:: 1]) = false.
Proof. by vm_compute. Qed.
