(* SPDX-License-Identifier: Apache-2.0 *)
(* Proves that along every run over Q a = A f + b.
   So the state is the sets, the forces, and what the policy remembers. *)
From Coq Require Import QArith List Bool Arith Lia Lqa.
From Stiction.loops Require Import Statement Loop Laws.
Import ListNotations.
Local Open Scope Q_scope.

Section Invariant.

Variables (p : problem rationals) (pol : policy).
Hypothesis W : well_formed p.

Definition ok (s : point rationals) := length (f s) = length (b p) /\ Forall2 Qeq (a s) (accelerations p (f s)).
Definition same_numbers (s u : point rationals) := f u = f s /\ a u = a s.

Lemma ok_same s u : same_numbers s u -> ok s -> ok u.
Proof. intros [Hf Ha]. unfold ok. now rewrite Hf, Ha. Qed.

Lemma axpy_length (c : rationals) (x y : list rationals) : length (axpy c x y) = Nat.min (length x) (length y).
Proof. unfold axpy. rewrite map_length, combine_length. reflexivity. Qed.

Lemma dot_axpy t : forall (r x y : list Q), length x = length y ->
  (dot r (axpy t x y) : Q) == dot r x + t * dot r y.
Proof.
  assert (cons : forall (u v : Q) r x, (@dot rationals (u :: r) (v :: x) : Q) = Qred (Qred (u * v) + dot r x))
    by reflexivity.
  assert (acons : forall (u v : Q) x y, @axpy rationals t (u :: x) (v :: y) = Qred (u + Qred (t * v)) :: axpy t x y)
    by reflexivity.
  induction r as [|u r IH]; intros [|v x] [|w y] L; try discriminate; try (unfold dot; simpl; ring).
  rewrite acons, !cons, !Qred_correct, IH by (simpl in L; lia). ring.
Qed.

Lemma accelerations_axpy t (x y z : list Q) : length x = length y -> Forall2 Qeq z (accelerations p x) ->
  Forall2 Qeq (axpy t z (times p y)) (accelerations p (axpy t x y)).
Proof.
  intro L. unfold accelerations, times. revert z. generalize (b p) as c.
  induction (A p) as [|r M IH]; intros [|d c] z H;
  cbn [map combine] in H |- *; inversion H as [|v w z' l' Hv Hz]; subst; try constructor.
  - change (Qred (v + Qred (t * dot r y)) == Qred (@dot rationals r (axpy t x y) + d)).
    change (v == Qred (dot r x + d)) in Hv.
    rewrite !Qred_correct, dot_axpy by exact L. rewrite Qred_correct in Hv. rewrite Hv. ring.
  - apply IH. exact Hz.
Qed.

Lemma enter_same i Y (m : @inner rationals) : same_numbers (here m) (here (enter i Y m)).
Proof. unfold enter. destruct (set_beq _ _); split; reflexivity. Qed.
Lemma same_trans s u v : same_numbers s u -> same_numbers u v -> same_numbers s v.
Proof. unfold same_numbers. intros [-> ->] [-> ->]. now split. Qed.
Lemma move_same d j Y z (m : @inner rationals) : same_numbers (here m) (here (move pol d j Y z m)).
Proof.
  assert (two : forall i Y k Z, same_numbers (here m) (here (enter k Z (enter i Y m))))
    by (intros; eapply same_trans; apply enter_same).
  unfold move. destruct (wants_back m j Y && _).
  - destruct (is_normal j && _ && _); [apply two | apply enter_same].
  - destruct (is_normal j); [|apply enter_same].
    set (X := set_of (here (enter j Y m)) (friction_of j)). clearbody X.
    destruct Y, X, (apex pol); try apply enter_same; apply two.
Qed.

Lemma unit_change_length s i : length (unit_change p s i) = length (b p).
Proof. unfold unit_change, rows. now rewrite map_length, seq_length. Qed.
Lemma combination_length n : forall (c : list rationals) (vs : list (list rationals)),
  (forall v, In v vs -> length v = n) ->
  length (combination n c vs) = n.
Proof.
  intros c vs. unfold combination.
  assert (G : forall start : list rationals, length start = n -> (forall v, In v vs -> length v = n) ->
            length (fold_left (fun v cx => @axpy rationals (fst cx) v (snd cx)) (combine c vs) start) = n).
  { revert c. induction vs as [|w vs IH]; intros [|x c] start L H; try exact L. simpl. apply IH.
    - rewrite axpy_length, L. cbn [snd]. rewrite (H w) by now left. apply Nat.min_id.
    - intros v Hv. apply H. now right. }
  intro H. apply G; [apply repeat_length | exact H].
