#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How simple the sources are, as numbers: what each is, and the bar that it must not pass.

    bars.py [BUILD] [--list] [--against COMMIT]

BUILD (build/release) is asked for the processor time of its compilations. --list names the places of what is counted by
rule: what to mend. --against compiles the program of COMMIT, of the whole clone, and that of this tree, one after the
other and from nothing, in build/against: seconds of one machine in one hour can be compared, others cannot.

Lines are those of files, blank ones and comments among them; those that the commits of the recipes and of FEATURES added
are not counted, and the latter said. The product is what a user runs: tests, and the peers that bench measures, are not in it.
Rules look at what sources do, so that a new name lowers no count:

  type            what stands behind struct, class, enum and union
  problem type    a type that has contacts and numbers, or A and b; or half of whose members are problems, two at least:
                  forms of one; not those of the C interfaces
  cascade         a source in which a method is compared with `auto`, or a function calls solving ones and goes on to
                  another where an answer is not solved, unless it hands them to the one loop of solver/in_turn.h;
                  certify/request is one, and solver/solve.ipp has its table
  options         of solving: types of solver, scene and certify with Options in their name, or with a member of the types
                  Limits or Tolerances
  judge           a source with a function of a problem and forces that says how wrong they are, by the law of friction,
                  and calls no judge of another source; in a Python checker, a function that multiplies mu by a
                  force and looks at accelerations
  generated file  GENERATED; commits since FIRST, the later half

A recipe of CONTRIBUTING.md names a commit that follows it. Where something cannot be known, as in a clone without history
or a build that noted nothing, it is "unknown". Exit 1 if a bar is passed."""

import argparse
import ast
import csv
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FIRST = "ab35161f"  # with 93,719 lines of product, 817 types
PRODUCT = ("bench", "certify", "cli", "corpus", "python", "reports", "scene", "search", "solver")
CODE = (".h", ".ipp", ".cpp", ".py", ".pyi", ".js", ".mjs")
TEXT = (".txt", ".in", "words.json")  # with places that code fills in, or read as tables
RECIPES = {"method": 4, "generator": 3, "claim": 5, "verb": 3, "field": 3}  # files that its commit touches, at most
FEATURES = {  # that came later: their commits, and the most lines that they may have cost
    "impacts": ("eaeb8eaf 38bca15b f30ea018 c3ed82e3 27b1a8ce 590fb9bf 29f85f8d 816e72b3 ed028206 da2bdbb1 6e914fae "
                "e700cec5 0709d1c3 6e9b9dba f42f2d13", 800),
    "rest without rationals": ("4845d61a 7142f02a", 60),
    "names in pages, checked": ("c67bc00d", 20),
    "paths that turn back": ("6f8cc96f 739bc4ff 6e1d3dcd aff9b16b 62771392 "
                             "b6194a2e 16cd3717 249738e6 45197b8c", 200),
    "suspicions told by balls": ("84438361", 140),
    "lifting, and a stop everywhere": ("d199f604 06783930 427eac08 25c5070a", 400),
    "suspicions, sooner": ("77847fc4 33c8a7cf c07c58fe", 130),
    "campaigns, sooner": ("9014a670 4d13d672 abeb7739 ddb0b1e9 033c56c8 46ebeb27", 130),
    "bench of scenes in motion": ("73f825cd 3fd69fbf 9b10ba86", 405),
    "certificates from factors": ("1b08c91f", 400)}
JSON_HEADERS = ("nlohmann/json.hpp",)
GENERATED = re.compile(r"reports/(examples|web/dist|web/solver)/|.*\.(svg|png|pdf|wasm)(\.gz)?$")
PROOFS = ("certify/condition_number.md", "certify/coq/README.md", "certify/existence.md", "certify/related_work.md",
          "certify/where_loops_begin.md", "search/adversary/frontiers.md", "solver/complete/complete_driving.md",
          "solver/complete/equivalence.md", "solver/published/mending.md", "solver/published/readings.md")
CHECKERS = tuple(f"certify/{name}.py" for name in ("check_certificate", "check_runs", "check_runs_in_space", "residuals"))


def git(*words):
    """What Git says; None where it refuses."""
    said = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True)
    return None if said.returncode else said.stdout


def is_measured(name):
    """A table that a command made."""
    return name.startswith("reports/measured/") and not name.endswith("README.md")


def files():
    """Of the product, as Git has them; what vendor/ has is the code of others."""
    for name in git("ls-files", *PRODUCT).splitlines():
        if name.endswith(CODE) and not name.startswith("bench/peers/") and "/vendor/" not in name:
            yield name


def texts():
    """Of the product: sentences, tables and templates beside the code; no list of CMake, licence or web asset."""
    for name in git("ls-files", *PRODUCT).splitlines():
        if name.endswith(TEXT) and not name.endswith(("CMakeLists.txt", "LICENSES.txt")) and "/web/" not in name:
            yield name


def text(name):
    return (ROOT / name).read_text()


# ---- Includes ----

def includes(names):
    """Of every C++ file: which of these it includes, and which headers of other libraries."""
    own, foreign = {}, {}
    for name in names:
        found = re.findall(r'^\s*#\s*include\s+["<]([^">]+)[">]', text(name), re.M)
        own[name] = [one for one in found if one in names]
        foreign[name] = [one for one in found if one not in names]
    return own, foreign


def reached(name, own):
    seen, left = {name}, [name]
    while left:
        for other in own[left.pop()]:
            if other not in seen:
                seen.add(other)
                left.append(other)
    return seen


def depth(name, own, known):
    if name not in known:
        known[name] = 0  # a circle ends here; structure_test.py refuses it
        known[name] = 1 + max((depth(other, own, known) for other in own[name]), default=0)
    return known[name]


# ---- Types and functions of C++ ----

TYPE = re.compile(r"^\s*(?:template <[^;{]*>\s*)?(?:struct|class|enum|enum class|union) (?!class)\w+[^;(]*\{", re.M)
STRUCT = re.compile(r"\b(?:struct|class)\s+(\w+)\s*(?:final\s*)?(?:<[^;{]*>\s*)?(?::[^;{}]*)?\{")
FUNCTION = re.compile(r"(?:^|\n)[ ]{0,2}(?:\[\[[\w:]+\]\] )?"  # an attribute
                      r"((?:[\w:]+(?:<[^;{}()]*>)?[&*]?\s+)*)([\w:~]+)"  # what it returns, name
                      r"\(([^;{}]*?)\)\s*(?:const|override|\s)*\{")


def bare(code):
    """Without comments and what stands in quotes; lines stay."""
    quoted = re.compile(r"""//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|(?<!\w)'(?:\\.|[^'\\\n])'""", re.S)
    return quoted.sub(lambda found: '""' if found[0] == '"auto"' else re.sub(r"[^\n]", " ", found[0]), code)


