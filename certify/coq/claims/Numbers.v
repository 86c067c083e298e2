(* SPDX-License-Identifier: Apache-2.0 *)
(* The rationals of Coq in any ordered field R. To trust: `of_Z`, `of_Q`. It proves that they keep +, * and <=. *)
From Coq Require Import QArith Qabs ZArith Arith Lia.
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ssrZ.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.
Delimit Scope Z_scope with coq_Z. Delimit Scope Q_scope with coq_Q.   (* mathcomp has taken %Z and %Q *)

Section Numbers.
Variable R : realFieldType.
Definition of_Z (z : Z) : R := (int_of_Z z)%:~R.
Definition of_Q (q : Q) : R := of_Z (Qnum q) / of_Z (Zpos (Qden q)).

Lemma of_ZD x y : of_Z (x + y)%coq_Z = of_Z x + of_Z y.
Proof. by rewrite /of_Z -intrD -(rmorphD ZInstances.int_of_Z_rmorphism). Qed.
Lemma of_ZM x y : of_Z (x * y)%coq_Z = of_Z x * of_Z y.
Proof. by rewrite /of_Z -intrM -(rmorphM ZInstances.int_of_Z_rmorphism). Qed.
Lemma of_ZN x : of_Z (- x)%coq_Z = - of_Z x.
Proof. by rewrite /of_Z -mulrNz -(rmorphN ZInstances.int_of_Z_rmorphism). Qed.
Lemma of_Z_ge0 x : (0 <= of_Z x) = Z.leb 0 x.
Proof. by rewrite /of_Z ler0z; case: x. Qed.
Lemma of_Z_le x y : (of_Z x <= of_Z y) = Z.leb x y.
Proof.
by rewrite -subr_ge0 -of_ZN -of_ZD of_Z_ge0; apply/idP/idP => /Z.leb_le h; apply/Z.leb_le; lia.
Qed.
Lemma of_pos_gt0 p : 0 < of_Z (Zpos p).
Proof.
rewrite lt_neqAle of_Z_ge0 andbT eq_sym /of_Z intr_eq0 /=.
by have := Pos2Nat.is_pos p; case: Pos.to_nat => //; lia.
Qed.
Lemma of_pos_neq0 p : of_Z (Zpos p) != 0.
Proof. by rewrite gt_eqF // of_pos_gt0. Qed.

Lemma of_Q_le x y : of_Q x <= of_Q y <-> (x <= y)%coq_Q.
Proof.
rewrite /of_Q ler_pdivr_mulr ?of_pos_gt0 // mulrAC ler_pdivl_mulr ?of_pos_gt0 // -!of_ZM of_Z_le /Qle.
exact: Z.leb_le.
Qed.
Lemma of_Q_eq x y : of_Q x = of_Q y <-> (x == y)%coq_Q.
Proof.
split=> [e|e]; first by apply: Qle_antisym; apply/of_Q_le; rewrite e.
by apply/eqP; rewrite eq_le; apply/andP; split; apply/of_Q_le; rewrite e; exact: Qle_refl.
Qed.
Lemma of_QD x y : of_Q (x + y)%coq_Q = of_Q x + of_Q y.
Proof. by rewrite /of_Q /= addf_div ?of_pos_neq0 // of_ZD Pos2Z.inj_mul !of_ZM. Qed.
Lemma of_QM x y : of_Q (x * y)%coq_Q = of_Q x * of_Q y.
Proof. by rewrite /of_Q /= mulf_div Pos2Z.inj_mul !of_ZM. Qed.
Lemma of_QN x : of_Q (- x)%coq_Q = - of_Q x.
Proof. by rewrite /of_Q /= of_ZN mulNr. Qed.
Lemma of_Q0 : of_Q 0%coq_Q = 0.
Proof. by rewrite /of_Q /of_Z /= mul0r. Qed.
Lemma of_Q_abs x : of_Q (Qabs x) = `|of_Q x|.
Proof.
apply: (Qabs_case x (fun y => of_Q y = _)) => /of_Q_le; rewrite of_Q0 => h; first by rewrite ger0_norm.
by rewrite of_QN ler0_norm.
Qed.
End Numbers.
