// SPDX-License-Identifier: Apache-2.0
#include "cli/survey_text.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

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
  if (range["in-range"] == true) return range["regular"] == true ? "all" : "yes";
  return (range["in-range"] == false ? "no: " : "<= ") + Short(range["distance"].get<double>());
}

// Says nothing of an A that is far from symmetric.
std::string RoughText(const Json& facts) {
  if (facts["asymmetry"].value("relative", 0.0) > kMostRounding) return "";
  return Short(facts["range"]["rough distance"].get<double>());
}

constexpr const char* kRow = "{:42} {:>7} {:>7}  {:18} {:8} {:>7}  {:16} {:>8} {:>8}  {}\n";

void PrintRow(const std::string& file, const std::string& contacts, const std::string& asymmetry,
              const Json& facts, const Json& run) {
  std::string method = run["method"].get<std::string>();
  if (run.contains("arithmetic")) method += ", " + run["arithmetic"].get<std::string>();
  std::string outcome = run["outcome"].get<std::string>();
  if (run.contains("reason")) outcome += ": " + run["reason"].get<std::string>();
  const bool first = !facts.is_null();
  fmt::print(kRow, file, contacts, asymmetry, first ? CurvatureText(facts["curvature"]) : "",
             first ? RangeText(facts["range"]) : "", first ? RoughText(facts) : "", method,
             run.contains("residual") ? Short(run["residual"].get<double>()) : "",
             run.contains("seconds") ? fmt::format("{:.3f}", run["seconds"].get<double>()) : "", outcome);
}

// The facts once, then a line for every run.
void PrintRuns(const std::string& file, const std::string& contacts, const std::string& asymmetry,
               const Json& facts) {
  bool first = true;
  for (const Json& run : facts["runs"]) {
    first ? PrintRow(file, contacts, asymmetry, facts, run) : PrintRow("", "", "", nullptr, run);
    first = false;
  }
}

}  // namespace

void PrintSurveyHead() {
  fmt::print(kRow, "problem", "contacts", "A - A'", "A psd", "b in", "rough", "method", "error", "seconds",
             "outcome");
}

void PrintSurveyed(const Json& entry) {
  PrintRuns(std::filesystem::path(entry["file"].get<std::string>()).filename().string(),
            fmt::format("{} {}D", entry["contacts"].get<int>(), entry["dimension"].get<int>()),
            Short(entry["asymmetry"]["relative"].get<double>()), entry);
  if (entry.contains("symmetrized")) PrintRuns("  (A + A')/2", "", "0", entry["symmetrized"]);
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
  fmt::print(std::cout, "\nThe problem {}.\nOf the methods: {}.\n", AssumptionsText(entry), RunsText(entry));
  if (!entry.contains("symmetrized")) return;
  const Json& symmetrized = entry["symmetrized"];
  fmt::print(std::cout, "With (A + A')/2 in place of A it {}.\nOf the methods: {}.\n",
             AssumptionsText(symmetrized), RunsText(symmetrized));
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
  fmt::print(std::cout, "\n{}Each method, and how it ended{}:\n", MeetingText(entries),
             suspicions ? "; exact: those that doubles leave open" : "");
  for (const auto& [method, outcomes] : counts) {
    std::vector<std::string> parts;
    for (const auto& [outcome, count] : outcomes) parts.push_back(fmt::format("{} {}", outcome, count));
    fmt::print(std::cout, "{:24} {}\n", method, fmt::join(parts, ", "));
  }
}

}  // namespace stiction
