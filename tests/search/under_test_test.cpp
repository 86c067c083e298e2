// SPDX-License-Identifier: Apache-2.0
// What a solver under test is judged by. What becomes of real ones: tests/cli/under_test_test.py.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "corpus/rounded.h"
#include "search/campaign.h"
#include "search/under_test/examine.h"
#include "search/under_test/judge_forces.h"
#include "search/under_test/reproducer.h"
#include "search/under_test/simple_scene.h"
#include "search/under_test/solver_process.h"
#include "search/under_test/solver_unit.h"
#include "search/units/regenerate.h"
#include "tests/scratch.h"
#include "tests/support.h"

namespace stiction {
namespace {

// One static contact: A = diag(own), b.
ContactProblem<double> OneContact(double mu, std::array<double, 2> own, std::array<double, 2> b) {
  ContactProblem<double> problem;
  problem.contacts = {{ContactKind::kStatic, mu, {}}};
  problem.A = Eigen::Vector2d(own[0], own[1]).asDiagonal();
  problem.b = Eigen::Vector2d(b[0], b[1]);
  return problem;
}

// The condition that is missed by more than 1e-6; "" of what passes. A problem of one row has no friction.
std::string MissOf(const ContactProblem<double>& problem, SolverLaw law, double normal, double friction) {
  const Eigen::Vector2d f(normal, friction);
  return JudgeForces(problem, law, Rational(1, 1000000), f.head(problem.rows())).what;
}

constexpr SolverLaw kLawsWithFriction[] = {SolverLaw::kBox, SolverLaw::kFindex, SolverLaw::kPyramid,
                                           SolverLaw::kCoulomb};

}  // namespace

TEST_CASE("under test: a contact that sticks passes by every law, and each condition has its name") {
  const auto problem = OneContact(1, {2, 3}, {-1, 1});  // f = (1/2, -1/3)
  for (const SolverLaw law : kLawsWithFriction) {
    CAPTURE(static_cast<int>(law));
    CHECK(MissOf(problem, law, 0.5, -1.0 / 3) == "");
    CHECK(MissOf(problem, law, 0.5, -1.0 / 3 + 1e-9) == "");
    CHECK(MissOf(problem, law, -0.5, -1.0 / 3) != "");
    CHECK(MissOf(problem, law, 0.25, -0.25) == "moves-inward");
    CHECK(MissOf(problem, law, 1, -1.0 / 3) == "presses-and-separates");
    CHECK(MissOf(problem, law, 0.5, 1.0 / 3) == "friction-drives-slip");
    CHECK(MissOf(problem, law, 0.5, -0.1) == "slips-below-limit");
    CHECK(MissOf(problem, law, 0.5, -0.75) != "");
  }
  CHECK(MissOf(PosedFor(SolverLaw::kFrictionless, problem), SolverLaw::kFrictionless, 0.5, 0) == "");
}

TEST_CASE("under test: what is beyond the limit of friction is named so") {
  const auto problem = OneContact(0.25, {2, 3}, {-1, 1});  // slips: f = (1/2, -1/8)
  for (const SolverLaw law : kLawsWithFriction) {
    CAPTURE(static_cast<int>(law));
    CHECK(MissOf(problem, law, 0.5, -0.125) == "");
    CHECK(MissOf(problem, law, 0.5, -1.0 / 3) == "friction-beyond-limit");
  }
}

TEST_CASE("under test: laws part where the normal force is not that of the normals alone") {
  ContactProblem<double> problem = OneContact(1, {2, 2}, {-2, 4});
  problem.A(0, 1) = problem.A(1, 0) = 1;
  // Coulomb: f = (2, -2), where friction presses the contact: a = (0, 2). Under findex, and with fixed bounds,
  // the limit is that of fN = 1 alone: f = (1.5, -1).
  CHECK(MissOf(problem, SolverLaw::kCoulomb, 2, -2) == "");
  CHECK(MissOf(problem, SolverLaw::kPyramid, 2, -2) == "");
  CHECK(MissOf(problem, SolverLaw::kFindex, 2, -2) == "friction-beyond-limit");
  CHECK(MissOf(problem, SolverLaw::kBox, 2, -2) == "friction-beyond-limit");
  CHECK(MissOf(problem, SolverLaw::kFindex, 1.5, -1) == "");
  CHECK(MissOf(problem, SolverLaw::kBox, 1.5, -1) == "");
  CHECK(MissOf(problem, SolverLaw::kCoulomb, 1.5, -1) == "slips-below-limit");
  const auto judged = JudgeForces(problem, SolverLaw::kFindex, Rational(1, 1000000), Eigen::Vector2d(1.5, -1));
  CHECK(judged.misses_coulomb);
  // Of what is wrong by its own law, nothing is said of another.
  const Eigen::Vector2d wrong(0.25, -0.25);
  CHECK_FALSE(JudgeForces(problem, SolverLaw::kFindex, Rational(1, 1000000), wrong).misses_coulomb);
}

TEST_CASE("under test: friction at its limit in space that is not against the slip is askew") {
  ContactProblem<double> problem;
  problem.dimension = 3;
  problem.contacts = {{ContactKind::kStatic, 0.5, {}}};
  problem.A = Eigen::Matrix3d::Identity();
  problem.b = Eigen::Vector3d(-1, 2, 0);
  const auto miss = [&problem](double normal, double one, double other) {
    return JudgeForces(problem, SolverLaw::kCoulomb, Rational(1, 1000000), Eigen::Vector3d(normal, one, other))
        .what;
  };
  CHECK(miss(1, -0.5, 0) == "");
  CHECK(miss(1, 0, -0.5) == "friction-askew");
  CHECK(miss(1, -0.6, 0) == "friction-beyond-limit");
}

TEST_CASE("under test: what is small beside a jam is not accused, and not called solved either") {
  ContactProblem<double> problem;
  problem.contacts.assign(2, {ContactKind::kFrictionless, 0, {}});
  problem.A = (Eigen::Matrix2d() << 1, -1, -1, 1).finished();
  problem.b = Eigen::Vector2d(-1, 1);
  const auto judged = [&problem](double first) {
    return JudgeForces(problem, SolverLaw::kCoulomb, Rational(1, 100000), Eigen::Vector2d(first, 10000));
  };
  CHECK(judged(10001).what.empty());
  CHECK_FALSE(judged(10001).is_neither);
  CHECK(judged(10001.0001).what.empty());  // a = (1e-4, -1e-4)
  CHECK(judged(10001.0001).is_neither);
  CHECK_FALSE(judged(10003).what.empty());
  CHECK_FALSE(judged(10003).is_neither);
}

TEST_CASE("under test: friction where nothing acts along the contact is held to what its normal bears") {
  ContactProblem<double> problem;
  problem.contacts = {{ContactKind::kStatic, 1, {}}, {ContactKind::kFrictionless, 0, {}}};
  problem.A = Eigen::Matrix3d::Identity();
  problem.A(0, 2) = problem.A(2, 0) = -0.5;
  problem.b = Eigen::Vector3d(0, 0, -1.5);  // f = (1, 0, 2); the fixed bound is 0, since b is 0 there
  const auto miss = [&problem](double friction) {
    return JudgeForces(problem, SolverLaw::kBox, Rational(1, 1000000), Eigen::Vector3d(1, friction, 2)).what;
  };
  CHECK(miss(0) == "");
  CHECK(miss(1e-12) == "");
  CHECK(miss(1e-5) == "friction-beyond-limit");
}

TEST_CASE("under test: bounds of findex that are not unique leave an answer unjudged") {
  ContactProblem<double> problem;
  problem.contacts.assign(2, {ContactKind::kStatic, 1, {}});
  problem.A = Eigen::MatrixXd::Zero(4, 4);
  problem.A(0, 0) = problem.A(0, 2) = problem.A(2, 0) = problem.A(2, 2) = 1;
  problem.A(1, 1) = problem.A(3, 3) = 1;
  problem.b = Eigen::Vector4d(-1, 0, -1, 0);
  const Eigen::Vector4d f(0.5, 0, 0.5, 0);
  CHECK(JudgeForces(problem, SolverLaw::kFindex, Rational(1, 1000000), f).kind == "unjudged");
  CHECK(JudgeForces(problem, SolverLaw::kCoulomb, Rational(1, 1000000), f).what == "");
  const Eigen::Vector4d endless(std::numeric_limits<double>::quiet_NaN(), 0, 0, 0);
  CHECK_FALSE(JudgeForces(problem, SolverLaw::kCoulomb, Rational(1, 1000000), endless).error < 1);
}

TEST_CASE("under test: rounding at a contact on which nothing acts is held to what acts elsewhere") {
  ContactProblem<double> problem;
  problem.contacts.assign(3, {ContactKind::kFrictionless, 0, {}});
  problem.A = Eigen::Vector3d(4, 2, 1).asDiagonal();
  problem.A(0, 2) = problem.A(2, 0) = 1;
  problem.b = Eigen::Vector3d(0, -1, 0);  // the second alone is loaded: f = 1/2, W = 1/2
  const auto judged = [&](double first, double last, double accuracy = 1e-6) {
    return JudgeForces(problem, SolverLaw::kFrictionless, Rational(accuracy),
                       Eigen::Vector3d(first, 0.5, last));
  };
  const double unit = std::sqrt(0.5 / 4);  // sqrt(W / A)
  CHECK(judged(1e-16, 0).what == "");
  CHECK(judged(-1e-16, 1e-16).what == "");
  CHECK(judged(0.9e-6 * unit, 0).what == "");
  CHECK(judged(0.9e-6 * unit, 0).error == Approx(0.9e-6));
  CHECK(judged(1.1e-6 * unit, 0).what == "presses-and-separates");
  CHECK(judged(-1.1e-6 * unit, 0).what == "pulls");
  CHECK(judged(1e-16, 0, 1e-17).what != "");
  // In other units it is the same problem.
  problem.A(0, 0) *= 1e12, problem.A(0, 2) = problem.A(2, 0) = 1e6;
  CHECK(judged(0.9e-12 * unit, 0).what == "");
  CHECK(judged(1.1e-12 * unit, 0).what != "");
  // A force that moves nothing has the unit of the largest.
  const double stiff = problem.A(0, 0);
  problem.A(0, 0) = problem.A(0, 2) = problem.A(2, 0) = 0;
  CHECK(judged(-0.9e-6 * 0.5, 0).what == "");
  CHECK(judged(-0.9e-6 * 0.5, 0).error == Approx(0.9e-6));
  CHECK(judged(-1.1e-6 * 0.5, 0).what == "pulls");
  CHECK(judged(-1e6, 0).what == "pulls");
  CHECK(judged(1e6, -1e-16).what == "");
  CHECK(judged(-1e-16, 1e-5).what == "presses-and-separates");
  problem.A(0, 0) = stiff, problem.A(0, 2) = problem.A(2, 0) = 1e6;
  // What is loaded, by however little, has a unit of its own.
  problem.b[0] = -1e-20;
  CHECK(judged(1e-16, 0).what != "");
  // Where nothing acts at all there is no unit.
  problem.b.setZero();
  const Eigen::Vector3d idle(1e-16, 0, 0);
  CHECK(JudgeForces(problem, SolverLaw::kFrictionless, Rational(1, 1000000), idle).what != "");
}

namespace {

// A program in Python; `loop` is what it does with each line.
SolverProcess InPython(const testing::Scratch& folder, const std::string& loop,
                       const std::string& version = "'1'", const std::string& accuracy = "1e-6",
                       const std::string& law = "frictionless") {
  const std::filesystem::path file = folder / "solver.py";
  std::ofstream(file) << "#!/usr/bin/env python3\nimport json, os, sys\n"
                      << "print(json.dumps(dict(protocol=1, solver='x', law='" << law
                      << "', version=" << version << ", accuracy=" << accuracy
                      << ")), flush=True)\nkept = []\nfor line in sys.stdin: " << loop << "\n";
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return SolverProcess({file.string()});
}

ContactProblem<double> Idle() {
  ContactProblem<double> problem;
  problem.contacts = {{ContactKind::kFrictionless, 0, {}}};
  problem.A = problem.b = Eigen::MatrixXd::Zero(1, 1);
  return problem;
}

// A program that answers f = 0; its first process makes a file and sleeps instead, or all of them do.
std::filesystem::path Sleeper(const testing::Scratch& folder, bool for_ever) {
  const std::filesystem::path file = folder / "sleeper.sh", woken = folder / "woken";
  std::ofstream(file) << "#!/bin/sh\n"
                         "echo '{\"protocol\": 1, \"solver\": \"x\", \"version\": \"1\", \"law\": "
                         "\"frictionless\", \"accuracy\": 1e-6}'\n"
                      << "while read -r line; do\n  if [ ! -e " << woken << " ]; then "
                      << (for_ever ? "" : "touch " + woken.string() + "; ") << "exec sleep 100; fi\n"
                      << "  echo '{\"solved\": true, \"f\": [0]}'\ndone\n";
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return file;
}

}  // namespace

TEST_CASE("under test: what waits is asked once more before it is said to hang") {
  const ContactProblem<double> problem = Idle();
  constexpr double kSeconds = 0.1;  // twice half a second on the clock
  for (const bool for_ever : {false, true}) {
    const testing::Scratch folder;
    SolverProcess process({Sleeper(folder, for_ever).string()});
    const SolverReply reply = process.Solve(problem, kSeconds);
    CHECK((reply.end == SolverEnd::kHung) == for_ever);
    CHECK(reply.how == (for_ever ? kAsleep : ""));
    // It costs its limit and no more: the time in which it sleeps counts as what it takes.
    if (for_ever) CHECK(process.Seconds() >= kSolverPatience * kSeconds);
  }
}

TEST_CASE("under test: a call that the search stops ends at once, and is no answer, no crash and no hang") {
  const testing::Scratch folder;
  bool stopped = false;
  SolverProcess process({Sleeper(folder, true).string()}, [&stopped] { return stopped; });
  stopped = true;
  CHECK(process.Solve(Idle(), 1e6).end == SolverEnd::kStopped);
  CHECK(process.Solve(Idle(), 1e6).end == SolverEnd::kStopped);  // nor is it started anew
  stopped = false;
  CHECK(process.Solve(Idle(), 0.01).end == SolverEnd::kHung);
}

TEST_CASE("under test: memory that grows steadily leaks, and what fills up or is collected late does not") {
  constexpr std::int64_t kCalls = 8000, kLeast = 1 << 16;
  const auto growth = [](auto memory) {
    MemoryWindows windows(kCalls, kLeast);
    for (std::int64_t call = 1; call <= kCalls; ++call) windows.Add(call, memory(call));
    return windows.Growth();
  };
  constexpr std::int64_t kFirst = 50'000'000;
  CHECK(growth([](std::int64_t call) { return kFirst + 48 * call; }) == 48);
  CHECK(growth([](std::int64_t call) { return kFirst + 4096 * (64 * call / 4096); }) > 60);  // page by page
  CHECK(growth([](std::int64_t call) { return kFirst + 4 * call; }) == 0);                   // hardly anything
  CHECK(growth([](std::int64_t) { return kFirst; }) == 0);
  CHECK(growth([](std::int64_t call) { return kFirst + 5000 * std::min<std::int64_t>(call, 1200); }) == 0);
  CHECK(growth([](std::int64_t call) {
          return kFirst + 1'000'000 * std::bit_width(static_cast<std::uint64_t>(call));
        }) == 0);
  CHECK(growth([](std::int64_t call) { return kFirst + std::llround(1e5 * std::sqrt(call)); }) == 0);
  CHECK(growth([](std::int64_t call) { return kFirst + 5000 * (call % 3000); }) == 0);  // it falls now and then
  CHECK(growth([](std::int64_t call) { return call == 2000 ? 0 : kFirst + 48 * call; }) ==
        0);  // a process ended
}

TEST_CASE("under test: a library runs in a process of this program, whatever the version behind its name") {
  CHECK(SolverCommand("/a/mine.so").size() == 3);
  CHECK(SolverCommand("/a/mine.so.1").size() == 3);
  CHECK(SolverCommand("/a/mine.so.d/mine.py") == std::vector<std::string>{"/a/mine.so.d/mine.py"});
}

TEST_CASE("under test: what lacks forces or has too many is no answer, and a lack of numbers is one") {
  const testing::Scratch folder;
  const auto reply = [&folder](const std::string& said) {
    return InPython(folder, "print('" + said + "', flush=True)").Solve(Idle(), 10);
  };
  CHECK(reply(R"({"solved": true, "f": [0]})").end == SolverEnd::kAnswered);
  CHECK(reply(R"({"solved": false})").end == SolverEnd::kAnswered);
  CHECK(std::isnan(reply(R"({"solved": true, "f": [-Infinity]})").f[0]));
  for (const char* const number : {"1e999", "-1E+400", "1e308000000000"}) {
    CAPTURE(number);
    const SolverReply beyond = reply(fmt::format(R"({{"solved": true, "f": [{}]}})", number));
    CHECK(beyond.end == SolverEnd::kAnswered);
    CHECK(std::isnan(beyond.f[0]));
    CHECK_FALSE(beyond.is_in_range);
  }
  const SolverReply tiny = reply(R"({"solved": true, "f": [1e-999], "NaN": "1e999 NaN \\" 1e999"})");
  CHECK((tiny.end == SolverEnd::kAnswered && tiny.is_in_range && tiny.f[0] == 0));
  for (const char* const said :
       {R"({"solved": true})", R"({"solved": true, "f": [0, 0]})", R"({"solved": true, "f": []})",
        R"({"solved": true, "f": ["0"]})", R"({"solved": true, "f": [true]})",
        R"({"solved": false, "f": [0], "solved": true})", R"({"solved": true, "f": [1], "f": [0]})", "no"}) {
    CAPTURE(said);
    CHECK(reply(said).how == "garbled");
  }
}

