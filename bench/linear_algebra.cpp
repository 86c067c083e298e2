// SPDX-License-Identifier: Apache-2.0
// stiction bench --suite linear-algebra: ways to solve a linear system exactly.
//
//   gauss           elimination over rationals: what the exact runs did before
//   fraction-free   solver/linear/elimination.h, with the scaling of the rows to integers: what they do
//   fmpq_mat        FLINT's fmpq_mat_solve, matrices already in FLINT's form
//   fmpz_mat        FLINT's fmpz_mat_solve of the rows scaled to integers, likewise; fractions are not reduced
//
// The systems are the reduced systems that complete driving meets on problems of the generators (entries: over
// rationals, or of the problem over doubles taken exactly), and dense ones of random integers. Only regular
// ones. All answers are compared exactly. Then whole runs of complete driving, of the published algorithm and
// of Lemke's method, by both eliminations; the published algorithm runs under the policy `paper`.

#include <fmt/format.h>

#ifdef STICTION_FLINT
#include <flint/fmpq_mat.h>
#include <flint/fmpz_mat.h>
#endif

#include <time.h>

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <iostream>
#include <map>

#include "bench/measure.h"
#include "bench/plain_rational.h"
#include "bench/progress.h"
#include "bench/suite.h"
#include "certify/exact/exact.h"
#include "corpus/json_text.h"
#include "corpus/stopwatch.h"
#include "search/choices.h"
#include "solver/complete/complete.ipp"
#include "solver/lemke/lemke.ipp"
#include "solver/linear/elimination.ipp"
#include "solver/problem/check.h"
#include "solver/published/published.ipp"

namespace stiction {
namespace {

using Vector = ExactProblem::Vector;
using Augmented = Eigen::Matrix<Rational, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  // [M | right side]

// ---- Systems -----------------------------------------------------------------------------------

ExactProblem MakeProblem(GeneratorId id, bool over_doubles, int contacts, Choices& choices) {
  ExactProblem exact;
  if (!over_doubles) {
    Generate(id, contacts, kDefaultPalette, choices, exact);
    return exact;
  }
  ContactProblem<double> rounded;
  Generate(id, contacts, kDefaultPalette, choices, rounded);
  for (const Contact<double>& contact : rounded.contacts)
    exact.contacts.push_back({contact.kind, contact.mu, {}});
  exact.A = rounded.A.cast<Rational>();
  exact.b = rounded.b.cast<Rational>();
  return exact;
}

// Accelerations of `rows` per unit of the variable `column`, whose friction may follow it.
Vector ReducedColumn(const ExactProblem& problem, const std::vector<IndexSet>& sets,
                     const std::vector<int>& rows, int column) {
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts);
  const bool rough = layout.IsNormal(column) && layout.HasFriction(column);
  const int limit = rough ? LimitSign(sets[column + 1]) : 0;
  Vector reduced(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    reduced[i] = problem.A(rows[i], column);
    if (limit == 0) continue;
    reduced[i] += limit * problem.contacts[layout.ContactOf(column)].mu * problem.A(rows[i], column + 1);
  }
  return reduced;
}

Augmented ReducedSystem(const ExactProblem& problem, const std::vector<IndexSet>& sets, int driven) {
  std::vector<int> unknowns;
  for (int row = 0; row < problem.rows(); ++row) {
    if (IsUnknown(sets[row])) unknowns.push_back(row);
  }
  const int size = static_cast<int>(unknowns.size());
  Augmented M(size, size + 1);
  for (int j = 0; j < size; ++j) M.col(j) = ReducedColumn(problem, sets, unknowns, unknowns[j]);
  M.col(size) = -ReducedColumn(problem, sets, unknowns, driven);
  return M;
}

bool IsRegular(const Augmented& M) {
  const int size = static_cast<int>(M.rows());
  Elimination<Rational> elimination;
  elimination.Assign(M);
  elimination.Run(size, size, size + 1);
  return elimination.rank() == size;
}

// Regular systems by size, from problems of 1 to 8 contacts; at most `count` of a size, two of a problem.
std::map<int, std::vector<Augmented>> ReducedSystems(GeneratorId id, bool over_doubles, std::uint64_t seed,
                                                     std::int64_t count) {
  std::map<int, std::vector<Augmented>> systems;
  for (int contacts = 1; contacts <= kMaxContacts; ++contacts) {
    for (std::int64_t index = 0; index < count; ++index) {
      Choices choices(
          ProblemSeed(seed, static_cast<std::uint64_t>(contacts), static_cast<std::uint64_t>(index)));
      const ExactProblem problem = MakeProblem(id, over_doubles, contacts, choices);
      const CompleteRun run = RunComplete(problem, Limits{}, KeepPath::kYes);
      std::map<int, int> taken;
      for (const Pivot<Rational>& piece : run.path) {
        const auto sets = SetsDuring(piece.word, problem.contacts, piece.driven);
        Augmented M = ReducedSystem(problem, sets, piece.driven);
        const int size = static_cast<int>(M.rows());
        auto& of_size = systems[size];
        if (taken[size] == 2 || static_cast<std::int64_t>(of_size.size()) == count || !IsRegular(M)) continue;
        ++taken[size];
        of_size.push_back(std::move(M));
      }
    }
  }
  return systems;
}

std::vector<Augmented> DenseSystems(int size, std::int64_t bound, std::uint64_t seed, std::int64_t count) {
  std::vector<Augmented> systems;
  Choices choices(ProblemSeed(seed, static_cast<std::uint64_t>(size), static_cast<std::uint64_t>(bound)));
  while (static_cast<std::int64_t>(systems.size()) < count) {
    Augmented M(size, size + 1);
    for (Rational& entry : M.reshaped()) entry = choices.Integer(-bound, bound);
    if (IsRegular(M)) systems.push_back(std::move(M));
  }
  return systems;
}

// ---- Ways --------------------------------------------------------------------------------------

// Everything is kept from one system to the next, as the exact runs do.
class Gauss {
 public:
  void Solve(const Augmented& M) {
    const int size = static_cast<int>(M.rows());
    M_ = M;
    for (int column = 0; column < size; ++column) {
      int pivot = column;
      while (Sign(M_(pivot, column)) == 0) ++pivot;
      if (pivot != column) M_.row(pivot).swap(M_.row(column));
      for (int i = column + 1; i < size; ++i) {
        if (Sign(M_(i, column)) == 0) continue;
        const Rational factor = M_(i, column) / M_(column, column);
        for (int j = column + 1; j <= size; ++j) M_(i, j) -= factor * M_(column, j);
      }
    }
    x_.resize(size);
    for (int i = size - 1; i >= 0; --i) {
      Rational value = M_(i, size);
      for (int k = i + 1; k < size; ++k) value -= M_(i, k) * x_[k];
      x_[i] = value / M_(i, i);
    }
  }
  const Vector& x() const { return x_; }

