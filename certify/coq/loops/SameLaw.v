(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that the law of loops/Statement.v, over Q and lists, is that of existence/Law.v, over any ordered field and
   matrices, and that solutions, symmetric, and definite are the same: who trusts one of the two need not read the
   other, but what takes the one to the other, `of_Q`, `vector_of`, `matrix_of`, `mu_of`. *)
From Coq Require Import QArith Qabs ZArith Arith Lia List.
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ssrZ.
From Stiction.existence Require Law.
From Stiction.claims Require Import Numbers.
From Stiction.loops Require Statement.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.
Delimit Scope Z_scope with coq_Z. Delimit Scope Q_scope with coq_Q.   (* mathcomp has taken %Z and %Q *)

(* ---- (15) and (16) at one contact ---- *)
Section Numbers.
Variable R : realFieldType.
Theorem same_law m fN fF aN aF :
  Statement.law m fN fF aN aF <-> Law.law (of_Q R m) (of_Q R fN) (of_Q R fF) (of_Q R aN) (of_Q R aF).
Proof.
have ge0 x : (0 <= x)%coq_Q <-> 0 <= of_Q R x by rewrite -(of_Q0 R); split=> /(of_Q_le R).
have le0 x : (x <= 0)%coq_Q <-> of_Q R x <= 0 by rewrite -(of_Q0 R); split=> /(of_Q_le R).
have eq0 x : (x == 0)%coq_Q <-> of_Q R x = 0 by rewrite -(of_Q0 R); split=> /(of_Q_eq R).
rewrite /Statement.law /Law.law /Law.normal_conditions -of_Q_abs -!of_QM -of_QN -of_QD -of_QM.
split=> [[[h1 [h2 h3]] [h4 [h5 h6]]]|[[h1 h2 h3] [h4 h5 h6]]].
  by split; split; by [apply/ge0 | apply/eq0 | apply/(of_Q_le R) | apply/le0].
by do !split; by [apply/ge0 | apply/eq0 | apply/(of_Q_le R) | apply/le0].
Qed.
End Numbers.