TEST_CASE("under test: what ends after it took most of its memory is out of it") {
  const testing::Scratch folder;
  const std::string answers = "print('{\"solved\": false}', flush=True)";
  auto greedy = InPython(folder, "os.close(2) if kept else 0; kept.append(bytearray(300 << 20)); " + answers);
  CHECK(greedy.Solve(Idle(), 10).end == SolverEnd::kAnswered);
  CHECK(greedy.Solve(Idle(), 10).how == "out-of-memory");
  CHECK(InPython(folder, "sys.exit(1)").Solve(Idle(), 10).how == "exit-1");
}

TEST_CASE(
    "under test: what writes too much, closes its output or does not greet again crashes, and is named so") {
  const testing::Scratch folder;
  const auto how = [&folder](const std::string& loop, int calls = 1) {
    SolverProcess process = InPython(folder, loop);
    std::string said;
    for (int call = 0; call < calls; ++call) said = process.Solve(Idle(), 10).how;
    return said;
  };
  const std::string answer = "print('{\"solved\": true, \"f\": [0]}', flush=True)";
  CHECK(how("sys.stdout.write('x' * (1 << 22)); sys.stdout.flush()") == "flood");
  CHECK(how("print('x' * (1 << 22), flush=True)") == "flood");
  CHECK(how("os.write(1, b'{\"solved\": true, \"f\": [0]}\\n' * 2)", 2) == "unasked");
  CHECK(how("os.close(0); os.close(1); __import__('time').sleep(1000)") == "closed");
  CHECK(how("os.kill(os.getppid(), 9); __import__('time').sleep(1000)") == "killed-its-guard");
  CHECK(how("sys.exit(0) if os.fork() else __import__('time').sleep(1000)") ==
        "exit-0");  // its child holds the output
  const std::string file = (folder / "greeted").string();
  CHECK(how("sys.exit(1); #\nif 0: pass", 1) == "exit-1");
  std::ofstream(folder / "again.py")
      << "#!/usr/bin/env python3\nimport os, sys\nif os.path.exists('" << file << "'): sys.exit(1)\nopen('"
      << file
      << "', 'w')\nprint('{\"protocol\": 1, \"solver\": \"x\", \"version\": \"1\", "
         "\"law\": \"box\", \"accuracy\": 1}', flush=True)\nsys.stdin.readline()\n";
  std::filesystem::permissions(folder / "again.py", std::filesystem::perms::owner_all);
  SolverProcess again({(folder / "again.py").string()});
  CHECK(again.Solve(Idle(), 10).how == "exit-0");
  CHECK(again.Solve(Idle(), 10).how == "no-greeting");
}