Qed.
Lemma direction_length s d rate df : direction p s d rate = Some df -> length df = length (b p).
Proof.
  unfold direction. destruct (solve _ _); [|discriminate]. intro H. injection H as <-.
  rewrite axpy_length, map_length, unit_change_length, combination_length; [apply Nat.min_id|].
  intros v Hv. apply in_map_iff in Hv as [i [<- _]]. apply unit_change_length.
Qed.

Lemma take_step_ok d g m m' pv : ok (here m) -> take_step p pol d g m = Going (m', pv) -> ok (here m').
Proof.
  intros [L H]. unfold take_step. destruct (direction _ _ _ _) as [df|] eqn:D; [|discriminate].
  destruct (maxstep _ _ _ _ _ _ _) as [l|]; [|discriminate]. intro E. injection E as <- _. cbn [here].
  eapply ok_same; [apply move_same|]. cbn [here]. pose proof (direction_length _ _ _ _ D) as Ld. split; cbn [f a].
  - rewrite axpy_length, L, Ld. apply Nat.min_id.
  - apply accelerations_axpy; [exact (eq_trans L (eq_sym Ld)) | exact H].
Qed.

Lemma steps_ok d g : forall n m s, ok (here m) -> snd (steps n p pol d g m) = Going s -> ok s.
Proof.
  induction n as [|n IH]; intros m s H E; simpl in E; [discriminate|].
  destruct (take_step p pol d g m) as [[m' pv]|e] eqn:T; [|discriminate].
  pose proof (take_step_ok d g m m' pv H T) as H'. destruct (Nat.eqb _ _).
  - injection E as <-. exact H'.
  - specialize (IH m' s H'). destruct (steps n p pol d g m') as [pvs r]. exact (IH E).
Qed.

Lemma drive_from_ok d g s x : ok s -> snd (drive_from p pol d g s) = Going x -> ok (point_of x).
Proof.
  intro H. unfold drive_from, drive. set (m := if is_normal d && _ then _ else _).
  assert (Hm : ok (here m)).
  { unfold m. destruct (is_normal d && _); [|exact H]. eapply ok_same; [apply enter_same | exact H]. }
  pose proof (steps_ok d g most_steps m) as G.
  destruct (steps most_steps p pol d g m) as [pvs [s'|e]]; intro E; [|discriminate].
  injection E as <-. exact (G s' Hm eq_refl).
Qed.

Lemma sweep_ok s : ok s -> ok (sweep p pol s).
Proof.
  unfold sweep. generalize (rows p) as is. intro is. revert s. induction is as [|i is IH]; intros s H; [exact H|].
  simpl. apply IH. eapply ok_same; [|exact H]. unfold sweep_row, same_numbers.
  repeat match goal with |- context [if ?c then _ else _] => destruct c
    | |- context [match ?c with _ => _ end] => destruct c end;
  split; reflexivity.
Qed.

Lemma next_ok x y : ok (point_of x) -> next p pol x = Going y -> ok (point_of y).
Proof.
  intro H. unfold next, next_with_pivots. destruct (next_driven x) as [d|]; [apply drive_from_ok, H|].
  destruct (find_violated _ _ _ _) as [d|]; [|discriminate]. apply drive_from_ok, sweep_ok, H.
Qed.

Theorem drives_ok k : forall x, drives p pol k = Going x -> ok (point_of x).
Proof.
  induction k as [|k IH]; simpl; intros x E.
  - injection E as <-. destruct W as [_ [WA _]]. split; simpl; [apply repeat_length|].
    unfold accelerations, times.
    assert (zero : forall (r : list Q) n, (@dot rationals r (repeat (0 : Q) n) : Q) == 0).
    { induction r as [|u r IH]; intros [|n]; try reflexivity.
      change (Qred (Qred (u * 0) + @dot rationals r (repeat (0 : Q) n)) == 0). rewrite !Qred_correct, IH. ring. }
    assert (G : forall n (M : list (list rationals)) (c : list rationals), length M = length c ->
              Forall2 Qeq c (map (fun rb : Q * Q => Qred (fst rb + snd rb))
                                 (combine (map (fun r => dot r (repeat (0 : Q) n)) M) c))).
    { intros n. induction M as [|r M IH]; intros [|d c] L; try discriminate; cbn [map combine]; constructor.
      - cbn [fst snd]. rewrite Qred_correct, zero. symmetry. apply Qplus_0_l.
      - apply IH. now injection L. }
    exact (G _ _ _ WA).
  - destruct (drives p pol k) as [y|e] eqn:D; [|discriminate]. exact (next_ok y x (IH y eq_refl) E).
Qed.

End Invariant.
