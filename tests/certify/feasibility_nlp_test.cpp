// SPDX-License-Identifier: Apache-2.0
// Ipopt as a proposer. STICTION_IPOPT: path of the program stiction-ipopt.

#include "certify/exact/feasibility_nlp.h"

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <thread>

#include "certify/exact/verify_solution.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// One process for all tests that do not harm it.
IpoptProposer& Proposer() {
  static IpoptProposer proposer(STICTION_IPOPT);
  return proposer;
}

std::optional<ExactVector> Propose(const ExactProblem& problem, const ProposalOptions& options = {}) {
  ProposalStatistics statistics;
  return Proposer().ProposeSolution(problem, options, statistics);
}

ExactVector ReferenceSolution() { return Vector({1, Rational(-6, 7), Rational(25, 14), Rational(-25, 14)}); }

// A script in place of the program; removed with the test.
class Script {
 public:
  explicit Script(const std::string& body) : path_(std::filesystem::temp_directory_path() / Name()) {
    std::ofstream(path_) << "#!/bin/sh\n" << body;
    chmod(path_.c_str(), 0700);
  }
  ~Script() { std::filesystem::remove(path_); }

  const std::filesystem::path& path() const { return path_; }

 private:
  static std::string Name() { return "stiction-script-" + std::to_string(getpid()); }

  std::filesystem::path path_;
};

constexpr const char* kGreeting = R"(echo '{"program": "stiction-ipopt", "protocol": 1}')";

TEST_CASE("ipopt: the reference problem is solved exactly") {
  const auto f = Propose(ReferenceProblem());
  REQUIRE(f);
  CHECK(*f == ReferenceSolution());
}

TEST_CASE("ipopt: no start gives anything else than a solution") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    ProposalOptions options;
    options.seed = seed;
    const auto f = Propose(ThreeSolutions(), options);
    REQUIRE(f);
    CHECK(!FindViolation(ThreeSolutions(), *f));
  }
}

TEST_CASE("ipopt: a problem without a solution gets no answer") {
  ProposalOptions options;
  options.starts = 5;
  ProposalStatistics statistics;
  CHECK(!Proposer().ProposeSolution(NoSolution(), options, statistics));
  CHECK(statistics.solved == 0);
  CHECK(statistics.starts == 5);
}

TEST_CASE("ipopt: nothing to solve is solved") {
  const auto f = Propose(NoContacts());
  REQUIRE(f);
  CHECK(f->size() == 0);
}

TEST_CASE("ipopt: units far from one do not matter") {
  ExactProblem problem = ReferenceProblem();
  Rational huge = 1;
  for (int i = 0; i < 400; ++i) huge *= 10;
  for (Rational& value : problem.A.reshaped()) value *= huge;
  for (Rational& value : problem.b) value /= huge;
  const auto f = Propose(problem);
  REQUIRE(f);
  const ExactVector expected = ReferenceSolution() / Rational(huge * huge);
  CHECK(*f == expected);
}

TEST_CASE("ipopt: redundant contacts leave forces open, and are solved") {
  // A block carried by three contacts in a row: rank two.
  const ExactProblem problem = MakeProblem({-1, -1, -1}, {{2, 1, 0}, {1, 1, 1}, {0, 1, 2}}, {-1, -1, -1});
  for (const Formulation formulation : {Formulation::kNonlinear, Formulation::kQuadratic}) {
    ProposalOptions options;
    options.formulation = formulation;
    const auto f = Propose(problem, options);
    REQUIRE(f);
    CHECK(!FindViolation(problem, *f));
  }
}

