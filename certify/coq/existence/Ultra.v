(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that every bounded sequence of reals has a limit along a free ultrafilter on the natural numbers;
   so no subsequences. *)
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import mathcomp_extra boolp classical_sets functions reals signed topology normedtype
  sequences realfun.
From Stiction.existence Require Import Statement Polygon.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory numFieldNormedType.Exports.
Local Open Scope ring_scope.
Local Open Scope classical_set_scope.

Lemma free_ultrafilter : exists U : set (set nat), UltraFilter U /\ \oo `<=` U.
Proof. by apply: ultraFilterLemma. Qed.

Section Tends.
Variables (R : realType) (U : set (set nat)).
Hypothesis UU : UltraFilter U.
Hypothesis Uoo : \oo `<=` U.
Let PU : ProperFilter U := ultra_proper.
Let FU : Filter U. Proof. exact _. Qed.
Definition tends (u : nat -> R) (l : R) := u @ U --> l.
Lemma tends_cst c : tends (fun _ => c) c. Proof. exact: cvg_cst. Qed.
Lemma tends_eq u v l : u =1 v -> tends u l -> tends v l.
Proof. by move=> /funext ->. Qed.
Lemma tendsD u v l m : tends u l -> tends v m -> tends (fun j => u j + v j) (l + m).
Proof. by move=> h k; exact: (cvgD h k). Qed.
Lemma tendsN u l : tends u l -> tends (fun j => - u j) (- l).
Proof. by move=> h; exact: (cvgN h). Qed.
Lemma tendsM u v l m : tends u l -> tends v m -> tends (fun j => u j * v j) (l * m).
Proof. by move=> h k; exact: (cvgM h k). Qed.
Lemma tends_sum (I : finType) (u : I -> nat -> R) (l : I -> R) :
  (forall i, tends (u i) (l i)) -> tends (fun j => \sum_i u i j) (\sum_i l i).
Proof.
move=> h; elim: (index_enum I) => [|i s IH].
  by rewrite big_nil; apply: (@tends_eq (fun _ => 0)) => [j|]; [rewrite big_nil | exact: tends_cst].
rewrite big_cons; apply: (@tends_eq (fun j => u i j + \sum_(i <- s) u i j)) => [j|]; first by rewrite big_cons.
exact: tendsD.
Qed.
Lemma tends_len u v l m : tends u l -> tends v m -> tends (fun j => length (u j) (v j)) (length l m).
Proof.
move=> h k; have s : tends (fun j => u j ^+ 2 + v j ^+ 2) (l ^+ 2 + m ^+ 2).
  by apply: tendsD; rewrite expr2; apply: (tendsM _ _).
exact: (cvg_comp s (@sqrt_continuous R _)).
Qed.
Lemma tends_ge0 u l : (forall j, 0 <= u j) -> tends u l -> 0 <= l.
Proof.
by move=> h; apply: (closed_cvg (fun x : R => 0 <= x)); [exact: closed_ge | exact: filterE].
Qed.
Lemma tends_uniq u l m : tends u l -> tends u m -> l = m.
Proof. by move=> h k; apply: (cvg_unique _ h k). Qed.
Lemma tends_gt0 u l : tends u l -> 0 < l -> U [set j | 0 < u j].
Proof. by move=> h l0; apply: (cvgr_gt l h). Qed.
Lemma tends_bounded u B : (forall j, `|u j| <= B) -> exists l, tends u l.
Proof.
move=> hB; have UB : U (u @^-1` `[- B, B]%classic).
  by apply: (@filterE _ U FU) => j; suff : u j \in `[- B, B]%R by []; rewrite in_itv /= -ler_norml.
have [l [_ cl]] := @segment_compact R (- B) B (fmap u U) (fmap_proper_filter u PU) UB.
exists l => V Vl; case: (in_ultra_setVsetC (u @^-1` V) UU) => // nV.
by have [x [nx Vx]] := cl (~` V) V nV Vl.
Qed.
Lemma tends_harmonic : tends (fun j => j.+1%:R^-1) 0.
Proof. move=> V /cvg_harmonic h; exact: Uoo h. Qed.
End Tends.
Arguments tends_cst {R U} UU c.
Arguments tends_eq {R U u v l} _ _.
Arguments tendsD {R U} UU {u v l m} _ _.
Arguments tendsN {R U} UU {u l} _.
Arguments tendsM {R U} UU {u v l m} _ _.
Arguments tends_sum {R U} UU {I u l} _.
Arguments tends_len {R U} UU {u v l m} _ _.
Arguments tends_ge0 {R U} UU {u l} _ _.
Arguments tends_uniq {R U} UU {u l m} _ _.
Arguments tends_gt0 {R U} UU {u l} _ _.
Arguments tends_bounded {R U} UU {u B} _.
Arguments tends_harmonic {R U} Uoo.
