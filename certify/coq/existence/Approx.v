(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that Coulomb's law has solutions up to a factor 1 - 2/M:
   the directions are the points (i/M, j/M) of the disc, M = m + 1. *)
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Stiction.existence Require Import Law Dot Edge Parity Limit Finite Statement Polygon.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Net.
Variables (R : rcfType) (m : nat).
Let M : R := m.+1%:R.
Let M0 : 0 < M. Proof. by rewrite ltr0n. Qed.
Definition coord (s : bool * 'I_m.+2) : R := (-1) ^+ s.1 * (s.2%:R / M).
(* round x to the grid, towards 0 *)
Lemma round x : `|x| <= 1 -> exists s, `|coord s| <= `|x| /\ x ^+ 2 - `|x| / M <= coord s * x.
Proof.
move=> x1; pose P k := k%:R / M <= `|x|.
have P0 : exists k, P k by exists 0%N; rewrite /P mul0r.
have Pm k : P k -> (k <= m.+1)%N.
  by rewrite /P ler_pdivr_mulr // => h; rewrite -(ler_nat R) (le_trans h) // ler_pimull // ltW.
case: (ex_maxnP P0 Pm) => i Pi maxi.
have im : (i < m.+2)%N by rewrite ltnS Pm.
have up : `|x| < i%:R / M + M^-1.
  rewrite ltNge; apply/negP => h; have : P i.+1 by rewrite /P -addn1 natrD mulrDl mul1r.
  by move=> /maxi; rewrite ltnn.
have i0 : 0 <= i%:R / M by apply: divr_ge0; [exact: ler0n | exact: ltW].
exists (x < 0, Ordinal im); rewrite /coord /= normrMsign ger0_norm //; split=> //.
have -> : (-1) ^+ (x < 0)%R * (i%:R / M) * x = i%:R / M * `|x|.
  case: ltP => h; first by rewrite expr1 mulN1r mulNr (ltr0_norm h) mulrN.
  by rewrite expr0 mul1r (ger0_norm h).
have -> : x ^+ 2 - `|x| / M = (`|x| - M^-1) * `|x|.
  by rewrite -[x ^+ 2]real_normK ?num_real // expr2 mulrBl [M^-1 * _]mulrC.
apply: ler_wpmul2r => //.
by rewrite ler_subl_addr ltW.
Qed.

Let K : finType := [finType of (bool * 'I_m.+2) * (bool * 'I_m.+2)].
Let inside (k : K) := length (coord k.1) (coord k.2) <= 1.
Definition dirx (k : K) := if inside k then coord k.1 else 0.
Definition diry (k : K) := if inside k then coord k.2 else 0.
Lemma dir_disc k : length (dirx k) (diry k) <= 1.
Proof. by rewrite /dirx /diry; case: ifP => // _; rewrite len00 ler01. Qed.
Lemma dir_net x y : exists k, (1 - 2%:R / M) * length x y <= - (dirx k * x + diry k * y).
Proof.
case: (altP (length x y =P 0)) => [l0|nz].
  have [-> ->] := len_eq0 l0; exists ((false, ord0), (false, ord0)).
  by rewrite len00 !mulr0 addr0 oppr0.
have lp : 0 < length x y by rewrite lt_neqAle eq_sym nz len_ge0.
pose u := - (x / length x y); pose v := - (y / length x y).
have uv : u ^+ 2 + v ^+ 2 = 1.
  by rewrite /u /v !sqrrN !exprMn -mulrDl -len_sqr exprVn divff // expf_neq0.
have l1 : length u v = 1 by rewrite /length uv sqrtr1.
have u1 : `|u| <= 1 by rewrite -l1 len_maxl.
have v1 : `|v| <= 1 by rewrite -l1 len_maxr.
have [s [s1 s2]] := round u1; have [t [t1 t2]] := round v1.
have ins : inside (s, t).
  rewrite /inside /=; apply: le_len => //; rewrite expr1n -uv.
  by apply: ler_add; rewrite -[leLHS]real_normK ?num_real // -[leRHS]real_normK ?num_real // ler_pexpn2r ?nnegrE.
exists (s, t); rewrite /dirx /diry ins /=.
have -> : - (coord s * x + coord t * y) = (coord s * u + coord t * v) * length x y.
  by rewrite /u /v !mulrN -opprD mulNr mulrDl -!mulrA !mulVf // !mulr1.
rewrite ler_pmul2r //; apply: le_trans (ler_add s2 t2).
rewrite addrACA uv -opprD ler_add2l ler_opp2 -mulrDl ler_pmul2r ?invr_gt0 //.
by rewrite [2%:R](natrD _ 1 1) ler_add.
Qed.
End Net.

Section Approx.
Variables (R : rcfType) (n : nat) (A : 'M[R]_(n + (n + n))) (b : 'cV[R]_(n + (n + n))) (mu : 'I_n -> R).
Hypothesis psd : forall f, 0 <= dotp f (A *m f).
Hypothesis mu0 : forall i, 0 <= mu i.
Hypothesis safe : forall v, obeys 1 mu v (A *m v) -> 0 <= dotp v b.
(* 1 in the normal rows *)
Definition open : 'cV[R]_(n + (n + n)) := col_mx (const_mx 1) 0.
Lemma open_rows i : [/\ nor open i = 1, tx open i = 0 & ty open i = 0].
Proof. by rewrite /nor /tx /ty /open !col_mxEu !col_mxEd !mxE. Qed.
Lemma dotp_open v : dotp v open = \sum_i nor v i.
Proof.
by rewrite dotp_rows; apply: eq_bigr => i _; have [-> -> ->] := open_rows i; rewrite mulr1 !mulr0 !addr0.
Qed.
(* with b = 0 the polygonal law is Coulomb's law: neither dissipates *)
Lemma homogeneous m v : (1 < m)%N -> polygonal mu (@dirx R m) (@diry R m) v (A *m v) -> obeys 1 mu v (A *m v).
Proof.
move=> m1 h; set a := A *m v in h *.
have f0 i : 0 <= nor v i by case: (h i) => [] [].
have p i : nor v i * nor a i + (tx v i * tx a i + ty v i * ty a i) <= 0.
  have [[_ _ ->] [_ [l l0 [_ ->]]]] := h i; by rewrite add0r oppr_le0 !mulr_ge0.
have z i : tx v i * tx a i + ty v i * ty a i = 0.
  have n0 j : true -> 0 <= - (nor v j * nor a j + (tx v j * tx a j + ty v j * ty a j)) by rewrite oppr_ge0.
  have s0 : \sum_j - (nor v j * nor a j + (tx v j * tx a j + ty v j * ty a j)) = 0.
    by apply/eqP; rewrite eq_le sumr_ge0 // andbT sumrN -dotp_rows oppr_le0 psd.
  have /eqP := psumr_eq0P n0 s0 isT (i := i); rewrite oppr_eq0.
  by have [[_ _ ->] _] := h i; rewrite add0r => /eqP.
move=> i; have [nl [ci [l l0 [lk e]]]] := h i; split=> //; split=> //.
rewrite z mul1r; have [k hk] := dir_net m (tx a i) (ty a i).
have lz : l * (mu i * nor v i) = 0 by apply/eqP; rewrite -oppr_eq0 -e z.
have c0 : 0 < 1 - 2%:R / m.+1%:R :> R.
  by rewrite subr_gt0 ltr_pdivr_mulr ?ltr0n // mul1r ltr_nat ltnS.
have le : (1 - 2%:R / m.+1%:R) * length (tx a i) (ty a i) <= l.
  by apply: (le_trans hk); rewrite ler_oppl -subr_ge0 opprK addrC.
rewrite oppr_ge0 -(pmulr_rle0 _ c0).
have n0 : 0 <= mu i * nor v i by rewrite mulr_ge0.
by have := ler_wpmul2r n0 le; rewrite lz -mulrA.
Qed.
Lemma approx m th : (1 < m)%N -> 0 <= th -> exists f, obeys (1 - 2%:R / m.+1%:R) mu f (A *m f + (b + th *: open)).
Proof.
move=> m1 th0; have safe' v : polygonal mu (@dirx R m) (@diry R m) v (A *m v) -> 0 <= dotp v (b + th *: open).
  move=> /(homogeneous m1) ob; rewrite dotpD addr_ge0 ?safe // dotpZ mulr_ge0 // dotp_open sumr_ge0 // => i _.
  by case: (ob i) => [] [].
have [f h] := polygon_solution psd mu0 (@dir_disc R m) safe'.
exists f => i; move: h; set a := _ + _ => h.
have [nl [ci [l l0 [lk ->]]]] := h i; split=> //; split=> //.
rewrite ler_opp2; have [f0 _ _] := nl.
have [k hk] := dir_net m (tx a i) (ty a i).
apply: ler_wpmul2r; first by rewrite mulr_ge0.
by apply: (le_trans hk); rewrite ler_oppl -subr_ge0 opprK addrC.
Qed.
End Approx.