TEST_CASE("under test: a solver is the same as long as it is tested, and states an accuracy") {
  const testing::Scratch folder;
  auto other = InPython(folder, "sys.exit(1)", "str(os.getpid())");
  CHECK(other.Solve(Idle(), 10).how == "exit-1");
  CHECK_THROWS_WITH(other.Solve(Idle(), 10), Catch::Contains("found another solver than before"));
  auto same = InPython(folder, "sys.exit(1)");
  CHECK(same.Solve(Idle(), 10).how == "exit-1");
  CHECK(same.Solve(Idle(), 10).how == "exit-1");
  for (const char* const accuracy : {"0", "-1", "'1'"})
    CHECK_THROWS_WITH(InPython(folder, "pass", "'1'", accuracy), Catch::Contains("a number above 0"));
}

TEST_CASE("under test: fixed bounds are none where no force moves the contact") {
  const std::vector<double> bounds = {0.5 * 3 / 2, 0};
  CHECK(FixedBounds(OneContact(0.5, {2, 3}, {-3, 1}))[0] == bounds[0]);
  CHECK(FixedBounds(OneContact(0.5, {0, 3}, {-3, 1}))[0] == bounds[1]);
  // A program is told them under the law of boxes alone.
  const testing::Scratch folder;
  for (const char* const law : {"box", "pyramid"}) {
    auto echo = InPython(
        folder, "print(json.dumps(dict(solved=True, f=json.loads(line).get('bounds', [0]) + [0])), flush=True)",
        "'1'", "1e-6", law);
    const SolverReply reply = echo.Solve(OneContact(0.5, {2, 3}, {-3, 1}), 10);
    REQUIRE(reply.end == SolverEnd::kAnswered);
    CHECK(reply.f[0] == (echo.about().law == SolverLaw::kBox ? bounds[0] : 0));
  }
}

