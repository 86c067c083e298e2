(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that a piece has exactly two ends, and that the ratio test finds the other: a line (m unknowns, m equations
   of which one is 0 = 0) within finitely many half spaces, no two of whose boundaries meet in it, and which contains
   no ray. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.driving Require Import Statement.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Piece.
Variables (R : realFieldType) (m : nat) (K : finType)
  (E : 'M[R]_m) (e : 'cV[R]_m) (G : K -> 'rV[R]_m) (h : K -> R) (r0 : 'I_m).
Notation lin := (Statement.lin G).
Notation val := (Statement.val G h).
Notation Bk := (Statement.Bk E G r0).
Notation cand := (Statement.cand E e G h r0).
Notation dir := (Statement.dir E G r0).
Notation isendb := (Statement.isendb E e G h r0).
Notation ratio := (Statement.ratio E e G h r0).
Notation pivot := (Statement.pivot E e G h r0).
Definition isend k f := [/\ E *m f = e, val k f = 0 & forall k', k' != k -> 0 < val k' f].

Hypothesis zero_row : row r0 E = 0.
Hypothesis nd : forall f, E *m f = e -> (forall k, 0 <= val k f) -> forall k l, val k f = 0 -> val l f = 0 -> k = l.
Hypothesis noray : forall f, E *m f = e -> (forall k, 0 <= val k f) ->
  forall v, E *m v = 0 -> (forall k, 0 <= lin k v) -> v = 0.

Lemma linD k u v : lin k (u + v) = lin k u + lin k v. Proof. by rewrite /Statement.lin mulmxDr mxE. Qed.
Lemma linZ k c v : lin k (c *: v) = c * lin k v. Proof. by rewrite /Statement.lin -scalemxAr mxE. Qed.
Lemma linN k v : lin k (- v) = - lin k v. Proof. by rewrite -scaleN1r linZ mulN1r. Qed.
Lemma valD k f t v : val k (f + t *: v) = val k f + t * lin k v.
Proof. by rewrite /Statement.val linD linZ addrAC. Qed.
Lemma end_ge0 k f : isend k f -> forall k', 0 <= val k' f.
Proof. by case=> _ z p k'; case: (altP (k' =P k)) => [->|/p /ltW //]; rewrite z. Qed.

Lemma first_zero u v k0 : (forall k, 0 <= val k u) -> E *m u = e -> E *m v = 0 -> lin k0 v < 0 ->
  exists t k,
    [/\ 0 <= t, forall k', 0 <= val k' (u + t *: v), lin k v < 0, val k (u + t *: v) = 0 & E *m (u + t *: v) = e].
Proof.
move=> u0 Hu Hv k0n.
case: (@arg_minP _ _ _ k0 (fun k => lin k v < 0) (fun k => val k u / - lin k v) k0n) => k kn kmin.
have vk : 0 < - lin k v by rewrite oppr_gt0.
exists (val k u / - lin k v), k; split=> //.
- by rewrite divr_ge0 // ltW.
- move=> j; rewrite valD; case: (ltP (lin j v) 0) => [jn|jp].
    have := kmin j jn; rewrite ler_pdivl_mulr ?oppr_gt0 // mulrN => le.
    by rewrite -ler_subl_addr sub0r.
  by rewrite addr_ge0 // mulr_ge0 // divr_ge0 // ltW.
- by rewrite valD invrN mulrN mulNr -mulrA mulVf ?mulr1 ?subrr // lt_eqF.
- by rewrite mulmxDr -scalemxAr Hv scaler0 addr0.
Qed.
Lemma kernel_zero l u y : isend l u -> E *m y = 0 -> lin l y = 0 -> y = 0.
Proof.
move=> ul Hy yl; have u0 := end_ge0 ul; case: (ul) => Hu ull _.
apply: (noray Hu u0 Hy) => k; rewrite leNgt; apply/negP => kn.
have [t [k' [t0 p zk' uk Hp]]] := first_zero u0 Hu Hy kn.
have ek : k' = l by (apply: (nd Hp p) => //; rewrite valD ull yl mulr0 addr0).
by move: zk'; rewrite ek yl ltxx.
Qed.
Lemma BkE k v : Bk k *m v = E *m v + lin k v *: delta_mx r0 0.
Proof.
rewrite mulmxDl -mulmxA; congr (_ + _); apply/matrixP => i j; rewrite ord1 mxE big_ord1 !mxE mulrC; congr (_ * _).
by rewrite /Statement.lin mxE.
Qed.
Lemma E_r0 (v : 'cV[R]_m) : (E *m v) r0 0 = 0.
Proof.
rewrite mxE big1 // => j _; have := congr1 (fun x : 'rV[R]_m => x 0 j) zero_row.
by rewrite !mxE => ->; rewrite mul0r.
Qed.
Lemma Bk_unit k u : isend k u -> Bk k \in unitmx.
Proof.
move=> uk; rewrite -unitmx_tr -row_free_unit -kermx_eq0; apply/eqP; apply/row_matrixP => i; rewrite row0.
set y := row i _; have : y *m (Bk k)^T = 0 by apply/sub_kermxP/row_sub.
move/(congr1 trmx); rewrite trmx_mul trmxK trmx0 BkE => h0.
have l0 : lin k y^T = 0.
  by have := congr1 (fun x : 'cV[R]_m => x r0 0) h0; rewrite mxE E_r0 add0r !mxE !eqxx mulr1.
rewrite l0 scale0r addr0 in h0.
by rewrite -[y]trmxK (kernel_zero uk h0 l0) trmx0.
Qed.
Lemma candE k u : isend k u -> cand k = u.
Proof.
move=> uk; have un := Bk_unit uk; have [Eu vu _] := uk; rewrite /Statement.cand.
have -> : e - h k *: delta_mx r0 0 = Bk k *m u; last by rewrite mulKmx.
by rewrite BkE Eu -scaleNr; congr (_ + _ *: _); apply/eqP; rewrite eq_sym -addr_eq0 -/(val k u) vu.
Qed.
Lemma isendP k : reflect (exists u, isend k u) (isendb k).
Proof.
apply: (iffP idP) => [/and3P [/eqP a /eqP b /forallP c]|[u uk]].
  by exists (cand k); split=> // k' kk; have := c k'; rewrite kk.
have [Eu vu pu] := uk; rewrite /Statement.isendb (candE uk) Eu vu !eqxx /=.
by apply/forallP => k'; apply/implyP/pu.
Qed.
Lemma isendC k : isendb k -> isend k (cand k).
Proof. by move=> /isendP [u uk]; rewrite (candE uk). Qed.
Lemma dirE k : isendb k -> E *m dir k = 0 /\ lin k (dir k) = 1.
Proof.
move=> /isendC uk; have un := Bk_unit uk.
have := BkE k (dir k); rewrite /Statement.dir mulKVmx // -/(dir k) => h0.
have l1 : lin k (dir k) = 1.
  by have := congr1 (fun x : 'cV[R]_m => x r0 0) h0; rewrite [RHS]mxE E_r0 add0r !mxE !eqxx mulr1.
by split=> //; apply: (addIr (delta_mx r0 0)); rewrite add0r [RHS]h0 l1 scale1r.
Qed.
Lemma pivotP k : isendb k ->
  exists k', [/\ pivot k = Some k', k' != k, isendb k' & forall l, isendb l -> l = k \/ l = k'].
Proof.
move=> ek; have uk := isendC ek; have [Hd dk] := dirE ek; have [Hu ukk up] := uk; have u0 := end_ge0 uk.
set u := cand k in uk Hu ukk up u0 *; set v := dir k in Hd dk *.
have [k0 k0n] : exists k0, lin k0 v < 0.
  apply/existsP; apply: contraT; rewrite negb_exists => /forallP p.
  have z : v = 0 by apply: (noray Hu u0 Hd) => l; have := p l; rewrite -leNgt.
  by move: dk; rewrite z /Statement.lin mulmx0 mxE => /esym/eqP; rewrite oner_eq0.
rewrite /Statement.pivot; case: pickP => [k1 /andP [kn /forallP kmin]|none]; last first.
  case: (@arg_minP _ _ _ k0 (fun l => lin l v < 0) (fun l => ratio k l) k0n) => l ln lmin.
  by have := none l; rewrite -/v ln /= => /forallP; case=> l2; apply/implyP/lmin.
exists k1; split=> //.
- by apply/eqP => e1; move: kn; rewrite -/v e1 dk ltr10.
- have nn l : 0 <= val l (u + ratio k k1 *: v).
    rewrite valD; case: (ltP (lin l v) 0) => [ln|lp]; last first.
      by rewrite addr_ge0 // mulr_ge0 // /Statement.ratio divr_ge0 // oppr_ge0 ltW.
    have := kmin l; rewrite -/v ln /= => le; have := le; rewrite [X in _ <= X -> _]/Statement.ratio -/u -/v.
    by rewrite ler_pdivl_mulr ?oppr_gt0 // mulrN -subr_ge0 opprK.
  have Hp : E *m (u + ratio k k1 *: v) = e by rewrite mulmxDr -scalemxAr Hd scaler0 addr0.
  have z : val k1 (u + ratio k k1 *: v) = 0.
    by rewrite valD /Statement.ratio -/u -/v -{2}[lin k1 v]opprK mulrN divfK ?subrr // gt_eqF // oppr_gt0.
  apply/isendP; exists (u + ratio k k1 *: v); split=> // l lk; rewrite lt_neqAle nn andbT eq_sym.
  by apply: contra lk => /eqP e1; apply/eqP/(nd Hp).
move=> l el; case: (altP (l =P k)) => [|lk]; [by left | right].
have xl := isendC el; set x := cand l in xl; have [Hx xll xp] := xl; have x0 := end_ge0 xl.
have xe : x = u + val k x *: v.
  apply/eqP; rewrite -subr_eq0; apply/eqP; apply: (kernel_zero uk).
    by rewrite mulmxBr mulmxDr -scalemxAr Hd Hx Hu scaler0 addr0 subrr.
  have hu : lin k u = - h k by apply/eqP; rewrite -addr_eq0 -/(val k u) ukk.
  by rewrite linD linN linD linZ dk mulr1 hu /Statement.val [- h k + _]addrC addrK subrr.
have s0 : 0 < val k x by rewrite xp // eq_sym.
have xE j : val j x = val j u + val k x * lin j v by rewrite {1}xe valD.
have vl : lin l v < 0.
  rewrite ltNge; apply/negP => le; have h1 := up l lk.
  have h2 : 0 < val l x by rewrite (xE l) ltr_paddr // mulr_ge0 // ltW.
  by move: h2; rewrite xll ltxx.
have xr : val k x = ratio k l.
  have := xE l; rewrite xll => /esym/eqP; rewrite addr_eq0 => /eqP eq1.
  by rewrite /Statement.ratio -/u -/v eq1 invrN mulrNN mulfK // lt_eqF.
have le1 : ratio k k1 <= val k x by have := kmin l; rewrite -/v vl xr.
have le2 : val k x <= ratio k k1.
  rewrite /Statement.ratio -/u -/v ler_pdivl_mulr ?oppr_gt0 // mulrN -subr_ge0 opprK -xE; exact: x0.
have e1 : val k x = ratio k k1 by apply/eqP; rewrite eq_le le2 le1.
apply: (nd Hx x0) => //;
  rewrite xE e1 /Statement.ratio -/u -/v -{2}[lin k1 v]opprK mulrN divfK ?subrr // gt_eqF // oppr_gt0; exact: kn.
Qed.
Lemma end_unique k u u' : isend k u -> isend k u' -> u = u'.
Proof. by move=> /candE <- /candE <-. Qed.
End Piece.
