// SPDX-License-Identifier: Apache-2.0
#include "certify/request/escalate.h"

#include <algorithm>

#include "certify/exact/inexact.h"
#include "certify/request/quad.h"
#include "corpus/record/sparse_problem.h"
#include "solver/numeric/coulomb.h"
#include "solver/problem/row_scale.h"

namespace stiction {
namespace {

ContactProblem<Quad> InQuad(const ContactProblem<double>& problem) {
  return Converted<Quad>(problem, [](double x) { return Quad(x); });
}

// Steps over quad that the budget holds.
std::int64_t QuadSteps(const ContactProblem<double>& problem) {
  const auto rows = static_cast<std::int64_t>(problem.rows());
  return kQuadOperations / std::max<std::int64_t>(1, rows * rows * rows / 3);
}

// Newton's method from forces that doubles found.
Answer<double> PolishInSpace(const ContactProblem<double>& problem, const SolveOptions& options,
                             const Eigen::VectorXd& from) {
  const RowScale scale = FindScale(problem);
  CoulombOptions coulomb;
  coulomb.limits = options.limits;
  coulomb.sides = 0;
  coulomb.residual = BoundOf<double>(options) / 2;
  coulomb.most_newton_steps = QuadSteps(problem);
  CoulombSolver<Quad> solver(coulomb);
  ContactProblem<Quad>::Vector start = from.cast<Quad>();
  for (int i = 0; i < start.size(); ++i) start[i] = ldexp(start[i], -scale.f[i]);
  auto answer = AnswerOf<double>(solver.Run(InQuad(Scaled(problem, scale)), &start));
  answer.law = FrictionLaw::kCoulomb;
  answer.f = solver.f().unaryExpr([](const Quad& x) { return static_cast<double>(x); });
  ScaleBy(answer.f, scale.f);
  answer.method = "fast";
  answer.arithmetic = Arithmetic::kQuad;
  answer.first_f = Eigen::VectorXd::Zero(problem.rows());
  JudgeAnswer(problem, BoundOf<double>(options), answer);
  return answer;
}

Answer<double> SolveFinelyInPlane(const ContactProblem<double>& problem, const SolveOptions& options) {
  SolveOptions few = options;
  few.limits.pivots = std::min(options.limits.pivots, QuadSteps(problem));
  const ContactProblem<Quad> fine = InQuad(problem);
  Answer<double> answer = InDoubles(Solve(fine, "fast", few), fine, BoundOf<double>(options));
  answer.arithmetic = Arithmetic::kQuad;
  return answer;
}

bool IsBetter(const Answer<double>& x, const Answer<double>& y) {
  if (x.Solved() != y.Solved()) return x.Solved();
  if (x.outcome == Outcome::kUndecided && y.outcome != Outcome::kUndecided) return false;
  return x.errors && (!y.errors || x.errors->Largest() < y.errors->Largest());
}

}  // namespace

Solution SolveEscalating(const ContactProblem<double>& problem, const SolveOptions& options) {
  const bool in_space = problem.dimension == 3;
  SolveOptions quick = options;
  if (in_space) quick.sides = 0;
  Answer<double> best = in_space ? Solve(problem, "fast", quick) : Solve(problem, kAutomatic, quick);
  if (!in_space && best.outcome == Outcome::kSingular) {
    Answer<double> proximal = Solve(problem, "proximal", options);
    if (proximal.Solved()) return {.answer = std::move(proximal)};
  }
  const bool is_open = !best.Solved() && best.outcome != Outcome::kNoSolution;
  if (!is_open || options.limits.Stopped() || best.f.size() != problem.rows() || !best.f.allFinite())
    return {.answer = std::move(best)};
  const Answer<double> doubles = best;
  bool is_fine = false;
  const auto consider = [&](Answer<double> answer, bool fine) {
    if (!IsBetter(answer, best)) return;
    best = std::move(answer);
    is_fine = fine;
  };
  if (QuadSteps(problem) > 0)
    consider(in_space ? PolishInSpace(problem, options, best.f) : SolveFinelyInPlane(problem, options), true);
  if (!best.Solved() && in_space) consider(Solve(problem, kAutomatic, options), false);
  Solution told = {.answer = std::move(best)};
  if (is_fine) told.suspected = doubles;
  return told;
}

}  // namespace stiction
