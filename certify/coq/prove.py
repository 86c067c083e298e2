#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compiles the proofs, says in words what they prove, and refuses what is not proved.

    prove.py [--build DIR] [--jobs N] [--family] [--compare] [--program PROGRAM [--every]]
    prove.py --scan | --accept | --unchanged

Refused are: a word that leaves something unproved (Admitted, Axiom, a Variable outside of a section, a switched-off
check); a theorem that does not state what its Statement.v states; an assumption that is not listed below; a file
that a reader must trust and that has changed since it was read (digests.json). --scan looks at the sources alone,
without Coq. --accept writes the digests, after somebody has read the files anew. --unchanged asks, without Coq,
whether the proofs were checked as they stand: a run with --program that passed, but for --family, which is of the
night, leaves their digest in PROVED.

Compiled is what has changed, in a copy of the sources. --family adds the family at mu = 1 under every policy (minutes
of processor time); --compare runs the Coq function, as a program, beside certify/check_runs.py and PROGRAM; --program
compiles what that stiction writes of the corpus (corpus.py), with --every under every policy. Before it answers, this
program refuses a few false proofs of its own, to see that it can.

Exit: 0 if all is proved, 1 if not, 2 if Coq is missing.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import textwrap
from pathlib import Path

sys.dont_write_bytecode = True
import corpus

HERE = Path(__file__).resolve().parent

# The three classical axioms of mathcomp-analysis, under the names that `Print Assumptions` gives them.
CLASSICAL = {
    "boolp.propositional_extensionality": "propositional extensionality",
    "boolp.functional_extensionality_dep": "functional extensionality",
    "boolp.constructive_indefinite_description": "indefinite description",
}

