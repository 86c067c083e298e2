(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves of complete driving (Statement.v), for b without ties: every end of a piece has one partner along the piece
   and one on the next piece, but for the first end and for solutions; so no piece comes twice, and the run ends at a
   solution. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.existence Require Import Law Dot.
From Stiction.driving Require Import Statement Path Piece Local.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Driving.
Variables (R : realFieldType) (n : nat) (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R).
Notation vec := 'cV[R]_(n + n).
Notation acc := (Law.acc A b).
Notation aN := (Law.aN A b).
Notation aF := (Law.aF A b).
Notation solution := (Law.solution A b mu).
Notation in_cones := (Law.in_cones mu).
Notation xN := (@Law.xN R n).
Notation xF := (@Law.xF R n).
Notation upd := (@Statement.upd n).
Notation rise := (@Statement.rise n).
Notation enter := (@Statement.enter n).
Notation prev := (@Statement.prev n).
Notation down := (@Statement.down R n).
Notation word := (Statement.word n).
Notation ends := (Statement.ends n).
Notation piece := (Statement.piece mu).
Notation drv := (Statement.drv mu).
Notation rowf := (Statement.rowf A mu).
Notation constf := (Statement.constf b).
Notation E := (Statement.E A mu).
Notation e := (Statement.e b).
Notation G := (Statement.G A mu).
Notation h := (Statement.h b).
Notation is_end := (Statement.is_end A b mu).
Notation point := (Statement.point A b mu).
Notation along := (Statement.along A b mu).
Notation next := (Statement.next A b).
Notation up := (Statement.up A b).
Notation over_at := (Statement.over_at A b mu).
Notation over := (Statement.over A b mu).
Notation first := (Statement.first A b).
Notation drive := (Statement.drive A b mu).

(* ---- equations and points ---- *)
Lemma rowf0 c j (v : vec) : (rowf c j *m v) 0 0 = ev (mu j) (xN v j) (xF v j) (xN (A *m v) j) (xF (A *m v) j) c.
Proof.
case: c => /=; rewrite ?mul0mx ?mulNmx ?mulmxDl ?mulmxBl ?mulNmx -?scalemxAl -?rowE -?row_mul ?mxE //.
- by rewrite /Law.xN mxE.
- by rewrite /Law.xN mxE.
- by rewrite /Law.xF mxE.
- by rewrite /Law.xF mxE.
Qed.
Lemma rowfE c j (f : vec) : (rowf c j *m f) 0 0 + constf c j = ev (mu j) (xN f j) (xF f j) (aN f j) (aF f j) c.
Proof.
have hN : aN f j = xN (A *m f) j + b (lshift n j) 0 by rewrite /Law.aN /Law.xN mxE.
have hF : aF f j = xF (A *m f) j + b (rshift n j) 0 by rewrite /Law.aF /Law.xF mxE.
by rewrite rowf0 hN hF; case: c => /=; rewrite ?addr0 // opprD.
Qed.
Lemma valE p x f : val (G p) (h p) x f = lval (mu x.1) (xN f x.1) (xF f x.1) (aN f x.1) (aF f x.1) (p x.1) x.2.
Proof.
by rewrite /val /lin /Statement.G /Statement.h /lval; case: ineq => [c|]; rewrite ?rowfE // mul0mx mxE add0r.
Qed.
Lemma rowM (u : 'I_n -> 'rV[R]_(n + n)) (f : vec) j : (\matrix_(i < n) u i *m f) j 0 = (u j *m f) 0 0.
Proof. by rewrite mxE [RHS]mxE; apply: eq_bigr => k _; rewrite mxE. Qed.
Lemma EE p (f : vec) : E p *m f = e p <-> forall j, on (mu j) (xN f j) (xF f j) (aN f j) (aF f j) (p j).
Proof.
have r (c : 'I_n -> form) j : ((\matrix_(j < n) rowf (c j) j *m f) j 0 == - constf (c j) j) =
    (ev (mu j) (xN f j) (xF f j) (aN f j) (aF f j) (c j) == 0).
  by rewrite -rowfE addr_eq0 rowM.
have r1 := r (fun j => eq1 (p j)); have r2 := r (fun j => eq2 (p j)); rewrite /= in r1 r2.
rewrite /Statement.E /Statement.e mul_col_mx; split=> [/eq_col_mx [e1 e2] j|ok].
  by rewrite /on -r1 -r2 e1 e2 !mxE !eqxx.
congr col_mx; apply/matrixP => j k; rewrite ord1 [RHS]mxE; apply/eqP; [rewrite r1 | rewrite r2];
  by have /andP [] := ok j.
Qed.
Lemma EE0 p (v : vec) : E p *m v = 0 -> forall j, on (mu j) (xN v j) (xF v j) (xN (A *m v) j) (xF (A *m v) j) (p j).
Proof.
have r (c : 'I_n -> form) j : ((\matrix_(j < n) rowf (c j) j *m v) j 0) =
    ev (mu j) (xN v j) (xF v j) (xN (A *m v) j) (xF (A *m v) j) (c j).
  by rewrite -rowf0 rowM.
have r1 := r (fun j => eq1 (p j)); have r2 := r (fun j => eq2 (p j)); rewrite /= in r1 r2.
rewrite /Statement.E mul_col_mx -col_mx0 => /eq_col_mx [e1 e2] j.
by rewrite /on -r1 -r2 e1 e2 !mxE !eqxx.
Qed.
(* the point f is end (j, k) of p *)
Definition V (p : word) j k f := fac (mu j) (xN f j) (xF f j) (aN f j) (aF f j) (p j) k /\
  forall t, t != j -> inn (mu t) (xN f t) (xF f t) (aN f t) (aF f t) (p t).
Lemma isendE p j k f : isend (E p) (e p) (G p) (h p) (j, k) f <-> V p j k f.
Proof.
split=> [[/EE o z pos]|[/and5P [o z a1 a2 a3] inns]].
  split=> [|t tj].
    rewrite /fac o -(valE p (j, k)) z eqxx /=; apply/and3P; split; apply/orP.
    - by case: (altP (k =P s0)) => [|ks]; [left | right; rewrite -(valE p (j, s0)) pos // xpair_eqE eqxx eq_sym].
    - by case: (altP (k =P s1)) => [|ks]; [left | right; rewrite -(valE p (j, s1)) pos // xpair_eqE eqxx eq_sym].
    - by case: (altP (k =P s2)) => [|ks]; [left | right; rewrite -(valE p (j, s2)) pos // xpair_eqE eqxx eq_sym].
  by rewrite /inn o -(valE p (t, s0)) -(valE p (t, s1)) -(valE p (t, s2)) !pos // xpair_eqE negb_and tj.
split.
- by apply/EE => t; case: (altP (t =P j)) => [->|/inns /and4P []].
- by rewrite valE /= (eqP z).
- move=> [t k']; rewrite xpair_eqE negb_and valE /=; case: (altP (t =P j)) => [->|tj _] /=.
    by case: k' => [[]|] /negbTE; rewrite eq_sym => kk; [move: a3 | move: a2 | move: a1]; rewrite kk.
  by have /and4P [_ b1 b2 b3] := inns t tj; case: k' => [[]|].
Qed.
Lemma zero_row p i : piece p i -> row (rshift n i) (E p) = 0.
Proof.
case/and4P=> d _ _ _; rewrite /Statement.E rowKd rowK; by case: (p i) d.
Qed.
Lemma piece_uniq p i j : piece p i -> piece p j -> i = j.
Proof.
move=> /and4P [di fi li _] /and4P [dj fj lj _]; apply/val_inj; case: (ltngtP i j) => // lt.
- by have /implyP /(_ lt) := forallP fj i; case: (p i) di.
- by have /implyP /(_ lt) := forallP fi j; case: (p j) dj.
Qed.
Lemma drvE p i : piece p i -> drv p = Some i.
Proof. by rewrite /Statement.drv => pi; case: pickP => [j pj|/(_ i)]; [rewrite (piece_uniq pi pj) | rewrite pi]. Qed.

(* ---- hypotheses ---- *)
Hypothesis mu0 : forall i, 0 <= mu i.
(* b is nondegenerate: of the equations fN = 0, fF = 0, abs fF = mu fN, aN = 0, aF = 0 of the contacts no more hold
   anywhere than there are unknowns (fN = fF = 0 counts for two) *)
Notation count f j := (cnt (mu j) (xN f j) (xF f j) (aN f j) (aF f j)).
Hypothesis generic : forall f, (\sum_j count f j <= n + n)%N.
(* no v in the cones has v.Av <= 0, but for A symmetric v with A v = 0 and b.v > 0 *)
Hypothesis cone : forall v, in_cones v -> v != 0 -> dotp v (A *m v) <= 0 -> A^T *m v = 0 /\ 0 < dotp v b.

(* ---- counting ---- *)
Lemma need_sum p i : piece p i -> ((\sum_j need (p j)).+1 = n + n)%N.
Proof.
move=> /and4P [d f l _]; rewrite (bigD1 i) //= /need d addnC addnS addn0.
rewrite (eq_bigr (fun _ => 2%N)) => [|t ti].
  have n0 : (0 < n)%N := leq_ltn_trans (leq0n _) (ltn_ord i).
  by rewrite sum_nat_const cardC1 card_ord muln2 -doubleS prednK // addnn.
suff -> : driven (p t) = false by [].
case: (ltngtP t i) => lt; last by move/eqP: ti; case; apply/val_inj.
- by have /implyP /(_ lt) := forallP f t; case: (p t).
- by have /implyP /(_ lt) /eqP -> := forallP l t.
Qed.
Definition zs (p : word) f j : nat := addn (addn (zeros (mu j) (xN f j) (xF f j) (aN f j) (aF f j) (p j) s0)
  (zeros (mu j) (xN f j) (xF f j) (aN f j) (aF f j) (p j) s1))
  (zeros (mu j) (xN f j) (xF f j) (aN f j) (aF f j) (p j) s2).
Lemma need_zs p i f : piece p i -> E p *m f = e p -> forall j, (need (p j) + zs p f j <= count f j)%N.
Proof.
move=> /and4P [_ _ _ /forallP o] /EE Ef j; have := cnt_on (o j) (Ef j); by rewrite /zs !addnA.
Qed.
Lemma zs_sum p i f : piece p i -> E p *m f = e p -> (\sum_j zs p f j <= 1)%N.
Proof.
move=> pi Ef; have le : (\sum_j (need (p j) + zs p f j) <= n + n)%N.
  by apply: leq_trans (generic f); apply: leq_sum => j _; exact: need_zs pi Ef j.
by move: le; rewrite big_split /= -(need_sum pi) -addn1 leq_add2l.
Qed.
Lemma nd p i : piece p i -> forall f, E p *m f = e p -> (forall x, 0 <= val (G p) (h p) x f) ->
  forall x y, val (G p) (h p) x f = 0 -> val (G p) (h p) y f = 0 -> x = y.
Proof.
move=> pi f Ef _ [j k] [j' k'] /eqP zx /eqP zy; apply/eqP; apply: contraT => ne.
have := zs_sum pi Ef; rewrite valE /= in zx; rewrite valE /= in zy.
have big (j1 : 'I_n) k1 : lval (mu j1) (xN f j1) (xF f j1) (aN f j1) (aF f j1) (p j1) k1 == 0 -> (0 < zs p f j1)%N.
  by rewrite /zs /zeros => z; case: k1 z => [[]|] ->; rewrite ?addn1 ?addSn ?addnS.
case: (altP (j =P j')) => [ej|jj].
  rewrite -ej in zy ne; rewrite xpair_eqE eqxx /= in ne.
  have : (1 < zs p f j)%N.
    rewrite /zs /zeros; case: k zx ne => [[]|] zx ne; case: k' zy ne => [[]|] zy ne //; rewrite zx zy //;
    by rewrite ?addn1 ?addSn ?addnS.
  rewrite (bigD1 j) //= => lt le; have := leq_trans (leq_addr _ _) le; by rewrite leqNgt lt.
rewrite (bigD1 j) //= (bigD1 j') 1?eq_sym //= addnA => le.
have := leq_trans (leq_addr _ _) le; have := leq_add (big _ _ zx) (big _ _ zy) => l1 l2.
by have := leq_trans l1 l2.
Qed.
(* at an end nothing else vanishes *)
Lemma exact_count p i j k f : piece p i -> V p j k f ->
  (count f j <= (need (p j)).+1)%N /\ forall t, t != j -> (count f t <= need (p t))%N.
Proof.
move=> pi v; have [Ef zf _] := proj2 (isendE p j k f) v.
have ge := need_zs pi Ef.
have gj : (need (p j) < count f j)%N.
  apply: leq_trans (ge j); rewrite -addn1 leq_add2l; move: zf; rewrite valE /= => /eqP.
  by rewrite /zs /zeros => z; case: k z {v} => [[]|] ->; rewrite ?addn1 ?addSn ?addnS.
have := generic f; rewrite -(need_sum pi) (bigD1 j) //= [X in (_ <= X.+1)%N](bigD1 j) //= => le.
have geS : (\sum_(t | t != j) need (p t) <= \sum_(t | t != j) count f t)%N.
  by apply: leq_sum => t _; apply: leq_trans (ge t); exact: leq_addr.
split.
  by have := leq_trans (leq_add (leqnn (count f j)) geS) le; rewrite -addSn leq_add2r.
move=> t tj; have le2 : (\sum_(s | s != j) count f s <= \sum_(s | s != j) need (p s))%N.
  by rewrite -(leq_add2l (need (p j)).+1); apply: leq_trans (leq_add gj (leqnn _)) _; rewrite addSn.
move: le2; rewrite (bigD1 t) //= [X in (_ <= X)%N](bigD1 t) //= => le2.
have geT : (\sum_(s | (s != j) && (s != t)) need (p s) <= \sum_(s | (s != j) && (s != t)) count f s)%N.
  by apply: leq_sum => s _; apply: leq_trans (ge s); exact: leq_addr.
by have := leq_trans (leq_add (leqnn (count f t)) geT) le2; rewrite leq_add2r.
Qed.

(* ---- no ray ---- *)
Lemma linE p x v : lin (G p) x v =
  hval (mu x.1) (xN v x.1) (xF v x.1) (xN (A *m v) x.1) (xF (A *m v) x.1) (p x.1) x.2.
Proof. by rewrite /lin /Statement.G /hval; case: ineq => [c|]; rewrite ?rowf0 // mul0mx mxE. Qed.
Lemma dotp_split (x y : vec) : dotp x y = \sum_j (xN x j * xN y j + xF x j * xF y j).
Proof. by rewrite /dotp big_split_ord /= -big_split. Qed.
Lemma sumr_le0 (g : 'I_n -> R) : (forall j, g j <= 0) -> \sum_j g j <= 0.
Proof. by move=> g0; rewrite -oppr_ge0 -sumrN sumr_ge0 // => j _; rewrite oppr_ge0. Qed.
Lemma noray p i : piece p i -> forall f, E p *m f = e p -> (forall x, 0 <= val (G p) (h p) x f) ->
  forall v, E p *m v = 0 -> (forall x, 0 <= lin (G p) x v) -> v = 0.
Proof.
move=> /and4P [_ _ _ /forallP o] f /EE Ef f0 v /EE0 Ev v0.
have cf j : closed (mu j) (xN f j) (xF f j) (aN f j) (aF f j) (p j).
  rewrite /closed Ef /=; have hl k : 0 <= hval (mu j) (xN f j) (xF f j) (aN f j) (aF f j) (p j) k.
    by have := f0 (j, k); rewrite valE /lval /hval /=; case: ineq.
  by rewrite !hl.
have cv j : closed (mu j) (xN v j) (xF v j) (xN (A *m v) j) (xF (A *m v) j) (p j).
  by rewrite /closed Ev /= -(linE p (j, s0)) -(linE p (j, s1)) -(linE p (j, s2)) !v0.
apply/eqP; apply: contraT => vn.
have vK : in_cones v by move=> j; exact: closedK (o j) (cv j).
have vAv : dotp v (A *m v) <= 0.
  by rewrite dotp_split; apply: sumr_le0 => j; exact: mono (o j) (cv j) (cv j).
have [Av bv] := cone vK vn vAv.
have : dotp v (acc f) <= 0 by rewrite dotp_split; apply: sumr_le0 => j; exact: mono (o j) (cv j) (cf j).
have vAf : dotp v (A *m f) = 0 by rewrite -[A]trmxK dotp_adj Av dotpC dotp0.
by rewrite /Law.acc dotpD vAf add0r leNgt bv.
Qed.
Lemma is_endP p i j k : piece p i -> reflect (exists f, V p j k f) (is_end (p, (j, k))).
Proof.
move=> pi; rewrite /Statement.is_end (drvE pi) /=.
apply: (iffP (isendP (zero_row pi) (nd pi) (noray pi) (j, k))) => -[f vf]; exists f; exact/isendE.
Qed.
Lemma pointE p i j k f : piece p i -> V p j k f -> point (p, (j, k)) = f.
Proof. by move=> pi /isendE v; rewrite /Statement.point (drvE pi) (candE (zero_row pi) (nd pi) (noray pi) v). Qed.
Lemma is_end_piece x : is_end x -> exists i, piece x.1 i.
Proof. by rewrite /Statement.is_end /Statement.drv; case: pickP => // i pi _; exists i. Qed.
Lemma is_end_V x : is_end x -> exists i, piece x.1 i /\ V x.1 x.2.1 x.2.2 (point x).
Proof.
case: x => p [j k] ex; have [i pi] := is_end_piece ex; exists i; split=> //.
have /(is_endP j k pi) [f v] := ex; by rewrite (pointE pi v).
Qed.

(* ---- along the piece ---- *)
Lemma alongP x : is_end x -> exists y, [/\ along x = Some y, y.1 = x.1, y.2 <> x.2, is_end y &
  forall z, is_end z -> z.1 = x.1 -> z = x \/ z = y].
Proof.
case: x => p u ex; have [i pi] := is_end_piece ex; rewrite /= in pi.
have eu : isendb (E p) (e p) (G p) (h p) (rshift n i) u by move: ex; rewrite /Statement.is_end (drvE pi).
have [k [pk ku ek only]] := pivotP (zero_row pi) (nd pi) (noray pi) eu.
exists (p, k); split=> //=; first by rewrite /Statement.along ex (drvE pi) /= pk.
- by apply/eqP.
- by rewrite /Statement.is_end (drvE pi).
move=> [p' u'] ez /= pp; rewrite pp /Statement.is_end (drvE pi) /= in ez; rewrite pp.
by case: (only _ ez) => ->; [left | right].
Qed.

(* ---- over to the next ---- *)
Definition good p j k f (y : ends) := [/\ exists i', piece y.1 i', V y.1 y.2.1 y.2.2 f,
  over_at f y.1 y.2.1 y.2.2 = Some (p, (j, k)) & y.1 <> p].
Lemma updj p j t : upd p j t j = t. Proof. by rewrite ffunE eqxx. Qed.
Lemma upd_upd p j t : upd (upd p j t) j (p j) = p.
Proof. by apply/ffunP => s; rewrite !ffunE; case: eqP => // ->. Qed.
Lemma piece_upd p i j t : piece p i -> driven t = driven (p j) -> finished t = finished (p j) -> ok (mu j) t ->
  piece (upd p j t) i.
Proof.
move=> /and4P [d /forallP f /forallP l /forallP o] ed ef ot; apply/and4P; split.
- by rewrite ffunE; case: eqP => // e1; rewrite ed -e1.
- by apply/forallP => s; rewrite ffunE; case: eqP => // ->; rewrite ef.
- apply/forallP => s; rewrite ffunE; case: (s =P j) => // ->; apply/implyP => lt; have /implyP /(_ lt) /eqP e1 := l j.
  by move: ed ef; rewrite e1; case: t ot.
- by apply/forallP => s; rewrite ffunE; case: eqP => // ->.
Qed.
Lemma cross p i j k f t k' : piece p i -> V p j k f -> driven t = driven (p j) -> finished t = finished (p j) ->
  ok (mu j) t ->
  fac (mu j) (xN f j) (xF f j) (aN f j) (aF f j) t k' -> t <> p j ->
  over_at f (upd p j t) j k' = Some (upd (upd p j t) j (p j), (j, k)) -> good p j k f (upd p j t, (j, k')).
Proof.
move=> pi [_ v] ed ef ot ft tp ov; split=> /=.
- by exists i; exact: piece_upd.
- split; first by rewrite updj.
  by move=> s sj; rewrite ffunE (negbTE sj); exact: v.
- by rewrite ov upd_upd.
- by move=> e1; apply: tp; rewrite -e1 updj.
Qed.
Lemma nextP f (i i' : 'I_n) :
  reflect [/\ (i < i')%N, aN f i' < 0 & forall s : 'I_n, (i < s < i')%N -> 0 <= aN f s] (next f i == Some i').
Proof.
apply: (iffP eqP); rewrite /Statement.next.
  by case: pickP => // t /and3P [a1 a2 /forallP a3] [<-]; split=> // s lt; exact: (implyP (a3 s)).
move=> [a1 a2 a3]; case: pickP => [t /and3P [b1 b2 /forallP b3]|/(_ i')]; last first.
  by rewrite a1 a2 /= => /forallP; case=> s; apply/implyP/a3.
congr Some; apply/val_inj; case: (ltngtP t i') => // lt.
- by have := a3 t; rewrite b1 lt leNgt b2 => /(_ isT).
- by have := b3 i'; rewrite a1 lt /= leNgt a2.
Qed.
Lemma prevP (p : word) (i j : 'I_n) :
  reflect [/\ (j < i)%N, p j <> cB & forall s : 'I_n, (j < s < i)%N -> p s = cB] (prev p i == Some j).
Proof.
apply: (iffP eqP); rewrite /Statement.prev.
  by case: pickP => // t /and3P [a1 /eqP a2 /forallP a3] [<-]; split=> // s lt; apply/eqP; exact: (implyP (a3 s)).
move=> [a1 a2 a3]; case: pickP => [t /and3P [b1 /eqP b2 /forallP b3]|/(_ j)]; last first.
  by rewrite a1 (introN eqP a2) /= => /forallP; case=> s; apply/implyP => /a3 ->.
congr Some; apply/val_inj; case: (ltngtP t j) => // lt.
- by have := b3 j; rewrite a1 lt /= => /eqP.
- by have := a3 t; rewrite lt b1 => /(_ isT).
Qed.
Lemma ord_gt (i s : 'I_n) : (i < s)%N -> (s == i) = false. Proof. by move=> lt; rewrite -val_eqE /= gtn_eqF. Qed.
Lemma ord_lt (i s : 'I_n) : (s < i)%N -> (s == i) = false. Proof. by move=> lt; rewrite -val_eqE /= ltn_eqF. Qed.
Section Order.
Variables (p : word) (i i' : 'I_n) (c : loc).
Hypothesis ii : (i < i')%N.
Lemma rise_lt (s : 'I_n) : (s < i)%N -> rise p i c i' s = p s. Proof. by move=> lt; rewrite ffunE lt. Qed.
Lemma rise_i : rise p i c i' i = c. Proof. by rewrite ffunE ltnn eqxx. Qed.
Lemma rise_mid (s : 'I_n) : (i < s < i')%N -> rise p i c i' s = cB.
Proof. by move=> /andP [l1 l2]; rewrite ffunE ltnNge (ltnW l1) /= ord_gt // l2. Qed.
Lemma rise_i' : rise p i c i' i' = dN.
Proof. by rewrite ffunE ltnNge (ltnW ii) /= ltnn eqxx ord_gt. Qed.
Lemma rise_gt (s : 'I_n) : (i' < s)%N -> rise p i c i' s = Later.
Proof.
move=> lt; have l1 := ltn_trans ii lt; rewrite ffunE ltnNge (ltnW l1) /= ltnNge (ltnW lt) /=.
by rewrite !ord_gt.
Qed.
Inductive five (s : 'I_n) : Prop :=
  Lt of (s < i)%N | At of s = i | Mid of (i < s < i')%N | At' of s = i' | Gt of (i' < s)%N.
Lemma order5 (s : 'I_n) : five s.
Proof.
case: (ltngtP s i) => l1; [by constructor 1| |by constructor 2; apply/val_inj].
case: (ltngtP s i') => l2; [|by constructor 5|by constructor 4; apply/val_inj].
by constructor 3; rewrite l1 l2.
Qed.
End Order.
Lemma enter_lt p (i : 'I_n) t (s : 'I_n) : (s < i)%N -> enter p i t s = p s.
Proof. by move=> lt; rewrite ffunE lt. Qed.
Lemma enter_i p (i : 'I_n) t : enter p i t i = t. Proof. by rewrite ffunE ltnn eqxx. Qed.
Lemma enter_gt p (i : 'I_n) t (s : 'I_n) : (i < s)%N -> enter p i t s = Later.
Proof. by move=> lt; rewrite ffunE ltnNge (ltnW lt) /= ord_gt. Qed.

Lemma later_neq p (i : 'I_n) k f (s : 'I_n) : piece p i -> V p i k f -> (i < s)%N ->
  [/\ xN f s = 0, xF f s = 0 & aN f s != 0].
Proof.
move=> pi v lt; have /and4P [_ _ /forallP l _] := pi; have /implyP /(_ lt) /eqP ps := l s.
have si : s != i by rewrite ord_gt.
have := proj2 v s si; rewrite ps iO => /andP [/eqP z1 /eqP z2]; split=> //.
have := proj2 (exact_count pi v) s si; rewrite ps z1 z2 /cnt eqxx /=; by case: eqP.
Qed.
Lemma up_ok p i k c f y : piece p i -> V p i k f -> inn (mu i) (xN f i) (xF f i) (aN f i) (aF f i) c ->
  finished c -> c <> cB ->
  ok (mu i) c -> up f p i c = Some y -> exists i', let p' := rise p i c i' in
  [/\ y = (p', (i', s0)), piece p' i', V p' i' s0 f
    & [/\ prev p' i' = Some i, enter p' i (p i) = p, p' i = c, p' i' = dN & p' <> p]].
Proof.
move=> pi v ic fc cb oc; rewrite /Statement.up; case ei: (next f i) => [i'|] // [<-].
have /and4P [d /forallP fin /forallP l /forallP o] := pi.
have [ii neg mid] := nextP f i i' (introT eqP ei); exists i' => /=.
have lat (s : 'I_n) : (i < s)%N -> p s = Later by move=> lt; exact/eqP/(implyP (l s)).
split=> //.
- apply/and4P; split; first by rewrite rise_i'.
  + apply/forallP => s; apply/implyP => lt; case: (order5 i i' s) => h1.
    * by rewrite rise_lt //; exact: (implyP (fin s)).
    * by rewrite h1 rise_i.
    * by rewrite rise_mid.
    * by rewrite h1 ltnn in lt.
    * by have := ltn_trans lt h1; rewrite ltnn.
  + by apply/forallP => s; apply/implyP => lt; rewrite rise_gt.
  + apply/forallP => s; case: (order5 i i' s) => h1.
    * by rewrite rise_lt.
    * by rewrite h1 rise_i.
    * by rewrite rise_mid //=; exact: mu0.
    * by rewrite h1 rise_i' //=; exact: mu0.
    * by rewrite rise_gt //=; exact: mu0.
- split.
    have [z1 z2 _] := later_neq pi v ii; by rewrite rise_i' // fN0 z1 z2 eqxx neg.
  move=> s si'; case: (order5 i i' s) => h1.
  + by rewrite rise_lt //; apply: (proj2 v); rewrite ord_lt.
  + by rewrite h1 rise_i.
  + rewrite rise_mid //; have [z1 z2 z3] := later_neq pi v (proj1 (andP h1)).
    by rewrite iB z1 z2 eqxx lt_neqAle eq_sym z3 mid.
  + by rewrite h1 eqxx in si'.
  + rewrite rise_gt // -(lat s (ltn_trans ii h1)); apply: (proj2 v); by rewrite ord_gt // (ltn_trans ii).
split.
- by apply/eqP/prevP; split=> // [|s]; rewrite ?rise_i // => /rise_mid ->.
- apply/ffunP => s; case: (ltngtP s i) => h1; first by rewrite enter_lt ?rise_lt.
    by rewrite enter_gt // lat.
  by have -> : s = i; [exact/val_inj | rewrite enter_i].
- by rewrite rise_i.
- by rewrite rise_i'.
- by move=> e1; have := lat i' ii; rewrite -e1 rise_i'.
Qed.
Lemma down_ok p i j f t k : piece p i -> V p i s0 f -> p i = dN -> prev p i = Some j -> driven t -> ok (mu j) t ->
  fac (mu j) (xN f j) (xF f j) (aN f j) (aF f j) t k -> let p' := enter p j t in
  [/\ piece p' j, V p' j k f, next f j = Some i & [/\ rise p' j (p j) i = p, p' j = t & p' <> p]].
Proof.
move=> pi v pd /eqP /prevP [ji pj mid] dt ot ft p'; rewrite /p'.
have /and4P [d /forallP fin /forallP l /forallP o] := pi.
have lat (s : 'I_n) : (i < s)%N -> p s = Later by move=> lt; exact/eqP/(implyP (l s)).
have innB (s : 'I_n) : (j < s < i)%N -> [&& xN f s == 0, xF f s == 0 & 0 < aN f s].
  move=> jsi; have si : s != i by rewrite ord_lt //; case/andP: jsi.
  by have := proj2 v s si; rewrite mid // iB.
have vi : [&& xN f i == 0, xF f i == 0 & aN f i < 0] by have := proj1 v; rewrite pd fN0.
split.
- apply/and4P; split; first by rewrite enter_i.
  + apply/forallP => s; apply/implyP => lt; rewrite enter_lt //; exact: (implyP (fin s)) (ltn_trans lt ji).
  + by apply/forallP => s; apply/implyP => lt; rewrite enter_gt.
  + apply/forallP => s; case: (ltngtP s j) => h1.
    * by rewrite enter_lt.
    * by rewrite enter_gt //=; exact: mu0.
    * by rewrite (val_inj h1) enter_i.
- split; first by rewrite enter_i.
  move=> s sj; case: (order5 j i s) => h1.
  + by rewrite enter_lt //; apply: (proj2 v); rewrite ord_lt // (ltn_trans h1).
  + by rewrite h1 eqxx in sj.
  + rewrite enter_gt; last by case/andP: h1.
    by rewrite iO; have /and3P [-> -> _] := innB s h1.
  + by rewrite h1 enter_gt // iO; have /and3P [-> -> _] := vi.
  + rewrite enter_gt ?(ltn_trans ji) // -(lat s h1); apply: (proj2 v); by rewrite ord_gt.
- apply/eqP/nextP; split=> //; first by case/and3P: vi.
  by move=> s jsi; have /and3P [_ _ /ltW] := innB s jsi.
split.
- apply/ffunP => s; case: (order5 j i s) => h1.
  + by rewrite rise_lt // enter_lt.
  + by rewrite h1 rise_i.
  + by rewrite rise_mid // mid.
  + by rewrite h1 rise_i' // pd.
  + by rewrite rise_gt // lat.
- by rewrite enter_i.
- by move=> e1; have /implyP /(_ ji) := fin j; rewrite -e1 enter_i; case: (t) dt.
Qed.
Lemma driven_at p i j : piece p i -> driven (p j) -> j = i.
Proof.
move=> /and4P [_ /forallP f /forallP l _] dj; apply/val_inj; case: (ltngtP j i) => // lt.
- by have /implyP /(_ lt) := f j; case: (p j) dj.
- by have /implyP /(_ lt) /eqP e1 := l j; rewrite e1 in dj.
Qed.
Lemma up_good p i j k f c y : piece p i -> V p j k f -> j = i -> finished c -> c <> cB -> ok (mu i) c ->
  inn (mu i) (xN f i) (xF f i) (aN f i) (aF f i) c ->
  (match c with cS => if 0 < xF f i then (dP, s2) else (dM, s2) | cP => (dP, s1) | cM => (dM, s1) | _ => (dN, s1)
   end) = (p i, k) ->
  up f p j c = Some y -> good p j k f y.
Proof.
move=> pi v ji fc cb oc ic back; rewrite ji in v *; move=> u.
have [i' [-> pp vv [pr en ri ri' ne]]] := up_ok pi v ic fc cb oc u; split=> //=; first by exists i'.
rewrite /Statement.over_at ri' /Statement.down pr ri; move: (rise p i c i') en => r en {oc ic u pp vv pr ri ri' ne}.
case: c back fc cb => //=; first by case: ifP => _ [e1 e2]; rewrite e1 e2 en.
- by case=> e1 e2; rewrite e1 e2 en.
- by case=> e1 e2; rewrite e1 e2 en.
- by case=> e1 e2; rewrite e1 e2 en.
Qed.
Lemma down_good p i j j' f t k : piece p i -> V p j s0 f -> j = i -> p i = dN -> prev p j = Some j' -> driven t ->
  ok (mu j') t ->
  fac (mu j') (xN f j') (xF f j') (aN f j') (aF f j') t k ->
  over_at f (enter p j' t) j' k = up f (enter p j' t) j' (p j') -> good p j s0 f (enter p j' t, (j', k)).
Proof.
move=> pi v ji; rewrite ji in v * => pd pr dt ot ft ov.
have [pp vv nx [ri en ne]] := down_ok pi v pd pr dt ot ft; split=> //=; first by exists j'.
by rewrite ov /Statement.up nx ri.
Qed.
Lemma over_ok p i j k f y : piece p i -> V p j k f -> over_at f p j k = Some y -> good p j k f y.
Proof.
move=> pi v; have [vj vo] := v; have [cj co] := exact_count pi v.
have o : forall s, ok (mu s) (p s) by have /and4P [_ _ _ /forallP] := pi.
have oj := o j; have dj := @driven_at p i j pi.
rewrite /Statement.over_at; case pj: (p j) vj oj cj dj => vj oj cj dj.
- move: vj; rewrite fB => /and4P [/eqP ks /eqP z1 /eqP z2 /eqP z3]; rewrite ks in v *.
  have an : aF f j != 0 by move: cj; rewrite /cnt z1 z2 z3 eqxx /=; case: eqP.
  case: (altP (mu j =P 0)) => [m0|m0].
    by move=> [<-]; apply: (cross pi v); rewrite ?pj //= ?m0 ?fZ ?z1 ?z2 ?z3 ?eqxx // /Statement.over_at updj ?pj.
  have m1 : 0 < mu j by rewrite lt_neqAle eq_sym m0 mu0.
  case: (ltP (aF f j) 0) => ag [<-]; apply: (cross pi v); rewrite ?pj //=.
  + by rewrite fP0 z1 z2 z3 eqxx.
  + by rewrite /Statement.over_at updj ?pj.
  + by rewrite fM0 z1 z2 z3 eqxx lt_neqAle eq_sym an.
  + by rewrite /Statement.over_at updj ?pj.
- case: k v vj => [[]|] v vj; first by rewrite fS2 in vj.
  + move: vj; rewrite fS1 // => vj [<-]; apply: (cross pi v); rewrite ?pj //= ?fM1 // /Statement.over_at updj ?pj //.
  + move: vj; rewrite fS0 // => vj [<-]; apply: (cross pi v); rewrite ?pj //= ?fP1 // /Statement.over_at updj ?pj //.
- case: k v vj => [[]|] v vj; first by rewrite fP2 in vj.
  + move: vj; rewrite fP1 => vj [<-]; apply: (cross pi v); rewrite ?pj //= ?fS0 // /Statement.over_at updj ?pj //.
  + move: vj; rewrite fP0 => /and4P [z1 z2 z3 ag] [<-]; apply: (cross pi v); rewrite ?pj //= ?fB ?z1 ?z2 ?z3 //.
    by rewrite /Statement.over_at updj ?pj ag gt_eqF.
- case: k v vj => [[]|] v vj; first by rewrite fM2 in vj.
  + move: vj; rewrite fM1 => vj [<-]; apply: (cross pi v); rewrite ?pj //= ?fS1 // /Statement.over_at updj ?pj //.
  + move: vj; rewrite fM0 => /and4P [z1 z2 z3 ag] [<-]; apply: (cross pi v); rewrite ?pj //= ?fB ?z1 ?z2 ?z3 //.
    by rewrite /Statement.over_at updj ?pj ltNge (ltW ag) gt_eqF.
- move: vj; rewrite fZ => /and4P [/eqP ks z1 z2 z3]; rewrite ks in v * => -[<-].
  by apply: (cross pi v); rewrite ?pj //= ?fB ?z1 ?z2 ?z3 // /Statement.over_at updj ?pj (oj : mu j == 0).
- have ji := dj isT; have pid : p i = dN by rewrite -ji.
  case: k v vj => [[]|] v vj; first by rewrite fN2 in vj.
  + move: vj; rewrite fN1 => /and3P [/eqP z1 /eqP z2 z3].
    have an : aF f j != 0 by move: cj; rewrite /cnt z1 z2 eqxx (gt_eqF z3) /=; case: eqP.
    case: (altP (mu j =P 0)) => [m0|m0].
      by apply: (up_good pi v ji) => //; rewrite -?ji /= ?m0 ?iZ ?z1 ?z2 ?z3 ?eqxx ?pj.
    have m1 : 0 < mu j by rewrite lt_neqAle eq_sym m0 mu0.
    case: (ltP (aF f j) 0) => ag [<-]; apply: (cross pi v); rewrite ?pj //=.
    * by rewrite fDP0 // z1 z2 eqxx z3.
    * by rewrite /Statement.over_at updj ?pj.
    * by rewrite fDM0 // z1 z2 eqxx z3 lt_neqAle eq_sym an.
    * by rewrite /Statement.over_at updj ?pj.
  + rewrite /Statement.down; case pr: (prev p j) => [j'|] //; have /prevP [lt pB _] := introT eqP pr.
    have nj : j' != j by rewrite ord_lt.
    have inj := vo j' nj; have oj' := o j'; have cj' := co j' nj.
    case pj': (p j') inj oj' cj' pB => // inj oj' cj' _.
    * move: inj; rewrite iS => /and4P [/eqP z1 /eqP z2 b1 b2].
      have fn : xF f j' != 0 by apply/eqP => e1; move: cj'; rewrite /cnt z1 z2 e1 eqxx /= orbT; case: ifP.
      case: (ltP 0 (xF f j')) => pos [<-]; apply: (down_good pi v) => //.
      - by rewrite fDP2 z1 z2 eqxx pos b1.
      - by rewrite /Statement.over_at enter_i ?pj'.
      - by rewrite fDM2 z1 z2 eqxx lt_neqAle fn pos b2.
      - by rewrite /Statement.over_at enter_i ?pj'.
    * move: inj; rewrite iP => inj [<-]; apply: (down_good pi v) => //; first by rewrite fDP1.
      by rewrite /Statement.over_at enter_i ?pj'.
    * move: inj; rewrite iM => inj [<-]; apply: (down_good pi v) => //; first by rewrite fDM1.
      by rewrite /Statement.over_at enter_i ?pj'.
    * move: inj; rewrite iZ => /and3P [z1 z2 z3] [<-]; apply: (down_good pi v) => //; first exact: mu0.
      - by rewrite fN1 z1 z2.
      - by rewrite /Statement.over_at enter_i ?pj' (oj' : mu j' == 0).
- have ji := dj isT; have pid : p i = dP by rewrite -ji.
  case: k v vj => [[]|] v vj.
  + move: vj; rewrite fDP2 => /and4P [z1 z2 b1 b2]; apply: (up_good pi v ji) => //; rewrite -?ji ?b1 ?pj //.
    rewrite iS z1 z2 b2 /=; apply: lt_trans b2; by rewrite (lt_trans _ b1) // oppr_lt0.
  + move: vj; rewrite fDP1 // => vj; apply: (up_good pi v ji) => //; rewrite -?ji ?pj ?iP //.
  + move: vj; rewrite fDP0 // => /and4P [z1 z2 z3 ag] [<-]; apply: (cross pi v); rewrite ?pj //= ?fN1 ?z1 ?z2 //.
    by rewrite /Statement.over_at updj ?pj ag gt_eqF.
- have ji := dj isT; have pid : p i = dM by rewrite -ji.
  case: k v vj => [[]|] v vj.
  + move: vj; rewrite fDM2 => /and4P [z1 z2 b1 b2]; apply: (up_good pi v ji) => //;
      rewrite -?ji ?(ltNge 0) ?(ltW b1) ?pj //.
    rewrite iS z1 z2 b2 andbT /=; apply: lt_trans b2; by rewrite (lt_trans b1) // oppr_gt0.
  + move: vj; rewrite fDM1 // => vj; apply: (up_good pi v ji) => //; rewrite -?ji ?pj ?iM //.
  + move: vj; rewrite fDM0 // => /and4P [z1 z2 z3 ag] [<-]; apply: (cross pi v); rewrite ?pj //= ?fN1 ?z1 ?z2 //.
    by rewrite /Statement.over_at updj ?pj ltNge (ltW ag) gt_eqF.
- by move: vj; rewrite fO.
Qed.

(* ---- the two matchings ---- *)
Definition mates (c : bool) : ends -> option ends := if c then over else along.
Lemma over_end x y : over x = Some y -> [/\ is_end y, point y = point x, over y = Some x & y.1 <> x.1].
Proof.
rewrite {1}/over; case: ifP => // ex; have [i [pi v]] := is_end_V ex; move/(over_ok pi v) => -[[i' pi'] v' ov ne].
have ey : is_end y.
  by case: y {ne ov} pi' v' => p' [j' k'] /= pi' v'; apply/(is_endP j' k' pi'); exists (point x).
have py : point y = point x by case: y {ne ov ey} pi' v' => p' [j' k'] /= pi' v'; exact: pointE pi' v'.
by split=> //; rewrite /Statement.over ey py ov; case: (x) => p' [j' k'].
Qed.
Lemma mates_sym c x y : mates c x = Some y -> mates c y = Some x.
Proof.
case: c => /=; first by case/over_end.
move=> xy; have ex : is_end x by move: xy; rewrite /Statement.along; case: ifP.
have [y' [xy' e1 ne ey only]] := alongP ex; move: xy; rewrite xy' => -[e2]; rewrite -e2.
have [z [yz e3 ne3 ez _]] := alongP ey; rewrite yz; congr Some.
by case: (only z ez) => [|//|e4]; [rewrite e3 | case: ne3; rewrite e4].
Qed.
Lemma mates_irr c x : mates c x <> Some x.
Proof.
case: c => /=; first by case/over_end.
move=> xy; have ex : is_end x by move: xy; rewrite /Statement.along; case: ifP.
by have [y [xy' _ ne _ _]] := alongP ex; move: xy; rewrite xy' => -[e2]; apply: ne; rewrite e2.
Qed.

(* ---- the law; where the path ends ---- *)
Lemma inn_law f j c : inn (mu j) (xN f j) (xF f j) (aN f j) (aF f j) c -> finished c -> ok (mu j) c ->
  law (mu j) (xN f j) (xF f j) (aN f j) (aF f j).
Proof.
case: c => // + _ oc; rewrite /law /normal_conditions.
- by rewrite iB => /and3P [/eqP -> /eqP -> /ltW ->]; rewrite !mul0r !mulr0 normr0 subr0 mulr0 lexx.
- rewrite iS => /and4P [/eqP -> /eqP -> b1 b2]; rewrite !mul0r !mulr0 lexx.
  have le : `|xF f j| <= mu j * xN f j by rewrite ler_norml (ltW b1) andbT ler_oppl ltW.
  by split; split=> //; rewrite -(pmulr_rge0 _ oc) (le_trans _ le).
- rewrite iP => /and4P [/eqP -> /eqP e1 p0 ag]; rewrite -e1.
  have m0 : 0 <= mu j * xN f j by rewrite mulr_ge0 ?ltW.
  rewrite ger0_norm // subrr !mulr0 lexx; split; split=> //; first exact: ltW.
  by apply: mulr_le0_ge0 => //; exact: ltW.
- rewrite iM => /and4P [/eqP -> /eqP e1 p0 ag]; have -> : xF f j = - (mu j * xN f j) by rewrite e1 opprK.
  have m0 : 0 <= mu j * xN f j by rewrite mulr_ge0 ?ltW.
  rewrite normrN ger0_norm // subrr !mulr0 lexx; split; split=> //; first exact: ltW.
  by rewrite mulrN oppr_le0 mulr_ge0 // ltW.
- by rewrite iZ => /and3P [/eqP -> /eqP -> p0]; rewrite normr0 subr0 (eqP oc) !mul0r !mulr0 lexx (ltW p0).
Qed.
Lemma later_law f j : xN f j = 0 -> xF f j = 0 -> 0 <= aN f j -> law (mu j) (xN f j) (xF f j) (aN f j) (aF f j).
Proof. by rewrite /law /normal_conditions => -> -> ->; rewrite !mul0r !mulr0 normr0 subr0 mulr0 lexx. Qed.

Lemma zero_count j : aN 0 j != 0.
Proof.
have x0 (i : 'I_n) : xN 0 i = 0 /\ xF 0 i = 0 by rewrite /Law.xN /Law.xF !mxE.
have ge i : (2 <= count 0 i)%N by have [z1 z2] := x0 i; rewrite /cnt z1 z2 eqxx /= -addnA leq_addr.
apply/eqP => z; have gj : (2 < count 0 j)%N
  by have [z1 z2] := x0 j; rewrite /cnt z1 z2 z eqxx /= addn1 addSn ltnS leq_addr.
have n0 : (0 < n)%N := leq_ltn_trans (leq0n _) (ltn_ord j).
have := generic 0; rewrite (bigD1 j) //= => le.
have geS : ((n.-1).*2 <= \sum_(i | i != j) count 0 i)%N.
  rewrite -muln2 -[n in n.-1]card_ord -(cardC1 j) -sum_nat_const; exact: leq_sum.
have := leq_trans (leq_add gj geS) le; by rewrite !addSn add0n -doubleS prednK // addnn ltnn.
Qed.
Definition word0 (i : 'I_n) : word := [ffun s : 'I_n => if (s < i)%N then cB else if s == i then dN else Later].
Lemma firstP x : reflect
  (exists2 i, x = (word0 i, (i, s0)) & aN 0 i < 0 /\ forall s : 'I_n, (s < i)%N -> 0 <= aN 0 s) (first == Some x).
Proof.
apply: (iffP eqP); rewrite /Statement.first.
  case: pickP => // i /andP [neg /forallP mid] [<-]; exists i => //; split=> // s lt; exact: (implyP (mid s)).
move=> [i -> [neg mid]]; case: pickP => [t /andP [b1 /forallP b2]|/(_ i)]; last first.
  by rewrite neg /= => /forallP; case=> s; apply/implyP/mid.
have -> // : t = i; apply/val_inj; case: (ltngtP t i) => // lt.
- by have := mid t lt; rewrite leNgt b1.
- by have := b2 i; rewrite lt /= leNgt neg.
Qed.
Lemma first_end x : first = Some x -> is_end x /\ over x = None.
Proof.
move/eqP/firstP => [i -> [neg mid]].
have x0 (s : 'I_n) : xN 0 s = 0 /\ xF 0 s = 0 by rewrite /Law.xN /Law.xF !mxE.
have wi : word0 i i = dN by rewrite ffunE ltnn eqxx.
have wl (s : 'I_n) : (s < i)%N -> word0 i s = cB by move=> lt; rewrite ffunE lt.
have wg (s : 'I_n) : (i < s)%N -> word0 i s = Later by move=> lt; rewrite ffunE ltnNge (ltnW lt) /= ord_gt.
have pi : piece (word0 i) i.
  apply/and4P; split; first by rewrite wi.
  - by apply/forallP => s; apply/implyP => /wl ->.
  - by apply/forallP => s; apply/implyP => /wg ->.
  - apply/forallP => s; rewrite ffunE; case: ifP => _ /=; first exact: mu0.
    by case: ifP => _ /=; exact: mu0.
have v : V (word0 i) i s0 0.
  split; first by have [z1 z2] := x0 i; rewrite wi fN0 z1 z2 eqxx neg.
  move=> s si; have [z1 z2] := x0 s; case: (ltngtP s i) => lt.
  - by rewrite wl // iB z1 z2 eqxx lt_neqAle eq_sym zero_count mid.
  - by rewrite wg // iO z1 z2 eqxx.
  - by move/eqP: si; case; exact/val_inj.
have ex : is_end (word0 i, (i, s0)) by apply/(is_endP i s0 pi); exists 0.
split=> //; rewrite /Statement.over ex /= (pointE pi v) /Statement.over_at wi /Statement.down /Statement.prev;
  case: pickP => // t /and3P [lt + _].
by rewrite wl.
Qed.
Lemma next_none f i : next f i = None -> forall s : 'I_n, (i < s)%N -> 0 <= aN f s.
Proof.
rewrite /Statement.next; case: pickP => // none _ s lt; rewrite leNgt; apply/negP => neg.
have Ps : (i < s)%N && (aN f s < 0) by rewrite lt neg.
case: (@arg_minnP _ s (fun t : 'I_n => (i < t)%N && (aN f t < 0)) (fun t : 'I_n => nat_of_ord t) Ps)
  => t /andP [t1 t2] tmin.
have := none t; rewrite t1 t2 /= => /forallP; case=> r; apply/implyP => /andP [r1 r2].
by rewrite leNgt; apply/negP => rn; have := tmin r; rewrite r1 rn leqNgt r2 => /(_ isT).
Qed.
Lemma prev_none p i : prev p i = None -> forall s : 'I_n, (s < i)%N -> p s = cB.
Proof.
rewrite /Statement.prev; case: pickP => // none _ s lt; apply/eqP; apply: contraT => neg.
have Ps : (s < i)%N && (p s != cB) by rewrite lt neg.
case: (@arg_maxnP _ s (fun t : 'I_n => (t < i)%N && (p t != cB)) (fun t : 'I_n => nat_of_ord t) Ps)
  => t /andP [t1 t2] tmax.
have := none t; rewrite t1 t2 /= => /forallP; case=> r; apply/implyP => /andP [r1 r2].
by apply: contraT => rn; have := tmax r; rewrite r2 rn /geq /= leqNgt r1 => /(_ isT).
Qed.
Lemma up_none p i j k f c : piece p i -> V p j k f -> j = i -> inn (mu i) (xN f i) (xF f i) (aN f i) (aF f i) c ->
  finished c ->
  ok (mu i) c -> up f p j c = None -> solution f.
Proof.
move=> pi v ji ic fc oc; rewrite ji in v *; rewrite /Statement.up; case e1: (next f i) => // _ s.
have /and4P [d /forallP fin /forallP l /forallP o] := pi.
case: (ltngtP s i) => lt.
- by apply: (inn_law (proj2 v s _) (implyP (fin s) lt) (o s)); rewrite ord_lt.
- have [z1 z2 _] := later_neq pi v lt; apply: later_law => //; exact: next_none e1 s lt.
- by have -> : s = i; [exact/val_inj | exact: inn_law ic fc oc].
Qed.
Lemma over_none x : is_end x -> over x = None -> solution (point x) \/ first = Some x.
Proof.
case: x => p [j k] ex; rewrite /Statement.over ex /=; have [i [pi v]] := is_end_V ex; rewrite /= in pi;
  move: (point _) v => f /= v.
have [vj vo] := v; have o : forall s, ok (mu s) (p s) by have /and4P [_ _ _ /forallP] := pi.
have oj := o j; have dj := @driven_at p i j pi.
rewrite /Statement.over_at; case pj: (p j) vj oj dj => vj oj dj; try by case: ifP => //; case: ifP.
- by case: k {v ex} vj => [[]|].
- by case: k {v ex} vj => [[]|].
- by case: k {v ex} vj => [[]|].
- by [].
- have ji := dj isT; case: k v vj ex => [[]|] v vj ex; first by rewrite fN2 in vj.
    move: vj; rewrite fN1 => /and3P [z1 z2 z3]; case: (altP (mu j =P 0)) => [m0|m0]; last by case: ifP.
    by move=> un; left; apply: (up_none pi v ji) un => //; rewrite -?ji /= ?m0 // iZ z1 z2.
  rewrite /Statement.down; case pr: (prev p j) => [j'|].
    have /prevP [lt pB _] := introT eqP pr.
    have /and4P [_ /forallP fin _ _] := pi; have := fin j'; rewrite -ji lt /=.
    by case: (p j') pB => //; case: ifP.
  move=> _; right; have B := prev_none pr; rewrite ji in vj B v pj ex *.
  have f0 : f = 0.
    have xz (s : 'I_n) : xN f s = 0 /\ xF f s = 0.
      case: (ltngtP s i) => lt.
      - by have := proj2 v s _; rewrite ord_lt // B // iB => /(_ isT) /and3P [/eqP -> /eqP ->].
      - by have [-> -> _] := later_neq pi v lt.
      - by have -> : s = i; [exact/val_inj | move: vj; rewrite fN0 => /and3P [/eqP -> /eqP ->]].
    apply/matrixP => r c; rewrite ord1 mxE; case: (splitP r) => s es.
    - have -> : r = lshift n s by exact/val_inj. exact: proj1 (xz s).
    - have -> : r = rshift n s by exact/val_inj. exact: proj2 (xz s).
  apply/eqP/firstP; exists i; last first.
    rewrite f0 in v vj; split; first by move: vj; rewrite fN0 => /and3P [].
    by move=> s lt; have := proj2 v s _; rewrite ord_lt // B // iB => /(_ isT) /and3P [_ _ /ltW].
  congr (_, _); apply/ffunP => s; rewrite ffunE; case: (ltngtP s i) => lt; first exact: B.
    by rewrite ord_gt //; have /and4P [_ _ /forallP l _] := pi; exact/eqP/(implyP (l s)).
  by have -> : s = i; [exact/val_inj | rewrite eqxx].
- have ji := dj isT; case: k v vj {ex} => [[]|] v vj //.
    move: vj; rewrite fDP2 => /and4P [z1 z2 b1 b2] un; left; apply: (up_none pi v ji) un => //; rewrite -?ji //.
    rewrite iS z1 z2 b2 /=; apply: lt_trans b2; by rewrite (lt_trans _ b1) // oppr_lt0.
  by move: vj; rewrite fDP1 // => vj un; left; apply: (up_none pi v ji) un => //; rewrite -?ji // iP.
- have ji := dj isT; case: k v vj {ex} => [[]|] v vj //.
    move: vj; rewrite fDM2 => /and4P [z1 z2 b1 b2] un; left; apply: (up_none pi v ji) un => //; rewrite -?ji //.
    rewrite iS z1 z2 b2 andbT /=; apply: lt_trans b2; by rewrite (lt_trans b1) // oppr_gt0.
  by move: vj; rewrite fDM1 // => vj un; left; apply: (up_none pi v ji) un => //; rewrite -?ji // iM.
- by move: vj; rewrite fO.
Qed.

(* ---- the run ---- *)
Variable x0 : ends.
Hypothesis f0 : first = Some x0.
Notation pos := (pos mates false x0).
Notation entry := (Statement.entry A b mu x0).
Arguments Statement.entry : simpl never.
Lemma entryS k x y z : entry k = Some x -> along x = Some y -> over y = Some z -> entry k.+1 = Some z.
Proof. by move=> ek xy ov; rewrite /Statement.entry iterS -/(Statement.entry A b mu x0 k) ek /= xy. Qed.
Lemma start0 : mates (~~ false) x0 = None. Proof. exact: (proj2 (first_end f0)). Qed.
Lemma pos_end k x : pos k = Some x -> is_end x.
Proof.
case: k => [[<-]|k /posS [y _]]; first exact: (proj1 (first_end f0)).
case: (turn _ _) => /=; first by case/over_end.
move=> xy; have ex : is_end y by move: xy; rewrite /Statement.along; case: ifP.
by have [z [xz _ _ ez _]] := alongP ex; move: xy; rewrite xz => -[<-].
Qed.
Lemma entry_pos k : entry k = pos k.*2.
Proof.
elim: k => // k IH; rewrite /Statement.entry iterS -/(Statement.entry A b mu x0 k) IH doubleS
  /= /turn /= odd_double /=.
by case: (Path.pos _ _ _ _) => //= x; case: (along x).
Qed.
(* no end twice, no piece twice *)
Theorem no_end_twice i j x : pos i = Some x -> pos j = Some x -> i = j.
Proof. exact: (pos_inj mates_sym mates_irr start0). Qed.
Theorem no_piece_twice i j x y : entry i = Some x -> entry j = Some y -> x.1 = y.1 -> i = j.
Proof.
rewrite !entry_pos => pi pj e1; have ex := pos_end pi; have ey := pos_end pj.
have [z [xz ez _ _ only]] := alongP ex.
have pz : pos i.*2.+1 = Some z by rewrite /= pi /= /turn /= odd_double.
case: (only y ey (esym e1)) => e2; rewrite e2 in pj.
  by apply: double_inj; exact: no_end_twice pi pj.
by have := congr1 odd (no_end_twice pz pj); rewrite /= !odd_double.
Qed.
Lemma entry_le j k x : (j <= k)%N -> entry k = Some x -> exists y, entry j = Some y.
Proof. by rewrite !entry_pos => le; apply: pos_le; rewrite leq_double. Qed.
(* the pieces: words of four letters, but for one *)
Definition code t : 'I_4 := match t with cB | Later => @Ordinal 4 0 isT | cS | cZ | dN => @Ordinal 4 1 isT
  | cP | dP => @Ordinal 4 2 isT | cM | dM => @Ordinal 4 3 isT end.
Definition codes (p : word) : {ffun 'I_n -> 'I_4} := [ffun j => code (p j)].
Lemma codes_neq p i : piece p i -> codes p != [ffun => code cB].
Proof.
move=> /and4P [d _ _ _]; apply/eqP => /ffunP /(_ i); rewrite !ffunE; by case: (p i) d.
Qed.
Lemma codes_inj p p' i i' : piece p i -> piece p' i' -> codes p = codes p' -> p = p'.
Proof.
move=> /and4P [d /forallP f /forallP l /forallP o] /and4P [d' /forallP f' /forallP l' /forallP o'] /ffunP e1.
have ec s : code (p s) = code (p' s) by have := e1 s; rewrite !ffunE.
have ii : i = i'.
  apply/val_inj; case: (ltngtP i i') => // lt.
  - by have /eqP e2 := implyP (l i') lt; have := ec i'; rewrite e2; case: (p' i') d'.
  - by have /eqP e2 := implyP (l' i) lt; have := ec i; rewrite e2; case: (p i) d.
rewrite -ii in d' f' l'; apply/ffunP => s; case: (ltngtP s i) => lt.
- have := implyP (f s) lt; have := implyP (f' s) lt; have := ec s; have := o s; have := o' s.
  by case: (p s); case: (p' s) => //= h1 h2 _ _ _; exfalso; move: h1 h2; case: (ltrgtP (mu s) 0).
- by have /eqP -> := implyP (l s) lt; have /eqP -> := implyP (l' s) lt.
- have -> : s = i by exact/val_inj.
  by have := ec i; case: (p i) d; case: (p' i) d'.
Qed.
Lemma entry_bound k x : entry k = Some x -> (k.+1 < 4 ^ n)%N.
Proof.
move=> ek; pose g (j : 'I_k.+1) := codes (odflt x0 (entry j)).1.
have gE (j : 'I_k.+1) : exists y, [/\ entry j = Some y, g j = codes y.1 & exists i, piece y.1 i].
  have [|y ej] := entry_le (j := j) _ ek; first by rewrite -ltnS.
  exists y; split=> //; first by rewrite /g ej.
  by apply: is_end_piece; apply: (@pos_end j.*2); rewrite -entry_pos.
have gi : injective g.
  move=> i j eij; have [y [ey gy [a pa]]] := gE i; have [z [ez gz [c pc]]] := gE j.
  by apply/val_inj/(no_piece_twice ey ez); apply: codes_inj pa pc _; rewrite -gy -gz.
have : (#|codom g| <= #|predC1 [ffun => code cB] : {pred {ffun 'I_n -> 'I_4}}|)%N.
  apply: subset_leq_card; apply/subsetP => w /codomP [j ->].
  by have [y [_ -> [a pa]]] := gE j; rewrite inE /=; exact: codes_neq pa.
by rewrite card_codom // card_ord cardC1 card_ffun !card_ord; case: (4 ^ n)%N.
Qed.
Lemma drive_entry a : forall k x, entry k = Some x ->
  if drive a x is Some y then over y = None /\ exists2 j, pos j = Some y & odd j
  else exists z, entry (k + a).+1 = Some z.
Proof.
elim: a => [|a IH] k x ek /=; have pk := ek; rewrite entry_pos in pk;
  have [y [xy _ _ _ _]] := alongP (pos_end pk); rewrite xy.
  case ov: (over y) => [z|].
    by exists z; rewrite addn0; exact: entryS ek xy ov.
  split=> //; exists k.*2.+1; last by rewrite /= odd_double.
  by rewrite /= pk /= /turn /= odd_double.
case ov: (over y) => [z|].
  by rewrite addnS -addSn; apply: IH; exact: entryS ek xy ov.
split=> //; exists k.*2.+1; last by rewrite /= odd_double.
by rewrite /= pk /= /turn /= odd_double.
Qed.
Theorem drive_ends : exists y, [/\ drive (4 ^ n).-2 x0 = Some y, is_end y & solution (point y)].
Proof.
have := @drive_entry (4 ^ n).-2 0%N x0 erefl; case: (drive _ _) => [y [ov [j pj oj]]|[z /entry_bound]].
  exists y; have ey := pos_end pj; split=> //; case: (over_none ey ov) => //; rewrite f0 => -[e1].
  by rewrite -e1 in pj; have e2 := @no_end_twice 0%N j x0 erefl pj; rewrite -e2 in oj.
by rewrite add0n; case: (4 ^ n)%N => [|[|m]] //=; rewrite ltnn.
Qed.
End Driving.
