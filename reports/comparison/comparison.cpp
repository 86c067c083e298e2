// SPDX-License-Identifier: Apache-2.0
#include "reports/comparison/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "corpus/counts.h"
#include "corpus/grouped.h"
#include "corpus/input_error.h"
#include "corpus/intervals.h"
#include "corpus/json_text.h"
#include "corpus/plain_text.h"
#include "reports/comparison/comparison_page.h"
#include "reports/report_files.h"
#include "reports/tables/csv.h"
#include "reports/tables/friction_order.h"

namespace stiction {
namespace {

// ---- What is compared ----

// Of a tally or a stratum.
template <class Runs>
Counts CountsOf(const Runs& runs) {
  Counts counts;
  counts.Add(runs);
  return counts;
}

struct Measure {
  const char* name;
  const char* meaning;
  Trials (*of)(const Tally&);
};

constexpr Measure kMeasures[] = {{"loops", "runs that loop, confirmed exactly",
                                  [](const Tally& t) {
                                    return Trials{CountsOf(t).Loops(), t.problems};
                                  }},
                                 {"singular", "runs without a direction of the forces, confirmed exactly",
                                  [](const Tally& t) {
                                    return Trials{CountsOf(t).Of(Outcome::kSingular), t.problems};
                                  }},
                                 {"rays", "runs with a step without end, confirmed exactly",
                                  [](const Tally& t) {
                                    return Trials{CountsOf(t).Of(Outcome::kRay), t.problems};
                                  }},
                                 {"zero-steps", "runs with a step of length zero",
                                  [](const Tally& t) {
                                    return Trials{t.with_zero_steps, t.problems};
                                  }},
                                 {"give-ups", "runs that gave something up",
                                  [](const Tally& t) {
                                    return Trials{t.with_give_ups, t.problems};
                                  }},
                                 {"misjudged", "audited runs that ended otherwise in exact arithmetic",
                                  [](const Tally& t) {
                                    return Trials{t.misjudged, t.audited};
                                  }},
                                 {"wrong", "runs called solved with forces that are none", [](const Tally& t) {
                                    return Trials{t.wrong, t.problems};
                                  }}};

struct StratumMeasure {
  const char* name;
  const char* meaning;
  Trials (*of)(const Stratum&);
};

constexpr StratumMeasure kStratumMeasures[] = {
    {"loops", "runs that loop, confirmed exactly",
     [](const Stratum& s) {
       return Trials{CountsOf(s).Loops(), s.problems};
     }},
    {"misjudged", "audited runs that ended otherwise in exact arithmetic", [](const Stratum& s) {
       return Trials{s.misjudged, s.audited};
     }}};

std::map<std::string, Stratum, ByFriction> FrictionsOf(const Tally& tally) {
  std::map<std::string, Stratum, ByFriction> frictions;
  for (const auto& [key, stratum] : tally.strata) frictions[key.friction].Merge(stratum);
  return frictions;
}

// The least number of steps that at least half of the runs of both together do not exceed.
int PooledMedian(const Tally& a, const Tally& b) {
  const std::int64_t all = a.problems + b.problems;
  std::int64_t up_to = 0;
  for (int steps = 0; steps < Tally::kBins; ++steps) {
    up_to += a.steps[steps] + b.steps[steps];
    if (2 * up_to >= all) return steps;
  }
  return Tally::kBins - 1;
}

Trials StepsAbove(const Tally& tally, int median) {
  Trials trials;
  for (int steps = 0; steps < Tally::kBins; ++steps) {
    trials.of += tally.steps[steps];
    trials.count += steps > median ? tally.steps[steps] : 0;
  }
  return trials;
}

void AddRates(Comparison& comparison, const TallyKey& key, const Tally& a, const Tally& b) {
  for (const Measure& measure : kMeasures)
    comparison.rates.push_back({key, "", measure.name, measure.meaning, measure.of(a), measure.of(b), {}, {}});
  const int median = PooledMedian(a, b);
  comparison.rates.push_back({key,
                              "",
                              fmt::format("steps-above-{}", median),
                              fmt::format("runs of more than {} steps, the median of both", median),
                              StepsAbove(a, median),
                              StepsAbove(b, median),
                              {},
                              {}});
  const auto frictions_a = FrictionsOf(a), frictions_b = FrictionsOf(b);
  for (const auto& [friction, stratum] : frictions_a) {
    const auto found = frictions_b.find(friction);
    if (found == frictions_b.end()) continue;
    for (const StratumMeasure& measure : kStratumMeasures)
      comparison.rates.push_back({key,
                                  friction,
                                  measure.name,
                                  measure.meaning,
                                  measure.of(stratum),
                                  measure.of(found->second),
                                  {},
                                  {}});
  }
}

void AddTests(Comparison& comparison) {
  std::vector<double> p;
  for (ComparedRate& rate : comparison.rates) {
    if (!CanDiffer(rate.a, rate.b)) continue;
    rate.p = FisherTest(rate.a, rate.b);
    p.push_back(*rate.p);
  }
  const std::vector<double> adjusted = Holm(p);
  std::size_t next = 0;
  for (ComparedRate& rate : comparison.rates) {
    if (rate.p) rate.adjusted = adjusted[next++];
  }
  comparison.tests = static_cast<std::int64_t>(p.size());
}

// ---- What differs by design ----

std::vector<std::string> Differences(const CampaignIdentity& a, const CampaignIdentity& b) {
  constexpr std::string_view kVersion = "version of the algorithm";
  std::vector<std::string> lines;
  if (a.algorithm != b.algorithm) {
    lines.push_back(fmt::format("{}: {} in A, {} in B. What differs below can be that of the two programs",
                                kVersion, a.algorithm, b.algorithm));
  }
  for (const auto& [part, of_a, of_b] : DifferencesOf(a, b)) {
    if (part != kVersion)
      lines.push_back(
          fmt::format("{}: A: {}; B: {}", part, of_a.empty() ? "none" : of_a, of_b.empty() ? "none" : of_b));
  }
  if (a.seed == b.seed)
    lines.push_back(
        fmt::format("seed: {} in both. The tests take problems for independent draws, which those of one "
                    "seed need not be",
                    a.seed));
  return lines;
}

// ---- Text ----

double RateOf(const Trials& t) { return static_cast<double>(t.count) / static_cast<double>(t.of); }

}  // namespace

std::string NameOf(const TallyKey& key) {
  std::string name = fmt::format("{}, {} contacts", key.generator, key.contacts);
  if (key.policy != "paper") name += ", policy " + key.policy;
  if (key.method != "baraff") name += ", method " + key.method;
  if (key.arithmetic != "double") name += ", arithmetic " + key.arithmetic;
  return name;
}

std::string PText(double p) { return p == 0 ? "< 1e-300" : fmt::format("{:.2g}", p); }

bool MoreInA(const ComparedRate& rate) { return RateOf(rate.a) > RateOf(rate.b); }

std::string SentenceOf(const ComparedRate& rate) {
  const auto side = [](const Trials& t) {
    return fmt::format("{} of {}, {}", Grouped(t.count), Grouped(t.of), ShareText(t.count, t.of));
  };
  return fmt::format("{}{}: {}: more in {}: A {}; B {}; p = {} corrected.", NameOf(rate.key),
                     rate.friction.empty() ? "" : ", mu = " + rate.friction, rate.meaning,
                     MoreInA(rate) ? "A" : "B", side(rate.a), side(rate.b), PText(*rate.adjusted));
}

std::vector<const ComparedRate*> BeyondNoise(const Comparison& comparison) {
  std::vector<const ComparedRate*> beyond;
  for (const ComparedRate& rate : comparison.rates) {
    if (rate.MoreThanNoise()) beyond.push_back(&rate);
  }
  std::stable_sort(beyond.begin(), beyond.end(), [](const ComparedRate* left, const ComparedRate* right) {
    return *left->adjusted < *right->adjusted;
  });
  return beyond;
}

std::string NoiseSentence(const Comparison& comparison) {
  const std::size_t beyond = BeyondNoise(comparison).size();
  const std::string tests = Grouped(comparison.tests);
  return beyond == 0 ? fmt::format("None of {} tests finds a difference that is more than noise.", tests)
                     : fmt::format("{} of {} tests find a difference that is more than noise:", beyond, tests);
}

std::string AboutTests() {
  return "Fisher's exact test of each rate, two-sided; steps by the runs above the median of both together. p "
         "is corrected by Holm for all tests that the counts leave open; at most 0.05 is called more than "
         "noise. In brackets: exact intervals at 95 %.";
}

std::string OnlyIn(const std::vector<TallyKey>& keys, const char* name) {
  if (keys.empty()) return "";
  std::map<std::string, std::set<int>> generators;
  for (const TallyKey& key : keys) generators[key.generator].insert(key.contacts);
  std::string text;
  for (const auto& [generator, contacts] : generators)
    text += fmt::format("{}{} ({} contacts)", text.empty() ? "" : "; ", generator, fmt::join(contacts, ", "));
  return fmt::format("Only in {}, and not compared: {}.", name, text);
}

namespace {

std::string NoiseText(const Comparison& c) {
  std::string text = Paragraph(NoiseSentence(c), 0);
  for (const ComparedRate* rate : BeyondNoise(c)) text += Paragraph(SentenceOf(*rate));
  return text;
}

// "near-degenerate, 2", and what is not as usual.
std::string RowName(const TallyKey& key) {
  std::string name = fmt::format("{}, {}", key.generator, key.contacts);
  for (const auto& [part, usual] : {std::pair(key.method, "baraff"), std::pair(key.arithmetic, "double")}) {
    if (part != usual) name += ", " + part;
  }
  return name;
}

// A table for each policy, of the rows that `add` puts into it.
template <class Rows, class Add>
std::string TablesByPolicy(const Rows& rows, const std::vector<std::string>& header, Add add) {
  std::map<std::string, TextTable> tables;
  for (const auto& row : rows) add(tables.try_emplace(row.key.policy, header, 1).first->second, row);
  std::string text;
  for (const auto& [policy, table] : tables)
    text += Paragraph(fmt::format("Policy {}:", policy)) + table.Done();
  return text;
}

std::string LoopTable(const Comparison& c) {
  return TablesByPolicy(
      c.rates, {"generator, contacts", "loops A", "in a million runs", "loops B", "in a million runs", "p"},
      [](TextTable& table, const ComparedRate& rate) {
        if (rate.measure != "loops" || !rate.friction.empty()) return;
        table.AddRow({RowName(rate.key), Grouped(rate.a.count), RateText(rate.a.count, rate.a.of),
                      Grouped(rate.b.count), RateText(rate.b.count, rate.b.of),
                      rate.adjusted ? PText(*rate.adjusted) : ""});
      });
}

// The number of steps that a share of the runs do not exceed; "63+" for the last bin.
std::string Quantile(const ComparedSteps::Bins& bins, double share) {
  double all = 0, up_to = 0;
  for (const std::int64_t count : bins) all += static_cast<double>(count);
  for (int steps = 0; steps < Tally::kBins - 1; ++steps) {
    up_to += static_cast<double>(bins[steps]);
    if (up_to >= share * all) return std::to_string(steps);
  }
  return fmt::format("{}+", Tally::kBins - 1);
}

// The mean, and quantiles.
std::vector<std::string> StepCells(const ComparedSteps::Bins& bins, std::int64_t sum) {
  const auto runs = std::accumulate(bins.begin(), bins.end(), std::int64_t{0});
  if (runs == 0) return {"", ""};
  std::string quantiles;
  for (const double share : {0.25, 0.5, 0.75, 0.99})
    quantiles += (quantiles.empty() ? "" : "/") + Quantile(bins, share);
  return {fmt::format("{:.2f}", static_cast<double>(sum) / static_cast<double>(runs)), quantiles};
}

std::string StepTable(const Comparison& c) {
  std::map<TallyKey, std::string> p;
  for (const ComparedRate& rate : c.rates) {
    if (rate.measure.starts_with("steps-above") && rate.adjusted) p[rate.key] = PText(*rate.adjusted);
  }
  const char* quantiles = "25/50/75/99 %";
  return TablesByPolicy(c.steps, {"generator, contacts", "mean A", quantiles, "mean B", quantiles, "p"},
                        [&p](TextTable& table, const ComparedSteps& steps) {
                          std::vector<std::string> cells = {RowName(steps.key)};
                          for (std::string& cell : StepCells(steps.a, steps.sum_a))
                            cells.push_back(std::move(cell));
                          for (std::string& cell : StepCells(steps.b, steps.sum_b))
                            cells.push_back(std::move(cell));
                          cells.push_back(p[steps.key]);
                          table.AddRow(std::move(cells));
                        });
}

void AddTallyKey(Csv& csv, const TallyKey& key) {
  csv.Add(key.generator).Add(key.contacts).Add(key.policy).Add(key.method).Add(key.arithmetic);
}

std::string Decimal(double value) { return fmt::format("{:.9g}", value); }

void AddTrials(Csv& csv, const Trials& trials) {
  csv.Add(trials.count).Add(trials.of);
  const Interval interval = ShareInterval(trials.count, trials.of);
  csv.Add(trials.of == 0 ? "" : Decimal(RateOf(trials)));
  csv.Add(trials.of == 0 ? "" : Decimal(interval.low)).Add(trials.of == 0 ? "" : Decimal(interval.high));
}

}  // namespace

bool Comparison::MoreThanNoise() const {
  return std::any_of(rates.begin(), rates.end(), [](const ComparedRate& rate) { return rate.MoreThanNoise(); });
}

Comparison Compare(const Store& a, const std::string& file_a, const Store& b, const std::string& file_b) {
  if (a.identity() == b.identity()) {
    throw InputError(
        fmt::format("{} and {}: found two stores of one campaign, expected two campaigns to compare; "
                    "'merge' joins those of one",
                    file_a, file_b));
  }
  const Record of_a = a.Total(), of_b = b.Total();
  Comparison comparison;
  comparison.differences = Differences(a.identity(), b.identity());
  for (const auto& [key, tally] : of_a.tallies) {
    const auto found = of_b.tallies.find(key);
    if (found == of_b.tallies.end()) {
      comparison.only_a.push_back(key);
      continue;
    }
    AddRates(comparison, key, tally, found->second);
    comparison.steps.push_back(
        {key, tally.steps, found->second.steps, tally.sums.steps, found->second.sums.steps});
  }
  for (const auto& [key, tally] : of_b.tallies) {
    if (!of_a.tallies.contains(key)) comparison.only_b.push_back(key);
  }
  if (comparison.rates.empty()) {
    throw InputError(
        fmt::format("{} and {}: found no generator, number of contacts, policy and arithmetic that both "
                    "have run, expected one to compare",
                    file_a, file_b));
  }
  AddTests(comparison);
  return comparison;
}

std::string ComparisonText(const Comparison& c, const std::string& file_a, const std::string& file_b) {
  std::string text = Paragraph("A: " + file_a, 0) + Paragraph("B: " + file_b, 0) + "\n" +
                     Heading("How the two campaigns differ");
  for (const std::string& line : c.differences) text += Paragraph(line);
  text += "\n" + Heading("What is more than noise") + NoiseText(c) + Paragraph(AboutTests(), 0);
  for (const std::string& only : {OnlyIn(c.only_a, "A"), OnlyIn(c.only_b, "B")})
    text += only.empty() ? "" : Paragraph(only, 0);
  text += "\n" + Heading("Loops, confirmed exactly") + LoopTable(c);
  return text + "\n" + Heading("Steps of a run: mean and quantiles") + StepTable(c);
}

std::string ComparisonCsv(const Comparison& comparison) {
  Csv csv;
  for (const char* column :
       {"generator", "contacts", "policy", "method",     "arithmetic", "friction",    "measure",
        "a_count",   "a_of",     "a_rate", "a_low",      "a_high",     "b_count",     "b_of",
        "b_rate",    "b_low",    "b_high", "difference", "p",          "p_corrected", "more_than_noise"})
    csv.Add(column);
  csv.EndRow();
  for (const ComparedRate& rate : comparison.rates) {
    AddTallyKey(csv, rate.key);
    csv.Add(rate.friction).Add(rate.measure);
    AddTrials(csv, rate.a);
    AddTrials(csv, rate.b);
    const bool both = rate.a.of > 0 && rate.b.of > 0;
    csv.Add(both ? Decimal(RateOf(rate.b) - RateOf(rate.a)) : "");
    csv.Add(rate.p ? Decimal(*rate.p) : "").Add(rate.adjusted ? Decimal(*rate.adjusted) : "");
    csv.Add(rate.MoreThanNoise() ? "yes" : "no").EndRow();
  }
  return csv.text();
}

Json ComparisonToJson(const Comparison& comparison) {
  const auto key_of = [](const TallyKey& key) {
    return Json{{"generator", key.generator},
                {"contacts", key.contacts},
                {"policy", key.policy},
                {"method", key.method},
                {"arithmetic", key.arithmetic}};
  };
  const auto trials = [](const Trials& trials) { return Json{{"count", trials.count}, {"of", trials.of}}; };
  const auto number = [](const std::optional<double>& x) { return x ? Json(*x) : Json(); };
  Json rates = Json::array(), only_a = Json::array(), only_b = Json::array();
  for (const ComparedRate& rate : comparison.rates) {
    Json row = key_of(rate.key);
    row.update({{"friction", rate.friction},
                {"measure", rate.measure},
                {"a", trials(rate.a)},
                {"b", trials(rate.b)},
                {"p", number(rate.p)},
                {"p_corrected", number(rate.adjusted)},
                {"more_than_noise", rate.MoreThanNoise()}});
    rates.push_back(std::move(row));
  }
  for (const TallyKey& key : comparison.only_a) only_a.push_back(key_of(key));
  for (const TallyKey& key : comparison.only_b) only_b.push_back(key_of(key));
  return {{"differences", comparison.differences},
          {"tests", comparison.tests},
          {"rates", rates},
          {"only_a", only_a},
          {"only_b", only_b}};
}

std::string ComparisonStepsCsv(const Comparison& comparison) {
  Csv csv;
  for (const char* column : {"generator", "contacts", "policy", "method", "arithmetic", "steps", "or_more",
                             "a_problems", "b_problems"})
    csv.Add(column);
  csv.EndRow();
  for (const ComparedSteps& compared : comparison.steps) {
    for (int steps = 0; steps < Tally::kBins; ++steps) {
      if (compared.a[steps] == 0 && compared.b[steps] == 0) continue;
      AddTallyKey(csv, compared.key);
      csv.Add(steps).Add(steps == Tally::kBins - 1 ? "yes" : "no");
      csv.Add(compared.a[steps]).Add(compared.b[steps]).EndRow();
    }
  }
  return csv.text();
}

std::filesystem::path WriteComparison(const Comparison& comparison, const std::string& file_a,
                                      const std::string& file_b, const std::filesystem::path& directory,
                                      Occupied occupied) {
  WholeFolder whole(directory, "report", occupied);
  ReportFiles folder(whole);
  const FixedTextWidth of_the_file(kUsualTextWidth);
  folder.Write("comparison.txt", ComparisonText(comparison, file_a, file_b));
  folder.Write("index.html", ComparisonPage(comparison, file_a, file_b));
  folder.Write("comparison.csv", ComparisonCsv(comparison));
  folder.Write("comparison_steps.csv", ComparisonStepsCsv(comparison));
  folder.WriteSums();
  return whole.Commit();
}

}  // namespace stiction
