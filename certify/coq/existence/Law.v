(* SPDX-License-Identifier: Apache-2.0 *)
(* What a reader must trust of the plane, for existence and for complete driving alike: the law of static friction,
   and what a solution is; and (15), which is the same in space. It proves nothing; Tests.v tests it.

   n contacts. f and a hold 2n numbers, all normal components first, then all friction components; a = A f + b.
   mu i: coefficient of friction at contact i. R: any ordered field. *)
From mathcomp Require Import all_ssreflect all_algebra.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Law.
Variable R : realFieldType.

(* x.y *)
Definition dotp n (x y : 'cV[R]_n) := \sum_i x i 0 * y i 0.

(* (15) of the paper: contacts push and do not sink in; a contact that opens carries no force *)
Definition normal_conditions (fN aN : R) := [/\ 0 <= fN, 0 <= aN & fN * aN = 0].
(* (15) and (16) at one contact of the plane *)
Definition law (m fN fF aN aF : R) :=
  normal_conditions fN aN /\ [/\ `|fF| <= m * fN, aF * fF <= 0 & aF * (m * fN - `|fF|) = 0].

Variables (n : nat) (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R).
Notation vec := 'cV[R]_(n + n).
Definition acc (f : vec) := A *m f + b.
Definition xN (f : vec) j := f (lshift n j) 0.            (* the normal component at contact j *)
Definition xF (f : vec) j := f (rshift n j) 0.            (* the friction component *)
Definition aN f j := xN (acc f) j.
Definition aF f j := xF (acc f) j.

Definition solution (f : vec) := forall j, law (mu j) (xN f j) (xF f j) (aN f j) (aF f j).

(* K: the forces that friction allows *)
Definition in_cones (v : vec) := forall j, `|xF v j| <= mu j * xN v j /\ 0 <= xN v j.
(* (H): b does no negative work on forces that accelerate nothing.
   It holds where b is in range(A), or in range(A) + K*. *)
Definition H_holds := forall v, in_cones v -> A *m v = 0 -> 0 <= dotp v b.
End Law.