TEST_CASE("ipopt: every kind of contact") {
  ExactProblem problem = ReferenceProblem();
  problem.contacts[0].kind = ContactKind::kSliding;
  problem.contacts[0].slip[0] = 1;
  problem.contacts[0].mu = Rational(1, 10);
  const auto sliding = Propose(problem);
  REQUIRE(sliding);
  CHECK(!FindViolation(problem, *sliding));

  // Pulled apart: the bilateral contact needs a negative force.
  ExactProblem held = MakeProblem({-1, 1}, {{2, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {4, -1, Rational(1, 2)});
  held.contacts[0].kind = ContactKind::kBilateral;
  const auto f = Propose(held);
  REQUIRE(f);
  CHECK(*f == Vector({-2, 1, Rational(-1, 2)}));
}

// The rate is a figure, not a promise: WARN shows it. The floor only says that something works at all.
TEST_CASE("ipopt: most random problems are solved, whatever their size") {
  constexpr int kProblems = 20;
  for (int contacts = 1; contacts <= 4; ++contacts) {
    ProposalStatistics statistics;
    for (int index = 0; index < kProblems; ++index) {
      const auto problem = Random<Rational>(GeneratorId::kIntegers, contacts, index);
      const auto f = Proposer().ProposeSolution(problem, {}, statistics);
      if (f) CHECK(!FindViolation(problem, *f));
    }
    WARN(contacts << " contacts: solved " << statistics.solved << " of " << statistics.problems << ", "
                  << statistics.starts << " starts, " << statistics.iterations << " iterations, "
                  << statistics.words << " words, " << statistics.seconds << " s");
    CHECK(statistics.problems == kProblems);
    CHECK(statistics.solved >= kProblems / 2);
    CHECK(statistics.starts >= kProblems);
  }
}

TEST_CASE("ipopt: equation (5) solves frictionless problems, and only those") {
  ProposalOptions options;
  options.formulation = Formulation::kQuadratic;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const ExactProblem problem = RandomFrictionless(1 + static_cast<int>(seed % 4), seed);
    const auto f = Propose(problem, options);
    REQUIRE(f);
    CHECK(!FindViolation(problem, *f));
  }
  CHECK_THROWS_WITH(Propose(ReferenceProblem(), options),
                    Catch::Contains("contacts[0].kind: found static, expected frictionless"));
}

TEST_CASE("ipopt: the same request gets the same answer") {
  const auto problem = Random<Rational>(GeneratorId::kIntegers, 3, 7);
  ProposalStatistics first, second;
  const auto f = Proposer().ProposeSolution(problem, {}, first);
  CHECK(f == Proposer().ProposeSolution(problem, {}, second));
  CHECK(first.starts == second.starts);
  CHECK(first.iterations == second.iterations);
}

TEST_CASE("ipopt: a process that is killed is replaced") {
  IpoptProposer proposer(STICTION_IPOPT);
  ProposalStatistics statistics;
  for (int round = 1; round <= 3; ++round) {
    const int before = proposer.process_id();
    REQUIRE(before > 0);
    REQUIRE(kill(before, SIGKILL) == 0);
    const auto f = proposer.ProposeSolution(ReferenceProblem(), {}, statistics);
    REQUIRE(f);
    CHECK(*f == ReferenceSolution());
    CHECK(statistics.restarts == round);
    CHECK(proposer.process_id() != before);
  }
}

TEST_CASE("ipopt: a process killed while it works is replaced", "[slow]") {
  IpoptProposer proposer(STICTION_IPOPT);
  const int process = proposer.process_id();
  std::thread killer([process] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    kill(process, SIGKILL);  // not reaped before `proposer` sees it: still ours
  });
  ProposalOptions options;
  options.starts = 100;  // takes longer than that
  ProposalStatistics statistics;
  CHECK(!proposer.ProposeSolution(NoSolution(), options, statistics));
  killer.join();
  CHECK(statistics.restarts == 1);
  CHECK(statistics.starts == 100);
}

TEST_CASE("ipopt: a process that always dies is no answer, not a loop") {
  const Script script(std::string(kGreeting) + "\nread line\n");
  IpoptProposer proposer(script.path());
  ProposalStatistics statistics;
  CHECK(!proposer.ProposeSolution(ReferenceProblem(), {}, statistics));
  CHECK(statistics.restarts == 1);
  CHECK(proposer.process_id() == -1);
}

TEST_CASE("ipopt: a process that hangs is ended") {
  const Script script(std::string(kGreeting) + "\nexec sleep 600\n");
  IpoptProposer proposer(script.path());
  ProposalOptions options;
  options.patience = 0.05;
  ProposalStatistics statistics;
  CHECK(!proposer.ProposeSolution(ReferenceProblem(), options, statistics));
  CHECK(statistics.timeouts == 1);
  CHECK(statistics.seconds < 10);

  // It does not even read, and the request is longer than what is kept for it.
  const int contacts = 200;
  ExactProblem large =
      MakeProblem(std::vector<Rational>(contacts, -1), {}, std::vector<Rational>(contacts, -1));
  large.A = ExactMatrix::Constant(contacts, contacts, Rational(1, 3));
  large.A(0, 0) = 1;
  CHECK(!proposer.ProposeSolution(large, options, statistics));
  CHECK(statistics.timeouts == 2);
  CHECK(statistics.seconds < 10);
}

TEST_CASE("ipopt: a wrong proposal is never returned") {
  // Forces of another problem.
  const Script script(
      std::string(kGreeting) +
      "\nwhile read line; do echo '{\"status\": \"solved\", \"f\": [3, 3, 0, 0], \"iterations\": 1, "
      "\"starts\": 20, \"objective\": 0, \"seconds\": 0}'; done\n");
  IpoptProposer proposer(script.path());
  ProposalStatistics statistics;
  CHECK(!proposer.ProposeSolution(ReferenceProblem(), {}, statistics));
  CHECK(statistics.words >= 1);
}

TEST_CASE("ipopt: what is not the program is refused with its path") {
  CHECK_THROWS_AS(IpoptProposer("/no/such/program"), InputError);
  CHECK_THROWS_WITH(IpoptProposer("/no/such/program"),
                    Catch::Contains("/no/such/program: cannot be run: No such file or directory"));
  CHECK_THROWS_AS(IpoptProposer("/bin/true"), InputError);
  CHECK_THROWS_WITH(IpoptProposer("/bin/pwd"), Catch::Contains("/bin/pwd: found \"/"));
}

TEST_CASE("ipopt: an answer that is none is refused") {
  const Script script(std::string(kGreeting) + "\nread line; echo '{\"f\": 1}'\n");
  IpoptProposer proposer(script.path());
  ProposalStatistics statistics;
  CHECK_THROWS_AS(proposer.ProposeSolution(ReferenceProblem(), {}, statistics), InputError);
}

TEST_CASE("ipopt: a problem in space is refused") {
  ExactProblem problem = NoContacts();
  problem.dimension = 3;
  CHECK_THROWS_WITH(Propose(problem), Catch::Contains("dimension: found 3, expected 2"));
}

}  // namespace
}  // namespace stiction
