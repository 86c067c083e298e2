#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a Coq file that proves what a planar `counterexample` certificate of stiction claims.

    make.py CERTIFICATE [-o FILE.v]

Static contacts only. After `./run prove`, `coqc -w none -R build/coq Stiction FILE.v` checks it. Nothing in the
certificate is trusted: Coq runs the algorithm itself, multiplies L D L', and tests the forces. The certificate's
pivots are not used, only its policies, starts and periods.
"""
import argparse
import itertools
import json
import sys
from collections import Counter
from fractions import Fraction
from pathlib import Path

SWITCHES = {  # in the order of Algorithm.policy and Loop.all_policies: the value in a certificate, and in Coq
    "scan": {"lowest": "lowest", "normals-first": "normals_first", "most-violated": "most_violated",
             "highest": "highest"},
    "resume": {"restart": "restart", "round": "round"},
    "admit": {"lazy": "lazy", "eager": "eager"},
    "file": {"no": "unfiled", "yes": "filed_at_scan"},
    "give-up": {"first": "first", "previous": "previous", "second": "second"},
    "drop": {"contact": "drop_contact", "variable": "drop_variable"},
    "rezero": {"rescan": "rescan", "continue": "continue"},
    "ties": {"sets": "by_sets", "contacts": "by_contacts"},
    "apex": {"kept": "kept", "suspended": "suspended_at_apex"},
}


def values(policy):
    """A value for every switch."""
    given = dict(part.split("=") for part in policy.split(",")) if policy != "paper" else {}
    assert set(given) <= set(SWITCHES), policy
    return tuple(given.get(switch, next(iter(names))) for switch, names in SWITCHES.items())


def number(x):
    x = Fraction(x)
    return f"({x.numerator} # {x.denominator})"


def vector(xs, number=number):
    return "[" + "; ".join(map(number, xs)) + "]"


def matrix(rows):
    return "[" + ";\n     ".join(map(vector, rows)) + "]"


def dense(A):
    if isinstance(A, list):
        return A
    entries = {(i, j): x for i, j, x in A["entries"]}
    return [[entries.get((i, j), entries.get((j, i), "0")) for j in range(A["size"])] for i in range(A["size"])]


def coq(certificate, source):
    assert certificate["claim"] == "counterexample", certificate["claim"]
    problem, witness = certificate["problem"], certificate["witness"]
    assert problem["dimension"] == 2 and all(c["kind"] == "static" for c in problem["contacts"]), "static, in the plane"
    A, n = dense(problem["A"]), len(problem["b"])
    table = {values(policy): (run["start"], run["period"]) for run in witness["runs"] for policy in run["policies"]}
    grid = list(itertools.product(*SWITCHES.values()))
    whole = set(table) == set(grid)
    listed = [policy for policy in grid if policy in table]
    groups = [(len(list(g)), key) for key, g in itertools.groupby(table[policy] for policy in listed)]
    policies = "all_policies" if whole else "policies"
    every, proof = ("forall pol,", "all_policies_complete pol") if whole else ("forall pol, In pol policies ->", "H")
    intro = "intro pol" if whole else "intros pol H"
    statement = f"  loops_under_every_policy {n} the_problem." if whole else f"""\
  well_formed the_problem /\\ symmetric {n} (A the_problem) /\\ positive_definite {n} (A the_problem) /\\
  (exists g, solution the_problem g) /\\
  ({every} forall k, exists x,
    drives the_problem pol k = Going x /\\ ~ solution the_problem (f (point_of x)))."""
    opened = "unfold loops_under_every_policy. " if whole else ""
    counts = sorted(Counter(table.values()).items(), key=lambda x: (-x[1], x[0]))
    lines = ["(* SPDX-License-Identifier: Apache-2.0 *)",
             f"(* Written by make.py from {source}.",
             "   It proves that the published algorithm never ends on the_problem under the policies listed, nor ever",
             "   stands at a solution, though A is definite and there is one. *)",
             "From Coq Require Import QArith ZArith List Bool Arith.",
             "From Stiction.loops Require Import Statement Loop Laws.",
             "Import ListNotations.", "Local Open Scope Q_scope.", "",
             f"Definition the_problem : problem rationals := Problem", f"    {matrix(A)}",
             f"    {vector(problem['b'])}", f"    {vector([c['mu'] for c in problem['contacts']])}.", "",
             "(* A = L D L' *)",
             f"Definition L := {matrix(witness['L'])}.", f"Definition D := {vector(witness['D'])}.", "",
             "(* a solution *)", f"Definition forces : list Q := {vector(witness['f'])}.", ""]
    if not whole:
        names = [" ".join(names[value] for names, value in zip(SWITCHES.values(), policy)) for policy in listed]
        lines += ["Definition policies : list policy := [", ";\n".join(f"  Policy {name}" for name in names) + "].", ""]
    lines += [f"(* (k, (start, period)) for k policies in a row, in the order of {policies} *)",
              "Definition table : list (nat * nat) := expand [", "  " + ";\n  ".join(
                  "; ".join(f"({k}, ({s}, {p}))" for k, (s, p) in groups[i:i + 7]) for i in range(0, len(groups), 7)) + "]%nat.",
              f"""
