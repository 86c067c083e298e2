// SPDX-License-Identifier: Apache-2.0
// Suite `methods`: every method on the same problems. Counts, outcomes and times. Suite `frictionless`: its
// last table, to 150 contacts.
//
// Counts are those of exact runs. Methods take turns at blocks of problems; times are compared problem by
// problem. method.h says what a time is, and how answers are verified.
//
// Determinism   all tables but the times, on one machine; Ipopt's starts and outcomes depend on its libraries.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "bench/method.h"
#include "bench/one_thread.h"
#include "bench/progress.h"
#include "bench/suite.h"
#include "bench/table.h"
#include "corpus/exit_code.h"
#include "corpus/json_text.h"

namespace stiction {
namespace {

constexpr int kBlock = 64;  // problems, before the next method has its turn

// ---- Measuring -----------------------------------------------------------------------------------

// Problems of one size. A method that is given fewer has the first ones.
struct Sample {
  int contacts = 0;
  std::int64_t problems = 0;
  std::vector<int> friction;  // class, by problem
  std::vector<bool> rough;
  std::vector<std::vector<Measure>> measures;  // by method, problem
  std::vector<std::string> mismatches;
};

// All classes of friction are as frequent in what a method is given.
std::int64_t ProblemsOf(const BenchMethod& method, const Sample& sample) {
  if (method.most_contacts > 0 && sample.contacts > method.most_contacts) return 0;
  const std::int64_t part = (sample.problems + method.one_in - 1) / method.one_in;
  const std::int64_t classes = kFrictionClasses;
  return std::min(sample.problems, (part + classes - 1) / classes * classes);
}

void AddMismatches(const std::vector<BenchMethod>& methods, Sample& sample) {
  for (std::size_t i = 0; i < sample.friction.size(); ++i) {
    std::vector<NamedMeasure> measures;
    for (std::size_t m = 0; m < methods.size(); ++m) {
      if (i < sample.measures[m].size())
        measures.push_back({methods[m].Title(), methods[m].exact(), sample.measures[m][i]});
    }
    const auto mismatch = FindMismatch(measures);
    if (mismatch)
      sample.mismatches.push_back(fmt::format("{} contacts, problem {}: {}", sample.contacts, i, *mismatch));
  }
}

// make(index) returns a BenchProblem.
template <class Make>
Sample Measured(std::vector<BenchMethod>& methods, int contacts, std::int64_t problems, Make make) {
  progress::Begin(fmt::format("runs at {} contacts", contacts),
                  static_cast<std::int64_t>(methods.size()) * problems);
  Sample sample{contacts, problems, {}, {}, {}, {}};
  sample.measures.resize(methods.size());
  for (std::int64_t first = 0; first < problems; first += kBlock) {
    const std::int64_t end = std::min(problems, first + kBlock);
    std::vector<BenchProblem> block;
    for (std::int64_t i = first; i < end; ++i) {
      block.push_back(make(i));
      sample.friction.push_back(block.back().friction);
      sample.rough.push_back(block.back().rough);
    }
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const std::int64_t last = std::min(end, ProblemsOf(methods[m], sample));
      for (std::int64_t i = first; i < last; ++i)
        sample.measures[m].push_back(methods[m].run(block[i - first]));
      progress::Done(end - first);
    }
  }
  AddMismatches(methods, sample);
  progress::Clear();
  return sample;
}

// ---- Tables --------------------------------------------------------------------------------------

double Percent(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

Json Cell(const Quartiles& q) { return {q.low, q.median, q.high}; }

std::int64_t MostPieces(int contacts) { return (std::int64_t{1} << (2 * contacts)) - 1; }

std::int64_t SolvedOf(const std::vector<Measure>& measures) {
  return std::count_if(measures.begin(), measures.end(), [](const Measure& m) { return m.Solved(); });
}

bool IsWrong(const Measure& measure) { return measure.wrong; }

Average WorkOf(const std::vector<Measure>& measures) {
  std::vector<std::int64_t> work;
  for (const Measure& m : measures) {
    if (m.Solved()) work.push_back(m.work);
  }
  return AverageOf(work);
}

// How runs end that are not solved; what is wrong is counted apart.
Json OtherEnds(const std::vector<Measure>& measures) {
  Json ends = Json::object();
  for (const Measure& m : measures) {
    if (m.outcome == Outcome::kSolved) continue;
    const std::string name(Name(m.outcome));
    ends[name] = ends.value(name, 0) + 1;
  }
  return ends;
}

BenchTable RunTable(const std::vector<BenchMethod>& methods, const std::vector<Sample>& samples) {
  BenchTable table{"runs", "how runs end; what they count, mean and most, over what is solved"};
  for (const Sample& sample : samples) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const std::vector<Measure>& measures = sample.measures[m];
      if (measures.empty()) continue;
      const Average work = WorkOf(measures);
      table.rows.push_back({{"contacts", sample.contacts},
                            {"method", methods[m].name},
                            {"reading", methods[m].reading},
                            {"arithmetic", methods[m].arithmetic},
                            {"problems", measures.size()},
                            {"solved", SolvedOf(measures)},
                            {"wrong", std::count_if(measures.begin(), measures.end(), IsWrong)},
                            {"not solved", OtherEnds(measures)},
                            {"counts", methods[m].counts},
                            {"mean", work.mean},
                            {"most", work.most},
                            {"bound", m == kComplete ? Json(MostPieces(sample.contacts)) : Json()}});
    }
  }
  return table;
}

