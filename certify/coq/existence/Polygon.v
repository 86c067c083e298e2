(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that friction in space with finitely many directions d_k in place of the circle has a solution: forces of
   the polygon (any directions); and a weaker law in the disc (directions in it), from which Approx.v goes on. *)
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Stiction.existence Require Import Law Dot Edge Parity Limit Finite Statement.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Length.
Variable R : rcfType.
Lemma ss_ge0 (x y : R) : 0 <= x ^+ 2 + y ^+ 2. Proof. by rewrite addr_ge0 ?sqr_ge0. Qed.
Lemma len_ge0 (x y : R) : 0 <= length x y. Proof. exact: sqrtr_ge0. Qed.
Lemma len_sqr (x y : R) : length x y ^+ 2 = x ^+ 2 + y ^+ 2. Proof. by rewrite sqr_sqrtr // ss_ge0. Qed.
Lemma len00 : length 0 0 = 0 :> R. Proof. by rewrite /length expr0n addr0 sqrtr0. Qed.
Lemma len_eq0 (x y : R) : length x y = 0 -> x = 0 /\ y = 0.
Proof.
move=> e; have := len_sqr x y; rewrite e expr0n => /esym/eqP.
by rewrite paddr_eq0 ?sqr_ge0 // !sqrf_eq0 => /andP [/eqP -> /eqP ->].
Qed.
Lemma le_len (x y c : R) : 0 <= c -> x ^+ 2 + y ^+ 2 <= c ^+ 2 -> length x y <= c.
Proof. by move=> c0 h; rewrite -(@ler_pexpn2r _ 2) ?nnegrE ?len_ge0 // len_sqr. Qed.
Lemma len_maxl (x y : R) : `|x| <= length x y.
Proof. by rewrite -sqrtr_sqr /length ler_wsqrtr // ler_addl sqr_ge0. Qed.
Lemma len_maxr (x y : R) : `|y| <= length x y.
Proof. by rewrite -sqrtr_sqr /length ler_wsqrtr // ler_addr sqr_ge0. Qed.
Lemma lenZ (c x y : R) : 0 <= c -> length (c * x) (c * y) = c * length x y.
Proof. by move=> c0; rewrite /length !exprMn -mulrDr sqrtrM ?sqr_ge0 // sqrtr_sqr ger0_norm. Qed.
Lemma cauchy (x y u v : R) : x * u + y * v <= length x y * length u v.
Proof.
case: (lerP (x * u + y * v) 0) => [h|h]; first by rewrite (le_trans h) // mulr_ge0 // len_ge0.
rewrite -(@ler_pexpn2r _ 2) ?nnegrE ?(ltW h) ?mulr_ge0 ?len_ge0 //.
rewrite exprMn !len_sqr -subr_ge0.
have -> : (x ^+ 2 + y ^+ 2) * (u ^+ 2 + v ^+ 2) - (x * u + y * v) ^+ 2 = (x * v - y * u) ^+ 2 by ring.
exact: sqr_ge0.
Qed.
(* a nonnegative combination of vectors of the disc is no longer than its weights *)
Lemma len_comb (K : finType) (be dx dy : K -> R) : (forall k, 0 <= be k) -> (forall k, length (dx k) (dy k) <= 1) ->
  length (\sum_k be k * dx k) (\sum_k be k * dy k) <= \sum_k be k.
