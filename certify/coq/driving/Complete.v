(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that complete driving ends at a solution for b without ties, over any ordered field; and that b(eps) has no
   ties and b(eps).v > 0, so that it ends on b(eps) for every b with (H). *)
From mathcomp Require Import all_ssreflect all_algebra.
From Stiction.existence Require Import Law Dot.
From Stiction.driving Require Import Path Lemke Rational Eval Lexico Piece Local Statement Drive.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

(* ---- part 3 of complete_driving.md: nondegenerate b ---- *)
Section Nondegenerate.
Variables (R : realFieldType) (n : nat) (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R).
Hypothesis mu0 : forall i, 0 <= mu i.
Notation nondegenerate := (Statement.nondegenerate A b mu).
Notation drives_to_a_solution := (Statement.drives_to_a_solution A b mu).
Hypothesis nd : nondegenerate.
Lemma solution0 : first A b = None -> solution A b mu 0.
Proof.
rewrite /Statement.first; case: pickP => // none _ j.
have z : xN (0 : 'cV[R]_(n + n)) j = 0 /\ xF (0 : 'cV[R]_(n + n)) j = 0 by rewrite /xN /xF !mxE.
apply: later_law; [exact: (proj1 z) | exact: (proj2 z) |]; rewrite leNgt; apply/negP => neg.
case: (@arg_minnP _ j (fun t : 'I_n => aN A b 0 t < 0) (fun t : 'I_n => nat_of_ord t) neg) => t t2 tmin.
have := none t; rewrite t2 /= => /forallP; case=> r; apply/implyP => r1.
by rewrite leNgt; apply/negP => rn; have := tmin r rn; rewrite leqNgt r1.
Qed.
Theorem complete_driving_definite : (forall x, x != 0 -> 0 < dotp x (A *m x)) -> drives_to_a_solution.
Proof.
move=> pd; rewrite /Statement.drives_to_a_solution; case e1: first => [x0|]; last exact: solution0.
by apply: drive_ends e1 => // v _ vn; rewrite leNgt pd.
Qed.
Theorem complete_driving_semidefinite : A^T = A -> (forall x, 0 <= dotp x (A *m x)) ->
  (forall v, in_cones mu v -> v != 0 -> A *m v = 0 -> 0 < dotp v b) -> drives_to_a_solution.
Proof.
move=> sym psd pos; rewrite /Statement.drives_to_a_solution; case e1: first => [x0|]; last exact: solution0.
apply: drive_ends e1 => // v vK vn le.
have Av : A *m v = 0 by apply: (psd_kernel sym psd); apply/eqP; rewrite eq_le le psd.
by rewrite sym; split=> //; exact: pos.
Qed.
End Nondegenerate.