def body(code, start):
    """From the brace at `start` to the one that closes it."""
    open_ = 0
    for found in re.compile(r"[{}]").finditer(code, start):
        open_ += 1 if found[0] == "{" else -1
        if not open_:
            return code[start:found.end()]
    return code[start:]


def members(struct):
    """(type, name) of the data members of a struct, from its body."""
    flat, at = "", 1
    while at < len(struct) - 1:
        if struct[at] == "{":
            at += len(body(struct, at))
            if re.search(r"\)\s*(?:const|noexcept|override|\s)*(?::[^;]*)?$", flat):  # of a function
                flat += ";"
        else:
            flat += struct[at]
            at += 1
    for one in flat.split(";"):
        one = re.sub(r"=.*|\b(?:public|private|protected)\s*:", "", one, flags=re.S).strip()
        outside = one
        while re.search(r"<[^<>]*>", outside):
            outside = re.sub(r"<[^<>]*>", "", outside)
        found = re.fullmatch(r"(.*[\w>&*\]])\s+([*&]?\w+(?:\[\w*\])*(?:\s*,\s*\w+)*)", one, re.S)
        if found and "(" not in outside and not re.match(r"using|friend|template|static|typedef|enum|struct|return", one):
            for name in found[2].split(","):
                yield found[1], name.strip(" *&")


def place(name, code, at):
    return f"{name}:{code.count(chr(10), 0, at) + 1}"


def structs(codes):
    """(place, name, [(type, member)])"""
    for name, code in codes.items():
        for found in STRUCT.finditer(code):
            yield place(name, code, found.start()), found[1], list(members(body(code, found.end() - 1)))


def functions(codes):
    """(source, place, what it returns, name, parameters, body)"""
    for name, code in codes.items():
        for found in FUNCTION.finditer(code):
            if found[2] not in ("if", "for", "while", "switch", "catch"):
                inside = body(code, found.end() - 1)
                yield name, place(name, code, found.start(2)), found[1].strip(), found[2], found[3], inside