Proof.
move=> be0 d1; set X := \sum_k be k * dx k; set Y := \sum_k be k * dy k.
have s0 : 0 <= \sum_k be k by apply: sumr_ge0.
case: (altP (length X Y =P 0)) => [->//|nz].
have lp : 0 < length X Y by rewrite lt_neqAle eq_sym nz len_ge0.
rewrite -(ler_pmul2r lp) -expr2 len_sqr mulr_suml.
have -> : X ^+ 2 + Y ^+ 2 = \sum_k be k * (dx k * X + dy k * Y).
  rewrite !expr2 {1}/X {1}/Y !mulr_suml -big_split; apply: eq_bigr => k _ /=; ring.
apply: ler_sum => k _; apply: ler_wpmul2l => //; apply: (le_trans (cauchy _ _ _ _)).
by rewrite -[leRHS]mul1r ler_wpmul2r // len_ge0.
Qed.
End Length.


Section Rows.
Variables (R : rcfType) (n : nat).
Notation V := ('cV[R]_(n + (n + n))).
Implicit Types (f a : V) (i : 'I_n).
Definition nor f i := f (lshift (n + n) i) 0.
Definition tx f i := f (rshift n (lshift n i)) 0.
Definition ty f i := f (rshift n (rshift n i)) 0.
Definition eN i : V := delta_mx (lshift (n + n) i) 0.
Definition eX i : V := delta_mx (rshift n (lshift n i)) 0.
Definition eY i : V := delta_mx (rshift n (rshift n i)) 0.
Lemma dotp_delta r a : dotp (delta_mx r 0) a = a r 0.
Proof.
rewrite /dotp (bigD1 r) //= mxE !eqxx mul1r big1 ?addr0 // => s sr.
by rewrite mxE (negbTE sr) mul0r.
Qed.
Lemma dotp_rows f a : dotp f a = \sum_i (nor f i * nor a i + (tx f i * tx a i + ty f i * ty a i)).
Proof. by rewrite /dotp !big_split_ord /= !big_split. Qed.
Lemma rowsP f a : (forall i, [/\ nor f i = nor a i, tx f i = tx a i & ty f i = ty a i]) -> f = a.
Proof.
move=> h; apply/matrixP => r j; rewrite ord1.
case: (split_ordP r) => [i ->|s ->]; first by case: (h i).
by case: (split_ordP s) => i ->; case: (h i).
Qed.
(* the product of the friction cones *)
Definition cone (mu : 'I_n -> R) f := forall i, 0 <= nor f i /\ length (tx f i) (ty f i) <= mu i * nor f i.
End Rows.

(* f and a satisfy Coulomb's law (k = 1), or that law up to a factor k *)
Section Law.
Variables (R : rcfType) (n : nat).
Notation V := 'cV[R]_(n + (n + n)).
Definition obeys (k : R) (mu : 'I_n -> R) (f a : V) := forall i,
  normal_conditions (nor f i) (nor a i) /\
  length (tx f i) (ty f i) <= mu i * nor f i /\
  tx f i * tx a i + ty f i * ty a i <= - (k * length (tx a i) (ty a i) * (mu i * nor f i)).
Lemma norZ c (f : V) i : nor (c *: f) i = c * nor f i. Proof. by rewrite /nor mxE. Qed.
Lemma txZ c (f : V) i : tx (c *: f) i = c * tx f i. Proof. by rewrite /tx mxE. Qed.
Lemma tyZ c (f : V) i : ty (c *: f) i = c * ty f i. Proof. by rewrite /ty mxE. Qed.
Lemma obeys_cone k mu f a : obeys k mu f a -> cone mu f.
Proof. by move=> h i; case: (h i) => [] [? _ _] [? _]. Qed.
Lemma obeys_scale c k mu f a : 0 <= c -> obeys k mu f a -> obeys k mu (c *: f) (c *: a).
Proof.
move=> c0 h i; have [[n1 n2 n3] [h1 h2]] := h i; rewrite !norZ !txZ !tyZ !lenZ //.
split; first by split; rewrite ?mulr_ge0 // mulrACA n3 mulr0.
split; first by rewrite mulrCA ler_wpmul2l.
move: h2; set L := length _ _ => h2.
have -> : c * tx f i * (c * tx a i) + c * ty f i * (c * ty a i) = c * c * (tx f i * tx a i + ty f i * ty a i) by ring.
have -> : - (k * (c * L) * (mu i * (c * nor f i))) = c * c * (- (k * L * (mu i * nor f i))) by ring.
by apply: ler_wpmul2l => //; rewrite mulr_ge0.
Qed.
Lemma obeys_power k mu f a : 0 <= k -> obeys k mu f a -> dotp f a <= 0.
Proof.
move=> k0 h; rewrite dotp_rows -oppr_ge0 -sumrN sumr_ge0 // => i _; rewrite oppr_ge0.
have [[n1 n2 n3] [h1 h2]] := h i; rewrite n3 add0r (le_trans h2) // oppr_le0.
by apply: mulr_ge0; [rewrite mulr_ge0 // len_ge0 | exact: le_trans (len_ge0 _ _) h1].
Qed.
Lemma obeys_weak k l mu f a : k <= l -> obeys l mu f a -> obeys k mu f a.
Proof.
move=> kl h i; have [nl [h1 h2]] := h i; split=> //; split=> //; apply: (le_trans h2).
rewrite ler_opp2; apply: ler_wpmul2r; first exact: le_trans (len_ge0 _ _) h1.
by apply: ler_wpmul2r => //; exact: len_ge0.
Qed.
End Law.

Section Polygon.
Variables (R : rcfType) (n : nat) (A : 'M[R]_(n + (n + n))) (b : 'cV[R]_(n + (n + n))) (mu : 'I_n -> R).
Hypothesis psd : forall f, 0 <= dotp f (A *m f).
Hypothesis mu0 : forall i, 0 <= mu i.
Variables (K : finType) (dx dy : K -> R).
Hypothesis disc : forall k, length (dx k) (dy k) <= 1.
Definition polygonal (f a : 'cV[R]_(n + (n + n))) := forall i,
  normal_conditions (nor f i) (nor a i) /\
  length (tx f i) (ty f i) <= mu i * nor f i /\
  exists2 l, 0 <= l & (forall k, 0 <= l + (dx k * tx a i + dy k * ty a i)) /\
    tx f i * tx a i + ty f i * ty a i = - (l * (mu i * nor f i)).
Hypothesis safe : forall v, polygonal v (A *m v) -> 0 <= dotp v b.
Definition polygonal_itself (f a : 'cV[R]_(n + (n + n))) := forall i, normal_conditions (nor f i) (nor a i) /\
  polygon_law dx dy (mu i) (nor f i) (tx f i) (ty f i) (tx a i) (ty a i).

(* unknowns: N i, beta i k, lambda i *)
Let T := (('I_n + 'I_n * K) + 'I_n)%type.
Let E (x : T) : 'cV[R]_(n + (n + n)) := match x with
  | inl (inl i) => eN R i
  | inl (inr ik) => dx ik.2 *: eX R ik.1 + dy ik.2 *: eY R ik.1
  | inr i => 0 end.
Let S (x y : T) : R := match x, y with
  | inl (inr ik), inr j => (ik.1 == j)%:R
  | inr i, inl (inl j) => (i == j)%:R * mu i
  | inr i, inl (inr jk) => - (i == jk.1)%:R
  | _, _ => 0 end.
Let sum1 (F : 'I_n -> R) i : \sum_j (i == j)%:R * F j = F i.
Proof.
rewrite (bigD1 i) //= eqxx mul1r big1 ?addr0 // => j; rewrite eq_sym => /negbTE ->; by rewrite mul0r.
Qed.
Let sumP (F : 'I_n * K -> R) : \sum_p F p = \sum_j \sum_k F (j, k).
Proof. by rewrite pair_bigA; apply: eq_bigr => -[]. Qed.
Let total (z : T -> R) i := \sum_k z (inl (inr (i, k))).
Let SN z i : app S z (inl (inl i)) = 0.
Proof. by apply: big1 => y _; rewrite mul0r. Qed.
Let SB z i k : app S z (inl (inr (i, k))) = z (inr i).
Proof.
rewrite /app big_sumType /= big1 ?add0r => [|y _]; last by rewrite mul0r.
by rewrite sum1.
Qed.
Let SL z i : app S z (inr i) = mu i * z (inl (inl i)) - total z i.
Proof.
rewrite /app big_sumType /= [X in _ + X]big1 ?addr0 => [|y _]; last by rewrite mul0r.
rewrite big_sumType /=; congr (_ + _).
  under eq_bigr do rewrite -mulrA; by rewrite (sum1 (fun j => mu i * z (inl (inl j)))).
rewrite sumP -(sum1 (total z)) -sumrN.
by apply: eq_bigr => j _ /=; rewrite -mulr_sumr mulNr.
Qed.
Let ipS z z' : ip z (app S z') = \sum_i (total z i * z' (inr i) + z (inr i) * (mu i * z' (inl (inl i)) - total z' i)).
Proof.
rewrite /ip big_sumType /= big_sumType /= big1 ?add0r => [|i _]; last by rewrite SN mulr0.
rewrite sumP -big_split.
apply: eq_bigr => i _; rewrite SL; congr (_ + _).
by rewrite /total mulr_suml; apply: eq_bigr => k _; rewrite SB.
Qed.
Let skew z z' : nng z -> nng z' -> 0 <= ip z (app S z') + ip z' (app S z).
Proof.
move=> h h'; rewrite !ipS -big_split; apply: sumr_ge0 => i _ /=.
have := h (inr i); have := h' (inr i); have := h (inl (inl i)); have := h' (inl (inl i)).
move: (total z i) (total z' i) (z (inr i)) (z' (inr i)) (z (inl (inl i))) (z' (inl (inl i))) (mu0 i).
move: (mu i) => m t t' l l' N N' m0 hN' hN hl' hl.
rewrite (_ : _ + _ = l * (m * N') + l' * (m * N)); last by ring.
by rewrite addr_ge0 // !mulr_ge0.
Qed.
Let force_rows z i : [/\ nor (force E z) i = z (inl (inl i)),
  tx (force E z) i = \sum_k z (inl (inr (i, k))) * dx k & ty (force E z) i = \sum_k z (inl (inr (i, k))) * dy k].
Proof.
have fr r : force E z r 0 = \sum_j z (inl (inl j)) * eN R j r 0 +
    \sum_j \sum_k z (inl (inr (j, k))) * (dx k * eX R j r 0 + dy k * eY R j r 0).
  rewrite /force summxE big_sumType /= [X in _ + X]big1 ?addr0 => [|j _]; last by rewrite scaler0 mxE.
  rewrite big_sumType /= sumP; congr (_ + _); first by apply: eq_bigr => j _; rewrite mxE.
  by apply: eq_bigr => j _; apply: eq_bigr => k _; rewrite !mxE.
rewrite /nor /tx /ty !fr /eN /eX /eY; split.
- rewrite [X in _ + X]big1 ?addr0 => [|j _]; last first.
    by apply: big1 => k _; rewrite !mxE !eq_shift /= !mulr0 addr0 mulr0.
  rewrite -[RHS](sum1 (fun j => z (inl (inl j)))); apply: eq_bigr => j _.
  by rewrite !mxE !eq_shift andbT mulrC.
- rewrite big1 ?add0r => [|j _]; last by rewrite !mxE !eq_shift /= mulr0.
  rewrite -(sum1 (fun j => \sum_k z (inl (inr (j, k))) * dx k)); apply: eq_bigr => j _.
  rewrite mulr_sumr; apply: eq_bigr => k _; rewrite !mxE !eq_shift /= !mulr0 addr0 andbT.
  by rewrite mulrA mulrC.
- rewrite big1 ?add0r => [|j _]; last by rewrite !mxE !eq_shift /= mulr0.
  rewrite -(sum1 (fun j => \sum_k z (inl (inr (j, k))) * dy k)); apply: eq_bigr => j _.
  rewrite mulr_sumr; apply: eq_bigr => k _; rewrite !mxE !eq_shift /= !mulr0 add0r andbT.
  by rewrite mulrA mulrC.
Qed.
(* what a solution of the complementarity problem says of the rows of contact i; z (inr i) is lambda *)
Let rows_of z a i : comp E S z a -> let f := force E z in let bound := mu i * nor f i in let l := z (inr i) in
  [/\ normal_conditions (nor f i) (nor a i), 0 <= l, total z i <= bound,
      forall k, 0 <= l + (dx k * tx a i + dy k * ty a i)
    & tx f i * tx a i + ty f i * ty a i = - (l * bound)].
Proof.
move=> [z0 w0] /=; set f := force E z.
have [fN fX fY] := force_rows z i; rewrite -/f in fN fX fY.
have [n1 n2] := w0 (inl (inl i)); rewrite SN addr0 /= dotp_delta in n1 n2.
have ae k : dotp (E (inl (inr (i, k)))) a = dx k * tx a i + dy k * ty a i.
  by rewrite /= dotpDl dotpC dotpZ dotpC dotp_delta dotpC dotpZ dotpC dotp_delta.
have c2 k : z (inl (inr (i, k))) * (dx k * tx a i + dy k * ty a i) = - (z (inl (inr (i, k))) * z (inr i)).
  have [_] := w0 (inl (inr (i, k))); rewrite SB ae mulrDr => /eqP.
  by rewrite addr_eq0 => /eqP.
have [l1 l2] := w0 (inr i); rewrite SL /= dotpC dotp0 add0r in l1 l2.
split=> //.
- by split; rewrite ?fN // /nor.
- by rewrite fN -subr_ge0.
- by move=> k; have [+ _] := w0 (inl (inr (i, k))); rewrite SB ae addrC.
rewrite fX fY fN !mulr_suml -big_split /=.
rewrite (eq_bigr (fun k => - (z (inr i) * z (inl (inr (i, k)))))) => [|k _]; last first.
  by rewrite -!mulrA -mulrDr c2 mulrC.
rewrite sumrN -mulr_sumr -/(total z i); congr (- _).
by move/eqP: l2; rewrite mulrBr subr_eq0 => /eqP ->.
Qed.
Let polygonal_of z a : comp E S z a -> polygonal (force E z) a.
Proof.
move=> h i; have [nl l0 le ge power] := rows_of i h; have [_ fX fY] := force_rows z i; have [z0 _] := h.
split=> //; split; first by rewrite fX fY (le_trans (len_comb _ disc)).
by exists (z (inr i)).
Qed.
Let itself_of z a : comp E S z a -> polygonal_itself (force E z) a.
Proof.
move=> h i; have [nl l0 le ge power] := rows_of i h; have [fN fX fY] := force_rows z i; have [z0 _] := h.
have bound : 0 <= mu i * nor (force E z) i by rewrite mulr_ge0 // fN.
split=> //; split.
- by exists (fun k => z (inl (inr (i, k)))).
- move=> k; rewrite power -subr_ge0 opprK [z _ * _]mulrC -mulrDr mulr_ge0 // addrC; exact: ge.
by rewrite power oppr_le0 mulr_ge0.
Qed.

(* b does no negative work on the solutions with b = 0; the directions need not be in the disc *)
Theorem polygon_itself_solution : (forall v, polygonal_itself v (A *m v) -> 0 <= dotp v b) ->
  exists f, polygonal_itself f (A *m f + b).
Proof.
move=> safe'.
have ra z : comp E S z (A *m force E z) -> 0 <= dotp (force E z) b.
  by move=> /itself_of; exact: safe'.
have [z hz] := lcp_factor psd skew ra.
by exists (force E z); exact: itself_of.
Qed.

Theorem polygon_solution : exists f, polygonal f (A *m f + b).
Proof.
have ra z : comp E S z (A *m force E z) -> 0 <= dotp (force E z) b.
  by move=> /polygonal_of; exact: safe.
have [z hz] := lcp_factor psd skew ra.
by exists (force E z); exact: polygonal_of.
Qed.
End Polygon.
