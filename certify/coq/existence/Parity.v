(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that a nondegenerate linear complementarity problem w = M z + q, whose matrix is copositive and whose q
   meets no ray, has a solution: vertices of edges are counted twice. No path is followed. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.existence Require Import Law Dot Edge.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Count.
Variables (n : nat) (F : {ffun 'I_n -> bool} -> 'I_n.+1 -> bool).
Definition flip (i : 'I_n) (s : {ffun 'I_n -> bool}) := [ffun j => if j == i then ~~ s j else s j].
Lemma flipK i : involutive (flip i).
Proof. by move=> s; apply/ffunP => j; rewrite !ffunE; case: eqP => // _; rewrite negbK. Qed.
Hypothesis across : forall s i, F (flip i s) (lift ord0 i) = F s (lift ord0 i).
Hypothesis none : forall s, ~~ F s ord0.
Lemma even_side i : ~~ odd (\sum_s F s (lift ord0 i)).
Proof.
rewrite (bigID (fun s : {ffun 'I_n -> bool} => s i)) /=.
rewrite [X in (_ + X)%N](reindex_inj (inv_inj (flipK i))) /=.
have -> : (\sum_(s | ~~ flip i s i) F (flip i s) (lift ord0 i) =
           \sum_(s : {ffun 'I_n -> bool} | s i) F s (lift ord0 i))%N.
  by apply: eq_big => [s|s _]; [rewrite ffunE eqxx negbK | rewrite across].
by rewrite addnn odd_double.
Qed.
Lemma even_all : ~~ odd (\sum_s \sum_l F s l).
Proof.
rewrite exchange_big /= big_ord_recl /= oddD.
have -> : (\sum_s F s ord0 = 0)%N by apply: big1 => s _; rewrite (negbTE (none s)).
rewrite /=; elim/big_ind: _ => //= [x y|i _]; last exact: even_side.
by rewrite oddD => /negbTE -> /negbTE ->.
Qed.
Lemma contradiction s0 : (forall s, s != s0 -> ~~ odd (\sum_l F s l)) -> odd (\sum_l F s0 l) -> False.
Proof.
move=> ev od; have := even_all; rewrite (bigD1 s0) //= oddD od /=.
suff -> : odd (\sum_(s | s != s0) \sum_l F s l)%N = false by [].
apply/negbTE; elim/big_ind: _ => //= x y; rewrite oddD => /negbTE -> /negbTE ->; by [].
Qed.
End Count.

Section LCP.
Variables (R : realFieldType) (n : nat) (M : 'M[R]_n) (d q : 'cV[R]_n).
Notation sel := {ffun 'I_n -> bool}.
Hypothesis d0 : forall i, 0 < d i 0.
(* columns: -d, then e_j (w_j) or -M e_j (z_j) *)
Definition H (s : sel) : 'M[R]_(n, n.+1) :=
  \matrix_(i, k) if unlift ord0 k is Some j then (if s j then - M i j else (i == j)%:R) else - d i 0.
Definition zof (s : sel) (u : 'cV[R]_n.+1) : 'cV[R]_n := \col_j if s j then u (lift ord0 j) 0 else 0.
Definition wof (s : sel) (u : 'cV[R]_n.+1) : 'cV[R]_n := \col_j if s j then 0 else u (lift ord0 j) 0.
Lemma HE s u : H s *m u = wof s u - M *m zof s u - u ord0 0 *: d.
Proof.
apply/matrixP => i k; rewrite ord1 !mxE big_ord_recl !mxE unlift_none mulNr addrC [d i 0 * _]mulrC; congr (_ - _).
rewrite (eq_bigr (fun j => (if i == j then wof s u j 0 else 0) - M i j * zof s u j 0)) => [|j _].
  by rewrite sumrB -big_mkcond (big_pred1 i) ?mxE // => j; rewrite eq_sym.
rewrite !mxE liftK; case: (s j); first by rewrite mulNr if_same sub0r.
by rewrite mulr0 subr0; case: eqP => _; rewrite ?mul1r ?mul0r.
Qed.
Hypothesis nd : forall s u, nonneg u -> H s *m u = q -> forall k l, u k 0 = 0 -> u l 0 = 0 -> k = l.
Hypothesis copositive : forall z, nonneg z -> 0 <= dotp z (M *m z).
Hypothesis rays : forall z z', nonneg z -> nonneg z' -> nonneg (M *m z) -> dotp z (M *m z) = 0 ->
  0 <= dotp z q /\ 0 <= dotp z (M *m z') + dotp z' (M *m z).

(* decided by linear algebra: the one candidate *)
Definition padl (l : 'I_n.+1) (y : 'cV[R]_n) : 'cV[R]_n.+1 := \col_k if unlift l k is Some j then y j 0 else 0.
Lemma padlE s l y : H s *m padl l y = col' l (H s) *m y.
Proof.
apply/matrixP => i j; rewrite [j]ord1 !mxE (bigD1_ord l) //= !mxE unlift_none mulr0 add0r.
by apply: eq_bigr => k _; rewrite !mxE liftK.
Qed.
Lemma padl_of l (u : 'cV[R]_n.+1) : u l 0 = 0 -> padl l (\col_j u (lift l j) 0) = u.
Proof.
move=> ul; apply/matrixP => k i; rewrite [i]ord1 mxE.
by case: (unliftP l k) => [a ->|->]; rewrite ?mxE ?ul.
Qed.
Lemma basis_unit s l u : vertex (H s) q l u -> col' l (H s) \in unitmx.
Proof.
move=> ul; rewrite -row_free_unit -kermx_eq0; apply: contraT => nz.
have [x Gx x0] : exists2 x : 'cV[R]_n, col' l (H s) *m x = 0 & x != 0.
  have nz' : kermx (col' l (H s))^T != 0 by rewrite -mxrank_eq0 mxrank_ker mxrank_tr -mxrank_ker mxrank_eq0.
  exists (nz_row (kermx (col' l (H s))^T))^T; last by rewrite -(inj_eq (@trmx_inj _ _ _)) trmxK trmx0 nz_row_eq0.
  by apply: trmx_inj; rewrite trmx_mul trmxK trmx0; apply/sub_kermxP/nz_row_sub.
have p0 : padl l x = 0.
  by apply: (kernel_zero (nd (s := s)) ul); [rewrite padlE | rewrite mxE unlift_none].
case/negP: x0; apply/eqP/matrixP => i j; rewrite [j]ord1 mxE.
by have := congr1 (fun m : 'cV[R]_n.+1 => m (lift l i) 0) p0; rewrite !mxE liftK.
Qed.
Definition candidate s l := padl l (invmx (col' l (H s)) *m q).
Lemma candidateE s l u : vertex (H s) q l u -> candidate s l = u.
Proof.
move=> ul; have [Hu ull _] := ul.
by rewrite /candidate -[in LHS]Hu -{1}(padl_of ull) padlE mulKmx ?(basis_unit ul) // padl_of.
Qed.
Definition is_vertex s l : bool :=
  [&& H s *m candidate s l == q, candidate s l l 0 == 0 & [forall k, (k != l) ==> (0 < candidate s l k 0)]].
Lemma is_vertexP s l : reflect (exists u, vertex (H s) q l u) (is_vertex s l).
Proof.
apply: (iffP idP) => [/and3P [/eqP a /eqP b /forallP c]|[u ul]].
  by exists (candidate s l); split=> // k kl; have := c k; rewrite kl.
have [Hu ull up] := ul; rewrite /is_vertex (candidateE ul) Hu ull !eqxx /=.
by apply/forallP => k; apply/implyP => kl; apply: up.
Qed.

Lemma across s i : is_vertex (flip i s) (lift ord0 i) = is_vertex s (lift ord0 i).
Proof.
have half t : is_vertex t (lift ord0 i) -> is_vertex (flip i t) (lift ord0 i).
  move=> /is_vertexP [u [Hu ul up]]; apply/is_vertexP; exists u; split=> //.
  rewrite -Hu; apply/matrixP => a b; rewrite !mxE; apply: eq_bigr => k _; rewrite !mxE.
  case: unliftP => // j kj; rewrite ffunE; case: eqP => // e.
  by rewrite kj e ord1 ul !mulr0.
by apply/idP/idP => [/half|/half //]; rewrite flipK.
Qed.

Lemma z_nonneg s u : nonneg u -> nonneg (zof s u).
Proof. by move=> h j; rewrite mxE; case: (s j). Qed.
Lemma apart s u v : dotp (zof s u) (wof s v) = 0.
Proof. by apply: big1 => j _; rewrite !mxE; case: (s j); rewrite ?mulr0 ?mul0r. Qed.
Lemma d_nonneg : nonneg d. Proof. by move=> i; rewrite ltW. Qed.
Lemma dotd_ge0 (z : 'cV[R]_n) : nonneg z -> 0 <= dotp z d.
Proof. by move=> h; apply: dotp_ge0 => //; exact: d_nonneg. Qed.
Lemma dotd0 (z : 'cV[R]_n) : nonneg z -> dotp z d = 0 -> z = 0.
Proof.
move=> hz e; apply/matrixP => i j; rewrite ord1 mxE.
have h k : true -> 0 <= z k 0 * d k 0 by rewrite mulr_ge0 // d_nonneg.
have /eqP : z i 0 * d i 0 = 0 by apply: (psumr_eq0P h e).
by rewrite mulf_eq0 (gt_eqF (d0 i)) orbF => /eqP.
Qed.

Lemma no_ray s l u : l != ord0 -> s != [ffun => false] -> vertex (H s) q l u ->
  forall v, nonneg v -> H s *m v = 0 -> v = 0.
Proof.
move=> l0 ns ul v v0 Hv; have u0 := vertex_nonneg ul; case: (ul) => Hu ull up.
set z := zof s v; set w := wof s v.
have wE : w = M *m z + v ord0 0 *: d.
  by move: Hv; rewrite HE -/z -/w -addrA -opprD => /eqP; rewrite subr_eq0 => /eqP.
have zn : nonneg z := z_nonneg s v0.
have [cop vd] : dotp z (M *m z) = 0 /\ v ord0 0 * dotp z d = 0.
  apply: sum0; [exact: copositive | by rewrite mulr_ge0 // dotd_ge0 |].
  by rewrite -dotpZ -dotpD -wE apart.
have wdone : z = 0 -> w = 0 -> v ord0 0 = 0 -> v = 0.
  move=> z0 w0 v00; apply/matrixP => k j; rewrite ord1 mxE.
  case: (unliftP ord0 k) => [i ->|-> //].
  have := congr1 (fun m : 'cV[R]_n => m i 0) z0; have := congr1 (fun m : 'cV[R]_n => m i 0) w0.
  by rewrite !mxE; case: (s i).
case: (altP (z =P 0)) => [z0|znz].
  case: (altP (v ord0 0 =P 0)) => [v00|vn].
    by apply: wdone => //; rewrite wE z0 mulmx0 v00 scale0r addr0.
  exfalso; move/negP: ns; apply; apply/eqP/ffunP => j; rewrite ffunE; apply/negbTE/negP => sj.
  have := congr1 (fun m : 'cV[R]_n => m j 0) wE; rewrite z0 mulmx0 add0r !mxE sj => /esym/eqP.
  by rewrite mulf_eq0 (negbTE vn) (gt_eqF (d0 j)).
exfalso.
have dz : dotp z d != 0 by apply: contra znz => /eqP /(dotd0 zn) ->.
have v00 : v ord0 0 = 0 by move/eqP: vd; rewrite mulf_eq0 (negbTE dz) orbF => /eqP.
have wE' : w = M *m z by rewrite wE v00 scale0r addr0.
set z' := zof s u; have zn' : nonneg z' := z_nonneg s u0.
have Mzn : nonneg (M *m z) by rewrite -wE'; move=> j; rewrite mxE; case: (s j).
have [r1 r2] := rays zn zn' Mzn cop.
have qE : wof s u = q + M *m z' + u ord0 0 *: d.
  by rewrite -Hu HE -/z' addrAC subrK subrK.
have e1 : dotp z q + dotp z (M *m z') + u ord0 0 * dotp z d = 0.
  by rewrite -dotpZ -!dotpD -qE apart.
have e2 : dotp z' (M *m z) = 0 by rewrite -wE' apart.
have p : 0 <= u ord0 0 * dotp z d by rewrite mulr_ge0 // dotd_ge0.
rewrite e2 addr0 in r2.
have [_ /eqP] := sum0 (addr_ge0 r1 r2) p e1.
rewrite mulf_eq0 (negbTE dz) orbF => /eqP u00.
have e : l = ord0 := nd u0 Hu ull u00.
by rewrite e eqxx in l0.
Qed.

Lemma primaryE u : H [ffun => false] *m u = q <-> forall j, u (lift ord0 j) 0 = q j 0 + u ord0 0 * d j 0.
Proof.
rewrite HE; have -> : zof [ffun => false] u = 0 by apply/matrixP => i j; rewrite !mxE ffunE.
rewrite mulmx0 subr0; split=> [e j|e].
  have := congr1 (fun m : 'cV[R]_n => m j 0) e; rewrite !mxE ffunE => <-; by rewrite subrK.
by apply/matrixP => i j; rewrite ord1 !mxE ffunE e addrK.
Qed.
(* the points of the primary edge, w = q + t d *)
Definition primary_point t : 'cV[R]_n.+1 := \col_k if unlift ord0 k is Some j then q j 0 + t * d j 0 else t.
Lemma primary_point0 t : primary_point t ord0 0 = t. Proof. by rewrite mxE unlift_none. Qed.
Lemma primary_point_lift t j : primary_point t (lift ord0 j) 0 = q j 0 + t * d j 0. Proof. by rewrite mxE liftK. Qed.
Lemma primary_vertex t l : nonneg (primary_point t) -> primary_point t l 0 = 0 ->
  vertex (H [ffun => false]) q l (primary_point t).
Proof.
have Ht : H [ffun => false] *m primary_point t = q.
  by apply/primaryE => j; rewrite primary_point_lift primary_point0.
move=> h e; split=> // k kl; rewrite lt_neqAle h andbT eq_sym; apply: contra kl => /eqP z.
by apply/eqP/(nd h Ht).
Qed.
Lemma primary_only l l' u u' : vertex (H [ffun => false]) q l u -> vertex (H [ffun => false]) q l' u' -> l = l'.
Proof.
have below m m' x x' : vertex (H [ffun => false]) q m x -> vertex (H [ffun => false]) q m' x' ->
    x ord0 0 < x' ord0 0 -> False.
  move=> xm [Hx' x'm' _] lt; have x0 := vertex_nonneg xm; case: (xm) => /primaryE Hx _ _.
  move/primaryE: Hx' => Hx'; suff : 0 < x' m' 0 by rewrite x'm' ltxx.
  case: (unliftP ord0 m') => [j ->|->]; last exact: le_lt_trans (x0 ord0) lt.
  rewrite Hx'; apply: le_lt_trans (x0 (lift ord0 j)) _.
  by rewrite Hx ltr_add2l ltr_pmul2r.
move=> ul ul'; case: (ltgtP (u ord0 0) (u' ord0 0)) => [h|h|h].
- by case: (below _ _ _ _ ul ul' h).
- by case: (below _ _ _ _ ul' ul h).
have e : u = u'.
  case: (ul) (ul') => /primaryE Hu _ _ [/primaryE Hu' _ _]; apply/matrixP => k j; rewrite ord1.
  by case: (unliftP ord0 k) => [i ->|-> //]; rewrite Hu Hu' h.
case: (ul) (ul') => Hu a _ [_ b _]; rewrite -e in b.
exact: (nd (vertex_nonneg ul) Hu a b).
Qed.
Lemma primary : odd (\sum_l is_vertex [ffun => false] l).
Proof.
suff [l [u ul]] : exists l u, vertex (H [ffun => false]) q l u.
  have vl : is_vertex [ffun => false] l by apply/is_vertexP; exists u.
  rewrite (bigD1 l) //= vl big1 // => m ml.
  case: (boolP (is_vertex [ffun => false] m)) => // /is_vertexP [x xm].
  by rewrite (primary_only xm ul) eqxx in ml.
case: (boolP [exists i, q i 0 < 0]) => [/existsP [i qi]|].
  case: (@arg_minP _ _ _ i predT (fun k => q k 0 / d k 0) isT) => k _ kmin.
  exists (lift ord0 k), (primary_point (- (q k 0 / d k 0))); apply: primary_vertex.
    move=> j; case: (unliftP ord0 j) => [m ->|->].
      by rewrite primary_point_lift mulNr subr_ge0 -ler_pdivl_mulr // kmin.
    rewrite primary_point0 oppr_ge0; apply: le_trans (kmin i isT) _.
    by rewrite pmulr_lle0 ?invr_gt0 // ltW.
  by rewrite primary_point_lift mulNr divfK ?subrr // gt_eqF.
rewrite negb_exists => /forallP p; exists ord0, (primary_point 0); apply: primary_vertex; last exact: primary_point0.
move=> j; case: (unliftP ord0 j) => [m ->|->]; last by rewrite primary_point0.
by rewrite primary_point_lift mul0r addr0 leNgt.
Qed.

Theorem solvable : exists s, is_vertex s ord0.
Proof.
apply/existsP; apply: contraT; rewrite negb_exists => /forallP none; exfalso.
apply: (contradiction across none (s0 := [ffun => false])) => [s ns|]; last exact: primary.
case: (boolP [exists l, is_vertex s l]) => [/existsP [l vl]|]; last first.
  rewrite negb_exists => /forallP no; rewrite big1 // => l _; by rewrite (negbTE (no l)).
have [u ul] := is_vertexP _ _ vl.
have l0 : l != ord0 by apply: contraTneq vl => ->; exact: none.
have [l' [u' [ll ul' only]]] := edge (nd (s := s)) ul (no_ray l0 ns ul).
rewrite (bigD1 l) //= (bigD1 l') //= vl.
have -> : is_vertex s l' by apply/is_vertexP; exists u'.
rewrite big1 // => m /andP [ml ml']; case: (boolP (is_vertex s m)) => // /is_vertexP [x xm].
by case: (only m x xm) => e; [rewrite e eqxx in ml | rewrite e eqxx in ml'].
Qed.

(* what it stands for *)
Definition lcp_solution (w z : 'cV[R]_n) :=
  [/\ nonneg w, nonneg z, w = M *m z + q & forall i, w i 0 * z i 0 = 0].
Lemma edge_solution s u : nonneg u -> H s *m u = q -> u ord0 0 = 0 -> lcp_solution (wof s u) (zof s u).
Proof.
move=> nn Hu u0; split.
- by move=> j; rewrite mxE; case: (s j).
- exact: z_nonneg.
- by move: Hu; rewrite HE u0 scale0r subr0 => <-; rewrite addrC subrK.
- by move=> i; rewrite !mxE; case: (s i); rewrite ?mul0r ?mulr0.
Qed.
Lemma basic_solution s y : nonneg y -> col' ord0 (H s) *m y = q ->
  lcp_solution (wof s (padl ord0 y)) (zof s (padl ord0 y)).
Proof.
move=> y0 Hy; apply: edge_solution; rewrite ?padlE // ?mxE ?unlift_none //.
by move=> k; rewrite mxE; case: unliftP.
Qed.
End LCP.
