(* SPDX-License-Identifier: Apache-2.0 *)
(* What a reader must trust of a file that `stiction certify --coq` writes of a claim about A, b and forces: contacts
   and problems in the plane and in space, the laws, and what each claim says. It proves nothing; Tests.v tests it.

   Numbers of a problem are rationals of Coq. Forces are those of any ordered field R, as are the reals; `of_Q` takes
   the one to the other (Numbers.v). Vectors are lists. Equations are those of [Baraff94]. *)
From Coq Require Import QArith.
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.claims Require Import Numbers.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

(* ---- Problems: a = A f + b ---- *)

Inductive contact :=
  | Bilateral                             (* pushes and pulls; no friction *)
  | Frictionless
  | Static (mu : Q)
  | Sliding (mu : Q) (slip : seq Q).      (* slip: the unit vector along which it slips *)

(* Rows contact by contact: the normal, then the directions of friction, one in the plane, two in space. *)
Record problem := Problem { dimension : nat; contacts : seq contact; A : seq (seq Q); b : seq Q }.

Definition frictions d c : nat := match c with Bilateral | Frictionless => 0 | Static _ | Sliding _ _ => d.-1 end.
Definition rows p : nat := sumn [seq (frictions (dimension p) c).+1 | c <- contacts p].

(* ---- Vectors over R ---- *)

Section Vectors.
Variable R : realFieldType.
Implicit Types (x y : seq R) (M : seq (seq R)).
Fixpoint dot x y : R := match x, y with u :: x, v :: y => u * v + dot x y | _, _ => 0 end.
Definition times M x : seq R := [seq dot row x | row <- M].
Definition plus x y : seq R := [seq uv.1 + uv.2 | uv <- zip x y].
Definition is_zero x := forall u, u \in x -> u = 0.
Definition real (x : seq Q) : seq R := map (of_Q R) x.
Definition real_matrix (M : seq (seq Q)) : seq (seq R) := map real M.
End Vectors.

(* A is square, b fits, mu >= 0, slip is a unit vector. *)
Definition contact_fits d c := match c with
  | Static mu => (0 <= mu)%coq_Q
  | Sliding mu slip => [/\ (0 <= mu)%coq_Q, size slip = d.-1 & dot (real rat_realFieldType slip) (real _ slip) = 1]
  | _ => True end.
Definition well_formed p :=
  [/\ dimension p = 2%N \/ dimension p = 3%N, size (A p) = rows p, size (b p) = rows p,
      forall row, List.In row (A p) -> size row = rows p &
      forall c, List.In c (contacts p) -> contact_fits (dimension p) c].

(* P at every contact: of x and y the normal component, and the list of those along the contact plane. *)
Fixpoint at_every_contact T d (P : contact -> T -> seq T -> T -> seq T -> Prop) (cs : seq contact) (x y : seq T)
  : Prop := match cs, x, y with
  | c :: cs, xN :: x, yN :: y =>
    let k := frictions d c in P c xN (take k x) yN (take k y) /\ at_every_contact d P cs (drop k x) (drop k y)
  | [::], _, _ => True
  | _, _, _ => False
  end.

(* ---- Laws of a contact, forces and accelerations fN, fF, aN, aF; lengths compared by their squares ---- *)

Section Laws.
Variable R : realFieldType.

(* (15) *)
Definition does_not_sink (fN aN : R) := [/\ 0 <= fN, 0 <= aN & fN * aN = 0].
(* In the plane (15) and (16), or (24) where the contact slides; in space (21), (22), which Coulomb's law implies. *)
Definition law c (fN : R) (fF : seq R) (aN : R) (aF : seq R) : Prop := match c with
  | Bilateral => aN = 0
  | Frictionless => does_not_sink fN aN
  | Static mu => let limit := of_Q R mu * fN in
    [/\ does_not_sink fN aN, dot fF fF <= limit * limit, dot fF aF <= 0 &
        is_zero aF \/ dot fF fF = limit * limit]
  | Sliding mu slip => does_not_sink fN aN /\ fF = [seq - (of_Q R mu * fN * u) | u <- real R slip]
  end.
(* In space: Coulomb's law up to k. Where a contact slips, abs(fF), times the cosine of the angle between fF and -aF, is
   at least k mu fN. With k = 1 friction is at its limit, opposite to aF: the law itself. *)
Definition coulomb_up_to (k : Q) c (fN : R) (fF : seq R) (aN : R) (aF : seq R) : Prop := match c with
  | Static mu => let limit := of_Q R mu * fN in let least := of_Q R k * limit in
    [/\ does_not_sink fN aN, dot fF fF <= limit * limit, dot fF aF <= 0 &
        least * least * dot aF aF <= dot fF aF * dot fF aF]
  | _ => law c fN fF aN aF
  end.

Variable p : problem.
Notation A := (real_matrix R (A p)).
Notation b := (real R (b p)).

Definition obey (law : contact -> R -> seq R -> R -> seq R -> Prop) (f : seq R) :=
  size f = rows p /\ at_every_contact (dimension p) law (contacts p) f (plus (times A f) b).
Definition solution := obey law.

(* K: the forces that friction allows *)
Definition in_cone c (vN : R) (vF : seq R) : Prop := match c with
  | Bilateral => True
  | Frictionless => 0 <= vN
  | Static mu | Sliding mu _ => 0 <= vN /\ dot vF vF <= (of_Q R mu * vN) * (of_Q R mu * vN)
  end.
Definition in_cones (v : seq R) :=
  at_every_contact (dimension p) (fun c vN vF _ _ => in_cone c vN vF) (contacts p) v v.
End Laws.

(* ---- The claims ---- *)

Definition solution_exists p := well_formed p /\ forall R : realFieldType, exists f : seq R, solution p f.

Definition coulomb_solution_exists k p := [/\ well_formed p, dimension p = 3%N, (0 < k <= 1)%coq_Q &
  forall R : realFieldType, exists f : seq R, obey p (coulomb_up_to k) f].

Definition no_solution p := well_formed p /\ forall (R : realFieldType) (f : seq R), ~ solution p f.

Definition positive_semidefinite p := well_formed p /\ forall (R : realFieldType) (x y : seq R),
  size x = rows p -> size y = rows p ->
  dot x (times (real_matrix R (A p)) y) = dot y (times (real_matrix R (A p)) x) /\
  0 <= dot x (times (real_matrix R (A p)) x).

(* (H): b does no negative work on forces that accelerate nothing. No contact slides. *)
Definition slides c := if c is Sliding _ _ then true else false.
Definition hypothesis_H p := well_formed p /\ (forall c, List.In c (contacts p) -> slides c = false) /\
  forall (R : realFieldType) (v : seq R), size v = rows p -> in_cones p v -> is_zero (times (real_matrix R (A p)) v) ->
  0 <= dot (real R (b p)) v.
