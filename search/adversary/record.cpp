// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/record.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "certify/claims/certificate.h"
#include "certify/claims/existence.h"
#include "certify/exact/properties.h"
#include "corpus/json_text.h"
#include "corpus/record/digest.h"
#include "corpus/rounded.h"
#include "search/adversary/trial.h"

namespace stiction {
namespace {

Rational ReadNumber(const JsonPlace& place) {
  const auto x = ParseRational(place.Text("a number p/q as a string"));
  if (!x) place.Refuse("a number p/q as a string");
  return *x;
}

bool OfCondition(const Objective& objective) { return objective.name == "condition"; }

// Whether all eigenvalues of A are in [l, u], 0 < l.
bool Encloses(const ExactMatrix& A, const Rational& l, const Rational& u) {
  if (l <= 0 || FindAsymmetry(A)) return false;
  const ExactMatrix identity = ExactMatrix::Identity(A.rows(), A.cols());
  const ExactMatrix above = A - l * identity, below = u * identity - A;
  return std::holds_alternative<LdltFactors>(DecideSemidefinite(above)) &&
         std::holds_alternative<LdltFactors>(DecideSemidefinite(below));
}

// Bounds that are doubles, as near to the eigenvalues as they can be proved.
std::optional<std::pair<Rational, Rational>> EigenvalueBounds(const ExactProblem& problem) {
  if (problem.rows() == 0) return std::nullopt;
  const auto A = Rounded<double>(problem).A;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, Eigen::EigenvaluesOnly);
  const double least = solver.eigenvalues().minCoeff(), most = solver.eigenvalues().maxCoeff();
  for (double slack = 1e-9; slack < 1e-3; slack *= 10) {
    const Rational l(least * (1 - slack)), u(most * (1 + slack));
    if (Encloses(problem.A, l, u)) return std::pair(l, u);
  }
  return std::nullopt;
}

Rational LargestFriction(const ExactProblem& problem) {
  Rational mu = 0;
  for (const auto& contact : problem.contacts) mu = std::max(mu, contact.mu);
  return mu;
}

// The value, exactly: of an objective whose double is exact, or of the friction of a loop.
Rational ShownValue(const Objective& objective, ExactTrial& trial) {
  const auto value = objective.exact(trial);
  if (!value)
    throw InputError(fmt::format("record: the problem has no value for objective {}", objective.name));
  if (objective.lowers_friction) return LargestFriction(trial.problem());
  const double shown = objective.sign * *value;
  const bool is_exact = objective.name == "radius" || std::floor(shown) == shown;
  if (!is_exact)
    throw InputError(fmt::format("record: objective {} has values that doubles round", objective.name));
  return shown;
}

// In space the friction of a loop is a value, under either slip.
bool IsInSpace(const ProblemFile& problem) { return problem.problem.dimension() == 3; }

FrontierRecord RecordInSpace(FrontierRecord record, const Limits& limits) {
  if (!record.objective->lowers_friction)
    throw InputError("record: of problems in space the friction of a loop is recorded, objective friction");
  Policy redirect;
  redirect.slip = Slip::kRedirect;
  record.certificate = CycleCertificate(record.problem.problem, {Policy{}, redirect}, limits);
  if (!record.certificate) throw InputError("record: found no proof that the problem loops in space");
  record.value = LargestFriction(record.problem.problem);
  return record;
}

std::string FaultOfCertificate(const FrontierRecord& record, const std::string& claim) {
  const CheckReport report =
      CheckCertificate(record.certificate, record.frontier, ProblemDigest(record.problem.problem));
  if (!report.accepted) return "its certificate is refused: " + report.reason;
  if (report.claim != claim) return fmt::format("its certificate claims {}, expected {}", report.claim, claim);
  return "";
}

std::string FaultInSpace(const FrontierRecord& record) {
  const Rational value = LargestFriction(record.problem.problem);
  if (!record.objective->lowers_friction || value != record.value)
    return fmt::format("its value is {}, that of its problem {}", ToString(record.value), ToString(value));
  return FaultOfCertificate(record, "cycle");
}

}  // namespace

FrontierRecord MakeRecord(const Objective& objective, const ProblemFile& problem, const Limits& limits) {
  if (objective.exact == nullptr)
    throw InputError(fmt::format("record: found objective {}, expected one without --solver", objective.name));
  FrontierRecord record;
  record.objective = &objective;
  record.problem = problem;
  if (IsInSpace(problem)) return RecordInSpace(std::move(record), limits);
  ExactTrial trial(problem.problem, {}, limits);
  if (OfCondition(objective)) {
    record.bounds = EigenvalueBounds(problem.problem);
    if (!record.bounds || !trial.Loops())
      throw InputError("record: found no definite matrix with a loop, expected one for objective condition");
    record.value = record.bounds->second / record.bounds->first;
  } else {
    record.value = ShownValue(objective, trial);
  }
  if (trial.Loops()) {
    record.certificate = CycleCertificate(problem.problem, {Policy{}}, limits);
  } else {
    record.certificate =
        DecideExistence(problem.problem, {.law = FrictionLaw::kBaraff, .limits = limits}).certificate;
  }
  return record;
}

