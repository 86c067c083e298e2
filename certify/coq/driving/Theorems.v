(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves the statements of Statement.v. The last step to them is here: the values at the end of the run on b(eps)
   solve the problem itself. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.existence Require Import Law Dot.
From Stiction.driving Require Import Path Lemke Rational Eval Lexico Piece Local Statement Drive Complete.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

(* standard parts *)
Lemma telescope (K : comRingType) (x y u v : K) : x * y - u * v = (x - u) * y + (y - v) * u.
Proof. by rewrite !mulrBl [y * u]mulrC [v * u]mulrC addrA subrK. Qed.
Section Standard.
Variable R : realFieldType.
Notation F := (ratfun R).
Notation emb := (@emb R).
Notation eps := (eps R).
Notation tiny := (@Statement.tiny R).
Notation st := (@Statement.st R).
Lemma tinyD x y : tiny x -> tiny y -> tiny (x + y).
Proof.
move=> hx hy c c0; have c2 : 0 < c / 2%:R by rewrite divr_gt0 ?ltr0n.
apply: le_lt_trans (ler_norm_add _ _) _.
have -> : emb c = emb (c / 2%:R) + emb (c / 2%:R) by rewrite -rmorphD -splitr.
by rewrite ltr_add ?hx ?hy.
Qed.
Lemma tinyM x y K : tiny x -> `|y| <= emb K -> tiny (x * y).
Proof.
move=> hx hy c c0; have K0 : 0 < `|K| + 1 by rewrite ltr_paddl ?ltr01.
rewrite normrM; apply: le_lt_trans (_ : `|x| * emb (`|K| + 1) < _).
  by rewrite ler_wpmul2l // (le_trans hy) // emb_le (le_trans (ler_norm K)) // ler_addl ler01.