# Theorem, what it states (a definition of Statement.v), its axioms, the statement in words.
THEOREMS = [
    ("existence.Theorems.coulomb_solution_exists", "existence.Statement.coulomb_has_a_solution", CLASSICAL,
     "Space, Coulomb's circular cones: A symmetric positive semidefinite, b in range(A), mu >= 0: a solution exists."),
    ("existence.Theorems.coulomb_solution_exists_H", "existence.Statement.coulomb_has_a_solution_under_H", CLASSICAL,
     "The same under (H) alone: b.v >= 0 for all v in the cones with A v = 0."),
    ("existence.Theorems.scene_solution_exists", "existence.Statement.scenes_have_a_solution", CLASSICAL,
     "So every scene at rest, and every time step without penetration, has one: A = J W J', b = J W F + gaps >= 0."),
    ("existence.Theorems.coulomb_solution_bounded", "existence.Statement.coulomb_has_a_bounded_solution", CLASSICAL,
     "One C bounds the forces of some solution for all b in range(A) and all mu <= M: sum fN <= C sum abs(b)."),
    ("existence.Theorems.coulomb_solution_exists_nonsymmetric", "existence.Statement.coulomb_without_symmetry",
     CLASSICAL,
     "A positive semidefinite, not symmetric: a solution exists if b.v >= 0 for all solutions v for b = 0."),
    ("existence.Theorems.coulomb_solution_exists_definite", "existence.Statement.coulomb_definite", CLASSICAL,
     "A positive definite, not symmetric: a solution exists for every b."),
    ("existence.Theorems.polygon_solution_exists", "existence.Statement.polygons_have_a_solution", {},
     "Space, friction in one polygon, and (H) with its cones: a solution exists."),
    ("existence.Theorems.plane_solution_exists", "existence.Statement.plane_has_a_solution", {},
     "Plane: A symmetric positive semidefinite, b in range(A), mu >= 0: (15), (16) have a solution."),
    ("driving.Theorems.complete_driving_ends_in_a_solution", "driving.Statement.complete_driving_solves", {},
     "Complete driving, ties told by one symbolic perturbation, ends at a solution, after at most 4^n - 1 pieces: "
     "plane, A symmetric positive semidefinite, (H), mu >= 0."),
    ("driving.Theorems.no_piece_twice", "driving.Statement.no_piece_comes_twice", {},
     "On its way no piece comes twice."),
    ("driving.Theorems.plane_solution_exists_H", "driving.Statement.plane_has_a_solution_under_H", {},
     "So the plane has a solution under (H)."),
    ("driving.Theorems.complete_driving_definite", "driving.Statement.complete_driving_solves_definite", {},
     "A positive definite, not symmetric, b nondegenerate: it ends at a solution, after at most 4^n - 1 pieces."),
    ("driving.Theorems.complete_driving_semidefinite", "driving.Statement.complete_driving_solves_semidefinite", {},
     "A symmetric positive semidefinite, b nondegenerate with b.v > 0 for 0 /= v in K with A v = 0: the same."),
    ("driving.Theorems.no_piece_twice_without_ties", "driving.Statement.no_piece_comes_twice_without_ties", {},
     "In both no piece comes twice."),
    ("driving.Theorems.range_plus_dual_has_H", "driving.Statement.range_has_H", {},
     "Plane: (H) holds for b in range(A) + K*, K* the dual of the friction cones."),
    ("driving.PlanarLemke.planar_lemke", None, {},
     "Lemke's method, lexicographic, with any positive covering vector, solves the plane: b in range(A)."),
    ("driving.PlanarLemke.graded_lemke_ends_in_a_solution", None, {},
     "So it does with the graded covering vector of equivalence.md."),
    ("loops.Headline.counterexample", "loops.Statement.headline_loops", {},
     "The published algorithm never ends on cycle-every-policy-mu-1.json under any of the 1,536 policies, and never "
     "stands at a solution; A is symmetric positive definite, and a solution exists."),
    ("loops.Headline.starts_and_periods", None, {},
     "There each policy's loop has the start and the period that the table of Headline.v gives."),
    ("loops.Headline.counts", None, {},
     "So many policies have each start and period as Headline.v counts."),
    ("loops.SameLaw.same_law", None, {},
     "The law of loops/Statement.v is that of existence/Law.v, ..."),
    ("loops.SameLaw.same_solutions", None, {},
     "... and so are the solutions, of the problem as matrices over any ordered field; ..."),
    ("loops.SameLaw.same_symmetric", None, {},
     "... A is symmetric in the one if it is in the other, ..."),
    ("loops.SameLaw.same_definite", None, {},
     "... and positive definite, over the rationals of mathcomp."),
    ("loops.Counterexample.every_policy_loops", None, {},
     "So it is wherever Coq's check of a table of starts and periods, L, D and forces says so, ..."),
    ("loops.Counterexample.policies_loop", None, {},
     "... and under the policies of the table alone."),
    ("loops.Loop.all_policies_complete", "loops.Statement.policies_complete", {},
     "The list of policies has every value of the nine switches, ..."),
    ("loops.Loop.all_policies_counted", "loops.Statement.policies_counted", {},
     "... none twice: they are 1,536."),
    ("loops.Endless.endless_without_repetition", "loops.Statement.endless_run_without_repetition", {},
     "A run that never ends, and on which no state stands twice: endless/without-repetition.json, resume=round."),
    ("loops.Family.loops_near_K", "loops.Statement.paper_loops_near_K", {},
     "At mu = 1 the reading `paper` loops at condition numbers below any number above 3 + 2 sqrt(2)."),
    ("claims.Claims.solution_holds", None, {},
     "Plane and space, contacts of every kind: forces that Coq's check takes are a solution."),
    ("claims.Claims.coulomb_solution_holds", None, {},
     "Space: forces that it takes obey Coulomb's law up to a bound."),
    ("claims.Claims.no_solution_holds", None, {},
     "Farkas vectors that it takes refute every solution, over any ordered field."),
    ("claims.Claims.psd_holds", None, {},
     "A = L D L' that it takes: A is symmetric and positive semidefinite."),
    ("claims.Claims.H_holds", None, {},
     "A vector y that it takes: (H) holds for b."),
    ("claims.Tests.planar_law", None, {},
     "The law of these claims is, at a static contact of the plane, that of existence/Law.v; ..."),
    ("claims.Tests.coulomb_law", None, {},
     "... in space, up to the bound 1, it is that friction is at its limit, opposite to the acceleration of slip."),
]
FAMILY = ("loops.FamilyAll.loops_near_K_under_every_policy", "loops.Statement.every_policy_loops_near_K", {},
          "So does every policy.")

FOLDERS = {
    "existence": "Every problem with static friction has a solution; where nothing else is said A is symmetric "
                 "positive semidefinite and mu >= 0",
    "driving": "Complete driving ends; A and mu as above",
    "loops": "The published algorithm loops",
    "claims": "Certificates about A, b and forces",
}

# What a reader must trust: definitions and statements. A change is refused until somebody has read the file.
TRUSTED = ["existence/Law.v", "existence/Statement.v", "driving/Rational.v", "driving/Statement.v", "loops/Statement.v",
           "claims/Numbers.v", "claims/Statement.v"]