// Counts over complete driving's measures.
struct FoldCount {
  std::int64_t problems = 0, folds = 0, descents = 0;

  void Count(const Measure& m) {
    ++problems;
    folds += m.folds > 0;
    descents += m.descents > 0;
  }
  Json AddTo(Json row) const {
    row.update({{"problems", problems},
                {"folds", folds},
                {"folds %", Percent(folds, problems)},
                {"descents", descents},
                {"descents %", Percent(descents, problems)}});
    return row;
  }
};

BenchTable FoldTable(const std::vector<Sample>& samples) {
  BenchTable table{"folds", "problems on which complete driving folds, and descends"};
  for (const Sample& sample : samples) {
    FoldCount count;
    for (const Measure& m : sample.measures[kComplete]) count.Count(m);
    table.rows.push_back(count.AddTo({{"contacts", sample.contacts}}));
  }
  return table;
}

BenchTable FrictionTable(const std::vector<Sample>& samples) {
  BenchTable table{"friction", "the same by friction coefficient, all sizes"};
  std::array<FoldCount, kFrictionClasses> counts;
  for (const Sample& sample : samples) {
    for (std::size_t i = 0; i < sample.friction.size(); ++i)
      counts[sample.friction[i]].Count(sample.measures[kComplete][i]);
  }
  for (int c = 0; c < kFrictionClasses; ++c) table.rows.push_back(counts[c].AddTo({{"mu", FrictionName(c)}}));
  return table;
}

// Folds of complete driving against give-ups of one reading of the published algorithm.
Json GiveUpRow(const BenchMethod& method, int place, const std::vector<Sample>& samples) {
  Contingency count;
  std::int64_t plain = 0, equal = 0;
  std::vector<std::int64_t> pieces, steps;  // where there are folds and both solve
  for (const Sample& sample : samples) {
    for (std::size_t i = 0; i < sample.friction.size(); ++i) {
      const Measure& complete = sample.measures[kComplete][i];
      const Measure& published = sample.measures[place][i];
      count.Count(complete.folds > 0, published.give_ups > 0);
      if (complete.folds > 0 && complete.Solved() && published.Solved()) {
        pieces.push_back(complete.work);
        steps.push_back(published.work);
      }
      if (complete.folds > 0 || !sample.rough[i]) continue;
      ++plain;
      equal += published.Solved() && published.work == complete.work;
    }
  }
  return {{"policy", method.reading},
          {"both", count.both},
          {"folds only", count.first_only},
          {"give-ups only", count.second_only},
          {"neither", count.neither},
          {"no folds, mu > 0", plain},
          {"as many steps", equal},
          {"pieces if folds", AverageOf(pieces).mean},
          {"steps if folds", AverageOf(steps).mean}};
}

