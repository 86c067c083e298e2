// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/lemke_space.h"

#include <utility>

#include "solver/lemke/lemke.h"
#include "solver/problem/remainder.h"

namespace stiction {
namespace {

// Of a contact that slips: the corner, or the edge, that its friction lies on.
LawCell SlippingCell(const FrictionPolygon<Rational>& polygon, const Planar<Rational>& force,
                     const Planar<Rational>& a) {
  int least = 0;
  for (int k = 1; k < polygon.sides(); ++k) {
    if (Dot(polygon.corner(k), a) < Dot(polygon.corner(least), a)) least = k;
  }
  const int side = Sign(Rational(Cross(polygon.corner(least), force)));
  if (side == 0) return {Law::kCorner, least};
  return {Law::kEdge, side > 0 ? least : polygon.Wrap(least - 1)};
}

LawCell CellOf(const Contact<Rational>& contact, const FrictionPolygon<Rational>& polygon, const Rational* f,
               const Rational* a) {
  if (contact.kind == ContactKind::kBilateral) return {Law::kHold};
  if (f[0] == 0) return {Law::kBreak};
  if (contact.kind != ContactKind::kStatic || contact.mu == 0) return {Law::kFree};
  if (a[1] == 0 && a[2] == 0) return {Law::kInside};
  return SlippingCell(polygon, {f[1], f[2]}, {a[1], a[2]});
}

CellWord WordOf(const ExactProblem& problem, const RationalPolygons& polygons, const ExactVector& f,
                const ExactVector& a) {
  CellWord word;
  ForEachContact(problem, [&](int i, int row, int) {
    word.push_back(CellOf(problem.contacts[i], polygons[i], &f[row], &a[row]));
  });
  return word;
}

}  // namespace

OnPolygons RunLemkeInSpace(const ExactProblem& problem, RationalPolygons polygons, const Limits& limits,
                           Trace<Rational>* trace) {
  const Remainder<Rational> remainder(problem);
  OnPolygons run;
  if (!remainder.Obstacle().empty()) {
    run.answer.outcome = Outcome::kSingular;
    run.answer.reason = remainder.Obstacle();
    run.answer.counters = kCompleteCounters;
    return run;
  }
  RationalPolygons kept;
  for (std::size_t i = 0; i < remainder.problem().contacts.size(); ++i)
    kept.push_back(polygons[remainder.ContactOf(static_cast<int>(i))]);
  run.polygons = std::move(polygons);
  LemkeAlgorithm<Rational> lemke({.limits = limits});
  const RunEnd<> verdict = lemke.Run(remainder.problem(), kept, trace);
  if (trace != nullptr)
    for (Pivot<Rational>& pivot : trace->pivots) pivot = remainder.Restored(std::move(pivot));
  run.answer.outcome = verdict.outcome;
  run.answer.reason = verdict.reason;
  run.answer.counters = kCompleteCounters;
  run.answer.counters[Counter::kPieces] = verdict.statistics[Counter::kPivots];
  if (verdict.outcome == Outcome::kRay) run.answer.ray = remainder.Direction(lemke.ray());
  if (verdict.outcome != Outcome::kSolved) return run;
  run.answer.f = remainder.Forces(lemke.f());
  run.answer.a = remainder.Accelerations(run.answer.f);
  run.word = WordOf(problem, run.polygons, run.answer.f, run.answer.a);
  return run;
}

}  // namespace stiction
