(* SPDX-License-Identifier: Apache-2.0 *)
(* What a reader must trust of complete driving in the plane: the algorithm as a function, and the statements.
   (Law.v: the law; Rational.v: the ordered field R(X).) It proves nothing; Theorems.v proves the statements, and
   Tests.v tests them.

   solver/complete/complete_driving.md, parts 1 to 5, is what is defined here. n contacts. mu i > 0: static; mu i = 0:
   frictionless (its second row is not looked at). f = (normal forces, friction forces), a = A f + b. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.existence Require Import Law.
From Stiction.driving Require Import Rational.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

(* ---- A line within finitely many half spaces:
        E f = e (m unknowns; row r0 of E is 0 = 0), G k f + h k >= 0 for all k ---- *)
Section Piece.
Variables (R : realFieldType) (m : nat) (K : finType)
  (E : 'M[R]_m) (e : 'cV[R]_m) (G : K -> 'rV[R]_m) (h : K -> R) (r0 : 'I_m).
Definition lin k (v : 'cV[R]_m) := (G k *m v) 0 0.
Definition val k f := lin k f + h k.
(* the point of the line on boundary k, and the direction that leaves it *)
Definition Bk k := E + delta_mx r0 (0 : 'I_1) *m G k.
Definition cand k : 'cV[R]_m := invmx (Bk k) *m (e - h k *: delta_mx r0 0).
Definition dir k : 'cV[R]_m := invmx (Bk k) *m delta_mx r0 0.
Definition isendb k : bool :=
  [&& E *m cand k == e, val k (cand k) == 0 & [forall k', (k' != k) ==> (0 < val k' (cand k))]].
Definition ratio k k' := val k' (cand k) / - lin k' (dir k).
Definition pivot k : option K :=
  [pick k' | (lin k' (dir k) < 0) && [forall k2, (lin k2 (dir k) < 0) ==> (ratio k k' <= ratio k k2)]].
End Piece.

(* ---- The cells of one contact:
        finished (B, S, +, -, and 0 for mu = 0), driven (its normal; its friction on side + or -), later;
        each as two equations and up to three inequalities ---- *)
Inductive loc := cB | cS | cP | cM | cZ | dN | dP | dM | Later.
Definition loc_nat t : nat := (match t with
  cB => 0 | cS => 1 | cP => 2 | cM => 3 | cZ => 4 | dN => 5 | dP => 6 | dM => 7 | Later => 8 end)%N.
Definition nat_loc (k : nat) : option loc :=
  nth None [:: Some cB; Some cS; Some cP; Some cM; Some cZ; Some dN; Some dP; Some dM; Some Later] k.
Lemma loc_natK : pcancel loc_nat nat_loc. Proof. by case. Qed.
Definition loc_eqMixin := PcanEqMixin loc_natK.
Canonical loc_eqType := EqType loc loc_eqMixin.
Definition loc_choiceMixin := PcanChoiceMixin loc_natK.
Canonical loc_choiceType := ChoiceType loc loc_choiceMixin.
Definition loc_countMixin := PcanCountMixin loc_natK.
Canonical loc_countType := CountType loc loc_countMixin.
Lemma loc_enumP : Finite.axiom [:: cB; cS; cP; cM; cZ; dN; dP; dM; Later]. Proof. by case. Qed.
Definition loc_finMixin := FinMixin loc_enumP.
Canonical loc_finType := FinType loc loc_finMixin.
Definition driven t := match t with dN | dP | dM => true | _ => false end.
Definition finished t := match t with cB | cS | cP | cM | cZ => true | _ => false end.

(* forms in the force and acceleration (fN, fF, aN, aF) of a contact *)
Inductive form := Zero | XN | XF | XFm | AN | ANm | AF | AFm | UP | DN.
Definition slot : finType := [finType of option bool].
Notation s0 := (None : slot). Notation s1 := (Some false : slot). Notation s2 := (Some true : slot).
Definition eq1 t := match t with cB | Later => XN | cS | cP | cM | cZ | dP | dM => AN | dN => XF end.
Definition eq2 t := match t with cB | Later | cZ => XF | cS => AF | cP => UP | cM => DN | dN | dP | dM => Zero end.
Definition ineq t (k : slot) : option form :=
  match t, k with
  | cB, None => Some AN
  | cS, None => Some UP | cS, Some false => Some DN
  | cP, None => Some XN | cP, Some false => Some AFm
  | cM, None => Some XN | cM, Some false => Some AF
  | cZ, None => Some XN
  | dN, None => Some XN | dN, Some false => Some ANm
  | dP, None => Some XF | dP, Some false => Some UP | dP, Some true => Some AFm
  | dM, None => Some XFm | dM, Some false => Some DN | dM, Some true => Some AF
  | _, _ => None
  end.
(* which cells a contact has *)
Definition ok (R : realFieldType) (m : R) t :=
  match t with cS | cP | cM | dP | dM => 0 < m | cZ => m == 0 | _ => 0 <= m end.

Section Cell.
Variables (R : realFieldType) (m fN fF aN aF : R).
Definition ev c : R := match c with
  | Zero => 0 | XN => fN | XF => fF | XFm => - fF | AN => aN | ANm => - aN | AF => aF | AFm => - aF
  | UP => m * fN - fF | DN => m * fN + fF end.
Definition lval t k : R := if ineq t k is Some c then ev c else 1.
Definition on t := (ev (eq1 t) == 0) && (ev (eq2 t) == 0).
Definition inn t := [&& on t, 0 < lval t s0, 0 < lval t s1 & 0 < lval t s2].
Definition fac t k := [&& on t, lval t k == 0,
  (k == s0) || (0 < lval t s0), (k == s1) || (0 < lval t s1) & (k == s2) || (0 < lval t s2)].
(* how many of the equations of contacts hold *)
Definition cnt : nat := addn (addn (if (fN == 0) && (fF == 0) then 2%N
  else nat_of_bool [|| fN == 0, fF == 0, m * fN == fF | m * fN == - fF]) (aN == 0)) (aF == 0).
End Cell.

(* ---- The algorithm, for b without ties ---- *)
Section Algorithm.
Variables (R : realFieldType) (n : nat) (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R).
Notation vec := 'cV[R]_(n + n).
Notation aN := (Law.aN A b).
Notation aF := (Law.aF A b).

(* a word: the state of every contact. A piece: contact i is driven, those before are finished, those after have no
   force *)
Definition word := {ffun 'I_n -> loc}.
Definition piece (p : word) (i : 'I_n) : bool := [&& driven (p i), [forall t : 'I_n, (t < i)%N ==> finished (p t)],
  [forall t : 'I_n, (i < t)%N ==> (p t == Later)] & [forall t, ok (mu t) (p t)]].
Definition drv (p : word) : option 'I_n := [pick i | piece p i].
(* its equations and inequalities *)
Definition rowf c (j : 'I_n) : 'rV[R]_(n + n) := match c with
  | Zero => 0 | XN => delta_mx 0 (lshift n j) | XF => delta_mx 0 (rshift n j) | XFm => - delta_mx 0 (rshift n j)
  | AN => row (lshift n j) A | ANm => - row (lshift n j) A | AF => row (rshift n j) A | AFm => - row (rshift n j) A
  | UP => mu j *: delta_mx 0 (lshift n j) - delta_mx 0 (rshift n j)
  | DN => mu j *: delta_mx 0 (lshift n j) + delta_mx 0 (rshift n j) end.
Definition constf c (j : 'I_n) : R := match c with
  | AN => b (lshift n j) 0 | ANm => - b (lshift n j) 0 | AF => b (rshift n j) 0 | AFm => - b (rshift n j) 0
  | _ => 0 end.
Definition E (p : word) : 'M[R]_(n + n) :=
  col_mx (\matrix_(j < n) rowf (eq1 (p j)) j) (\matrix_(j < n) rowf (eq2 (p j)) j).
Definition e (p : word) : vec := col_mx (\col_j - constf (eq1 (p j)) j) (\col_j - constf (eq2 (p j)) j).
Definition G (p : word) (x : 'I_n * slot) : 'rV[R]_(n + n) := if ineq (p x.1) x.2 is Some c then rowf c x.1 else 0.
Definition h (p : word) (x : 'I_n * slot) : R := if ineq (p x.1) x.2 is Some c then constf c x.1 else 1.
(* an end of a piece: (p, (j, k)), the point where inequality k of contact j becomes zero *)
Definition ends : finType := [finType of word * ('I_n * slot)].
Definition is_end (x : ends) : bool :=
  if drv x.1 is Some i then isendb (E x.1) (e x.1) (G x.1) (h x.1) (rshift n i) x.2 else false.
Definition point (x : ends) : vec :=
  if drv x.1 is Some i then cand (E x.1) (e x.1) (G x.1) (h x.1) (rshift n i) x.2 else 0.

(* ---- the algorithm ---- *)
(* along the piece: the null vector, the ratio test *)
Definition along (x : ends) : option ends :=
  if is_end x then if drv x.1 is Some i then
    if pivot (E x.1) (e x.1) (G x.1) (h x.1) (rshift n i) x.2 is Some k then Some (x.1, k) else None
    else None else None.
(* over to the next piece *)
Definition upd (p : word) (j : 'I_n) t : word := [ffun s => if s == j then t else p s].
Definition next (f : vec) (i : 'I_n) : option 'I_n := (* the first contact after i that would penetrate *)
  [pick t : 'I_n | [&& (i < t)%N, aN f t < 0 & [forall s : 'I_n, (i < s < t)%N ==> (0 <= aN f s)]]].
Definition prev (p : word) (i : 'I_n) : option 'I_n := (* the last contact before i that is not in B *)
  [pick t : 'I_n | [&& (t < i)%N, p t != cB & [forall s : 'I_n, (t < s < i)%N ==> (p s == cB)]]].
Definition rise (p : word) (i : 'I_n) c (i' : 'I_n) : word := [ffun s : 'I_n =>
  if (s < i)%N then p s else if s == i then c else if (s < i')%N then cB else if s == i' then dN else Later].
Definition enter (p : word) (i : 'I_n) t : word :=
  [ffun s : 'I_n => if (s < i)%N then p s else if s == i then t else Later].
Definition up (f : vec) (p : word) i c : option ends :=
  if next f i is Some i' then Some (rise p i c i', (i', s0)) else None.
Definition down (f : vec) (p : word) i : option ends := if prev p i is Some j then
  match p j with
  | cS => if 0 < xF f j then Some (enter p j dP, (j, s2)) else Some (enter p j dM, (j, s2))
  | cP => Some (enter p j dP, (j, s1))
  | cM => Some (enter p j dM, (j, s1))
  | cZ => Some (enter p j dN, (j, s1))
  | _ => None
  end else None.
Definition over_at (f : vec) (p : word) j (k : slot) : option ends := match p j, k with
  (* a finished contact's facet: into the cell beyond *)
  | cB, _ => if mu j == 0 then Some (upd p j cZ, (j, s0))
             else if aF f j < 0 then Some (upd p j cP, (j, s0)) else Some (upd p j cM, (j, s0))
  | cP, None => Some (upd p j cB, (j, s0)) | cP, _ => Some (upd p j cS, (j, s0))
  | cM, None => Some (upd p j cB, (j, s0)) | cM, _ => Some (upd p j cS, (j, s1))
  | cS, None => Some (upd p j cP, (j, s1)) | cS, _ => Some (upd p j cM, (j, s1))
  | cZ, _ => Some (upd p j cB, (j, s0))
  (* the driven force is back at zero: descent *)
  | dN, None => down f p j
  | dP, None | dM, None => Some (upd p j dN, (j, s1))
  (* the driven acceleration is zero, or the driven friction at its bound: the contact is finished *)
  | dN, _ => if mu j == 0 then up f p j cZ
             else if aF f j < 0 then Some (upd p j dP, (j, s0)) else Some (upd p j dM, (j, s0))
  | dP, Some false => up f p j cP | dP, Some true => up f p j cS
  | dM, Some false => up f p j cM | dM, Some true => up f p j cS
  | Later, _ => None
  end.
Definition over (x : ends) : option ends := if is_end x then over_at (point x) x.1 x.2.1 x.2.2 else None.
(* the first end: f = 0. None: no contact would penetrate, and f = 0 is a solution *)
Definition first : option ends :=
  if [pick t : 'I_n | (aN 0 t < 0) && [forall s : 'I_n, (s < t)%N ==> (0 <= aN 0 s)]] is Some i
  then Some (([ffun s : 'I_n => if (s < i)%N then cB else if s == i then dN else Later] : word), (i, s0)) else None.

(* From end x: along its piece, over to the next, ...; at most fuel + 1 pieces.
   The last end, if there is no next piece. *)
Fixpoint drive fuel (x : ends) : option ends :=
  if along x is Some y then if over y is Some z then if fuel is k.+1 then drive k z else None else Some y else None.

(* the end at which piece k begins *)
Variable x0 : ends.
Definition entry k := iter k (obind (fun x => obind over (along x))) (Some x0).
End Algorithm.

(* Without ties: of the equations fN = 0, fF = 0, abs fF = mu fN, aN = 0, aF = 0 of the contacts no more hold anywhere
   than there are unknowns (fN = fF = 0 counts for two). *)
Section Nondegenerate.
Variables (R : realFieldType) (n : nat) (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R).
Definition nondegenerate := forall f, (\sum_j cnt (mu j) (xN f j) (xF f j) (aN A b f j) (aF A b f j) <= n + n)%N.
Definition drives_to_a_solution := match first A b with
  | None => solution A b mu 0
  | Some x0 => exists y, [/\ drive A b mu (4 ^ n).-2 x0 = Some y, is_end A b mu y & solution A b mu (point A b mu y)]
  end.
End Nondegenerate.

(* ---- Ties: b(eps) = b + eps e_N + (eps^2, eps^3, ...) over R(X), eps = 1/X, rows contact by contact ---- *)
(* the place of a row in N1 F1 N2 F2 ... *)
Definition place n (r : 'I_(n + n)) : nat := match split r with inl j => j.*2 | inr j => j.*2.+1 end.
Section Perturbed.
Variables (R : realFieldType) (n : nat).
Notation F := (ratfun R).
Definition eps : F := (X R)^-1.
Definition MF k (M : 'M[R]_k) : 'M[F]_k := map_mx (@emb R) M.
Definition qF k (q : 'cV[R]_k) : 'cV[F]_k := map_mx (@emb R) q.
Variables (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R).
Definition muF i : F := @emb R (mu i).
Definition eN : 'cV[F]_(n + n) := col_mx (const_mx 1) 0.
Definition beps : 'cV[F]_(n + n) := qF b + (eps *: eN + \col_r eps ^+ (place r).+2).

(* x is infinitely near r *)
Definition tiny (z : F) := forall c : R, 0 < c -> `|z| < emb c.
Definition st (x : F) (r : R) := tiny (x - emb r).
Definition near k (f : 'cV[F]_k) (g : 'cV[R]_k) := forall r, st (f r 0) (g r 0).

(* the run on b(eps), at most 4^n - 1 pieces *)
Definition complete_driving : option 'cV[F]_(n + n) :=
  if first (MF A) beps is Some x0 then omap (point (MF A) beps muF) (drive (MF A) beps muF (4 ^ n).-2 x0) else Some 0.
End Perturbed.

(* ---- The statements ---- *)

(* Every problem with A symmetric positive semidefinite, mu >= 0, and b with (H), so with b in range(A) + K*:
   complete driving on b(eps) ends after at most 4^n - 1 pieces at a solution f for b(eps), which is infinitely near a
   solution g for b. *)
Definition complete_driving_solves :=
  forall (R : realFieldType) n (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R),
  A^T = A -> (forall x, 0 <= dotp x (A *m x)) -> (forall i, 0 <= mu i) -> H_holds A b mu ->
  exists f g,
    [/\ complete_driving A b mu = Some f, solution (MF A) (beps b) (muF mu) f, near f g & solution A b mu g].

(* On its way no piece, named by its word, comes twice. *)
Definition no_piece_comes_twice :=
  forall (R : realFieldType) n (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R) x0,
  A^T = A -> (forall x, 0 <= dotp x (A *m x)) -> (forall i, 0 <= mu i) -> H_holds A b mu ->
  first (MF A) (beps b) = Some x0 -> forall i j x y,
  entry (MF A) (beps b) (muF mu) x0 i = Some x -> entry (MF A) (beps b) (muF mu) x0 j = Some y -> x.1 = y.1 -> i = j.

(* The same for b without ties, under the hypotheses of either theorem that follows. *)
Definition no_piece_comes_twice_without_ties :=
  forall (R : realFieldType) n (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R) x0, (forall i, 0 <= mu i) ->
  nondegenerate A b mu -> (forall x, x != 0 -> 0 < dotp x (A *m x)) \/
    [/\ A^T = A, forall x, 0 <= dotp x (A *m x) & forall v, in_cones mu v -> v != 0 -> A *m v = 0 -> 0 < dotp v b] ->
  first A b = Some x0 -> forall i j x y,
  entry A b mu x0 i = Some x -> entry A b mu x0 j = Some y -> x.1 = y.1 -> i = j.

(* b without ties. A positive definite, symmetric or not. *)
Definition complete_driving_solves_definite :=
  forall (R : realFieldType) n (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R), (forall i, 0 <= mu i) ->
  nondegenerate A b mu -> (forall x, x != 0 -> 0 < dotp x (A *m x)) -> drives_to_a_solution A b mu.

(* b without ties. A symmetric positive semidefinite, and b.v > 0 for 0 <> v in K with A v = 0. *)
Definition complete_driving_solves_semidefinite :=
  forall (R : realFieldType) n (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R), (forall i, 0 <= mu i) ->
  nondegenerate A b mu -> A^T = A -> (forall x, 0 <= dotp x (A *m x)) ->
  (forall v, in_cones mu v -> v != 0 -> A *m v = 0 -> 0 < dotp v b) -> drives_to_a_solution A b mu.

(* So the plane has a solution under (H). *)
Definition plane_has_a_solution_under_H :=
  forall (R : realFieldType) n (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R),
  A^T = A -> (forall x, 0 <= dotp x (A *m x)) -> (forall i, 0 <= mu i) -> H_holds A b mu ->
  exists g, solution A b mu g.

(* (H) holds for b in range(A) + K*. *)
Definition range_has_H := forall (R : realFieldType) n (A : 'M[R]_(n + n)) (c k : 'cV[R]_(n + n)) (mu : 'I_n -> R),
  A^T = A -> (forall v, in_cones mu v -> 0 <= dotp v k) -> H_holds A (A *m c + k) mu.
