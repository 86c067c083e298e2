(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that one check by computation is right: of the witness of a `counterexample`, A = L D L', forces, and a start
   and a period for each policy (certify/certificates.md). *)
From Coq Require Import QArith List Bool Arith.
From Stiction.loops Require Import Statement Loop Laws.
Import ListNotations.

Definition check_counterexample (p : problem rationals) L D forces policies table : bool :=
  check_well_formed p && check_symmetric (length (b p)) (A p) && check_definite (length (b p)) (A p) L D &&
  obeys p forces && table_holds p policies table.

Section Sound.

Variables (p : problem rationals) (L : list (list Q)) (D forces : list Q) (policies : list policy)
  (table : list (nat * nat)).
Hypothesis H : check_counterexample p L D forces policies table = true.

Theorem policies_loop : loops_under_policies policies (length (b p)) p.
Proof.
  unfold check_counterexample in H. rewrite !andb_true_iff in H. destruct H as [[[[W S] P] F] T].
  apply check_well_formed_sound in W. split; [exact W|].
  split; [exact (check_symmetric_sound _ _ S)|]. split; [exact (check_definite_sound _ _ L D P)|].
  split; [exists forces; now apply (obeys_iff_solution _ _ W)|].
  intros pol I k. destruct (table_never_ends _ _ _ T pol I k) as [x Hx]. exists x. split; [exact Hx|].
  intro E. apply (obeys_iff_solution _ _ W) in E. pose proof (table_never_obeys _ _ _ T pol I k x Hx). congruence.
Qed.

(* The first state at the top of the main loop that recurs, and after how many drives. *)
Theorem policies_cycle : forall pol s period, In (pol, (s, period)) (combine policies table) -> cycles p pol s period.
Proof.
  unfold check_counterexample in H. rewrite !andb_true_iff in H. exact (table_cycles _ _ _ (proj2 H)).
Qed.

End Sound.

Theorem every_policy_loops p L D forces table :
  check_counterexample p L D forces all_policies table = true -> loops_under_every_policy (length (b p)) p.
Proof.
  intro H. destruct (policies_loop _ _ _ _ _ _ H) as [W [S [P [F E]]]]. repeat (split; [assumption|]).
  intro pol. exact (E pol (all_policies_complete pol)).
Qed.
