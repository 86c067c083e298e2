# SPDX-License-Identifier: Apache-2.0
"""What includes what: the order of the folders, and of rooms within them; and names that files must not share."""

import functools
import re

import cli

# What each folder may include besides itself, and each room of a folder besides itself.
FOLDERS = {
    "solver": [],
    "scene": ["solver"],
    "corpus": ["scene", "solver"],
    "certify": ["corpus", "scene", "solver"],
    "reports": ["corpus", "scene", "solver"],
    "search": ["certify", "corpus", "scene", "solver"],
    "python": ["cli", "reports", "search", "certify", "corpus", "scene", "solver"],
    "cli": ["bench", "reports", "search", "certify", "corpus", "scene", "solver"],
    "bench": ["reports", "search", "certify", "corpus", "scene", "solver"],
}
ROOMS = {
    "solver": {
        "problem": [],
        "linear": ["problem"],
        "published": ["linear", "problem"],
        "complete": ["published", "linear", "problem"],
        "lemke": ["complete", "published", "linear", "problem"],
        "numeric": ["complete", "lemke", "published", "linear", "problem"],
        "c": ["numeric", "problem"],
    },
    "certify": {"exact": [], "claims": ["exact"], "request": ["claims", "exact"]},
    "corpus": {"record": [], "store": ["record"], "formats": ["record", "store"]},
    "search": {"generators": ["lanes"], "lanes": ["generators"], "units": ["generators", "lanes"],
               "adversary": ["generators", "units"]},
}
OF_OTHERS = ("ode/src/lcp.cpp",)  # sources of other packages that texts name
MOST_LEVELS = 10
UNITED = ("certify", "cli", "corpus", "reports", "scene", "search")  # several sources to a unit
CONSTANT = re.compile(r"^(?:static |inline )?constexpr [^=;(]*?\b(k\w+)\s*(?:\[[^\]]*\])*\s*[={]", re.M)
TYPE = re.compile(r"^(?:struct|class|enum class) (\w+)\b(?! ?[;<])", re.M)
FUNCTION = re.compile(r"^(?! |return|using|namespace|template)[\w:<>,&*\[\] ]*?[\w>&*] (\w+)\([^{};]*?\)(?: const)? \{", re.M)
INCLUDE = re.compile(r'^#include ([<"])([^>"]+)[>"]', re.M)


def sources():
    """Path -> (our own files that it includes, the others)."""
    found = {}
    for folder in FOLDERS:
        for file in sorted((cli.ROOT / folder).rglob("*")):
            if file.suffix in (".h", ".ipp", ".cpp"):
                names = INCLUDE.findall(file.read_text())
                found[file.relative_to(cli.ROOT).as_posix()] = [name for _, name in names]
    return ({path: [name for name in names if name in found] for path, names in found.items()},
            {path: [name for name in names if name not in found] for path, names in found.items()})


