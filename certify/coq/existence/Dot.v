(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves what the other files need of products x.y, and that v.Av = 0 only where A v = 0, for A symmetric positive
   semidefinite. *)
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Stiction.existence Require Import Law.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Definition nonneg (R : realFieldType) m (u : 'cV[R]_m) := forall k, 0 <= u k 0.

Section Dot.
Variable R : realFieldType.
Lemma dotpD n (x y z : 'cV[R]_n) : dotp x (y + z) = dotp x y + dotp x z.
Proof. by rewrite -big_split /=; apply: eq_bigr => i _; rewrite mxE mulrDr. Qed.
Lemma dotpZ n (x : 'cV[R]_n) c y : dotp x (c *: y) = c * dotp x y.
Proof. by rewrite mulr_sumr; apply: eq_bigr => i _; rewrite mxE mulrCA. Qed.
Lemma dotp_ge0 n (x y : 'cV[R]_n) : nonneg x -> nonneg y -> 0 <= dotp x y.
Proof. by move=> hx hy; apply: sumr_ge0 => i _; rewrite mulr_ge0. Qed.
Lemma dotpC n (x y : 'cV[R]_n) : dotp x y = dotp y x.
Proof. by apply: eq_bigr => i _; rewrite mulrC. Qed.
Lemma dotp_adj m n (E : 'M[R]_(m, n)) (x : 'cV[R]_n) (y : 'cV[R]_m) : dotp x (E^T *m y) = dotp (E *m x) y.
Proof.
rewrite /dotp; transitivity (\sum_i \sum_j x i 0 * (E j i * y j 0)).
  by apply: eq_bigr => i _; rewrite mxE mulr_sumr; apply: eq_bigr => j _; rewrite mxE.
rewrite exchange_big; apply: eq_bigr => j _; rewrite mxE mulr_suml; apply: eq_bigr => i _.
by rewrite mulrA [x i 0 * _]mulrC.
Qed.
Lemma dotp_col m n (a c : 'cV[R]_m) (b d : 'cV[R]_n) : dotp (col_mx a b) (col_mx c d) = dotp a c + dotp b d.
Proof.
rewrite /dotp big_split_ord /=; congr (_ + _); apply: eq_bigr => i _; rewrite ?col_mxEu ?col_mxEd //.
Qed.
Lemma dotp0 n (x : 'cV[R]_n) : dotp x 0 = 0.
Proof. by apply: big1 => i _; rewrite mxE mulr0. Qed.
Lemma dotpN n (x y : 'cV[R]_n) : dotp x (- y) = - dotp x y.
Proof. by rewrite -[- y]scaleN1r dotpZ mulN1r. Qed.
Lemma dotpDl n (x y z : 'cV[R]_n) : dotp (x + y) z = dotp x z + dotp y z.
Proof. by rewrite dotpC dotpD !(dotpC z). Qed.
Lemma sum0 (x y : R) : 0 <= x -> 0 <= y -> x + y = 0 -> x = 0 /\ y = 0.
Proof. by move=> hx hy /eqP; rewrite paddr_eq0 // => /andP [/eqP -> /eqP ->]. Qed.
End Dot.

Section Kernel.
Variables (R : realFieldType) (N : nat) (A : 'M[R]_N).
Hypothesis sym : A^T = A.
Hypothesis psd : forall f, 0 <= dotp f (A *m f).
Lemma sym_dotp f g : dotp f (A *m g) = dotp (A *m f) g.
Proof. by rewrite -{1}sym dotp_adj. Qed.
Lemma psd_kernel f : dotp f (A *m f) = 0 -> A *m f = 0.
Proof.
move=> f0; set g := A *m f; set s := dotp g g; set r := dotp g (A *m g).
have r0 : 0 <= r := psd g.
have fg : dotp f (A *m g) = s by rewrite -{1}sym dotp_adj.
have q t : 0 <= t * s + t * s + t * t * r.
  have := psd (f + t *: g); rewrite mulmxDr -scalemxAr dotpDl !dotpD !dotpZ.
  rewrite (dotpC (t *: g)) dotpZ f0 add0r fg (dotpC (t *: g)) !dotpZ (dotpC _ g) -/s (dotpC _ g) -/r.
  by rewrite -addrA mulrA.
have s0 : s = 0.
  apply/eqP; apply: contraT => sn; have k : 0 < r + 1 := ltr_paddl r0 ltr01.
  pose x := s / (r + 1); have u : s = x * (r + 1) by rewrite /x divfK // gt_eqF.
  have := q (- x); rewrite u.
  have -> : - x * (x * (r + 1)) + - x * (x * (r + 1)) + - x * - x * r = - (x ^+ 2 * (r + 2%:R)) by ring.
  rewrite oppr_ge0 leNgt mulr_gt0 ?(ltr_paddl r0) ?ltr0n //.
  by rewrite exprn_even_gt0 //= /x mulf_neq0 // invr_eq0 gt_eqF.
have h i : true -> 0 <= g i 0 * g i 0 by rewrite -expr2 sqr_ge0.
apply/matrixP => i j; rewrite ord1 [RHS]mxE; apply/eqP.
have /eqP : g i 0 * g i 0 = 0 by apply: (psumr_eq0P h s0).
by rewrite mulf_eq0 orbb.
Qed.
End Kernel.
