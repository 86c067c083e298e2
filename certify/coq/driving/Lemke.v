(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that Lemke's method, as a function, ends, and where: for w = M z + q with a covering vector d > 0; over any
   ordered field, nondegenerate.
   Columns: number 0 is z0 (column -d), number j+1 is w_j or, if `s j`, z_j. A basis: a set s and a column l that is
   left out (zero); the edge of s: all n + 1 columns of s. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.existence Require Import Law Dot Edge Parity.
From Stiction.driving Require Import Path.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Lemke.
Variables (R : realFieldType) (n : nat) (M : 'M[R]_n) (d q : 'cV[R]_n).
Notation sel := {ffun 'I_n -> bool}.
Notation H := (H M d).
Notation candidate := (candidate M d q).
Notation is_vertex := (is_vertex M d q).

(* ---- the algorithm ---- *)
(* from the basis (s, l) the column l enters: the other columns change along `dir`, l by 1 *)
Definition dir (s : sel) l : 'cV[R]_n.+1 :=
  \col_k if unlift l k is Some j then - (invmx (col' l (H s)) *m col l (H s)) j 0 else 1.
(* the ratio test: the column that leaves; none: a ray *)
Definition ratio s l k := candidate s l k 0 / - dir s l k 0.
Definition pivot s l : option 'I_n.+1 :=
  [pick k | (dir s l k 0 < 0) && [forall k', (dir s l k' 0 < 0) ==> (ratio s l k <= ratio s l k')]].
(* the first basis: all w and z0, but for the w that z0, coming from infinity, makes zero first *)
Definition s0 : sel := [ffun => false].
Definition first : 'I_n.+1 :=
  if [pick i | (q i 0 < 0) && [forall j, q i 0 / d i 0 <= q j 0 / d j 0]] is Some i then lift ord0 i else ord0.
Inductive outcome := Solved of sel | Ray of sel & 'I_n.+1 | Running of sel & 'I_n.+1.
(* l has left on the edge s. If it is z0, the end; else its complement enters, on the edge `flip i s` *)
Definition step s l : outcome :=
  if unlift ord0 l is Some i then
    let s' := flip i s in if pivot s' l is Some l' then Running s' l' else Ray s' l
  else Solved s.
Fixpoint lemke fuel s l : outcome :=
  match step s l with
  | Running s' l' => if fuel is k.+1 then lemke k s' l' else Running s l
  | o => o
  end.
(* the bases met *)
Definition state k : option (sel * 'I_n.+1) :=
  iter k (obind (fun x => if step x.1 x.2 is Running s l then Some (s, l) else None)) (Some (s0, first)).

Arguments state : simpl never.

(* ---- what it does ---- *)
Hypothesis d0 : forall i, 0 < d i 0.
Hypothesis nd : forall s u, nonneg u -> H s *m u = q -> forall k l, u k 0 = 0 -> u l 0 = 0 -> k = l.

Lemma vertexC s l : is_vertex s l -> vertex (H s) q l (candidate s l).
Proof. by move=> v; have [u ul] := is_vertexP nd s l v; rewrite (candidateE nd ul). Qed.
Lemma dirE s l : is_vertex s l -> H s *m dir s l = 0 /\ dir s l l 0 = 1.
Proof.
move=> /vertexC ul; split; last by rewrite mxE unlift_none.
have -> : dir s l = padl l (- (invmx (col' l (H s)) *m col l (H s))) + \col_k (k == l)%:R.
  apply/matrixP => k j; rewrite !mxE; case: (unliftP l k) => [a ->|->]; last by rewrite eqxx add0r.
  by rewrite !mxE eq_sym (negbTE (neq_lift _ _)) addr0.
rewrite mulmxDr padlE mulmxN mulKVmx ?(basis_unit nd ul) //.
apply/matrixP => i j; rewrite [j]ord1 !mxE (bigD1 l) //= !mxE eqxx mulr1 big1 ?addr0 ?addNr // => k kl.
by rewrite mxE (negbTE kl) mulr0.
Qed.
Lemma ray_dir s l r : is_vertex s l -> H s *m r = 0 -> r = r l 0 *: dir s l.
Proof.
move=> v Hr; have [Hd dl] := dirE v; apply/eqP; rewrite -subr_eq0; apply/eqP.
apply: (kernel_zero (nd (s := s)) (vertexC v)).
  by rewrite mulmxBr -scalemxAr Hd Hr scaler0 subrr.
by rewrite mxE mxE [X in _ - X]mxE dl mulr1 subrr.
Qed.

(* the pivot: to the only other vertex of the edge, or, if there is none, a ray *)
Lemma pivotP s l : is_vertex s l ->
  if pivot s l is Some k then [/\ k != l, is_vertex s k & forall m, is_vertex s m -> m = l \/ m = k]
  else [/\ nonneg (dir s l), dir s l != 0, H s *m dir s l = 0 & forall m, is_vertex s m -> m = l].
Proof.
move=> v; have ul := vertexC v; have [Hd dl] := dirE v; have [Hu ull up] := ul; have u0 := vertex_nonneg ul.
set p := dir s l in Hd dl *; set u := candidate s l in ul Hu ull up u0 *.
rewrite /pivot; case: pickP => [k /andP [kn /forallP kmin]|h].
  have noray r : nonneg r -> H s *m r = 0 -> r = 0.
    move=> r0 Hr; have e := ray_dir v Hr; rewrite e.
    suff -> : r l 0 = 0 by rewrite scale0r.
    apply/eqP; rewrite eq_le r0 andbT leNgt; apply/negP => rl.
    by have := r0 k; rewrite e mxE leNgt pmulr_rlt0 // kn.
  have [l' [u' [ll vl' only]]] := edge (nd (s := s)) ul noray.
  have kl : k != l by apply/eqP => e; move: kn; rewrite -/p e dl ltr10.
  have vk : is_vertex s k.
    apply/(is_vertexP nd); exists (u + (ratio s l k) *: p).
    have pk : 0 < - p k 0 by rewrite oppr_gt0.
    have Hp : H s *m (u + ratio s l k *: p) = q by rewrite mulmxDr -scalemxAr Hd scaler0 addr0.
    have z : (u + ratio s l k *: p) k 0 = 0.
      rewrite mxE [X in _ + X]mxE /ratio -/u -/p -{2}[p k 0]opprK mulrN divfK ?subrr //.
      by rewrite gt_eqF.
    have nn : nonneg (u + ratio s l k *: p).
      move=> j; rewrite mxE [X in _ + X]mxE; case: (ltP (p j 0) 0) => [jn|jp]; last first.
        by rewrite addr_ge0 // mulr_ge0 // /ratio divr_ge0 // ltW.
      have := kmin j; rewrite -/p jn /= => le; have := le; rewrite [X in _ <= X -> _]/ratio -/u -/p.
      by rewrite ler_pdivl_mulr ?oppr_gt0 // mulrN -subr_ge0 opprK.
    split=> // j jk; rewrite lt_neqAle nn andbT eq_sym; apply: contra jk => /eqP e.
    by apply/eqP/(nd nn Hp).
  have kl' : k = l' by have [x xk] := is_vertexP nd s k vk; case: (only k x xk) => // e; rewrite e eqxx in kl.
  split=> // m /(is_vertexP nd) [x xm]; rewrite kl'; exact: only xm.
have pn : nonneg p.
  move=> k; rewrite leNgt; apply/negP => kn.
  case: (@arg_minP _ _ _ k (fun k => p k 0 < 0) (fun k => ratio s l k) kn) => j jn jmin.
  by have := h j; rewrite -/p jn /= => /forallP; apply => k'; apply/implyP/jmin.
split=> //; first by apply/eqP => e; move: dl; rewrite e mxE => /esym/eqP; rewrite oner_eq0.
move=> m vm; apply/eqP; apply: contraT => ml; have [Hx xm xp] := vertexC vm.
have e := ray_dir v (r := candidate s m - u); rewrite mulmxBr Hx Hu subrr in e; have {}e := e erefl.
have xl : 0 < (candidate s m - u) l 0 by rewrite mxE [X in _ + X]mxE ull subr0 xp // eq_sym.
have : 0 < candidate s m m 0.
  have := congr1 (fun x : 'cV[R]_n.+1 => x m 0) e; rewrite mxE [X in _ + X]mxE [X in _ = X]mxE => /eqP.
  rewrite subr_eq => /eqP ->; rewrite ltr_paddl ?up // mulr_ge0 //; exact: ltW.
by rewrite xm ltxx.
Qed.

(* the primary edge: w = q + z0 d, a ray with one vertex *)
Lemma first_vertex : is_vertex s0 first.
Proof.
rewrite /first; case: pickP => [i /andP [qi /forallP imin]|h]; apply/(is_vertexP nd).
  exists (primary_point d q (- (q i 0 / d i 0))); apply: (primary_vertex nd); last first.
    by rewrite primary_point_lift mulNr divfK ?subrr // gt_eqF.
  move=> j; case: (unliftP ord0 j) => [m ->|->].
    by rewrite primary_point_lift mulNr subr_ge0 -ler_pdivl_mulr // imin.
  by rewrite primary_point0 oppr_ge0 pmulr_lle0 ?invr_gt0 // ltW.
exists (primary_point d q 0); apply: (primary_vertex nd); last exact: primary_point0.
move=> j; case: (unliftP ord0 j) => [m ->|->]; last by rewrite primary_point0.
rewrite primary_point_lift mul0r addr0 leNgt; apply/negP => mn.
case: (@arg_minP _ _ _ m predT (fun k => q k 0 / d k 0) isT) => k _ kmin.
have := h k; rewrite (introT forallP) ?andbT => [|x]; last exact: kmin.
have -> // : q k 0 < 0.
have := kmin m isT; rewrite leNgt [X in ~~ X]ltNge negbK => le.
have : q k 0 / d k 0 < 0 by apply: le_lt_trans le _; rewrite pmulr_llt0 ?invr_gt0.
by rewrite pmulr_llt0 // invr_gt0.
Qed.
Lemma first_only l : is_vertex s0 l -> l = first.
Proof. by move=> /vertexC ul; apply: (primary_only d0 nd ul (vertexC first_vertex)). Qed.

(* ---- the graph: ends (s, l) of edges; matchings: over to the next edge, to the other end of the edge ---- *)
Definition over (x : sel * 'I_n.+1) : option (sel * 'I_n.+1) :=
  if is_vertex x.1 x.2 then if unlift ord0 x.2 is Some i then Some (flip i x.1, x.2) else None else None.
Definition along (x : sel * 'I_n.+1) : option (sel * 'I_n.+1) :=
  if is_vertex x.1 x.2 then if pivot x.1 x.2 is Some k then Some (x.1, k) else None else None.
Definition mates (c : bool) := if c then over else along.
Lemma unlift0 (l : 'I_n.+1) i : unlift ord0 l = Some i -> l = lift ord0 i.
Proof. by case: unliftP => // j -> [->]. Qed.
Lemma unlift00 (l : 'I_n.+1) : unlift ord0 l = None -> l = ord0.
Proof. by case: unliftP. Qed.
Lemma flip_neq i (s : sel) : flip i s <> s.
Proof. by move=> /ffunP /(_ i); rewrite ffunE eqxx; case: (s i). Qed.
Lemma mates_sym c x y : mates c x = Some y -> mates c y = Some x.
Proof.
case: c x y => -[s l] [s' l'] /=; rewrite /over /along /=.
  case: ifP => // v; case ul: (unlift ord0 l) => [i|] // [<- <-].
  have li : l = lift ord0 i := unlift0 ul.
  by rewrite {1}li (across nd) -li v ul flipK.
case: ifP => // v; have := pivotP v; case: (pivot s l) => // k [kl vk only] [<- <-].
rewrite vk; have := pivotP vk; case: (pivot s k) => [m [mk vm _]|[_ _ _ /(_ l v) e]]; last by rewrite e eqxx in kl.
by case: (only m vm) => [-> //|e]; rewrite e eqxx in mk.
Qed.
Lemma mates_irr c x : mates c x <> Some x.
Proof.
case: c x => -[s l] /=; rewrite /over /along /=; case: ifP => // v.
  by case: unlift => // i [] /flip_neq.
by have := pivotP v; case: (pivot s l) => // k [kl _ _] [] e; rewrite e eqxx in kl.
Qed.
Lemma mates_start : mates (~~ true) (s0, first) = None.
Proof.
rewrite /= /along /=; case: ifP => // v; have := pivotP v; case: (pivot s0 first) => // k [kl vk _].
by rewrite (first_only vk) eqxx in kl.
Qed.
Notation pos := (pos mates true (s0, first)).
Lemma is_vertex_pos k x : pos k = Some x -> is_vertex x.1 x.2.
Proof.
case: k => [[<-]|k /posS [y _]]; first exact: first_vertex.
by case: (turn _ _) => /=; rewrite /over /along; move=> e;
  move: (mates_sym (c := true)) (mates_sym (c := false)) => /=;
  rewrite /over /along => s1 s2; [move: (s1 _ _ e) | move: (s2 _ _ e)]; case: ifP.
Qed.
Lemma state_pos k : state k = pos k.*2.
Proof.
elim: k => [//|k IH]; rewrite /state iterS -/(state k) IH doubleS /= /turn /= odd_double /=.
case e: (pos k.*2) => [[s l]|] //=; have v := is_vertex_pos e; rewrite /= in v.
rewrite /over /step /= v; case ul: (unlift ord0 l) => [i|] //=.
have vo : is_vertex (flip i s) l.
  have li : l = lift ord0 i := unlift0 ul.
  by rewrite li (across nd) -li.
by rewrite /along /= vo; case: pivot.
Qed.
Lemma state_vertex k s l : state k = Some (s, l) -> is_vertex s l.
Proof. by rewrite state_pos => /is_vertex_pos. Qed.

(* no edge, hence no basis, comes twice *)
Lemma on_edge s l1 l2 l3 : is_vertex s l1 -> is_vertex s l2 -> is_vertex s l3 -> [|| l1 == l2, l1 == l3 | l2 == l3].
Proof.
move=> v1 v2 v3; have := pivotP v1; case: (pivot s l1) => [k [_ _ only]|[_ _ _ only]].
  case: (only _ v2) => ->; first by rewrite eqxx.
  by case: (only _ v3) => ->; rewrite eqxx ?orbT.
by rewrite (only _ v2) eqxx.
Qed.
Lemma entered k s l : state k.+1 = Some (s, l) -> exists2 l', pos k.*2.+1 = Some (s, l') & is_vertex s l'.
Proof.
rewrite state_pos doubleS => /posS [[s' l'] e] h.
have [<- v] : s' = s /\ is_vertex s' l'.
  move: h; rewrite /turn /= odd_double /= /along /=.
  by case: ifP => // v; case: (pivot s' l') => // a [<- _].
by exists l'.
Qed.
Theorem edges_distinct i j s l l' : state i = Some (s, l) -> state j = Some (s, l') -> i = j.
Proof.
wlog lt : i j l l' / (i < j)%N => [w pi pj|pi pj].
  by case: (ltngtP i j) => // h; [exact: w pi pj | symmetry; exact: w pj pi].
exfalso; case: j lt pj => // j lt pj.
have inj := pos_inj mates_sym mates_irr mates_start.
have vi := state_vertex pi; have vj := state_vertex pj; have [m pm vm] := entered pj.
have pi' := pi; have pj' := pj; rewrite !state_pos in pi' pj'.
have dij : l <> l' by move=> e; rewrite -e in pj'; have /double_inj e' := inj _ _ _ pi' pj'; rewrite e' ltnn in lt.
have dim : l <> m.
  move=> e; rewrite -e in pm; have := congr1 odd (inj _ _ _ pi' pm); by rewrite /= !odd_double.
case: i lt pi pi' => [|i] lt pi pi'.
  case: pi => es el; rewrite -es in vm; rewrite -es in vj.
  by apply: dij; rewrite -el (first_only vj).
have [a pa va] := entered pi.
have dal' : a <> l'.
  move=> e; rewrite -e in pj'; have := congr1 odd (inj _ _ _ pa pj'); by rewrite /= !odd_double.
have dam : a <> m.
  move=> e; rewrite -e in pm; have [/double_inj e'] := inj _ _ _ pa pm; by rewrite -e' ltnn in lt.
have dla : l <> a.
  move=> e; rewrite -e in pa; have := congr1 odd (inj _ _ _ pi' pa); by rewrite /= !odd_double.
case/or3P: (on_edge vi va vj) => /eqP; [exact: dla | exact: dij | exact: dal'].
Qed.

Lemma state_le j k x : (j <= k)%N -> state k = Some x -> exists y, state j = Some y.
Proof.
rewrite !state_pos => le; apply: pos_le; by rewrite leq_double.
Qed.
Lemma state_bound k x : state k = Some x -> (k < 2 ^ n)%N.
Proof.
move=> e; pose f (j : 'I_k.+1) := odflt s0 (omap fst (state j)).
have fE (j : 'I_k.+1) : exists l, state j = Some (f j, l).
  have [|[s l] ej] := state_le (j := j) _ e; first by rewrite -ltnS.
  by exists l; rewrite /f ej.
have fi : injective f.
  move=> i j eij; have [l el] := fE i; have [l' el'] := fE j; rewrite -eij in el'.
  exact/val_inj/(edges_distinct el el').
by have := leq_card f fi; rewrite card_ord card_ffun card_bool card_ord.
Qed.

Lemma stateS k s l s' l' : state k = Some (s, l) -> step s l = Running s' l' -> state k.+1 = Some (s', l').
Proof. by move=> e st; rewrite /state iterS -/(state k) e /= st. Qed.
(* the run is the sequence of states *)
Lemma lemke_state k : forall a s l, state k = Some (s, l) ->
  match lemke a s l with
  | Solved s' => exists j, state j = Some (s', ord0)
  | Ray s' l' => exists j i s'', [/\ state j = Some (s'', l'), l' = lift ord0 i, s' = flip i s'' & pivot s' l' = None]
  | Running s' l' => exists x, state (k + a).+1 = Some x
  end.
Proof.
move=> a; elim: a k => [|a IH] k s l e /=; have := erefl (step s l); rewrite {2}/step;
  case ul: (unlift ord0 l) => [i|]; try (case pv: (pivot (flip i s) l) => [l'|]); move=> /= st; rewrite ?st.
- by exists (flip i s, l'); rewrite addn0; exact: stateS e st.
- exists k, i, s; split=> //.
  exact: unlift0.
- by exists k; rewrite e (unlift00 ul).
- rewrite addnS -addSn; apply: IH; exact: stateS e st.
- exists k, i, s; split=> //.
  exact: unlift0.
- by exists k; rewrite e (unlift00 ul).
Qed.

(* Lemke's method ends, after at most 2^n - 1 pivots: in a solution, or in a secondary ray *)
Theorem lemke_ends :
  match lemke (2 ^ n).-1 s0 first with
  | Solved s => is_vertex s ord0 : Prop
  | Ray s l => [/\ s != s0, l != ord0, is_vertex s l & nonneg (dir s l) /\ (H s *m dir s l = 0 /\ dir s l != 0)]
  | Running _ _ => False
  end.
Proof.
have := @lemke_state 0%N (2 ^ n).-1 s0 first erefl; case: lemke => [s [j /state_vertex //]|s l|s l [x /state_bound]].
  move=> [j [i [s' [e li es pv]]]]; have v' := state_vertex e.
  have v : is_vertex s l by rewrite es li (across nd) -li.
  have := pivotP v; rewrite pv => -[nn nz Hd only]; split=> //; last by rewrite li eq_sym neq_lift.
  apply/eqP => ss; rewrite ss in v es; have lf := first_only v.
  (* at the primary edge one comes from the first vertex, and that is where the path began *)
  case: j e => [[e _]|j e]; first by move: (@flip_neq i s'); rewrite -es e.
  have inj := pos_inj mates_sym mates_irr mates_start.
  have p0 : pos j.+1.*2 = Some (s', l) by rewrite -state_pos.
  have p1 : pos j.+1.*2.+1 = Some (s0, first).
    rewrite /= -/(pos j.+1.*2) /= in p0 *; rewrite p0 /= /turn /= odd_double /= /over /= v' li liftK.
    by rewrite -es -lf li.
  by have := inj 0%N _ _ erefl p1.
by rewrite add0n prednK ?expn_gt0 // ltnn.
Qed.

(* ---- copositive matrices: no secondary ray, so a solution ---- *)
Hypothesis copositive : forall z, nonneg z -> 0 <= dotp z (M *m z).
Hypothesis rays : forall z z', nonneg z -> nonneg z' -> nonneg (M *m z) -> dotp z (M *m z) = 0 ->
  0 <= dotp z q /\ 0 <= dotp z (M *m z') + dotp z' (M *m z).

(* the answer that a set of basic z's stands for *)
Definition z_of s := zof s (candidate s ord0).
Definition w_of s := wof s (candidate s ord0).
Lemma answer s : is_vertex s ord0 -> lcp_solution M q (w_of s) (z_of s).
Proof. by move=> /vertexC ul; have [Hu u0 _] := ul; apply: edge_solution Hu u0; exact: vertex_nonneg ul. Qed.
Theorem lemke_ends_in_a_solution :
  exists s, lemke (2 ^ n).-1 s0 first = Solved s /\ lcp_solution M q (w_of s) (z_of s).
Proof.
have := lemke_ends; case: lemke => [s v|s l [ns nl v [nn [Hd nz]]]|//]; first by exists s; split=> //; exact: answer.
by rewrite (no_ray d0 nd copositive rays nl ns (vertexC v) nn Hd) eqxx in nz.
Qed.
End Lemke.
