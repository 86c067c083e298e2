(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that a walk meets no point twice and ends, if it uses two partial matchings of a finite set in turn from a
   point that one of them leaves alone. Here the points are the ends of pieces: `m true` goes over to the next piece,
   `m false` to the other end of the piece, or the reverse. *)
From mathcomp Require Import all_ssreflect.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

Section Path.
Variables (T : finType) (m : bool -> T -> option T) (c0 : bool) (x0 : T).
Hypothesis sym : forall c x y, m c x = Some y -> m c y = Some x.
Hypothesis irr : forall c x, m c x <> Some x.
Hypothesis start : m (~~ c0) x0 = None.

Definition turn k := c0 (+) odd k.
Fixpoint pos k : option T := if k is k'.+1 then obind (m (turn k')) (pos k') else Some x0.

Lemma posS k y : pos k.+1 = Some y -> exists2 x, pos k = Some x & m (turn k) x = Some y.
Proof. by rewrite /=; case: (pos k) => //= x e; exists x. Qed.
Lemma pos_le j k y : j <= k -> pos k = Some y -> exists x, pos j = Some x.
Proof.
elim: k y => [|k IH] y; first by rewrite leqn0 => /eqP ->; exists y.
by rewrite leq_eqVlt => /orP [/eqP -> e|jk /posS [x e _]]; [exists y | exact: IH e].
Qed.
Lemma turnE i j : odd i = odd j -> turn i = turn j.
Proof. by rewrite /turn => ->. Qed.

Lemma pos_inj_even i j x : odd i = odd j -> i <= j -> pos i = Some x -> pos j = Some x -> i = j.
Proof.
elim: i j x => [|i IH] [|j] x //=.
  move=> o _ [<-] /posS [y _ h]; have := sym h.
  suff -> : turn j = ~~ c0 by rewrite start.
  by rewrite /turn; move: o; case: (odd j) => //= _; case: c0.
move=> o le /posS [y pi hi] /posS [z pj hj].
have o' : odd i = odd j by move: o; case: (odd i); case: (odd j).
have e : y = z by have := sym hi; rewrite (turnE o') (sym hj) => -[].
by congr _.+1; apply: (IH j y) => //; rewrite e.
Qed.
Lemma pos_inj_odd d i x : ~~ (pos i == Some x) || ~~ (pos (i + d.*2.+1) == Some x).
Proof.
elim: d i x => [|d IH] i x; rewrite -negb_and; apply/negP => /andP [/eqP pi /eqP pj].
  by rewrite addn1 in pj; case/posS: pj => y; rewrite pi => -[<-]; exact: irr.
have le : i.+1 <= i + d.+1.*2.+1 by rewrite -addn1 leq_add2l.
have [y py] := pos_le le pj; have [x' px' hy] := posS py.
have {x' px' hy} hy : m (turn i) x = Some y by move: px'; rewrite pi => -[->].
have ej : i + d.+1.*2.+1 = (i.+1 + d.*2.+1).+1 by rewrite doubleS !addnS !addSn.
rewrite ej in pj; have [z pz hz] := posS pj.
have e : y = z.
  have := sym hz; rewrite (turnE (j := i)) ?hy; first by case.
  by rewrite oddD /= odd_double /= addbT negbK.
by have := IH i.+1 y; rewrite py e pz eqxx.
Qed.
Theorem pos_inj i j x : pos i = Some x -> pos j = Some x -> i = j.
Proof.
wlog le : i j / i <= j => [w pi pj|pi pj].
  by case/orP: (leq_total i j) => le; [exact: w | symmetry; apply: w].
case: (eqVneq (odd i) (odd j)) => o; first exact: pos_inj_even pi pj.
have e : j = i + (j - i)./2.*2.+1.
  have ood : odd (j - i) by rewrite oddB //; move: o; case: (odd i); case: (odd j).
  have := odd_double_half (j - i); rewrite ood add1n => ->; by rewrite subnKC.
by have := pos_inj_odd (j - i)./2 i x; rewrite -e pi pj eqxx.
Qed.
(* it ends: at the latest when every point has been met *)
Theorem pos_ends : exists k x, [/\ k < #|T|, pos k = Some x & m (turn k) x = None].
Proof.
have [k kT pk] : exists2 k, k <= #|T| & pos k = None.
  case: (pickP (fun k : 'I_#|T|.+1 => pos k == None)) => [k /eqP e|h]; first by exists k; rewrite // -ltnS.
  pose f (k : 'I_#|T|.+1) := odflt x0 (pos k).
  have fE (k : 'I_#|T|.+1) : pos k = Some (f k) by have := h k; rewrite /f; case: (pos k).
  have fi : injective f by move=> i j e; apply/val_inj/(pos_inj (fE i)); rewrite e; exact: fE.
  by have := leq_card f fi; rewrite card_ord ltnn.
elim: k kT pk => [//|k IH] kT /=; case pk: (pos k) => [x|] /= h; last by apply: IH => //; exact: ltnW.
by exists k, x.
Qed.
End Path.
