(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves, over any ordered field, that an edge (n rows, n + 1 columns) of a nondegenerate system has two vertices,
   or a ray; and that some row combination p /= 0 vanishes in all but two columns, by which systems are seen to be
   nondegenerate. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.existence Require Import Dot.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Edge.
Variables (R : realFieldType) (n : nat) (H : 'M[R]_(n, n.+1)) (q : 'cV[R]_n).
Definition vertex (l : 'I_n.+1) (u : 'cV[R]_n.+1) :=
  [/\ H *m u = q, u l 0 = 0 & forall k, k != l -> 0 < u k 0].
Hypothesis nd : forall u, nonneg u -> H *m u = q -> forall k l, u k 0 = 0 -> u l 0 = 0 -> k = l.

Lemma vertex_nonneg l u : vertex l u -> nonneg u.
Proof. by case=> _ ul up k; case: (altP (k =P l)) => [->|/up/ltW //]; rewrite ul. Qed.

Lemma first_zero u v k0 : nonneg u -> H *m u = q -> H *m v = 0 -> v k0 0 < 0 ->
  exists t k, [/\ 0 <= t, nonneg (u + t *: v), v k 0 < 0, u k 0 + t * v k 0 = 0 & H *m (u + t *: v) = q].
Proof.
move=> u0 Hu Hv k0n.
case: (@arg_minP _ _ _ k0 (fun k => v k 0 < 0) (fun k => u k 0 / - v k 0) k0n) => k kn kmin.
have vk : 0 < - v k 0 by rewrite oppr_gt0.
exists (u k 0 / - v k 0), k; split=> //.
- by rewrite divr_ge0 // ltW.
- move=> j; rewrite !mxE; case: (ltP (v j 0) 0) => [jn|jp].
    have := kmin j jn; rewrite ler_pdivl_mulr ?oppr_gt0 // mulrN => h.
    by rewrite -ler_subl_addr sub0r.
  by rewrite addr_ge0 // mulr_ge0 // divr_ge0 // ltW.
- by rewrite invrN mulrN mulNr -mulrA mulVf ?mulr1 ?subrr // lt_eqF.
- by rewrite mulmxDr -scalemxAr Hv scaler0 addr0.
Qed.

Lemma kernel_zero l u (y : 'cV[R]_n.+1) : vertex l u -> H *m y = 0 -> y l 0 = 0 -> y = 0.
Proof.
move=> ul Hy yl; have u0 := vertex_nonneg ul; case: (ul) => Hu ull _.
have no : forall (z : 'cV[R]_n.+1) k, H *m z = 0 -> z l 0 = 0 -> ~~ (z k 0 < 0).
  move=> z k Hz zl; case: (boolP (z k 0 < 0)) => // zn; exfalso.
  have [t [k' [t0 p zk' uk Hp]]] := first_zero u0 Hu Hz zn.
  have e : k' = l by (apply: (nd p Hp); rewrite !mxE ?uk // ull zl mulr0 addr0).
  by move: zk'; rewrite e zl ltxx.
apply/matrixP => k j; rewrite ord1 mxE; apply/eqP; rewrite eq_le.
have := no y k Hy yl; rewrite -leNgt => ->; rewrite andbT.
have := no (- y) k; rewrite mulmxN Hy oppr0 !mxE yl oppr0 => /(_ erefl erefl).
by rewrite oppr_lt0 -leNgt.
Qed.

Lemma kernel_exists : exists2 v : 'cV[R]_n.+1, H *m v = 0 & v != 0.
Proof.
have r : (0 < \rank (kermx H^T))%N by rewrite mxrank_ker subn_gt0 ltnS rank_leq_col.
have nz : kermx H^T != 0 by rewrite -mxrank_eq0 -lt0n.
exists (nz_row (kermx H^T))^T.
  by apply: trmx_inj; rewrite trmx_mul trmxK trmx0; apply/sub_kermxP/nz_row_sub.
by rewrite -(inj_eq (@trmx_inj _ _ _)) trmxK trmx0 nz_row_eq0.
Qed.

(* one vertex and no ray: exactly one other vertex *)
Lemma edge l u : vertex l u -> (forall v, nonneg v -> H *m v = 0 -> v = 0) ->
  exists l' u', [/\ l' != l, vertex l' u' & forall m x, vertex m x -> m = l \/ m = l'].
Proof.
move=> ul noray; have u0 := vertex_nonneg ul; case: (ul) => Hu ull _.
have [v Hv vl] : exists2 v : 'cV[R]_n.+1, H *m v = 0 & v l 0 = 1.
  have [v0 Hv0 nz] := kernel_exists.
  have v0l : v0 l 0 != 0 by apply: contra nz => /eqP /(kernel_zero ul Hv0) ->.
  by exists ((v0 l 0)^-1 *: v0); [rewrite -scalemxAr Hv0 scaler0 | rewrite mxE mulVf].
have [k0 k0n] : exists k, v k 0 < 0.
  apply/existsP; apply: contraT; rewrite negb_exists => /forallP p.
  have z : v = 0 by apply: noray => // k; have := p k; rewrite -leNgt.
  by move: vl; rewrite z mxE => /esym/eqP; rewrite oner_eq0.
have [t [k [t0 p vk uk Hp]]] := first_zero u0 Hu Hv k0n.
have pE m : (u + t *: v) m 0 = u m 0 + t * v m 0 by rewrite !mxE.
have kl : k != l.
  by apply/eqP => e; move: vk; rewrite e vl ltr10.
exists k, (u + t *: v); split=> //.
  split=> //; first by rewrite pE.
  move=> j jk; rewrite lt_neqAle p andbT eq_sym; apply: contra jk => /eqP z.
  by apply/eqP/(nd p Hp) => //; rewrite pE uk.
move=> m x xm; case: (altP (m =P l)) => [|ml]; [by left | right].
have [Hx xmm xp] := xm; have x0 := vertex_nonneg xm.
have xe : x = u + x l 0 *: v.
  apply/eqP; rewrite -subr_eq0; apply/eqP; apply: (kernel_zero ul).
    by rewrite mulmxBr mulmxDr -scalemxAr Hv Hx Hu scaler0 addr0 subrr.
  by rewrite !mxE vl ull add0r mulr1 subrr.
have xE j : x j 0 = u j 0 + x l 0 * v j 0 by rewrite {1}xe !mxE.
have s0 : 0 < x l 0 by rewrite xp // eq_sym.
have [_ _ up] := ul.
have vm : v m 0 < 0.
  rewrite ltNge; apply/negP => h; have h1 := up m ml.
  have h2 : 0 < x m 0 by rewrite (xE m) ltr_paddr // mulr_ge0 // ltW.
  by move: h2; rewrite xmm ltxx.
have sle : x l 0 <= t.
  have h : 0 <= (x l 0 - t) * v k 0.
    have -> : (x l 0 - t) * v k 0 = x k 0 - (u k 0 + t * v k 0) by rewrite (xE k) mulrBl opprD addrACA subrr add0r.
    by rewrite uk subr0.
  by move: h; rewrite nmulr_lge0 // subr_le0.
have tle : t <= x l 0.
  have h : 0 <= (t - x l 0) * v m 0.
    have := p m; rewrite pE => h.
    have -> : (t - x l 0) * v m 0 = (u m 0 + t * v m 0) - x m 0 by rewrite (xE m) mulrBl opprD addrACA subrr add0r.
    by rewrite xmm subr0.
  by move: h; rewrite nmulr_lge0 // subr_le0.
have e : x l 0 = t by apply/eqP; rewrite eq_le sle tle.
apply: (nd p Hp); last by rewrite pE.
by rewrite -e -xe xmm.
Qed.
End Edge.

(* p A is zero but for the columns k and l *)
Lemma annihilate (R : realFieldType) n (A : 'M[R]_(n, n.+1)) k l : k != l ->
  exists2 p : 'rV[R]_n, p != 0 & forall j, j != k -> j != l -> (p *m A) 0 j = 0.
Proof.
case: n A k l => [|m] A k l; first by rewrite !ord1 eqxx.
move=> kl; case: (unliftP k l) => [l' ll|e]; last by rewrite e eqxx in kl.
pose K : 'M[R]_(m.+1, m) := \matrix_(i, j) A i (lift k (lift l' j)).
have r : (0 < \rank (kermx K))%N by rewrite mxrank_ker subn_gt0 ltnS rank_leq_col.
have [p p0 pK] : exists2 p : 'rV[R]_m.+1, p != 0 & p *m K = 0.
  exists (nz_row (kermx K)); first by rewrite nz_row_eq0 -mxrank_eq0 -lt0n.
  by apply/sub_kermxP/nz_row_sub.
exists p => // j jk jl; case: (unliftP k j) jk jl => [j' ->|->]; last by rewrite eqxx.
move=> _; rewrite ll; case: (unliftP l' j') => [a ->|->]; last by rewrite eqxx.
move=> _; have := congr1 (fun x : 'rV[R]_m => x 0 a) pK; rewrite !mxE => h; rewrite -[RHS]h.
by apply: eq_bigr => b _; rewrite ?mxE.
Qed.
