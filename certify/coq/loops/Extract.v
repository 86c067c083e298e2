(* SPDX-License-Identifier: Apache-2.0 *)
(* Writes the Coq function as an OCaml program, with no realizer: numbers, lists and nat are those of Coq.
   Proves nothing. *)
From Coq Require Import QArith List.
From Stiction.loops Require Import Statement.
From Coq Require Extraction.
Extraction Language OCaml.
Extraction "algorithm.ml" rationals next_with_pivots start all_policies Problem.
