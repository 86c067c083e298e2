// SPDX-License-Identifier: Apache-2.0
// The fuzz targets in ordinary builds: inputs that once failed, and a few hundred others.

#include <catch2/catch.hpp>
#include <filesystem>
#include <sstream>

#include "certify/claims/certificate.h"
#include "certify/request/solve_in.h"
#include "corpus/input_file.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "tests/fuzz/claims.h"
#include "tests/fuzz/extreme.h"
#include "tests/fuzz/json_mutation.h"
#include "tests/fuzz/targets.h"
#include "tests/judge.h"
#include "tests/support.h"

namespace stiction::fuzz {
namespace {

namespace fs = std::filesystem;
using namespace testing;

const fs::path kSources = STICTION_SOURCES;

// ---- Inputs ---------------------------------------------------------------------------------------

std::vector<fs::path> FilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

struct Seeds {
  std::vector<std::string> texts;
  std::size_t most = 0;  // bytes
};

// Of targets.json; a file of lines holds one each.
Seeds SeedsOf(const Target& target) {
  static const Json table = ParseJson(ReadText(kSources / "tests/fuzz/targets.json"), "targets.json");
  const Json& row = table.at(std::string(target.name));
  Seeds seeds{{}, row.at("bytes").get<std::size_t>()};
  for (const Json& folder : row.at("seeds")) {
    for (const fs::path& file : FilesIn(kSources / folder.get<std::string>())) {
      std::istringstream text(ReadText(file));
      if (file.extension() == ".lines") {
        for (std::string line; std::getline(text, line);) seeds.texts.push_back(line);
      } else if (file.extension() == ".json" || file.extension() == ".dat") {
        if (text.str().size() <= seeds.most) seeds.texts.push_back(text.str());
      }
    }
  }
  return seeds;
}

std::int64_t Any(Choices& choices, std::size_t below) {
  return choices.Integer(0, std::max<std::int64_t>(static_cast<std::int64_t>(below) - 1, 0));
}

// A byte or a part changed, lost, or doubled.
std::string MutatedBytes(std::string text, Choices& choices) {
  for (std::int64_t count = choices.Integer(1, 3); count > 0 && !text.empty(); --count) {
    const auto at = static_cast<std::size_t>(Any(choices, text.size()));
    const auto size = static_cast<std::size_t>(choices.Integer(1, 12));
    switch (choices.Integer(0, 3)) {
      case 0:
        text[at] = static_cast<char>(choices.Integer(0, 255));
        break;
      case 1:
        text.erase(at, size);
        break;
      case 2:
        text.insert(at, text.substr(static_cast<std::size_t>(Any(choices, text.size())), size));
        break;
      default:
        text[at] = "0123456789-+./eE\"[]{}, "[Any(choices, 23)];
    }
  }
  return text;
}

std::string RandomBytes(std::size_t size, Choices& choices) {
  std::string bytes;
  while (bytes.size() < size) bytes += static_cast<char>(choices.Integer(0, 255));
  return bytes;
}

// What a target says to an input: taken, refused, or what it throws.
struct Taken {
  bool taken = false;
  std::string fault;
};
Taken Try(const Target& target, const std::string& input) {
  try {
    return {target.run(input), ""};
  } catch (const std::exception& fault) {
    return {false, fault.what()};
  }
}

// ---- Tests ----------------------------------------------------------------------------------------

TEST_CASE("targets: inputs that once failed are taken or refused") {
  int files = 0;
  for (const Target& target : Targets()) {
    for (const fs::path& file : FilesIn(kSources / "tests/fuzz/findings" / target.name)) {
      CAPTURE(file);
      CHECK(Try(target, ReadInput(file, kMostInputBytes)).fault.empty());
      ++files;
    }
  }
  CHECK(files > 0);
}

TEST_CASE("targets: seeds, and seeds that are changed at random, are taken or refused") {
  constexpr int kInputs = 200;
  for (const Target& target : Targets()) {
    const Seeds seeds = SeedsOf(target);
    int taken = 0, refused = 0;
    for (const std::string& seed : seeds.texts) {
      CAPTURE(target.name, seed);
      CHECK(Try(target, seed).fault.empty());
    }
    Choices choices(1994);
    for (int k = 0; k < kInputs && !seeds.texts.empty(); ++k) {
      const std::string& seed = seeds.texts[static_cast<std::size_t>(Any(choices, seeds.texts.size()))];
      const bool document = seed.starts_with('{') && choices.Integer(0, 2) > 0;
      const std::string input = document ? MutatedJson(seed, choices) : MutatedBytes(seed, choices);
      if (input.size() > seeds.most) continue;
      const Taken result = Try(target, input);
      CAPTURE(target.name, input, result.fault);
      CHECK(result.fault.empty());
      ++(result.taken ? taken : refused);
    }
    CAPTURE(target.name, taken, refused);
    CHECK((seeds.texts.empty() || (taken > 0 && refused > 0)));
  }
}

TEST_CASE("targets: every method in every arithmetic on problems at extremes") {
  constexpr int kProblems = 60;
  const Target solve = {"solve", &FuzzSolve};
  Choices choices(1994);
  int taken = 0;
  for (int k = 0; k < kProblems; ++k) {
    std::string input = RandomBytes(static_cast<std::size_t>(choices.Integer(8, 200)), choices);
    input[0] = '\0';  // all of them
    const Taken result = Try(solve, input);
    CAPTURE(k, result.fault);
    CHECK(result.fault.empty());
    taken += result.taken;
  }
  CHECK(taken > kProblems / 2);
}

TEST_CASE("targets: certificates of problems at extremes are accepted") {
  const Target certify = {"certify", &FuzzCertify};
  Choices choices(1994);
  for (int k = 0; k < 100; ++k) {
    const Taken result = Try(certify, RandomBytes(static_cast<std::size_t>(choices.Integer(8, 120)), choices));
    CAPTURE(k, result.fault);
    CHECK(result.fault.empty());
    CHECK(result.taken);
  }
}

TEST_CASE("problems: any bytes are a valid problem, and zeros an ordinary one") {
  Choices choices(7);
  int contacts = 0, space = 0, extreme = 0;
  for (int k = 0; k < 300; ++k) {
    const std::string input = RandomBytes(static_cast<std::size_t>(choices.Integer(0, 200)), choices);
    Bytes bytes(input);
    ProblemFile file;
    file.problem = ExtremeProblem(bytes);
    CHECK_NOTHROW(ParseProblem(Print(file), "text"));
    contacts = std::max(contacts, static_cast<int>(file.problem.contacts().size()));
    space += file.problem.dimension() == 3;
    extreme += !Unrefused([&file] { return Rounded<double>(file.problem); });
  }
  CHECK(contacts == 4);
  CHECK(space > 100);
  CHECK(extreme > 10);
  Bytes none("");
  const ExactProblem problem = ExtremeProblem(none);
  CHECK(problem.contacts.size() == 1);
  CHECK(MeetsAssumptions(problem));
}

// ---- What would find a fault ------------------------------------------------------------------------

TEST_CASE("judge: forces that are no solution are not called one") {
  for (const int dimension : {2, 3}) {
    ExactProblem problem = MakeProblem({1}, {{2, 0}, {0, 3}}, {-1, 1});
    if (dimension == 3) {
      problem.dimension = 3;
      problem.A = Matrix({{2, 0, 0}, {0, 3, 0}, {0, 0, 3}});
      problem.b = Vector({-1, 1, 0});
    }
    for (const Arithmetic arithmetic : {Arithmetic::kExact, Arithmetic::kDouble, Arithmetic::kFloat}) {
      const Request request{.method = "complete", .arithmetic = arithmetic};
      Solution solution = SolveIn(problem, request);
      CAPTURE(dimension, Name(arithmetic));
      CHECK(FaultOf(problem, request, solution).empty());
      std::visit([](auto& answer) { answer.f[0] += 0.001; }, solution.answer);
      CHECK(!FaultOf(problem, request, solution).empty());
      std::visit([](auto& answer) { answer.f.resize(0); }, solution.answer);
      CHECK(FaultOf(problem, request, solution) == "solved without forces");
    }
  }
}

TEST_CASE("judge: the paper's law in space") {
  const auto holds = [](const ExactProblem& problem, const ExactVector& f, double eps) {
    return !FindMiss(problem, f, FrictionLaw::kBaraff, Gate{eps, eps * GateOf<double>().theta()});
  };
  ExactProblem problem = MakeProblem({1}, {{1, 0}, {0, 1}}, {-5, 0});
  problem.dimension = 3;
  problem.A = ExactMatrix::Identity(3, 3);
  problem.b = Vector({-5, -3, -4});
  CHECK(holds(problem, Vector({5, 3, 4}), 0));   // sticks
  CHECK(!holds(problem, Vector({5, 3, 3}), 0));  // slips inside of the cone
  CHECK(holds(problem, Vector({5, 3, Number("3.9")}), 0.04));
  CHECK(!holds(problem, Vector({5, 3, Number("3.9")}), 0.005));
  problem.contacts[0].mu = Number("0.5");
  CHECK(holds(problem, Vector({5, Number("1.5"), 2}), 0));     // slips, at the limit
  CHECK(!holds(problem, Vector({5, Number("-1.5"), -2}), 0));  // pushes along
  CHECK(!holds(problem, Vector({5, 3, 4}), 0.1));              // out of the cone
}

TEST_CASE("claims: a false one is noticed, whatever the checker says of it") {
  const ExactProblem cycling = ReferenceProblem(), none = NoSolution();
  const auto fault = [](const ExactProblem& problem, const char* claim, const Json& witness = Json::object()) {
    const Json certificate = {{"claim", claim}, {"problem", ProblemToJson(problem)}, {"witness", witness}};
    return !FaultOfClaim(certificate).empty();
  };
  ExactProblem asymmetric = cycling;
  asymmetric.A(0, 1) += 1;
  CHECK(fault(none, "solution-exists"));
  CHECK(fault(cycling, "no-solution"));
  CHECK(fault(asymmetric, "symmetric"));
  CHECK(fault(cycling, "not-symmetric"));
  CHECK(fault(asymmetric, "psd"));
  CHECK(fault(cycling, "not-psd"));
  CHECK(fault(none, "in-range"));
  CHECK(fault(cycling, "not-in-range"));
  CHECK(fault(none, "h"));
  CHECK(fault(cycling, "not-h"));
  CHECK(fault(cycling, "safe"));
  CHECK(fault(cycling, "safe-by-condition"));
  const Json runs = ParseJson(R"({"runs": [{"policies": ["paper"]}]})", "runs");
  CHECK(fault(none, "cycle", runs));
  CHECK(!fault(cycling, "cycle", runs));
  CHECK(!fault(cycling, "unsafe"));
}

TEST_CASE("documents: changed ones stay documents") {
  const std::string text = R"({"a": [1, "1/3", {"b": "{\"c\": [2]}"}], "d": null})";
  Choices choices(3);
  int changed = 0, inside = 0;
  for (int k = 0; k < 300; ++k) {
    const std::string other = MutatedJson(text, choices);
    CHECK_NOTHROW(ParseJson(other, "changed"));
    changed += ParseJson(other, "changed") != ParseJson(text, "text");
    inside += other.find(R"({\"c\":)") != other.npos && other.find(R"({\"c\":[2]})") == other.npos;
  }
  CHECK(changed > 200);
  CHECK(inside > 5);
  CHECK(MutatedJson("{nonsense", choices) == "{nonsense");
}

}  // namespace
}  // namespace stiction::fuzz