LONG = {"loops/FamilyA", "loops/FamilyB", "loops/FamilyAll"}
APART = {"loops/Extract"}

FORBIDDEN = [
    (re.compile(r"\b(Admitted|Admit\s+Obligations|Axioms?|Parameters?|Conjectures?|bypass_check)\b"),
     "leaves something unproved"),
    (re.compile(r"\b(admit|give_up)\s*[.;|\])]"), "leaves something unproved"),
    (re.compile(r"\b(Unset|Set)\s+(Guard|Positivity|Universe)\s+Checking\b|\btype-in-type\b"), "switches a check off"),
    (re.compile(r"\bExtract\s+(Inlined\s+)?(Constant|Inductive)\b"), "replaces a definition in the program"),
    (re.compile(r"\b(Declare\s+ML\s+Module|Load|Redirect|Drop)\b"), "is no part of a proof"),
]

SCOPES = re.compile(r"(?m)(?:^|(?<=\.\s))\s*(Section|Module|End|Variables?|Hypothes[ie]s|Context)\b\s*(\w*)")


def without_comments(text):
    """The text with comments and strings blanked; lines stay."""
    out, depth, i, string = [], 0, 0, False
    while i < len(text):
        two = text[i:i + 2]
        if string:
            string = text[i] != '"'
            out.append("\n" if text[i] == "\n" else " ")
            i += 1
        elif text[i] == '"':
            string = True
            out.append(" ")
            i += 1
        elif two == "(*":
            depth += 1
            out.append("  ")
            i += 2
        elif two == "*)" and depth:
            depth -= 1
            out.append("  ")
            i += 2
        else:
            out.append(text[i] if not depth or text[i] == "\n" else " ")
            i += 1
    return "".join(out)


def scan(sources):
    """What in the sources is refused, a line each."""
    found = []
    for path in sorted(sources.rglob("*.v")):
        name = path.relative_to(sources)
        raw = path.read_text()
        if not raw.startswith("(* SPDX-License-Identifier: Apache-2.0 *)\n(* "):
            found.append(f"{name}:1: has no head that says what it proves")
        text = without_comments(raw)
        for pattern, why in FORBIDDEN:
            for m in pattern.finditer(text):
                found.append(f"{name}:{text.count(chr(10), 0, m.start()) + 1}: `{m[0]}` {why}")
        open_ = []
        for m in SCOPES.finditer(text):
            word, line = m[1], text.count("\n", 0, m.start(1)) + 1
            if word in ("Section", "Module"):
                open_.append((word, m[2]))
            elif word == "End":
                if open_:
                    open_.pop()
            elif not any(kind == "Section" for kind, _ in open_):
                found.append(f"{name}:{line}: `{word}` outside of a section leaves something unproved")
    try:
        digests = json.loads((sources / "digests.json").read_text())
    except FileNotFoundError:
        digests = {}
    for name in TRUSTED:
        path = sources / name
        if not path.exists():
            found.append(f"{name}: is missing")
            continue
        for need in imports(without_comments(path.read_text())):
            if f"{need}.v" not in TRUSTED:
                found.append(f"{name}: must be read to be trusted, and imports {need}.v, which is not")
        if digests.get(name) != hashlib.sha256(path.read_bytes()).hexdigest():
            found.append(f"{name}: has changed since it was read; read it, then call prove.py --accept")
    return found


def imports(text):
    lines = re.finditer(r"From Stiction\.(\w+) Require (?:Import |Export )?([\w\s]+?)\s*\.", text)
    return [f"{m[1]}/{name}" for m in lines for name in m[2].split()]


def digest_of(sources):
    """Of all that decides whether the proofs pass: what is here, and what writes the text of a claim. Not of what the
    program says of the corpus, which the night looks at."""
    files = [path for path in sources.rglob("*") if path.suffix in (".v", ".py", ".ml", ".json")]
    files += (sources.parent / "claims").glob("coq_text.*")
    lines = (f"{path.relative_to(sources.parent)} {hashlib.sha256(path.read_bytes()).hexdigest()}" for path in sorted(files))
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()


def is_proved(sources):
    proved = sources / "PROVED"
    return proved.exists() and proved.read_text().strip() == digest_of(sources)


class Failed(Exception):
    pass


