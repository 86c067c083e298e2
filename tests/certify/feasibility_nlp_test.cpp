// SPDX-License-Identifier: Apache-2.0
// Ipopt as a proposer. STICTION_IPOPT: path of the program stiction-ipopt.

#include "certify/exact/feasibility_nlp.h"

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
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

std::optional<ExactVector> Propose(const ExactProblem& problem, IpoptProposer& proposer = Proposer()) {
  const Answer<Rational> answer = proposer.ProposeSolution(problem);
  return answer.Solved() ? std::optional(answer.f) : std::nullopt;
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
  IpoptProposer proposer(STICTION_IPOPT);
  for (proposer.seed = 1; proposer.seed <= 10; ++proposer.seed) {
    const auto f = Propose(ThreeSolutions(), proposer);
    REQUIRE(f);
    CHECK(!FindViolation(ThreeSolutions(), *f));
  }
}

TEST_CASE("ipopt: a problem without a solution gets no answer") {
  IpoptProposer proposer(STICTION_IPOPT);
  proposer.starts = 5;
  const Answer<Rational> answer = proposer.ProposeSolution(NoSolution());
  CHECK(answer.outcome == Outcome::kUndecided);
  CHECK(!answer.reason.empty());
  CHECK(answer.counters[Counter::kStarts] == 5);
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
  const auto f = Propose(problem);
  REQUIRE(f);
  CHECK(!FindViolation(problem, *f));
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
    Counters counters;
    int solved = 0;
    for (int index = 0; index < kProblems; ++index) {
      const auto problem = Random<Rational>(GeneratorId::kIntegers, contacts, index);
      const Answer<Rational> answer = Proposer().ProposeSolution(problem);
      counters += answer.counters;
      solved += answer.Solved();
      if (answer.Solved()) CHECK(!FindViolation(problem, answer.f));
    }
    WARN(contacts << " contacts: solved " << solved << " of " << kProblems << ", " << counters[Counter::kStarts]
                  << " starts, " << counters[Counter::kIterations] << " iterations, "
                  << counters[Counter::kWords] << " words");
    CHECK(solved >= kProblems / 2);
    CHECK(counters[Counter::kStarts] >= kProblems);
  }
}

TEST_CASE("ipopt: the same request gets the same answer") {
  const auto problem = Random<Rational>(GeneratorId::kIntegers, 3, 7);
  const Answer<Rational> first = Proposer().ProposeSolution(problem),
                         second = Proposer().ProposeSolution(problem);
  CHECK(first.f == second.f);
  CHECK(first.counters[Counter::kStarts] == second.counters[Counter::kStarts]);
  CHECK(first.counters[Counter::kIterations] == second.counters[Counter::kIterations]);
}

TEST_CASE("ipopt: a process that is killed is replaced") {
  IpoptProposer proposer(STICTION_IPOPT);
  for (int round = 1; round <= 3; ++round) {
    const int before = proposer.process_id();
    REQUIRE(before > 0);
    REQUIRE(kill(before, SIGKILL) == 0);
    const auto f = Propose(ReferenceProblem(), proposer);
    REQUIRE(f);
    CHECK(*f == ReferenceSolution());
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
  proposer.starts = 100;  // takes longer than that
  const Answer<Rational> answer = proposer.ProposeSolution(NoSolution());
  killer.join();
  CHECK(!answer.Solved());
  CHECK(answer.counters[Counter::kStarts] == 100);
  CHECK(proposer.process_id() > 0);
  CHECK(proposer.process_id() != process);
}

TEST_CASE("ipopt: a process that always dies is no answer, not a loop") {
  const Script script(std::string(kGreeting) + "\nread line\n");
  IpoptProposer proposer(script.path());
  CHECK(!Propose(ReferenceProblem(), proposer));
  CHECK(proposer.process_id() == -1);
}

TEST_CASE("ipopt: a process that hangs is ended") {
  const Script script(std::string(kGreeting) + "\nexec sleep 600\n");
  IpoptProposer proposer(script.path());
  proposer.patience = 0.05;
  const auto begin = std::chrono::steady_clock::now();
  CHECK(!Propose(ReferenceProblem(), proposer));
  CHECK(proposer.process_id() == -1);

  // It does not even read, and the request is longer than what is kept for it.
  const int contacts = 200;
  ExactProblem large =
      MakeProblem(std::vector<Rational>(contacts, -1), {}, std::vector<Rational>(contacts, -1));
  large.A = ExactMatrix::Constant(contacts, contacts, Rational(1, 3));
  large.A(0, 0) = 1;
  CHECK(!Propose(large, proposer));
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(20));
}

TEST_CASE("ipopt: a wrong proposal is never returned") {
  // Forces of another problem.
  const Script script(
      std::string(kGreeting) +
      "\nwhile read line; do echo '{\"status\": \"solved\", \"f\": [3, 3, 0, 0], \"iterations\": 1, "
      "\"starts\": 20, \"objective\": 0, \"seconds\": 0}'; done\n");
  IpoptProposer proposer(script.path());
  const Answer<Rational> answer = proposer.ProposeSolution(ReferenceProblem());
  CHECK(!answer.Solved());
  CHECK(answer.counters[Counter::kWords] >= 1);
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
  CHECK_THROWS_AS(proposer.ProposeSolution(ReferenceProblem()), InputError);
}

TEST_CASE("ipopt: a problem in space is refused") {
  ExactProblem problem = NoContacts();
  problem.dimension = 3;
  CHECK_THROWS_WITH(Propose(problem), Catch::Contains("dimension: found 3, expected 2"));
}

}  // namespace
}  // namespace stiction
