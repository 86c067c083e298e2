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
Answer<double> PolishInSpace(const ContactProblem<double>& problem, const Request& request,
                             const Eigen::VectorXd& from) {
  const RowScale scale = FindScale(problem);
  CoulombSolver<Quad> solver(
      {.limits = request.limits, .residual = ResidualOf<double>(request) / 2, .sides = 0});
  solver.most_newton_steps = QuadSteps(problem);
  ContactProblem<Quad>::Vector start = from.cast<Quad>();
  for (int i = 0; i < start.size(); ++i) start[i] = ldexp(start[i], -scale.f[i]);
  auto answer = AnswerOf<double>(solver.Run(InQuad(Scaled(problem, scale)), &start));
  answer.law = FrictionLaw::kCoulomb;
  answer.f = solver.f().unaryExpr([](const Quad& x) { return static_cast<double>(x); });
  ScaleBy(answer.f, scale.f);
  answer.method = "fast";
  answer.arithmetic = Arithmetic::kQuad;
  answer.first_f = Eigen::VectorXd::Zero(problem.rows());
  JudgeAnswer(problem, ResidualOf<double>(request), answer);
  return answer;
}

Answer<double> SolveFinelyInPlane(const ContactProblem<double>& problem, const Request& request) {
  Request few = request;
  few.method = "fast";
  few.limits.pivots = std::min(request.limits.pivots, QuadSteps(problem));
  const ContactProblem<Quad> fine = InQuad(problem);
  Answer<double> answer = InDoubles(Solve(fine, few), fine, ResidualOf<double>(request));
  answer.arithmetic = Arithmetic::kQuad;
  return answer;
}

bool IsBetter(const Answer<double>& x, const Answer<double>& y) {
  if (x.Solved() != y.Solved()) return x.Solved();
  if (x.outcome == Outcome::kUndecided && y.outcome != Outcome::kUndecided) return false;
  return x.errors && (!y.errors || x.errors->Largest() < y.errors->Largest());
}

}  // namespace

Solution SolveEscalating(const ContactProblem<double>& problem, const Request& request) {
  const bool in_space = problem.dimension == 3;
  const auto by = [&request](std::string_view method) {
    Request named = request;
    named.method = method;
    return named;
  };
  Request quick = by(in_space ? "fast" : kAutomatic);
  if (in_space) quick.sides = 0;
  Answer<double> best = Solve(problem, quick);
  if (!in_space && best.outcome == Outcome::kSingular) {
    Answer<double> proximal = Solve(problem, by("proximal"));
    if (proximal.Solved()) return {.answer = std::move(proximal)};
  }
  const bool is_open = !best.Solved() && best.outcome != Outcome::kNoSolution;
  if (!is_open || request.limits.Stopped() || best.f.size() != problem.rows() || !best.f.allFinite())
    return {.answer = std::move(best)};
  const Answer<double> doubles = best;
  bool is_fine = false;
  const auto consider = [&](Answer<double> answer, bool fine) {
    if (!IsBetter(answer, best)) return;
    best = std::move(answer);
    is_fine = fine;
  };
  if (QuadSteps(problem) > 0)
    consider(in_space ? PolishInSpace(problem, request, best.f) : SolveFinelyInPlane(problem, request), true);
  if (!best.Solved() && in_space) consider(Solve(problem, by(kAutomatic)), false);
  Solution told = {.answer = std::move(best)};
  if (is_fine) told.suspected = doubles;
  return told;
}

}  // namespace stiction