 private:
  Augmented M_;
  Vector x_;
};

class FractionFree {
 public:
  void Solve(const Augmented& M) {
    const int size = static_cast<int>(M.rows());
    elimination_.Assign(M);
    elimination_.Run(size, size, size + 1);
    elimination_.BackSubstitute(size);
    x_.resize(size);
    for (int i = 0; i < size; ++i) x_[i] = elimination_.Solution(i);
  }
  const Vector& x() const { return x_; }

 private:
  Elimination<Rational> elimination_;
  Vector x_;
};

#ifdef STICTION_FLINT

class FlintRationals {
 public:
  explicit FlintRationals(const Augmented& M) {
    const int size = static_cast<int>(M.rows());
    fmpq_mat_init(A_, size, size);
    fmpq_mat_init(b_, size, 1);
    fmpq_mat_init(x_, size, 1);
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) fmpq_set_mpq(fmpq_mat_entry(A_, i, j), M(i, j).get_mpq_t());
      fmpq_set_mpq(fmpq_mat_entry(b_, i, 0), M(i, size).get_mpq_t());
    }
  }
  FlintRationals(const FlintRationals&) = delete;
  FlintRationals& operator=(const FlintRationals&) = delete;
  ~FlintRationals() {
    fmpq_mat_clear(A_);
    fmpq_mat_clear(b_);
    fmpq_mat_clear(x_);
  }

  void Solve() { fmpq_mat_solve(x_, A_, b_); }
  Vector x() const {
    Vector x(fmpq_mat_nrows(x_));
    for (int i = 0; i < x.size(); ++i) fmpq_get_mpq(x[i].get_mpq_t(), fmpq_mat_entry(x_, i, 0));
    return x;
  }

 private:
  fmpq_mat_t A_, b_, x_;
};

