(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that the family of Family.v loops under every policy. *)
From Coq Require Import QArith List Bool.
From Stiction.loops Require Import Statement Loop Laws Symbolic Family FamilyA FamilyB.
Import ListNotations.
Local Open Scope Q_scope.

Lemma all_recur_app n t l m : all_recur n t l = true -> all_recur n t m = true -> all_recur n t (l ++ m) = true.
Proof. unfold all_recur. intros H1 H2. rewrite forallb_app. apply andb_true_intro. split; assumption. Qed.
Lemma all_recur_one n t l : all_recur n t l = true -> forall pol, In pol l ->
  recurs (member_t small t) pol (states_eqb small t) n [] (start (member_t small t)) = true.
Proof. unfold all_recur. intro H. exact (proj1 (forallb_forall _ l) H). Qed.

Theorem every_policy_never_ends pol eta : 0 < eta < small -> never_ends (member eta) pol.
Proof.
  intro H. apply (never_ends_at small eta pol H).
  assert (R : all_recur 14 eta all_policies = true).
  { apply (eq_ind (firstn 768 all_policies ++ skipn 768 all_policies) (fun l => all_recur 14 eta l = true)).
    - apply all_recur_app; [exact (first_half eta) | exact (second_half eta)].
    - apply firstn_skipn. }
  exact (recurs_never_ends _ _ _ (states_eqb_eq small eta) 14
           (all_recur_one 14 eta all_policies R pol (all_policies_complete pol))).
Qed.

(* For every c > K(1) = 3 + 2 sqrt(2) there are problems of condition number below c on which no policy ever ends. *)
Theorem loops_near_K_under_every_policy : every_policy_loops_near_K.
Proof. apply near_K. intros pol eta _. apply every_policy_never_ends. Qed.
