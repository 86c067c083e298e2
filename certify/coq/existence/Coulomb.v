(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that Coulomb's law has a solution under (H), and that one constant bounds some solution for all b in
   range(A) and all mu <= M. *)
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import mathcomp_extra boolp classical_sets functions reals signed topology normedtype
  sequences realfun.
From mathcomp Require Import ring.
From Stiction.existence Require Import Law Dot Edge Parity Limit Finite Statement Polygon Approx Ultra Cluster.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Main.
Variables (R : realType) (n : nat) (A : 'M[R]_(n + (n + n))).
Hypothesis psd : forall f, 0 <= dotp f (A *m f).
Notation V := 'cV[R]_(n + (n + n)).
Notation op := (open R n).
Let th j : R := j.+1%:R^-1.
Let th_gt0 j : 0 < th j. Proof. by rewrite invr_gt0 ltr0n. Qed.
Let th_ge0 j : 0 <= th j. Proof. exact: ltW. Qed.
Let th_le1 j : th j <= 1. Proof. by rewrite invf_le1 ?ltr0n // ler1n. Qed.
Let lim_one U (UU : UltraFilter U) (Uoo : (\oo `<=` U)%classic) : tends U (fun j => 1 - 2%:R * th j) 1.
Proof.
have := tendsD UU (tends_cst UU 1) (tendsN UU (tendsM UU (tends_cst UU 2%:R) (tends_harmonic (R := R) Uoo))).
by rewrite mulr0 oppr0 addr0.
Qed.

(* A positive semidefinite, symmetric or not; b does no negative work on the solutions of the law with b = 0 *)
Section S.
Variables (b : V) (mu : 'I_n -> R).
Hypothesis mu0 : forall i, 0 <= mu i.
Hypothesis safe : forall v, obeys 1 mu v (A *m v) -> 0 <= dotp v b.
Theorem solution_S : exists f, obeys 1 mu f (A *m f + b).
Proof.
have [U [UU Uoo]] := free_ultrafilter; pose lim := @tends R U.
have lim_th : lim th 0 := tends_harmonic Uoo.
have ex j : exists f, obeys (1 - 2%:R * th j) mu f (A *m f + (b + th j *: op)).
  have [f hf] := approx psd mu0 safe (isT : (1 < j.+2)%N) (th_ge0 j).
  exists f; apply: obeys_weak hf; rewrite ler_add2l ler_opp2 ler_pmul2l ?ltr0n // /th lef_pinv ?posrE ?ltr0n //.
  by rewrite ler_nat -addn2 leq_addr.
have [f hf] := choice ex.
pose a j : V := A *m f j + (b + th j *: op).
pose w j := (1 + \sum_i nor (f j) i)^-1.
have sp j : 0 < 1 + \sum_i nor (f j) i.
  by rewrite ltr_paddr // sumr_ge0 // => i _; case: (hf j i) => [] [].
have w_gt0 j : 0 < w j by rewrite invr_gt0.
pose g j : V := w j *: f j; pose h j : V := w j *: a j.
have law_g j : obeys (1 - 2%:R * th j) mu (g j) (h j) := obeys_scale (ltW (w_gt0 j)) (hf j).
have sum_g j : \sum_i nor (g j) i + w j = 1.
  under eq_bigr do rewrite norZ.
  by rewrite -mulr_sumr -{2}[w j]mulr1 -mulrDr addrC /w mulVf // gt_eqF.
have g_ge0 j i : 0 <= nor (g j) i by case: (law_g j i) => [] [].
have w1 j : w j <= 1 by rewrite -(sum_g j) ler_addr sumr_ge0.
have g1 j i : nor (g j) i <= 1.
  by rewrite -(sum_g j) (bigD1 i) //= -addrA ler_addl addr_ge0 ?(ltW (w_gt0 j)) // sumr_ge0.
have [W lim_w] : exists W, lim w W.
  by apply: (tends_bounded UU (B := 1)) => j; rewrite gtr0_norm.
have [|_ [v lim_g]] := cluster UU (M := mu) (mu := fun _ => mu) _ (fun j => obeys_cone (law_g j)) g1.
  by move=> j i; rewrite mu0 lexx.
pose a0 : V := A *m v + W *: b.
have hE j : h j = A *m g j + w j *: (b + th j *: op) by rewrite /h /a /g scalerDr -scalemxAr.
have lim_h : vlim U h a0.
  have lim0 : lim (fun j => w j * th j) 0 by rewrite -(mulr0 W); exact: (tendsM UU).
  have := vlimD UU (vlimD UU (vlim_mul UU A lim_g) (vlimZ UU lim_w (vlim_cst UU b))) (vlimZ UU lim0 (vlim_cst UU op)).
  by rewrite scale0r addr0; apply: vlim_eq => j; rewrite hE scalerDr scalerA addrA.
have lim_k := lim_one UU Uoo; have lim_mu i := tends_cst UU (mu i).
have law_v := obeys_limit UU lim_k lim_mu lim_g law_g lim_h.
have sum_v : \sum_i nor v i + W = 1.
  apply: (tends_uniq UU (u := fun _ => 1)); last exact: tends_cst.
  apply: (tends_eq sum_g); apply: (tendsD UU) => //.
  exact: (tends_sum UU (fun i => lim_g _)).
have W0 : 0 <= W by apply: (tends_ge0 UU _ lim_w) => j; apply: ltW.
case: (ltrP 0 W) => [Wp|Wn].
  (* the forces have a limit *)
  exists (W^-1 *: v); have -> : A *m (W^-1 *: v) + b = W^-1 *: a0.
    by rewrite -scalemxAr scalerDr scalerA mulVf ?gt_eqF // scale1r.
  by apply: obeys_scale => //; rewrite invr_ge0.
(* the forces run away in the direction v: then b + th op does positive work on v, and the contacts do not *)
exfalso; have W00 : W = 0 by apply/eqP; rewrite eq_le Wn.
rewrite /a0 W00 scale0r addr0 in law_v lim_h.
have vAv : dotp v (A *m v) = 0 by apply/eqP; rewrite eq_le psd andbT (obeys_power ler01 law_v).
have Av : A^T *m v = - (A *m v).
  by apply/eqP; rewrite -addr_eq0 addrC -mulmxDl (kernel_of_sum psd vAv).
have [j [d1 d2]] : exists j, dotp v (h j) <= 0 /\ dotp (A *m v) (g j) <= 0.
  have FU : Filter U by exact _.
  exact: (@filter_ex _ U _ _ (filterI (dissipation UU lim_k lim_mu lim_g law_g ltr01)
    (codissipation UU lim_k law_g ltr01 lim_h))).
have e : dotp v (A *m g j) = - dotp (A *m v) (g j) by rewrite dotp_tr Av dotpC dotpN dotpC.
move: d1; rewrite hE dotpD e (dotpZ v) dotpD (dotpZ v) dotp_open leNgt => /negP; apply.
have -> : \sum_i nor v i = 1 by rewrite -sum_v W00 addr0.
rewrite mulr1 ltr_paddl ?oppr_ge0 // mulr_gt0 // ltr_paddl //; exact: safe.
Qed.
End S.

Hypothesis sym : A^T = A.
Theorem solution_H (b : V) (mu : 'I_n -> R) : (forall i, 0 <= mu i) ->
  (forall v, cone mu v -> A *m v = 0 -> 0 <= dotp v b) -> exists f, obeys 1 mu f (A *m f + b).
Proof.
move=> mu0 safe; apply: solution_S => // v ov; apply: safe; first exact: obeys_cone ov.
by apply: (psd_kernel sym psd); apply/eqP; rewrite eq_le psd andbT (obeys_power ler01 ov).
Qed.

(* one constant for all b in the range of A and all coefficients up to M: jamming forces are never needed *)
Definition size m (b : 'cV[R]_m) := \sum_r `|b r 0|.
Lemma size_ge0 m (b : 'cV[R]_m) : 0 <= size b. Proof. by apply: sumr_ge0. Qed.
Lemma le_size m (b : 'cV[R]_m) r : `|b r 0| <= size b.
Proof. by rewrite /size (bigD1 r) //= ler_addl sumr_ge0. Qed.
Variable M : 'I_n -> R.
Let half : R := 2%:R^-1.
Let half_gt0 : 0 < half. Proof. by rewrite invr_gt0 ltr0n. Qed.
Lemma force_bound : exists2 C, 0 <= C & forall mu c t f, (forall i, 0 <= mu i <= M i) -> 0 < t ->
  obeys half mu f (A *m f + (A *m c + t *: op)) -> \sum_i nor f i <= C * (size (A *m c) + t).
Proof.
apply: contrapT => no.
have ex j : exists x : ('I_n -> R) * V * R * V, let: (mu, c, t, f) := x in
    [/\ forall i, 0 <= mu i <= M i, 0 < t, obeys half mu f (A *m f + (A *m c + t *: op)) &
        j.+1%:R * (size (A *m c) + t) < \sum_i nor f i].
  apply: contrapT => nx; apply: no; exists j.+1%:R; first exact: ler0n.
  move=> mu c t f hmu t0 ob; rewrite leNgt; apply/negP => lt; apply: nx.
  by exists (mu, c, t, f).
have [x hx] := choice ex.
pose mu j := (x j).1.1.1; pose c j := (x j).1.1.2; pose t j := (x j).1.2; pose f j := (x j).2.
have h1 j i : 0 <= mu j i <= M i by rewrite /mu; case: (x j) (hx j) => [[[m' c'] t'] f'] [].
have h2 j : 0 < t j by rewrite /t; case: (x j) (hx j) => [[[m' c'] t'] f'] [].
pose a j : V := A *m f j + (A *m c j + t j *: op).
have h3 j : obeys half (mu j) (f j) (a j).
  by rewrite /a /mu /c /t /f; case: (x j) (hx j) => [[[m' c'] t'] f'] [].
have h4 j : j.+1%:R * (size (A *m c j) + t j) < \sum_i nor (f j) i.
  by rewrite /c /t /f; case: (x j) (hx j) => [[[m' c'] t'] f'] [].
have [U [UU Uoo]] := free_ultrafilter; pose lim := @tends R U.
have sp j : 0 < \sum_i nor (f j) i.
  by apply: le_lt_trans (h4 j); rewrite mulr_ge0 // addr_ge0 ?size_ge0 // ltW.
pose w j := (\sum_i nor (f j) i)^-1.
have w_gt0 j : 0 < w j by rewrite invr_gt0.
pose g j : V := w j *: f j; pose h j : V := w j *: a j.
have law_g j : obeys half (mu j) (g j) (h j) := obeys_scale (ltW (w_gt0 j)) (h3 j).
have sum_g j : \sum_i nor (g j) i = 1.
  by under eq_bigr do rewrite norZ; rewrite -mulr_sumr /w mulVf // gt_eqF.
have g1 j i : nor (g j) i <= 1.
  by rewrite -(sum_g j) (bigD1 i) //= ler_addl sumr_ge0 // => k _; case: (law_g j k) => [] [].
have small j : w j * (size (A *m c j) + t j) <= th j.
  by rewrite /w /th mulrC ler_pdivr_mulr // mulrC ler_pdivl_mulr ?ltr0n // mulrC ltW.
have [[m lim_mu] [v lim_g]] := cluster UU h1 (fun j => obeys_cone (law_g j)) g1.
have lim_small (u : nat -> R) : (forall j, `|u j| <= w j * (size (A *m c j) + t j)) -> lim u 0.
  move=> hu; have uth j : `|u j| <= th j := le_trans (hu j) (small j).
  have [l lim_u] : exists l, lim u l.
    by apply: (tends_bounded UU (B := 1)) => j; apply: le_trans (uth j) _.
  have lim_th : lim th 0 := tends_harmonic Uoo.
  suff <- : l = 0 by [].
  apply/eqP; rewrite eq_le; apply/andP; split.
    rewrite -oppr_ge0 -[- l]add0r; apply: (tends_ge0 UU _ (tendsD UU lim_th (tendsN UU lim_u))) => j.
    by rewrite subr_ge0 (le_trans (ler_norm _)).
  rewrite -[l]add0r; apply: (tends_ge0 UU _ (tendsD UU lim_th lim_u)) => j.
  by rewrite -ler_subl_addr sub0r (le_trans _ (uth j)) // -normrN ler_norm.
have lim_h : vlim U h (A *m v).
  have lim_c : vlim U (fun j => w j *: (A *m c j)) 0.
    move=> r; rewrite mxE; apply: lim_small => j; rewrite mxE normrM gtr0_norm // ler_pmul2l //.
    by rewrite (le_trans (le_size _ _)) // ler_addl ltW.
  have lim_t : lim (fun j => w j * t j) 0.
    apply: lim_small => j; rewrite normrM !gtr0_norm // ler_pmul2l // ler_addr; exact: size_ge0.
  have := vlimD UU (vlimD UU (vlim_mul UU A lim_g) lim_c) (vlimZ UU lim_t (vlim_cst UU op)).
  rewrite scale0r !addr0; apply: vlim_eq => j.
  by rewrite /h /a /g !scalerDr -scalemxAr scalerA addrA.
have law_v := obeys_limit UU (tends_cst UU half) lim_mu lim_g law_g lim_h.
have sum_v : \sum_i nor v i = 1.
  apply: (tends_uniq UU (u := fun _ => 1)); last exact: tends_cst.
  by apply: (tends_eq sum_g); exact: (tends_sum UU (fun i => lim_g _)).
have Av : A *m v = 0.
  by apply: (psd_kernel sym psd); apply/eqP; rewrite eq_le psd andbT (obeys_power (ltW half_gt0) law_v).
have [j] : exists j, dotp v (h j) <= 0.
  have FU : Filter U by exact _.
  exact: (@filter_ex _ U _ _ (dissipation UU (tends_cst UU half) lim_mu lim_g law_g half_gt0)).
rewrite leNgt => /negP; apply; rewrite dotpZ pmulr_rgt0 //.
by rewrite /a !dotpD !sym_dotp // Av ![dotp 0 _]dotpC !dotp0 !add0r dotpZ dotp_open sum_v mulr1.
Qed.

Theorem solution_bounded : exists2 C, 0 <= C & forall mu b, (forall i, 0 <= mu i <= M i) -> (exists c, b = A *m c) ->
  exists2 f, obeys 1 mu f (A *m f + b) & \sum_i nor f i <= C * size b.
Proof.
have [C C0 hC] := force_bound; exists C => // mu _ hmu [c ->]; set b := A *m c.
have mu0 i : 0 <= mu i by have /andP [] := hmu i.
have safe v : obeys 1 mu v (A *m v) -> 0 <= dotp v b.
  move=> ov; have Av : A *m v = 0.
    by apply: (psd_kernel sym psd); apply/eqP; rewrite eq_le psd andbT (obeys_power ler01 ov).
  by rewrite /b sym_dotp // Av dotpC dotp0.
have ex j : exists f, obeys (1 - 2%:R / (j + 4).+1%:R) mu f (A *m f + (b + th j *: op)).
  by apply: approx => //; rewrite addn4.
have [f hf] := choice ex.
have [U [UU Uoo]] := free_ultrafilter; pose lim := @tends R U.
have lim_th : lim th 0 := tends_harmonic Uoo.
have law1 j : obeys half mu (f j) (A *m f j + (b + th j *: op)).
  apply: obeys_weak (hf j).
  have -> : half = 1 - 2%:R / 4%:R.
    by rewrite /half; apply: (@mulfI _ 4%:R); rewrite ?pnatr_eq0 //; field.
  rewrite ler_add2l ler_opp2 ler_pmul2l ?ltr0n // lef_pinv ?posrE ?ltr0n // ler_nat.
  by rewrite ltnW // ltnS leq_addl.
have law2 j : obeys (1 - 2%:R * th j) mu (f j) (A *m f j + (b + th j *: op)).
  apply: obeys_weak (hf j); rewrite ler_add2l ler_opp2 ler_pmul2l ?ltr0n // /th lef_pinv ?posrE ?ltr0n //.
  by rewrite ler_nat ltnS leq_addr.
have bd j : \sum_i nor (f j) i <= C * (size b + th j) := hC _ _ _ _ hmu (th_gt0 j) (law1 j).
have bd1 j i : nor (f j) i <= C * (size b + 1).
  apply: (@le_trans _ _ (\sum_i nor (f j) i)).
    by rewrite (bigD1 i) //= ler_addl sumr_ge0 // => k _; case: (law1 j k) => [] [].
  by rewrite (le_trans (bd j)) // ler_wpmul2l // ler_add2l.
have [_ [v lim_f]] := cluster UU (fun _ => hmu) (fun j => obeys_cone (law1 j)) bd1.
exists v.
  apply: (obeys_limit UU (lim_one UU Uoo) (fun i => tends_cst UU (mu i)) lim_f law2).
  have := vlimD UU (vlim_mul UU A lim_f) (vlimD UU (vlim_cst UU b) (vlimZ UU lim_th (vlim_cst UU op))).
  by rewrite scale0r addr0.
rewrite -subr_ge0.
have := tendsD UU (tendsM UU (tends_cst UU C) (tendsD UU (tends_cst UU (size b)) lim_th))
  (tendsN UU (tends_sum UU (fun i => lim_f (lshift _ i)))).
by rewrite addr0; apply: (tends_ge0 UU) => j; rewrite subr_ge0; exact: bd.
Qed.
End Main.