class Build:
    """A copy of the sources, compiled. A file is compiled anew if it, one it needs, or Coq is another."""

    def __init__(self, sources, build, jobs, version):
        self.sources, self.build, self.jobs = sources, build, jobs
        self.text = {str(p.relative_to(sources).with_suffix("")): p.read_text() for p in sources.rglob("*.v")}
        self.needs = {name: imports(without_comments(text)) for name, text in self.text.items()}
        self.keys = {}
        self.version = version

    def key(self, name):
        if name not in self.keys:
            if name not in self.text:
                raise Failed(f"{name}.v is imported, but is not there")
            self.keys[name] = None  # a ring would be refused here
            parts = [self.version, self.text[name]]
            for need in self.needs[name]:
                key = self.key(need)
                if key is None:
                    raise Failed(f"{name}.v and {need}.v import one another")
                parts.append(key)
            self.keys[name] = hashlib.sha256("\0".join(parts).encode()).hexdigest()
        return self.keys[name]

    def wanted(self, roots):
        """What the roots need, and they, each after what it needs."""
        order = []

        def visit(name):
            if name not in order:
                self.key(name)
                for need in self.needs[name]:
                    visit(need)
                order.append(name)
        for root in roots:
            visit(root)
        return order

    def coqc(self, path, *, cwd=None):
        command = ["coqc", "-q", "-w", "none", "-R", str(self.build), "Stiction", str(path)]
        return subprocess.run(command, cwd=cwd or self.build, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)

    def is_there(self, name):
        stamp = self.build / f"{name}.key"
        return ((self.build / f"{name}.vo").exists() and stamp.exists() and stamp.read_text() == self.key(name))

    def compile_one(self, name):
        target = self.build / f"{name}.v"
        target.parent.mkdir(parents=True, exist_ok=True)
        stamp = target.with_suffix(".key")
        stamp.unlink(missing_ok=True)
        target.write_text(self.text[name])
        result = self.coqc(target)
        if result.returncode:
            raise Failed(f"{name}.v is refused by Coq:\n{result.stdout.replace(str(self.build), str(self.sources))}")
        stamp.write_text(self.key(name))
        return name

    def compile(self, roots, *, quiet=False):
        order = self.wanted(roots)
        todo = [name for name in order if not self.is_there(name)]
        if not todo:
            return
        if not quiet:
            print(f"prove: {len(todo)} of {len(order)} files to compile", file=sys.stderr, flush=True)
        done, running = set(order) - set(todo), {}
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            waiting = list(todo)
            failed = None
            while waiting or running:
                for name in [] if failed else list(waiting):
                    if all(need in done for need in self.needs[name]):
                        waiting.remove(name)
                        running[pool.submit(self.compile_one, name)] = name
                if not running:
                    break
                finished, _ = concurrent.futures.wait(running, return_when=concurrent.futures.FIRST_COMPLETED)
                for future in finished:
                    name = running.pop(future)
                    if future.exception():
                        failed = failed or future.exception()
                    else:
                        done.add(name)
                        if not quiet:
                            print(f"prove: {name}.v ({len(done)} of {len(order)})", file=sys.stderr, flush=True)
            if failed:
                raise failed


def check(build, theorems):
    """Asks Coq of every theorem whether it has its statement, and what it assumes."""
    modules = sorted({".".join(name.split(".")[:2]) for row in theorems for name in row[:2] if name})
    lines = [f"From Stiction Require {' '.join(modules)}."]
    for theorem, statement, _, _ in theorems:
        lines.append(f'Goal True. idtac "@theorem {theorem}". Abort.')
        if statement:
            lines.append(f"Definition checked_{len(lines)} : Stiction.{statement} := @Stiction.{theorem}.")
        lines.append(f"Print Assumptions Stiction.{theorem}.")
    path = build.build / "Check.v"
    path.write_text("\n".join(lines) + "\n")
    result = build.coqc(path)
    if result.returncode:
        raise Failed(f"a theorem is not there, or has another statement:\n{result.stdout}")
    parts = re.split(r"(?m)^@theorem (\S+)\n", result.stdout)[1:]
    found = dict(zip(parts[::2], parts[1::2]))
    bad, answers = [], []
    for theorem, _, allowed, words in theorems:
        said = found.get(theorem, "")
        if "Closed under the global context" in said:
            assumed = set()
        elif said.lstrip().startswith("Axioms:"):
            assumed = set(re.findall(r"(?m)^([\w.']+)\s*:(?!=)", said.split("Axioms:", 1)[1]))
            assumed |= set(re.findall(r"(?m)^([\w.']+) (?:relies on|is assumed) .*$", said))
        else:
            bad.append(f"{theorem}: Coq's answer is not understood:\n{said}")
            continue
        bad += [f"{theorem}: assumes {axiom}, which is not listed" for axiom in sorted(assumed - set(allowed))]
        answers.append((theorem, words, assumed))
    if bad:
        raise Failed("\n".join(bad))
    return answers


