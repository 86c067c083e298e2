(* SPDX-License-Identifier: Apache-2.0 *)
(* The field R(X) of rational functions over an ordered field R, ordered with X infinitely large: x < y where the
   leading coefficients of y - x have a positive product. It proves that this is an ordered field. *)
From mathcomp Require Import all_ssreflect all_algebra.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory FracField.
Local Open Scope ring_scope.
Local Open Scope quotient_scope.

Definition ratfun (R : realFieldType) := {fraction {poly R}}.
Section Structures.
Variable R : realFieldType.
Canonical ratfun_eqType := Eval hnf in [eqType of ratfun R].
Canonical ratfun_choiceType := Eval hnf in [choiceType of ratfun R].
Canonical ratfun_zmodType := Eval hnf in [zmodType of ratfun R].
Canonical ratfun_ringType := Eval hnf in [ringType of ratfun R].
Canonical ratfun_comRingType := Eval hnf in [comRingType of ratfun R].
Canonical ratfun_unitRingType := Eval hnf in [unitRingType of ratfun R].
Canonical ratfun_comUnitRingType := Eval hnf in [comUnitRingType of ratfun R].
Canonical ratfun_idomainType := Eval hnf in [idomainType of ratfun R].
Canonical ratfun_fieldType := Eval hnf in [fieldType of ratfun R].
Notation F := (ratfun R).
Definition pf : {poly R} -> F := @tofrac [idomainType of {poly R}].
Canonical pf_additive := [additive of pf].
Canonical pf_rmorphism := [rmorphism of pf].
Definition num (x : F) : {poly R} := \n_(repr x).
Definition den (x : F) : {poly R} := \d_(repr x).
Lemma den_neq0 x : den x != 0. Proof. exact: denom_ratioP. Qed.
Lemma pf_inj : injective pf. Proof. by move=> x y /eqP; rewrite tofrac_eq => /eqP. Qed.
Lemma pf_eq0 p : (pf p == 0) = (p == 0). Proof. exact: tofrac_eq0. Qed.
Lemma fracE x : x = pf (num x) / pf (den x).
Proof.
rewrite /pf; unlock tofrac; rewrite -[X in _ = _ * X]pi_inv -[RHS]pi_mul -[LHS]reprK.
apply/eqmodP => /=; rewrite equivfE /mulf /invf !numden_Ratio ?oner_eq0 ?mulf_neq0 ?den_neq0 ?oner_eq0 // mul1r mulr1.
by rewrite /num /den mulrC.
Qed.
(* sign: of the leading coefficients *)
Definition sgf (x : F) : R := lead_coef (num x) * lead_coef (den x).
Lemma cross x p q : q != 0 -> x = pf p / pf q -> num x * q = p * den x.
Proof.
move=> q0 e; apply: pf_inj; rewrite !rmorphM /=.
have := fracE x; rewrite {1}e => /eqP; rewrite eqr_div ?pf_eq0 ?den_neq0 // => /eqP ->.
by [].
Qed.
Lemma sgfE x p q : q != 0 -> x = pf p / pf q -> (0 < sgf x) = (0 < lead_coef p * lead_coef q).
Proof.
move=> q0 e; have := congr1 lead_coef (cross q0 e); rewrite !lead_coefM => h.
have l1 : lead_coef q != 0 by rewrite lead_coef_eq0.
have l2 : lead_coef (den x) != 0 by rewrite lead_coef_eq0 den_neq0.
rewrite -(pmulr_lgt0 _ (_ : 0 < lead_coef q ^+ 2)) ?exprn_even_gt0 //
  -[in RHS](pmulr_lgt0 _ (_ : 0 < lead_coef (den x) ^+ 2)) ?exprn_even_gt0 //.
by rewrite /sgf; congr (0 < _); rewrite !expr2 mulrACA h [RHS]mulrACA [lead_coef (den x) * lead_coef q]mulrC.
Qed.
Definition ltf (x y : F) := 0 < sgf (y - x).
Definition lef (x y : F) := (x == y) || ltf x y.
Definition normf (x : F) := if ltf x 0 then - x else x.
Lemma lead_pos_add (p q : {poly R}) : 0 < lead_coef p -> 0 < lead_coef q -> 0 < lead_coef (p + q).
Proof.
move=> hp hq; case: (ltngtP (size p) (size q)) => h.
- by rewrite addrC lead_coefDl.
- by rewrite lead_coefDl.
have c : 0 < (p + q)`_(size p).-1.
  by rewrite coefD -/(lead_coef p) [in q`__]h -/(lead_coef q) addr_gt0.
suff e : size (p + q) = size p by rewrite lead_coefE e.
apply/eqP; rewrite eqn_leq; apply/andP; split.
  by apply: leq_trans (size_add _ _) _; rewrite h maxnn.
have p0 : (0 < size p)%N by rewrite size_poly_gt0 -lead_coef_eq0 gt_eqF.
rewrite -(prednK p0) ltnNge; apply/negP => /(leq_sizeP) /(_ _ (leqnn _)) e; by rewrite e ltxx in c.
Qed.
Lemma posf x : (0 < sgf x) -> exists p q, [/\ 0 < lead_coef p, 0 < lead_coef q & x = pf p / pf q].
Proof.
move=> h; case: (ltrP 0 (lead_coef (den x))) => d0.
  by exists (num x), (den x); split=> //; [move: h; rewrite /sgf pmulr_lgt0 | exact: fracE].
