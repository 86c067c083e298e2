// SPDX-License-Identifier: Apache-2.0
// Complete driving is Lemke's method with a graded covering vector (complete/equivalence.md).

#include <algorithm>
#include <catch2/catch.hpp>

#include "solver/complete/complete.h"
#include "solver/lemke/lemke.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

using Points = std::vector<ExactVector>;

// Half the bits of a grade: what the two paths may differ by.
bool AreNear(const ExactVector& x, const ExactVector& y) {
  Rational most = 0;
  for (int i = 0; i < x.size(); ++i) most = std::max(most, Rational(abs(x[i] - y[i])));
  return most * Grade<Rational>() * most * Grade<Rational>() < Grade<Rational>();
}

// f = 0, and f at the end of every piece.
struct DrivenPath {
  Points points;
  Counters statistics;
};

DrivenPath Driven(const ExactProblem& problem) {
  CompleteDriving<Rational> driving;
  Trace<Rational> trace;
  DrivenPath path;
  const RunEnd<> verdict = driving.Run(problem, &trace);
  REQUIRE(verdict.outcome == Outcome::kSolved);
  path.statistics = verdict.statistics;
  path.points.push_back(ExactVector::Zero(problem.rows()));
  for (const auto& pivot : trace.pivots) path.points.push_back(pivot.f);
  return path;
}

Points Covered(const ExactProblem& problem, Cover cover, ExactVector& end) {
  LemkeAlgorithm<Rational> lemke({}, cover);
  Trace<Rational> trace;
  REQUIRE(lemke.Run(problem, &trace).outcome == Outcome::kSolved);
  end = lemke.f();
  Points points;
  for (const auto& pivot : trace.pivots) points.push_back(pivot.f);
  return points;
}

// Whether x is on the segment from p to q.
bool IsBetween(const ExactVector& p, const ExactVector& q, const ExactVector& x) {
  int widest = 0;
  for (int i = 1; i < p.size(); ++i) {
    if (abs(q[i] - p[i]) > abs(q[widest] - p[widest])) widest = i;
  }
  if (q[widest] == p[widest]) return AreNear(p, x);
  Rational t = (x[widest] - p[widest]) / (q[widest] - p[widest]);
  t = std::clamp(t, Rational(0), Rational(1));
  return AreNear(ExactVector(p + t * (q - p)), x);
}

// Every breakpoint of `path` in its order, and between two of them only points of their segment: Lemke's method
// has a breakpoint more where the friction of a sticking contact changes its sign, or the tangential
// acceleration of an open one.
void CheckFollows(const Points& path, const Points& points) {
  std::size_t reached = 0;  // the last breakpoint that was met
  const auto advance = [&](const ExactVector& x) {
    while (reached + 1 < path.size() && AreNear(path[reached + 1], x)) ++reached;
  };
  for (std::size_t k = 0; k < points.size(); ++k) {
    CAPTURE(k, reached);
    advance(points[k]);
    CHECK((AreNear(path[reached], points[k]) ||
           (reached + 1 < path.size() && IsBetween(path[reached], path[reached + 1], points[k]))));
  }
  CHECK(reached + 1 == path.size());
}

TEST_CASE("equivalence: Lemke's method with a graded covering vector takes the path of complete driving",
          "[slow]") {
  int folded = 0, descended = 0, apart = 0;
  for (std::uint64_t index = 0; folded < 60 || descended < 20; ++index) {
    REQUIRE(index < 20000);
    const ExactProblem problem = Random<Rational>(GeneratorId::kPsd, 2 + static_cast<int>(index % 3), index);
    const DrivenPath path = Driven(problem);
    const bool chosen = path.statistics[Counter::kTies] == 0 &&
                        (path.statistics[Counter::kFolds] > 0 || path.statistics[Counter::kDescents] > 0);
    if (!chosen && index >= 60) continue;
    if (path.statistics[Counter::kTies] > 0) continue;
    CAPTURE(index);
    ExactVector end, other;
    CheckFollows(path.points, Covered(problem, Cover::kGraded, end));
    CHECK(end == path.points.back());
    Covered(problem, Cover::kOnes, other);
    folded += path.statistics[Counter::kFolds] > 0;
    descended += path.statistics[Counter::kDescents] > 0;
    apart += other != end;
  }
  CHECK(apart > 0);  // with ones it is another path
}

}  // namespace
}  // namespace stiction
