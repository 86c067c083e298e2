// SPDX-License-Identifier: Apache-2.0
// Suite `smallest`: the problems of two static contacts with small integers, one after the other: which loop
// has the smallest? Policy `paper`, mu = 1.
//
// Every positive definite A and every b with integers of at most K, but for tangents reversed: A_N1F1 and
// A_N2F2 are not negative. Problems without a negative bN are solved by f = 0 and left out. Smallest is the
// loop with the smallest largest entry, of these the one with the fewest nonzeros, of these that with the least
// sum. Runs are over doubles; what does not end solved there is run exactly. A loop that doubles take for a
// solution, since they break a tie otherwise, is not seen: counts are lower bounds. With --exact
// every run is over rationals, which takes much longer, and the search is exhaustive if none ends otherwise
// than solved, in a loop, or without a force direction (`singular`).

#include <fmt/format.h>

#include <iostream>

#include "bench/progress.h"
#include "bench/suite.h"
#include "bench/table.h"
#include "certify/exact/exact.h"
#include "corpus/exit_code.h"
#include "corpus/problem_file.h"
#include "corpus/rounded.h"
#include "solver/problem/errors.h"
#include "solver/published/published.ipp"

namespace stiction {
namespace {

constexpr int kRows = 4;
using Matrix = std::array<std::array<std::int64_t, kRows>, kRows>;

// Leading minors by elimination without fractions (Bareiss): exact, and a sign of every leading minor.
bool IsDefinite(Matrix m) {
  std::int64_t before = 1;
  for (int k = 0; k < kRows; ++k) {
    if (m[k][k] <= 0) return false;
    for (int i = k + 1; i < kRows; ++i) {
      for (int j = k + 1; j < kRows; ++j) m[i][j] = (m[i][j] * m[k][k] - m[i][k] * m[k][j]) / before;
    }
    before = m[k][k];
  }
  return true;
}

// All vectors of integers from `low` to `high`, entry by entry.
template <std::size_t Size, class Visit>
void ForEachVector(const std::array<int, Size>& low, const std::array<int, Size>& high, Visit visit) {
  std::array<int, Size> x = low;
  while (true) {
    visit(x);
    std::size_t k = 0;
    while (k < Size && x[k] == high[k]) x[k] = low[k], ++k;
    if (k == Size) return;
    ++x[k];
  }
}

struct Size {
  int largest = 0, nonzeros = 0, sum = 0;
  auto operator<=>(const Size&) const = default;
};

class Smallest {
 public:
  Smallest(int largest, bool exactly) : largest_(largest), exactly_(exactly) {
    for (auto& contact : problem_.contacts) {
      contact.kind = ContactKind::kStatic;
      contact.mu = 1;
    }
    problem_.dimension = 2;
  }

  void Run() {
    const int k = largest_;
    progress::Begin(fmt::format("matrices of integers of at most {}", k),
                    static_cast<std::int64_t>(std::pow(k, 4) * std::pow(k + 1, 2) * std::pow(2 * k + 1, 4)));
    ForEachVector<4>({1, 1, 1, 1}, {k, k, k, k}, [this, k](const auto& diagonal) {
      ForEachVector<6>({0, 0, -k, -k, -k, -k}, {k, k, k, k, k, k},
                       [this, &diagonal](const auto& beside) { TryMatrix(diagonal, beside); });
    });
  }

  std::int64_t matrices = 0, problems = 0, loops = 0, singular = 0, open = 0;
  std::optional<std::pair<Size, ExactProblem>> smallest, smallest_whole;

 private:
  void TryMatrix(const std::array<int, 4>& diagonal, const std::array<int, 6>& beside) {
    progress::Done();
    const auto [n1f1, n2f2, n1n2, n1f2, f1n2, f1f2] = beside;
    const Matrix m = {{{diagonal[0], n1f1, n1n2, n1f2},
                       {n1f1, diagonal[1], f1n2, f1f2},
                       {n1n2, f1n2, diagonal[2], n2f2},
                       {n1f2, f1f2, n2f2, diagonal[3]}}};
    if (!IsDefinite(m)) return;
    ++matrices;
    for (int i = 0; i < kRows; ++i) {
      for (int j = 0; j < kRows; ++j) problem_.A(i, j) = static_cast<double>(m[i][j]);
    }
    const int k = largest_;
    ForEachVector<4>({-k, -k, -k, -k}, {k, k, k, k}, [this](const auto& b) {
      if (b[0] >= 0 && b[2] >= 0) return;
      for (int i = 0; i < kRows; ++i) problem_.b[i] = b[i];
      TryProblem();
    });
  }