TEST_CASE("under test: a solution is known of the laws of the plane, and of fixed bounds in space") {
  const auto problem = OneContact(1, {2, 3}, {-1, 1});
  for (const SolverLaw law : kLawsWithFriction) {
    const auto f = SolutionUnder(law, problem);
    REQUIRE(f.has_value());
    CHECK((*f)[0] == Rational(1, 2));
    CHECK((*f)[1] == Rational(-1, 3));
  }
  // Friction presses the contact, so the laws part: under findex the bound is that of fN = 1 alone.
  ContactProblem<double> pressed = OneContact(1, {2, 2}, {-2, 4});
  pressed.A(0, 1) = pressed.A(1, 0) = 1;
  const ExactProblem::Vector within{{Rational(3, 2), Rational(-1)}}, coulomb{{Rational(2), Rational(-2)}};
  CHECK((*SolutionUnder(SolverLaw::kFindex, pressed) == within));
  CHECK((*SolutionUnder(SolverLaw::kCoulomb, pressed) == coulomb));
  ContactProblem<double> space;
  space.dimension = 3;
  space.contacts = {{ContactKind::kStatic, 0.5, {}}};
  space.A = Eigen::Matrix3d::Identity();
  space.b = Eigen::Vector3d(-2, 3, -0.5);
  const ExactProblem::Vector expected{{Rational(2), Rational(-1), Rational(1, 2)}};  // each tangent for itself
  CHECK((*SolutionUnder(SolverLaw::kFindex, space) == expected));
  CHECK((*SolutionUnder(SolverLaw::kBox, space) == expected));
  CHECK(NearSolution(space).has_value());
  CHECK_FALSE(SolutionUnder(SolverLaw::kCoulomb, space).has_value());
  CHECK(SolutionUnder(SolverLaw::kFrictionless, PosedFor(SolverLaw::kFrictionless, space)).has_value());
}

