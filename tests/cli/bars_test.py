# SPDX-License-Identifier: Apache-2.0
"""tests/setup/bars.py counts what sources do, whatever its name: in sources made up for it, and in these."""

import sys
import unittest

import cli

sys.path.insert(0, str(cli.ROOT / "tests/setup"))
import bars  # noqa: E402

PROBLEMS = """
struct Scene {
  std::vector<Contact<Scalar>> contacts;  // and numbers
  int dimension = 2;
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(3);
  int rows() const { return dimension; }
};
class Numbers {
 public:
  explicit Numbers(int n) : n_(n) {}
 private:
  int n_;
  std::vector<std::vector<double>> A_;
  Things b_{1, 2};
};
struct Forms { std::optional<Numbers> wide; Scene narrow; bool both = false; };
struct Worker { Numbers one; Scene two; int a, b, c; };
struct Named { const Scene& scene; Scene::Vector x, y; };
"""
OF_C = 'extern "C" { struct of_c { double* A; double* b; }; }'
CASCADES = """
Answer<double> Best(int x);
std::optional<Answer<T>> Other(int x) { return {}; }
bool Plain() { return Best(1).Solved(); }
auto InTurn() {
  auto first = Best(1);
  if (first.Solved()) return first;
  return *Other(2);
}
bool Asks(const Row& row) { return row.method == "auto"; }  // not == kAutomatic
Answer<double> Line() {
  auto first = Best(1);
  if (!first.Solved()) return first;
  return Best(2);
}
Answer<double> Listed() { return InTurn<A>({Best(1), Best(2)}, [](auto& answer) { return answer.Solved(); }); }
"""
JUDGES = """
bool Holds(const ExactProblem& problem, const ExactVector& x) { return Law(FrictionLaw::kCoulomb, problem.A * x); }
double Wraps(const ExactProblem& problem, const ExactVector& f, FrictionLaw law) { return Far(problem, f, a); }
"""
FAR = "[[nodiscard]] double Far(const Problem& problem, const Vector& f, const Vector& a) { return mu * f[0] - a[0]; }"


def names(places):
    return [one.split()[-1] for one in places]


@unittest.skipIf(cli.SHORT, "the script is the same for every build")
class Rules(cli.TestCase):
    def codes(self, **sources):
        return {f"certify/{name}.cpp": bars.bare(code) for name, code in sources.items()}

    def test_problems_cascades_options_and_judges_by_what_they_hold_and_do(self):
        self.assertEqual(names(bars.problem_types(self.codes(x=PROBLEMS, y=OF_C))), ["Scene", "Numbers", "Forms"])
        self.assertEqual(names(bars.problem_types(self.codes(x=OF_C.replace('extern "C"', "")))), ["of_c"])
        self.assertEqual(bars.cascades(self.codes(x=CASCADES)),
                         ["certify/x.cpp: certify/x.cpp:5 InTurn, certify/x.cpp:10 Asks"])
        self.assertEqual(bars.cascades({"solver/solve.ipp": CASCADES}), [])
        held = "struct Wishes { Limits limits = {}; }; struct SmallOptions { int n; }; struct Row { int n; };"
        self.assertEqual(names(bars.options_of_solving(self.codes(x=held))), ["Wishes", "SmallOptions"])
        self.assertEqual([one.split(":")[0] for one in bars.judges(self.codes(x=JUDGES, y=FAR))],
                         ["certify/x.cpp", "certify/y.cpp"])
        self.assertNotIn("Wraps", str(bars.judges(self.codes(x=JUDGES, y=FAR))))

    def test_a_generated_file_is_known_by_its_place_and_what_is_no_program_is_not(self):
        for name, generated in (("reports/examples/search/index.html", True), ("reports/web/dist/viewer.html", True),
                                ("reports/web/solver/solver.wasm.gz", True), ("corpus/scenes/a.svg", True),
                                ("tests/golden/CHANGES.md", False), ("reports/measured/nightly.md", False),
                                ("reports/web/src/viewer.js", False)):
            self.assertEqual(bool(bars.GENERATED.match(name)), generated, name)

    def test_in_these_sources_each_rule_finds_something_that_is_there(self):
        sources = {name: bars.bare(bars.text(name)) for name in bars.files() if name.endswith((".h", ".ipp", ".cpp"))}
        self.assertIn("ContactProblem", names(bars.problem_types(sources)))
        self.assertIn("certify/request", [one.split(":")[0] for one in bars.cascades(sources)])
        self.assertIn("Request", names(bars.options_of_solving(sources)))
        self.assertIn("certify/exact/verify_solution.cpp", [one.split(":")[0] for one in bars.judges(sources)])
        self.assertIn("check_forces", names(bars.judges_in_python("certify/check_certificate.py")))


if __name__ == "__main__":
    cli.main()