BenchTable GiveUpTable(const std::vector<BenchMethod>& methods, const std::vector<Sample>& samples) {
  BenchTable table{"give-ups", "folds of complete driving against give-ups of the published algorithm"};
  for (const int place : kPublished) table.rows.push_back(GiveUpRow(methods[place], place, samples));
  return table;
}

Quartiles Microseconds(const std::vector<Measure>& measures, double Measure::*seconds = &Measure::seconds) {
  std::vector<double> values;
  for (const Measure& m : measures) values.push_back(1e6 * m.*seconds);
  return QuartilesOf(values);
}

// Of the problems that both were given.
Quartiles RatioOf(const std::vector<Measure>& left, const std::vector<Measure>& right,
                  double Measure::*seconds = &Measure::seconds) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i)
    ratios.push_back(left[i].*seconds / right[i].seconds);
  return QuartilesOf(ratios);
}

BenchTable TimeTable(const std::vector<BenchMethod>& methods, const std::vector<Sample>& samples) {
  BenchTable table{"times",
                   "microseconds a problem, and times that of complete driving over doubles: quartiles"};
  for (const Sample& sample : samples) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
      if (sample.measures[m].empty()) continue;
      table.rows.push_back({{"contacts", sample.contacts},
                            {"method", methods[m].name},
                            {"reading", methods[m].reading},
                            {"arithmetic", methods[m].arithmetic},
                            {"problems", sample.measures[m].size()},
                            {"us", Cell(Microseconds(sample.measures[m]))},
                            {"ratio", Cell(RatioOf(sample.measures[m], sample.measures[kCompleteDouble]))}});
    }
  }
  return table;
}

BenchTable StartTable(const std::vector<Sample>& samples) {
  BenchTable table{"starts", "starts that Ipopt needed; none: no solution from its twenty"};
  for (const Sample& sample : samples) {
    std::int64_t one = 0, two = 0, three = 0, more = 0, none = 0;
    for (const Measure& m : sample.measures[kIpopt])
      ++(!m.Solved() ? none : m.work == 1 ? one : m.work == 2 ? two : m.work == 3 ? three : more);
    table.rows.push_back({{"contacts", sample.contacts},
                          {"problems", sample.measures[kIpopt].size()},
                          {"1", one},
                          {"2", two},
                          {"3", three},
                          {"4 to 20", more},
                          {"none", none}});
  }
  return table;
}

BenchTable FrictionlessTable(const std::vector<Sample>& samples) {
  BenchTable table{
      "frictionless",
      "without friction, microseconds: plain Gauss on A f = -b, section 4, Lemke, fast, inside Ipopt "
      "program (5), and the program exactly by CGAL (qp)"};
  for (const Sample& sample : samples) {
    const auto& gauss = sample.measures[kGauss];
    const auto& baraff = sample.measures[kBaraffDouble];
    const auto& lemke = sample.measures[kLemkeDouble];
    const auto& fast = sample.measures[kFastDouble];
    const auto& program = sample.measures[kQuadratic];
    const auto& exact = sample.measures[kExactQuadratic];
    table.rows.push_back({{"contacts", sample.contacts},
                          {"problems", baraff.size()},
                          {"baraff solved", SolvedOf(baraff)},
                          {"lemke solved", SolvedOf(lemke)},
                          {"fast solved", SolvedOf(fast)},
                          {"ipopt solved", SolvedOf(program)},
                          {"qp solved", SolvedOf(exact)},
                          {"gauss us", Cell(Microseconds(gauss))},
                          {"baraff us", Cell(Microseconds(baraff))},
                          {"baraff/gauss", Cell(RatioOf(baraff, gauss))},
                          {"lemke/baraff", Cell(RatioOf(lemke, baraff))},
                          {"fast/baraff", Cell(RatioOf(fast, baraff))},
                          {"ipopt us", Cell(Microseconds(program, &Measure::library_seconds))},
                          {"ipopt/baraff", Cell(RatioOf(program, baraff, &Measure::library_seconds))},
                          {"qp us", Cell(Microseconds(exact))},
                          {"qp/baraff", Cell(RatioOf(exact, baraff))}});
  }
  return table;
}

