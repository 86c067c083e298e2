// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/feasibility_nlp.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <set>
#include <system_error>
#include <utility>

#include "certify/exact/line_process.h"
#include "certify/exact/qp.h"
#include "corpus/json.h"
#include "corpus/stop.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

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
  auto process = std::make_unique<LineProcess>(std::vector{program.string()}, "the program stiction-ipopt",
                                               LineBounds{.stopped = &Stop::IsAsked});
  const LineProcess::Line line = process->Read(LineProcess::After(kGreetingPatience));
  if (line.end == LineProcess::End::kLine && IsGreeting(line.text)) return process;
  throw InputError(fmt::format(
      "{}: found {}, expected the program stiction-ipopt, protocol {}", program.string(),
      line.end == LineProcess::End::kLine ? "\"" + Shortened(line.text) + "\"" : "no greeting", kProtocol));
}

void RequirePlane(const ExactProblem& problem) {
  if (problem.dimension != 2) throw InputError("dimension: found 3, expected 2 for ipopt");
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

// ---- The proposer --------------------------------------------------------------------------------

IpoptProposer::IpoptProposer(const std::filesystem::path& program)
    : program_(program), process_(StartIpopt(program)) {}

IpoptProposer::~IpoptProposer() = default;

int IpoptProposer::process_id() const { return process_ ? process_->id() : -1; }

// One start a request, since words near a point that is no solution may have one: the first, to be changed.
Json IpoptProposer::MakeRequest(const ExactProblem& problem, const ScaledProblem& scaled,
                                const char* formulation) const {
  STICTION_CHECK(starts >= 1 && max_iterations >= 1 && words >= 1,
                 "ipopt: starts, iterations and words are at least 1");
  STICTION_CHECK(patience > 0 && patience <= 1e6, "ipopt: patience is from 0 to 1e6 seconds");
  Json contacts = Json::array();
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    Json& contact = contacts.emplace_back(Json{{"kind", Name(problem.contacts[i].kind)}});
    if (problem.contacts[i].HasFrictionRows()) contact["mu"] = scaled.numbers.contacts[i].mu;
    if (problem.contacts[i].kind == ContactKind::kSliding) contact["slip"] = scaled.numbers.contacts[i].slip[0];
  }
  Json A = Json::array();
  for (const auto& row : scaled.numbers.A.rowwise()) A.push_back(std::vector<double>(row.begin(), row.end()));
  const auto& b = scaled.numbers.b;
  return {{"dimension", problem.dimension},
          {"contacts", contacts},
          {"A", A},
          {"b", std::vector<double>(b.begin(), b.end())},
          {"options",
           {{"first_start", 0},
            {"max_iterations", max_iterations},
            {"starts", 1},
            {"seed", seed},
            {"formulation", formulation}}}};
}

std::optional<std::vector<double>> IpoptProposer::Ask(const std::string& request, Counters& counters) {
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (!process_) process_ = StartIpopt(program_);
    // Kept only if it answers: whatever is thrown ends it.
    std::unique_ptr<LineProcess> process = std::move(process_);
    const LineProcess::Line line = process->Exchange(request, patience);
    Stop::Check();
    if (line.end == LineProcess::End::kLine) {
      std::vector<double> f = ReadPoint(line.text, counters);
      process_ = std::move(process);
      return f;
    }
    if (line.end == LineProcess::End::kTimeout) return std::nullopt;
  }
  return std::nullopt;
}

std::vector<double> IpoptProposer::ReadPoint(const std::string& text, Counters& counters) {
  const Json json = ParseJson(text, program_.string());
  STICTION_CHECK(json.value("status", "") != "refused", "stiction-ipopt refused: " + Shown(json));
  try {
    auto f = json.at("f").get<std::vector<double>>();
    counters[Counter::kStarts] += json.at("starts").get<std::int64_t>();
    counters[Counter::kIterations] += json.at("iterations").get<std::int64_t>();
    ipopt_seconds_ += json.at("seconds").get<double>();
    return f;
  } catch (const Json::exception& error) {
    throw InputError(
        fmt::format("{}: found {} ({}), expected an answer", program_.string(), Shown(json), error.what()));
  }
}

// Forces of the scaled problem.
std::optional<std::vector<double>> IpoptProposer::AskForces(const Json& request, int rows, Counters& counters) {
  auto f = Ask(JsonText(request) + "\n", counters);
  if (!f || static_cast<int>(f->size()) == rows) return f;
  throw InputError(fmt::format("{}: found {} forces, expected {}", program_.string(), f->size(), rows));
}

Answer<Rational> IpoptProposer::ProposeSolution(const ExactProblem& problem) {
  RequirePlane(problem);
  const ScaledProblem scaled = MakeScaled(problem);
  Json request = MakeRequest(problem, scaled, "nlp");
  Counters counters = {Counter::kStarts, Counter::kIterations, Counter::kWords};
  std::set<ModeWord> tried;
  Answer<Rational> answer;
  for (int start = 0; start < starts && !answer.Solved(); ++start) {
    request["options"]["first_start"] = start;
    const auto f = AskForces(request, problem.rows(), counters);
    if (!f) break;
    answer = SolveNear(problem, scaled, *f, words, tried);
    counters += answer.counters;
  }
  answer.counters = counters;
  if (!answer.Solved()) answer.reason = "no point that Ipopt proposed led to a solution";
  return answer;
}

Answer<double> IpoptProposer::ProposePoint(const ExactProblem& problem) {
  RequirePlane(problem);
  RequireFrictionless(problem);
  const ScaledProblem scaled = MakeScaled(problem);
  Counters counters;
  const auto f = AskForces(MakeRequest(problem, scaled, "qp"), problem.rows(), counters);
  Answer<double> answer;
  answer.counters = {{Counter::kIterations, counters[Counter::kIterations]}};
  answer.reason = "no answer from Ipopt";
  if (!f) return answer;
  answer.f = Eigen::VectorXd::Map(f->data(), problem.rows()) * ToDouble(scaled.force);
  answer.reason = "the errors of Ipopt's point are above the bound";  // unless the gate finds that they are not
  return answer;
}

}  // namespace stiction