class FlintIntegers {
 public:
  explicit FlintIntegers(const Augmented& M) {
    const int size = static_cast<int>(M.rows());
    Elimination<Rational> scaled;
    scaled.Assign(M);
    fmpz_mat_init(A_, size, size);
    fmpz_mat_init(b_, size, 1);
    fmpz_mat_init(x_, size, 1);
    fmpz_init(denominator_);
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) fmpz_set_mpz(fmpz_mat_entry(A_, i, j), scaled(i, j).get_mpz_t());
      fmpz_set_mpz(fmpz_mat_entry(b_, i, 0), scaled(i, size).get_mpz_t());
    }
  }
  FlintIntegers(const FlintIntegers&) = delete;
  FlintIntegers& operator=(const FlintIntegers&) = delete;
  ~FlintIntegers() {
    fmpz_mat_clear(A_);
    fmpz_mat_clear(b_);
    fmpz_mat_clear(x_);
    fmpz_clear(denominator_);
  }

  void Solve() { fmpz_mat_solve(x_, denominator_, A_, b_); }
  Vector x() const {
    Vector x(fmpz_mat_nrows(x_));
    mpz_class numerator, denominator;
    fmpz_get_mpz(denominator.get_mpz_t(), denominator_);
    for (int i = 0; i < x.size(); ++i) {
      fmpz_get_mpz(numerator.get_mpz_t(), fmpz_mat_entry(x_, i, 0));
      x[i] = Fractions<Rational>::Quotient(numerator, denominator);
    }
    return x;
  }

 private:
  fmpz_mat_t A_, b_, x_;
  fmpz_t denominator_;
};

#endif

// ---- Timing ------------------------------------------------------------------------------------

// One way to do something to item i; ratios are those of the time of way `base` to its own.
struct Way {
  std::string_view name;
  std::function<void(std::size_t)> run;
  std::size_t base = 0;
};

double MicrosecondsOf(const Way& way, std::size_t items, int passes) {
  const Stopwatch watch;
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 0; i < items; ++i) way.run(i);
  }
  return 1e6 * watch.Seconds() / (static_cast<double>(items) * passes);
}

// Microseconds an item, by way and run: all ways in turn, `repeat` times after one that is not counted; a run
// takes 5 ms or so of each at least.
std::vector<std::vector<double>> MeasureWays(const std::vector<Way>& ways, std::size_t items, int repeat) {
  std::vector<std::vector<double>> times(ways.size());
  std::vector<int> passes(ways.size(), 1);
  for (int run = 0; run <= repeat; ++run) {
    for (std::size_t w = 0; w < ways.size(); ++w) {
      const double time = MicrosecondsOf(ways[w], items, passes[w]);
      if (run > 0) times[w].push_back(time);
      if (run == 0) passes[w] = 1 + static_cast<int>(5000 / (time * static_cast<double>(items)));
    }
  }
  return times;
}

class Table {
 public:
  explicit Table(const BenchOptions& options) : options_(options) {
    if (options.json) return;
#ifndef STICTION_FLINT
    fmt::print("built without FLINT (libflint-dev): its rows are missing\n");
#endif
    fmt::print("{:26} {:>4} {:>6} {:24} {:>9} {:>9} {:>9} {:>7}   microseconds of processor time an item\n",
               "items", "size", "count", "way", "least", "median", "most", "ratio");
  }

  void AddRows(const std::string& name, int size, std::size_t items, const std::vector<Way>& ways) {
    const auto times = MeasureWays(ways, items, options_.repeat);
    progress::Clear();
    for (std::size_t w = 0; w < ways.size(); ++w) {
      std::vector<double> ratios;  // within one run
      for (std::size_t run = 0; run < times[w].size(); ++run) {
        ratios.push_back(times[ways[w].base][run] / times[w][run]);
      }
      const Spread time = SpreadOf(times[w]), ratio = SpreadOf(ratios);
      rows_.push_back({{"items", name},
                       {"size", size},
                       {"count", items},
                       {"way", ways[w].name},
                       {"least", time.least},
                       {"median", time.median},
                       {"most", time.most},
                       {"ratio", ratio.median}});
      if (!options_.json)
        fmt::print("{:26} {:>4} {:>6} {:24} {:>9.2f} {:>9.2f} {:>9.2f} {:>7.2f}\n", name, size, items,
                   ways[w].name, time.least, time.median, time.most, ratio.median);
    }
    std::fflush(stdout);
    progress::Done();
  }

  void Print() const {
    if (options_.json) std::cout << JsonText(rows_) << "\n";
  }

 private:
  const BenchOptions& options_;
  Json rows_ = Json::array();
};

void AddSystems(const std::string& name, int size, const std::vector<Augmented>& systems, Table& table) {
  Gauss gauss;
  FractionFree fraction_free;
  std::vector<Way> ways = {{"gauss", [&](std::size_t i) { gauss.Solve(systems[i]); }},
                           {"fraction-free", [&](std::size_t i) { fraction_free.Solve(systems[i]); }}};
#ifdef STICTION_FLINT
  std::deque<FlintRationals> rationals;
  std::deque<FlintIntegers> integers;
  for (const Augmented& M : systems) {
    rationals.emplace_back(M);
    integers.emplace_back(M);
  }
  ways.push_back({"fmpq_mat", [&](std::size_t i) { rationals[i].Solve(); }});
  ways.push_back({"fmpz_mat", [&](std::size_t i) { integers[i].Solve(); }});
#endif
  for (std::size_t i = 0; i < systems.size(); ++i) {
    progress::Done(0);
    for (const Way& way : ways) way.run(i);
    STICTION_CHECK(fraction_free.x() == gauss.x(), "elimination without fractions disagrees");
#ifdef STICTION_FLINT
    STICTION_CHECK(rationals[i].x() == gauss.x() && integers[i].x() == gauss.x(), "FLINT disagrees");
#endif
  }
  table.AddRows(name, size, systems.size(), ways);
}

