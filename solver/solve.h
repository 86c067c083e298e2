// SPDX-License-Identifier: Apache-2.0
// Solve: one problem, one method, one answer. Entry of the library.
//
//   #include <iostream>
//
//   #include "solver/solve.h"
//
//   int main() {  // a box of 1 kg on a floor, mu = 0.5, pulled sideways by 8 N
//     stiction::ContactProblem<double> problem;
//     problem.contacts = {{stiction::ContactKind::kStatic, 0.5}};
//     problem.A = Eigen::Matrix2d::Identity();  // 1/kg
//     problem.b = Eigen::Vector2d(-10, 8);      // without contact: it falls, and slides
//     const auto answer = stiction::Solve(problem);
//     std::cout << Name(answer.outcome) << ", f = " << answer.f.transpose() << '\n';
//   }
//
// prints: solved, f = 10 -5
//
// Methods() is the table of all that this library has over a scalar; whatever chooses or names a method reads
// it. Solve() does what every call needs:
//
//   scale     A and b by powers of two, each contact in units of its own (row_scale.h; exact)
//   reduce    bilateral and sliding contacts leave the problem, for methods that do not take them (4.5, 6)
//   run       the method
//   restore   rows, contacts and units of the whole problem
//   gate      `solved` is said of forces whose own errors, with a = A f + b computed anew and its rounding
//             bounded, are at most the stated bound (gate.h); forces that nearly are so are refined
//             (numeric/refine.h); whatever else claims to be solved is `undecided`
//
// Over exact scalars nothing is scaled, and the gate is the verification of certify.

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "solver/problem/answer.h"
#include "solver/problem/enclosure.h"
#include "solver/problem/errors.h"
#include "solver/problem/options.h"
#include "solver/problem/problem.h"

namespace stiction {

template <class Scalar>
using MethodRun = Answer<Scalar> (*)(const ContactProblem<Scalar>&, const Request&);

// How the steps of a run are told.
enum class Path : std::uint8_t {
  kNone,    // it records none
  kDrives,  // of one contact after another, with the sets of all
  kPieces,  // of one contact after another, with the cells of all
  kPivots,  // of a tableau
};

// The reason of an undecided run over enclosures.
inline constexpr std::string_view kUnsureSign = "a sign is unsure";

inline constexpr int kNeverFirst = std::numeric_limits<int>::max();

// A method as it is built for one dimension; `run` is null where it is not.
template <class Scalar>
struct MethodIn {
  MethodRun<Scalar> run = nullptr;
  bool takes_all_kinds = false;  // otherwise bilateral and sliding contacts leave a problem first
  bool on_request = false;       // `auto` passes it over, though the row is automatic
  int first_from = kNeverFirst;  // rows from which on `auto` tries it before all others
};

// A row of the table.
template <class Scalar>
struct Method {
  std::string_view name;          // in --method
  std::string_view title;         // what the field calls it
  std::string_view source;        // section of the paper, or reference
  std::string_view ends;          // what its end proves
  bool automatic = false;         // `auto` tries these, by default in the order of the table, until one decides
  Path path = Path::kNone;        // of the trace that it records
  std::string_view heading = {};  // of a run that is told
  MethodIn<Scalar> plane;
  MethodIn<Scalar> space;

  const MethodIn<Scalar>& In(int dimension) const { return dimension == 2 ? plane : space; }
  bool IsBuilt(int dimension) const { return In(dimension).run != nullptr; }
  bool IsAutomatic(int dimension) const { return automatic && IsBuilt(dimension) && !In(dimension).on_request; }
  bool IsFirst(int dimension, Eigen::Index rows) const { return rows >= In(dimension).first_from; }
};

// The methods over a scalar: here float and double; wider and exact ones in certify.
template <class Scalar>
std::span<const Method<Scalar>> Methods();

// The row of that name; null if the table has none.
template <class Scalar>
const Method<Scalar>* FindMethod(std::string_view name);

// Runs the method that is asked for, or kAutomatic. Shapes: all vectors rows x 1; f in N, a in m/s^2. Outcomes
// are never exceptions; std::invalid_argument for a method that is not in the table or not built for the
// dimension.
template <class Scalar>
Answer<Scalar> Solve(const ContactProblem<Scalar>& problem, const Request& request = {});

// The same for one row.
template <class Scalar>
Answer<Scalar> SolveBy(const Method<Scalar>& method, const ContactProblem<Scalar>& problem,
                       const Request& request);

// The gate. Floating-point scalars. Sets answer.a and answer.errors; an answer that calls itself solved and
// whose forces are not finite or do not meet the bound becomes undecided.
template <class Scalar>
void JudgeAnswer(const ContactProblem<Scalar>& problem, double bound, Answer<Scalar>& answer);

extern template Answer<float> Solve(const ContactProblem<float>&, const Request&);
extern template Answer<double> Solve(const ContactProblem<double>&, const Request&);
extern template Answer<double> SolveBy(const Method<double>&, const ContactProblem<double>&, const Request&);

}  // namespace stiction