rewrite -ltr_pdivl_mulr ?emb_gt0 // -fmorph_div; apply: hx; by rewrite divr_gt0.
Qed.
Lemma tinyN x : tiny x -> tiny (- x). Proof. by move=> hx c /hx; rewrite normrN. Qed.
Lemma tiny0 : tiny 0. Proof. by move=> c c0; rewrite normr0 -(rmorph0 (emb_rmorphism R)) emb_lt. Qed.
Lemma st_emb r : st (emb r) r. Proof. by rewrite /st subrr; exact: tiny0. Qed.
Lemma st_0 : st 0 0. Proof. by have := st_emb 0; rewrite rmorph0. Qed.
Lemma st_D x y r s : st x r -> st y s -> st (x + y) (r + s).
Proof. by move=> hx hy; rewrite /st rmorphD opprD addrACA; exact: tinyD. Qed.
Lemma st_N x r : st x r -> st (- x) (- r).
Proof. by move=> hx; rewrite /st rmorphN -opprD; exact: tinyN. Qed.
Lemma st_bound x r : st x r -> `|x| <= emb (`|r| + 1).
Proof.
move=> hx; rewrite rmorphD -[x](subrK (emb r)) addrC; apply: le_trans (ler_norm_add _ _) _.
apply: ler_add; last exact: ltW (hx 1 ltr01).
by rewrite /= ler_norml -rmorphN !emb_le ler_norm andbT ler_oppl -normrN ler_norm.
Qed.
Lemma st_M x y r s : st x r -> st y s -> st (x * y) (r * s).
Proof.
move=> hx hy; rewrite /st rmorphM /= telescope.
apply: tinyD; first exact: tinyM hx (st_bound hy).
by apply: (tinyM (K := `|r|) hy); rewrite ler_norml -rmorphN !emb_le ler_norm andbT ler_oppl -normrN ler_norm.
Qed.
Lemma st_ge0 x r : st x r -> 0 <= x -> 0 <= r.
Proof.
move=> hx x0; rewrite leNgt; apply/negP => rn; have := hx (- r); rewrite oppr_gt0 => /(_ rn).
apply/negP; rewrite -leNgt rmorphN; apply: le_trans (ler_norm _); by rewrite ler_addr.
Qed.
Lemma st_eq0 r : st 0 r -> r = 0.
Proof.
move=> h; apply/eqP; rewrite eq_le (st_ge0 h) // andbT -oppr_ge0; apply: (st_ge0 (st_N h)); by rewrite oppr0.
Qed.
Lemma st_norm x r : st x r -> st `|x| `|r|.
Proof.
case: (lerP 0 x) => x0 h; first by rewrite ?(ger0_norm x0) (ger0_norm (st_ge0 h x0)).
have r0 : 0 <= - r by apply: (st_ge0 (st_N h)); rewrite oppr_ge0 ltW.
rewrite oppr_ge0 in r0; by rewrite ?(ltr0_norm x0) (ler0_norm r0); exact: st_N.
Qed.
Lemma st_sum (I : finType) (x : I -> F) r : (forall i, st (x i) (r i)) -> st (\sum_i x i) (\sum_i r i).
Proof.
move=> h; elim/big_ind2: _ => [|x1 r1 x2 r2|i _]; [exact: st_0 | exact: st_D | exact: h].
Qed.
Lemma st_eps k : st (eps ^+ k.+1) 0.
Proof.
move=> c c0; rewrite rmorph0 subr0 normrX (gtr0_norm (eps_gt0 R)) exprS.
apply: le_lt_trans (eps_small c0); rewrite ger_pmulr ?eps_gt0 // exprn_ile1 ?(ltW (eps_gt0 R)) //.
by have := eps_small (@ltr01 R); rewrite rmorph1 => /ltW.
Qed.
Lemma law_st m fN fF aN aF gN gF dN dF : st fN gN -> st fF gF -> st aN dN -> st aF dF ->
  law (emb m) fN fF aN aF -> law m gN gF dN dF.
Proof.
move=> h1 h2 h3 h4 [[l1 l2 l3] [l4 l5 l6]].
have hm : st (emb m * fN - `|fF|) (m * gN - `|gF|)
  by apply: st_D; [exact: st_M (st_emb m) h1 | exact: st_N (st_norm h2)].
split; split.
- exact: st_ge0 h1 l1.
- exact: st_ge0 h3 l2.
- by apply: st_eq0; rewrite -l3; exact: st_M.
- by rewrite -subr_ge0; apply: (st_ge0 hm); rewrite subr_ge0.
- by rewrite -oppr_ge0; apply: (st_ge0 (st_N (st_M h4 h2))); rewrite oppr_ge0.
- by apply: st_eq0; rewrite -l6; exact: st_M.
Qed.
End Standard.

Section Every.
Variables (R : realFieldType) (n : nat) (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R).
Hypothesis sym : A^T = A.
Hypothesis psd : forall x, 0 <= dotp x (A *m x).
Hypothesis mu0 : forall i, 0 <= mu i.
(* b in range(A) + K*, K the friction cones *)
Hypothesis dual : H_holds A b mu.
Notation F := (ratfun R).
Notation emb := (@emb R).
Notation AF := (MF A).
Notation bF := (beps b).
Notation muF := (muF mu).
Lemma near_mul k l (B : 'M[R]_(k, l)) f g : near f g -> near (map_mx emb B *m f) (B *m g).
Proof.
move=> h r; rewrite !mxE; apply: st_sum => i; rewrite mxE; apply: st_M => //; exact: st_emb.
Qed.
Lemma nearD k (f f' : 'cV[F]_k) g g' : near f g -> near f' g' -> near (f + f') (g + g').
Proof. by move=> h h' r; rewrite !mxE; exact: st_D. Qed.
Lemma st_near3 (B : R) (x y : F) : st x 0 -> st y 0 -> st (emb B + (x + y)) B.
Proof. by move=> hx hy; have := st_D (st_emb B) (st_D hx hy); rewrite !addr0. Qed.
Lemma st_epsM (x : F) (r : R) : st x r -> st (eps R * x) 0.
Proof. by move=> hx; have := st_M (@st_eps R 0) hx; rewrite expr1 mul0r. Qed.
Lemma st_1 : st (1 : F) 1. Proof. by have := st_emb (1 : R); rewrite rmorph1. Qed.
Lemma near_eN r : exists s, st (eN R n r 0) s.
Proof.
rewrite /eN mxE; case: (split r) => j; rewrite mxE; [by exists 1; exact: st_1 | by exists 0; exact: st_0].
Qed.
Lemma near_beps (bb : 'cV[R]_(n + n)) r :
  st ((qF bb + (eps R *: eN R n + \col_r eps R ^+ (place r).+2)) r 0) (bb r 0).
Proof.
rewrite mxE [X in st (_ + X)]mxE [X in st (X + _)]mxE [X in st (_ + (X + _))]mxE [X in st (_ + (_ + X))]mxE.
by have [s hs] := near_eN r; apply: st_near3; [exact: st_epsM hs | exact: st_eps].
Qed.
Lemma near_b : near bF b.
Proof. by move=> r; exact: near_beps. Qed.
Lemma solution_near f g : near f g -> solution AF bF muF f -> solution A b mu g.
Proof.
move=> h s j; have ha : near (acc AF bF f) (acc A b g) by apply: nearD near_b; exact: near_mul.
apply: (law_st (m := mu j) (h _) (h _) (ha _) (ha _)); exact: s.
Qed.
(* the end of a piece: the same formula, with b for b(eps) *)
Lemma rowf_map ch j : rowf AF muF ch j = map_mx emb (rowf A mu ch j).
Proof.
have hd k : map_mx emb (delta_mx (0 : 'I_1) k : 'rV_(n + n)) = delta_mx 0 k by rewrite map_delta_mx.
by case: ch => /=; rewrite ?map_mx0 ?map_mxD ?map_mxN ?map_mxZ ?hd ?map_row.
Qed.
Lemma E_map p : E AF muF p = map_mx emb (E A mu p).
Proof.
rewrite /E map_col_mx; congr col_mx; apply/matrixP => r s; rewrite !mxE rowf_map mxE; done.
Qed.
Lemma const_near ch j : st (constf bF ch j) (constf b ch j).
Proof.
case: ch; rewrite /constf; [exact: st_0 | exact: st_0 | exact: st_0 | exact: st_0 | exact: near_b |
  apply: st_N; exact: near_b | exact: near_b | apply: st_N; exact: near_b | exact: st_0 | exact: st_0].
Qed.
Lemma cand_near p x r0 :
  near (cand (E AF muF p) (e bF p) (G AF muF p) (h bF p) r0 x) (cand (E A mu p) (e b p) (G A mu p) (h b p) r0 x).
Proof.
rewrite /cand; have -> : Bk (E AF muF p) (G AF muF p) r0 x = map_mx emb (Bk (E A mu p) (G A mu p) r0 x).
  rewrite /Bk map_mxD map_mxM E_map map_delta_mx; congr (_ + _ *m _).
  by rewrite /G; case: ineq => [ch|]; rewrite ?rowf_map ?map_mx0.
rewrite -map_invmx; apply: near_mul; apply: nearD.
  move=> r; rewrite /e !mxE; case: split => j; rewrite !mxE; apply: st_N; exact: const_near.
move=> r; rewrite !mxE; apply: st_N; apply: st_M;
  last by case: (_ && _); [rewrite -(rmorph1 (emb_rmorphism R)); exact: st_emb | exact: st_0].
by rewrite /h; case: ineq => [ch|]; [exact: const_near | rewrite -(rmorph1 (emb_rmorphism R)); exact: st_emb].
Qed.

(* ---- every planar problem: static friction, A symmetric positive semidefinite, b in range(A) + K* ---- *)
Lemma ends_in_a_solution :
  exists f g, [/\ complete_driving A b mu = Some f, solution AF bF muF f, near f g & solution A b mu g].
Proof.
have := complete_driving_eps sym psd mu0 dual; rewrite /drives_to_a_solution /complete_driving.
case: first => [x0 [y [-> ey s]]|s] /=.
  have [i pi] := is_end_piece ey.
  exists (point AF bF muF y), (cand (E A mu y.1) (e b y.1) (G A mu y.1) (h b y.1) (rshift n i) y.2).
  have nr : near (point AF bF muF y) (cand (E A mu y.1) (e b y.1) (G A mu y.1) (h b y.1) (rshift n i) y.2).
    by rewrite /point (drvE pi); exact: cand_near.
  by split=> //; exact: solution_near nr s.
exists 0, 0; have nr : near 0 (0 : 'cV[R]_(n + n)) by move=> r; rewrite !mxE; exact: st_0.
by split=> //; exact: solution_near nr s.
Qed.
End Every.

Theorem complete_driving_ends_in_a_solution : complete_driving_solves.
Proof. by move=> R n A b mu; exact: ends_in_a_solution. Qed.

Theorem plane_solution_exists_H : plane_has_a_solution_under_H.
Proof.
by move=> R n A b mu sym psd mu0 dual; have [f [g [_ _ _ s]]] := ends_in_a_solution sym psd mu0 dual; exists g.
Qed.

Theorem no_piece_twice : no_piece_comes_twice.
Proof.
move=> R n A b mu x0 sym psd mu0 dual f0.
have cone v : in_cones (muF mu) v -> v != 0 -> dotp v (MF A *m v) <= 0 -> (MF A)^T *m v = 0 /\ 0 < dotp v (beps b).
  move=> vK vn le.
  have Av : MF A *m v = 0 by apply: (psd_kernel (symF sym) (psdF psd)); apply/eqP; rewrite eq_le le psdF.
  by rewrite (symF sym); split=> //; exact: (cone_eps mu0 dual vK vn Av).
exact: (Drive.no_piece_twice (muF0 mu0) (@generic_eps _ _ A b mu) cone f0).
Qed.

Theorem complete_driving_definite : complete_driving_solves_definite.
Proof. by move=> R n A b mu; exact: Complete.complete_driving_definite. Qed.

Theorem complete_driving_semidefinite : complete_driving_solves_semidefinite.
Proof. by move=> R n A b mu; exact: Complete.complete_driving_semidefinite. Qed.

Theorem no_piece_twice_without_ties : no_piece_comes_twice_without_ties.
Proof.
move=> R n A b mu x0 mu0 nd hyp f0.
have cone v : in_cones mu v -> v != 0 -> dotp v (A *m v) <= 0 -> A^T *m v = 0 /\ 0 < dotp v b.
  move=> vK vn le; case: hyp => [pd|[sym psd pos]]; first by move: le; rewrite leNgt pd.
  have Av : A *m v = 0 by apply: (psd_kernel sym psd); apply/eqP; rewrite eq_le le psd.
  by rewrite sym; split=> //; exact: pos.
exact: (Drive.no_piece_twice mu0 nd cone f0).
Qed.

Theorem range_plus_dual_has_H : range_has_H.
Proof.
move=> R n A c k mu sym dual v vK Av.
by rewrite dotpD -{1}sym dotp_adj Av dotpC dotp0 add0r dual.
Qed.