void AddReducedSystems(GeneratorId id, bool over_doubles, const BenchOptions& o, std::int64_t count,
                       Table& table) {
  const auto systems = ReducedSystems(id, over_doubles, o.seed, count);
  for (const int size : {1, 2, 4, 6, 8, 12}) {
    const auto of_size = systems.find(size);
    if (of_size == systems.end() || of_size->second.size() < 5) continue;
    AddSystems(fmt::format("{}, {}", Row(id).name, over_doubles ? "doubles" : "rationals"), size,
               of_size->second, table);
  }
}

// Size: contacts.
void AddRuns(GeneratorId id, int contacts, const BenchOptions& o, std::int64_t count, Table& table) {
  std::vector<ExactProblem> problems;
  std::vector<ContactProblem<PlainRational>> plain;
  for (std::int64_t index = 0; index < count; ++index) {
    Choices choices(
        ProblemSeed(o.seed, static_cast<std::uint64_t>(contacts), static_cast<std::uint64_t>(index)));
    problems.push_back(MakeProblem(id, false, contacts, choices));
    plain.push_back(Plain(problems.back()));
  }
  CompleteDriving<Rational> complete;
  CompleteDriving<PlainRational> plain_complete;
  PublishedAlgorithm<Rational> published;
  PublishedAlgorithm<PlainRational> plain_published;
  LemkeAlgorithm<Rational> lemke;
  LemkeAlgorithm<PlainRational> plain_lemke;
  const std::vector<Way> ways = {
      {"complete, gauss", [&](std::size_t i) { plain_complete.Run(plain[i]); }, 0},
      {"complete, fraction-free", [&](std::size_t i) { complete.Run(problems[i]); }, 0},
      {"baraff, gauss", [&](std::size_t i) { plain_published.Run(plain[i]); }, 2},
      {"baraff, fraction-free", [&](std::size_t i) { published.Run(problems[i]); }, 2},
      {"lemke, gauss", [&](std::size_t i) { plain_lemke.Run(plain[i]); }, 4},
      {"lemke, fraction-free", [&](std::size_t i) { lemke.Run(problems[i]); }, 4}};
  for (std::size_t i = 0; i < problems.size(); ++i) {
    for (const Way& way : ways) way.run(i);
    STICTION_CHECK(complete.f() == plain_complete.f().cast<Rational>() &&
                       published.state().f == plain_published.state().f.cast<Rational>() &&
                       lemke.f() == plain_lemke.f().cast<Rational>(),
                   "runs by different eliminations disagree");
  }
  table.AddRows(fmt::format("{}, runs", Row(id).name), contacts, problems.size(), ways);
}

}  // namespace

int BenchLinearAlgebra(const BenchOptions& o) {
  using enum GeneratorId;
  const std::int64_t count = o.problems.value_or(200);
  Table table(o);
  progress::Expect(o.generator ? 1 : 4 + 3);
  for (const GeneratorId id : {kIntegers, kPsd, kBodies, kConditioned}) {
    if (o.generator && id != *o.generator) continue;
    progress::Begin(
        std::string(Row(id).name),
        (Row(id).exact_in_double ? 6 : 12) + (o.contacts.empty() ? 4 : static_cast<int>(o.contacts.size())));
    AddReducedSystems(id, true, o, count, table);
    if (!Row(id).exact_in_double) AddReducedSystems(id, false, o, count, table);
    for (const int contacts : o.contacts.empty() ? std::vector<int>{2, 4, 6, 8} : o.contacts) {
      AddRuns(id, contacts, o, count, table);
    }
  }
  for (const int size : {6, 12, 16}) {
    if (o.generator) break;
    progress::Begin(fmt::format("dense, {} rows", size), 2);
    AddSystems("dense, up to 100", size, DenseSystems(size, 100, o.seed, count), table);
    AddSystems("dense, 63 bits", size, DenseSystems(size, std::int64_t{1} << 62, o.seed, count), table);
  }
  progress::Clear();
  table.Print();
  return 0;
}

}  // namespace stiction
