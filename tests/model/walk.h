// SPDX-License-Identifier: Apache-2.0
// Operations of the model tester: of a problem, another one, and how solutions go forth and back between them.
//
// All of them are exact by Coulomb's law, whatever A and b are. Most say the same rows in other words, those of
// a matrix G:
//
//   A' = G A G',  b' = G b,  a' = G a,  f = G' f'
//
//   permute   contacts in another order
//   turn      tangents: the other way round; in space by 3-4-5, or changed with each other. Slips turn along
//   units     a positive number for the normal of each contact and one for its tangents; mu' = mu n / t
//   split     a contact stands twice, the second in units of its own, and takes a share of the force
//   smooth    contacts without friction lose their tangents
//
// The others add something that the problem does not feel:
//
//   idle      a contact that parts        border   a bilateral one, whose elimination leaves the problem
//   sum       another problem             scale    A' = s A, b' = t b, f' = f t / s
//   space     the plane, in space: second tangents that nothing moves
//
// A walk is several of them. `stay` does nothing: what a walk is shrunk to.

#pragma once

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "certify/exact/verify_solution.h"
#include "certify/request/solve_in.h"
#include "tests/model/draw.h"
#include "tests/support.h"

namespace stiction::testing {

// ---- Truth -------------------------------------------------------------------------------------------

// Whether a problem has a solution by Coulomb's law. In the plane by enumeration; in space by an exact answer,
// whose f may be a solution of Coulomb's law up to a bound.
struct Truth {
  bool is_known = false, solvable = false;
  ExactVector f = {};
  Rational bound = 1;
};

inline std::optional<std::string> Violation(const ExactProblem& problem, const ExactVector& f,
                                            const Rational& bound) {
  return FindViolation(problem, f, FrictionLaw::kCoulomb, bound);
}

inline Request RequestFor(std::string_view method, Arithmetic arithmetic,
                          FrictionLaw law = FrictionLaw::kCoulomb) {
  Request request{.method = method, .arithmetic = arithmetic};
  request.law = law;
  request.limits.drives = request.limits.pivots = 1000;
  return request;
}

inline constexpr std::size_t kMostContactsTried = 5;  // by enumeration: beyond that it takes long

inline Truth TruthOf(const ExactProblem& problem) {
  const bool few = problem.dimension == 2 && problem.contacts.size() <= kMostContactsTried;
  const std::string_view method = few ? "enumerate" : kAutomatic;
  const Solution solution = SolveIn(problem, RequestFor(method, Arithmetic::kExact));
  if (solution.outcome() == Outcome::kNoSolution) return {true, false};
  const auto& answer = std::get<ExactAnswer>(solution.answer);
  if (!answer.Solved()) return {};
  const Rational bound = answer.bound.value_or(1);
  if (Violation(problem, answer.f, bound)) return {};
  return {true, true, answer.f, bound};
}

// ---- Steps -------------------------------------------------------------------------------------------

using OfForces = std::function<ExactVector(const ExactVector&)>;

struct Step {
  std::string name;
  Case to;
  OfForces forward, backward;  // of solutions; no `backward` where they need not be
  bool solvable = true;        // whether what was added is
  bool keeps_errors = false;   // of any forces, as solver/problem/errors.h says
};

inline OfForces Same() {
  return [](const ExactVector& f) { return f; };
}

// The rows G of the contacts.
inline Step InRows(std::string name, const Case& from, std::vector<Contact<Rational>> contacts,
                   const ExactMatrix& G, OfForces forward) {
  Step step{std::move(name), {}, std::move(forward), [G](const ExactVector& f) -> ExactVector {
              return G.transpose() * f;
            }};
  step.to.problem = {from.problem.dimension, contacts, G * from.problem.A * G.transpose(), G * from.problem.b};
  if (!from.factors) return step;
  FactorParts parts{{}, BlocksOf(from.factors->M), from.factors->w, G * from.factors->c};
  const ExactMatrix J = G * ExactMatrix(from.factors->A.J());
  for (int i = 0; i < J.rows(); ++i) {
    for (int j = 0; j < J.cols(); ++j)
      if (J(i, j) != 0) parts.J[{i, j}] = J(i, j);
  }
  step.to.factors = MakeFactors(from.problem.dimension, std::move(contacts), std::move(parts));
  return step;
}

inline ExactMatrix Zeros(int rows, int columns) { return ExactMatrix::Constant(rows, columns, Rational(0)); }

inline int FirstRowOf(const ExactProblem& problem, int contact) {
  int first = 0;
  ForEachContact(problem, [&](int k, int row, int) { first = k == contact ? row : first; });
  return first;
}

inline Step Permute(const Case& from, Choices& choices) {
  std::vector<int> order(from.problem.contacts.size());
  std::iota(order.begin(), order.end(), 0);
  for (int k = static_cast<int>(order.size()) - 1; k > 0; --k)
    std::swap(order[k], order[choices.Integer(0, k)]);
  ExactMatrix G = Zeros(from.problem.rows(), from.problem.rows());
  std::vector<Contact<Rational>> contacts;
  int row = 0;
  for (const int k : order) {
    contacts.push_back(from.problem.contacts[k]);
    const int count = RowsOf(contacts.back(), from.problem.dimension);
    for (int i = 0; i < count; ++i) G(row++, FirstRowOf(from.problem, k) + i) = 1;
  }
  Step step = InRows("permute", from, contacts, G, [G](const ExactVector& f) -> ExactVector { return G * f; });
  step.keeps_errors = true;
  return step;
}

// Of the tangents in the plane and in space: a rotation by 3-4-5 either way, or one that changes coordinates.
inline ExactMatrix DrawTurn(Choices& choices, int tangents) {
  ExactMatrix turn = ExactMatrix::Identity(tangents, tangents);
  if (tangents == 2) {
    const Rational c(3, 5), s(choices.Integer(0, 1) == 0 ? 4 : -4, 5);
    switch (choices.Integer(0, 3)) {
      case 0:
        return turn;
      case 1:
        turn << c, s, -s, c;
        break;
      case 2:
        turn << 0, 1, 1, 0;
        break;
      default:
        turn << s, -c, -c, -s;
    }
    return turn;
  }
  if (choices.Integer(0, 1) == 1) turn(0, 0) = -1;
  return turn;
}

inline Step Turn(const Case& from, Choices& choices) {
  const int tangents = from.problem.dimension - 1;
  ExactMatrix G = ExactMatrix::Identity(from.problem.rows(), from.problem.rows());
  std::vector<Contact<Rational>> contacts = from.problem.contacts;
  ForEachContact(from.problem, [&](int k, int row, int count) {
    if (count == 1) return;
    const ExactMatrix turn = DrawTurn(choices, tangents);
    G.block(row + 1, row + 1, tangents, tangents) = turn;
    for (int i = 0; i < tangents; ++i) {
      contacts[k].slip[i] = 0;
      for (int j = 0; j < tangents; ++j) contacts[k].slip[i] += turn(i, j) * from.problem.contacts[k].slip[j];
    }
  });
  Step step = InRows("turn", from, contacts, G, [G](const ExactVector& f) -> ExactVector { return G * f; });
  step.keeps_errors = tangents == 1;
  return step;
}

inline Rational DrawUnit(Choices& choices) {
  static const Rational kUnits[] = {1, 2, Rational(1, 64), Rational(3, 7), 1024, Number("1e-6"), Number("1e6")};
  static const Rational kFar[] = {Number("1e-300"), Number("1e-38"), Number("1e38"), Number("1e150")};
  return OneIn(choices, 16) ? kFar[choices.Integer(0, 3)] : kUnits[choices.Integer(0, 6)];
}

inline Step Units(const Case& from, Choices& choices) {
  ExactMatrix G = Zeros(from.problem.rows(), from.problem.rows());
  std::vector<Contact<Rational>> contacts = from.problem.contacts;
  const bool stretch = choices.Integer(0, 1) == 1;
  ForEachContact(from.problem, [&](int k, int row, int count) {
    const Rational normal = DrawUnit(choices), tangent = stretch ? DrawUnit(choices) : normal;
    for (int i = 0; i < count; ++i) G(row + i, row + i) = i == 0 ? normal : tangent;
    contacts[k].mu *= normal / tangent;
    if (contacts[k].kind == ContactKind::kBilateral && choices.Integer(0, 1) == 1) G.row(row) *= Rational(-1);
  });
  Step step = InRows("units", from, contacts, G, [G](const ExactVector& f) -> ExactVector {
    return f.cwiseQuotient(ExactVector(G.diagonal()));
  });
  step.keeps_errors = true;
  return step;
}

inline Step Split(const Case& from, Choices& choices) {
  const int rows = from.problem.rows();
  const int k = static_cast<int>(choices.Integer(0, from.problem.contacts.size() - 1));
  const int first = FirstRowOf(from.problem, k);
  std::vector<Contact<Rational>> contacts = from.problem.contacts;
  contacts.push_back(contacts[k]);
  const int count = RowsOf(contacts[k], from.problem.dimension);
  const bool pulls = contacts[k].kind == ContactKind::kBilateral;
  const Rational unit = DrawUnit(choices) * Rational(pulls && choices.Integer(0, 1) == 1 ? -1 : 1);
  const Rational share = Rational(choices.Integer(pulls ? -2 : 0, pulls ? 4 : 2)) / 2;
  ExactMatrix G = Zeros(rows + count, rows);
  G.topRows(rows).setIdentity();
  for (int i = 0; i < count; ++i) G(rows + i, first + i) = unit;
  return InRows("split", from, contacts, G, [=](const ExactVector& f) {
    ExactVector both(rows + count);
    both << f, ExactVector(f.segment(first, count) * Rational((1 - share) / unit));
    both.segment(first, count) *= share;
    return both;
  });
}

inline Step Smooth(const Case& from, Choices&) {
  std::vector<Contact<Rational>> contacts = from.problem.contacts;
  std::vector<int> kept;
  ForEachContact(from.problem, [&](int k, int row, int count) {
    const bool smooth = count > 1 && contacts[k].mu == 0;
    for (int i = 0; i < (smooth ? 1 : count); ++i) kept.push_back(row + i);
    if (smooth) contacts[k] = {ContactKind::kFrictionless, 0, {}};
  });
  ExactMatrix G = Zeros(static_cast<int>(kept.size()), from.problem.rows());
  for (std::size_t i = 0; i < kept.size(); ++i) G(i, kept[i]) = 1;
  return InRows("smooth", from, contacts, G, [G](const ExactVector& f) -> ExactVector { return G * f; });
}

// `more` behind it, neither feels the other; more_f of its solution.
inline Step Beside(std::string name, const Case& from, const ExactProblem& more, const ExactVector& more_f) {
  const int rows = from.problem.rows();
  return {std::move(name),
          {Decoupled(from.problem, more)},
          [more_f](const ExactVector& f) {
            ExactVector both(f.size() + more_f.size());
            both << f, more_f;
            return both;
          },
          [rows](const ExactVector& f) -> ExactVector { return f.head(rows); }};
}

inline Step Idle(const Case& from, Choices& choices) {
  ExactProblem idle;
  idle.dimension = from.problem.dimension;
  idle.contacts = {{choices.Integer(0, 1) == 0 ? ContactKind::kFrictionless : ContactKind::kStatic, 0, {}}};
  if (idle.contacts[0].HasFrictionRows()) idle.contacts[0].mu = choices.Integer(0, 2);
  const int rows = RowCount(idle.contacts, idle.dimension);
  idle.A = Zeros(rows, rows);
  idle.b = ExactVector::Constant(rows, Rational(1));
  for (int i = 0; i < rows; ++i) {
    idle.A(i, i) = choices.Integer(0, 3);
    if (i > 0) idle.b[i] = choices.Integer(-2, 2);
  }
  Step step = Beside("idle", from, idle, ExactVector::Constant(rows, Rational(0)));
  step.keeps_errors = true;
  return step;
}

inline Step Sum(const Case& from, Choices& choices) {
  const ExactProblem other = DrawProblem(choices, from.problem.dimension, 1).problem;
  const Truth truth = TruthOf(other);
  if (!truth.is_known || truth.bound != 1) return {"stay", from, Same(), Same()};
  const ExactVector none = ExactVector::Constant(other.rows(), Rational(0));
  Step step = Beside(truth.solvable ? "sum" : "sum with what has no solution", from, other,
                     truth.solvable ? truth.f : none);
  step.solvable = truth.solvable;
  return step;
}

inline Step Border(const Case& from, Choices& choices) {
  const ExactProblem& problem = from.problem;
  const int rows = problem.rows();
  const Rational d = choices.Integer(1, 3), b = choices.Integer(-3, 3);
  ExactVector u(rows);
  for (int i = 0; i < rows; ++i) u[i] = choices.Integer(-1, 1);
  ExactProblem bordered = problem;
  bordered.contacts.insert(bordered.contacts.begin(), {ContactKind::kBilateral, 0, {}});
  bordered.A.resize(rows + 1, rows + 1);
  bordered.A << d, u.transpose(), u, problem.A + u * u.transpose() / d;
  bordered.b.resize(rows + 1);
  bordered.b << b, problem.b + u * b / d;
  return {"border",
          {bordered},
          [=](const ExactVector& f) {
            ExactVector all(rows + 1);
            all << Rational(-(b + u.dot(f)) / d), f;
            return all;
          },
          [rows](const ExactVector& f) -> ExactVector { return f.tail(rows); }};
}

inline Step Scale(const Case& from, Choices& choices) {
  const Rational of_A = DrawUnit(choices), of_b = DrawUnit(choices);
  Step step{"scale", {from.problem}, {}, {}};
  step.to.problem.A *= of_A;
  step.to.problem.b *= of_b;
  step.forward = [r = Rational(of_b / of_A)](const ExactVector& f) -> ExactVector { return f * r; };
  step.backward = [r = Rational(of_A / of_b)](const ExactVector& f) -> ExactVector { return f * r; };
  step.keeps_errors = true;
  return step;
}

inline Step IntoSpace(const Case& from, Choices& choices) {
  std::vector<int> old;  // rows; -1 for a new one
  ForEachContact(from.problem, [&old](int, int row, int count) {
    for (int i = 0; i < count; ++i) old.push_back(row + i);
    if (count > 1) old.push_back(-1);
  });
  const int rows = static_cast<int>(old.size());
  Step step{"space", {}, {}, {}};
  ExactProblem& space = step.to.problem;
  space = {3, from.problem.contacts, Zeros(rows, rows), ExactVector::Constant(rows, Rational(0))};
  for (int i = 0; i < rows; ++i) {
    if (old[i] < 0) space.A(i, i) = choices.Integer(1, 3);
    for (int j = 0; j < rows && old[i] >= 0; ++j)
      if (old[j] >= 0) space.A(i, j) = from.problem.A(old[i], old[j]);
    if (old[i] >= 0) space.b[i] = from.problem.b[old[i]];
  }
  step.forward = [old](const ExactVector& f) {
    ExactVector wide(old.size());
    for (std::size_t i = 0; i < old.size(); ++i) wide[i] = old[i] < 0 ? Rational(0) : f[old[i]];
    return wide;
  };
  return step;
}

// A step from there, of at most so many rows.
inline Step DrawStep(const Case& from, Choices& choices, int most_rows) {
  const bool has_room = from.problem.rows() + 3 <= most_rows;
  switch (choices.Integer(0, 12)) {
    case 1:
    case 2:
      return Permute(from, choices);
    case 3:
      return Turn(from, choices);
    case 4:
    case 5:
      return Units(from, choices);
    case 6:
      if (has_room) return Split(from, choices);
      break;
    case 7:
      return Smooth(from, choices);
    case 8:
      if (has_room) return Idle(from, choices);
      break;
    case 9:
      if (has_room) return Sum(from, choices);
      break;
    case 10:
      if (has_room) return Border(from, choices);
      break;
    case 11:
      return Scale(from, choices);
    case 12:
      if (from.problem.dimension == 2) return IntoSpace(from, choices);
      break;
    default:
      break;
  }
  return {"stay", from, Same(), Same()};
}

// ---- Walks -------------------------------------------------------------------------------------------

struct Walk {
  Case start;
  std::vector<Step> steps;

  const Case& end() const { return steps.empty() ? start : steps.back().to; }
  std::string Names() const {
    std::string names;
    for (const Step& step : steps) names += step.name == "stay" ? "" : " " + step.name;
    return names.empty() ? " none" : names;
  }
};

inline Walk DrawWalk(Choices& choices) {
  constexpr int kMostRows = 9;
  Walk walk;
  switch (choices.Integer(0, 9)) {
    case 9:
      walk.start = DrawScene(choices);
      break;
    case 7:
    case 8:
      walk.start = DrawGenerated(choices);
      break;
    case 5:
    case 6:
      walk.start = DrawProblem(choices, 3, 2);
      break;
    default:
      walk.start = DrawProblem(choices, 2, 3);
  }
  for (auto steps = choices.Integer(0, 5); steps > 0; --steps)
    walk.steps.push_back(DrawStep(walk.end(), choices, kMostRows));
  return walk;
}

}  // namespace stiction::testing
