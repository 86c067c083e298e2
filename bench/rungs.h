// SPDX-License-Identifier: Apache-2.0
// Rungs: every method over every arithmetic on the same problems, and what their answers are worth.
//
// A call is what a user's program calls: Solve() over numbers of the rung's own, the filtered call for
// filtered, both on data already in memory; its time is that of the call alone. Answers are judged over
// rationals, on the problem that the rung was given: rounded to float, rounded to double for wider numbers, as
// it is for filtered and exact.
//
//   silent   called solved within a residual that it does not have, or that no solution exists where one does
//   wrong    the published algorithm ends otherwise than over rationals, and does not say that it is undecided
//   refused  a number of the problem is not one of the rung's

#ifndef STICTION_BENCH_RUNGS_H_
#define STICTION_BENCH_RUNGS_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "corpus/json_text.h"
#include "corpus/problem_file.h"
#include "solver/problem/answer.h"

namespace stiction {

// One problem as the rungs get it. Truths are found once, when they are asked for.
class RungProblem {
 public:
  explicit RungProblem(ExactProblem problem);

  const ExactProblem& exact() const { return exact_; }
  // Empty where a number is not one of the scalar's.
  const std::optional<ContactProblem<float>>& in_float() const { return float_; }
  const std::optional<ContactProblem<double>>& in_double() const { return double_; }
  // What a rung was given, over rationals.
  const ExactProblem& Given(Arithmetic arithmetic) const;
  // How the published algorithm ends on it over rationals.
  Outcome PublishedEnd(Arithmetic arithmetic) const;

 private:
  enum Data { kFloat, kDouble, kAsItIs };
  static Data DataOf(Arithmetic arithmetic);

  ExactProblem exact_;
  std::optional<ContactProblem<float>> float_;
  std::optional<ContactProblem<double>> double_;
  std::array<ExactProblem, 2> given_;
  mutable std::array<std::optional<Outcome>, 3> ends_;
};

// What is done to a problem before, or to forces after, a call over doubles.
enum class Remedy { kNone, kScaled, kRefined, kRegularized };

struct RungAnswer {
  bool refused = false;
  Outcome outcome = Outcome::kUndecided;
  double seconds = 0;
  double bound = 0;                            // of the residual, that solved claims
  std::optional<ExactProblem::Vector> f = {};  // as the rung has them, exactly
  std::optional<Rung> decided_on = {};         // filtered
};

struct RungRow {
  std::string method;
  Arithmetic arithmetic;
  Remedy remedy = Remedy::kNone;

  std::string Name() const;  // "double", "double scaled"
  // The time is the least of so many runs: the first finds memory cold.
  RungAnswer Run(const RungProblem& problem, int repeats = 1) const;

 private:
  RungAnswer RunOnce(const RungProblem& problem) const;
};

// complete, lemke, fast, baraff over all that they are built for; with `remedies` those of doubles too.
std::vector<RungRow> RungRows(bool remedies);

// What a row made of several problems.
struct RungTally {
  std::int64_t problems = 0, solved = 0, undecided = 0, other = 0, refused = 0, wrong = 0, silent = 0;
  std::array<std::int64_t, kRungCount> decided_on = {};
  std::vector<double> seconds, residuals;  // of the calls; of answers called solved, over rationals

  // Returns whether the answer is silently wrong. `has_solution`: that there is one is known.
  bool Count(const RungRow& row, const RungProblem& problem, const RungAnswer& answer, bool has_solution);
  void Merge(const RungTally& more);
  Json ToJson() const;
};

// The largest error (solver/problem/errors.h), over rationals, rounded.
double ExactResidual(const ExactProblem& problem, const ExactProblem::Vector& f);

}  // namespace stiction

#endif  // STICTION_BENCH_RUNGS_H_