namespace {

// Of two contacts with friction before one without, so that A takes as many lines as any: A = diag(1, ...,
// rows), b = -1.
Finding FoundBy(std::string_view kind, int dimension, bool is_library) {
  ExactProblem problem;
  problem.dimension = dimension;
  problem.contacts.assign(3, {ContactKind::kStatic, Rational(1, 2), {}});
  problem.contacts[2] = {ContactKind::kFrictionless, 0, {}};
  const int rows = 2 * dimension + 1;
  problem.A = ExactProblem::Matrix::Zero(rows, rows);
  for (int i = 0; i < rows; ++i) problem.A(i, i) = i + 1;
  problem.b = ExactProblem::Vector::Constant(rows, Rational(-1));
  ProblemFile file;
  file.problem = std::move(problem);
  Finding finding;
  finding.kind = kind;
  finding.signature = fmt::format("{}-3c", kind);
  finding.problem = Print(file);
  finding.facts = fmt::format(R"({{"library": {}, "found": {{"kind": "{}", "what": ""}}}})", is_library, kind);
  return finding;
}

bool HasLaw(std::string_view package, SolverLaw law) {
  if (package == "c" || package == "python" || law == SolverLaw::kFrictionless) return true;
  return law == (package == "siconos" ? SolverLaw::kCoulomb : SolverLaw::kFindex);
}

}  // namespace

