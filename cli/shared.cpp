// SPDX-License-Identifier: Apache-2.0
#include "cli/shared.h"

#include <fmt/ostream.h>

#include <algorithm>
#include <csignal>
#include <sstream>

#include "certify/request/request.h"
#include "cli/help.h"
#include "corpus/json_text.h"
#include "corpus/named_rows.h"

namespace stiction {
namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

void OnSignal(int) { interrupted = true; }

template <class Options>
void AddNumbers(Verb& verb, Options& options, const char* group) {
  ForEachField(options, [&verb, group](const NumberRow& row, auto& value) {
    verb.Option("--" + std::string(row.name), value, row.help)
        .Unit(row.unit)
        .Range(row.min, row.max)
        .Group(group);
  });
}

// The switch or value that is meant by the first setting that names no switch or none of its values.
std::string NearestPolicyWord(const std::string& text) {
  std::istringstream settings(text);
  for (std::string setting; std::getline(settings, setting, ',');) {
    const std::size_t equals = std::min(setting.find('='), setting.size());
    const std::string name = setting.substr(0, equals);
    std::vector<std::string> names = NamesOf(PolicySwitches());
    names.insert(names.begin(), "paper");
    const PolicySwitchRow* const row = RowNamed(PolicySwitches(), name);
    if (row == nullptr) return Nearest(name, names);
    if (equals == setting.size()) return "";
    const std::string value = setting.substr(equals + 1);
    names = NamesOf(row->values);
    if (std::find(names.begin(), names.end(), value) == names.end()) return Nearest(value, names);
  }
  return "";
}

}  // namespace

std::string PolicyError(const std::string& text, Grid grid) {
  if (text == "*" && grid == Grid::kAllowed) return "";
  try {
    ParsePolicy(text);
    return "";
  } catch (const std::invalid_argument& error) {
    const std::string nearest = NearestPolicyWord(text);
    return nearest.empty() ? error.what() : fmt::format("{}; did you mean {}?", error.what(), nearest);
  }
}

void AddPolicyOption(Verb& verb, std::string& policy, Grid grid) {
  const char* all = grid == Grid::kAllowed ? ", or '*' for the whole planar grid" : "";
  verb.Option("-p,--policy", policy,
              fmt::format("policy, a reading of the published text, as 'stiction policies' lists them{}", all))
      .Check([grid](const std::string& text) { return PolicyError(text, grid); });
}

void AddLimits(Verb& verb, Limits& limits) { AddNumbers(verb, limits, "Budgets"); }
void AddTolerances(Verb& verb, Tolerances& tolerances) { AddNumbers(verb, tolerances, "Tolerances"); }

std::string CheckSides(const std::string& text) {
  return AreSides(std::atoi(text.c_str())) ? "" : fmt::format("found '{}', expected {}", text, kSidesExpected);
}

void AddReplace(Verb& verb, bool& replace) {
  verb.Flag("--replace", replace, "also a folder that holds files of others; it is kept as NAME.old");
}

Occupied OccupiedIf(bool replace) { return replace ? Occupied::kSetAside : Occupied::kRefused; }

void TellAside(const std::filesystem::path& aside) {
  if (!aside.empty()) fmt::print(std::cerr, "stiction: what stood there is kept as {}\n", aside.string());
}

std::string Expected(const ProblemFile& file, const Policy& policy) {
  for (const auto& [name, outcome] : file.expect) {
    if (name != "*" && ParsePolicy(name) == policy) return outcome;
  }
  const auto all = file.expect.find("*");
  return all == file.expect.end() ? "" : all->second;
}

const std::atomic<bool>& Interruption() {
  std::signal(SIGINT, OnSignal);
  std::signal(SIGTERM, OnSignal);
  if (std::signal(SIGHUP, OnSignal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  return interrupted;
}

void SayWhatWasDone(const std::string& output, bool json, const std::string& text, const SharedJson& object) {
  std::ostream& out = output == "-" ? std::cerr : std::cout;
  out << (json ? JsonText(object) + "\n" : Folded(text));
}

}  // namespace stiction