(* ---- part 5: b(eps) = b + eps e_N + (eps^2, eps^3, ...), eps = 1/X infinitesimal ---- *)
Section Rank.
Variables (R : fieldType) (m : nat).
Lemma rank_cols (T : 'M[R]_m) (I : pred 'I_m) : (forall r c, ~~ I c -> T r c = 0) -> (\rank T <= #|I|)%N.
Proof.
move=> h; have -> : T = \sum_(c | I c) T *m delta_mx c c.
  apply/matrixP => r c; rewrite summxE; case: (boolP (I c)) => ic; last first.
    rewrite h // big1 // => a ia; rewrite mxE big1 // => s _; rewrite mxE.
    by case: (altP (c =P a)) => [e1|_]; [rewrite -e1 (negbTE ic) in ia | rewrite andbF mulr0].
  rewrite (bigD1 c) //= mxE (bigD1 c) //= mxE !eqxx mulr1 big1 => [|s sc]; last by rewrite mxE (negbTE sc) mulr0.
  rewrite addr0 big1 ?addr0 // => a /andP [_ ac]; rewrite mxE big1 // => s _; rewrite mxE.
  by rewrite [c == a]eq_sym (negbTE ac) andbF mulr0.
rewrite -sum1_card; elim/big_ind2: _ => [|x a y c hx hy|c ic]; first by rewrite mxrank0.
  by apply: leq_trans (mxrank_add _ _) _; exact: leq_add.
by apply: leq_trans (mxrankM_maxr _ _) _; rewrite mxrank_delta.
Qed.
End Rank.

Lemma place_lt n (r : 'I_(n + n)) : (place r < n + n)%N.
Proof.
by rewrite /place addnn; case: (split r) => j; rewrite ?ltn_double ?ltn_Sdouble.
Qed.
Lemma place_inj n : injective (@place n).
Proof.
move=> r s; rewrite -(splitK r) -(splitK s) /place !unsplitK.
case: (split r) => i; case: (split s) => j /=.
- by move=> /double_inj/val_inj ->.
- by move=> /(congr1 odd); rewrite /= !odd_double.
- by move=> /(congr1 odd); rewrite /= !odd_double.
- by case=> /double_inj/val_inj ->.
Qed.

Section Perturbed.
Variables (R : realFieldType) (n : nat) (A : 'M[R]_(n + n)) (b : 'cV[R]_(n + n)) (mu : 'I_n -> R).
Hypothesis sym : A^T = A.
Hypothesis psd : forall x, 0 <= dotp x (A *m x).
Hypothesis mu0 : forall i, 0 <= mu i.
(* b in range(A) + K*, K the friction cones *)
Hypothesis dual : forall v, in_cones mu v -> A *m v = 0 -> 0 <= dotp v b.
Notation F := (ratfun R).
Notation emb := (@emb R).
Notation eps := (eps R).
Notation AF := (MF A).
Notation muF := (Statement.muF mu).
Notation eN := (Statement.eN R n).
Notation beps := (Statement.beps b).
Lemma muF0 i : 0 <= muF i. Proof. by rewrite -(rmorph0 (emb_rmorphism R)) emb_le. Qed.
Lemma transcendental2 (p : 'rV[R]_(n + n)) : (map_mx emb p *m beps) 0 0 = 0 -> p = 0.
Proof.
rewrite /Statement.beps !mulmxDr -scalemxAr !mxE => e1; apply/matrixP => i j; rewrite ord1 mxE.
pose N := (n + n)%N; pose s := \sum_(k < n) p 0 (lshift n k).
pose P : {poly R} := (p *m b) 0 0 *: 'X^N.+1 + (s *: 'X^N + \sum_r p 0 r *: 'X^(N.+1 - (place r).+2)).
have P0 : P = 0.
  apply: pf_inj; rewrite rmorph0 -[RHS](mulr0 (X R ^+ N.+1)) -e1.
  rewrite !rmorphD rmorph_sum /= !mulrDr; congr (_ + (_ + _)).
  - rewrite -mul_polyC rmorphM rmorphX /= mulrC; congr (_ * _).
    rewrite -/(emb _) mxE rmorph_sum; apply: eq_bigr => k _; by rewrite [map_mx _ _ _ _]mxE [qF _ _ _]mxE rmorphM.
  - have Xe : X R ^+ N.+1 * eps = X R ^+ N by rewrite exprSr -mulrA divff ?mulr1 // gt_eqF // X_gt0.
    rewrite -mul_polyC rmorphM rmorphX /= -/(X R) -/(emb _) mulrA Xe mulrC; congr (_ * _).
    rewrite big_split_ord /= [X in _ = _ + X]big1 => [|k _];
      last by rewrite /Statement.eN col_mxEd [X in _ * X]mxE mulr0.
    by rewrite addr0 rmorph_sum; apply: eq_bigr => k _; rewrite col_mxEu !mxE mulr1.
  - rewrite mulr_sumr; apply: eq_bigr => k _; rewrite !mxE -mul_polyC rmorphM rmorphX /= -/(X R) -/(emb _) mulrCA;
      congr (_ * _).
    by rewrite /Statement.eps exprVn -expfB_cond //; rewrite gt_eqF ?X_gt0 //= add0n ltnS place_lt.
have jN : (place j < N)%N := place_lt j.
have := congr1 (fun Q : {poly R} => Q`_(N.+1 - (place j).+2)) P0; rewrite coef0 !coefD !coefZ !coefXn.
have lt : (N.+1 - (place j).+2 < N)%N by rewrite subSS ltn_subrL /= (leq_ltn_trans _ jN).
have -> : (N.+1 - (place j).+2 == N.+1)%N = false by rewrite ltn_eqF // ltnW.
rewrite (ltn_eqF lt) !mulr0 !add0r coef_sum (bigD1 j) //= coefZ coefXn eqxx mulr1 big1 ?addr0 // => k kj.
rewrite coefZ coefXn; have -> : (N.+1 - (place j).+2 == N.+1 - (place k).+2)%N = false; last by rewrite mulr0.
apply/negbTE; apply: contra kj => /eqP e2; apply/eqP/(@place_inj n).
have : (N - (N - (place j).+1) = N - (N - (place k).+1))%N by move: e2; rewrite !subSS => ->.
by rewrite !subKn ?place_lt // => -[].
Qed.
Lemma generic_eps : nondegenerate AF beps muF.
Proof.
move=> f; rewrite leqNgt; apply/negP => big.
pose uN j := xN f j != 0.
pose uF j := (xF f j != 0) && ((xN f j == 0) || (muF j * xN f j != xF f j) && (muF j * xN f j != - xF f j)).
pose sl j : R := if uF j || (xF f j == 0) then 0 else if muF j * xN f j == xF f j then mu j else - mu j.
pose T : 'M[R]_(n + n) :=
  block_mx (diag_mx (\row_j (uN j)%:R)) 0 (diag_mx (\row_j sl j)) (diag_mx (\row_j (uF j)%:R)).
pose I (r : 'I_(n + n)) := match split r with inl j => uN j | inr j => uF j end.
pose J (r : 'I_(n + n)) := acc AF beps f r 0 == 0.
pose D : 'M[R]_(n + n) := \matrix_(r, s) ((r == s) && J r)%:R.
have slN j : ~~ uN j -> sl j = 0.
  by rewrite negbK /sl /uF => ->; rewrite /= andbT; case: (xF f j == 0).
have rT : (\rank T <= #|I|)%N.
  apply: rank_cols => r s; rewrite /I; case: (splitP s) => j es nu.
    have -> : s = lshift n j by exact/val_inj.
    rewrite -(splitK r); case: (split r) => t /=; rewrite ?block_mxEul ?block_mxEdl !mxE.
      by case: (altP (t =P j)) => [->|_]; rewrite ?(negbTE nu) ?mulr0n ?mul0rn.
    by case: (altP (t =P j)) => [->|_]; rewrite ?(slN _ nu) ?mulr0n ?mul0rn.
  have -> : s = rshift n j by exact/val_inj.
  rewrite -(splitK r); case: (split r) => t /=; rewrite ?block_mxEur ?block_mxEdr !mxE //.
  by case: (altP (t =P j)) => [->|_]; rewrite ?(negbTE nu) ?mulr0n ?mul0rn.
have Tf : map_mx emb T *m f = f.
  rewrite /T map_block_mx !map_diag_mx -[f]vsubmxK mul_block_col !map_mx0 mul0mx addr0 !mul_diag_mx.
  congr col_mx; apply/matrixP => j k; rewrite [k]ord1 !mxE -/(xN f j) -/(xF f j) /=.
    by rewrite /uN; case: eqP => [->|_]; rewrite ?rmorph1 ?mul1r ?mulr0.
  rewrite /sl; case: (boolP (uF j)) => uf /=; first by rewrite rmorph0 rmorph1 mul0r add0r mul1r.
  rewrite rmorph0 mul0r addr0; case: (altP (xF f j =P 0)) => [->|fn]; first by rewrite rmorph0 mul0r.
  move: uf; rewrite /uF fn /= negb_or negb_and !negbK => /andP [_ /orP [] /eqP e1].
    by rewrite e1 eqxx.
  case: eqP => [//|_]; by rewrite rmorphN mulNr -/(muF j) e1 opprK.
have rD : (#|J| <= \rank D)%N.
  pose D' : 'M[R]_(n + n) := \matrix_(r, s) ((r == s) && ~~ J r)%:R.
  have e1 : D + D' = 1%:M.
    by apply/matrixP => r s; rewrite !mxE; case: (r == s) => //=;
      [case: (J r); rewrite ?addr0 ?add0r | rewrite addr0].
  have r' : (\rank D' <= #|[predC J]|)%N.
    rewrite -(eq_card (_ : (fun r => ~~ J r) =i [predC J])) //.
    by apply: rank_cols => r s; rewrite negbK mxE => js; case: (r =P s) => //= ->; rewrite js.
  have := mxrank_add D D'; rewrite e1 mxrank1 => le.
  have := leq_trans le (leq_add (leqnn _) r').
  by rewrite -{1}[(n + n)%N]card_ord -(cardC J) leq_add2r.
have IJ : (#|I| < #|J|)%N.
  have cI : #|I| = (\sum_j (uN j + uF j))%N.
    rewrite -sum1_card big_mkcond big_split_ord /= -big_split /=; apply: eq_bigr => j _; congr (_ + _)%N.
      by rewrite unfold_in /I (unsplitK (inl j : 'I_n + 'I_n)); case: (uN j).
    by rewrite unfold_in /I (unsplitK (inr j : 'I_n + 'I_n)); case: (uF j).
  pose zN j := aN AF beps f j == 0; pose zF j := aF AF beps f j == 0.
  have cJ : #|J| = (\sum_j (zN j + zF j))%N.
    rewrite -sum1_card big_mkcond big_split_ord /= -big_split /=; apply: eq_bigr => j _.
    by rewrite !unfold_in /J /zN /zF /aN /aF /xN /xF; case: eqP; case: eqP.
  have le : (\sum_j cnt (muF j) (xN f j) (xF f j) (aN AF beps f j) (aF AF beps f j) + \sum_j (uN j + uF j) <=
     \sum_j (zN j + zF j) + (n + n))%N.
    have e2 : (\sum_(j < n) 2 = n + n)%N by rewrite sum_nat_const card_ord muln2 addnn.
    rewrite -[X in (_ <= _ + X)%N]e2 -!big_split /=; apply: leq_sum => j _; rewrite /cnt /uN /uF /zN /zF.
    case: (xN f j == 0); case: (xF f j == 0); case: (muF j * xN f j == xF f j); case: (muF j * xN f j == - xF f j);
    by case: (aN AF beps f j == 0); case: (aF AF beps f j == 0).
  rewrite cI cJ -(ltn_add2r (n + n)); apply: leq_trans le; by rewrite addnC ltn_add2r.
have nsub : ~~ (kermx (D *m A *m T) <= kermx D)%MS.
  apply/negP => /mxrankS; rewrite !mxrank_ker leq_subLR -{1}(subnKC (rank_leq_row D)) leq_add2r => le.
  have := leq_ltn_trans rT IJ; rewrite ltnNge => /negP; apply; apply: leq_trans rD _; apply: leq_trans le _;
    exact: mxrankM_maxr.
case/row_subPn: nsub => i; set l := row i _ => nl.
have l0 : l *m (D *m A *m T) = 0 by apply/sub_kermxP/row_sub.
case/negP: nl; apply/sub_kermxP/transcendental2.
have e1 : map_mx emb (l *m D) *m acc AF beps f = 0.
  apply/matrixP => r s; rewrite ord1 [s]ord1 mxE [RHS]mxE big1 // => t _; rewrite mxE.
  case: (boolP (J t)) => [/eqP ->|jt]; first by rewrite mulr0.
  rewrite mxE big1 ?rmorph0 ?mul0r // => u _; rewrite [D u t]mxE.
  by case: (altP (u =P t)) => [->|_]; rewrite ?(negbTE jt) mulr0.
have e2 : map_mx emb (l *m D) *m (AF *m f) = 0.
  by rewrite !mulmxA in l0; rewrite -Tf /Statement.MF !mulmxA -!map_mxM l0 map_mx0 mul0mx.
by move: e1; rewrite /acc mulmxDr e2 add0r => ->; rewrite mxE.
Qed.

Lemma psdF (x : 'cV[F]_(n + n)) : 0 <= dotp x (AF *m x).
Proof. by apply: ge0_val; apply: large_imp (val_dotM A x x) => t ->. Qed.
Lemma symF : AF^T = AF. Proof. by rewrite /Statement.MF map_trmx sym. Qed.
Lemma dual_eps v : in_cones muF v -> AF *m v = 0 -> 0 <= dotp v (qF b).
Proof.
move=> vK Av; apply: ge0_val.
have hA : large (fun t => A *m valv v t = 0).
  by apply: large_imp (large_and (val_mul A v) (val_q (0 : 'cV[R]_(n + n)))) => t [<-];
    rewrite Av /Statement.qF map_mx0.
have hK : large (fun t => in_cones mu (valv v t)).
  apply: large_all => j; have [le n0] := vK j; move: le; rewrite ler_norml => /andP [l1 l2].
  rewrite -subr_ge0 opprK in l1; rewrite -subr_ge0 in l2.
  apply: large_imp (large_and (val_ge0 l1) (large_and (val_ge0 l2) (large_and (val_ge0 n0)
    (large_and (Eval.valD (xF v j) (muF j * xN v j)) (large_and (Eval.valD (muF j * xN v j) (- xF v j))
    (large_and (val_opp (xF v j)) (large_and (valM (muF j) (xN v j)) (val_emb (mu j))))))))).
  move=> t [a1 [a2 [a3 [e1 [e2 [e3 [e4 e5]]]]]]]; rewrite /xN /xF !mxE -/(xN v j) -/(xF v j); split=> //.
  rewrite e1 e4 e5 in a1; rewrite e2 e3 e4 e5 in a2.
  by rewrite ler_norml -[X in X && _]subr_ge0 opprK a1 -subr_ge0 a2.
apply: large_imp (large_and hA (large_and hK (large_and (val_dotp v (qF b)) (val_q b)))) => t [h1 [h2 [-> ->]]];
  exact: dual.
Qed.
Lemma cone_eps v : in_cones muF v -> v != 0 -> AF *m v = 0 -> 0 < dotp v beps.
Proof.
move=> vK vn Av; rewrite /Statement.beps !dotpD dotpZ.
apply: ltr_paddl; first exact: dual_eps.
have eNE : dotp v eN = \sum_j xN v j.
  rewrite /dotp big_split_ord /= [X in _ + X]big1 ?addr0 => [|j _];
    last by rewrite /Statement.eN col_mxEd [X in _ * X]mxE mulr0.
  by apply: eq_bigr => j _; rewrite /Statement.eN col_mxEu mxE mulr1.
have n0 j : 0 <= xN v j by case: (vK j).
set S := \sum_j xN v j in eNE *.
have S0 : 0 < S.
  rewrite lt_neqAle sumr_ge0 ?andbT // eq_sym; apply: contra vn => /eqP z.
  have xz j : xN v j = 0 by apply: (psumr_eq0P (fun j _ => n0 j) z).
  apply/eqP/matrixP => r k; rewrite [k]ord1 [RHS]mxE; case: (splitP r) => j er.
    by have -> : r = lshift n j; [exact/val_inj | exact: xz].
  have -> : r = rshift n j by exact/val_inj.
  by have := proj1 (vK j); rewrite xz mulr0 normr_le0 => /eqP.
pose C := 1 + \sum_t mu t; have C0 : 0 < C by rewrite ltr_paddr ?ltr01 // sumr_ge0.
have e0 := eps_gt0 R; have e1 : eps <= 1 by have := eps_small (@ltr01 R); rewrite rmorph1 => /ltW.
have le : `|dotp v (\col_r eps ^+ (place r).+2)| <= eps ^+ 2 * (emb C * S).
  apply: le_trans (ler_norm_sum _ _ _) _.
  apply: le_trans (_ : \sum_r `|v r 0| * eps ^+ 2 <= _).
    apply: ler_sum => r _; rewrite mxE normrM ler_wpmul2l // normrX (gtr0_norm e0).
    by rewrite -addn2 exprD ler_pimull ?exprn_ge0 ?exprn_ile1 ?(ltW e0).
  rewrite -mulr_suml mulrC ler_wpmul2l ?exprn_ge0 ?(ltW e0) // big_split_ord /= -big_split /= /S mulr_sumr.
  apply: ler_sum => j _; rewrite (ger0_norm (n0 j)); have [lj _] := vK j.
  apply: le_trans (_ : xN v j + muF j * xN v j <= _); first by rewrite ler_add2l.
  rewrite -[X in X + _]mul1r -mulrDl ler_wpmul2r //.
  by rewrite /C rmorphD rmorph1 ler_add2l emb_le (bigD1 j) //= ler_addl sumr_ge0.
rewrite eNE -ltr_subl_addr sub0r; apply: le_lt_trans (_ : eps ^+ 2 * (emb C * S) < _).
  by apply: le_trans le; rewrite -normrN ler_norm.
rewrite expr2 -mulrA ltr_pmul2l // mulrA gtr_pmull //.
have := eps_small (_ : 0 < C^-1); rewrite invr_gt0 => /(_ C0) h.
by apply: lt_le_trans (_ : emb C^-1 * emb C <= _); rewrite ?ltr_pmul2r ?emb_gt0 // -rmorphM mulVf ?rmorph1 // gt_eqF.
Qed.
Theorem complete_driving_eps : drives_to_a_solution AF beps muF.
Proof. exact: complete_driving_semidefinite muF0 generic_eps symF psdF cone_eps. Qed.
End Perturbed.
