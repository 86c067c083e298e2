// SPDX-License-Identifier: Apache-2.0
#include "reports/tables/discovery.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <regex>
#include <string_view>
#include <tuple>

#include "corpus/json_text.h"
#include "corpus/record/kinds.h"
#include "corpus/store/finding_words.h"

namespace stiction {
namespace {

constexpr std::int64_t kMostCounted = std::int64_t{1} << 48;  // sums of them are no longer than 64 bits
constexpr std::size_t kLongestName = 200;  // file systems allow 255, and extensions come on top

// A signature names drives and steps of its loop: "cycle-2c-4d-10s-...".
std::optional<LoopLength> LoopLengthOf(const std::string& signature) {
  static const std::regex pattern("^(?:safe-)?(?:cycle|stall)-\\d+c-(\\d{1,18})d-(\\d{1,18})s(?:[-@].*)?");
  std::smatch match;
  if (!std::regex_match(signature, match, pattern)) return std::nullopt;
  return LoopLength{std::stoll(match[1]), std::stoll(match[2])};
}

GridOutcomes ReadGrid(const JsonPlace& facts) {
  GridOutcomes grid;
  const JsonPlace counts = facts.Required("grid", "outcomes over the policy grid");
  counts.RequireObject();
  for (int i = 0; i < kOutcomeCount; ++i) {
    const auto count = counts.Optional(std::string(kOutcomeNames[i]));
    if (count) grid.counts[i] = count->Integer(0, kMostCounted, "a count");
  }
  return grid;
}

RunFacts ReadRun(const JsonPlace& facts) {
  const auto count = [&facts](const char* key, std::int64_t most = kMostCounted) {
    return facts.Required(key, "a count").Integer(0, most, "a count");
  };
  RunFacts run = {
      count("contacts", 1 << 20), count("start"), count("period"), count("steps"), ReadGrid(facts), {}};
  const auto safe = facts.Optional("safe");
  if (safe && !safe->IsNull()) run.safe = safe->Truth("true, false or null");
  return run;
}

// Facts of a run in space count the steps up to where intervals could tell no more; its certificate has all.
void CountSteps(RunFacts& run, const Finding& finding, FindingForm form) {
  const bool found = form == FindingForm::kFound;
  const std::string& certificate = found ? finding.certificate : finding.minimized_certificate;
  if (certificate.empty() || !IsLoopKind(finding.kind)) return;
  if (const std::int64_t steps = ProvedRunOf(finding, form).steps; steps > 0) run.steps = steps;
}

void AddFacts(Discovery& discovery, const Finding& finding) {
  if (finding.facts.empty()) return;
  const std::string source = "facts of " + finding.signature;
  const JsonPlace root(finding.facts, source);
  root.RequireObject();
  if (const auto found = root.Optional("found")) {
    discovery.found = ReadRun(*found);
    CountSteps(*discovery.found, finding, FindingForm::kFound);
  }
  if (const auto minimized = root.Optional("minimized")) {
    discovery.minimized = ReadRun(*minimized);
    CountSteps(*discovery.minimized, finding, FindingForm::kMinimized);
  }
  if (const auto ipopt = root.Optional("ipopt")) {
    discovery.ipopt = {ipopt->Required("outcome", "an outcome of Ipopt").Text("an outcome of Ipopt"),
                       ipopt->Required("starts", "a count").Integer(0, kMostCounted, "a count")};
  }
}

FindingFiles FilesOf(const Finding& finding) {
  const std::string stem = "findings/" + FileName(finding.signature);
  const bool certified = !finding.certificate.empty() || !finding.minimized_certificate.empty();
  const bool minimized = !finding.minimized.empty();
  const std::string& existence = minimized ? finding.minimized_existence : finding.existence;
  return {stem + ".json", stem + ".original.json", certified ? stem + ".certificate.json" : "",
          existence.empty() ? "" : stem + ".existence.certificate.json",
          minimized && !finding.existence.empty() ? stem + ".original.existence.certificate.json" : ""};
}

void Represent(Discovery& discovery, const Finding& finding) {
  discovery.kind = finding.kind;
  discovery.representative = &finding;
  discovery.files = FilesOf(finding);
  AddFacts(discovery, finding);
}

bool MayStandInFileName(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return letter || (c >= '0' && c <= '9') || std::string_view("-_=,@").find(c) != std::string_view::npos;
}

std::uint64_t Hash(std::string_view text) {  // FNV-1a
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

}  // namespace

std::int64_t GridOutcomes::Total() const {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

bool GridOutcomes::IsAll(std::string_view outcome) const {
  const std::int64_t total = Total();
  for (int i = 0; i < kOutcomeCount; ++i) {
    if (kOutcomeNames[i] == outcome) return total > 0 && counts[i] == total;
  }
  return false;
}

std::int64_t GridOutcomes::Loops() const {
  return counts[static_cast<int>(Outcome::kCycle)] + counts[static_cast<int>(Outcome::kStall)];
}

bool GridOutcomes::AllLoop() const { return Loops() > 0 && Loops() == Total(); }

bool Discovery::IsLoop() const { return IsLoopKind(kind); }

bool Discovery::WholeGrid() const {
  return found && representative->exact_outcome != Name(Outcome::kSolved) &&
         found->grid.IsAll(representative->exact_outcome);
}

std::int64_t Discovery::Words() const {
  return std::llround(std::min(static_cast<double>(met), words->Count()));
}

int Discovery::SmallestContacts() const {
  return minimized ? static_cast<int>(minimized->contacts) : representative->contacts;
}

std::vector<Discovery> Discoveries(const Record& record, const std::vector<Finding>& findings) {
  std::map<std::string, Discovery> by_signature;
  for (const auto& [signature, count] : record.signatures) {
    by_signature[signature].kind = KindOf(signature);
    by_signature[signature].met = count;
  }
  for (auto& [signature, discovery] : by_signature) {
    if (const auto words = record.words.find(signature); words != record.words.end())
      discovery.words = words->second;
  }
  for (const Finding& finding : findings) Represent(by_signature[finding.signature], finding);
  std::vector<Discovery> discoveries;
  for (auto& [signature, discovery] : by_signature) {
    discovery.signature = signature;
    if (discovery.IsLoop()) discovery.loop = LoopLengthOf(signature);
    discoveries.push_back(std::move(discovery));
  }
  return discoveries;
}

std::vector<const Discovery*> ByInterest(const std::vector<Discovery>& discoveries) {
  std::vector<const Discovery*> sorted;
  for (const Discovery& discovery : discoveries) {
    if (discovery.representative != nullptr) sorted.push_back(&discovery);
  }
  const auto rank = [](const Discovery* d) {
    // The shorter the text of the minimized problem, the smaller its numbers.
    return std::tuple(Gravity(d->kind), !d->IsLoop(), !d->Finished(), d->SmallestContacts(), !d->WholeGrid(),
                      d->representative->minimized.size(), -d->met);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&rank](const Discovery* left, const Discovery* right) { return rank(left) < rank(right); });
  return sorted;
}

const Discovery* SimplestLoop(const std::vector<Discovery>& discoveries) {
  const auto rank = [](const Discovery& d) {
    return std::tuple(Gravity(d.kind), d.representative->minimized.size());
  };
  const Discovery* simplest = nullptr;
  for (const Discovery& discovery : discoveries) {
    if (!discovery.IsLoop() || !discovery.minimized) continue;
    if (simplest == nullptr || rank(discovery) < rank(*simplest)) simplest = &discovery;
  }
  return simplest;
}

std::string FileName(const std::string& signature) {
  std::string name = signature.substr(0, kLongestName);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !MayStandInFileName(c); }, '_');
  if (name == signature && !name.empty()) return name;
  return fmt::format("{}-{:016x}", name, Hash(signature));
}

}  // namespace stiction
