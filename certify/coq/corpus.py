# SPDX-License-Identifier: Apache-2.0
"""What `stiction certify --coq` writes of the corpus, compiled; for prove.py.

Of every problem file: whether there is a solution (in space by both laws), psd, h, and in the plane a loop of the
published algorithm: under `paper`, or with `every` under all policies at once, where some cycle. What a problem has no
certificate of is passed over. Coq is called once for many files, each a module of its own, since loading the library
takes longer than most proofs. Then some certificates are altered, and Coq must refuse them.
"""
import concurrent.futures
import re
import subprocess
from collections import Counter

FOLDERS = ["corpus", "corpus/sliding", "corpus/endless", "corpus/space", "corpus/space/critical"]
CLAIMS = [["--claim", "existence"], ["--claim", "psd"], ["--claim", "h"]]
LIMITS = ["--max-drives", "200"]  # of a run: the corpus has some that never recur
# Why certify refuses a problem that has no such certificate; anything else is an error.
NONE = ("expected with --coq one of", "expected static", "stated for", "is not symmetric", "no checker would take")
CLOSED = "Closed under the global context"

# A file of the corpus, what is asked of it, a text of what is written then, and what takes its place: Coq refuses that.
ALTERED = [
    ("corpus/two-contact-cycle.json", [], "Definition forces : list Q := [1;", "Definition forces : list Q := [2;"),
    ("corpus/two-contact-cycle.json", ["--claim", "psd"], "18 # 29]", "17 # 29]"),
    ("corpus/space/three-sliding-contacts.json", [], "Definition bound : Q := ", "Definition bound : Q := 1 + "),
    ("corpus/no-solution-scripted-wedge.json", [], "([Break], [1; 0])", "([Break], [0; 1])"),
    ("corpus/two-contact-cycle.json", ["--claim", "h"], "Definition y : list Q := [", "Definition y : list Q := [-9; "),
    ("corpus/two-contact-cycle.json", ["--claim", "counterexample"], "(1, (3, 4))", "(1, (2, 4))"),
]


def written(program, repository, path, words):
    """The text that certify --coq writes, or nothing where the problem has no such certificate."""
    done = subprocess.run([program, "certify", path, *words, "--coq", "-o", "-"], cwd=repository,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    reason = " ".join(done.stderr.split())
    if done.returncode not in (0, 1, 3) and not (done.returncode == 2 and any(why in reason for why in NONE)):
        raise RuntimeError(f"{path}: certify {' '.join(words)} ends with {done.returncode}: {done.stderr}")
    return done.stdout


def batches(texts, number):
    """(number, text) in so many parts, the longest texts first."""
    parts = [[] for _ in range(number)]
    for k, text in enumerate(sorted(texts, key=lambda row: -len(row[1]))):
        parts[k % number].append(text)
    return [part for part in parts if part]


def as_modules(texts):
    """A file of them all, which asks once for the axioms of all claims: that takes Coq a while."""
    asks = re.compile(r"Print Assumptions (\w+)\.\n")
    modules = "".join(f"(* {name} *)\nModule File{k}.\n{asks.sub('', text)}End File{k}.\n"
                      for k, (name, text) in enumerate(texts))
    claims = ", ".join(f"File{k}.{asks.search(text)[1]}" for k, (_, text) in enumerate(texts))
    return f"{modules}Definition all_claims := ({claims}, tt).\nPrint Assumptions all_claims.\n"


def compile_batch(build, name, texts):
    """None, or what Coq has against one of the texts."""
    path = build.build / "corpus" / f"{name}.v"
    path.parent.mkdir(exist_ok=True)
    path.write_text(as_modules(texts))
    result = build.coqc(path)
    if result.returncode:
        line = re.search(r"line (\d+)", result.stdout)
        before = path.read_text().splitlines()[:int(line[1]) if line else 0]
        at = [found[1] for found in map(re.compile(r"\(\* (corpus/.*) \*\)").fullmatch, before) if found]
        return f"{at[-1] if at else name}: Coq refuses what certify --coq writes:\n{result.stdout}"
    if CLOSED not in result.stdout:
        return f"{name}: rests on axioms:\n{result.stdout}"
    return None


def compile_corpus(build, program, repository, every):
    """How many certificates of each claim Coq has taken; or RuntimeError that says which it has not."""
    build.compile(["claims/Claims", "loops/Counterexample"])
    texts, policy = [], "*" if every else "paper"
    for folder in FOLDERS:
        for path in sorted((repository / folder).glob("*.json")):
            name = str(path.relative_to(repository))
            in_space = "space" in folder
            asked = [*CLAIMS, ["--claim", "existence", "--law", "baraff"] if in_space else
                     ["--claim", "counterexample", "--policy", policy, *LIMITS]]
            for words in asked:
                text = written(program, repository, name, words)
                if text:
                    texts.append((f"{name} {words[1]}", text))
    parts = batches(texts, max(build.jobs, 4 if every else 1))
    with concurrent.futures.ThreadPoolExecutor(build.jobs) as pool:
        said = list(pool.map(lambda row: compile_batch(build, f"Part{row[0]}", row[1]), enumerate(parts)))
    bad = [text for text in said if text]
    if bad or not texts:
        raise RuntimeError("\n".join(bad) or "the corpus has no certificate for Coq")
    return Counter(name.split()[1] for name, _ in texts)


def refuses_altered(build, program, repository, every):
    """Altered certificates: one of them, or all. RuntimeError for one that Coq takes."""
    rows = ALTERED if every else ALTERED[:1]
    for k, (path, words, old, new) in enumerate(rows):
        text = written(program, repository, path, words)
        if text.count(old) != 1:
            raise RuntimeError(f"{path} {' '.join(words)}: `{old}` is not there to be altered")
        said = compile_batch(build, f"Altered{k}", [(path, text.replace(old, new))])
        if said is None or "refuses" not in said:
            raise RuntimeError(f"{path} {' '.join(words)}: Coq takes an altered certificate: {said}")
    return len(rows)
