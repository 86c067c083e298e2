// SPDX-License-Identifier: Apache-2.0
// Inexact arithmetic against what is decided exactly of the same doubles.

#include <catch2/catch.hpp>

#include "certify/exact/enumerate.h"
#include "solver/complete/complete.ipp"
#include "solver/lemke/lemke.ipp"
#include "solver/numeric/fast.ipp"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

// A = J J' of deficient rank, b anywhere: small integers, or numbers whose products round.
ContactProblem<double> RandomDeficient(std::uint64_t seed) {
  Choices choices(seed);
  const int contacts = static_cast<int>(1 + seed % 2), rows = 2 * contacts;
  const int columns = static_cast<int>(choices.Integer(1, rows - 1));
  const bool integers = choices.Integer(0, 1) == 0;
  const auto draw = [&](int small) {
    return integers ? static_cast<double>(choices.Integer(-small, small))
                    : static_cast<double>(choices.Integer(-1000000, 1000000)) / 999983;
  };
  ContactProblem<double> problem;
  Eigen::MatrixXd J(rows, columns);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) J(i, j) = draw(3);
  }
  problem.A = J * J.transpose();
  problem.A = (problem.A + problem.A.transpose()).eval() / 2;
  problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) problem.b[i] = draw(5);
  for (int i = 0; i < contacts; ++i)
    problem.contacts.push_back({ContactKind::kStatic, static_cast<double>(choices.Integer(0, 8)) / 2, {}});
  return problem;
}

ExactProblem Exactly(const ContactProblem<double>& problem) {
  ExactProblem exact;
  for (const auto& contact : problem.contacts)
    exact.contacts.push_back({contact.kind, Rational(contact.mu), {}});
  exact.A.resize(problem.rows(), problem.rows());
  exact.b.resize(problem.rows());
  for (int i = 0; i < problem.rows(); ++i) {
    exact.b[i] = Rational(problem.b[i]);
    for (int j = 0; j < problem.rows(); ++j) exact.A(i, j) = Rational(problem.A(i, j));
  }
  return exact;
}

TEST_CASE("inexact: a problem without a solution is never called solved") {
  FastSolver<double> fast;
  CompleteDriving<double> complete;
  LemkeAlgorithm<double> lemke({}, Cover::kUnits);
  int without = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    CAPTURE(seed);
    const ContactProblem<double> problem = RandomDeficient(seed);
    if (!EnumerateModes(Exactly(problem), {}, UntilSolved).ProvesNoSolution()) continue;
    ++without;
    CHECK(fast.Run(problem).outcome != Outcome::kSolved);
    CHECK(complete.Run(problem).outcome != Outcome::kSolved);
    CHECK(lemke.Run(problem).outcome != Outcome::kSolved);
  }
  CHECK(without > 200);
}

}  // namespace
}  // namespace stiction