def tell(answers):
    before = None
    for theorem, words, assumed in answers:
        folder, file, name = theorem.split(".")
        if folder != before:
            print("\n" * bool(before) + f"{FOLDERS[folder]} (certify/coq/{folder}):")
        before = folder
        print(textwrap.fill(words, 110, initial_indent="  ", subsequent_indent="  "))
        axioms = "the three classical ones" if assumed == set(CLASSICAL) else ", ".join(sorted(assumed)) or "none"
        print(f"    {file}.v, {name}; axioms: {axioms}")
    if any(assumed for _, _, assumed in answers):
        print(f"\nThe three classical axioms are those of mathcomp-analysis: {', '.join(CLASSICAL.values())}.")
    print()


# Proofs of a small statement: one that is right; and false ones, with what must be said of each.
STATEMENT = "forall n : nat, n < 0 \\/ n = 0 \\/ 0 < n"
SELF_TESTS = [
    ("Require Import PeanoNat.\nTheorem t : {}.\nProof. intro n. apply Nat.lt_trichotomy. Qed.", None),
    ("Theorem t : forall n : nat, n = n.\nProof. reflexivity. Qed.", "has another statement"),
    ("Axiom a : {}.\nTheorem t : {}.\nProof. exact a. Qed.", "assumes .*, which is not listed"),
    ("Theorem t : {}.\nProof. Admitted.", "assumes .*, which is not listed"),
    ("Unset Guard Checking.\nFixpoint f (n : nat) : n < 0 \\/ n = 0 \\/ 0 < n := f n.\nSet Guard Checking.\n"
     "Theorem t : {}.\nProof. exact f. Qed.", "assumes .*, which is not listed"),
    ("Theorem t : {}.\nProof. intro n. left. auto. Qed.", "is refused by Coq"),
]


def self_test(version):
    """The checks after the scan, on small proofs: one is accepted, each of the others refused."""
    for number, (text, expected) in enumerate(SELF_TESTS):
        with tempfile.TemporaryDirectory() as folder:
            sources, build = Path(folder) / "sources", Path(folder) / "build"
            (sources / "small").mkdir(parents=True)
            build.mkdir()
            (sources / "small/Statement.v").write_text(f"Definition small := {STATEMENT}.\n")
            (sources / "small/Theorems.v").write_text(text.replace("{}", STATEMENT) + "\n")
            said = None
            try:
                made = Build(sources, build, 1, version)
                made.compile(["small/Statement", "small/Theorems"], quiet=True)
                check(made, [("small.Theorems.t", "small.Statement.small", {}, "")])
            except Failed as error:
                said = str(error)
            if (said is None) != (expected is None) or (expected and not re.search(expected, said)):
                raise Failed(f"this program does not refuse what it must: false proof {number}: {said}")


def compare(build, repository, policies, program, problems):
    """The Coq function as a program, step by step beside certify/check_runs.py, and beside the C++."""
    folder = build.build / "compare"
    folder.mkdir(exist_ok=True)
    for name in ("Extract.v", "run.ml"):
        shutil.copy(build.sources / "loops" / name, folder)
    build.compile(["loops/Statement", "loops/Loop"])
    result = build.coqc(folder / "Extract.v", cwd=folder)
    if result.returncode:
        raise Failed(f"Extract.v is refused by Coq:\n{result.stdout}")
    result = subprocess.run(["ocamlfind", "ocamlopt", "-w", "-a", "-package", "zarith", "-linkpkg", "algorithm.mli",
                             "algorithm.ml", "run.ml", "-o", "run"], cwd=folder, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True)
    if result.returncode:
        raise Failed(f"the extracted function does not compile:\n{result.stdout}")
    command = ["/usr/bin/python3", str(build.sources / "loops" / "compare.py"), str(folder / "run")]  # has numpy
    files = sorted(map(str, (repository / "corpus").glob("*.json")))
    others = [("certify/check_runs.py", [], [])]
    if program:
        package = program.parent / "python" / "package"
        if not list(package.glob("stiction/_stiction*.so")):
            raise Failed(f"--compare needs {package}, which is not built: ./run python -c '' builds it")
        others.append(("the C++", ["--package", str(package)], ["--problems", str(problems)]))
    for other, words, more in others:
        print(f"The Coq function beside {other}, step by step:", flush=True)
        if subprocess.run([*command, *words, *more, "--policies", str(policies), *files]).returncode:
            raise Failed(f"the Coq function and {other} differ")
        flawed = [*command, *words, "--policies", "40", "--flaw", str(repository / "corpus/two-contact-cycle.json")]
        if subprocess.run(flawed, stdout=subprocess.DEVNULL).returncode != 1:
            raise Failed(f"compare.py does not notice that {other} is wrong")