TEST_CASE("under test: a finding of any kind, law and dimension is a program of at most 60 lines") {
  constexpr SolverLaw kLaws[] = {SolverLaw::kFrictionless, SolverLaw::kBox, SolverLaw::kFindex,
                                 SolverLaw::kPyramid, SolverLaw::kCoulomb};
  int programs = 0;
  for (const SolverLaw law : kLaws)
    for (const std::string_view name : kReproducerNames)
      for (const int dimension : {2, 3})
        for (const bool is_library : {true, false})
          for (const std::string_view kind :
               {"crash", "hang", "leak", "not-finite", "silent-wrong", "refused-solvable"})
            for (const std::string_view solver : {"dantzig", "lemke", "nsgs", "nsn-ac"}) {
              if (name == "c" && !is_library) continue;
              CAPTURE(kSolverLawNames[static_cast<std::size_t>(law)], name, dimension, is_library, kind,
                      solver);
              const SolverUnderTest about = {std::string(solver), "1", law, "1e-06"};
              const Finding finding = FoundBy(kind, dimension, is_library);
              const auto write = [&] { return ReproducerOf(finding, about, name, "shown.c"); };
              if (!HasLaw(name, law)) {
                CHECK_THROWS_WITH(write(), Catch::Contains("c and python have all"));
                continue;
              }
              const std::string text = write();
              CHECK(std::ranges::count(text, '\n') <= 60);
              CHECK(text.find('@') == text.npos);  // what is not filled in
              CHECK(text.find(finding.signature) < text.find("shown"));
              ++programs;
            }
  CHECK(programs > 1000);
}

