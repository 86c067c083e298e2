// SPDX-License-Identifier: Apache-2.0
#include "cli/survey_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "cli/shared.h"
#include "corpus/json.h"
#include "solver/problem/solution.h"

namespace stiction {
namespace {

std::string Short(double x) { return x == 0 ? "0" : fmt::format("{:.0e}", x); }

std::string CurvatureText(const Json& curvature) {
  if (curvature["psd"] == true) return "yes";
  const std::string least = curvature.contains("least") ? Short(curvature["least"].get<double>()) : "?";
  if (curvature["psd"] == false)
    return fmt::format("no: {} .. {}", least, Short(curvature["most"].get<double>()));
  return ">= " + least;
}

std::string RangeText(const Json& range) {
  if (range["in-range"] == true) return range["regular"] == true ? "yes, as all are" : "yes";
  return (range["in-range"] == false ? "no: " : "<= ") + Short(range["distance"].get<double>());
}

// Says nothing of an A that is far from symmetric.
std::string RoughText(const Json& facts) {
  if (facts["asymmetry"].value("relative", 0.0) > kMostRounding) return "";
  return Short(facts["range"]["rough distance"].get<double>());
}

// The facts in a line, then a table of the runs.
void PrintRuns(const std::string& head, const std::string& asymmetry, const Json& facts) {
  const std::string rough = RoughText(facts);
  Tell("{}\n  A - A' {}; A psd: {}; b in range: {}{}\n", head, asymmetry, CurvatureText(facts["curvature"]),
       RangeText(facts["range"]), rough.empty() ? "" : "; rough " + rough);
  TextTable table({"method", "outcome", "error", "seconds"}, 2);
  for (const Json& run : facts["runs"]) {
    std::string method = run["method"].get<std::string>();
    if (run.contains("arithmetic")) method += ", " + run["arithmetic"].get<std::string>();
    std::string outcome = run["outcome"].get<std::string>();
    if (run.contains("reason")) outcome += ": " + run["reason"].get<std::string>();
    table.AddRow({method, outcome, run.contains("residual") ? Short(run["residual"].get<double>()) : "",
                  run.contains("seconds") ? fmt::format("{:.3f}", run["seconds"].get<double>()) : ""});
  }
  std::cout << table.Done();
}

}  // namespace

void PrintSurveyed(const Json& entry) {
  const std::string name = std::filesystem::path(entry["file"].get<std::string>()).filename().string();
  PrintRuns(fmt::format("{}: {} contacts{}", name, entry["contacts"].get<int>(),
                        entry["dimension"] == 3 ? " in space" : ""),
            Short(entry["asymmetry"]["relative"].get<double>()), entry);
  if (entry.contains("symmetrized")) PrintRuns("with (A + A')/2 in place of A:", "0", entry["symmetrized"]);
}

namespace {

std::string AssumptionsText(const Json& facts) {
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

// The first run that says whether there is a solution, and what the published algorithm does.
std::string RunsText(const Json& facts) {
  std::string existence = "no method that was tried solved it", published;
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
                    ? "it has no solution, as a certificate says"
                    : fmt::format("{} solves it {}, with an error of {}", method,
                                  exact ? "exactly" : "over doubles", Short(run["residual"].get<double>()));
  }
  return existence + published;
}

// Of many problems, how many meet the assumptions.
std::string MeetingText(const Json& entries) {
  int meet = 0, fail = 0, open = 0, unread = 0;
  for (const Json& entry : entries) {
    if (entry.contains("error")) {
      ++unread;
    } else {
      const Json& meets = entry["meets assumptions"];
      ++(meets == true ? meet : meets == false ? fail : open);
    }
  }
  std::string text = fmt::format("Of {} problems {} meet the paper's assumptions, {} do not, {} are undecided",
                                 entries.size(), meet, fail, open);
  if (unread > 0) text += fmt::format(", {} could not be read", unread);
  return text + ".\n";
}

}  // namespace

void PrintSurveySentences(const Json& entry) {
  Tell("\nThe problem {}.\nOf the methods: {}.\n", AssumptionsText(entry), RunsText(entry));
  if (!entry.contains("symmetrized")) return;
  const Json& symmetrized = entry["symmetrized"];
  Tell("With (A + A')/2 in place of A it {}.\nOf the methods: {}.\n", AssumptionsText(symmetrized),
       RunsText(symmetrized));
}

void PrintSurveyCounts(const Json& entries, bool suspicions) {
  std::map<std::string, std::map<std::string, int>> counts;
  for (const Json& entry : entries) {
    for (const Json& run : entry.value("runs", Json::array())) {
      const std::string method =
          fmt::format("{}, {}", run["method"].get<std::string>(), run.value("arithmetic", "-"));
      ++counts[method][run["outcome"].get<std::string>()];
    }
  }
  Tell("\n{}Each method, and how it ended{}:\n", MeetingText(entries),
       suspicions ? "; exact: those that doubles leave open" : "");
  for (const auto& [method, outcomes] : counts) {
    std::vector<std::string> parts;
    for (const auto& [outcome, count] : outcomes) parts.push_back(fmt::format("{} {}", outcome, count));
    Tell("{:24}  {}\n", method, fmt::join(parts, ", "));
  }
}

}  // namespace stiction
