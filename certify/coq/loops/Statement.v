(* SPDX-License-Identifier: Apache-2.0 *)
(* What a reader must trust of the loops: the published algorithm as a function, the law, and the statements.

   First the algorithm of D. Baraff, Fast Contact Force Computation for Nonpenetrating Rigid Bodies, SIGGRAPH 1994,
   sections 4.3 and 5.2-5.5, for static contacts of the plane, in exact arithmetic, under every reading of its text
   that solver/published/readings.md distinguishes (a `policy`). Section numbers are the paper's. `drives p pol k` is
   the state after k drives, or how the run ended before. compare.py holds it against certify/check_runs.py,
   step by step.

   Then the law in plain mathematics over Q, the problems, and what is stated of them. Tests.v tests both. *)
From Coq Require Import QArith Qabs ZArith List Bool Arith.
Import ListNotations.
Local Open Scope nat_scope.

(* ---- Policies: the nine switches; the first value of each is the reading `paper` ------------------------------- *)

Inductive scan_order := lowest | normals_first | most_violated | highest.   (* 5.5: "continually scans for" *)
Inductive scan_begin := restart | round.
Inductive admission  := lazy | eager.               (* normals that hold at first sight: 4.3; 4.1 *)
Inductive filing     := unfiled | filed_at_scan.    (* `file=no`, `file=yes`: frictions that hold at a scan, 5.2 *)
Inductive give_up_at := first | previous | second.  (* 5.5: "and the previous step size was zero" *)
Inductive dropping   := drop_contact | drop_variable. (* 5.4: "removed from both C and NC" *)
Inductive rezeroing  := rescan | continue.          (* 5.5: "we first drive fF to zero" *)
Inductive tie_order  := by_sets | by_contacts.
Inductive apex_rule  := kept | suspended_at_apex.   (* friction while fN = 0 *)

Record policy := Policy { scan : scan_order; resume : scan_begin; admit : admission; file : filing;
  give_up : give_up_at; drop : dropping; rezero : rezeroing; ties : tie_order; apex : apex_rule }.

Definition paper := Policy lowest restart lazy unfiled first drop_contact rescan by_sets kept.

(* ---- Numbers: any field with a sign. The theorems are about `rationals` (Q in lowest terms) -------------------- *)

Record field := Field { num :> Type; zero : num; one : num; add : num -> num -> num; mul : num -> num -> num;
  opp : num -> num; inv : num -> num; sign : num -> comparison }.            (* sign: Lt, Eq, Gt for < 0, = 0, > 0 *)

Canonical Structure rationals : field := Field Q 0%Q 1%Q (fun x y => Qred (x + y)) (fun x y => Qred (x * y))
  (fun x => Qred (- x)) (fun x => Qred (/ x)) (fun x => (Qnum x ?= 0)%Z).

(* ---- Index sets (4.1, 5.3) ------------------------------------------------------------------------------------- *)

Inductive set := none | C | NC | CF | NCm | NCp | suspended.   (* none: in no set; NCm, NCp: NC-, NC+ *)
Scheme Equality for set.

Inductive goal := establish | to_zero.        (* what a drive is for: the conditions, or fF = 0 (5.5) *)

(* Lists as vectors; rows are N1 F1 N2 F2 ..., contacts count from 0. *)
Definition put {T} (l : list T) i x := firstn i l ++ match skipn i l with [] => [] | _ :: t => x :: t end.
Definition is_normal row := Nat.even row.
Definition contact_of row := Nat.div2 row.
Definition normal_of row := 2 * contact_of row.
Definition friction_of row := S (normal_of row).

(* The first element of least key; of equals the one found first. *)
Definition best {T} (less : T -> T -> bool) (l : list T) : option T :=
  fold_left (fun b x => match b with None => Some x | Some y => if less x y then Some x else b end) l None.

Declare Scope num_scope.
Delimit Scope num_scope with num.

Section Numbers.