Lemma table_checked : table_holds the_problem {policies} table = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

(* The run under each policy: the state after k drives exists for all k. *)
Theorem never_ends : {every} forall k, exists x, drives the_problem pol k = Going x.
Proof. {intro}. exact (table_never_ends _ _ _ table_checked pol ({proof})). Qed.

Lemma is_well_formed : well_formed the_problem.
Proof. apply check_well_formed_sound. vm_compute. reflexivity. Qed.

(* No state between two drives is a solution. *)
Theorem never_at_a_solution : {every} forall k x, drives the_problem pol k = Going x ->
  ~ solution the_problem (f (point_of x)).
Proof.
  {intro}. intros k x Hx S. apply (obeys_iff_solution _ _ is_well_formed) in S.
  pose proof (table_never_obeys _ _ _ table_checked pol ({proof}) k x Hx). congruence.
Qed.

Theorem counterexample :
{statement}
Proof.
  {opened}split; [exact is_well_formed|].
  split; [apply check_symmetric_sound; vm_compute; reflexivity|].
  split; [apply (check_definite_sound _ _ L D); vm_compute; reflexivity|].
  split; [exists forces; apply (obeys_iff_solution _ _ is_well_formed); vm_compute; reflexivity|].
  {intro}. intro k. destruct (never_ends pol {'' if whole else 'H '}k) as [x Hx]. exists x.
  split; [exact Hx | exact (never_at_a_solution pol {'' if whole else 'H '}k x Hx)].
Qed.

(* The starts and periods, and how many policies have them:
   the first state at the top of the main loop that recurs. *)
Theorem starts_and_periods : forall pol s period, In (pol, (s, period)) (combine {policies} table) ->
  cycles the_problem pol s period.
Proof. exact (table_cycles _ _ _ table_checked). Qed.

Definition count s period := length (filter (fun x => Nat.eqb (fst x) s && Nat.eqb (snd x) period) table).
Theorem counts : length table = {len(listed)}%nat""" + "".join(
                  f" /\\\n  count {s} {p} = {k}%nat" for (s, p), k in counts) + """.
Proof. repeat split; vm_compute; reflexivity. Qed."""]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("certificate", type=Path)
    parser.add_argument("-o", "--output", type=Path, help="standard output otherwise")
    arguments = parser.parse_args()
    path, repository = arguments.certificate.resolve(), Path(__file__).resolve().parents[3]
    source = path.relative_to(repository) if path.is_relative_to(repository) else path.name
    text = coq(json.loads(path.read_text()), source)
    if arguments.output:
        arguments.output.write_text(text)
    else:
        sys.stdout.write(text)
