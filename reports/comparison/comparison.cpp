// SPDX-License-Identifier: Apache-2.0
#include "reports/comparison/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "corpus/grouped.h"
#include "corpus/input_error.h"
#include "corpus/intervals.h"
#include "corpus/json_text.h"
#include "corpus/plain_text.h"
#include "reports/comparison/comparison_txt.h"
#include "reports/comparison_template.h"
#include "reports/html/html.h"
#include "reports/page/sections.h"
#include "reports/report_files.h"
#include "reports/tables/groups.h"

namespace stiction {
namespace {

constexpr std::size_t kSentences = 12;  // on the page before the table, which has all differences

// ---- What is compared ----

std::map<std::string, Counts, decltype(&NaturalLess)> FrictionsOf(const Tally& tally) {
  std::map<std::string, Counts, decltype(&NaturalLess)> frictions(&NaturalLess);
  for (const auto& [key, stratum] : tally.strata) frictions[key.friction].Add(stratum);
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

Ratio StepsAbove(const Tally& tally, int median) {
  Ratio trials;
  for (int steps = 0; steps < Tally::kBins; ++steps) {
    trials.of += tally.steps[steps];
    trials.count += steps > median ? tally.steps[steps] : 0;
  }
  return trials;
}

void AddRates(Comparison& comparison, const TallyKey& key, const Group& a, const Group& b) {
  const auto add = [&](const std::string& friction, const Column& measure, const Ratio& of_a,
                       const Ratio& of_b) {
    comparison.rates.push_back({key, friction, measure.name, measure.hint, of_a, of_b, {}, {}});
  };
  const auto add_all = [&](const std::string& friction, const char* measures, const Counts& of_a,
                           const Counts& of_b) {
    const Numbers numbers_a = NumbersOf(Group{{}, {}, of_a}), numbers_b = NumbersOf(Group{{}, {}, of_b});
    const auto share = [](const Column& measure, const Numbers& numbers) {
      return std::get<Ratio>(CellOf(measure.from, numbers).value);
    };
    const Table table = Described(measures);
    for (const Column& measure : table.columns)
      add(friction, measure, share(measure, numbers_a), share(measure, numbers_b));
  };
  add_all("", "measures", a.counts, b.counts);
  const int median = PooledMedian(a.tally, b.tally);
  add("",
      {fmt::format("steps-above-{}", median),
       fmt::format("runs of more than {} steps, the median of both", median)},
      StepsAbove(a.tally, median), StepsAbove(b.tally, median));
  const auto frictions = FrictionsOf(b.tally);
  for (const auto& [friction, counts] : FrictionsOf(a.tally)) {
    const auto found = frictions.find(friction);
    if (found != frictions.end()) add_all(friction, "measures-by-friction", counts, found->second);
  }
}

TallyKey KeyOf(const Group& g) { return {g.Text(0), g.Number(1), g.Text(2), g.Text(3), g.Text(4)}; }

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

// ---- In words ----

double ValueOf(const Ratio& t) { return static_cast<double>(t.count) / static_cast<double>(t.of); }

// "psd, 2 contacts", and what is not as usual.
std::string NameOf(const TallyKey& key) {
  std::string name = fmt::format("{}, {}", key.generator, Counted(key.contacts, "contact"));
  if (key.policy != "paper") name += ", policy " + key.policy;
  if (key.method != "baraff") name += ", method " + key.method;
  if (key.arithmetic != "double") name += ", arithmetic " + key.arithmetic;
  return name;
}

std::string PText(double p) { return p == 0 ? "< 1e-300" : fmt::format("{:.2g}", p); }

bool MoreInA(const ComparedRate& rate) { return ValueOf(rate.a) > ValueOf(rate.b); }

std::string SentenceOf(const ComparedRate& rate) {
  const auto side = [](const Ratio& t) {
    return fmt::format("{} of {}, {}", Grouped(t.count), Grouped(t.of), ShareText(t.count, t.of));
  };
  return fmt::format("{}{}: {}: more in {}: A {}; B {}; p = {} corrected.", NameOf(rate.key),
                     rate.friction.empty() ? "" : ", mu = " + rate.friction, rate.meaning,
                     MoreInA(rate) ? "A" : "B", side(rate.a), side(rate.b), PText(*rate.adjusted));
}

// Differences that are more than noise, the surest first.
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

// "psd (2, 3 contacts); ..."
std::string Named(const std::vector<TallyKey>& keys) {
  std::map<std::string, std::set<int>> generators;
  for (const TallyKey& key : keys) generators[key.generator].insert(key.contacts);
  std::string text;
  for (const auto& [generator, contacts] : generators)
    text += fmt::format("{}{} ({} {})", text.empty() ? "" : "; ", generator, fmt::join(contacts, ", "),
                        contacts == std::set{1} ? "contact" : "contacts");
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

std::vector<Table> StepTables(const Comparison& c) {
  std::map<TallyKey, std::string> p;
  for (const ComparedRate& rate : c.rates) {
    if (rate.measure.starts_with("steps-above") && rate.adjusted) p[rate.key] = PText(*rate.adjusted);
  }
  Table table{"steps", "", Columns("policy* generator,_contacts* mean_A 25/50/75/99_% mean_B 25/50/75/99_% p")};
  table.keys = 2;
  for (const ComparedSteps& steps : c.steps) {
    const auto a = StepCells(steps.a, steps.sum_a), b = StepCells(steps.b, steps.sum_b);
    table.Add({steps.key.policy, RowName(steps.key), a[0], a[1], b[0], b[1], p[steps.key]});
  }
  return SplitByPolicy(table);
}

TableCell CountCell(const Ratio& ratio) {
  return {fmt::format("{} of {}", Grouped(ratio.count), Grouped(ratio.of)), Shown(ratio),
          ratio.count == 0 ? "zero" : ""};
}

Table NoiseTable(const std::vector<const ComparedRate*>& beyond) {
  Table table = Described("noise");
  for (const ComparedRate* rate : beyond) {
    table.Add({NameOf(rate->key), rate->friction.empty() ? "any" : rate->friction, rate->meaning,
               MoreInA(*rate) ? "A" : "B", CountCell(rate->a), CountCell(rate->b), PText(*rate->p),
               PText(*rate->adjusted)});
  }
  return table;
}

// By policy, generator and contacts.
Table ComparedLoopsTable(const Comparison& comparison, bool in_text) {
  Table table = Described(in_text ? "compared-loops-in-text" : "compared-loops");
  for (const auto& [key, friction, measure, meaning, a, b, p, adjusted] : comparison.rates) {
    if (measure != "loops" || !friction.empty()) continue;
    std::vector<TableCell> cells = {key.policy, RowName(key)};
    for (const Ratio& side : {a, b}) {
      if (in_text) cells.emplace_back(side.count);
      cells.emplace_back(RateOf(side.count, side.of));
    }
    cells.emplace_back(adjusted ? PText(*adjusted) : "");
    table.Add(std::move(cells));
  }
  return table;
}

Group GroupOf(const TallyKey& key) {
  return {{key.generator, std::int64_t{key.contacts}, key.policy, key.method, key.arithmetic}, {}, {}};
}

// In nine digits.
TableCell Decimal(std::optional<double> x) { return x ? TableCell(RoundedTo(9, *x)) : TableCell(); }

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
  Comparison comparison;
  comparison.differences = Differences(a.identity(), b.identity());
  std::map<TallyKey, Group> of_b;
  for (Group& group : GroupsBy(b.Total(), kByAll)) of_b.emplace(KeyOf(group), std::move(group));
  for (const Group& group : GroupsBy(a.Total(), kByAll)) {
    const TallyKey key = KeyOf(group);
    const auto found = of_b.find(key);
    if (found == of_b.end()) {
      comparison.only_a.push_back(key);
      continue;
    }
    const Tally &tally_a = group.tally, &tally_b = found->second.tally;
    AddRates(comparison, key, group, found->second);
    comparison.steps.push_back({key, tally_a.steps, tally_b.steps, tally_a.sums.steps, tally_b.sums.steps});
    of_b.erase(found);
  }
  for (const auto& [key, group] : of_b) comparison.only_b.push_back(key);
  if (comparison.rates.empty()) {
    throw InputError(
        fmt::format("{} and {}: found no generator, number of contacts, policy and arithmetic that both "
                    "have run, expected one to compare",
                    file_a, file_b));
  }
  AddTests(comparison);
  return comparison;
}

Told Tell(const Comparison& c, const std::string& file_a, const std::string& file_b) {
  const std::vector<const ComparedRate*> beyond = BeyondNoise(c);
  Facts facts{{{"beyond", std::ssize(beyond)}, {"tests", c.tests}},
              {{"file_a", file_a},
               {"file_b", file_b},
               {"word_a", ShellWord(file_a)},
               {"word_b", ShellWord(file_b)},
               {"only_a", Named(c.only_a)},
               {"only_b", Named(c.only_b)}}};
  for (const std::string& line : c.differences) facts.lists["differences"].emplace_back(line, "");
  Lines &all = facts.lists["noise"], &first = facts.lists["first_noise"];
  for (const ComparedRate* rate : beyond) all.emplace_back(SentenceOf(*rate), "");
  first = all;
  if (all.size() > kSentences) {
    first.resize(kSentences);
    first.emplace_back(fmt::format("and {} more, in the table.", all.size() - kSentences), "");
  }
  facts.tables = {{"noise", [&] { return std::vector<Table>{NoiseTable(beyond)}; }},
                  {"loops", [&] { return std::vector<Table>{ComparedLoopsTable(c, false)}; }},
                  {"loops_by_policy", [&] { return SplitByPolicy(ComparedLoopsTable(c, true)); }},
                  {"steps", [&] { return StepTables(c); }}};
  return Tell(kComparisonTxt, facts, {"text", "page", "page-lead"});
}

std::string ComparisonText(const Comparison& c, const std::string& file_a, const std::string& file_b) {
  return ToText(Tell(c, file_a, file_b), "text");
}

Table ComparisonTable(const Comparison& comparison) {
  Table table = Keyed("comparison", "", kByAll,
                      Columns("friction* measure* a_count,a_of,a_rate,a_low,a_high "
                              "b_count,b_of,b_rate,b_low,b_high difference p p_corrected more_than_noise*"));
  for (const ComparedRate& rate : comparison.rates) {
    const bool both = rate.a.of > 0 && rate.b.of > 0;
    table.Add(Behind(GroupOf(rate.key), {rate.friction, rate.measure, rate.a, rate.b,
                                         both ? Decimal(ValueOf(rate.b) - ValueOf(rate.a)) : TableCell(),
                                         Decimal(rate.p), Decimal(rate.adjusted), rate.MoreThanNoise()}));
  }
  return table;
}

SharedJson ComparisonToJson(const Comparison& comparison) {
  const auto trials = [](const Ratio& trials) {
    return SharedJson{{"count", trials.count}, {"of", trials.of}};
  };
  const auto number = [](const std::optional<double>& x) { return x ? SharedJson(*x) : SharedJson(); };
  std::vector<SharedJson> rates, only_a, only_b;
  for (const ComparedRate& rate : comparison.rates) {
    SharedJson row = ToJson(rate.key);
    row.Add({{"friction", rate.friction},
             {"measure", rate.measure},
             {"a", trials(rate.a)},
             {"b", trials(rate.b)},
             {"p", number(rate.p)},
             {"p_corrected", number(rate.adjusted)},
             {"more_than_noise", rate.MoreThanNoise()}});
    rates.push_back(std::move(row));
  }
  for (const TallyKey& key : comparison.only_a) only_a.push_back(ToJson(key));
  for (const TallyKey& key : comparison.only_b) only_b.push_back(ToJson(key));
  return {{"differences", comparison.differences},
          {"tests", comparison.tests},
          {"rates", rates},
          {"only_a", only_a},
          {"only_b", only_b}};
}

Table ComparisonStepsTable(const Comparison& comparison) {
  Table table = Keyed("comparison_steps", "", kByAll, Columns("steps or_more* a_problems b_problems"));
  for (const auto& [key, a, b, sum_a, sum_b] : comparison.steps) {
    for (int steps = 0; steps < Tally::kBins; ++steps) {
      if (a[steps] > 0 || b[steps] > 0)
        table.Add(Behind(GroupOf(key), {steps, steps == Tally::kBins - 1, a[steps], b[steps]}));
    }
  }
  return table;
}

std::filesystem::path WriteComparison(const Comparison& comparison, const std::string& file_a,
                                      const std::string& file_b, const std::filesystem::path& directory,
                                      Occupied occupied) {
  WholeFolder whole(directory, "report", occupied);
  ReportFiles folder(whole);
  const FixedTextWidth of_the_file(kUsualTextWidth);
  const Told told = Tell(comparison, file_a, file_b);
  const std::vector<Table> tables = {ComparisonTable(comparison), ComparisonStepsTable(comparison)};
  folder.Write("comparison.txt", ToText(told, "text"));
  folder.Write("index.html", ComparisonPage("stiction: two campaigns side by side",
                                            "What differs, and is it more than noise?", told, tables));
  for (const Table& table : tables) folder.Write(table.name + ".csv", ToCsv(table));
  folder.WriteSums();
  return whole.Commit();
}

std::string ComparisonPage(const char* title, const char* question, const Told& told,
                           const std::vector<Table>& figures) {
  const SharedJson data = {{"figures", FiguresToJson(figures, told, "page")}};
  const std::string page(std::begin(kComparisonTemplate), std::end(kComparisonTemplate));
  return FilledTemplate(page, {{"title", Text(title)},
                               {"heading", Text(question)},
                               {"lead", PartsToHtml(told, "page-lead")},
                               {"navigation", LinksTo(told, "page")},
                               {"found", SectionsToHtml(told, "page", {}, "")},
                               {"data", ScriptData(JsonText(data))}});
}

}  // namespace stiction