Context {F : field}.
Local Notation "0" := (zero F) : num_scope.
Local Notation "1" := (one F) : num_scope.
Local Notation "x + y" := (add F x y) : num_scope.
Local Notation "x * y" := (mul F x y) : num_scope.
Local Notation "- x" := (opp F x) : num_scope.
Local Notation "x - y" := (add F x (opp F y)) : num_scope.
Local Notation "x / y" := (mul F x (inv F y)) : num_scope.
Local Notation vec := (list (num F)).
Local Open Scope num_scope.

Definition negative (x : F) := match sign F x with Lt => true | _ => false end.
Definition positive (x : F) := match sign F x with Gt => true | _ => false end.
Definition is0 (x : F) := match sign F x with Eq => true | _ => false end.
Definition sgn (x : F) : F := match sign F x with Lt => - (1) | Eq => 0 | Gt => 1 end.
Definition abs (x : F) : F := if negative x then - x else x.
Definition less (x y : F) := negative (x - y).
Definition at_ (v : vec) i := nth i v 0.
Definition dot (x y : vec) : F := fold_right (fun uv s => fst uv * snd uv + s) 0 (combine x y).
Definition axpy (c : F) (x y : vec) : vec := map (fun uv => fst uv + c * snd uv) (combine x y).     (* x + c y *)

Record problem := Problem { A : list vec; b : vec; mu : vec }.      (* a = A f + b (5.4); mu by contact *)
Definition times (p : problem) (x : vec) : vec := map (fun r => dot r x) (A p).
Definition rows (p : problem) := seq 0 (length (b p)).
Definition contacts (p : problem) := length (mu p).
Definition mu_of p row := at_ (mu p) (contact_of row).

(* Forces, accelerations and index sets. *)
Record point := Point { f : vec; a : vec; sets : list set }.
Definition set_of (s : point) row := nth row (sets s) none.

(* ---- The conditions (15), (16) --------------------------------------------------------------------------------- *)

(* fN >= 0, aN >= 0, fN aN = 0 (15) *)
Definition normal_holds (s : point) i :=
  let fN := at_ (f s) i in let aN := at_ (a s) i in
  negb (negative fN) && negb (negative aN) && (is0 fN || is0 aN).

(* abs(fF) <= mu fN, aF fF <= 0, aF (mu fN - abs(fF)) = 0 (16) *)
Definition friction_holds p (s : point) i :=
  let fF := at_ (f s) i in let aF := at_ (a s) i in let slack := mu_of p i * at_ (f s) (normal_of i) - abs fF in
  negb (negative slack) && (is0 aF || is0 fF || negb (eqb (negative aF) (negative fF))) && (is0 aF || is0 slack).

(* "one must first establish the normal force conditions" (5.5): a friction counts once (15) holds *)
Definition violated p s i :=
  if is_normal i then negb (normal_holds s i) else normal_holds s (normal_of i) && negb (friction_holds p s i).

(* ---- Direction: fdirection (4.3, 5.5) -------------------------------------------------------------------------- *)

(* Gauss-Jordan on rows [M | r], column by column. Returns the pivot rows, each with its column, and the others.
   A column that depends on those before it finds no pivot. *)
Fixpoint split_at_pivot k (before todo : list vec) : option (vec * list vec) :=
  match todo with
  | [] => None
  | r :: t => if is0 (at_ r k) then split_at_pivot k (r :: before) t else Some (r, rev before ++ t)
  end.
Fixpoint eliminate (columns : list nat) (pivots : list (nat * vec)) (todo : list vec) : list (nat * vec) * list vec :=
  match columns with
  | [] => (pivots, todo)
  | k :: t =>
    match split_at_pivot k [] todo with
    | None => eliminate t pivots todo
    | Some (r, others) =>
      let r := map (fun x => x / at_ r k) r in
      let clear x := axpy (- at_ x k) x r in
      eliminate t ((k, r) :: map (fun jx => (fst jx, clear (snd jx))) pivots) (map clear others)
    end
  end.