  void TryProblem() {
    ++problems;
    if (!exactly_ && DoublesSolve()) return;
    const ExactProblem exact = Exact();
    const Outcome outcome = exact_algorithm_.Run(exact).outcome;
    singular += outcome == Outcome::kSingular;
    open += outcome != Outcome::kSolved && outcome != Outcome::kCycle && outcome != Outcome::kSingular;
    if (outcome != Outcome::kCycle) return;
    ++loops;
    const Size size = SizeOf(exact);
    Keep(smallest, size, exact);
    const bool worth_the_grid = !smallest_whole || size < smallest_whole->first;
    if (worth_the_grid && AllEndIn(Outcome::kCycle, exact, PlanarGrid(), kLimits))
      Keep(smallest_whole, size, exact);
  }

  bool DoublesSolve() {
    if (algorithm_.Run(problem_).outcome != Outcome::kSolved) return false;
    const auto& f = algorithm_.state().f;
    const Eigen::Vector4d a = problem_.A * f + problem_.b;
    return MeasureErrors(problem_, FrictionLaw::kCoulomb, f, a).Largest() <= kClear;
  }

  static void Keep(std::optional<std::pair<Size, ExactProblem>>& best, const Size& size,
                   const ExactProblem& problem) {
    if (!best || size < best->first) best = {size, problem};
  }

  ExactProblem Exact() const {
    ExactProblem exact;
    exact.dimension = 2;
    exact.contacts.resize(2);
    for (auto& contact : exact.contacts) contact.mu = 1;
    exact.A = problem_.A.unaryExpr([](double x) { return Rational(x); });
    exact.b = problem_.b.unaryExpr([](double x) { return Rational(x); });
    return exact;
  }

  static Size SizeOf(const ExactProblem& problem) {
    Size size;
    const auto add = [&size](const Rational& x) {
      const int entry = static_cast<int>(ToDouble(abs(x)));
      size.largest = std::max(size.largest, entry);
      size.nonzeros += entry != 0;
      size.sum += entry;
    };
    for (const Rational& x : problem.A.reshaped()) add(x);
    for (const Rational& x : problem.b) add(x);
    return size;
  }

  static constexpr double kClear = 1e-6;
  static constexpr Limits kLimits = {1000, 10000, 100000};
  int largest_;
  bool exactly_;
  ContactProblem<double, kRows> problem_;
  PublishedAlgorithm<double, kRows> algorithm_{PublishedOptions{{}, {}, kLimits}};
  PublishedAlgorithm<Rational> exact_algorithm_{PublishedOptions{{}, {}, kLimits}};
};

Json FileOf(const std::optional<std::pair<Size, ExactProblem>>& best, const char* name) {
  if (!best) return nullptr;
  ProblemFile file;
  file.name = name;
  file.problem = best->second;
  return ToJson(file);
}

Json Shown(const std::optional<std::pair<Size, ExactProblem>>& best) {
  if (!best) return "-";
  return fmt::format("{} nonzeros, largest {}, sum {}", best->first.nonzeros, best->first.largest,
                     best->first.sum);
}

}  // namespace

int BenchSmallest(const BenchOptions& options) {
  BenchTable table{"smallest",
                   "loops of two contacts, mu = 1, A definite, among all with integers of at most K"};
  Json problems = Json::array();
  progress::Expect(static_cast<std::size_t>(options.entries));
  for (int largest = 1; largest <= options.entries; ++largest) {
    Smallest all(largest, options.exact);
    all.Run();
    table.rows.push_back({{"K", largest},
                          {"matrices", all.matrices},
                          {"problems", all.problems},
                          {"loops of paper", all.loops},
                          {"singular", all.singular},
                          {"neither", all.open},
                          {"smallest", Shown(all.smallest)},
                          {"under every policy", Shown(all.smallest_whole)}});
    problems.push_back({{"K", largest},
                        {"smallest", FileOf(all.smallest, "smallest-loop")},
                        {"under every policy", FileOf(all.smallest_whole, "smallest-loop-every-policy")}});
  }
  progress::Clear();
  if (options.json)
    std::cout << JsonText({{"suite", "smallest"}, {"rows", table.rows}, {"problems", problems}}) << "\n";
  else
    Print(table);
  return kExitDone;
}

}  // namespace stiction