have dn : lead_coef (den x) < 0 by rewrite lt_neqAle d0 lead_coef_eq0 den_neq0.
exists (- num x), (- den x); split.
- by rewrite lead_coefN oppr_gt0; move: h; rewrite /sgf nmulr_lgt0.
- by rewrite lead_coefN oppr_gt0.
- by rewrite !rmorphN /= invrN mulrNN; exact: fracE.
Qed.
Lemma neq0_lead (p : {poly R}) : 0 < lead_coef p -> p != 0.
Proof. by move=> h; rewrite -lead_coef_eq0 gt_eqF. Qed.
Lemma sgf_gt0 p q : 0 < lead_coef p -> 0 < lead_coef q -> 0 < sgf (pf p / pf q).
Proof. by move=> hp hq; rewrite (sgfE (neq0_lead hq) erefl) mulr_gt0. Qed.
Lemma sgfN x : sgf (- x) < 0 = (0 < sgf x) /\ (0 < sgf (- x)) = (sgf x < 0).
Proof.
have e y : (0 < sgf (- y)) = (sgf y < 0).
  rewrite (sgfE (den_neq0 y) (p := - num y)); first by rewrite lead_coefN mulNr oppr_gt0.
  by rewrite rmorphN mulNr -fracE.
by split=> //; rewrite -e opprK.
Qed.
Lemma lt0_add x y : ltf 0 x -> ltf 0 y -> ltf 0 (x + y).
Proof.
rewrite /ltf !subr0 => /posf [p [q [p0 q0 ->]]] /posf [r [s [r0 t0 ->]]].
rewrite addf_div ?pf_eq0 ?neq0_lead // -!rmorphM -rmorphD; apply: sgf_gt0.
  by apply: lead_pos_add; rewrite lead_coefM mulr_gt0.
by rewrite lead_coefM mulr_gt0.
Qed.
Lemma lt0_mul x y : ltf 0 x -> ltf 0 y -> ltf 0 (x * y).
Proof.
rewrite /ltf !subr0 => /posf [p [q [p0 q0 ->]]] /posf [r [s [r0 t0 ->]]].
rewrite mulf_div -!rmorphM; apply: sgf_gt0; by rewrite lead_coefM mulr_gt0.
Qed.
Lemma lt0_ngt0 x : ltf 0 x -> ~~ ltf x 0.
Proof. by rewrite /ltf subr0 sub0r (proj2 (sgfN x)) => h; rewrite -leNgt ltW. Qed.
Lemma sub_gt0 x y : ltf 0 (y - x) = ltf x y. Proof. by rewrite /ltf subr0. Qed.
Lemma lt0_total x : x != 0 -> ltf 0 x || ltf x 0.
Proof.
move=> x0; rewrite /ltf subr0 sub0r (proj2 (sgfN x)) orbC -neq_lt mulf_neq0 // lead_coef_eq0 ?den_neq0 //.
by apply: contra x0 => /eqP e; rewrite (fracE x) e rmorph0 mul0r.
Qed.
Lemma normfN x : normf (- x) = normf x.
Proof.
case: (altP (x =P 0)) => [->|x0]; first by rewrite oppr0.
rewrite /normf; have -> : ltf (- x) 0 = ltf 0 x by rewrite /ltf sub0r opprK subr0.
have := lt0_total x0; case: (boolP (ltf 0 x)) => [h _|_ /= ->] //; by rewrite opprK (negbTE (lt0_ngt0 h)).
Qed.
Lemma ge0_normf x : lef 0 x -> normf x = x.
Proof.
case/orP => [/eqP <-|h]; rewrite /normf; last by rewrite (negbTE (lt0_ngt0 h)).
by rewrite oppr0 if_same.
Qed.
Definition ratfunMixin : realLtMixin [idomainType of F] :=
  RealLtMixin lt0_add lt0_mul lt0_ngt0 sub_gt0 lt0_total normfN ge0_normf (fun _ _ => erefl).
Canonical ratfun_porderType := POrderType ring_display F ratfunMixin.
Canonical ratfun_latticeType := LatticeType F ratfunMixin.
Canonical ratfun_distrLatticeType := DistrLatticeType F ratfunMixin.
Canonical ratfun_orderType := OrderType F ratfunMixin.
Canonical ratfun_numDomainType := NumDomainType F ratfunMixin.
Canonical ratfun_normedZmodType := NormedZmodType F F ratfunMixin.
Canonical ratfun_numFieldType := Eval hnf in [numFieldType of F].
Canonical ratfun_realDomainType := Eval hnf in [realDomainType of F].
Canonical ratfun_realFieldType := Eval hnf in [realFieldType of F].
Lemma ratfun_gt0 (x : F) : (0 < x) = (0 < sgf x).
Proof. by change ((0 < x) = (0 < sgf x)) with (ltf 0 x = (0 < sgf x)); rewrite /ltf subr0. Qed.
End Structures.

(* R in R(X), and X, which is larger than every element of R *)
Section Elements.
Variable R : realFieldType.
Definition emb (c : R) : ratfun R := pf c%:P.
Definition X : ratfun R := pf 'X.
End Elements.