(* x with M x = r, zero where the column depends on those before it; None if there is none *)
Definition solve n (M : list vec) : option vec :=
  let '(pivots, rest) := eliminate (seq 0 n) [] M in
  if forallb (fun r => is0 (at_ r n)) rest then
    Some (map (fun k => match List.find (fun jx => Nat.eqb (fst jx) k) pivots with
                        | Some jx => at_ (snd jx) n | None => 0 end) (seq 0 n))
  else None.

(* Forces, if the force of this row changes by 1:
   a normal takes its friction along in NC- and NC+ (dfF = -+mu dfN). *)
Definition unit_change p (s : list set) i : vec :=
  map (fun j => if Nat.eqb j i then 1 else
                if is_normal i && Nat.eqb j (S i) then
                  match nth j s none with NCp => mu_of p i | NCm => - mu_of p i | _ => 0 end
                else 0) (rows p).
Definition maintained (x : set) := match x with C | CF => true | _ => false end.
Definition combination n (c : list F) (vs : list vec) : vec :=
  fold_left (fun v cx => axpy (fst cx) v (snd cx)) (combine c vs) (repeat 0 n).

(* df while the force of d changes at this rate; daN = 0 in C, daF = 0 in CF *)
Definition direction p (s : list set) d (rate : F) : option vec :=
  let unknowns := filter (fun i => maintained (nth i s none) && negb (Nat.eqb i d)) (rows p) in
  let changes := map (unit_change p s) unknowns in
  let effects := map (times p) changes in
  let driven := map (mul F rate) (unit_change p s d) in
  let effect := times p driven in
  let n := length unknowns in
  match solve n (map (fun i => map (fun e => at_ e i) effects ++ [- at_ effect i]) unknowns) with
  | None => None
  | Some x => Some (axpy 1 driven (combination (length (b p)) x changes))
  end.

(* ---- Largest step: maxstep (4.3, 5.5) -------------------------------------------------------------------------- *)

(* (s, j, Y): after the step s, j wants into Y. A limit is offered where `gap` >= 0 closes at a positive rate. *)
Record limit := Limit { step : F; who : nat; into : set }.
Definition closing (gap rate : F) j Y : list limit := if positive rate then [Limit (gap / rate) j Y] else [].

Definition at_bound p (s : point) (df : vec) i : list limit :=        (* fF = mu fN, fF = -mu fN *)
  let bound := mu_of p i * at_ (f s) (normal_of i) in let growth := mu_of p i * at_ df (normal_of i) in
  closing (bound - at_ (f s) i) (at_ df i - growth) i NCp ++
  closing (bound + at_ (f s) i) (- at_ df i - growth) i NCm.

Definition driven_limits p (s : point) d g (df da : vec) : list limit :=
  let fd := at_ (f s) d in let ad := at_ (a s) d in
  if is_normal d then closing (- ad) (at_ da d) d C
  else match g with
  | to_zero => [Limit (abs fd) d none]                                (* it falls at rate 1 *)
  | establish => closing (abs ad) (- (sgn ad * at_ da d)) d CF ++ at_bound p s df d
  end.

Definition limits_of p (s : point) (df da : vec) i : list limit :=
  match set_of s i with
  | C => closing (at_ (f s) i) (- at_ df i) i NC
  | NC => closing (at_ (a s) i) (- at_ da i) i C
  | CF => at_bound p s df i
  | NCm => closing (at_ (a s) i) (- at_ da i) i CF
  | NCp => closing (- at_ (a s) i) (at_ da i) i CF
  | none | suspended => []
  end.

Definition others p (pol : policy) (s : point) d : list nat :=        (* in the order in which ties are broken *)
  let rs := filter (fun i => negb (Nat.eqb i d)) (rows p) in
  match ties pol with
  | by_contacts => rs
  | by_sets => flat_map (fun X => filter (fun i => set_beq (set_of s i) X) rs) [C; NC; CF; NCm; NCp]
  end.

