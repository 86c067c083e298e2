(* SPDX-License-Identifier: Apache-2.0 *)
(* Tests of Statement.v: what ends, ends; what readings.md says of another problem, the Coq function says, too; wrong
   starts and periods are refused. *)
From Coq Require Import QArith ZArith List Bool Arith.
From Stiction.loops Require Import Statement Loop Laws.
Import ListNotations.
Local Open Scope Q_scope.

Fixpoint ending_within (p : problem rationals) pol n (x : state rationals) : option ending :=
  match n with O => None | S n =>
    match next p pol x with Going y => ending_within p pol n y | End e => Some e end end.
Definition ends_as e p pol := match ending_within p pol 30 (start p), e with
  | Some Solved, Solved | Some Singular, Singular | Some Ray, Ray => true | _, _ => false end.
(* A state stands again within n drives. *)
Fixpoint repeats (p : problem rationals) pol n (seen : list (state rationals)) (x : state rationals) : bool :=
  if existsb (state_eqb x) seen then true else
  match n with O => false | S n =>
    match next p pol x with Going y => repeats p pol n (x :: seen) y | End _ => false end end.

(* One contact: two drives, then solved (frontiers.md, 1). *)
Definition one : problem rationals := Problem [[2; 1]; [1; 2]] [-(3); 1] [1 # 2].
Example one_ends :
  drives one paper 2 = Going (State (Point [2; -(1)] [0; 1] [C; NCm]) None None) /\ drives one paper 3 = End Solved.
Proof. vm_compute. auto. Qed.
Example one_is_solved : forallb (ends_as Solved one) all_policies = true.
Proof. vm_compute. reflexivity. Qed.

(* corpus/two-contact-cycle.json: 1320 policies cycle, 216 solve it;
   among those with file=yes, drop=variable 168 and 216 (solver/published/readings.md). *)
Definition two : problem rationals := Problem
  [[7; -(2); -(6); 0]; [-(2); 9; -(1); -(7)]; [-(6); -(1); 7; 3]; [0; -(7); 3; 7]] [2; -(1); -(2); 2] [1; 1].
Definition solving := Eval vm_compute in filter (ends_as Solved two) all_policies.
Example two_solved : length solving = 216%nat.
Proof. reflexivity. Qed.
Example two_solved_where : forallb
    (fun pol => match file pol, drop pol with filed_at_scan, drop_variable => true | _, _ => false end)
  solving = true.
Proof. vm_compute. reflexivity. Qed.
Example two_paper : loops two paper (3, 4)%nat = true.      (* the state after 3 drives stands again after 4 more *)
Proof. vm_compute. reflexivity. Qed.
Example two_rest : length (filter (fun pol => repeats two pol 25 [] (start two)) all_policies) = 1320%nat.
Proof. vm_compute. reflexivity. Qed.
(* Wrong entries of a table are refused. *)
Example wrong :
  loops two paper (3, 5)%nat = false /\ loops two paper (2, 4)%nat = false /\ loops two paper (4, 4)%nat = false.
Proof. vm_compute. auto. Qed.