def tell_corpus(build, program, repository, every):
    """What certify --coq writes of the corpus is proved, and what is altered is not."""
    try:
        counts = corpus.compile_corpus(build, program, repository, every)
        altered = corpus.refuses_altered(build, program, repository, every)
    except RuntimeError as error:
        raise Failed(str(error))
    words = ", ".join(f"{count} of {claim}" for claim, count in sorted(counts.items()))
    print(f"Of the corpus Coq takes what certify --coq writes: {words}; no axioms. Altered and refused: {altered}.\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--sources", type=Path, default=HERE, help=argparse.SUPPRESS)
    parser.add_argument("--build", type=Path, default=HERE.parents[1] / "build" / "coq")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--family", action="store_true", help="also the family at mu = 1 under every policy")
    parser.add_argument("--compare", action="store_true", help="also the Coq function beside check_runs.py and PROGRAM")
    parser.add_argument("--policies", type=int, default=5, help="of each file that --compare runs")
    parser.add_argument("--problems", type=int, default=10000, help="random ones that --compare gives to PROGRAM")
    parser.add_argument("--program", type=Path, help="also what this stiction writes of the corpus")
    parser.add_argument("--every", action="store_true", help="of --program: loops under every policy")
    parser.add_argument("--scan", action="store_true", help="only look at the sources")
    parser.add_argument("--accept", action="store_true", help="write the digests of what a reader must trust")
    parser.add_argument("--unchanged", action="store_true", help="whether these proofs were checked: exit 0 if so")
    parser.add_argument("--only", help=argparse.SUPPRESS)  # of the theorems, those of this folder: for tests
    o = parser.parse_args()
    o.sources, o.build = o.sources.resolve(), o.build.resolve()
    repository = HERE.parents[1]
    if o.accept:
        digests = {name: hashlib.sha256((o.sources / name).read_bytes()).hexdigest() for name in TRUSTED}
        (o.sources / "digests.json").write_text(json.dumps(digests, indent=2) + "\n")
        return 0
    if o.unchanged:
        proved = is_proved(o.sources)
        print("prove: the proofs were checked as they stand: certify/coq/PROVED has their digest" if proved else
              "prove: the proofs are not those of certify/coq/PROVED")
        return 0 if proved else 1
    try:
        found = scan(o.sources)
        if found:
            raise Failed("\n".join(found))
        if o.scan:
            print("prove: nothing in the sources leaves anything unproved")
            return 0
        if not shutil.which("coqc"):
            print("prove: coqc is not installed", file=sys.stderr)
            return 2
        version = subprocess.run(["coqc", "--version"], stdout=subprocess.PIPE, text=True).stdout
        o.build.mkdir(parents=True, exist_ok=True)
        build = Build(o.sources, o.build, max(1, o.jobs), version)
        theorems = THEOREMS + ([FAMILY] if o.family else [])
        theorems = [row for row in theorems if not o.only or row[0].startswith(o.only + ".")]
        roots = [name for name in sorted(build.text) if name not in APART and (o.family or name not in LONG)
                 and (not o.only or name.startswith(o.only + "/"))]
        self_test(version)
        build.compile(roots)
        answers = check(build, theorems)
        tell(answers)
        if o.program:
            tell_corpus(build, o.program.resolve(), repository, o.every)
        if o.compare:
            compare(build, repository, o.policies, o.program and o.program.resolve(), o.problems)
    except Failed as error:
        print(f"prove: failed: {error}", file=sys.stderr)
        return 1
    if o.program and not o.only and not o.family:  # which the night asks for: it changes no file that Git has
        (o.sources / "PROVED").write_text(digest_of(o.sources) + "\n")
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"prove: all {len(theorems)} theorems are proved; {used.ru_utime + used.ru_stime:.0f} s of processor time")
    return 0


if __name__ == "__main__":
    sys.exit(main())