Definition maxstep p pol s d g df da : option limit :=
  best (fun l k => less (step l) (step k))
       (driven_limits p s d g df da ++ flat_map (limits_of p s df da) (others p pol s d)).

(* ---- Moving between sets, and giving up (5.3-5.5) -------------------------------------------------------------- *)

(* A drive remembers the set that each variable last left, and whether its last step had length zero. *)
Record inner := Inner { here : point; left : list (option set); zero_step : bool }.

Definition filed_set (s : point) i := match sign F (at_ (a s) i) with Lt => NCp | Eq => CF | Gt => NCm end.

Definition enter i Y (m : inner) : inner :=
  let s := here m in
  if set_beq (set_of s i) Y then m
  else Inner (Point (f s) (a s) (put (sets s) i Y)) (put (left m) i (Some (set_of s i))) (zero_step m).

Definition wants_back (m : inner) j Y := match nth j (left m) None with Some X => set_beq X Y | None => false end.

Definition move (pol : policy) d j Y (zero_now : bool) (m : inner) : inner :=
  let hopeless := match give_up pol with
                  | first => zero_now | previous => zero_step m | second => zero_step m && zero_now end in
  let fr := friction_of j in
  if wants_back m j Y && hopeless then                                 (* given up (5.4) *)
    let m := enter j none m in
    if is_normal j && negb (Nat.eqb fr d) && match drop pol with drop_contact => true | drop_variable => false end
    then enter fr none m else m
  else
    let m := enter j Y m in
    if is_normal j then
      match Y, set_of (here m) fr, apex pol with
      | NC, (CF | NCm | NCp), suspended_at_apex => enter fr suspended m
      | C, suspended, _ => enter fr (filed_set (here m) fr) m
      | _, _, _ => m
      end
    else m.

(* ---- One drive: drive-to-zero (4.3, 5.5) ----------------------------------------------------------------------- *)

Record pivot := Pivot { driven : nat; driven_to : goal; length_ : F; limiting : nat; from : set; to : set }.

Inductive ending := Solved | Singular | Ray | Spent.      (* Spent: more steps in a drive than were allowed *)
Inductive result (T : Type) := Going (x : T) | End (e : ending).
Arguments Going {T} x.  Arguments End {T} e.

