// SPDX-License-Identifier: Apache-2.0
// The model tester: small problems, drawn where methods are in doubt, through every method and arithmetic, in
// every form; all answers against each other, against enumeration, and against what they say of themselves.
//
//   draw     bodies of few velocities with fractions, so that ranks are low and rounding changes the problem;
//   jams,
//            zeros, rows without an own acceleration, A that is unsymmetric or indefinite, every kind of
//            contact
//   truth    in the plane: enumeration over rationals, whose solution is verified
//   hold     FaultsOf(problem): what an answer says that is false, by kind
//   shrink   search/units/minimize.h, keeping the kind of fault
//
// A fault's kind is its first word; a problem is shrunk only to others of the same kind.

#ifndef STICTION_TESTS_MODEL_MODEL_H_
#define STICTION_TESTS_MODEL_MODEL_H_

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "certify/exact/properties.h"
#include "certify/exact/verify_solution.h"
#include "certify/request/solve_in.h"
#include "corpus/record/problem_file.h"
#include "search/generators/choices.h"
#include "search/units/minimize.h"
#include "tests/judge.h"

namespace stiction::testing {

// ---- Draw
// ----------------------------------------------------------------------------------------------------

inline Rational DrawFraction(Choices& choices, int most) {
  Rational x(choices.Integer(-most, most));
  if (choices.Integer(0, 2) > 0) x /= choices.Integer(1, 13);
  return x;
}

inline std::vector<Contact<Rational>> DrawContacts(Choices& choices, int dimension) {
  static const Rational kMu[] = {0, Rational(1, 3), Rational(1, 2), 1, 2, 10, Rational(1000000000)};
  std::vector<Contact<Rational>> contacts(choices.Integer(1, 3));
  for (auto& contact : contacts) {
    contact.kind = static_cast<ContactKind>(choices.Integer(0, 3));
    if (!contact.HasFrictionRows()) continue;
    contact.mu = kMu[choices.Integer(0, 6)];
    if (contact.kind != ContactKind::kSliding) continue;
    if (dimension == 2) {
      contact.slip[0] = choices.Integer(0, 1) == 0 ? 1 : -1;
    } else {
      contact.slip = {Rational(3, 5), Rational(4 - 8 * choices.Integer(0, 1), 5)};
    }
  }
  return contacts;
}

inline ExactProblem DrawProblem(Choices& choices, int dimension) {
  ExactProblem problem;
  problem.dimension = dimension;
  problem.contacts = DrawContacts(choices, dimension);
  const int rows = RowCount(problem.contacts, dimension);
  const int columns = static_cast<int>(choices.Integer(0, 3) == 0 ? 1 : choices.Integer(1, rows));
  ExactMatrix J(rows, columns);
  ExactVector w(columns);
  for (int j = 0; j < columns; ++j) {
    w[j] = DrawFraction(choices, 9);
    for (int i = 0; i < rows; ++i)
      J(i, j) = choices.Integer(0, 3) == 0 ? Rational(0) : DrawFraction(choices, 3);
  }
  problem.A = J * J.transpose();
  problem.b = J * w;
  switch (choices.Integer(0, 7)) {
    case 0:  // outside the range of A
      problem.b[choices.Integer(0, rows - 1)] += DrawFraction(choices, 2);
      break;
    case 1:  // unsymmetric, perhaps indefinite
      problem.A(choices.Integer(0, rows - 1), choices.Integer(0, rows - 1)) += DrawFraction(choices, 2);
      break;
    case 2: {  // other units, far apart
      const Rational unit = Rational(1) / Rational(choices.Integer(1, 1000000));
      const int row = static_cast<int>(choices.Integer(0, rows - 1));
      if (problem.contacts.size() == 1 || rows == static_cast<int>(problem.contacts.size())) {
        problem.A.row(row) *= unit;
        problem.A.col(row) *= unit;
        problem.b[row] *= unit;
      }
      break;
    }
    default:
      break;
  }
  return problem;
}

// ---- Hold
// ----------------------------------------------------------------------------------------------------

// What is known of a problem in the plane, by enumeration.
struct Truth {
  bool is_known = false;
  bool solvable = false;
};
inline Truth TruthOf(const ExactProblem& problem) {
  if (problem.dimension != 2) return {};
  const Solution solution = SolveIn(problem, {.method = "enumerate"});
  if (solution.outcome() == Outcome::kNoSolution) return {true, false};
  const auto* answer = std::get_if<ExactAnswer>(&solution.answer);
  const bool solved = answer != nullptr && answer->Solved() && !FindViolation(problem, answer->f);
  return {solved, solved};
}

inline Request RequestFor(std::string_view method, Arithmetic arithmetic, FrictionLaw law) {
  Request request{.method = method, .arithmetic = arithmetic};
  request.law = law;
  request.limits.drives = request.limits.pivots = 1000;
  return request;
}

// What one answer says that is false; empty if nothing.
inline std::string FaultOfAnswer(const ExactProblem& problem, const Truth& truth, const Request& request,
                                 const Solution& solution) {
  const Outcome outcome = solution.outcome();
  const auto* exact = std::get_if<ExactAnswer>(&solution.answer);
  if (outcome == Outcome::kNoSolution) {
    if (exact == nullptr) return "rounded: no-solution is said of a rounded problem";
    if (truth.is_known && truth.solvable) return "falsehood: no-solution of a problem that has one";
  }
  if (exact != nullptr && exact->f.size() == problem.rows() && exact->Solved()) {
    const std::string fault = FaultOf(problem, *exact);  // exact answers are of the file
    if (!fault.empty()) return "inexact: an exact answer is none: " + fault;
  } else if (exact == nullptr && outcome == Outcome::kSolved) {
    const std::string fault = FaultOf(problem, request, solution);
    if (!fault.empty()) return "gate: " + fault;
    if (truth.is_known && !truth.solvable && AsRun(problem, request.arithmetic).A == problem.A &&
        AsRun(problem, request.arithmetic).b == problem.b)
      return "";  // a neighbour may have a solution that the problem has not
  }
  if (exact == nullptr) {
    const Arithmetic told = std::get<InexactAnswer>(solution.answer).arithmetic;
    const bool escalates = request.method == kAutomatic;  // doubles go on over quad
    if (told != request.arithmetic && !escalates)
      return fmt::format("name: {} answers over {}", Name(request.arithmetic), Name(told));
  }
  return "";
}

// The first thing that is false of a problem, over all methods, arithmetics and laws; empty if there is none.
inline std::string FaultIn(const ExactProblem& problem) {
  const Truth truth = TruthOf(problem);
  std::vector<std::string_view> methods = {kAutomatic};
  for (const MethodFacts& facts : AllMethods()) methods.push_back(facts.name);
  for (const std::string_view method : methods) {
    if (method == "ipopt") continue;  // a process of its own, which proposes only
    for (int k = 0; k < kArithmeticCount; ++k) {
      const auto arithmetic = static_cast<Arithmetic>(k);
      if (!Refusal(method, problem.dimension, arithmetic).empty()) continue;
      for (const FrictionLaw law : {FrictionLaw::kCoulomb, FrictionLaw::kBaraff}) {
        if (law == FrictionLaw::kBaraff && (problem.dimension == 2 || method != "baraff")) continue;
        if (law == FrictionLaw::kCoulomb && problem.dimension == 3 && method == "baraff") continue;
        const Request request = RequestFor(method, arithmetic, law);
        try {
          const Solution solution = SolveIn(problem, request);
          const std::string fault = FaultOfAnswer(problem, truth, request, solution);
          if (!fault.empty()) return fmt::format("{} ({} over {})", fault, method, Name(arithmetic));
        } catch (
            const InputError&) {  // a number that the arithmetic does not hold, or a reading that is not built
        } catch (const std::exception& error) {
          return fmt::format("throws: {} ({} over {})", error.what(), method, Name(arithmetic));
        }
      }
    }
  }
  return "";
}

// Forms of one problem: the file that is printed is the problem; contacts in another order, and other units of
// each, have a solution where it has one.
inline std::string FaultInForms(const ExactProblem& problem) {
  ProblemFile file;
  file.name = "drawn";
  file.problem = problem;
  const ExactProblem read = ParseProblem(Print(file), "drawn").problem;
  if (read.A != problem.A || read.b != problem.b) return "file: what is printed is read as another problem";
  const Truth truth = TruthOf(problem);
  if (!truth.is_known) return "";
  ExactProblem scaled = problem;
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const Rational unit = i % 2 == 0 ? Rational(1024) : Rational(1, 64);
    for (int end = row + RowsOf(problem.contacts[i], 2); row < end; ++row) {
      scaled.A.row(row) *= unit;
      scaled.A.col(row) *= unit;
      scaled.b[row] *= unit;
    }
  }
  const Truth same = TruthOf(scaled);
  if (same.is_known && same.solvable != truth.solvable)
    return "units: other units of the contacts change existence";
  return "";
}

// ---- Shrink
// --------------------------------------------------------------------------------------------------

inline std::string KindOf(const std::string& fault) { return fault.substr(0, fault.find(':')); }

// The smallest problem found with a fault of the same kind, as text.
inline std::string Shrunk(const ExactProblem& problem, const std::string& fault) {
  MinimizeOptions options;
  options.keeps = [kind = KindOf(fault)](const ExactProblem& candidate) {
    std::string found = FaultInForms(candidate);
    if (found.empty()) found = FaultIn(candidate);
    return KindOf(found) == kind && !found.empty();
  };
  ProblemFile file;
  file.name = "shrunk";
  file.problem = Minimize(problem, options).problem;
  return fault + "\n" + Print(file);
}

}  // namespace stiction::testing

#endif  // STICTION_TESTS_MODEL_MODEL_H_
