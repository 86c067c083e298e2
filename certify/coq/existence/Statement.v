(* SPDX-License-Identifier: Apache-2.0 *)
(* What a reader must trust of existence: the law of static friction in space, and the statements. (Law.v: (15), and
   the plane.) It proves nothing; Theorems.v proves the statements, and Tests.v tests them.

   n contacts. fN i, fX i, fY i: normal force and the two components of the friction force at contact i;
   aN i, aX i, aY i: normal acceleration and the two components of the tangential acceleration.
   The columns f = (fN, fX, fY) and a = (aN, aX, aY) hold 3n numbers; a = A f + b. mu i: coefficient of friction at
   contact i.
   R: the real numbers (`realType`: a complete ordered field; `rcfType`, for polygons: a real closed one). *)
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import reals.
From Stiction.existence Require Import Law.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Laws.
Variable R : rcfType.

Definition length (x y : R) := Num.sqrt (x ^+ 2 + y ^+ 2).

(* Coulomb: friction is at most mu fN;
   where the contact begins to slide it is exactly mu fN, opposed to the acceleration *)
Definition coulomb_law (mu fN fX fY aX aY : R) :=
  length fX fY <= mu * fN /\
  ((aX = 0 /\ aY = 0) \/
   (fX = - (mu * fN) * (aX / length aX aY) /\ fY = - (mu * fN) * (aY / length aX aY))).

