// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/feasibility_nlp.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "certify/exact/line_process.h"
#include "certify/exact/nearby_words.h"
#include "certify/exact/qp.h"
#include "corpus/json.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kProtocol = 1;
constexpr double kGreetingPatience = 30;  // seconds; loading libraries on a busy machine

// Whether `line` is what a program of this protocol says first.
bool IsGreeting(const std::string& line) {
  const Json json = Json::parse(line, nullptr, false);
  return json.is_object() && json.value("program", Json()) == "stiction-ipopt" &&
         json.value("protocol", Json()) == kProtocol;
}

// Runs the program and waits for its greeting. InputError if it cannot be run, or does not speak the protocol.
std::unique_ptr<LineProcess> StartIpopt(const std::filesystem::path& program) {
  auto process = std::make_unique<LineProcess>(std::vector{program.string()}, "the program stiction-ipopt");
  const LineProcess::Line line = process->Read(LineProcess::After(kGreetingPatience));
  if (line.end == LineProcess::End::kLine && IsGreeting(line.text)) return process;
  throw InputError(fmt::format(
      "{}: found {}, expected the program stiction-ipopt, protocol {}", program.string(),
      line.end == LineProcess::End::kLine ? "\"" + Shortened(line.text) + "\"" : "no greeting", kProtocol));
}

double SecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

// ---- Requests ------------------------------------------------------------------------------------

namespace {

// One start a request, since words near a point that is no solution may have one: the first, to be changed.
Json MakeRequest(const ExactProblem& problem, const ScaledProblem& scaled, const ProposalOptions& options) {
  Json contacts = Json::array();
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    Json& contact = contacts.emplace_back(Json{{"kind", Name(problem.contacts[i].kind)}});
    if (problem.contacts[i].HasFrictionRows()) contact["mu"] = scaled.numbers.contacts[i].mu;
    if (problem.contacts[i].kind == ContactKind::kSliding) contact["slip"] = scaled.numbers.contacts[i].slip[0];
  }
  Json A = Json::array();
  for (const auto& row : scaled.numbers.A.rowwise()) A.push_back(std::vector<double>(row.begin(), row.end()));
  const auto& b = scaled.numbers.b;
  const bool quadratic = options.formulation == Formulation::kQuadratic;
  return {{"dimension", problem.dimension},
          {"contacts", contacts},
          {"A", A},
          {"b", std::vector<double>(b.begin(), b.end())},
          {"options",
           {{"first_start", 0},
            {"max_iterations", options.max_iterations},
            {"starts", 1},
            {"seed", options.seed},
            {"formulation", quadratic ? "qp" : "nlp"}}}};
}

void RequireHandled(const ExactProblem& problem, const ProposalOptions& options) {
  STICTION_CHECK(options.starts >= 1 && options.max_iterations >= 1 && options.words >= 1,
                 "ipopt: starts, iterations and words are at least 1");
  STICTION_CHECK(options.patience > 0 && options.patience <= 1e6, "ipopt: patience is from 0 to 1e6 seconds");
  if (problem.dimension != 2) throw InputError("dimension: found 3, expected 2 for ipopt");
  if (options.formulation == Formulation::kQuadratic) RequireFrictionless(problem);
}

}  // namespace

std::filesystem::path FindIpoptProgram() {
  static constexpr const char* kName = "stiction-ipopt";
  std::error_code error;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* place : {"", "..", "certify/ipopt", "../certify/ipopt"}) {
    const auto candidate = (folder / place / kName).lexically_normal();
    if (std::filesystem::is_regular_file(candidate, error)) return candidate;
  }
  // The Python package, in a build or below /usr/lib: the executable is an interpreter, which need not be that
  // of /usr/bin, and what holds this code a library.
  if (Dl_info library; dladdr(reinterpret_cast<void*>(&FindIpoptProgram), &library) != 0) {
    const auto package = std::filesystem::absolute(library.dli_fname, error).parent_path();
    for (const char* place : {"../../..", "../../../../bin"}) {
      const auto candidate = (package / place / kName).lexically_normal();
      if (std::filesystem::is_regular_file(candidate, error)) return candidate;
    }
  }
  return folder / kName;
}

// What the process answered.
struct IpoptProposer::Point {
  std::vector<double> f;
  int starts = 0;
};

