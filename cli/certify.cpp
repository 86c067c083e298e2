// SPDX-License-Identifier: Apache-2.0
// stiction certify, stiction check: claims with exact witnesses, made and verified.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "certify/certificate.h"
#include "certify/condition.h"
#include "certify/existence.h"
#include "certify/safe.h"
#include "certify/safety_threshold.h"
#include "certify/space.h"
#include "cli/shared.h"
#include "cli/verbs.h"
#include "corpus/json_text.h"

namespace stiction {
namespace {

struct CertifyOptions {
  std::string file;
  std::string output;
  std::string claim = "solution-exists";
  std::string policy = "paper";
  bool all = false;
  bool safe = false;
  bool json = false;
  Limits limits;
};

void ShowProgress(const EnumerationProgress& progress) {
  fmt::print(stderr, "\r\033[K{:.1f} % of all mode words, {} linear programs, {} solutions",
             100 * progress.decided, progress.programs, progress.solutions);
}

EnumerationOptions WithProgress(EnumerationOptions options) {
  if (isatty(STDERR_FILENO) == 0) return options;
  options.progress = [](const EnumerationProgress& progress) {
    if (progress.prefixes % 64 == 0) ShowProgress(progress);
    return true;
  };
  return options;
}

// All words that have solutions, with a witness each.
int ListSolutions(const CertifyOptions& o, const ProblemFile& file) {
  const Enumeration modes = EnumerateModes(file.problem, WithProgress({}));
  Json words = Json::array();
  for (const WordSolution& solution : modes.solutions) {
    const Json word = WordToJson(solution.word);
    words.push_back({{"modes", word}, {"f", VectorToJson(solution.f)}, {"unique", solution.unique}});
    if (!o.json) {
      fmt::print("{}{}: f = {}\n", word.dump(), solution.unique ? "" : " (more than one)",
                 VectorToJson(solution.f).dump());
    }
  }
  const bool complete = modes.end == EnumerationEnd::kComplete;
  if (o.json) {
    std::cout << JsonText({{"complete", complete},
                           {"words", words},
                           {"distinct_witnesses", modes.distinct_witnesses},
                           {"programs", modes.programs}})
              << "\n";
  } else {
    fmt::print("{} words with solutions, {} distinct witnesses; {} linear programs{}\n", words.size(),
               modes.distinct_witnesses, modes.programs, complete ? "" : "; not complete");
  }
  return complete ? kExitDone : kExitUndecided;
}

// The best bound that was found, or null.
Json CertifyCoulomb(const ExactProblem& problem, const Limits& limits) {
  SpaceOptions options;
  options.law = FrictionLaw::kCoulomb;
  options.limits = limits;
  const SpaceSolution solution = SolveInSpace(problem, options);
  if (solution.outcome != Outcome::kSolved || solution.bound <= 0) return nullptr;
  return CoulombCertificate(problem, solution.f, solution.bound);
}

Json Certify(const CertifyOptions& o, const ProblemFile& file) {
  if (o.claim == "solution-exists")
    return DecideExistence(file.problem, o.limits, WithProgress({})).certificate;
  if (o.claim == "coulomb-solution") return CertifyCoulomb(file.problem, o.limits);
  if (o.claim == "symmetric") return SymmetryCertificate(file.problem);
  if (o.claim == "psd") return SemidefiniteCertificate(file.problem);
  if (o.claim == "in-range") return RangeCertificate(file.problem);
  if (o.claim == "h") return HypothesisCertificate(file.problem);
  if (o.claim == "safe") return SafetyCertificate(file.problem);
  if (o.claim == "safe-by-condition") return ConditionCertificate(file.problem).value_or(Json());
  const Outcome loop = o.claim == "cycle" ? Outcome::kCycle : Outcome::kStall;
  return LoopCertificate(file.problem, loop, PoliciesNamed(o.policy), o.limits);
}

// ---- Safety ----

// By the determinants of all words, and for which uniform friction they are positive.
void AddWords(const ExactProblem& problem, Json& result) {
  result["safe"] = !DecideSafety(problem).unsafe_word.has_value();
  const auto threshold = FindSafetyThreshold(problem);
  if (!threshold) return;
  Json polynomial = Json::array();
  for (const Rational& coefficient : threshold->polynomial) polynomial.push_back(ToString(coefficient));
  result["threshold"] = {{"low", ToString(threshold->low)},
                         {"high", ToString(threshold->high)},
                         {"word", WordToJson(threshold->word)},
                         {"polynomial", polynomial}};
}

// By the condition number of A after scaling: any number of contacts.
void AddCondition(const ExactProblem& problem, Json& result) {
  const auto bound = FindConditionBound(problem, FrictionWeights::kUniform);
  if (!bound) return;
  const auto mu = bound->SafeFriction();
  result["condition"] = {{"number", ToString(Rational(bound->most / bound->least))},
                         {"scaling", VectorToJson(bound->scaling)},
                         {"mu", mu ? Json(ToString(*mu)) : Json()}};
}

std::string SafetyText(const Json& result, bool has_words) {
  const Json& safe = result["safe"];
  std::string text = safe.is_null()     ? "undecided: too many words, and the condition does not tell\n"
                     : safe.get<bool>() ? "safe\n"
                                        : "unsafe\n";
  if (result.contains("threshold")) {
    const Json& t = result["threshold"];
    text += fmt::format("uniform mu: safe below mu* in [{}, {}], where the determinant of {} vanishes\n",
                        t["low"].get<std::string>(), t["high"].get<std::string>(), t["word"].dump());
  } else if (has_words) {
    text += "safe for every uniform mu > 0\n";
  }
  if (result.contains("condition")) {
    const Json& mu = result["condition"]["mu"];
    text += mu.is_null()
                ? "its condition alone: safe for every uniform mu\n"
                : fmt::format("its condition alone: safe for uniform mu <= {}\n", mu.get<std::string>());
  }
  return text;
}

int ShowSafety(const CertifyOptions& o, const ProblemFile& file) {
  const bool has_words = HasFewWords(file.problem);
  const auto by_condition = ConditionCertificate(file.problem);
  Json result = {{"safe", by_condition ? Json(true) : Json()}};
  if (has_words) AddWords(file.problem, result);
  AddCondition(file.problem, result);
  const bool decided = !result["safe"].is_null();
  if (!o.output.empty() && decided)
    WriteText(o.output, JsonText(has_words ? SafetyCertificate(file.problem) : *by_condition, 1) + "\n");
  std::ostream& out = o.output == "-" ? std::cerr : std::cout;
  out << (o.json ? JsonText(result) + "\n" : SafetyText(result, has_words));
  return decided ? kExitDone : kExitUndecided;
}

// Loops are claimed, and modes listed, of planar problems; safety is one of static and frictionless contacts;
// Coulomb's law is that of problems in space.
ProblemFile ReadFor(const CertifyOptions& o) {
  if (o.all || o.claim == "cycle" || o.claim == "stall") return ReadPlanarProblem(o.file);
  if (o.claim == "coulomb-solution") {
    ProblemFile file = ReadProblem(o.file);
    if (file.problem.dimension == 3) return file;
    throw InputError(o.file, "dimension", "2", "3: in the plane the claim is solution-exists");
  }
  return o.safe || o.claim.starts_with("safe") ? ReadHandledProblem(o.file, "safety") : ReadProblem(o.file);
}

int RunCertify(const CertifyOptions& o) {
  if (o.output.empty() && !o.all && !o.safe) throw InputError("certify: expected -o CERT, --all or --safe");
  const ProblemFile file = ReadFor(o);
  if (o.all) return ListSolutions(o, file);
  if (o.safe) return ShowSafety(o, file);
  const Json certificate = Certify(o, file);
  const bool certified = !certificate.is_null();
  if (certified) WriteText(o.output, JsonText(certificate, 1) + "\n");
  const Json claim = certified ? certificate["claim"] : Json("undecided");
  // With the certificate itself on standard output, nothing else may stand there.
  std::ostream& out = o.output == "-" ? std::cerr : std::cout;
  if (o.json) {
    out << JsonText({{"claim", claim}, {"assumptions", FailedAssumptions(file.problem)}}) << "\n";
  } else if (certified) {
    out << fmt::format("{}: {}\n", o.output, claim.get<std::string>());
  } else {
    out << fmt::format("undecided: nothing that was run shows '{}'\n", o.claim);
  }
  return certified ? kExitDone : kExitUndecided;
}

struct CheckOptions {
  std::vector<std::string> files;
  bool json = false;
};

// One line, or one object, per file. A file that cannot be read does not keep the others from being checked.
int RunCheck(const CheckOptions& o) {
  int exit = kExitDone;
  Json reports = Json::array();
  for (const std::string& file : o.files) {
    Json entry = {{"file", file}, {"accepted", false}};
    try {
      const CheckReport report = CheckCertificate(ParseJson(ReadText(file), file), file);
      entry["accepted"] = report.accepted;
      entry["claim"] = report.claim;
      entry[report.accepted ? "facts" : "reason"] = report.accepted ? report.facts : Json(report.reason);
      if (!report.accepted) exit = std::max(exit, kExitNotSo);
      if (!o.json && report.accepted)
        fmt::print("{}: accepted: {} {}\n", file, report.claim, report.facts.dump());
      if (!o.json && !report.accepted) fmt::print("{}: REJECTED: {}\n", file, report.reason);
    } catch (const InputError& error) {
      entry["reason"] = error.what();
      exit = kExitBadInput;
      fmt::print(stderr, "stiction: {}\n", error.what());
    }
    reports.push_back(std::move(entry));
  }
  if (o.json) std::cout << JsonText(reports) << "\n";
  return exit;
}

}  // namespace

void AddCertify(CommandLine& program) {
  auto [verb, o] = program.Add("certify", "Write a certificate: a claim with an exact witness", RunCertify);
  verb.Positional("FILE", o.file, "stiction-problem file").Required();
  verb.Option("-o,--output", o.output, "certificate to write; - is standard output");
  verb.Option("--claim", o.claim, "what to certify, or its negation if that holds")
      .Choices({{"solution-exists", "forces that meet all conditions"},
                {"coulomb-solution", "the same for Coulomb's law, in space"},
                {"symmetric", "A = A'"},
                {"psd", "A is positive semidefinite"},
                {"in-range", "b is in the range of A"},
                {"h", "b'v >= 0 for all v in the friction cones with A v = 0"},
                {"safe", "A is safe for the published algorithm"},
                {"safe-by-condition", "its condition number alone shows that it is"},
                {"cycle", "the published algorithm repeats a state of its outer loop"},
                {"stall", "it repeats a state of one drive"}});
  verb.Flag("--safe", o.safe, "the friction coefficient below which A is safe for the published algorithm")
      .Details("See certify/README.md; with -o a certificate whether the problem is");
  verb.Flag("--all", o.all, "list all contact modes that have solutions; writes no certificate");
  AddPolicyOption(verb, o.policy, Grid::kAllowed);
  verb.Flag("--json", o.json, "machine output");
  AddLimits(verb, o.limits);
}

void AddCheck(CommandLine& program) {
  auto [verb, o] = program.Add("check", "Verify certificates", RunCheck);
  verb.Positional("CERT", o.files, "stiction-certificate files").Required();
  verb.Flag("--json", o.json, "machine output");
}

}  // namespace stiction