(* Baraff's weaker law: (21), friction opposes the acceleration at least partially; (22), the bound, met if a <> 0 *)
Definition baraff_law (mu fN fX fY aX aY : R) :=
  [/\ fX * aX + fY * aY <= 0,
      length fX fY <= mu * fN
    & ~ (aX = 0 /\ aY = 0) -> length fX fY = mu * fN].

Definition solution n (A : 'M[R]_(n + (n + n))) (b : 'cV[R]_(n + (n + n))) (mu : 'I_n -> R)
    (fN fX fY aN aX aY : 'cV[R]_n) :=
  col_mx aN (col_mx aX aY) = A *m col_mx fN (col_mx fX fY) + b /\
  forall i, [/\ normal_conditions (fN i 0) (aN i 0),
                coulomb_law (mu i) (fN i 0) (fX i 0) (fY i 0) (aX i 0) (aY i 0)
              & baraff_law (mu i) (fN i 0) (fX i 0) (fY i 0) (aX i 0) (aY i 0)].

(* Friction in a polygon: P is the convex hull of 0 and of finitely many points (dx k, dy k), the same at every
   contact. The force is in mu fN P, ... *)
Definition in_polygon (K : finType) (dx dy : K -> R) (bound fX fY : R) := exists w : K -> R,
  [/\ forall k, 0 <= w k, \sum_k w k <= bound, fX = \sum_k w k * dx k & fY = \sum_k w k * dy k].
(* ... and there no other force opposes the acceleration more. *)
Definition polygon_law (K : finType) (dx dy : K -> R) (mu fN fX fY aX aY : R) :=
  [/\ in_polygon dx dy (mu * fN) fX fY,
      forall k, fX * aX + fY * aY <= mu * fN * (dx k * aX + dy k * aY)
    & fX * aX + fY * aY <= 0].
Definition polygon_solution n (K : finType) (dx dy : K -> R) (A : 'M[R]_(n + (n + n))) (b : 'cV[R]_(n + (n + n)))
    (mu : 'I_n -> R) (fN fX fY aN aX aY : 'cV[R]_n) :=
  col_mx aN (col_mx aX aY) = A *m col_mx fN (col_mx fX fY) + b /\
  forall i, normal_conditions (fN i 0) (aN i 0) /\
            polygon_law dx dy (mu i) (fN i 0) (fX i 0) (fY i 0) (aX i 0) (aY i 0).
End Laws.

Definition symmetric (R : rcfType) n (A : 'M[R]_n) := A^T = A.
Definition semidefinite (R : rcfType) n (A : 'M[R]_n) := forall f : 'cV[R]_n, 0 <= (f^T *m (A *m f)) 0 0.
Definition definite (R : rcfType) n (A : 'M[R]_n) := forall f : 'cV[R]_n, f != 0 -> 0 < (f^T *m (A *m f)) 0 0.

(* ---- The statements ---- *)

(* A is symmetric positive semidefinite, b in its range. No other hypothesis on mu >= 0, none on n. *)
Definition coulomb_has_a_solution := forall (R : realType) n (A : 'M[R]_(n + (n + n))) (b : 'cV[R]_(n + (n + n))) mu,
  symmetric A -> semidefinite A -> (exists c, b = A *m c) -> (forall i, 0 <= mu i) ->
  exists fN fX fY aN aX aY, solution A b mu fN fX fY aN aX aY.

(* The same under (H): b does no negative work on the forces of the friction cones that accelerate nothing. *)
Definition coulomb_has_a_solution_under_H :=
  forall (R : realType) n (A : 'M[R]_(n + (n + n))) (b : 'cV[R]_(n + (n + n))) mu,
  symmetric A -> semidefinite A -> (forall i, 0 <= mu i) ->
  (forall vN vX vY : 'cV[R]_n, (forall i, 0 <= vN i 0 /\ length (vX i 0) (vY i 0) <= mu i * vN i 0) ->
    let v := col_mx vN (col_mx vX vY) in A *m v = 0 -> 0 <= (v^T *m b) 0 0) ->
  exists fN fX fY aN aX aY, solution A b mu fN fX fY aN aX aY.

(* Inertial bodies (W symmetric positive semidefinite), contact Jacobian J, loads F, and gaps >= 0 that are allowed to
   close: every scene at rest, every step of a time-stepping scheme without penetration. *)
Definition scenes_have_a_solution := forall (R : realType) n d
    (J : 'M[R]_(n + (n + n), d)) (W : 'M[R]_d) (F : 'cV[R]_d) (gap : 'cV[R]_n) mu,
  symmetric W -> semidefinite W -> (forall i, 0 <= gap i 0) -> (forall i, 0 <= mu i) ->
  exists fN fX fY aN aX aY, solution (J *m W *m J^T) (J *m (W *m F) + col_mx gap 0) mu fN fX fY aN aX aY.

(* One constant, for all b in the range of A and all coefficients up to M, bounds the forces of some solution. *)
Definition coulomb_has_a_bounded_solution := forall (R : realType) n (A : 'M[R]_(n + (n + n))) (M : 'I_n -> R),
  symmetric A -> semidefinite A ->
  exists2 C, 0 <= C & forall b mu, (exists c, b = A *m c) -> (forall i, 0 <= mu i <= M i) ->
  exists fN fX fY aN aX aY, solution A b mu fN fX fY aN aX aY /\ \sum_i fN i 0 <= C * \sum_r `|b r 0|.

(* A positive semidefinite, symmetric or not: it is enough that b does no negative work on the solutions of the law
   with b = 0. *)
Definition coulomb_without_symmetry :=
  forall (R : realType) n (A : 'M[R]_(n + (n + n))) (b : 'cV[R]_(n + (n + n))) mu,
  semidefinite A -> (forall i, 0 <= mu i) ->
  (forall vN vX vY rN rX rY : 'cV[R]_n, solution A 0 mu vN vX vY rN rX rY ->
    0 <= ((col_mx vN (col_mx vX vY))^T *m b) 0 0) ->
  exists fN fX fY aN aX aY, solution A b mu fN fX fY aN aX aY.

(* A positive definite, symmetric or not: any b. *)
Definition coulomb_definite := forall (R : realType) n (A : 'M[R]_(n + (n + n))) (b : 'cV[R]_(n + (n + n))) mu,
  definite A -> (forall i, 0 <= mu i) -> exists fN fX fY aN aX aY, solution A b mu fN fX fY aN aX aY.

(* Friction in a polygon, under (H) with the forces of the polygons. *)
Definition polygons_have_a_solution := forall (R : rcfType) n (K : finType) (dx dy : K -> R)
    (A : 'M[R]_(n + (n + n))) (b : 'cV[R]_(n + (n + n))) mu,
  symmetric A -> semidefinite A -> (forall i, 0 <= mu i) ->
  (forall vN vX vY : 'cV[R]_n, (forall i, 0 <= vN i 0 /\ in_polygon dx dy (mu i * vN i 0) (vX i 0) (vY i 0)) ->
    let v := col_mx vN (col_mx vX vY) in A *m v = 0 -> 0 <= (v^T *m b) 0 0) ->
  exists fN fX fY aN aX aY, polygon_solution dx dy A b mu fN fX fY aN aX aY.

(* The plane, over any ordered field, b in range(A). Under (H): driving/Statement.v. *)
Definition plane_has_a_solution := forall (R : realFieldType) n (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) mu,
  A^T = A -> (forall f, 0 <= dotp f (A *m f)) -> (exists c, b = A *m c) -> (forall i, 0 <= mu i) ->
  exists f, Law.solution A b mu f.