def problem_types(codes):
    rows = list(structs({name: code for name, code in codes.items() if not re.search(r"\bextern +\{", code)}))
    found = {}
    for at, name, held in rows:
        contacts = any(re.search(r"(?:vector|span)<.*Contact\b|\bContacts$", kind) for kind, _ in held)
        numbers = any(re.search(r"Vector|Matrix|vector<(?:double|Rational|Scalar|Real)", kind) for kind, _ in held)
        if contacts and numbers or {"A", "b"} <= {member.rstrip("_") for _, member in held}:
            found[at] = name
    known = "|".join(found.values())
    aliases = re.findall(rf"using (\w+) = (?:{known})<[^;]*>;", "\n".join(codes.values()))
    known = re.compile(rf"\b(?:{'|'.join([known, *aliases])})\b(?!::|<.*>::)")
    for at, name, held in rows:
        forms = [kind for kind, _ in held if known.search(kind) and not re.search("[&*]$|vector<|function<", kind)]
        if len(forms) > 1 and 2 * len(forms) >= len(held):
            found[at] = name
    return [f"{at} {name}" for at, name in found.items()]


def cascades(codes):
    answers = re.compile(r"\b(?!Claim)\w*Answer(?:<[^;{}()]*>)?&?>?\s+(?:\w+(?:<[^;{}()]*>)?::)*(\w+)\s*\(")
    left = re.compile(r"if \(!\w+\.Solved\(\)\) (?:return|\{(?:[^{}]|\{[^{}]*\})*\breturn\b[^{}]*\})")  # at once
    solving = {name for code in codes.values() for name in answers.findall(code)}
    found = {}
    for source, at, _, name, _, inside in functions(codes):
        calls = [call for call in re.findall(r"(?<!\w)(\w+)\s*(?:<[^;(){}]*>)?\(", inside) if call in solving]
        named = re.search(r'[!=]= (?:kAutomatic|"")|kAutomatic [!=]=', inside)
        in_turn = len(calls) > 1 and re.search(r"\bSolved\(\)", left.sub("", inside)) and "InTurn" not in inside
        where = "certify/request" if source.startswith("certify/request/") else source
        if (named or in_turn) and not source.startswith("solver/solve."):
            found.setdefault(where, []).append(f"{at} {name}")
    return [f"{where}: {', '.join(places)}" for where, places in found.items()]


def options_of_solving(codes):
    of_solving = {name: code for name, code in codes.items() if name.startswith(("solver/", "scene/", "certify/"))}
    return [f"{at} {name}" for at, name, held in structs(of_solving) if name.endswith("Options") or
            any(re.fullmatch(r"(?:const )?(?:Limits|Tolerances)&?", kind) for kind, _ in held)]


def judges(codes):
    says = re.compile(r"\b(?:bool|double|auto|Scalar|Rational|Errors<.*>|std::optional<.*>|\w*Forces)$", re.S)
    rows = [row for row in functions(codes)
            if says.search(row[2]) and re.search(r"Problem\w*(?:<[^,]*>)?& ", row[4])
            and re.search(r"Vector\w*& \w+|\bVector f\b|\bVectorXd& ", row[4])
            and re.search(r"FrictionLaw|\bmu\b|ContactKind|HasFrictionRows", row[4] + row[5])
            and re.search(r"\ba\b|Accelerat|\.A \*", row[4] + row[5])]
    of, asks = {}, {}
    for source, _, _, name, _, inside in rows:
        of.setdefault(name, set()).add(source)
        asks.setdefault((source, name), set()).update(re.findall(r"\b(\w+)(?:<[^;(){}]*>)?\(", inside))

    def asks_another(source, name, seen=()):
        return any(of[call] != {source} or call not in seen and asks_another(source, call, (*seen, call))
                   for call in asks[source, name] - {name} if call in of)
    found = {}
    for source, at, _, name, _, _ in rows:
        if not asks_another(source, name):
            found.setdefault(source, []).append(f"{at} {name}")
    return [f"{source}: {', '.join(places)}" for source, places in found.items()]