TEST_CASE("under test: a program has the minimized problem, and the bounds and units that its law gives") {
  ExactProblem problem;
  problem.contacts = {{ContactKind::kStatic, Rational(1, 2), {}}, {ContactKind::kBilateral, 0, {}}};
  problem.A = ExactProblem::Matrix::Identity(3, 3);
  problem.b = ExactProblem::Vector{{Rational(-4), Rational(0), Rational(1)}};
  ProblemFile file;
  file.problem = std::move(problem);
  Finding finding = FoundBy("silent-wrong", 2, true);
  finding.minimized = Print(file);
  finding.facts = R"({"library": true, "found": {"what": "pulls"}, "minimized": {"what": "moves-inward"}})";
  const auto text = [&finding](SolverLaw law, std::string_view name = "python", const char* to = "shown.py") {
    return ReproducerOf(finding, {"x", "1", law, "1e-06"}, name, to);
  };
  using Catch::Contains;
  const std::string coulomb = text(SolverLaw::kCoulomb);
  CHECK_THAT(coulomb,
             Contains("B = [-4, 0, 1]\nLOW = [0, -0.5, -math.inf]\nHIGH = [math.inf, 0.5, math.inf]\n"));
  CHECK_THAT(coulomb, Contains("FORCE = [8, 4, 2]"));  // friction: half of what acts at the normal
  CHECK_THAT(coulomb, Contains("a contact moves inward") && !Contains("a contact pulls"));
  CHECK_THAT(text(SolverLaw::kBox), Contains("LOW = [0, -2, "));  // mu abs(b) / A
  CHECK_THAT(text(SolverLaw::kCoulomb, "c", "a.b.c"), Contains(" -o a.b "));
  CHECK_THAT(text(SolverLaw::kCoulomb, "c", ".c"), Contains(" -o .c-program "));
  CHECK_THAT(text(SolverLaw::kCoulomb, "c", "shown"), Contains(" -o shown-program "));
}

TEST_CASE("under test: a scene is made simpler while the solver fails alike on its problem") {
  Campaign campaign;
  campaign.generators = {GeneratorId::kScenes};
  campaign.contacts = {4};
  campaign.solver = {"toy", "1", SolverLaw::kCoulomb, "1e-06"};
  const auto never = [] { return false; };
  Finding finding;
  finding.signature = "silent-wrong-pulls-4c";
  int asked = 0;
  const auto two_press = [&](const ContactProblem<double>& posed) {
    ++asked;
    return posed.contacts.size() >= 2 && posed.contacts[0].mu == 0.5 && posed.b[0] < 0;
  };
  while (!(Rounded<double>(Regenerate(campaign, 0, finding.index).problem).b[0] < 0)) ++finding.index;
  const auto scene = SimpleSceneOf(finding, campaign, two_press, never);
  REQUIRE(scene.has_value());
  CHECK(scene->contacts <= 4);
  CHECK(scene->mu == MuChoice{1, 2});  // the one of the campaign's with which it fails
  CHECK(asked > 10);
  const ProblemFile file = PosedFileOf(*scene, SolverLaw::kCoulomb, "simple");
  CHECK(file.scene);
  CHECK(two_press(Rounded<double>(file.problem)));
  CHECK(CandidateOf(file, "simple") == *scene);
  CHECK_FALSE(SimpleSceneOf(finding, campaign, two_press, [] { return true; }).has_value());
  CHECK_FALSE(SimpleSceneOf(
                  finding, campaign, [](const ContactProblem<double>&) { return false; }, never)
                  .has_value());
  // Without friction the solver is given normals alone, of a scene without friction.
  campaign.solver.law = SolverLaw::kFrictionless;
  const auto any = [](const ContactProblem<double>& posed) { return posed.rows() >= 2; };
  const auto smooth = SimpleSceneOf(finding, campaign, any, never);
  REQUIRE(smooth.has_value());
  CHECK(smooth->mu == MuChoice{0, 1});
  CHECK(PosedFileOf(*smooth, SolverLaw::kFrictionless, "smooth").problem.rows() == 2);
  campaign.generators = {GeneratorId::kIntegers};
  CHECK_FALSE(SimpleSceneOf(finding, campaign, any, never).has_value());
}