std::string FaultOf(const FrontierRecord& record, const Limits& limits) try {
  if (IsInSpace(record.problem)) return FaultInSpace(record);
  ExactTrial trial(record.problem.problem, {}, limits);
  const Objective& objective = *record.objective;
  if (objective.of_loops && !trial.Loops()) return "its problem does not loop under the policy paper";
  if (OfCondition(objective)) {
    if (!record.bounds || record.bounds->second / record.bounds->first != record.value)
      return "the quotient of its bounds is not its value";
    if (!Encloses(record.problem.problem.dense().A, record.bounds->first, record.bounds->second))
      return "eigenvalues of A are not in its bounds";
  } else {
    const Rational value = ShownValue(objective, trial);
    if (value != record.value)
      return fmt::format("its value is {}, that of its problem {}", ToString(record.value), ToString(value));
  }
  return FaultOfCertificate(record, trial.Loops() ? "cycle" : "solution-exists");
} catch (const InputError& error) {
  return error.what();
}

FrontierRecord ParseFrontierRecord(std::string_view json_text, const std::string& source) {
  const JsonPlace root(json_text, source);
  root.RequireObject();
  root.AllowKeys({"format", "version", "frontier", "what", "objective", "value", "bounds", "status", "proof",
                  "command", "build", "processor_seconds", "random", "problem", "certificate"});
  const auto text = [&root](const char* key) { return root.Required(key, "a text").Text("a text"); };
  root.RequireFormat("stiction-record");
  FrontierRecord record;
  record.frontier = text("frontier");
  record.what = text("what");
  const JsonPlace objective = root.Required("objective", "the name of an objective");
  record.objective = FindObjective(objective.Text("the name of an objective"));
  if (record.objective == nullptr) objective.Refuse("the name of an objective");
  record.value = ReadNumber(root.Required("value", "a number p/q as a string"));
  if (const auto bounds = root.Optional("bounds")) {
    if (bounds->Size("two numbers") != 2) bounds->Refuse("two numbers");
    record.bounds = {ReadNumber((*bounds)[0]), ReadNumber((*bounds)[1])};
    if (record.bounds->first <= 0) (*bounds)[0].Refuse("a number above zero");
  }
  const JsonPlace status = root.Required("status", "\"best so far\" or \"proved\"");
  record.status = status.Text("\"best so far\" or \"proved\"");
  if (record.status != "best so far" && record.status != "proved")
    status.Refuse("\"best so far\" or \"proved\"");
  if (record.status == "proved") record.proof = text("proof");
  record.command = text("command");
  record.build = text("build");
  record.processor_seconds = root.Required("processor_seconds", "seconds").Number("seconds");
  const JsonPlace random = root.Required("random", "an object");
  random.RequireObject();
  random.AllowKeys({"value", "evaluations", "command"});
  const JsonPlace value = random.Required("value", "a number p/q as a string, or null");
  if (!value.IsNull()) record.random_value = ReadNumber(value);
  record.random_evaluations =
      random.Required("evaluations", "a count").Integer(0, std::int64_t{1} << 53, "a count");
  record.random_command = random.Required("command", "a text").Text("a text");
  record.problem = ParseProblem(JsonText(root.Required("problem", "a problem").json()), source + ": problem");
  record.certificate = root.Required("certificate", "a certificate").json();
  return record;
}

FrontierRecord ReadRecord(const std::filesystem::path& file) {
  return ParseFrontierRecord(ReadText(file), file.string());
}

std::vector<FrontierRecord> ReadRecords(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw InputError(fmt::format("{}: found no folder, expected one of records", folder.string()));
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  if (files.empty()) throw InputError(fmt::format("{}: found no record", folder.string()));
  std::sort(files.begin(), files.end());
  std::vector<FrontierRecord> records;
  for (const auto& file : files) {
    records.push_back(ReadRecord(file));
    if (records.back().frontier != file.stem())
      throw InputError(fmt::format("{}: frontier: found \"{}\", expected the name of the file", file.string(),
                                   records.back().frontier));
  }
  return records;
}

SharedJson HeadOf(const FrontierRecord& record) {
  return {{"frontier", record.frontier},     {"what", record.what},     {"objective", record.objective->name},
          {"value", ToString(record.value)}, {"status", record.status}, {"command", record.command}};
}

std::string Print(const FrontierRecord& record) {
  SharedJson json = {{"format", "stiction-record"}, {"version", 1}};
  json.Add(HeadOf(record));
  json.Add({{"build", record.build},
            {"processor_seconds", record.processor_seconds},
            {"random", SharedJson{{"value", record.random_value ? SharedJson(ToString(*record.random_value))
                                                                : SharedJson()},
                                  {"evaluations", record.random_evaluations},
                                  {"command", record.random_command}}},
            {"problem", ToJson(record.problem)},
            {"certificate", record.certificate}});
  if (record.bounds)
    json.Add({{"bounds", std::vector{ToString(record.bounds->first), ToString(record.bounds->second)}}});
  if (record.status == "proved") json.Add({{"proof", record.proof}});
  return JsonText(json) + "\n";
}

}  // namespace stiction