def judges_in_python(name):
    code, found = text(name), []
    forces = r"(?:\w+\.)?mu(?:\[\w+\])? \* (?:max\([^()]*)?(?:self\.)?f|f\w*\W*\* \w+\.mu\b"
    for one in ast.walk(ast.parse(code)):
        if isinstance(one, ast.FunctionDef):
            inside = ast.get_source_segment(code, one)
            if re.search(forces, inside) and re.search(r"\b(?:self\.)?a[NF]?\b", inside):
                found.append(f"{name}:{one.lineno} {one.name}")
    return found


# ---- What is measured otherwise ----

def build_seconds(build, target="stiction"):
    """Of what it is linked from; None where nothing was noted."""
    noted = build / "compile_times.csv"
    listed = subprocess.run(["ninja", "-C", build, "-t", "inputs", target], capture_output=True, text=True)
    if listed.returncode or not noted.exists():
        return None
    with open(noted) as file:
        seconds = {name: float(value) for name, value in csv.reader(file)}
    used = [name for name in listed.stdout.split() if name.endswith((".o", ".gch"))]
    return round(sum(seconds[name] for name in used)) if used and all(name in seconds for name in used) else None


def compiled(sources, build):
    """Processor seconds of the program, compiled from nothing by the release's options."""
    shutil.rmtree(build, ignore_errors=True)
    said = subprocess.run(["cmake", "-N", "-S", ROOT, "--preset", "release"], check=True, capture_output=True, text=True)
    options = [f"-D{name}={value}" for name, value in re.findall(r'^  (\w+)="(.*)"$', said.stdout, re.M)]
    subprocess.run(["cmake", "-G", "Ninja", "-S", sources, "-B", build, *options], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", build, "-j", str(os.cpu_count()), "stiction"], check=True, stdout=sys.stderr)
    return build_seconds(build)


def share_against(commit):
    folder = ROOT / "build/against"
    shutil.rmtree(folder / "sources", ignore_errors=True)
    subprocess.run(["git", "clone", "--quiet", "--shared", "--no-checkout", ROOT, folder / "sources"], check=True)
    subprocess.run(["git", "-C", folder / "sources", "checkout", "--quiet", commit], check=True)
    before, now = compiled(folder / "sources", folder / "before"), compiled(ROOT, folder / "now")
    print(f"compiled: {commit} in {before} s, this tree in {now} s of processor time")
    return round(now / before, 2)


def commit_lines(commit):
    """(file, lines that came, lines that went); None where Git does not have it."""
    listed = git("show", "--format=", "--numstat", "--no-renames", commit, "--")
    rows = re.findall(r"^([\d-]+)\t([\d-]+)\t(.*)$", listed or "", re.M)  # "-" of a file that is no text
    return None if listed is None else [(name, int(came.strip("-") or 0), int(went.strip("-") or 0))
                                        for came, went, name in rows]


def recipe_lines(recipe):
    """Of the commit of the recipe that CONTRIBUTING.md names."""
    return commit_lines(re.search(rf"^\*\*A {recipe}\b[^*]*\*\* \(([0-9a-f]+)\)", text("CONTRIBUTING.md"), re.M)[1])


def recipe_files(recipe):
    lines = recipe_lines(recipe)
    return None if lines is None else len(lines)


def added(commits):
    """Lines of the product, of (file, came, went) of commits; None where one is not known."""
    return None if None in commits else sum(came - went for lines in commits for name, came, went in lines
                                            if name.split("/")[0] in PRODUCT and name.endswith(CODE)
                                            and not name.startswith("bench/peers/"))


def feature_lines(feature):
    return added([commit_lines(commit) for commit in FEATURES[feature][0].split()])


def lines_before_features(names):
    """Of the product, without what the commits of recipes and features added. None as above."""
    counts = [added([recipe_lines(recipe) for recipe in RECIPES]), *map(feature_lines, FEATURES)]
    return None if None in counts else sum(len(text(name).splitlines()) for name in names) - sum(counts)


def survivors():
    """Per cent of the last drawn mutants that no test noticed; None where none were drawn."""
    name = "reports/measured/mutants.md"
    found = (ROOT / name).exists() and re.search(r"^drawn, seed \d+: (\d+) of (\d+) noticed", text(name), re.M)
    return round(100 - 100 * int(found[1]) / int(found[2]), 1) if found else None


def commits_with_generated():
    """Of the later half of the commits since FIRST: how many there are, and those that carry a generated file. None where
    Git does not have FIRST, or there are none."""
    listed = git("rev-list", "--no-merges", f"{FIRST}..HEAD")
    later = listed.split()[:-(len(listed.split()) // 2) or None] if listed else []
    found = []
    for commit in later:
        touched = git("show", "--format=", "--name-only", commit, "--").split("\n")
        carried = [name for name in touched if GENERATED.match(name)]
        if carried:
            found.append(f"{commit[:8]}: {', '.join(carried)}")
    return (len(later), found) if later else None


# ---- All ----

def measures(build, share):
    """(what, how much or None, the most that it may be, places)"""
    names = list(files())
    cpp = {name for name in names if name.endswith((".h", ".ipp", ".cpp"))}
    codes = {name: bare(text(name)) for name in sorted(cpp)}
    own, foreign = includes(cpp)
    sources = [name for name in cpp if name.endswith(".cpp")]
    known, words = {}, {name: len(text(name).split()) for name in git("ls-files", "*.md").splitlines()
                        if name not in PROOFS and not is_measured(name)}

    def counted(what, places, most):
        return what, len(places), most, places
    yield "lines of the product, peers and later features apart", lines_before_features(names), 93_719 - 6_000, []
    for feature, (_, most) in FEATURES.items():
        yield f"lines of the feature {feature}", feature_lines(feature), most, []
    yield "lines of texts with places, beside them", sum(len(text(name).splitlines()) for name in texts()), 1_800, []
    yield "types", sum(len(TYPE.findall(text(name))) for name in cpp), 710, []
    yield counted("problem types", problem_types(codes), 3)
    yield counted("cascades", cascades(codes), 1)
    yield counted("options of solving", options_of_solving(codes), 1)
    yield counted("judges in C++", judges(codes), 2)
    yield counted("judges of a Python checker, at most", max(map(judges_in_python, CHECKERS), key=len), 1)
    yield counted("loops over tallies outside of tables and records",
                  [f"{place(name, code, found.start())}" for name, code in codes.items()
                   if not name.startswith(("reports/tables/", "corpus/record/"))
                   for found in re.finditer(r"^ *for \(.*\btallies\)", code, re.M)], 0)
    yield "depth of includes", max(depth(name, own, known) for name in cpp), 9, []
    yield counted(f"sources that read the whole JSON library, of {len(sources)}",
                  [name for name in sorted(sources)
                   if any(header in JSON_HEADERS for one in reached(name, own) for header in foreign[one])], 60)
    pages = {name: len(text(name).splitlines()) for name in git("ls-files", "*README.md").split()}
    yield "longest page of a folder, in lines", max(pages.values()), 120, [name for name in pages if pages[name] > 120]
    yield "words of the texts, proofs and measured tables apart", sum(words.values()), 45_000, []
    seconds = build_seconds(build)
    yield f"compilation, a share of {FIRST}'s" + (f"; here {seconds} s" if seconds else ""), share, 0.67, []
    generated = commits_with_generated()
    yield ("commits with a generated file, per cent" + (f" of {generated[0]}" if generated else ""),
           round(100 * len(generated[1]) / generated[0]) if generated else None, 5, generated[1] if generated else [])
    examples = git("ls-files", "reports/examples").split()
    yield "megabytes of examples", round(sum((ROOT / name).stat().st_size for name in examples) / 1e6, 1), 8, []
    for recipe, most in RECIPES.items():
        yield f"files of the recipe for a {recipe}", recipe_files(recipe), most, []
    yield "drawn mutants that no test notices, per cent", survivors(), 10, []


def main():
    parser = argparse.ArgumentParser(description="How simple the sources are.")
    parser.add_argument("build", nargs="?", type=Path, default=ROOT / "build/release")
    parser.add_argument("--list", action="store_true", help="name the places of what is counted by rule")
    parser.add_argument("--against", metavar="COMMIT", help="compile its program and this one, and compare")
    o = parser.parse_args()
    bars = passed = 0
    for what, found, most, places in measures(o.build, share_against(o.against) if o.against else None):
        over = found is not None and found > most
        bars, passed = bars + 1, passed + over
        shown = "unknown" if found is None else f"{found:,}"
        print(f"{what:60} {shown:>10} {'bar' if found is None else 'over' if over else 'within':>7} {most:,}")
        if o.list:
            print("".join(f"    {one}\n" for one in places), end="")
    print(f"over {passed} of {bars} bars")
    return passed > 0


if __name__ == "__main__":
    sys.exit(main())