TEST_CASE("under test: what is minimized fails in the same way and is what bodies make") {
  // It crashes in one way where two contacts are coupled, in another where there is one; so does much that no
  // bodies make. All else it gives up.
  const std::string give_up = "print(json.dumps(dict(solved=False)), flush=True)";
  const testing::Scratch folder;
  SolverProcess process = InPython(
      folder,
      "A = json.loads(line)['A']; len(A) == 1 and os._exit(4); A[0][1] >= 4 and os._exit(3); " + give_up);
  Campaign campaign;
  campaign.solver = process.about();
  campaign.generators = {GeneratorId::kIntegers};
  campaign.contacts = {2};
  ExactProblem problem;
  problem.contacts.assign(2, {ContactKind::kFrictionless, 0, {}});
  problem.A = testing::Matrix({{8, 4}, {4, 8}});
  problem.b = testing::Vector({-9, -7});
  ProblemFile file;
  file.problem = problem;
  Finding finding;
  finding.signature = "crash-exit-3-2c";
  finding.kind = "crash";
  finding.generator = "integers";
  finding.contacts = 2;
  finding.problem = JsonText(ToJson(file));
  finding.facts = R"({"library": false, "found": {"contacts": 2, "kind": "crash", "what": "exit-3"}})";
  const auto finished = FinishSolverFinding(finding, campaign, process, [] { return false; });
  REQUIRE(finished.has_value());
  REQUIRE_FALSE(finished->minimized.empty());
  CHECK(Json::parse(finished->facts).at("minimized").at("what") == "exit-3");
  const ExactProblem small = ParseProblem(finished->minimized, "minimized").problem;
  REQUIRE(small.rows() == 2);
  CHECK(small.A(0, 0) < 8);  // simpler than it was
  CHECK(small.A(0, 1) == 4);
  CHECK(small.A(0, 0) * small.A(1, 1) >= 16);
  CHECK(small.A(0, 0) > 0);
  CHECK((small.b[0] != 0 || small.b[1] != 0));

  // Of rows that nothing moves every failure of two contacts would be made.
  SolverProcess any = InPython(folder, "os._exit(len(json.loads(line)['A']))", "'2'");
  campaign.solver = any.about();
  finding.signature = "crash-exit-2-2c";
  finding.facts = R"({"library": false, "found": {"contacts": 2, "kind": "crash", "what": "exit-2"}})";
  const auto least = FinishSolverFinding(finding, campaign, any, [] { return false; });
  REQUIRE(least.has_value());
  const ExactProblem moved = ParseProblem(least->minimized, "minimized").problem;
  CHECK(moved.A(0, 1) == 0);
  CHECK(moved.A(0, 0) > 0);
  CHECK(moved.A(1, 1) > 0);
}

TEST_CASE("under test: a campaign names the solver, and is another with another one") {
  Campaign campaign;
  const CampaignIdentity without = IdentityOf(campaign);
  campaign.solver = {"toy", "1", SolverLaw::kFindex, "1e-06"};
  CHECK(CampaignOf(IdentityOf(campaign), "here") == campaign);
  CHECK_FALSE(IdentityOf(campaign) == without);
  Campaign other = campaign;
  other.solver.version = "2";
  CHECK_FALSE(IdentityOf(other) == IdentityOf(campaign));
  other.objective = "steps";
  CHECK_THROWS_WITH(RequireConsistent(other), Catch::Contains("expected error or time"));
  other.objective = "error";
  CHECK_NOTHROW(RequireConsistent(other));
  other.generators = {GeneratorId::kSpace};
  CHECK_NOTHROW(RequireConsistent(other));
  other.generators = {GeneratorId::kBilateral};
  CHECK_THROWS_WITH(RequireConsistent(other), Catch::Contains("bilateral"));
  other.generators = {GeneratorId::kPsd};
  other.solver = {};
  CHECK_THROWS_WITH(RequireConsistent(other), Catch::Contains("--solver"));
  Campaign sliding = campaign;
  sliding.generators = {GeneratorId::kSliding};
  CHECK_THROWS_WITH(RequireConsistent(sliding), Catch::Contains("without sliding contacts"));
}

TEST_CASE("under test: statistics are read back as they were written, and add up") {
  Record record;
  UnderTestTally& tally = record.under_test[{"psd", 2, "1/2", 3, 1}];
  tally.problems = 5;
  tally.passed = 3;
  tally.crash = 2;
  tally.leak = 1;
  CHECK(ParseRecord(Serialize(record)) == record);
  Record twice = record;
  twice.Merge(record);
  CHECK(twice.under_test.begin()->second.passed == 6);
  CHECK(Serialize(Record{}).find("under_test") == std::string::npos);
}

}  // namespace stiction
