// SPDX-License-Identifier: Apache-2.0
#include "corpus/store/store_totals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <tuple>
#include <utility>

#include "corpus/json_text.h"
#include "corpus/program_name.h"
#include "corpus/record/kinds.h"

namespace stiction {
namespace {

void AddRecord(StoreTotals& totals) {
  totals.counts = CountAll(totals.record);
  totals.problems = ProblemsOf(totals.record);
  totals.existence = SumOf(totals.record.existence);
  totals.agreement = SumOf(totals.record.agreement);
  totals.disagreements = totals.agreement.disagreements;
  totals.loops = SumOf(totals.record.loops);
  for (const auto& [signature, count] : totals.record.signatures) ++totals.groups[LabelOf(signature)];
}

void AddFinding(StoreTotals& totals, Finding finding) {
  ++(finding.done ? totals.finished : totals.pending);
  if (IsGrave(finding.kind)) totals.grave.push_back(finding);
  // Its signature stays that of what it was met as.
  totals.disagreements +=
      finding.kind == kDisagreementOfMethods && KindOf(finding.signature) != kDisagreementOfMethods;
  if (!finding.done || finding.minimized.empty()) return;
  if (IsLoopKind(finding.kind)) {
    const SharedJson facts = MinimizedFacts(finding);
    const auto grid = JsonPlace(facts, finding.signature, "").Required("grid", "outcomes").Members();
    totals.finished_loops += !grid.empty();
    totals.whole_grid += grid.size() == 1;
  }
  totals.simplest.push_back(std::move(finding));
}

}  // namespace

std::string LabelOf(const std::string& signature) {
  for (std::size_t dash = signature.find('-'); dash != signature.npos; dash = signature.find('-', dash + 1)) {
    if (dash + 1 < signature.size() && std::isdigit(static_cast<unsigned char>(signature[dash + 1])) != 0) {
      return signature.substr(0, dash);
    }
  }
  return signature;
}

bool LabelsByGravity::operator()(const std::string& left, const std::string& right) const {
  const auto rank = [](const std::string& label) {
    const std::string kind = KindOf(label + "-");
    return std::tuple(Gravity(kind), !IsLoopKind(kind), label);
  };
  return rank(left) < rank(right);
}

std::int64_t StoreTotals::LoopGroups() const {
  std::int64_t sum = 0;
  for (const auto& [label, count] : groups) sum += IsLoopKind(KindOf(label + "-")) ? count : 0;
  return sum;
}

SharedJson MinimizedFacts(const Finding& finding) {
  const std::string source = "facts of " + finding.signature;
  const JsonPlace facts(finding.facts, source);
  const JsonPlace minimized = facts.Required("minimized", "those of the minimized problem");
  minimized.Required("grid", "outcomes over the policy grid").RequireObject();
  for (const char* key : {"contacts", "start", "period"}) minimized.Required(key, "a number");
  return minimized.json();
}

StoreTotals TotalsOf(const Store& store) {
  StoreTotals totals;
  totals.record = store.Total();
  totals.work = store.TotalWork();
  totals.units = store.Units().Count();
  AddRecord(totals);
  for (Finding& finding : store.Findings()) AddFinding(totals, std::move(finding));
  const auto rank = [](const Finding& f) {
    return std::tuple(Gravity(f.kind), !IsLoopKind(f.kind), f.minimized.size());
  };
  std::stable_sort(totals.simplest.begin(), totals.simplest.end(),
                   [&rank](const Finding& left, const Finding& right) { return rank(left) < rank(right); });
  return totals;
}

std::string TimeText(const ProcessorTime& time) {
  const auto total = static_cast<double>(time.Total());
  if (total == 0) return "";
  std::string parts;
  ForEachPart(time, [&](const char* name, const char*, std::int64_t value) {
    const double share = 100 * static_cast<double>(value) / total;
    if (value > 0)
      parts += fmt::format("{}{} {:.{}f} %", parts.empty() ? "" : ", ", name, share, share < 1 ? 1 : 0);
  });
  return fmt::format("processor time: {:.4g} s: {}", total * 1e-6, parts);
}

std::string FinishCommand(const std::string& file) {
  return fmt::format("{} search --store {} --finish", ProgramName(), file);
}

}  // namespace stiction