// ---- The proposer --------------------------------------------------------------------------------

IpoptProposer::IpoptProposer(const std::filesystem::path& program)
    : program_(program), process_(StartIpopt(program)) {}

IpoptProposer::~IpoptProposer() = default;

int IpoptProposer::process_id() const { return process_ ? process_->id() : -1; }

std::optional<IpoptProposer::Point> IpoptProposer::Ask(const std::string& request, double patience,
                                                       ProposalStatistics& statistics) {
  ++statistics.requests;
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (!process_) {
      ++statistics.restarts;
      process_ = StartIpopt(program_);
    }
    // Kept only if it answers: whatever is thrown ends it.
    std::unique_ptr<LineProcess> process = std::move(process_);
    const LineProcess::Line line = process->Exchange(request, patience);
    if (line.end == LineProcess::End::kLine) {
      Point point = ReadPoint(line.text, statistics);
      process_ = std::move(process);
      return point;
    }
    if (line.end == LineProcess::End::kTimeout) {
      ++statistics.timeouts;
      return std::nullopt;
    }
  }
  return std::nullopt;
}

IpoptProposer::Point IpoptProposer::ReadPoint(const std::string& text, ProposalStatistics& statistics) const {
  const Json json = ParseJson(text, program_.string());
  STICTION_CHECK(json.value("status", "") != "refused", "stiction-ipopt refused: " + Shown(json));
  Point point;
  try {
    point = {json.at("f").get<std::vector<double>>(), json.at("starts").get<int>()};
    statistics.iterations += json.at("iterations").get<std::int64_t>();
    statistics.ipopt_seconds += json.at("seconds").get<double>();
  } catch (const Json::exception& error) {
    throw InputError(
        fmt::format("{}: found {} ({}), expected an answer", program_.string(), Shown(json), error.what()));
  }
  statistics.starts += point.starts;
  return point;
}

// Forces of the scaled problem.
std::optional<std::vector<double>> IpoptProposer::AskForces(const Json& request, int rows, double patience,
                                                            ProposalStatistics& statistics) {
  auto point = Ask(JsonText(request) + "\n", patience, statistics);
  if (!point) return std::nullopt;
  if (static_cast<int>(point->f.size()) == rows) return std::move(point->f);
  throw InputError(fmt::format("{}: found {} forces, expected {}", program_.string(), point->f.size(), rows));
}

std::optional<ExactVector> IpoptProposer::Search(const ExactProblem& problem, const ProposalOptions& options,
                                                 ProposalStatistics& statistics) {
  const ScaledProblem scaled = MakeScaled(problem);
  Json request = MakeRequest(problem, scaled, options);
  std::set<ModeWord> tried;
  for (int start = 0; start < options.starts; ++start) {
    request["options"]["first_start"] = start;
    const auto f = AskForces(request, problem.rows(), options.patience, statistics);
    if (!f) return std::nullopt;
    NearbyWords near = SolveNear(problem, scaled, *f, options.words, tried);
    statistics.words += near.words;
    statistics.first_words += near.is_first;
    if (near.f) return std::move(near.f);
  }
  return std::nullopt;
}

std::optional<std::vector<double>> IpoptProposer::ProposePoint(const ExactProblem& problem,
                                                               const ProposalOptions& options,
                                                               ProposalStatistics& statistics) {
  const Clock::time_point begin = Clock::now();
  RequireHandled(problem, options);
  const ScaledProblem scaled = MakeScaled(problem);
  auto f = AskForces(MakeRequest(problem, scaled, options), problem.rows(), options.patience, statistics);
  if (f) {
    for (double& x : *f) x *= ToDouble(scaled.force);
  }
  ++statistics.problems;
  statistics.seconds += SecondsSince(begin);
  return f;
}

std::optional<ExactVector> IpoptProposer::ProposeSolution(const ExactProblem& problem,
                                                          const ProposalOptions& options,
                                                          ProposalStatistics& statistics) {
  const Clock::time_point begin = Clock::now();
  RequireHandled(problem, options);
  auto solution = Search(problem, options, statistics);
  ++statistics.problems;
  statistics.solved += solution.has_value();
  statistics.seconds += SecondsSince(begin);
  return solution;
}

}  // namespace stiction
