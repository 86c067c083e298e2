(* SPDX-License-Identifier: Apache-2.0 *)
(* Checks of witnesses by computation over Q, and proofs that they are right: who finds one of them `true` has the claim
   of Statement.v. The witnesses are those of certify/certificates.md. *)
From Coq Require Import QArith.
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Stiction.claims Require Import Numbers Statement.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

(* ---- Vectors over R ---- *)

Section Vectors.
Variable R : realFieldType.
Implicit Types (x y u v : seq R) (M : seq (seq R)).

(* M'y: y times the rows *)
Fixpoint combine n M y : seq R := match M, y with
  | row :: M, c :: y => plus [seq c * u | u <- row] (combine n M y)
  | _, _ => nseq n 0 end.

Lemma dot_nil x : dot x [::] = 0. Proof. by case: x. Qed.
Lemma dotC x y : dot x y = dot y x.
Proof. by elim: x y => [|u x IH] [|v y] //=; rewrite IH mulrC. Qed.
Lemma dot_split k x y : dot x y = dot (take k x) (take k y) + dot (drop k x) (drop k y).
Proof.
elim: k x y => [|k IH] [|u x] [|v y]; rewrite /= ?add0r ?dot_nil //; by rewrite (IH x y) addrA.
Qed.
Lemma dot_zeros n x : dot (nseq n 0) x = 0.
Proof. by elim: n x => [|n IH] [|u x] //=; rewrite IH mul0r addr0. Qed.
Lemma dot_plus x u v : size u = size v -> dot x (plus u v) = dot x u + dot x v.
Proof.
elim: x u v => [|w x IH] [|s u] [|t v] //=; rewrite ?addr0 // => -[e].
by rewrite /plus /= -/(plus u v) IH //; ring.
Qed.
Lemma dot_scale c x y : dot [seq c * u | u <- x] y = c * dot x y.
Proof. by elim: x y => [|u x IH] [|v y] /=; rewrite ?mulr0 // IH; ring. Qed.
Lemma size_plus x y : size (plus x y) = minn (size x) (size y).
Proof. by rewrite size_map size_zip. Qed.
Lemma size_combine n M y : all (fun row => size row == n) M -> size (combine n M y) = n.
Proof.
elim: M y => [|row M IH] [|c y] /=; rewrite ?size_nseq // => /andP [/eqP e h].
by rewrite size_plus size_map IH // e minnn.
Qed.
Lemma dot_times n M x y : all (fun row => size row == n) M -> dot y (times M x) = dot (combine n M y) x.
Proof.
elim: M y => [|row M IH] [|c y] /=; rewrite ?dot_zeros // => /andP [/eqP e h].
by rewrite (dotC (plus _ _)) dot_plus ?size_map ?size_combine // IH // !(dotC x) dot_scale.
Qed.
Lemma dot_zero x y : is_zero y -> dot x y = 0.
Proof.
elim: x y => [|u x IH] [|v y] //= z; rewrite (z v) ?mem_head // IH ?mulr0 ?addr0 // => w wy.
by apply: z; rewrite inE wy orbT.
Qed.

Lemma square_ge0 (s : R) : 0 <= s * s. Proof. by rewrite -expr2 sqr_ge0. Qed.
Lemma dot_ge0 x : 0 <= dot x x.
Proof. by elim: x => [|u x IH] //=; rewrite addr_ge0 ?square_ge0. Qed.
Lemma dot_eq0 x : dot x x <= 0 -> is_zero x.
Proof.
elim: x => [|u x IH] //= h; have s := square_ge0 u; have d := dot_ge0 x.
have u0 : u = 0.
  apply/eqP; have : u * u <= 0 by apply: le_trans h; rewrite ler_addl.
  by move=> l; have /eqP : u * u = 0 by [apply/eqP; rewrite eq_le l s]; rewrite mulf_eq0 orbb.
move=> w; rewrite inE => /orP [/eqP -> //|]; apply: IH; apply: le_trans h; by rewrite ler_addr.
Qed.
Lemma le_of_squares (s t : R) : 0 <= t -> s * s <= t * t -> s <= t.
Proof.
move=> t0 h; rewrite leNgt; apply/negP => ts; move: h; rewrite leNgt => /negP; apply.
apply: le_lt_trans (_ : t * s < _); first by rewrite ler_wpmul2l // ltW.
by rewrite ltr_pmul2r //; exact: le_lt_trans ts.
Qed.
(* (x.y)^2 <= (x.x) (y.y) *)
Lemma schwarz x y : dot x y * dot x y <= dot x x * dot y y.
Proof.
elim: x y => [|u x IH] [|v y] /=; rewrite ?mul0r ?mulr0 //.
have := IH y; set s := dot x y; set X := dot x x; set Y := dot y y => h.
have X0 : 0 <= X := dot_ge0 x; have Y0 : 0 <= Y := dot_ge0 y.
have cross : 2%:R * (u * v * s) <= u * u * Y + v * v * X.
  apply: le_of_squares; first by rewrite addr_ge0 // mulr_ge0 // square_ge0.
  rewrite -subr_ge0; have -> : (u * u * Y + v * v * X) * (u * u * Y + v * v * X) -
      2%:R * (u * v * s) * (2%:R * (u * v * s)) =
    (u * u * Y - v * v * X) * (u * u * Y - v * v * X) + 4%:R * (u * v) * (u * v) * (X * Y - s * s) by ring.
  rewrite addr_ge0 ?square_ge0 // mulr_ge0 ?subr_ge0 // -mulrA mulr_ge0 ?ler0n ?square_ge0 //.
rewrite -subr_ge0; have -> : (u * u + X) * (v * v + Y) - (u * v + s) * (u * v + s) =
  (u * u * Y + v * v * X - 2%:R * (u * v * s)) + (X * Y - s * s) by ring.
by rewrite addr_ge0 // subr_ge0.
Qed.
(* forces in a friction cone against what is in its dual *)
Lemma cones_meet (m gN vN : R) gF vF : 0 <= gN -> m * m * dot gF gF <= gN * gN ->
  0 <= vN -> dot vF vF <= (m * vN) * (m * vN) -> 0 <= gN * vN + dot gF vF.
Proof.
move=> g0 g v0 v; rewrite -[dot gF vF]opprK subr_ge0; apply: le_of_squares; first exact: mulr_ge0.
rewrite mulrNN; apply: le_trans (schwarz gF vF) _.
apply: le_trans (_ : dot gF gF * ((m * vN) * (m * vN)) <= _); first by rewrite ler_wpmul2l ?dot_ge0.
have -> : dot gF gF * (m * vN * (m * vN)) = m * m * dot gF gF * (vN * vN) by ring.
have -> : gN * vN * (gN * vN) = gN * gN * (vN * vN) by ring.
by rewrite ler_wpmul2r ?square_ge0.
Qed.
End Vectors.

(* ---- Vectors over Q, for computing, in lowest terms ---- *)

Definition qplus (x y : seq Q) : seq Q := [seq Qred (uv.1 + uv.2)%coq_Q | uv <- zip x y].
Definition qscale c (x : seq Q) : seq Q := [seq Qred (c * u)%coq_Q | u <- x].
Fixpoint qdot (x y : seq Q) : Q := match x, y with
  | u :: x, v :: y => Qred (u * v + qdot x y)%coq_Q
  | _, _ => 0%coq_Q end.
Definition qtimes (M : seq (seq Q)) x : seq Q := [seq qdot row x | row <- M].
Fixpoint qcombine n (M : seq (seq Q)) y : seq Q := match M, y with
  | row :: M, c :: y => qplus (qscale c row) (qcombine n M y)
  | _, _ => nseq n 0%coq_Q end.
Definition qzero (x : seq Q) := all (fun u => Qeq_bool u 0) x.
Definition qsame (x y : seq Q) := (size x == size y) && all (fun uv => Qeq_bool uv.1 uv.2) (zip x y).

Arguments Qred : simpl never. Arguments Qmult : simpl never. Arguments Qplus : simpl never.
Arguments of_Q : simpl never.
Section Transfer.
Variable R : realFieldType.
Notation Q2R := (of_Q R).
Notation real := (real R).
Lemma of_Qred q : Q2R (Qred q) = Q2R q. Proof. by apply/of_Q_eq; exact: Qred_correct. Qed.
Lemma le_real x y : Qle_bool x y -> Q2R x <= Q2R y. Proof. by move/Qle_bool_iff/(of_Q_le R). Qed.
Lemma ge0_real x : Qle_bool 0 x -> 0 <= Q2R x. Proof. by move/le_real; rewrite of_Q0. Qed.
Lemma le0_real x : Qle_bool x 0 -> Q2R x <= 0. Proof. by move/le_real; rewrite of_Q0. Qed.
Lemma eq_real x y : Qeq_bool x y -> Q2R x = Q2R y. Proof. by move/Qeq_bool_iff/(of_Q_eq R). Qed.
Lemma eq0_real x : Qeq_bool x 0 -> Q2R x = 0. Proof. by move/eq_real; rewrite of_Q0. Qed.
Lemma real_plus x y : real (qplus x y) = plus (real x) (real y).
Proof.
elim: x y => [|u x IH] [|v y] //; apply: (congr2 cons); [by rewrite of_Qred of_QD | exact: IH].
Qed.
Lemma real_scale c x : real (qscale c x) = [seq Q2R c * u | u <- real x].
Proof. by elim: x => [|u x IH] //=; rewrite IH of_Qred of_QM. Qed.
Lemma real_dot x y : Q2R (qdot x y) = dot (real x) (real y).
Proof. by elim: x y => [|u x IH] [|v y] /=; rewrite ?of_Q0 // of_Qred of_QD of_QM IH. Qed.
Lemma real_times M x : real (qtimes M x) = times (real_matrix R M) (real x).
Proof. by elim: M => [|row M IH] //; apply: (congr2 cons); [exact: real_dot | exact: IH]. Qed.
Lemma real_combine n M y : real (qcombine n M y) = combine n (real_matrix R M) (real y).
Proof.
elim: M y => [|row M IH] [|c y] /=; rewrite ?[LHS]map_nseq ?of_Q0 //.
by rewrite real_plus real_scale IH.
Qed.
Lemma real_zero x : qzero x -> is_zero (real x).
Proof.
elim: x => [|u x IH] //= /andP [/eq0_real e z] w; rewrite inE => /orP [/eqP -> //|]; exact: IH.
Qed.
Lemma real_same x y : qsame x y -> real x = real y.
Proof.
case/andP; elim: x y => [|u x IH] [|v y] //= e /andP [/eq_real -> h]; by rewrite (IH y).
Qed.
Lemma real_take k x : real (take k x) = take k (real x). Proof. exact: map_take. Qed.
Lemma real_drop k x : real (drop k x) = drop k (real x). Proof. exact: map_drop. Qed.
Lemma size_real x : size (real x) = size x. Proof. exact: size_map. Qed.
Lemma rows_real n M : all (fun row => size row == n) M -> all (fun row => size row == n) (real_matrix R M).
Proof. by elim: M => [|row M IH] //= /andP [/eqP e h]; rewrite size_map e eqxx IH. Qed.
End Transfer.

(* ---- A problem is one ---- *)

Definition check_contact d c := match c with
  | Static mu => Qle_bool 0 mu
  | Sliding mu slip => [&& Qle_bool 0 mu, size slip == d.-1 & Qeq_bool (qdot slip slip) 1]
  | _ => true end.
Definition check_well_formed p :=
  [&& (dimension p == 2%N) || (dimension p == 3%N), size (A p) == rows p, size (b p) == rows p,
      all (fun row => size row == rows p) (A p) & all (check_contact (dimension p)) (contacts p)].
Lemma all_in T (P : T -> bool) s : all P s -> forall x, List.In x s -> P x.
Proof. by elim: s => [|y s IH] //= /andP [h hs] x [<- //|]; exact: IH. Qed.
Lemma check_well_formed_sound p : check_well_formed p -> well_formed p.
Proof.
case/and5P => d /eqP sA /eqP sb rs cs; split=> //.
- by case/orP: d => /eqP ->; [left | right].
- by move=> row /(all_in rs) /eqP.
- move=> c /(all_in cs); case: c => //= [mu /Qle_bool_iff //|mu slip /and3P [/Qle_bool_iff h1 /eqP h2 h3]].
  by split=> //; rewrite -real_dot (eq_real _ h3) /of_Q /of_Z /= divr1.
Qed.

Fixpoint all_contacts d (check : contact -> Q -> seq Q -> Q -> seq Q -> bool) (cs : seq contact) (x y : seq Q) : bool :=
  match cs, x, y with
  | c :: cs, xN :: x, yN :: y =>
    let k := frictions d c in check c xN (take k x) yN (take k y) && all_contacts d check cs (drop k x) (drop k y)
  | [::], _, _ => true
  | _, _, _ => false
  end.
Lemma all_contacts_sound (R : realFieldType) d (check : contact -> Q -> seq Q -> Q -> seq Q -> bool)
    (P : contact -> R -> seq R -> R -> seq R -> Prop) :
  (forall c xN xF yN yF, check c xN xF yN yF -> P c (of_Q R xN) (real R xF) (of_Q R yN) (real R yF)) ->
  forall cs x y, all_contacts d check cs x y -> at_every_contact d P cs (real R x) (real R y).
Proof.
move=> h; elim=> [|c cs IH] // [|xN x] [|yN y] //= /andP [hc hs].
by rewrite -!real_take -!real_drop; split; [exact: h | exact: IH].
Qed.

(* ---- solution-exists ---- *)

Definition qdoes_not_sink fN aN := [&& Qle_bool 0 fN, Qle_bool 0 aN & Qeq_bool (fN * aN) 0].
Definition solves c fN fF aN aF := match c with
  | Bilateral => Qeq_bool aN 0
  | Frictionless => qdoes_not_sink fN aN
  | Static mu => let limit := (mu * fN)%coq_Q in
    [&& qdoes_not_sink fN aN, Qle_bool (qdot fF fF) (limit * limit), Qle_bool (qdot fF aF) 0 &
        qzero aF || Qeq_bool (qdot fF fF) (limit * limit)]
  | Sliding mu slip => qdoes_not_sink fN aN && qsame fF (qscale (- (mu * fN)) slip)
  end.
Lemma sink (R : realFieldType) xN yN : qdoes_not_sink xN yN -> does_not_sink (of_Q R xN) (of_Q R yN).
Proof. by case/and3P => /(@ge0_real R) h1 /(@ge0_real R) h2 /(@eq0_real R); rewrite of_QM; split. Qed.
Lemma solves_sound (R : realFieldType) c fN fF aN aF :
  solves c fN fF aN aF -> law c (of_Q R fN) (real R fF) (of_Q R aN) (real R aF).
Proof.
case: c => [|| mu | mu slip] /=.
- exact: eq0_real.
- exact: sink.
- case/and4P => /(@sink R) h1 /(@le_real R) h2 /(@le0_real R) h3 h4; rewrite real_dot in h3.
  rewrite real_dot !of_QM in h2; split=> //.
  case/orP: h4 => [/(@real_zero R) z|/(@eq_real R) e]; [by left | by right; rewrite -real_dot e !of_QM].
- case/andP => /(@sink R) h1 /(@real_same R) ->; split=> //; rewrite real_scale; apply: eq_map => u.
  by rewrite of_QN of_QM mulNr.
Qed.
Definition check_solution p f :=
  [&& check_well_formed p, size f == rows p &
      all_contacts (dimension p) solves (contacts p) f (qplus (qtimes (A p) f) (b p))].
Theorem solution_holds p f : check_solution p f -> solution_exists p.
Proof.
case/and3P => w /eqP s h; split; first exact: check_well_formed_sound.
move=> R; exists (real R f); split; first by rewrite size_real.
rewrite -real_times -real_plus; apply: all_contacts_sound h; exact: solves_sound.
Qed.

(* ---- coulomb-solution ---- *)

Definition solves_up_to k c fN fF aN aF := match c with
  | Static mu => let limit := (mu * fN)%coq_Q in let least := (k * limit)%coq_Q in let power := qdot fF aF in
    [&& qdoes_not_sink fN aN, Qle_bool (qdot fF fF) (limit * limit), Qle_bool power 0 &
        Qle_bool (least * least * qdot aF aF) (power * power)]
  | _ => solves c fN fF aN aF
  end.
Lemma solves_up_to_sound (R : realFieldType) k c fN fF aN aF :
  solves_up_to k c fN fF aN aF -> coulomb_up_to k c (of_Q R fN) (real R fF) (of_Q R aN) (real R aF).
Proof.
case: c => [|| mu | mu slip] /=; [exact: eq0_real | exact: sink | | exact: (@solves_sound R (Sliding mu slip))].
case/and4P => /(@sink R) h1 /(@le_real R) h2 /(@le0_real R) h3 /(@le_real R) h4.
by rewrite real_dot !of_QM in h2; rewrite real_dot in h3; rewrite !of_QM !real_dot in h4; split.
Qed.
Definition check_coulomb p k f :=
  [&& check_well_formed p, dimension p == 3%N, ~~ Qle_bool k 0, Qle_bool k 1, size f == rows p &
      all_contacts (dimension p) (solves_up_to k) (contacts p) f (qplus (qtimes (A p) f) (b p))].
Theorem coulomb_solution_holds p k f : check_coulomb p k f -> coulomb_solution_exists k p.
Proof.
case/and4P => w /eqP d k0 /and3P [k1 /eqP s h]; split=> //; first exact: check_well_formed_sound.
  split; last exact/Qle_bool_iff.
  by case: (Qlt_le_dec 0 k) => // /Qle_bool_iff e; rewrite e in k0.
move=> R; exists (real R f); split; first by rewrite size_real.
rewrite -real_times -real_plus; apply: all_contacts_sound h; exact: solves_up_to_sound.
Qed.

(* ---- psd: A = L D L', D >= 0 ---- *)

Definition by_entry (x y : seq Q) : seq Q := [seq Qred (uv.1 * uv.2)%coq_Q | uv <- zip x y].
Definition check_psd p L D :=
  [&& check_well_formed p, size L == rows p, all (fun row => size row == rows p) L, size D == rows p,
      all (Qle_bool 0) D &
      all (fun ri => qsame ri.1 (qtimes L (by_entry D ri.2))) (zip (A p) L)].
Section Factors.
Variable R : realFieldType.
Implicit Types (x y z : seq R).
Definition entries x y : seq R := [seq uv.1 * uv.2 | uv <- zip x y].
Lemma real_entries (x y : seq Q) : real R (by_entry x y) = entries (real R x) (real R y).
Proof.
elim: x y => [|u x IH] [|v y] //; apply: (congr2 cons); [by rewrite of_Qred of_QM | exact: IH].
Qed.
Lemma dot_entries x y z : dot (entries x y) z = dot y (entries x z).
Proof.
elim: x y z => [|u x IH] [|v y] [|w z] //=; rewrite ?dot_nil //.
by rewrite /entries /= -/(entries _ _) -/(entries _ _) IH; ring.
Qed.
Lemma entries_ge0 x z : all (fun u => 0 <= u) x -> 0 <= dot z (entries x z).
Proof.
elim: x z => [|u x IH] [|w z] //= /andP [h hs]; rewrite /entries /= -/(entries _ _) addr_ge0 ?IH //.
by rewrite mulrCA mulr_ge0 ?square_ge0.
Qed.
(* L'x.(D L'y) *)
Lemma factored_dot n (B L : seq (seq Q)) D x y : size B = size L -> all (fun row => size row == n) L ->
  all (fun ri => qsame ri.1 (qtimes L (by_entry D ri.2))) (zip B L) ->
  dot x (times (real_matrix R B) y) =
  dot (combine n (real_matrix R L) x) (entries (real R D) (combine n (real_matrix R L) y)).
Proof.
move=> sB sL h; rewrite -dot_times ?rows_real //; congr dot; move: {1 3 4}(L) sB h => M.
elim: B M => [|row B IH] [|li M] //= [sB] /andP [/(@real_same R) e hs].
rewrite (IH M) //; congr cons.
by rewrite e real_times dotC (dot_times _ _ (rows_real R sL)) dotC real_entries dot_entries.
Qed.
End Factors.
Theorem psd_holds p L D : check_psd p L D -> positive_semidefinite p.
Proof.
case/and5P => w /eqP sL rL /eqP sD /andP [D0 h]; split; first exact: check_well_formed_sound.
have sA : size (A p) = size L by case/and5P: w => _ /eqP ->.
move=> R x y sx sy; rewrite !(factored_dot (n := rows p) _ _ sA rL h); split.
  by rewrite -dot_entries dotC.
by apply: entries_ge0; elim: D D0 {sD h} => [|u D IH] //= /andP [/(@ge0_real R) -> hD]; exact: IH.
Qed.

(* ---- h: b - A'y is in the dual cones ---- *)

Definition in_dual c (gN : Q) (gF : seq Q) (_ : Q) (_ : seq Q) := match c with
  | Bilateral => Qeq_bool gN 0
  | Frictionless => Qle_bool 0 gN
  | Static mu => Qle_bool 0 gN && Qle_bool (mu * mu * qdot gF gF) (gN * gN)
  | Sliding _ _ => false end.
Definition check_H p y := let g := qplus (b p) (qcombine (rows p) (A p) (qscale (-1) y)) in
  [&& check_well_formed p & all_contacts (dimension p) in_dual (contacts p) g g].
Section Dual.
Variable R : realFieldType.
Lemma dual_contact d c gN gF (vN : R) vF s t : size vF = frictions d c ->
  in_dual c gN gF s t -> in_cone c vN vF -> 0 <= of_Q R gN * vN + dot (real R gF) vF.
Proof.
case: c => [|| mu | mu slip] //=.
- move=> /size0nil -> /(@eq0_real R) ->; by rewrite mul0r dot_nil addr0.
- move=> /size0nil -> /(@ge0_real R) h1 h2; by rewrite dot_nil addr0 mulr_ge0.
- move=> _ /andP [/(@ge0_real R) h1 /(@le_real R) h2] [h3 h4].
  by apply: (@cones_meet _ (of_Q R mu)) => //; rewrite -real_dot -!of_QM.
Qed.
Definition rows_of d (cs : seq contact) : nat := sumn [seq (frictions d c).+1 | c <- cs].
Lemma split_size d c cs (x : seq R) : (size x).+1 = rows_of d (c :: cs) ->
  size (take (frictions d c) x) = frictions d c /\ size (drop (frictions d c) x) = rows_of d cs.
Proof.
rewrite /rows_of /= addSn => -[e]; rewrite size_drop e addKn; split=> //; apply: size_takel; by rewrite e leq_addr.
Qed.
Lemma dual_sound d cs g (v : seq R) : size v = rows_of d cs ->
  all_contacts d in_dual cs g g -> at_every_contact d (fun c vN vF _ _ => in_cone c vN vF) cs v v ->
  0 <= dot (real R g) v.
Proof.
elim: cs g v => [|c cs IH] [|gN g] [|vN v] //= sv; rewrite ?lexx //.
move=> /andP [hg hs] [hv vs]; have [s1 s2] := split_size sv.
rewrite (dot_split (frictions d c) (map _ g)) addrA -map_take -map_drop; apply: addr_ge0.
  exact: dual_contact s1 hg hv.
exact: IH.
Qed.
End Dual.
Theorem H_holds p y : check_H p y -> hypothesis_H p.
Proof.
case/andP => w h; have W := check_well_formed_sound w; split; [exact: W | split].
  move: h; set g := qplus _ _; elim: (contacts p) g => [|c cs IH] //= [|gN g] //= /andP [hc hs] c' [<-|].
    by move: hc => {hs}; case: c.
  exact: IH hs c'.
move=> R v sv vK Av; case: W => _ sA sb rs _.
have rA : all (fun row => size row == rows p) (A p) by case/and5P: w.
have := dual_sound sv h vK; rewrite real_plus real_combine real_scale dotC dot_plus; last first.
  by rewrite size_real sb size_combine // rows_real.
by rewrite (dotC v (combine _ _ _)) -dot_times ?rows_real // (dot_zero _ Av) addr0 dotC.
Qed.

(* ---- no-solution: every word of contact modes begins with a prefix that a Farkas vector y refutes ---- *)

Inductive mode := Hold | Break | Touch | Stick | SlipPlus | SlipMinus.
Scheme Equality for mode.
Definition modes_of d c := match c with
  | Bilateral => [:: Hold]
  | Static mu => if (d == 2%N) && ~~ Qle_bool mu 0 then [:: Break; Stick; SlipPlus; SlipMinus] else [:: Break; Touch]
  | _ => [:: Break; Touch] end.

(* yN aN + yF.aF - (gN fN + gF.fF) is not negative where the contact is in the mode *)
Definition outside_cone mu gN gF := Qle_bool gN 0 && Qle_bool (mu * mu * qdot gF gF) (gN * gN).
Definition never_negative c m (yN : Q) (yF : seq Q) (gN : Q) (gF : seq Q) := match m, c with
  | Hold, _ => Qeq_bool gN 0
  | Break, _ => Qle_bool 0 yN && qzero yF
  | Touch, Static mu => qzero yF && outside_cone mu gN gF
  | Touch, Sliding mu slip => qzero yF && Qle_bool gN (mu * qdot slip gF)
  | Touch, _ => Qle_bool gN 0
  | Stick, Static mu => outside_cone mu gN gF
  | SlipPlus, Static mu => if (yF, gF) is ([:: yT], [:: gT]) then Qle_bool gN (mu * gT) && Qle_bool 0 yT else false
  | SlipMinus, Static mu => if (yF, gF) is ([:: yT], [:: gT]) then Qle_bool gN (- (mu * gT)) && Qle_bool yT 0 else false
  | _, _ => false end.
Fixpoint terms d cs (w : seq mode) (y g : seq Q) : bool := match cs, y, g with
  | c :: cs, yN :: y, gN :: g =>
    let k := frictions d c in let holds m := never_negative c m yN (take k y) gN (take k g) in
    (if w is m :: _ then holds m else all holds (modes_of d c)) && terms d cs (behead w) (drop k y) (drop k g)
  | [::], _, _ => true
  | _, _, _ => false end.
Definition refutes p w y :=
  ~~ Qle_bool 0 (qdot y (b p)) && terms (dimension p) (contacts p) w y (qcombine (rows p) (A p) y).

(* a refutation: prefixes with their y; those behind a mode *)
Notation prefixes := (seq (seq mode * seq Q)).
Definition behind m (l : prefixes) : prefixes :=
  [seq (behead e.1, e.2) | e <- l & if e.1 is m' :: _ then mode_beq m m' else false].
Definition whole (l : prefixes) := [seq e.2 | e <- l & nilp e.1].
Fixpoint covered p (cs : seq contact) w (l : prefixes) : bool :=
  if whole l is y :: _ then refutes p w y
  else if cs is c :: cs then all (fun m => covered p cs (rcons w m) (behind m l)) (modes_of (dimension p) c) else false.
Definition check_no_solution p l := check_well_formed p && covered p (contacts p) [::] l.

Section Modes.
Variable R : realFieldType.
Implicit Types (f a fF aF : seq R) (fN aN : R).
Definition in_mode c m fN fF aN aF : Prop := match m, c with
  | Hold, Bilateral => aN = 0
  | Break, _ => [/\ fN = 0, is_zero fF & 0 <= aN]
  | Touch, Frictionless => 0 <= fN /\ aN = 0
  | Touch, Static mu => [/\ 0 <= fN, aN = 0 & dot fF fF <= (of_Q R mu * fN) * (of_Q R mu * fN)]
  | Touch, Sliding mu slip => [/\ 0 <= fN, aN = 0 & fF = [seq - (of_Q R mu * fN * u) | u <- real R slip]]
  | Stick, Static mu => [/\ 0 <= fN, aN = 0, is_zero aF & dot fF fF <= (of_Q R mu * fN) * (of_Q R mu * fN)]
  | SlipPlus, Static mu => exists s, [/\ 0 <= fN, aN = 0, fF = [:: - (of_Q R mu * fN)], aF = [:: s] & 0 <= s]
  | SlipMinus, Static mu => exists s, [/\ 0 <= fN, aN = 0, fF = [:: of_Q R mu * fN], aF = [:: s] & s <= 0]
  | _, _ => False end.

Lemma is_zero_nil : is_zero ([::] : seq R). Proof. by []. Qed.
Lemma size1 T (x : seq T) : size x = 1%N -> exists u, x = [:: u].
Proof. by case: x => [|u [|v x]] // _; exists u. Qed.
Lemma law_in_mode d c fN fF aN aF : size fF = frictions d c -> size aF = frictions d c -> law c fN fF aN aF ->
  exists2 m, List.In m (modes_of d c) & in_mode c m fN fF aN aF.
Proof.
have either (x y : R) : x * y = 0 -> x = 0 \/ y = 0.
  by move/eqP; rewrite mulf_eq0 => /orP [/eqP|/eqP]; [left | right].
case: c => [|| mu | mu slip] /= sf sa.
- by move=> h; exists Hold; [left | exact: h].
- case=> h1 h2 /either [e|e]; first by exists Break; [left | split=> //; rewrite (size0nil sf)].
  by exists Touch; [right; left | split].
- case=> -[h1 h2 h3] h4 h5 h6.
  have broken : fN = 0 -> in_mode (Static mu) Break fN fF aN aF.
    by move=> e; split=> //; apply: dot_eq0; move: h4; rewrite e mulr0 mul0r.
  case: ifP => [/andP [/eqP d2 /negP m0]|_]; last first.
    by case: (either _ _ h3) => e; [exists Break; [left | exact: broken] | exists Touch; [right; left | split]].
  have [f0|f0] := eqVneq fN 0; first by exists Break; [left | exact: broken].
  have a0 : aN = 0 by case: (either _ _ h3) => // e; rewrite e eqxx in f0.
  case: h6 => [z|slips]; first by exists Stick; [right; left | split].
  rewrite d2 in sf sa; have [t et] := size1 sf; have [s es] := size1 sa.
  move: h5 slips; rewrite et es /= !addr0 => h5 slips.
  have limit : 0 < of_Q R mu * fN.
    rewrite mulr_gt0 //; last by rewrite lt_neqAle eq_sym f0.
    rewrite ltNge; apply/negP; rewrite -(of_Q0 R) => /of_Q_le h; apply: m0; exact/Qle_bool_iff.
  have /either [e|e] : (t + of_Q R mu * fN) * (t - of_Q R mu * fN) = 0 by rewrite mulrC -subr_sqr !expr2 slips subrr.
    have {e} e : t = - (of_Q R mu * fN) by apply/eqP; rewrite -addr_eq0 e.
    exists SlipPlus; first by right; right; left.
    by exists s; split; rewrite ?e //; move: h5; rewrite e mulNr oppr_le0 pmulr_rge0.
  have {e} e : t = of_Q R mu * fN by apply/eqP; rewrite -subr_eq0 e.
  exists SlipMinus; first by right; right; right; left.
  by exists s; split; rewrite ?e //; move: h5; rewrite e pmulr_rle0.
- case=> -[h1 h2 /either [e|e]] hf; last by exists Touch; [right; left | split].
  exists Break; [by left | split=> //]; move=> u; rewrite hf => /mapP [v _ ->]; by rewrite e mulr0 mul0r oppr0.
Qed.

Lemma never_negative_sound d c m yN yF gN gF fN fF aN aF : size fF = frictions d c -> size aF = frictions d c ->
  never_negative c m yN yF gN gF -> in_mode c m fN fF aN aF ->
  0 <= of_Q R yN * aN + dot (real R yF) aF - (of_Q R gN * fN + dot (real R gF) fF).
Proof.
move=> sf sa.
have cone mu : outside_cone mu gN gF -> 0 <= fN -> dot fF fF <= (of_Q R mu * fN) * (of_Q R mu * fN) ->
    0 <= - (of_Q R gN * fN + dot (real R gF) fF).
  case/andP => /(@le0_real R) h1 /(@le_real R) h2 f0 h3.
  have -> : - (of_Q R gN * fN + dot (real R gF) fF) =
            (- of_Q R gN) * fN + dot [seq -1 * u | u <- real R gF] fF by rewrite dot_scale; ring.
  apply: (@cones_meet _ (of_Q R mu)) => //; first by rewrite oppr_ge0.
  rewrite dot_scale dotC dot_scale (_ : _ * _ = of_Q R mu * of_Q R mu * dot (real R gF) (real R gF)); last by ring.
  rewrite (_ : - of_Q R gN * - of_Q R gN = of_Q R gN * of_Q R gN); last by ring.
  by rewrite -real_dot -!of_QM.
have zeroed : qzero yF -> dot (real R yF) aF = 0 by move=> z; rewrite dotC dot_zero //; exact: real_zero.
case: m => /=.
- case: c sf sa => //= sf sa /(@eq0_real R) -> ->.
  by rewrite (size0nil sf) (size0nil sa) !dot_nil mulr0 mul0r !addr0 subr0.
- move=> /andP [/(@ge0_real R) h1 /zeroed ->] [-> z h2]; by rewrite (dot_zero _ z) mulr0 !addr0 subr0 mulr_ge0.
- case: c sf sa => [|| mu | mu slip] //= sf sa.
  + move=> /(@le0_real R) h [f0 ->].
    by rewrite (size0nil sf) (size0nil sa) !dot_nil mulr0 !addr0 add0r oppr_ge0 mulr_le0_ge0.
  + by move=> /andP [/zeroed -> h] [f0 -> hf]; rewrite mulr0 addr0 add0r; exact: cone h f0 hf.
  + move=> /andP [/zeroed -> /(@le_real R)]; rewrite of_QM real_dot => h [f0 -> ->].
    rewrite mulr0 addr0 add0r.
    have -> : [seq - (of_Q R mu * fN * u) | u <- real R slip] = [seq - (of_Q R mu * fN) * u | u <- real R slip].
      by apply: eq_map => u; rewrite mulNr.
    rewrite (dotC (real R gF)) dot_scale; rewrite -subr_ge0 in h.
    move: h; set D := dot _ _ => h; have -> : - (of_Q R gN * fN + - (of_Q R mu * fN) * D) =
      (of_Q R mu * D - of_Q R gN) * fN by ring.
    by rewrite mulr_ge0.
- case: c sf sa => [|| mu | mu slip] //= sf sa h [f0 -> z hf].
  rewrite (dot_zero _ z) mulr0 addr0 add0r; exact: cone h f0 hf.
- case: c sf sa => [|| mu | mu slip] //= sf sa; case: yF zeroed => [|yT [|]] // _; case: gF cone => [|gT [|]] // _.
  move=> /andP [/(@le_real R) h1 /(@ge0_real R) h2] [s [f0 -> -> -> s0]] /=; rewrite of_QM -subr_ge0 in h1.
  rewrite (_ : _ - _ = of_Q R yT * s + (of_Q R mu * of_Q R gT - of_Q R gN) * fN); last by ring.
  by rewrite addr_ge0 // mulr_ge0.
- case: c sf sa => [|| mu | mu slip] //= sf sa; case: yF zeroed => [|yT [|]] // _; case: gF cone => [|gT [|]] // _.
  move=> /andP [/(@le_real R) h1 /(@le0_real R) h2] [s [f0 -> -> -> s0]] /=; rewrite of_QN of_QM -subr_ge0 in h1.
  rewrite (_ : _ - _ = of_Q R yT * s + (- (of_Q R mu * of_Q R gT) - of_Q R gN) * fN); last by ring.
  by apply: addr_ge0; [exact: mulr_le0 | exact: mulr_ge0].
Qed.

(* the first contacts are in the modes of w, the others obey the law *)
Fixpoint realizes d cs (w : seq mode) f a {struct w} : Prop := if w is m :: w then match cs, f, a with
  | c :: cs, fN :: f, aN :: a =>
    let k := frictions d c in in_mode c m fN (take k f) aN (take k a) /\ realizes d cs w (drop k f) (drop k a)
  | _, _, _ => False end else at_every_contact d (@law R) cs f a.

Lemma terms_sound d cs w y g f a : size f = rows_of d cs -> size a = rows_of d cs ->
  realizes d cs w f a -> terms d cs w y g -> 0 <= dot (real R y) a - dot (real R g) f.
Proof.
elim: cs w y g f a => [|c cs IH] w y g f a sf sa.
  by rewrite (size0nil sf) (size0nil sa) !dot_nil subrr.
case: f a sf sa => [|fN f] [|aN a] // sf sa; case: y g => [|yN y] [|gN g] //.
have [sf1 sf2] := split_size sf; have [sa1 sa2] := split_size sa; move=> r /andP [t ts] /=.
set k := frictions d c in sf1 sf2 sa1 sa2 r t ts.
rewrite (dot_split k (map _ y)) (dot_split k (map _ g)) -!map_take -!map_drop.
have [m [hm hn] hr] : exists2 m, in_mode c m fN (take k f) aN (take k a) /\
    never_negative c m yN (take k y) gN (take k g) & realizes d cs (behead w) (drop k f) (drop k a).
  case: w r t {ts} => [|m w] /=; last by case=> h1 h2 h3; exists m.
  case=> h1 h2 h3; have [m hm1 hm2] := law_in_mode sf1 sa1 h1; exists m => //; split=> //; exact: all_in h3 m hm1.
have first := never_negative_sound sf1 sa1 hn hm; have others := IH _ _ _ _ _ sf2 sa2 hr ts.
rewrite (_ : _ - _ = (of_Q R yN * aN + dot (real R (take k y)) (take k a)
    - (of_Q R gN * fN + dot (real R (take k g)) (take k f)))
  + (dot (real R (drop k y)) (drop k a) - dot (real R (drop k g)) (drop k f))); last by rewrite /real; ring.
exact: addr_ge0.
Qed.

Lemma realizes_next d cs w c rest f a : size f = rows_of d cs -> size a = rows_of d cs ->
  drop (size w) cs = c :: rest ->
  realizes d cs w f a -> exists2 m, List.In m (modes_of d c) & realizes d cs (rcons w m) f a.
Proof.
elim: w cs f a => [|m w IH] [|c' cs] [|fN f] [|aN a] //= sf sa; have [sf1 sf2] := split_size sf;
  have [sa1 sa2] := split_size sa.
  move=> -[e _] [h1 h2]; rewrite -e; have [m hm1 hm2] := law_in_mode sf1 sa1 h1; by exists m.
move=> e [h1 h2]; have [m' hm1 hm2] := IH _ _ _ sf2 sa2 e h2; by exists m'.
Qed.
End Modes.

Theorem no_solution_holds p l : check_no_solution p l -> no_solution p.
Proof.
case/andP => w h; split; first exact: check_well_formed_sound.
have rA : all (fun row => size row == rows p) (A p) by case/and5P: w.
have sA : size (A p) = rows p by case/and5P: w => _ /eqP.
have sb : size (b p) = rows p by case/and5P: w => _ _ /eqP.
move=> R f [sf]; set a := plus _ _ => law_f.
have sa : size a = rows p by rewrite size_plus !size_map sA sb minnn.
have not_refuted v y : realizes (dimension p) (contacts p) v f a -> ~~ refutes p v y.
  move=> r; apply/negP => /andP [/negP neg t]; have := terms_sound sf sa r t.
  rewrite real_combine -dot_times ?rows_real // dot_plus ?size_map ?sA ?sb // addrAC subrr add0r -real_dot -(of_Q0 R).
  by move/of_Q_le/Qle_bool_iff.
suff no cs v k : drop (size v) (contacts p) = cs -> covered p cs v k ->
    realizes (dimension p) (contacts p) v f a -> False.
  by apply: (no (contacts p) [::] l); rewrite /= ?drop0.
elim: cs v k => [|c cs IH] v k e /=; case: (whole k) => [|y _] // hk r; try by case/negP: (not_refuted v y r).
have [m hm1 hm2] := realizes_next sf sa e r.
apply: (IH (rcons v m) (behind m k)) => //; last exact: all_in hk m hm1.
by rewrite size_rcons -add1n -drop_drop e /= drop0.
Qed.