(* ---- A problem as matrices: here all normal rows come first, in its lists rows are N1 F1 N2 F2 ... ---- *)
Section Problems.
Variables (R : realFieldType) (p : Statement.problem Statement.rationals).
Hypothesis W : Statement.well_formed p.
Notation n := (List.length (Statement.mu p)).
Definition row_of (r : 'I_(n + n)) : nat :=
  match split r with inl i => (2 * i)%coq_nat | inr i => S (2 * i)%coq_nat end.
Definition vector_of (x : list Q) : 'cV[R]_(n + n) := \col_r of_Q R (List.nth (row_of r) x 0%coq_Q).
Definition matrix_of (M : list (list Q)) : 'M[R]_(n + n) :=
  \matrix_(r, s) of_Q R (Statement.entry M (row_of r) (row_of s)).
Definition mu_of (i : 'I_n) : R := of_Q R (List.nth i (Statement.mu p) 0%coq_Q).

Lemma row_normal i : row_of (lshift n i) = (2 * i)%coq_nat.
Proof. by rewrite /row_of (unsplitK (inl i)). Qed.
Lemma row_friction i : row_of (rshift n i) = S (2 * i)%coq_nat.
Proof. by rewrite /row_of (unsplitK (inr i)). Qed.
Lemma sum_pairs k (F : nat -> Q) : of_Q R (Statement.sum (2 * k)%coq_nat F) =
  \sum_(i < k) of_Q R (F (2 * i)%coq_nat) + \sum_(i < k) of_Q R (F (S (2 * i)%coq_nat)).
Proof.
rewrite -big_split; elim: k => [|k IH]; first by rewrite big_ord0 of_Q0.
have two m : of_Q R (Statement.sum m.+2 F) = of_Q R (Statement.sum m F) + (of_Q R (F m) + of_Q R (F m.+1)).
  by rewrite /= !of_QD addrA.
have -> : (2 * k.+1)%coq_nat = (2 * k)%coq_nat.+2 by lia.
by rewrite two big_ord_recr -IH.
Qed.
Lemma acceleration g r : Law.acc (matrix_of (Statement.A p)) (vector_of (Statement.b p)) (vector_of g) r 0 =
  of_Q R (Statement.sum (List.length (Statement.b p))
            (fun j => Statement.entry (Statement.A p) (row_of r) j * List.nth j g 0)
          + List.nth (row_of r) (Statement.b p) 0)%coq_Q.
Proof.
have [-> _] := W; rewrite of_QD sum_pairs /Law.acc mxE [vector_of _ r 0]mxE mxE big_split_ord /=; congr (_ + _ + _).
  by apply: eq_bigr => i _; rewrite !mxE row_normal of_QM.
by apply: eq_bigr => i _; rewrite !mxE row_friction of_QM.
Qed.

Theorem same_solutions g : Statement.solution p g <->
  Law.solution (matrix_of (Statement.A p)) (vector_of (Statement.b p)) mu_of (vector_of g).
Proof.
have at_contact i : Law.law (mu_of i) (Law.xN (vector_of g) i) (Law.xF (vector_of g) i)
    (Law.aN (matrix_of (Statement.A p)) (vector_of (Statement.b p)) (vector_of g) i)
    (Law.aF (matrix_of (Statement.A p)) (vector_of (Statement.b p)) (vector_of g) i) <->
  let a j := (Statement.sum (List.length (Statement.b p))
    (fun k => Statement.entry (Statement.A p) j k * List.nth k g 0) + List.nth j (Statement.b p) 0)%coq_Q in
  Statement.law (List.nth i (Statement.mu p) 0%coq_Q) (List.nth (2 * i)%coq_nat g 0%coq_Q)
    (List.nth (S (2 * i)%coq_nat) g 0%coq_Q) (a (2 * i)%coq_nat) (a (S (2 * i)%coq_nat)).
  rewrite /= (same_law R) /Law.aN /Law.aF /Law.xN /Law.xF !acceleration /mu_of.
  by rewrite ![vector_of g _ 0]mxE row_normal row_friction.
split=> [h i|h f a c hc]; first by apply/at_contact; apply: h; apply/ssrnat.ltP; exact: ltn_ord.
by have /at_contact := h (Ordinal (introT ssrnat.ltP hc)).
Qed.
End Problems.

(* ---- What is said of A ---- *)
Section Matrices.
Variable p : Statement.problem Statement.rationals.
Notation n := (List.length (Statement.mu p)).
Notation row_of := (@row_of p).
Lemma row_of_lt r : (row_of r < 2 * n)%coq_nat.
Proof.
case: (split_ordP r) => i ->; rewrite ?row_normal ?row_friction; have /ssrnat.ltP := ltn_ord i; lia.
Qed.
Lemma row_of_onto k : (k < 2 * n)%coq_nat -> exists r, row_of r = k.
Proof.
move=> kn; have [[i e]|[i e]] := Nat.Even_or_Odd k.
  have lt : (i < n)%N by apply/ssrnat.ltP; lia.
  by exists (lshift n (Ordinal lt)); rewrite row_normal /=; lia.
have lt : (i < n)%N by apply/ssrnat.ltP; lia.
by exists (rshift n (Ordinal lt)); rewrite row_friction /=; lia.
Qed.
Lemma row_of_inj : injective row_of.
Proof.
move=> r s; case: (split_ordP r) => i ->; case: (split_ordP s) => j ->; rewrite ?row_normal ?row_friction => e.
- by congr lshift; apply: ord_inj; lia.
- by exfalso; lia.
- by exfalso; lia.
- by congr rshift; apply: ord_inj; lia.
Qed.

Theorem same_symmetric (R : realFieldType) M :
  Statement.symmetric (2 * n)%coq_nat M <-> (matrix_of R p M)^T = matrix_of R p M.
Proof.
split=> [h|h i j]; first by apply/matrixP => r s; rewrite !mxE; apply/of_Q_eq/h; exact: row_of_lt.
move=> /row_of_onto [r <-] /row_of_onto [s <-]; have := congr1 (fun B : 'M_(n + n) => B s r) h.
by rewrite !mxE => /of_Q_eq.
Qed.

(* every rational number of mathcomp is one of Coq *)
Definition to_Q (x : rat) : Q := Qmake (Z_of_int (numq x)) (Z.to_pos (Z_of_int (denq x))).
Lemma to_QK x : of_Q _ (to_Q x) = x.
Proof.
rewrite /of_Q /of_Z /= Z_of_intK; suff -> : Posz (Pos.to_nat (Z.to_pos (Z_of_int (denq x)))) = denq x.
  exact: divq_num_den.
by rewrite -[RHS]Z_of_intK; have := denq_gt0 x; case: (denq x) => // -[|m] // _; rewrite /= -Nat2Pos.id.
Qed.

Lemma quadratic_of (R : realFieldType) M x : let v : 'cV_(n + n) := \col_r of_Q R (x (row_of r)) in
  of_Q R (Statement.quadratic (2 * n)%coq_nat M x) = Law.dotp v (matrix_of R p M *m v).
Proof.
rewrite /Statement.quadratic sum_pairs /Law.dotp big_split_ord.
congr (_ + _); apply: eq_bigr => i _; rewrite of_QM sum_pairs [in RHS]mxE ?row_normal ?row_friction; congr (_ * _);
  rewrite mxE big_split_ord; congr (_ + _); apply: eq_bigr => j _;
  by rewrite of_QM !mxE ?row_normal ?row_friction.
Qed.

Theorem same_definite M : Statement.positive_definite (2 * n)%coq_nat M <->
  forall v : 'cV[rat]_(n + n), v != 0 -> 0 < Law.dotp v (matrix_of _ p M *m v).
Proof.
have gt0 x : 0 < of_Q rat_realFieldType x <-> (0 < x)%coq_Q.
  rewrite ltNge -(of_Q0 rat_realFieldType); split=> [/negP h|h]; last first.
    by apply/negP => /of_Q_le; exact: Qlt_not_le.
  by apply: Qnot_le_lt => /(of_Q_le rat_realFieldType).
split=> [h v v0|h x [i [/row_of_onto [r <-] xr]]].
  pose x k := if [pick r | row_of r == k] is Some r then to_Q (v r 0) else 0%coq_Q.
  have xE r : x (row_of r) = to_Q (v r 0).
    by rewrite /x; case: pickP => [s /eqP /row_of_inj -> //|/(_ r)]; rewrite eqxx.
  have vE : v = \col_r of_Q rat_realFieldType (x (row_of r)).
    by apply/matrixP => r j; rewrite [j]ord1 [RHS]mxE xE to_QK.
  rewrite {1}vE [X in _ *m X]vE -quadratic_of; apply/gt0/h.
  have [r vr] : exists r, v r 0 != 0.
    apply/existsP; apply: contraNT v0; rewrite negb_exists => /forallP z.
    by apply/eqP/matrixP => r j; rewrite [j]ord1 mxE; apply/eqP; have := z r; rewrite negbK.
  exists (row_of r); split; first exact: row_of_lt.
  by rewrite xE => /(of_Q_eq rat_realFieldType); rewrite to_QK of_Q0; apply/eqP.
apply/gt0; rewrite quadratic_of; apply: h; apply/eqP => z; apply: xr; apply/(of_Q_eq rat_realFieldType).
by have := congr1 (fun u : 'cV_(n + n) => u r 0) z; rewrite !mxE of_Q0.
Qed.
End Matrices.
