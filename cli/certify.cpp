// SPDX-License-Identifier: Apache-2.0
// stiction certify, stiction check: claims with exact witnesses, made and verified.

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <iostream>

#include "certify/claims/certificate.h"
#include "certify/claims/claims.h"
#include "certify/claims/condition.h"
#include "certify/claims/coq_text.h"
#include "certify/claims/robust.h"
#include "certify/claims/robust_scene.h"
#include "certify/claims/safe.h"
#include "certify/claims/safety_threshold.h"
#include "certify/request/request.h"
#include "cli/command_line.h"
#include "cli/narration/narrate_text.h"
#include "cli/shared.h"
#include "corpus/json.h"
#include "corpus/record/digest.h"
#include "corpus/record/scene_file.h"

namespace stiction {
namespace {

struct CertifyOptions : WantedClaim {
  std::string file;
  std::string output;
  bool all = false;
  bool safe = false;
  bool robust = false;
  bool coq = false;
  bool json = false;
};

// Options of an enumeration that is shown from when it begins to when the bar goes.
EnumerationOptions Shown(ProgressBar& bar) {
  EnumerationOptions options;
  options.progress = [&bar](const EnumerationProgress& progress) {
    if (progress.prefixes % 64 == 0) {
      bar.Show(progress.decided, fmt::format("{:.1f} % of all mode words, {} linear programs, {} solutions",
                                             100 * progress.decided, progress.programs, progress.solutions));
    }
    return true;
  };
  return options;
}

// ["slip-", "stick"] -> "slip- stick".
std::string WordText(const Json& word) {
  std::string text;
  for (const Json& mode : word) text += (text.empty() ? "" : " ") + mode.get<std::string>();
  return text;
}

std::string SolutionsText(const Enumeration& modes) {
  std::string text = fmt::format(
      "{} of the contact modes {} solutions, with {} distinct witness{}{} ({} linear programs)\n",
      modes.solutions.size(), modes.solutions.size() == 1 ? "has" : "have", modes.distinct_witnesses,
      modes.distinct_witnesses == 1 ? "" : "es",
      modes.end == EnumerationEnd::kComplete ? "" : " so far: not all were looked at", modes.programs);
  for (const WordSolution& solution : modes.solutions)
    text += fmt::format("  {}: f = {}{}\n", WordText(WordToJson(solution.word)),
                        ListText(solution.f, FractionText::kShort), solution.unique ? "" : ", and others");
  return text;
}

// All words that have solutions, with a witness each.
int ListSolutions(const CertifyOptions& o, const ProblemFile& file) {
  RequirePlanar(file.problem, o.file);
  ProgressBar bar;
  const Enumeration modes = EnumerateModes(file.problem, Shown(bar));
  bar.Clear();
  Json words = Json::array();
  for (const WordSolution& solution : modes.solutions) {
    words.push_back(
        {{"modes", WordToJson(solution.word)}, {"f", VectorToJson(solution.f)}, {"unique", solution.unique}});
  }
  const bool complete = modes.end == EnumerationEnd::kComplete;
  if (o.json) {
    std::cout << JsonText({{"complete", complete},
                           {"words", words},
                           {"distinct_witnesses", modes.distinct_witnesses},
                           {"programs", modes.programs}})
              << "\n";
  } else {
    Tell("{}", SolutionsText(modes));
  }
  return complete ? kExitDone : kExitUndecided;
}

// ---- Safety ----

Json ThresholdToJson(const SafetyThreshold& threshold) {
  Json polynomial = Json::array();
  for (const Rational& coefficient : threshold.polynomial) polynomial.push_back(ToString(coefficient));
  return {{"low", ToString(threshold.low)},
          {"high", ToString(threshold.high)},
          {"word", WordToJson(threshold.word)},
          {"polynomial", polynomial}};
}

// By the determinants of all words, and for which uniform friction they are positive.
void AddWords(const ExactProblem& problem, Json& result) {
  result["safe"] = !DecideSafety(problem).unsafe_word.has_value();
  if (const auto threshold = FindSafetyThreshold(problem)) result["threshold"] = ThresholdToJson(*threshold);
}

// What can be said of a problem that is not safe since determinants vanish.
void AddWeakSafety(const ExactProblem& problem, Json& result) {
  const WeakSafety weak = DecideWeakSafety(problem);
  result["weakly_safe"] = !weak.negative_word;
  result["vanishing_words"] = weak.vanishing;
  if (weak.negative_word) result["negative_word"] = WordToJson(*weak.negative_word);
  result["limit"] = {{"safe", !weak.limit_word}};
  if (weak.limit_word) result["limit"]["word"] = WordToJson(*weak.limit_word);
  if (const auto threshold = FindLimitThreshold(problem)) {
    result["limit"]["threshold"] = ThresholdToJson(*threshold);
  }
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

std::string ThresholdText(const Json& threshold) {
  return fmt::format("mu* in [{}, {}], by {}", threshold["low"].get<std::string>(),
                     threshold["high"].get<std::string>(), WordText(threshold["word"]));
}

std::string WeakSafetyText(const Json& result) {
  const Json& limit = result["limit"];
  std::string text = fmt::format("{} words of determinant zero; ", result["vanishing_words"].get<int>());
  text += result["weakly_safe"].get<bool>()
              ? "none negative, so weakly safe: complete driving neither folds nor descends\n"
              : fmt::format("negative: {}\n", WordText(result["negative_word"]));
  text += limit["safe"].get<bool>()
              ? "safe in the limit: A + eps I is safe for all small eps > 0\n"
              : fmt::format("not safe in the limit: A + eps I is unsafe by {}\n", WordText(limit["word"]));
  return text + (limit.contains("threshold")
                     ? "uniform mu: safe in the limit below " + ThresholdText(limit["threshold"]) + "\n"
                     : "safe in the limit for every uniform mu > 0\n");
}

std::string ConditionText(const Json& condition) {
  const Json& mu = condition["mu"];
  if (mu.is_null()) return "its condition alone: safe for every uniform mu\n";
  return fmt::format("its condition alone: safe for uniform mu <= {}\n", mu.get<std::string>());
}

std::string SafetyText(const Json& result, bool has_words) {
  const Json& safe = result["safe"];
  std::string text = safe.is_null()     ? "undecided: too many words, and the condition does not tell\n"
                     : safe.get<bool>() ? "safe: the determinants of all words are positive; complete driving "
                                          "has no fold, and the published\n"
                                          "algorithm under apex=suspended, ties apart, nothing to give up\n"
                                        : "unsafe: the determinant of a word is zero or negative; where one is "
                                          "negative, complete driving may\n"
                                          "fold, and the published algorithm give up\n";
  if (result.contains("threshold")) {
    text += "uniform mu: safe below " + ThresholdText(result["threshold"]) + "\n";
  } else if (has_words) {
    text += "safe for every uniform mu > 0\n";
  }
  if (result.contains("limit")) text += WeakSafetyText(result);
  if (has_words && !safe.get<bool>() && !result.contains("limit")) {
    text += "weakly safe, safe in the limit: not looked at, too many words\n";
  }
  if (result.contains("condition")) text += ConditionText(result["condition"]);
  return text;
}

int ShowSafety(const CertifyOptions& o, const ProblemFile& file) {
  RequireHandled(file.problem, o.file, "safety");
  const bool has_words = HasFewWords(file.problem);
  const auto by_condition = ConditionCertificate(file.problem);
  Json result = {{"safe", by_condition ? Json(true) : Json()}};
  if (has_words) AddWords(file.problem, result);
  if (result["safe"] == false && HasFewWords(file.problem, kMaxWeakSafetyWords)) {
    AddWeakSafety(file.problem, result);
  }
  AddCondition(file.problem, result);
  const bool decided = !result["safe"].is_null();
  if (!o.output.empty() && decided)
    WriteText(o.output, JsonText(has_words ? SafetyCertificate(file.problem) : *by_condition, 1) + "\n");
  std::ostream& out = o.output == "-" ? std::cerr : std::cout;
  out << (o.json ? JsonText(result) + "\n" : Folded(SafetyText(result, has_words)));
  return decided ? kExitDone : kExitUndecided;
}

// ---- Robustness ----

// The scene that a problem file carries, if it does. The problem must be that of the scene, all contacts in
// one.
std::optional<TouchingScene> ReadTouchingScene(const CertifyOptions& o, const ProblemFile& file) {
  if (!file.scene) return std::nullopt;
  const Scene<Rational> scene = ParseScene(file.scene->dump(), o.file + ": scene").scene;
  if (const auto unfit = UnfitForBox(scene))
    throw InputError(o.file, "scene." + unfit->path, unfit->found, unfit->expected + " (--robust)");
  TouchingScene touching = Touching(scene);
  if (ProblemDigest(touching.problem) != ProblemDigest(file.problem))
    throw InputError(o.file, "scene", "one of another problem",
                     "one that 'assemble --full' makes this problem of (--robust)");
  return touching;
}

Json RadiusToJson(const std::optional<Rational>& radius) { return radius ? Json(ToString(*radius)) : Json(); }

void ShowRadiusOf(const std::string& policy, const std::optional<Rational>& radius, std::string_view what,
                  std::string_view measure) {
  if (radius)
    Tell("{}: loops for all {} within {} of these, proved ({})\n", policy, what, ToString(*radius), measure);
  else
    Tell("{}: no loop of {} that is proved\n", policy, what);
}

int ShowRadius(const CertifyOptions& o, const ProblemFile& file) {
  RequireHandled(file.problem, o.file, "robustness");
  const auto scene = ReadTouchingScene(o, file);
  Json rows = Json::array();
  bool all = true;
  for (const Policy& policy : ParsePolicies(o.policy)) {
    const PublishedOptions options = {policy, {}, o.limits};
    const std::string name = PolicyName(policy);
    const auto radius = RadiusOfLoop(file.problem, options);
    Json& row = rows.emplace_back(Json{{"policy", name}, {"radius", RadiusToJson(radius)}});
    all = all && radius;
    if (!o.json) ShowRadiusOf(name, radius, "A, b, mu", "A, b: of the largest entry");
    if (!scene) continue;
    const auto of_scene = RadiusOfSceneLoop(*scene, options);
    row["scene_radius"] = RadiusToJson(of_scene);
    all = all && of_scene;
    if (!o.json) ShowRadiusOf(name, of_scene, "scenes", "lengths: of the largest arm; angles in radians");
  }
  if (o.json) std::cout << JsonText(rows) << "\n";
  return all ? kExitDone : kExitUndecided;
}

// ": " and what a certificate proves about solutions, "" if it speaks of something else.
std::string ProvedOfSolutions(std::string_view name) {
  for (const Claim& claim : AllClaims())
    if (claim.name == name && !claim.proves.empty()) return fmt::format(": {}", claim.proves);
  return "";
}

// Where nothing that was run shows the claim; `why`: a text, or null.
std::string UndecidedText(const std::string& claim, const Json& why) {
  const std::string reason = why.is_string() ? fmt::format(" ({})", why.get<std::string>()) : "";
  return fmt::format("undecided: nothing that was run shows '{}'{}\n", claim, reason);
}

void RequireAffordable(const Json& certificate, const std::string& file) {
  const CheckReport report = CheckCertificate(certificate, file);
  if (report.accepted) return;
  throw InputError(
      fmt::format("{}: found a problem whose certificate no checker would take, {}: try another claim, "
                  "or a smaller problem",
                  file, report.reason));
}

int RunCertify(const CertifyOptions& o) {
  if (o.output.empty() && !o.all && !o.safe && !o.robust)
    throw InputError("certify: expected -o CERT, --all, --safe or --robust");
  if (o.robust && (o.all || o.safe || !o.output.empty()))
    throw InputError(
        "certify: found --robust with --all, --safe or -o, expected it alone: it writes no certificate");
  if (o.coq && (o.all || o.safe || o.robust))
    throw InputError("certify: found --coq with --all, --safe or --robust, expected it with --claim");
  const ProblemFile file = ReadProblem(o.file);
  if (o.all) return ListSolutions(o, file);
  if (o.safe) return ShowSafety(o, file);
  if (o.robust) return ShowRadius(o, file);
  ProgressBar bar;
  WantedClaim wanted = o;
  wanted.factors = file.factors && !o.coq ? &*file.factors : nullptr;
  const Json certificate = CertificateOf(wanted, file.problem, o.file, Shown(bar));
  bar.Clear();
  const bool certified = certificate.is_object();
  if (certified) RequireAffordable(certificate, o.file);
  if (certified)
    WriteText(o.output, o.coq ? CoqText(certificate, file.problem, o.file) : JsonText(certificate, 1) + "\n");
  const Json claim = certified ? certificate["claim"] : Json("undecided");
  // With the certificate itself on standard output, nothing else may stand there.
  std::ostream& out = o.output == "-" ? std::cerr : std::cout;
  if (o.json) {
    out << JsonText({{"claim", claim}, {"assumptions", FailedAssumptions(file)}}) << "\n";
  } else if (certified) {
    const std::string name = claim.get<std::string>();
    out << Folded(fmt::format("{}: {}{}\n", o.output, name, ProvedOfSolutions(name)));
  } else {
    out << Folded(UndecidedText(o.claim, certificate));
  }
  return certified ? kExitDone : kExitUndecided;
}

struct CheckOptions {
  std::vector<std::string> files;
  std::string problem;
  bool json = false;
};

std::string ValueText(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

std::string ValuesText(const Json& values) {
  std::string text;
  for (const Json& value : values) text += (text.empty() ? "" : " ") + ValueText(value);
  return text;
}

std::string ReportText(const CheckReport& report) {
  if (!report.accepted) return "REJECTED: " + report.reason;
  std::string facts;
  for (const auto& [name, value] : report.facts.items())
    facts += fmt::format("{} {}, ", name, value.is_array() ? ValuesText(value) : ValueText(value));
  return fmt::format("accepted: {}, {}problem {}", report.claim, facts, report.digest);
}

Json ReportToJson(const std::string& file, const CheckReport& report) {
  return {{"file", file},
          {"accepted", report.accepted},
          {"claim", report.claim},
          {"problem", report.digest},
          {report.accepted ? "facts" : "reason", report.accepted ? report.facts : Json(report.reason)}};
}

// One line, or one object, per file. A file that cannot be read does not keep the others from being checked.
int RunCheck(const CheckOptions& o) {
  int exit = kExitDone;
  const std::string digest = o.problem.empty() ? "" : ProblemDigest(ReadProblem(o.problem).problem);
  Json reports = Json::array();
  for (const std::string& file : o.files) {
    try {
      const CheckReport report = CheckText(ReadText(file), file, digest);
      if (!report.accepted) exit = std::max(exit, kExitNotSo);
      if (!o.json) Tell("{}: {}\n", file, ReportText(report));
      reports.push_back(ReportToJson(file, report));
    } catch (const InputError& error) {
      exit = kExitBadInput;
      fmt::print(std::cerr, "stiction: {}\n", error.what());
      reports.push_back({{"file", file}, {"accepted", false}, {"reason", error.what()}});
    }
  }
  if (o.json) std::cout << JsonText(reports) << "\n";
  return exit;
}

std::vector<AllowedValue> ClaimChoices() {
  std::vector<AllowedValue> choices;
  for (const Claim& claim : AllClaims())
    if (claim.certify != nullptr) choices.push_back({std::string(claim.name), std::string(claim.meaning)});
  return choices;
}

}  // namespace

const ListedVerb kCertifyVerb("One problem", 30, [](CommandLine& program) {
  auto [verb, o] = program.Add("certify", "Write a certificate: a claim with an exact witness", RunCertify);
  verb.Positional("FILE", o.file, kFileHelp).Required().Details(kFileDetails);
  verb.Option("-o,--output", o.output, "certificate to write; - is standard output");
  verb.Option("--claim", o.claim, "what to certify, or its negation if that holds").Choices(ClaimChoices());
  verb.Option("--law", o.law, "friction in space, of the claim existence; by default coulomb")
      .Choices({{"coulomb", "Coulomb's law up to a proved bound on the angle: coulomb-solution"},
                {"baraff", "the paper's conditions (21), (22): solution-exists"}});
  verb.Flag("--safe", o.safe,
            "the friction coefficient below which A is safe: ties apart, the published algorithm under "
            "apex=suspended ends")
      .Details("See certify/README.md; with -o a certificate whether the problem is");
  verb.Flag("--all", o.all, "list all contact modes that have solutions; writes no certificate");
  verb.Flag("--robust", o.robust, "of a loop: how far A, b and mu may move at once while it stays one")
      .Details(
          "A lower bound, proved over intervals; of a problem that carries its scene also how far all that "
          "the scene is built of may be off at once. Exit 3 unless each is proved. Writes no certificate");
  verb.Flag("--coq", o.coq, "write a file for Coq, which proves the claim anew, in place of the certificate")
      .Details(fmt::format("Of {}. After ./run prove: coqc -R build/coq Stiction CERT",
                           fmt::join(ClaimsForCoq(), ", ")));
  AddPolicyOption(verb, o.policy, Grid::kAllowed);
  verb.Prints(o.json,
              "what was certified; with --all, all solutions; with --safe, safety; with --robust, radii; the "
              "certificate itself where -o is -",
              R"(
      {claim: claim | "undecided", assumptions: [assumption]} |
      {complete: truth, words: [{modes: [mode], f: [exact], unique: truth}], distinct_witnesses: integer,
       programs: integer  // linear programs
      } |
      {safe: truth | null,  // null: undecided
       condition?: {number: exact, scaling: [exact], mu: exact | null}, threshold?: threshold,
       weakly_safe?: truth, vanishing_words?: integer, negative_word?: [mode],
       limit?: {safe: truth, word?: [mode], threshold?: threshold}} |
      certificate | [{policy: text, radius: exact | null, scene_radius?: exact | null}])");
  AddLimits(verb, o.limits);
});

const ListedVerb kCheckVerb("One problem", 40, [](CommandLine& program) {
  auto [verb, o] = program.Add("check", "Verify certificates", RunCheck);
  verb.Positional("CERT", o.files, "stiction-certificate files").Required();
  verb.Option("--problem", o.problem, "problem file that all of them must speak of, by its digest");
  verb.Prints(o.json, "a row for each certificate",
              "[{file: text, accepted: truth, claim?: text, problem?: digest, facts?: object, reason?: text}]");
});

}  // namespace stiction