(* A step: the limit that is reached, what is then, and the pivot for the record. *)
Definition take_step p pol d g (m : inner) : result (inner * pivot) :=
  let s := here m in
  let rate := if is_normal d then 1 else
              match g with establish => - sgn (at_ (a s) d) | to_zero => - sgn (at_ (f s) d) end in
  match direction p (sets s) d rate with
  | None => End Singular
  | Some df =>
    let da := times p df in
    match maxstep p pol s d g df da with
    | None => End Ray
    | Some l =>
      let t := step l in let j := who l in let zero_now := is0 t in
      let m' := Inner (Point (axpy t (f s) df) (axpy t (a s) da) (sets s)) (left m) (zero_step m) in
      let m' := move pol d j (into l) zero_now m' in
      Going (Inner (here m') (left m') zero_now,
             Pivot d g t j (set_of s j) (set_of (here m') j))
    end
  end.

Fixpoint steps (most : nat) p pol d g (m : inner) : list pivot * result point :=
  match most with
  | O => ([], End Spent)
  | S most =>
    match take_step p pol d g m with
    | End e => ([], End e)
    | Going (m', pv) =>
      if Nat.eqb (limiting pv) d then ([pv], Going (here m'))
      else let '(pvs, end_) := steps most p pol d g m' in (pv :: pvs, end_)
    end
  end.

Definition most_steps := 1000.          (* of one drive; that it is enough is part of every theorem *)

Definition drive p pol d g (s : point) : list pivot * result point :=
  let m := Inner s (repeat None (length (b p))) false in
  let fr := friction_of d in
  let m := if is_normal d && set_beq (set_of s fr) suspended then enter fr (filed_set s fr) m else m in
  steps most_steps p pol d g m.

(* ---- Main loop: compute-forces (4.3, 5.5) ---------------------------------------------------------------------- *)

(* Between drives: the point, what is remembered under resume=round (the contact driven last), and under
   rezero=continue the friction that was just driven to zero and is violated there: it is driven next. *)
Record state := State { point_of : point; last : option nat; next_driven : option nat }.

Definition start p := State (Point (repeat 0 (length (b p))) (b p) (repeat none (length (b p)))) None None.

(* 4.1, 5.2: conditions that hold at first sight *)
Definition sweep_row p pol (s : point) i : point :=
  let to Y := Point (f s) (a s) (put (sets s) i Y) in
  if negb (set_beq (set_of s i) none) then s
  else if is_normal i then
    match admit pol with
    | eager => if is0 (at_ (f s) i) && negb (negative (at_ (a s) i)) then to NC else s
    | lazy => s
    end
  else match file pol with
    | filed_at_scan =>
      if negb (normal_holds s (normal_of i)) || negb (friction_holds p s i) then s
      else if positive (at_ (f s) (normal_of i)) then to (filed_set s i)
      else if set_beq (set_of s (normal_of i)) NC then to suspended else s
    | unfiled => s
    end.
Definition sweep p pol s := fold_left (sweep_row p pol) (rows p) s.

(* The order of a scan. *)
Definition contact_order p pol (last : option nat) : list nat :=
  (let n := contacts p in
  let up k := map (fun i => (k + i) mod n) (seq 0 n) in
  let down k := map (fun i => (k + (n - i)) mod n) (seq 0 n) in
  match scan pol, last with
  | highest, Some k => down k
  | highest, None => down (n - 1)
  | _, Some k => up k
  | _, None => up 0
  end)%nat.
Definition scan_order_of p pol last : list nat :=
  (let cs := contact_order p pol last in
  match scan pol with
  | normals_first => map (fun c => 2 * c) cs ++ map (fun c => S (2 * c)) cs
  | _ => flat_map (fun c => [2 * c; S (2 * c)]) cs
  end)%nat.

Definition find_violated p pol last (s : point) : option nat :=
  match scan pol with
  | most_violated =>
    let found := filter (violated p s) (rows p) in
    let normals := filter is_normal found in
    if negb (Nat.eqb (length normals) 0)
    then best (fun i j => less (at_ (a s) i) (at_ (a s) j)) normals
    else best (fun i j => less (abs (at_ (a s) j)) (abs (at_ (a s) i))) found
  | _ => List.find (violated p s) (scan_order_of p pol last)
  end.

Definition drive_from p pol d g (s : point) : list pivot * result state :=
  let '(pvs, r) := drive p pol d g s in
  (pvs, match r with
        | End e => End e
        | Going s' => Going (State s'
            (match resume pol with round => Some (contact_of d) | restart => None end)
            (match g, rezero pol with
             | to_zero, continue => if violated p s' d then Some d else None
             | _, _ => None end))
        end).

(* The next drive, or the end; with its pivots. *)
Definition next_with_pivots p pol (x : state) : list pivot * result state :=
  match next_driven x with
  | Some d => drive_from p pol d establish (point_of x)
  | None =>
    let s := sweep p pol (point_of x) in
    match find_violated p pol (last x) s with
    | None => ([], End Solved)
    | Some d => drive_from p pol d (if is_normal d || is0 (at_ (f s) d) then establish else to_zero) s
    end
  end.
Definition next p pol x := snd (next_with_pivots p pol x).

(* The state after k drives, or the end. *)
Fixpoint drives p pol k : result state :=
  match k with
  | O => Going (start p)
  | S k => match drives p pol k with Going x => next p pol x | End e => End e end
  end.

End Numbers.

Arguments problem : clear implicits.
Arguments point : clear implicits.
Arguments state : clear implicits.
Arguments Problem {F}.
Arguments Going {T} x.
Arguments End {T} e.

(* ---- Runs ------------------------------------------------------------------------------------------------------ *)

Definition never_ends {F : field} (p : problem F) pol := forall k, exists x, drives p pol k = Going x.

(* The outer state of readings.md, 2: sets, forces as numbers, and the contact driven last. *)
Definition same_state (x y : state rationals) :=
  Forall2 Qeq (f (point_of x)) (f (point_of y)) /\ sets (point_of x) = sets (point_of y) /\ last x = last y.

(* Every value of the nine switches: 1,536. *)
Definition all_policies : list policy :=
  flat_map (fun s => flat_map (fun r => flat_map (fun ad => flat_map (fun fi => flat_map (fun gu =>
  flat_map (fun dr => flat_map (fun re => flat_map (fun ti => map (fun ap =>
    Policy s r ad fi gu dr re ti ap)
  [kept; suspended_at_apex]) [by_sets; by_contacts]) [rescan; continue]) [drop_contact; drop_variable])
  [first; previous; second]) [unfiled; filed_at_scan]) [lazy; eager]) [restart; round])
  [lowest; normals_first; most_violated; highest].

(* ---- The law --------------------------------------------------------------------------------------------------- *)

Local Open Scope Q_scope.

Fixpoint sum (n : nat) (g : nat -> Q) : Q := match n with O => 0 | S n => sum n g + g n end.
Definition entry (M : list (list Q)) i j := nth j (nth i M []) 0.

Definition symmetric n M := forall i j, (i < n)%nat -> (j < n)%nat -> entry M i j == entry M j i.
Definition quadratic n M (x : nat -> Q) := sum n (fun i => x i * sum n (fun j => entry M i j * x j)).
Definition positive_definite n M := forall x, (exists i, (i < n)%nat /\ ~ x i == 0) -> 0 < quadratic n M x.

(* n contacts: A is 2n x 2n, b has 2n components, mu >= 0. *)
Definition well_formed (p : problem rationals) :=
  length (b p) = (2 * length (mu p))%nat /\ length (A p) = length (b p) /\
  (forall r, In r (A p) -> length r = length (b p)) /\ (forall m, In m (mu p) -> 0 <= m).

(* Forces f that meet (15) and (16) at every contact c, with a = A f + b; rows N1 F1 N2 F2 ...
   SameLaw.v: this law is that of existence/Law.v, over Q. *)
Definition law (m fN fF aN aF : Q) :=
  (0 <= fN /\ 0 <= aN /\ fN * aN == 0) /\                                                          (* (15) *)
  (Qabs fF <= m * fN /\ aF * fF <= 0 /\ aF * (m * fN - Qabs fF) == 0).                             (* (16) *)
Definition solution (p : problem rationals) (g : list Q) :=
  let f i := nth i g 0 in
  let a i := sum (length (b p)) (fun j => entry (A p) i j * f j) + nth i (b p) 0 in
  forall c, (c < length (mu p))%nat ->
    law (nth c (mu p) 0) (f (2 * c)%nat) (f (S (2 * c))) (a (2 * c)%nat) (a (S (2 * c))).

(* All eigenvalues of a symmetric M are between l and u, strictly: u I - M and M - l I are positive definite. *)
Definition shifted n (c d : Q) (M : list (list Q)) : list (list Q) :=                      (* c M + d I *)
  map (fun i => map (fun j => c * entry M i j + (if Nat.eqb i j then d else 0)) (seq 0 n)) (seq 0 n).
Definition condition_below n M c := exists l u, 0 < l /\ u == c * l /\
  positive_definite n (shifted n 1 (- l) M) /\ positive_definite n (shifted n (-(1)) u M).

(* ---- The problems ---------------------------------------------------------------------------------------------- *)

(* corpus/cycle-every-policy-mu-1.json *)
Definition headline : problem rationals := Problem
    [[(3 # 1); (-4 # 1); (2 # 1); (0 # 1)];
     [(-4 # 1); (7 # 1); (-4 # 1); (1 # 1)];
     [(2 # 1); (-4 # 1); (7 # 1); (-6 # 1)];
     [(0 # 1); (1 # 1); (-6 # 1); (7 # 1)]]
    [(-1 # 1); (0 # 1); (0 # 1); (-2 # 1)]
    [(1 # 1); (1 # 1)].

(* corpus/endless/without-repetition.json, under resume=round *)
Definition endless_problem : problem rationals := Problem
    [[2; 0; -(2); 3; 1; 0];
     [0; 4; -(1); 0; 0; 0];
     [-(2); -(1); 10; -(1); 4; -(11)];
     [3; 0; -(1); 10; 2; -(4)];
     [1; 0; 4; 2; 4; -(7)];
     [0; 0; -(11); -(4); -(7); 16]]
    [0; 0; -(1); 4; -(1); 0] [1; 1; 1].
Definition endless_policy := Policy lowest round lazy unfiled first drop_contact rescan by_sets kept.

(* search/adversary/frontiers.md, 4, at mu = 1: two contacts. The condition number of the matrix tends to
   K(1) = 3 + 2 sqrt(2) as eta tends to 0; below K(1) there are no folds. *)
Definition matrix (eta : Q) : list (list Q) :=
  [[1; 1 + eta; 0; 4 * eta];
   [1 + eta; 3; - (4 * eta); 0];
   [0; - (4 * eta); 1; 1 + eta];
   [4 * eta; 0; 1 + eta; 3]].
Definition member (eta : Q) : problem rationals := Problem (matrix eta) [eta; 1; - eta; 1] [1; 1].

(* ---- The statements -------------------------------------------------------------------------------------------- *)

(* n rows. A is symmetric positive definite; a solution exists; under every policy the run never ends
   (the state after k drives is there for every k), and no state between two drives is a solution. *)
Definition loops_under_every_policy n (p : problem rationals) :=
  well_formed p /\ symmetric n (A p) /\ positive_definite n (A p) /\ (exists g, solution p g) /\
  (forall pol, forall k, exists x, drives p pol k = Going x /\ ~ solution p (f (point_of x))).
Definition headline_loops := loops_under_every_policy 4 headline.
(* The same, under these policies. *)
Definition loops_under_policies policies n (p : problem rationals) :=
  well_formed p /\ symmetric n (A p) /\ positive_definite n (A p) /\ (exists g, solution p g) /\
  (forall pol, In pol policies -> forall k, exists x, drives p pol k = Going x /\ ~ solution p (f (point_of x))).

Definition policies_complete := forall pol, In pol all_policies.
Definition policies_counted := length all_policies = 1536%nat /\ NoDup all_policies.

(* The run never ends, and no state stands twice. *)
Definition endless_run_without_repetition :=
  well_formed endless_problem /\ symmetric 6 (A endless_problem) /\ positive_definite 6 (A endless_problem) /\
  (forall k, exists x, drives endless_problem endless_policy k = Going x) /\
  (forall i j x y, (i < j)%nat -> drives endless_problem endless_policy i = Going x ->
    drives endless_problem endless_policy j = Going y -> ~ same_state x y).

(* For every c > K(1) (that is, c > 1 and c + 1/c > 6) all members with a small eta have a condition number below c,
   and loop. *)
Definition loops_near_K (policies : policy -> Prop) := forall c, 1 < c -> 6 < c + / c -> exists eta0, 0 < eta0 /\
  forall eta, 0 < eta < eta0 -> well_formed (member eta) /\ symmetric 4 (A (member eta)) /\
    condition_below 4 (A (member eta)) c /\ forall pol, policies pol -> never_ends (member eta) pol.
Definition paper_loops_near_K := loops_near_K (fun pol => pol = paper).
Definition every_policy_loops_near_K := loops_near_K (fun _ => True).