// ---- Output ------------------------------------------------------------------------------------

Json ToJson(const BenchOptions& options, std::int64_t problems, const std::vector<BenchTable>& tables,
            const std::vector<std::string>& mismatches) {
  Json json = {{"suite", options.suite},
               {"seed", options.seed},
               {"generator", options.generator ? Row(*options.generator).name : "definite"},
               {"problems", problems},
               {"one_thread", ThreadsJson()}};
  for (const BenchTable& table : tables) json[table.name] = table.rows;
  json["mismatches"] = mismatches;
  return json;
}

// ---- The suite -----------------------------------------------------------------------------------

// Exact arithmetic makes many contacts slow to solve and to verify.
std::int64_t FrictionlessProblems(int contacts) {
  return contacts <= 12 ? 48 : contacts <= 25 ? 24 : contacts <= 50 ? 8 : 4;
}

std::vector<Sample> MeasureFrictionless(const std::vector<int>& sizes, std::int64_t problems,
                                        std::uint64_t seed) {
  std::vector<BenchMethod> methods = FrictionlessMethods();
  std::vector<Sample> samples;
  for (const int n : sizes) {
    samples.push_back(Measured(methods, n, std::min(problems, FrictionlessProblems(n)),
                               [&](std::int64_t index) { return MakeFrictionless(n, seed, index); }));
  }
  return samples;
}

std::vector<std::string> MismatchesOf(const std::vector<Sample>& samples) {
  std::vector<std::string> mismatches;
  for (const Sample& sample : samples)
    mismatches.insert(mismatches.end(), sample.mismatches.begin(), sample.mismatches.end());
  return mismatches;
}

int Report(const BenchOptions& options, std::int64_t problems, const std::vector<BenchTable>& tables,
           const std::vector<std::string>& mismatches) {
  if (options.json) {
    std::cout << JsonText(ToJson(options, problems, tables, mismatches)) << "\n";
  } else {
    fmt::print("{}\n", ThreadsText());
    for (const BenchTable& table : tables) Print(table);
    fmt::print("\n{} mismatches\n", mismatches.size());
    for (const std::string& mismatch : mismatches) fmt::print("{}\n", mismatch);
  }
  return mismatches.empty() ? kExitDone : kExitNotSo;
}

}  // namespace

int BenchMethods(const BenchOptions& options) {
  const std::int64_t problems = options.problems.value_or(800);
  std::vector<int> contacts = options.contacts;
  if (contacts.empty()) contacts = {2, 3, 4, 5, 6};
  progress::Expect(contacts.size() + 5);
  std::vector<BenchMethod> methods = BenchedMethods();
  std::vector<Sample> samples;
  for (const int n : contacts) {
    samples.push_back(Measured(methods, n, problems, [&](std::int64_t index) {
      return MakeBenchProblem(options.generator, n, options.seed, index);
    }));
  }
  const std::vector<Sample> smooth = MeasureFrictionless({3, 6, 12, 25, 50}, problems, options.seed);
  std::vector<std::string> mismatches = MismatchesOf(samples);
  for (const std::string& mismatch : MismatchesOf(smooth)) mismatches.push_back(mismatch);
  return Report(
      options, problems,
      {RunTable(methods, samples), FoldTable(samples), FrictionTable(samples), GiveUpTable(methods, samples),
       TimeTable(methods, samples), StartTable(samples), FrictionlessTable(smooth)},
      mismatches);
}

int BenchFrictionless(const BenchOptions& options) {
  const std::int64_t problems = options.problems.value_or(48);
  std::vector<int> sizes = options.contacts;
  if (sizes.empty()) sizes = {3, 6, 12, 25, 50, 100, 150};
  progress::Expect(sizes.size());
  const std::vector<Sample> samples = MeasureFrictionless(sizes, problems, options.seed);
  return Report(options, problems, {FrictionlessTable(samples)}, MismatchesOf(samples));
}

}  // namespace stiction
