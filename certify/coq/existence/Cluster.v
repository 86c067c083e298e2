(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves of limits of forces that obey Coulomb's law up to a factor:
   they obey it, and friction works against them in the end. *)
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import mathcomp_extra boolp classical_sets functions reals signed topology normedtype
  sequences realfun.
From mathcomp Require Import ring.
From Stiction.existence Require Import Law Dot Edge Parity Limit Finite Statement Polygon Approx Ultra.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Cluster.
Variables (R : realType) (n : nat) (U : set (set nat)).
Hypothesis UU : UltraFilter U.
Notation V := 'cV[R]_(n + (n + n)).
Notation lim := (@tends R U).
Definition vlim m (u : nat -> 'cV[R]_m) (v : 'cV[R]_m) := forall r, lim (fun j => u j r 0) (v r 0).
Let FU : Filter U. Proof. exact _. Qed.

Lemma vlim_mul m p (A : 'M[R]_(p, m)) u v : vlim u v -> vlim (fun j => A *m u j) (A *m v).
Proof.
move=> h r; have := tends_sum UU (fun s => tendsM UU (tends_cst UU (A r s)) (h s)).
by rewrite [(A *m v) r 0]mxE; apply: tends_eq => j; rewrite mxE.
Qed.
Lemma vlimD m (u u' : nat -> 'cV[R]_m) v v' : vlim u v -> vlim u' v' -> vlim (fun j => u j + u' j) (v + v').
Proof.
by move=> h h' r; rewrite [(v + v') r 0]mxE; apply: (tends_eq _ (tendsD UU (h r) (h' r))) => j; rewrite mxE.
Qed.
Lemma vlimZ m (c : nat -> R) l (u : nat -> 'cV[R]_m) v : lim c l -> vlim u v -> vlim (fun j => c j *: u j) (l *: v).
Proof.
by move=> h h' r; rewrite [(l *: v) r 0]mxE; apply: (tends_eq _ (tendsM UU h (h' r))) => j; rewrite mxE.
Qed.
Lemma vlim_cst m (v : 'cV[R]_m) : vlim (fun _ => v) v.
Proof. by move=> r; exact: tends_cst. Qed.
Lemma vlim_eq m (u u' : nat -> 'cV[R]_m) v : u =1 u' -> vlim u v -> vlim u' v.
Proof. by move=> /funext ->. Qed.

(* bounded forces accumulate *)
Lemma cluster (B : R) (M : 'I_n -> R) (mu : nat -> 'I_n -> R) (g : nat -> V) :
  (forall j i, 0 <= mu j i <= M i) -> (forall j, cone (mu j) (g j)) -> (forall j i, nor (g j) i <= B) ->
  (exists m, forall i, lim (fun j => mu j i) (m i)) /\ exists v, vlim g v.
Proof.
move=> hM cg hB; split.
  have ex i : exists m, lim (fun j => mu j i) m.
    apply: (tends_bounded UU (B := M i)) => j; have /andP [m0 mM] := hM j i.
    by rewrite ger0_norm.
  have [m hm] := choice ex; by exists m.
have ex r : exists l, lim (fun j => g j r 0) l.
  have c2 j i : mu j i * nor (g j) i <= M i * B.
    by have /andP [m0 mM] := hM j i; have [n0 _] := cg j i; rewrite ler_pmul.
  case: (split_ordP r) => [i ->|s ->].
    by apply: (tends_bounded UU (B := B)) => j; have [c _] := cg j i; rewrite ger0_norm // hB.
  case: (split_ordP s) => i ->; apply: (tends_bounded UU (B := M i * B)) => j;
    have [_ c] := cg j i; apply: le_trans (le_trans c (c2 j i)); [exact: len_maxl | exact: len_maxr].
have [l hl] := choice ex.
by exists (\col_r l r) => r; rewrite mxE.
Qed.

Variables (k_ : nat -> R) (k : R) (mu_ : nat -> 'I_n -> R) (mu : 'I_n -> R) (g h : nat -> V) (v : V).
Hypothesis lim_k : lim k_ k.
Hypothesis lim_mu : forall i, lim (fun j => mu_ j i) (mu i).
Hypothesis lim_g : vlim g v.
Hypothesis law : forall j, obeys (k_ j) (mu_ j) (g j) (h j).

Let lN i : lim (fun j => nor (g j) i) (nor v i). Proof. exact: lim_g. Qed.
Let lX i : lim (fun j => tx (g j) i) (tx v i). Proof. exact: lim_g. Qed.
Let lY i : lim (fun j => ty (g j) i) (ty v i). Proof. exact: lim_g. Qed.
Arguments lim_mu : clear implicits. Arguments lN : clear implicits.
Arguments lX : clear implicits. Arguments lY : clear implicits.
Let lmu i : lim (fun j => mu_ j i * nor (g j) i) (mu i * nor v i). Proof. exact: (tendsM UU (lim_mu i) (lN i)). Qed.
Arguments lmu : clear implicits.

Lemma cone_limit : cone mu v.
Proof.
move=> i; split.
  by apply: (tends_ge0 UU _ (lN i)) => j; case: (law j i) => [] [].
rewrite -subr_ge0; apply: (tends_ge0 UU _ (tendsD UU (lmu i) (tendsN UU (tends_len UU (lX i) (lY i))))) => j.
by rewrite subr_ge0; case: (law j i) => _ [].
Qed.

(* the law is closed *)
Lemma obeys_limit a : vlim h a -> obeys k mu v a.
Proof.
move=> lim_h i; have [c1 c2] := cone_limit i.
have kN : lim (fun j => nor (h j) i) (nor a i) by exact: lim_h.
have kX : lim (fun j => tx (h j) i) (tx a i) by exact: lim_h.
have kY : lim (fun j => ty (h j) i) (ty a i) by exact: lim_h.
split; first split=> //.
- by apply: (tends_ge0 UU _ kN) => j; case: (law j i) => [] [].
- apply: (tends_uniq UU (tendsM UU (lN i) kN)); apply: tends_eq (tends_cst UU 0) => j.
  by case: (law j i) => [] [].
split=> //; rewrite -subr_ge0.
have := tendsD UU (tendsN UU (tendsM UU (tendsM UU lim_k (tends_len UU kX kY)) (lmu i)))
  (tendsN UU (tendsD UU (tendsM UU (lX i) kX) (tendsM UU (lY i) kY))).
by apply: (tends_ge0 UU) => j; rewrite subr_ge0; case: (law j i) => _ [].
Qed.

(* dissipation: contacts that are squeezed along v do no positive work on v in the end *)
Lemma dissipation : 0 < k -> U [set j | dotp v (h j) <= 0]%classic.
Proof.
move=> kp.
have term i : U [set j | nor v i * nor (h j) i + (tx v i * tx (h j) i + ty v i * ty (h j) i) <= 0]%classic.
  have [N0 cN] := cone_limit i.
  have sq : U [set j | nor v i * nor (h j) i = 0]%classic.
    case: (ltrP 0 (nor v i)) => [Np|Nn]; last first.
      have -> : nor v i = 0 by apply/eqP; rewrite eq_le Nn.
      by apply: filterE => j /=; rewrite mul0r.
    apply: filterS (tends_gt0 UU (lN i) Np) => j /= gp.
    have [[_ _ /eqP n3] _] := law j i; move: n3; rewrite mulf_eq0 (gt_eqF gp) /= => /eqP ->.
    by rewrite mulr0.
  case: (ltrP 0 (mu i * nor v i)) => [mp|mn]; last first.
    have /len_eq0 [-> ->] : length (tx v i) (ty v i) = 0.
      by apply/eqP; rewrite eq_le len_ge0 andbT (le_trans cN).
    by apply: filterS sq => j /= ->; rewrite !mul0r !addr0.
  have lim_d := tendsD UU (tendsM UU lim_k (lmu i)) (tendsN UU (tends_len UU
    (tendsD UU (tends_cst UU (tx v i)) (tendsN UU (lX i))) (tendsD UU (tends_cst UU (ty v i)) (tendsN UU (lY i))))).
  rewrite !subrr len00 subr0 in lim_d.
  have kmp : 0 < k * (mu i * nor v i) by rewrite mulr_gt0.
  apply: filterS (filterI sq (tends_gt0 UU lim_d kmp)) => j /= [-> dp]; rewrite add0r.
  have [_ [_ p]] := law j i.
  have q := cauchy (tx v i - tx (g j) i) (ty v i - ty (g j) i) (tx (h j) i) (ty (h j) i).
  have := ler_add p q.
  have -> : tx (g j) i * tx (h j) i + ty (g j) i * ty (h j) i +
    ((tx v i - tx (g j) i) * tx (h j) i + (ty v i - ty (g j) i) * ty (h j) i) =
    tx v i * tx (h j) i + ty v i * ty (h j) i by ring.
  move=> /le_trans; apply; move: dp.
  set L := length (tx (h j) i) _; set D := length (tx v i - _) _ => dp.
  have -> : - (k_ j * L * (mu_ j i * nor (g j) i)) + D * L = - (L * (k_ j * (mu_ j i * nor (g j) i) - D)) by ring.
  by rewrite oppr_le0 mulr_ge0 ?len_ge0 // ltW.
apply: filterS (filter_forall FU term) => j hj /=.
by rewrite dotp_rows -oppr_ge0 -sumrN sumr_ge0 // => i _; rewrite oppr_ge0; exact: hj.
Qed.

(* and the limit of the accelerations, if there is one, does no positive work on the forces in the end *)
Lemma codissipation a : 0 < k -> vlim h a -> U [set j | dotp a (g j) <= 0]%classic.
Proof.
move=> kp lim_h.
have term i : U [set j | nor a i * nor (g j) i + (tx a i * tx (g j) i + ty a i * ty (g j) i) <= 0]%classic.
  have kN : lim (fun j => nor (h j) i) (nor a i) by exact: lim_h.
  have kX : lim (fun j => tx (h j) i) (tx a i) by exact: lim_h.
  have kY : lim (fun j => ty (h j) i) (ty a i) by exact: lim_h.
  have sq : U [set j | nor a i * nor (g j) i = 0]%classic.
    case: (ltrP 0 (nor a i)) => [Np|Nn]; last first.
      have -> : nor a i = 0.
        apply/eqP; rewrite eq_le Nn; apply: (tends_ge0 UU _ kN) => j; by case: (law j i) => [] [].
      by apply: filterE => j /=; rewrite mul0r.
    apply: filterS (tends_gt0 UU kN Np) => j /= hp.
    have [[_ _ /eqP n3] _] := law j i; move: n3; rewrite mulf_eq0 (gt_eqF hp) orbF => /eqP ->.
    by rewrite mulr0.
  case: (ltrP 0 (length (tx a i) (ty a i))) => [lp|ln]; last first.
    have /len_eq0 [-> ->] : length (tx a i) (ty a i) = 0 by apply/eqP; rewrite eq_le len_ge0 ln.
    by apply: filterS sq => j /= ->; rewrite !mul0r !addr0.
  have lim_d := tendsD UU (tendsM UU lim_k (tends_len UU kX kY)) (tendsN UU (tends_len UU
    (tendsD UU (tends_cst UU (tx a i)) (tendsN UU kX)) (tendsD UU (tends_cst UU (ty a i)) (tendsN UU kY)))).
  rewrite !subrr len00 subr0 in lim_d.
  have klp : 0 < k * length (tx a i) (ty a i) by rewrite mulr_gt0.
  apply: filterS (filterI sq (tends_gt0 UU lim_d klp)) => j /= [-> dp]; rewrite add0r.
  have [_ [q' p]] := law j i.
  have q := cauchy (tx a i - tx (h j) i) (ty a i - ty (h j) i) (tx (g j) i) (ty (g j) i).
  have := ler_add p (le_trans q (ler_wpmul2l (len_ge0 _ _) q')).
  have -> : tx (g j) i * tx (h j) i + ty (g j) i * ty (h j) i +
    ((tx a i - tx (h j) i) * tx (g j) i + (ty a i - ty (h j) i) * ty (g j) i) =
    tx a i * tx (g j) i + ty a i * ty (g j) i by ring.
  move=> /le_trans; apply; move: dp.
  set L := length (tx (h j) i) _; set D := length (tx a i - _) _ => dp.
  have -> : - (k_ j * L * (mu_ j i * nor (g j) i)) + D * (mu_ j i * nor (g j) i) =
    - ((k_ j * L - D) * (mu_ j i * nor (g j) i)) by ring.
  by rewrite oppr_le0 mulr_ge0 //; [exact: ltW | exact: le_trans (len_ge0 _ _) q'].
apply: filterS (filter_forall FU term) => j hj /=.
by rewrite dotp_rows -oppr_ge0 -sumrN sumr_ge0 // => i _; rewrite oppr_ge0; exact: hj.
Qed.
End Cluster.
Arguments vlim_mul {R U} UU {m p} A {u v} _.
Arguments vlimD {R U} UU {m u u' v v'} _ _.
Arguments vlimZ {R U} UU {m c l u v} _ _.
Arguments vlim_cst {R U} UU {m} v.
Arguments cluster {R n U} UU {B M mu g} _ _ _.
Arguments cone_limit {R n U} UU {k_ mu_ mu g h v} _ _ _.
Arguments obeys_limit {R n U} UU {k_ k mu_ mu g h v} _ _ _ _ {a} _.
Arguments dissipation {R n U} UU {k_ k mu_ mu g h v} _ _ _ _ _.
Arguments codissipation {R n U} UU {k_ k mu_ g h} _ _ {a} _ _.
