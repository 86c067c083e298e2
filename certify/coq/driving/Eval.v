(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that what holds of vectors and matrices over R holds over R(X): signs of rational functions are those of
   their values at large numbers. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.existence Require Import Law Dot Edge Parity.
From Stiction.driving Require Import Rational.
From Stiction.driving Require Import Statement.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Large.
Variable R : realFieldType.
Notation F := (ratfun R).
Notation pf := (@pf R).
Definition large (C : R -> Prop) := exists b, forall t, b < t -> C t.
Lemma large_and C D : large C -> large D -> large (fun t => C t /\ D t).
Proof.
by move=> [b hb] [c hc]; exists (Num.max b c) => t; rewrite lt_maxl => /andP [h1 h2]; split; [apply: hb|apply: hc].
Qed.
Lemma large_imp (C D : R -> Prop) : (forall t, C t -> D t) -> large C -> large D.
Proof. by move=> h [b hb]; exists b => t /hb /h. Qed.
Lemma large_true (C : R -> Prop) : (forall t, C t) -> large C.
Proof. by move=> h; exists 0 => t _. Qed.
Lemma large_all (T : finType) (C : T -> R -> Prop) : (forall x, large (C x)) -> large (fun t => forall x, C x t).
Proof.
move=> h; suff [b hb] : large (fun t => forall x, x \in enum T -> C x t).
  by exists b => t /hb ht x; apply: ht; rewrite mem_enum.
elim: (enum T) => [|x s IH]; first exact: large_true.
apply: large_imp (large_and (h x) IH) => t [p r] y; by rewrite inE => /orP [/eqP ->|/r].
Qed.
Lemma large_ex C : large C -> exists t, C t.
Proof. by move=> [b h]; exists (b + 1); apply: h; rewrite ltr_addl ltr01. Qed.
Lemma lead_large (P : {poly R}) : 0 < lead_coef P -> exists2 c, 0 < c & large (fun t => c <= P.[t]).
Proof.
elim/poly_ind: P => [|P a IH]; first by rewrite lead_coef0 ltxx.
case: (altP (P =P 0)) => [->|P0].
  rewrite mul0r add0r lead_coefC => a0; exists a => //; apply: large_true => t; by rewrite hornerC.
have -> : lead_coef (P * 'X + a%:P) = lead_coef P.
  rewrite lead_coefDl ?lead_coefMX // size_mulX // size_polyC ltnS.
  by apply: leq_trans (leq_b1 _) _; rewrite lt0n size_poly_eq0.
case/IH => c c0 [b hb]; exists c => //; exists (Num.max b (Num.max 0 ((c - a) / c))) => t.
rewrite !lt_maxl => /and3P [h1 h2 h3]; rewrite hornerMXaddC -ler_subl_addr.
apply: le_trans (_ : c * t <= _); last by rewrite ler_pmul2r // hb.
by rewrite mulrC -ler_pdivr_mulr // ltW.
Qed.
Lemma lead_gt0 (P : {poly R}) : 0 < lead_coef P -> large (fun t => 0 < P.[t]).
Proof. case/lead_large => c c0; apply: large_imp => t; exact: lt_le_trans c0. Qed.
Lemma neq0_large (P : {poly R}) : P != 0 -> large (fun t => P.[t] != 0).
Proof.
move=> nz; case: (ltrgtP (lead_coef P) 0) => h; last by move/eqP: h; rewrite lead_coef_eq0 (negbTE nz).
  have : 0 < lead_coef (- P) by rewrite lead_coefN oppr_gt0.
  by move/lead_gt0; apply: large_imp => t; rewrite hornerN oppr_gt0 => /lt_eqF ->.
by move/lead_gt0: h; apply: large_imp => t /gt_eqF ->.
Qed.

(* the value at t of a rational function *)
Definition val (x : F) t := (num x).[t] / (den x).[t].
Lemma val_frac x p q : q != 0 -> x = pf p / pf q -> large (fun t => val x t = p.[t] / q.[t]).
Proof.
move=> q0 e; have := cross q0 e => h.
apply: large_imp (large_and (neq0_large q0) (neq0_large (den_neq0 x))) => t [qt dt].
by apply/eqP; rewrite /val eqr_div // -!hornerM h.
Qed.
Lemma valD x y : large (fun t => val (x + y) t = val x t + val y t).
Proof.
have h : x + y = pf (num x * den y + num y * den x) / pf (den x * den y).
  by rewrite [in LHS](fracE x) [in LHS](fracE y) addf_div ?pf_eq0 ?den_neq0 // -!rmorphM -rmorphD.
have d0 : den x * den y != 0 by rewrite mulf_neq0 ?den_neq0.
apply: large_imp (large_and (val_frac d0 h) (large_and (neq0_large (den_neq0 x)) (neq0_large (den_neq0 y)))).
by move=> t [-> [xt yt]]; rewrite /val addf_div // hornerD !hornerM.
Qed.
Lemma valM x y : large (fun t => val (x * y) t = val x t * val y t).
Proof.
have h : x * y = pf (num x * num y) / pf (den x * den y).
  by rewrite [in LHS](fracE x) [in LHS](fracE y) mulf_div -!rmorphM.
have d0 : den x * den y != 0 by rewrite mulf_neq0 ?den_neq0.
by apply: large_imp (val_frac d0 h) => t ->; rewrite /val mulf_div !hornerM.
Qed.
Notation emb := (@Rational.emb R).
Lemma emb_is_rmorphism : rmorphism emb.
Proof.
split; first by move=> x y; rewrite /Rational.emb !rmorphB.
by split=> [x y|]; rewrite /Rational.emb ?rmorphM ?rmorph1.
Qed.
Canonical emb_additive := Additive emb_is_rmorphism.
Canonical emb_rmorphism := RMorphism emb_is_rmorphism.
Lemma val_emb c : large (fun t => val (emb c) t = c).
Proof.
have h : emb c = pf c%:P / pf 1%:P by rewrite /Rational.emb !rmorph1 divr1.
have q0 : 1%:P != 0 :> {poly R} by rewrite polyC_eq0 oner_eq0.
by apply: large_imp (val_frac q0 h) => t ->; rewrite !hornerC divr1.
Qed.
Lemma val_gt0 x : 0 < x -> large (fun t => 0 < val x t).
Proof.
rewrite ratfun_gt0 => /posf [p [q [p0 q0 e]]].
apply: large_imp (large_and (val_frac (neq0_lead q0) e) (large_and (lead_gt0 p0) (lead_gt0 q0))) => t [-> [pt qt]].
by rewrite divr_gt0.
Qed.
Lemma val_opp x : large (fun t => val (- x) t = - val x t).
Proof.
have h : - x = pf (- num x) / pf (den x) by rewrite rmorphN mulNr -fracE.
by apply: large_imp (val_frac (den_neq0 x) h) => t ->; rewrite hornerN mulNr.
Qed.
Lemma val_ge0 x : 0 <= x -> large (fun t => 0 <= val x t).
Proof.
rewrite le_eqVlt => /orP [/eqP <-|/val_gt0]; last by apply: large_imp => t /ltW.
by rewrite (_ : 0 = emb 0) ?rmorph0 //; apply: large_imp (val_emb 0) => t ->.
Qed.
Lemma ge0_val x : large (fun t => 0 <= val x t) -> 0 <= x.
Proof.
move=> h; rewrite leNgt; apply/negP => n; have : 0 < - x by rewrite oppr_gt0.
move/val_gt0 => h2; have [t [a [b]]] := large_ex (large_and h (large_and h2 (val_opp x))).
by move=> e; rewrite e oppr_gt0 ltNge a in b.
Qed.
Lemma val_sum (I : finType) (f : I -> F) : large (fun t => val (\sum_i f i) t = \sum_i val (f i) t).
Proof.
suff h (s : seq I) : large (fun t => val (\sum_(i <- s) f i) t = \sum_(i <- s) val (f i) t) by exact: h.
elim: s => [|i s IH].
  by rewrite big_nil (_ : 0 = emb 0) ?rmorph0 //; apply: large_imp (val_emb 0) => t ->; rewrite big_nil.
rewrite big_cons; apply: large_imp (large_and (valD (f i) (\sum_(j <- s) f j)) IH) => t [-> ->]; by rewrite big_cons.
Qed.
Lemma emb_gt0 c : (0 < emb c) = (0 < c).
Proof.
rewrite ratfun_gt0 (@sgfE R _ c%:P 1%:P) ?oner_eq0 ?lead_coefC ?mulr1 //.
by rewrite /Rational.emb !rmorph1 divr1.
Qed.
Lemma emb_lt c e : (emb c < emb e) = (c < e).
Proof. by rewrite -subr_gt0 -rmorphB emb_gt0 subr_gt0. Qed.
Lemma emb_le c e : (emb c <= emb e) = (c <= e).
Proof. by rewrite leNgt emb_lt -leNgt. Qed.
Lemma emb_inj : injective emb.
Proof. by move=> x y e; apply/eqP; rewrite eq_le -!emb_le e lexx. Qed.
(* X is larger than every element of R *)
Notation X := (@Rational.X R).
Lemma X_large c : emb c < X.
Proof.
rewrite -subr_gt0 /Rational.X /Rational.emb -rmorphB ratfun_gt0 (@sgfE R _ ('X - c%:P) 1%:P) ?oner_eq0 //.
  by rewrite lead_coefXsubC lead_coefC mulr1 ltr01.
by rewrite rmorph1 divr1.
Qed.
Lemma X_gt0 : 0 < X. Proof. by have := X_large 0; rewrite rmorph0. Qed.

(* ---- vectors and matrices ---- *)
Section Vectors.
Variable n : nat.
Definition valv (z : 'cV[F]_n) t : 'cV[R]_n := \col_i val (z i 0) t.
Variable M : 'M[R]_n.
Notation MF := (Statement.MF M).
Lemma val_mul z : large (fun t => valv (MF *m z) t = M *m valv z t).
Proof.
have h i : large (fun t => val ((MF *m z) i 0) t = (M *m valv z t) i 0).
  rewrite mxE; apply: large_imp (large_and (val_sum (fun j => MF i j * z j 0))
    (large_and (large_all (fun j => valM (MF i j) (z j 0))) (large_all (fun j => val_emb (M i j))))).
  move=> t [-> [h1 h2]]; rewrite mxE; apply: eq_bigr => j _; by rewrite h1 mxE h2 mxE.
apply: large_imp (large_all h) => t ht; by apply/matrixP => i j; rewrite ord1 mxE ht.
Qed.
Lemma val_dotp x y : large (fun t => val (dotp x y) t = dotp (valv x t) (valv y t)).
Proof.
apply: large_imp (large_and (val_sum (fun j => x j 0 * y j 0)) (large_all (fun j => valM (x j 0) (y j 0))))
  => t [-> h].
by apply: eq_bigr => i _; rewrite h !mxE.
Qed.
Lemma val_nonneg z : nonneg z -> large (fun t => nonneg (valv z t)).
Proof. by move=> h; apply: large_imp (large_all (fun i => val_ge0 (h i))) => t ht i; rewrite mxE. Qed.
Lemma val_dotM x y : large (fun t => val (dotp x (MF *m y)) t = dotp (valv x t) (M *m valv y t)).
Proof. by apply: large_imp (large_and (val_dotp x (MF *m y)) (val_mul y)) => t [-> ->]. Qed.
Lemma copositiveF : (forall z, nonneg z -> 0 <= dotp z (M *m z)) ->
  forall z : 'cV[F]_n, nonneg z -> 0 <= dotp z (MF *m z).
Proof.
move=> h z z0; apply: ge0_val; apply: large_imp (large_and (val_dotM z z) (val_nonneg z0)) => t [-> zt]; exact: h.
Qed.
Variable q : 'cV[R]_n.
Notation qF := (Statement.qF q).
Lemma val_q : large (fun t => valv qF t = q).
Proof.
apply: large_imp (large_all (fun i => val_emb (q i 0))) => t h; by apply/matrixP => i j; rewrite ord1 !mxE h.
Qed.
Lemma raysF : (forall z z', nonneg z -> nonneg z' -> nonneg (M *m z) -> dotp z (M *m z) = 0 ->
    0 <= dotp z q /\ 0 <= dotp z (M *m z') + dotp z' (M *m z)) ->
  forall z z' : 'cV[F]_n, nonneg z -> nonneg z' -> nonneg (MF *m z) -> dotp z (MF *m z) = 0 ->
    0 <= dotp z qF /\ 0 <= dotp z (MF *m z') + dotp z' (MF *m z).
Proof.
move=> h z z' z0 z0' Mz e.
have e0 : large (fun t => dotp (valv z t) (M *m valv z t) = 0).
  apply: large_imp (large_and (val_dotM z z) (val_emb 0)) => t [<-]; by rewrite e rmorph0.
have H : large (fun t => 0 <= dotp (valv z t) q /\
  0 <= dotp (valv z t) (M *m valv z' t) + dotp (valv z' t) (M *m valv z t)).
  apply: large_imp (large_and e0 (large_and (val_nonneg z0) (large_and (val_nonneg z0')
    (large_and (val_nonneg Mz) (val_mul z))))).
  by move=> t [a [b [c [d f]]]]; apply: h => //; rewrite -f.
split; apply: ge0_val.
  by apply: large_imp (large_and H (large_and (val_dotp z qF) val_q)) => t [[a _] [-> ->]].
apply: large_imp (large_and H (large_and (valD (dotp z (MF *m z')) (dotp z' (MF *m z)))
  (large_and (val_dotM z z') (val_dotM z' z)))).
by move=> t [[_ a] [-> [-> ->]]].
Qed.
End Vectors.
End Large.
