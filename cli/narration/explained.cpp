// SPDX-License-Identifier: Apache-2.0
#include "cli/narration/explained.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

#include "certify/claims/claims.h"
#include "certify/claims/policy_ends.h"
#include "certify/claims/robust.h"
#include "certify/claims/safe.h"
#include "certify/exact/answer_json.h"
#include "certify/request/facts.h"
#include "certify/request/request.h"
#include "cli/narration/outcome_text.h"
#include "cli/narration/published_ends.h"
#include "cli/narration/safety.h"
#include "corpus/formats/read_problem.h"
#include "corpus/grouped.h"
#include "corpus/json.h"
#include "corpus/plain_text.h"
#include "corpus/record/kinds.h"
#include "corpus/record/loop_sentence.h"
#include "corpus/store/finding_words.h"

namespace stiction {
namespace {

// ---- What is found ---------------------------------------------------------------------------------

// Contacts by kind, the least and the largest mu, the least and the largest A_ii that is not zero.
void AddContacts(const AnyProblem& problem, Json& found) {
  Json kinds = Json::object();
  std::vector<Rational> mu, diagonal;
  for (const auto& contact : problem.contacts()) {
    const std::string kind(Name(contact.kind));
    kinds[kind] = kinds.value(kind, 0) + 1;
    if (contact.HasFrictionRows()) mu.push_back(contact.mu);
  }
  for (const Rational& value : problem.entries().A.diagonal().eval())
    if (value != 0) diagonal.push_back(value);
  found["kinds"] = kinds;
  const auto add = [&found](const char* name, const std::vector<Rational>& numbers) {
    if (numbers.empty()) return;
    const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
    found[name] = {ToString(*least), ToString(*most)};
  };
  add("mu", mu);
  add("diagonal", diagonal);
}

// How every policy ends, by outcome; of those that loop the first, as `paper` is, and its loop. Null in space
// where doubles do not hold the problem.
Json PoliciesOn(const ExactProblem& problem, const ExplainOptions& o) try {
  Wanted wanted{.method = "baraff", .request = {.limits = o.limits}};
  const std::map<std::string, Json> ends = OutcomesOf(wanted, problem, o.file);
  Json found = {{"all", ends.size()},
                {"arithmetic", problem.dimension == 2 ? "exact" : "double"},
                {"outcomes", Json::object()},
                {"loops", nullptr}};
  Json &outcomes = found["outcomes"], &loop = found["loops"];
  for (const Policy& policy : GridOf(problem.dimension)) {
    const std::string name = PolicyName(policy), outcome = ends.at(name)["outcome"];
    outcomes[outcome] = outcomes.value(outcome, 0) + 1;
    if (!loop.is_null() || !ends.at(name).contains("period")) continue;
    loop = ends.at(name);
    loop["policy"] = wanted.policy = name;
  }
  if (loop.is_null()) return found;
  const auto proved = OverIntervals(problem, PathRequestOf(wanted, problem, o.file), Outcome::kCycle);
  const bool by_intervals = proved && IsLoop(proved->outcome);
  loop["proved"] = problem.dimension == 2 || by_intervals;
  // Intervals tell where the loop begins, too; over doubles it begins where rounded states recur.
  if (by_intervals) loop.update(EndToJson(*proved));
  loop["kind"] = Name(by_intervals && !proved->reason.empty() ? ProofKind::kBox : ProofKind::kStates);
  return found;
} catch (const InputError&) {
  return nullptr;
}

// How `solve` ends on it by the method of this name.
Json EndOf(std::string_view method, const ProblemFile& file, const ExplainOptions& o) {
  const Wanted wanted{.method = std::string(method), .request = {.limits = o.limits}};
  const Request request = RequestOf(wanted, file.problem, o.file);
  Json run = {{"method", method}, {"arithmetic", Name(request.arithmetic)}};
  const auto add = [&run](const auto& answer) {
    run.update(EndToJson(answer));
    if (answer.moves_elsewhere) run["unique_accelerations"] = false;
  };
  std::visit(add, SolveAsked(file.problem, request, o.file).answer);
  return run;
}

// How `solve` ends on it by default. Where it refuses, as it does in space of numbers that no double holds,
// why.
Json EndByDefault(const ProblemFile& file, const ExplainOptions& o) try {
  return EndOf(kAutomatic, file, o);
} catch (const InputError& error) {
  const Arithmetic arithmetic = UsualArithmetic(kAutomatic, file.problem).arithmetic;
  return {{"method", kAutomatic},
          {"arithmetic", Name(arithmetic)},
          {"outcome", "not tried"},
          {"reason", error.what()}};
}

// How every method ends that is built for such a problem, in its usual arithmetic.
Json MethodsOn(const ProblemFile& file, const ExplainOptions& o) {
  Json runs = Json::array();
  for (const MethodFacts& facts : AllMethods()) {
    try {
      runs.push_back(EndOf(facts.name, file, o));
    } catch (const InputError&) {  // not built for such problems, or a number is none of the arithmetic's
    }
  }
  return runs;
}

// The contact modes that have solutions, in the plane.
Json SolutionsOf(const ExactProblem& problem) {
  const Enumeration modes = EnumerateModes(problem, {.limits = {.programs = kProgramsOfOne}});
  Json words = Json::array();
  bool unique = modes.distinct_witnesses == 1;
  for (const WordSolution& solution : modes.solutions) {
    words.push_back(WordToJson(solution.word));
    unique = unique && solution.unique;
  }
  return {{"complete", modes.end == EnumerationEnd::kComplete}, {"modes", words}, {"unique", unique}};
}

// The mu below which A is safe, and how far all numbers of the loop may move while it stays one.
void AddMargins(const ExactProblem& problem, const ExplainOptions& o, Json& found) {
  const bool handled =
      problem.dimension == 2 && !found["kinds"].contains("bilateral") && !found["kinds"].contains("sliding");
  if (handled && HasFewWords(problem, kExplainedWords)) {
    found["safety"] = SafetyOf(problem);
    const Json& safety = found["safety"];
    found["safe_below"] = safety.contains("threshold") ? safety["threshold"]["low"] : Json();
  }
  if (!handled) return;
  const Json& loop = found["policies"]["loops"];
  if (loop.is_null()) return;
  const auto radius =
      RadiusOfLoop(problem, {.policy = ParsePolicy(loop["policy"].get<std::string>()), .limits = o.limits});
  found["radius"] = radius ? Json(ToString(*radius)) : Json();
}

// Every claim that is made of such problems: the certificate that it gets, or null, and the command.
Json ClaimsOf(const ProblemFile& file, const ExplainOptions& o, const std::string& policy) {
  const ExactProblem& problem = file.problem;
  Json claims = Json::array();
  Request request = {.limits = o.limits};
  request.limits.programs = kProgramsOfOne;
  const std::vector<Policy> policies = PoliciesAsked(policy, problem.dimension);
  const ExactFactors* factors = file.problem.factors();
  const std::string stem = std::filesystem::path(o.file).stem().string();
  for (const Claim& claim : AllClaims()) {
    if (claim.certify == nullptr) continue;
    try {
      claim.require(problem, o.file);
      const Json answer = ToJson(claim.Decide(problem, request, policies, factors), claim.name);
      const Json& certificate = answer["certificate"];
      constexpr std::string_view kOfRuns[] = {"cycle", "ray", "endless", "counterexample"};
      const bool of_runs = std::ranges::find(kOfRuns, claim.name) != std::end(kOfRuns);
      claims.push_back(
          {{"claim", claim.name},
           {"meaning", claim.meaning},
           {"state", answer["state"]},
           {"says", ClaimSentence(answer)},
           {"certificate", certificate.is_object() ? certificate["claim"] : Json()},
           {"command", fmt::format("stiction certify {} --claim {}{} -o {}", ShellWord(o.file), claim.name,
                                   of_runs && policy != "paper" ? " --policy " + policy : "",
                                   ShellWord(fmt::format("{}-{}.json", stem, claim.name)))}});
    } catch (const InputError&) {  // not made of such problems
    }
  }
  return claims;
}

// The certificate that a claim gets; empty where it gets none.
std::string CertificateFor(const Json& found, std::string_view claim) {
  for (const Json& each : found.value("claims", Json::array())) {
    if (each["claim"] == claim && each["certificate"].is_string()) return each["certificate"];
  }
  return "";
}

Json NextOf(const Json& found, const std::string& file) {
  Json next = Json::array();
  const auto add = [&](const std::string& verb, const std::string& options, const char* shows) {
    next.push_back(
        {{"command", fmt::format("stiction {} {}{}", verb, ShellWord(file), options)}, {"shows", shows}});
  };
  if (!found.contains("solve") || found["solve"]["outcome"] != "not tried")
    add("solve", "", CertificateFor(found, "existence") == "no-solution" ? "why there are none" : "the forces");
  // What fails over doubles does so there alone.
  const auto named = FindNamed(file);
  const bool of_doubles = named && IsOfDoubles(named->finding.kind);
  if (of_doubles)
    add("replay", ReplayOptionsOf(named->finding) + " --step", "the run that was found, over doubles");
  if (found.contains("policies")) {
    const Json& loop = found["policies"]["loops"];
    const bool other = !loop.is_null() && loop["policy"] != "paper";
    const std::string policy = other ? " --policy " + loop["policy"].get<std::string>() : "";
    const bool exactly = found["policies"]["arithmetic"] == "exact";
    add("replay", policy + " --step",
        exactly ? "the published algorithm, step by step, exactly"
                : "the published algorithm, step by step, over doubles");
    add("replay", policy + " --html run.html", "the same as a page, beside complete driving");
    add("replay", " --all-policies", "which policies end how, and what they have in common");
    if (!loop.is_null() && loop["proved"] == true)
      add("minimize", policy + " -o smaller.json", "a simpler problem that loops");
  }
  if (found.contains("solutions")) add("certify", " --all", "all contact modes that have solutions");
  if (found.contains("safe_below")) add("certify", " --safe", "where the path of forces can turn back");
  if (found.contains("radius"))
    add("certify", " --robust", "how far all numbers may move while the loop stays one");
  return next;
}

}  // namespace

SharedJson Explained(ProblemFile file, const ExplainOptions& o) {
  file.problem = InFactors(file);
  Json found = {{"file", o.file}};
  AddContacts(file.problem, found);
  found["survey"] = Surveyed(file.problem, o.limits);
  if (file.problem.rows() <= kExplainedRows) {
    const ExactProblem& problem = file.problem;
    std::string policy = "paper";
    found["rank"] = RankOf(problem.A);
    found["methods"] = MethodsOn(file, o);
    found["solve"] = EndByDefault(file, o);
    if (problem.contacts.size() <= kExplainedContacts) {
      const Json policies = PoliciesOn(problem, o);
      if (!policies.is_null()) found["policies"] = policies;
      if (problem.dimension == 2) found["solutions"] = SolutionsOf(problem);
      AddMargins(problem, o, found);
      if (policies.contains("loops") && !policies["loops"].is_null()) policy = policies["loops"]["policy"];
    }
    found["claims"] = ClaimsOf(file, o, policy);
  }
  found["next"] = NextOf(found, o.file);
  return found;
}

namespace {

// ---- In words --------------------------------------------------------------------------------------

std::string BetweenText(const Json& ends) {
  const auto text = [](const Json& end) {
    return Text(*ParseRational(end.get<std::string>()), FractionText::kShort);
  };
  return ends[0] == ends[1] ? text(ends[0]) : fmt::format("{} to {}", text(ends[0]), text(ends[1]));
}

std::string AssumptionsMetText(const Json& facts) {
  if (facts["meets assumptions"] == true)
    return "meets the paper's assumptions: A is symmetric and semidefinite, b in its range";
  if (facts["meets assumptions"].is_null())
    return "may meet the paper's assumptions: nothing fails, but bounds do not decide them all";
  std::vector<std::string> failing;
  if (facts["asymmetry"]["difference"] != 0) failing.emplace_back("A is not symmetric");
  if (facts["curvature"]["psd"] == false) failing.emplace_back("A is not semidefinite");
  if (facts["range"]["in-range"] == false) failing.emplace_back("b is not in the range of A");
  return fmt::format("does not meet the paper's assumptions: {}", fmt::join(failing, ", "));
}

std::string RunsText(const Json& facts) {
  std::string existence = "No method that was tried solved it", published;
  bool found = false;
  for (const Json& run : facts["runs"]) {
    const std::string method = run["method"].get<std::string>(), outcome = run["outcome"].get<std::string>();
    const bool exact = run.value("arithmetic", "") == "exact";
    if (method == "baraff") {
      published = fmt::format("; the published algorithm {} {}",
                              outcome == "cycle"    ? "loops for ever"
                              : outcome == "solved" ? "solves it"
                              : outcome == "wrong"  ? "returns forces that are wrong"
                                                    : "ends in " + outcome,
                              exact ? "(policy paper, exactly)" : "(policy paper, over doubles)");
    }
    if (found || (outcome != "solved" && outcome != "no-solution")) continue;
    found = true;
    existence = outcome == "no-solution"
                    ? "It has no solution, as a certificate says"
                    : fmt::format("Method {} solves it {}, with an error of {}", method,
                                  exact ? "exactly" : "over doubles", ShortText(run["residual"].get<double>()));
  }
  return existence + published + ".";
}

std::string ProblemText(const Json& found) {
  const Json& facts = found["survey"];
  std::vector<std::string> kinds;
  for (const auto& [kind, count] : found["kinds"].items()) kinds.push_back(JsonText(count) + " " + kind);
  std::string text = fmt::format("{} {}{}{}", Counted(facts["contacts"], "contact"),
                                 facts["dimension"] == 3 ? "in space" : "in the plane",
                                 kinds.empty() ? "" : ": ", fmt::join(kinds, ", "));
  if (found.contains("mu")) text += ", mu " + BetweenText(found["mu"]);
  text += fmt::format(". A has {}", Counted(facts["rows"], "row"));
  if (found.contains("rank")) text += ", rank " + JsonText(found["rank"]);
  if (found.contains("diagonal")) text += fmt::format(", A_ii {}", BetweenText(found["diagonal"]));
  return text + fmt::format(". The problem {}.", AssumptionsMetText(facts));
}

std::string ExistenceText(const Json& found) {
  const Json& facts = found["survey"];
  const bool in_range = facts["range"]["in-range"] == true, slides = found["kinds"].contains("sliding");
  const std::string existence = CertificateFor(found, "existence");
  if (existence == "no-solution") return "No: that no forces meet all conditions is proved.";
  std::string text;
  if (CertificateFor(found, "exists") == "exists" || (facts["meets assumptions"] == true && !slides))
    text = fmt::format(
        "Yes, by a theorem (certify/existence.md), for {}: A is symmetric and semidefinite, no contact slides, "
        "and {}. ",
        in_range ? "every mu" : "these mu",
        in_range ? "b is in the range of A" : "b.v >= 0 for all forces v that friction allows with A v = 0");
  const std::string yes = text.empty() ? "Yes. " : text;
  if (existence == "solution-exists") return yes + "Forces that meet every condition are found, exactly.";
  if (existence == "coulomb-solution")
    return yes + "Forces are found that obey Coulomb's law within a proved bound on the angle of slip.";
  if (CertificateFor(found, "solution-exists") == "solution-exists")
    return yes + "Forces that meet the paper's conditions in space, (21) and (22), are found, exactly.";
  return text.empty() ? "Nothing that was run proves that there is one, or none."
                      : text + "No exact forces are found here.";
}

std::string PoliciesText(const Json& policies) {
  std::vector<std::string> parts;
  for (const auto& [outcome, count] : policies["outcomes"].items())
    parts.push_back(fmt::format("{} {}", outcome, Grouped(count.get<std::int64_t>())));
  const std::string text = fmt::format(
      "The published algorithm under {}, readings of its text{}: {}.", Counted(policies["all"], "policy"),
      policies["arithmetic"] == "exact" ? "" : ", over doubles", fmt::join(parts, ", "));
  const Json& loop = policies["loops"];
  if (loop.is_null()) return text;
  const ProvedRun run{loop["kind"] == "box" ? ProofKind::kBox : ProofKind::kStates, loop["start"],
                      loop["period"]};
  return text + fmt::format(" Under {} {}{}.", loop["policy"].get<std::string>(), LoopSentence(run),
                            loop["proved"] == true ? "" : ", as far as rounded numbers tell");
}

std::string SurenessText(const Json& found) {
  std::string text;
  if (found.contains("solutions")) {
    const Json& solutions = found["solutions"];
    std::vector<std::string> words;
    for (const Json& word : solutions["modes"])
      words.push_back(fmt::format("{}", fmt::join(word.get<std::vector<std::string>>(), " ")));
    text += fmt::format("{} of contact modes {}{}",
                        words.empty()       ? "No choice"
                        : words.size() == 1 ? "One choice"
                                            : fmt::format("{} choices", words.size()),
                        words.size() > 1 ? "have solutions" : "has a solution",
                        solutions["complete"] == true ? "" : ", as far as they were looked at");
    text += words.empty() ? ". " : fmt::format("{}{}. ", words.size() == 1 ? ": " : ", the first ", words[0]);
    if (solutions["complete"] == true && !words.empty())
      text += solutions["unique"] == true ? "Its forces are the only ones. "
                                          : "There are other forces that meet all conditions. ";
  }
  if (found.contains("safety")) text += fmt::format("A is {}. ", SafetySentence(found["safety"]));
  if (found.contains("safe_below"))
    text += found["safe_below"].is_null() ? "With one mu for all contacts it is safe, whatever mu is. "
            : found["safe_below"] == "0"  ? "With one mu for all contacts it is safe for no mu. "
                                          : fmt::format("With one mu for all contacts it is safe below {}. ",
                                                        found["safe_below"].get<std::string>());
  if (found.contains("radius"))
    text += found["radius"].is_null()
                ? "No distance is proved within which the loop stays one. "
                : fmt::format("The loop stays one while A, b and mu move by up to {} of their size, proved. ",
                              found["radius"].get<std::string>());
  if (found.contains("solve") && found["solve"].contains("unique_accelerations"))
    text +=
        "They are not unique: others with other accelerations are known, and `solve` gives those that move "
        "less. ";
  if (!found.contains("solutions"))
    text += "Whether other forces obey the law, too, is not looked for in space, or with so many contacts. ";
  return text;
}

std::string MethodsText(const Json& found) {
  const Json& facts = found["survey"];
  std::string text = "\nWhat the methods do\n" + Paragraph(RunsText(facts));
  if (found.contains("policies")) text += Paragraph(PoliciesText(found["policies"]));
  if (facts.contains("symmetrized"))
    text += Paragraph(fmt::format("With (A + A')/2 in place of A it {}. {}",
                                  AssumptionsMetText(facts["symmetrized"]), RunsText(facts["symmetrized"])));
  TextTable table({"method", "end"}, 2);
  for (const Json& run : found.value("methods", Json::array())) {
    std::string end = run["outcome"];
    if (run.contains("period"))
      end += fmt::format(": from {} on, every {}", JsonText(run["start"]), JsonText(run["period"]));
    if (run.contains("reason")) end += ": " + run["reason"].get<std::string>();
    table.AddRow(
        {fmt::format("  {}, {}", run["method"].get<std::string>(), run["arithmetic"].get<std::string>()), end});
  }
  return text + table.Done();
}

// A command stands on a line of its own, however long: it is to be copied.
std::string LineOfCommand(const Json& command) { return "    " + command.get<std::string>() + "\n"; }

std::string CommandsText(const Json& found) {
  std::string text = found.contains("claims") ? "\nWhat can be certified\n" : "";
  for (const Json& claim : found.value("claims", Json::array())) {
    const bool certified = claim["certificate"].is_string();
    const bool told = claim["claim"] != "existence" && certified &&
                      claim["certificate"] == CertificateFor(found, "existence");
    if (told) continue;
    text +=
        Paragraph(fmt::format("{}: {}", claim["claim"].get<std::string>(), claim["says"].get<std::string>()));
    if (certified) text += LineOfCommand(claim["command"]);
  }
  text += "\nWhat to type next\n";
  for (const Json& each : found["next"])
    text += Paragraph(each["shows"].get<std::string>()) + LineOfCommand(each["command"]);
  return text;
}

}  // namespace

std::string ExplainedText(const Json& found) {
  return Folded(found["file"].get<std::string>() + "\n") + Paragraph(ProblemText(found)) +
         "\nIs there a solution?\n" + Paragraph(ExistenceText(found)) + MethodsText(found) +
         "\nHow sure are the forces?\n" + Paragraph(SurenessText(found)) + CommandsText(found);
}

}  // namespace stiction
