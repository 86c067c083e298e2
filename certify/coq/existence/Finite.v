(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that complementarity problems have solutions whose rows are named by a finite type and whose matrix is
   M x y = E x . A E y + S x y, A positive semidefinite, S with z' S z' + z' S z >= 0:
   the form of every polygonal law. *)
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
From Stiction.existence Require Import Law Dot Edge Parity Limit.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section FinLCP.
Variables (R : realFieldType) (T : finType).
Definition app (M : T -> T -> R) (z : T -> R) x := \sum_y M x y * z y.
Definition ip (z z' : T -> R) := \sum_x z x * z' x.
Definition nng (z : T -> R) := forall x, 0 <= z x.
Lemma eq_ip z z1 u u1 : z =1 z1 -> u =1 u1 -> ip z u = ip z1 u1.
Proof. by move=> h k; apply: eq_bigr => x _; rewrite h k. Qed.
Lemma ip_ge0 z z' : nng z -> nng z' -> 0 <= ip z z'.
Proof. by move=> h k; apply: sumr_ge0 => x _; rewrite mulr_ge0. Qed.
Lemma ipD z u v : ip z (fun x => u x + v x) = ip z u + ip z v.
Proof. by rewrite -big_split; apply: eq_bigr => x _; rewrite mulrDr. Qed.

Variables (M : T -> T -> R) (q : T -> R).
Hypothesis copositive : forall z, nng z -> 0 <= ip z (app M z).
Hypothesis rays : forall z z', nng z -> nng z' -> nng (app M z) -> ip z (app M z) = 0 ->
  0 <= ip z q /\ 0 <= ip z (app M z') + ip z' (app M z).
Let P : 'M[R]_#|T| := \matrix_(i, j) M (enum_val i) (enum_val j).
Let r : 'cV[R]_#|T| := \col_i q (enum_val i).
Let fn (z : 'cV[R]_#|T|) x := z (enum_rank x) 0.
Let sumE (F : T -> R) : \sum_x F x = \sum_(i < #|T|) F (enum_val i).
Proof. by rewrite (reindex _ (onW_bij _ (@enum_val_bij T))). Qed.
Let fn_nng z : nonneg z -> nng (fn z). Proof. by move=> h x; apply: h. Qed.
Let fn_app z : app M (fn z) =1 fn (P *m z).
Proof.
move=> x; rewrite /fn mxE /app sumE; apply: eq_bigr => i _.
by rewrite mxE enum_rankK enum_valK.
Qed.
Let fn_ip z z' : ip (fn z) (fn z') = dotp z z'.
Proof. by rewrite /ip sumE; apply: eq_bigr => i _; rewrite /fn enum_valK. Qed.
Let fn_r : q =1 fn r. Proof. by move=> x; rewrite /fn mxE enum_rankK. Qed.

Lemma lcp_fin : exists z, [/\ nng z, nng (fun x => app M z x + q x) & forall x, z x * (app M z x + q x) = 0].
Proof.
have d0 i : 0 < (const_mx 1 : 'cV[R]_#|T|) i 0 by rewrite mxE ltr01.
have fi z z' : ip (fn z) (app M (fn z')) = dotp z (P *m z').
  by rewrite -fn_ip; apply: eq_ip => // x; apply: fn_app.
have co z : nonneg z -> 0 <= dotp z (P *m z) by move=> /fn_nng h; rewrite -fi; apply: copositive.
have ra z z' : nonneg z -> nonneg z' -> nonneg (P *m z) -> dotp z (P *m z) = 0 ->
    0 <= dotp z r /\ 0 <= dotp z (P *m z') + dotp z' (P *m z).
  move=> /fn_nng h /fn_nng h' /fn_nng k e.
  have [|r1 r2] := rays h h' _ (etrans (fi _ _) e); first by move=> x; rewrite fn_app.
  by rewrite -!fi; split=> //; rewrite -fn_ip -(eq_ip (frefl _) fn_r).
have [w [z [w0 z0 we wz]]] := lcp_solvable d0 co ra.
exists (fn z); have wE x : app M (fn z) x + q x = fn w x by rewrite fn_app fn_r we /fn [RHS]mxE.
by split=> [|x|x]; [exact: fn_nng | rewrite wE; exact: fn_nng | rewrite wE mulrC; exact: wz].
Qed.
End FinLCP.

Section Factor.
Variables (R : realFieldType) (T : finType) (N : nat) (A : 'M[R]_N) (b : 'cV[R]_N).
Hypothesis psd : forall f, 0 <= dotp f (A *m f).
Lemma dotp_tr f g : dotp f (A *m g) = dotp (A^T *m f) g.
Proof. by rewrite -dotp_adj trmxK. Qed.
Lemma kernel_of_sum f : dotp f (A *m f) = 0 -> (A + A^T) *m f = 0.
Proof.
have dbl g : dotp g ((A + A^T) *m g) = dotp g (A *m g) + dotp g (A *m g).
  by rewrite mulmxDl dotpD; congr (_ + _); rewrite dotp_adj dotpC.
move=> e; apply: psd_kernel; last by rewrite dbl e addr0.
  by rewrite linearD /= trmxK addrC.
by move=> g; rewrite dbl addr_ge0.
Qed.
Variables (E : T -> 'cV[R]_N) (S : T -> T -> R).
Definition force (z : T -> R) : 'cV[R]_N := \sum_x z x *: E x.
Definition comp (z : T -> R) (a : 'cV[R]_N) := nng z /\
  forall x, 0 <= dotp (E x) a + app S z x /\ z x * (dotp (E x) a + app S z x) = 0.
Hypothesis skew : forall z z', nng z -> nng z' -> 0 <= ip z (app S z') + ip z' (app S z).
Hypothesis rays : forall z, comp z (A *m force z) -> 0 <= dotp (force z) b.

Let M x y := dotp (E x) (A *m E y) + S x y.
Lemma dotp_force z u : dotp (force z) u = \sum_x z x * dotp (E x) u.
Proof.
rewrite /force; elim/big_ind2: _ => [|x1 x2 y1 y2 e1 e2|x _]; first by rewrite dotpC dotp0.
  by rewrite dotpDl e1 e2.
by rewrite dotpC dotpZ dotpC.
Qed.
Let appM z x : app M z x = dotp (E x) (A *m force z) + app S z x.
Proof.
rewrite dotp_tr // dotpC dotp_force /app -big_split; apply: eq_bigr => y _.
by rewrite mulrDl (dotpC (E y)) -dotp_tr // [_ * z y]mulrC.
Qed.
Let ipM z z' : ip z (app M z') = dotp (force z) (A *m force z') + ip z (app S z').
Proof. by rewrite (eq_ip (frefl z) (appM z')) ipD dotp_force. Qed.
Let skew1 z : nng z -> 0 <= ip z (app S z).
Proof. by move=> h; have := skew h h; rewrite -mulr2n pmulrn_lge0. Qed.

Lemma lcp_factor : exists z, comp z (A *m force z + b).
Proof.
have co z : nng z -> 0 <= ip z (app M z) by move=> h; rewrite ipM addr_ge0 // skew1.
have ra z z' : nng z -> nng z' -> nng (app M z) -> ip z (app M z) = 0 ->
    0 <= ip z (fun x => dotp (E x) b) /\ 0 <= ip z (app M z') + ip z' (app M z).
  move=> h h' k e; have := e; rewrite ipM => e'.
  have [e1 _] := sum0 (psd _) (skew1 h) e'.
  have Af := kernel_of_sum e1; split.
    rewrite /ip -dotp_force; apply: rays; split=> // x; rewrite -appM; split; first exact: k.
    have h0 y : true -> 0 <= z y * app M z y by rewrite mulr_ge0.
    exact: (psumr_eq0P h0 e).
  rewrite !ipM dotp_tr addrACA (dotpC _ (force z')) -dotpD -mulmxDl addrC [A^T + A]addrC Af dotp0 addr0.
  exact: skew.
have [z [z0 w0 zw]] := lcp_fin co ra.
exists z; split=> // x; rewrite dotpD addrAC -appM; split; [exact: w0 | exact: zw].
Qed.
End Factor.