class Structure(cli.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.ours, cls.others = sources()

    def test_a_source_that_a_text_or_a_comment_names_is_there(self):
        said = re.compile(r"(?<![\w/.])([a-z_]+(?:/[a-z_]+)+\.(?:h|cpp|ipp|py))\b")
        files = [path for folder in (*FOLDERS, "tests") for path in (cli.ROOT / folder).rglob("*") if path.is_file()]
        there = {path.relative_to(cli.ROOT).as_posix() for path in files}
        ends = {path[i + 1:] for path in there for i, c in enumerate(path) if c == "/"} | there
        count = 0
        for path in [*files, *cli.ROOT.glob("*.md")]:
            if path.suffix not in (".md", ".h", ".cpp", ".ipp"):
                continue
            for line in path.read_text().splitlines():
                for name in said.findall(line if path.suffix == ".md" else line.partition("//")[2]):
                    count += 1
                    if name not in OF_OTHERS:
                        self.assertIn(name, ends, path)
        self.assertGreater(count, 300)

    def test_folders_include_only_those_before_them(self):
        self.assertGreater(len(self.ours), 150)
        for path, names in self.ours.items():
            folder = path.split("/")[0]
            for name in names:
                with self.subTest(file=path, includes=name):
                    self.assertIn(name.split("/")[0], [folder, *FOLDERS[folder]])

    def test_the_command_line_has_of_bench_the_table_of_suites_alone(self):
        """`stiction` explains the words of bench, and is linked with none of it; its program may call all."""
        for path, names in self.ours.items():
            if path.startswith("cli/") and path != "cli/stiction_bench.cpp":
                self.assertLessEqual({name for name in names if name.startswith("bench/")}, {"bench/suite.h"}, path)

    def test_rooms_include_only_those_before_them(self):
        for path, names in self.ours.items():
            folder, room, *_ = path.split("/")
            if room in ROOMS.get(folder, {}):
                for name in names:
                    if name.startswith(folder + "/") and name.count("/") == 2:
                        with self.subTest(file=path, includes=name):
                            self.assertIn(name.split("/")[1], [room, *ROOMS[folder][room]])

    def test_the_solver_includes_eigen_the_standard_library_and_in_one_source_klu(self):
        for path, names in self.others.items():
            if path.startswith("solver/") and not path.startswith("solver/c/examples/"):
                for name in set(names) - ({"klu.h"} if path == "solver/linear/sparse_lu.cpp" else set()):
                    with self.subTest(file=path, includes=name):
                        self.assertRegex(name, r"^(Eigen/\w+|[a-z_]+)$")

    def test_json_text_is_made_in_one_place(self):
        # Elsewhere a byte of somebody's file that is no UTF-8 would throw, and a number that is not finite become null.
        makers = sorted(path for path in self.ours if re.search(r"(\.|->)dump\(", (cli.ROOT / path).read_text()))
        # Hosts of Ipopt and of solvers under test are processes of their own, which write a line each.
        self.assertEqual(makers, ["certify/ipopt/stiction_ipopt.cpp", "corpus/json_text.cpp", "search/under_test/host.cpp"])

    def test_command_line_parsers_stand_in_the_programs_alone(self):
        users = {path for path, names in self.others.items() if any(name.startswith("CLI/") for name in names)}
        self.assertEqual({path for path in users if not path.startswith("bench/peers/")}, {"cli/command_line.cpp"})

    def test_files_that_may_be_compiled_together_share_no_name(self):
        """In their unnamed namespaces: which files share a unit changes with every file that is added."""
        for folder in UNITED:
            constants, types, functions = ({}, {}, {})
            for file in sorted((cli.ROOT / folder).rglob("*.cpp")):
                if {"ipopt", "live", "peers", "lanes"} & set(file.relative_to(cli.ROOT).parts):
                    continue  # programs of their own
                text = file.read_text()
                for pattern, found in ((CONSTANT, constants), (TYPE, types), (FUNCTION, functions)):
                    for name in pattern.findall(text):
                        found.setdefault(name, set()).add(file.name)
            self.assertGreater(len(functions), 20, folder)
            for name, files in (*constants.items(), *types.items()):
                self.assertEqual(len(files), 1, f"{folder}: {name} stands in {sorted(files)}")
            for name in types.keys() & functions.keys():
                self.assertEqual(types[name], functions[name], f"{folder}: {name} is a type and a function")

    def test_includes_are_no_circle_and_at_most_ten_levels_deep(self):
        open_files = []

        @functools.cache
        def chain(path):
            self.assertNotIn(path, open_files, "a circle")
            open_files.append(path)
            longest = max((chain(name) for name in self.ours[path]), key=len, default=())
            open_files.pop()
            return path, *longest

        for path in self.ours:
            with self.subTest(file=path):
                self.assertLessEqual(len(chain(path)) - 1, MOST_LEVELS, " > ".join(chain(path)))


if __name__ == "__main__":
    cli.main()
