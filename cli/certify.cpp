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
#include "certify/claims/policy_ends.h"
#include "certify/claims/robust.h"
#include "certify/claims/robust_scene.h"
#include "certify/claims/safe.h"
#include "certify/claims/witness.h"
#include "certify/request/facts.h"
#include "certify/request/request.h"
#include "cli/command_line.h"
#include "cli/narration/narrate_text.h"
#include "cli/narration/safety.h"
#include "cli/program.h"
#include "cli/shared.h"
#include "corpus/grouped.h"
#include "corpus/json.h"
#include "corpus/record/digest.h"
#include "corpus/record/scene_file.h"

namespace stiction {
namespace {

struct CertifyOptions : Wanted {
  std::string claim = "existence";
  std::string file;
  std::string output;
  bool all = false;
  bool safe = false;
  bool robust = false;
  bool coq = false;
  bool json = false;
};

// An enumeration is shown from when it begins to when the bar goes.
EnumerationWatch ShownBy(ProgressBar& bar) {
  return [&bar](const Enumeration& modes) {
    if (modes.prefixes % 64 == 0) {
      bar.Show(modes.decided,
               fmt::format("{:.1f} % of all mode words, {}, {}", 100 * modes.decided,
                           Counted(modes.programs, "linear program"),
                           Counted(static_cast<std::int64_t>(modes.solutions.size()), "solution")));
    }
    return true;
  };
}

std::string SolutionsText(const Enumeration& modes) {
  std::string text = fmt::format(
      "{} of the contact modes {} solutions, with {}{} ({})\n", modes.solutions.size(),
      modes.solutions.size() == 1 ? "has" : "have", Counted(modes.distinct_witnesses, "distinct witness"),
      modes.end == EnumerationEnd::kComplete ? "" : " so far: not all were looked at",
      Counted(modes.programs, "linear program"));
  for (const WordSolution& solution : modes.solutions)
    text += fmt::format("  {}: f = {}{}\n", WordText(WordToJson(solution.word)),
                        ListText(solution.f, FractionText::kShort), solution.unique ? "" : ", and others");
  return text;
}

// All words that have solutions, with a witness each.
int ListSolutions(const CertifyOptions& o, const ProblemFile& file) {
  RequirePlanar(file.problem, o.file);
  ProgressBar bar;
  const Enumeration modes = EnumerateModes(file.problem, {}, ShownBy(bar));
  bar.Clear();
  Json words = Json::array();
  for (const WordSolution& solution : modes.solutions) {
    words.push_back(
        {{"modes", WordToJson(solution.word)}, {"f", ListJson(solution.f)}, {"unique", solution.unique}});
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

int ShowSafety(const CertifyOptions& o, const ProblemFile& file) {
  RequireHandled(file.problem, o.file, "safety");
  const Json result = SafetyOf(file.problem);
  const bool decided = !result["safe"].is_null();
  if (!o.output.empty() && decided) {
    const bool few = HasFewWords(file.problem);
    const Json certificate = few ? SafetyCertificate(file.problem) : *ConditionCertificate(file.problem);
    WriteText(o.output, JsonText(certificate, 1) + "\n");
  }
  std::ostream& out = o.output == "-" ? std::cerr : std::cout;
  out << (o.json ? JsonText(result) + "\n" : Folded(SafetyText(result)));
  return decided ? kExitDone : kExitUndecided;
}

// ---- Robustness ----

// The scene that a problem file carries, if it does. The problem must be that of the scene, all contacts in
// one.
std::optional<TouchingScene> ReadTouchingScene(const CertifyOptions& o, const ProblemFile& file) {
  if (!file.scene) return std::nullopt;
  const Scene<Rational> scene = ParseScene(JsonText(file.scene), o.file + ": scene").scene;
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
  for (const Policy& policy : PoliciesAsked(o.policy, file.problem.dimension())) {
    const Request request = {.policy = policy, .limits = o.request.limits};
    const std::string name = PolicyName(policy);
    const auto radius = RadiusOfLoop(file.problem, request);
    Json& row = rows.emplace_back(Json{{"policy", name}, {"radius", RadiusToJson(radius)}});
    all = all && radius;
    if (!o.json) ShowRadiusOf(name, radius, "A, b, mu", "A, b: of the largest entry");
    if (!scene) continue;
    const auto of_scene = RadiusOfSceneLoop(*scene, request);
    row["scene_radius"] = RadiusToJson(of_scene);
    all = all && of_scene;
    if (!o.json) ShowRadiusOf(name, of_scene, "scenes", "lengths: of the largest arm; angles in radians");
  }
  if (o.json) std::cout << JsonText(rows) << "\n";
  return all ? kExitDone : kExitUndecided;
}

void RequireAffordable(const Json& certificate, const std::string& file) {
  const CheckReport report = CheckCertificate(certificate, file);
  if (report.accepted) return;
  throw InputError(
      fmt::format("{}: found a problem whose certificate no checker would take, {}: try another claim, "
                  "or a smaller problem",
                  file, report.reason));
}

// The certificate stands in a file of its own.
Json AnswerForPrograms(Json answer, const ProblemFile& file) {
  const Json certificate = std::move(answer["certificate"]);
  answer.erase("certificate");
  answer["claim"] = certificate.is_object() ? certificate["claim"] : Json();
  answer["assumptions"] = FailedAssumptions(file.problem);
  return answer;
}

std::string AnswerText(const Json& answer, const CertifyOptions& o) {
  const bool certified = answer["certificate"].is_object();
  std::string text = fmt::format("{}{}: {}\n", certified ? o.output + ": " : "",
                                 answer["asked"].get<std::string>(), ClaimSentence(answer));
  if (!certified) text += fmt::format("{} is not written: there is no certificate\n", o.output);
  if (answer.contains("policies") && answer["policies"].contains("example")) {
    const std::string policy = answer["policies"]["example"];
    text += fmt::format("shown by stiction replay {}{}\n", ShellWord(o.file),
                        policy == "paper" ? "" : " --policy " + ShellWord(policy));
  }
  return text;
}

// Proved, or refuted by its certificate: done. Refuted by a run, or so under some of the policies only: not so.
int ExitOf(const Json& answer) {
  if (answer["state"] == Name(ClaimState::kNotDecided)) return kExitUndecided;
  return IsWholeCertificate(answer) ? kExitDone : kExitNotSo;
}

int RunCertify(const CertifyOptions& o) {
  if (o.output.empty() && !o.all && !o.safe && !o.robust)
    throw InputError("certify: expected -o CERT, --all, --safe or --robust");
  if (o.robust && (o.all || o.safe || !o.output.empty()))
    throw InputError(
        "certify: found --robust with --all, --safe or -o, expected it alone: it writes no certificate");
  if (o.coq && (o.all || o.safe || o.robust))
    throw InputError("certify: found --coq with --all, --safe or --robust, expected it with --claim");
  ProblemFile file = ReadProblem(o.file);
  file.problem = InFactors(file);
  if (o.all) return ListSolutions(o, file);
  if (o.safe) return ShowSafety(o, file);
  if (o.robust) return ShowRadius(o, file);
  ProgressBar bar;
  const ExactFactors* factors = o.coq ? nullptr : file.problem.factors();
  const Json answer = CertificateOf(o.claim, o, file.problem, o.file, factors, ShownBy(bar));
  bar.Clear();
  const Json& certificate = answer["certificate"];
  const bool certified = certificate.is_object();
  if (certified) {
    RequireAffordable(certificate, o.file);
    WriteText(o.output, o.coq ? CoqText(certificate, file.problem, o.file) : JsonText(certificate, 1) + "\n");
  }
  // With the certificate itself on standard output, nothing else may stand there.
  std::ostream& out = o.output == "-" ? std::cerr : std::cout;
  out << (o.json ? JsonText(AnswerForPrograms(answer, file)) + "\n" : AsTyped(Folded(AnswerText(answer, o))));
  return ExitOf(answer);
}

struct CheckOptions {
  std::vector<std::string> files;
  std::string problem;
  bool quiet = false, json = false;
};

std::string ValueText(const Json& value) {
  return value.is_string() ? value.get<std::string>() : JsonText(value);
}

std::string ValuesText(const Json& values) {
  std::string text;
  for (const Json& value : values) text += (text.empty() ? "" : " ") + ValueText(value);
  return text;
}

std::string ReportText(const CheckReport& report) {
  if (!report.accepted) return "REJECTED: " + report.reason;
  std::string facts;
  for (const auto& [name, value] : report.facts->items())
    facts += fmt::format("{} {}, ", name, value.is_array() ? ValuesText(value) : ValueText(value));
  return fmt::format("accepted: {}, {}problem {}", report.claim, facts, report.digest);
}

Json ReportToJson(const std::string& file, const CheckReport& report) {
  return {{"file", file},
          {"accepted", report.accepted},
          {"claim", report.claim},
          {"problem", report.digest},
          {report.accepted ? "facts" : "reason", report.accepted ? *report.facts : Json(report.reason)}};
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
      if (o.quiet && report.accepted) continue;
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

const ListedVerb kCertifyVerb("Prove", 10, [](CommandLine& program) {
  auto [verb, o] = program.Add("certify", "Write a certificate: a claim with an exact witness", RunCertify);
  verb.footer =
      "A claim is proved; or disproved, by the certificate of its negation (exit 0), or by a run that ends "
      "otherwise, "
      "as where it holds under some of several policies only (exit 1); or not decided (exit 3).";
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
      {asked: claim, state: "proved" | "disproved" | "not decided", reason?: text,
       claim: claim | null,  // of the certificate that was written
       policies?: {asked: integer, so: integer, certified: integer, otherwise: counters, example?: text},
       assumptions: [assumption]} |
      {complete: truth, words: [{modes: [mode], f: [exact], unique: truth}], distinct_witnesses: integer,
       programs: integer  // linear programs
      } |
      {safe: truth | null,  // null: not decided
       by?: "words" | "condition",
       condition?: {number: exact, scaling: [exact], mu: exact | null}, threshold?: threshold,
       weakly_safe?: truth, vanishing_words?: integer, negative_word?: [mode],
       limit?: {safe: truth, word?: [mode], threshold?: threshold}} |
      certificate | [{policy: text, radius: exact | null, scene_radius?: exact | null}])");
  AddLimits(verb, o.request.limits);
});

const ListedVerb kCheckVerb("Prove", 20, [](CommandLine& program) {
  auto [verb, o] = program.Add("check", "Verify certificates", RunCheck);
  verb.Positional("CERT", o.files, "stiction-certificate files").Required();
  verb.Option("--problem", o.problem, "problem file that all of them must speak of, by its digest");
  verb.Flag("-q,--quiet", o.quiet, "say nothing of those that are accepted");
  verb.Prints(o.json, "a row for each certificate",
              "[{file: text, accepted: truth, claim?: text, problem?: digest, facts?: object, reason?: text}]");
});

}  // namespace stiction
