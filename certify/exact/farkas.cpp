// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/farkas.h"

#include <fmt/format.h>

#include <span>

namespace stiction {
namespace {

using enum Mode;

// gF, yF of a contact, zero where it has no friction row.
Rational FrictionEntry(const Contact<Rational>& contact, int row, const ExactVector& values) {
  return contact.HasFrictionRows() ? values[row + 1] : Rational(0);
}

Rational SlipOf(const Contact<Rational>& contact) {
  return contact.kind == ContactKind::kSliding ? contact.slip[0] : Rational(0);
}

// TermIsNonnegative in space: of touch and break, of contacts with friction rows.
bool TermIsNonnegativeInSpace(const Contact<Rational>& contact, int row, Mode mode,
                              const FarkasVector& farkas) {
  const ExactVector &y = farkas.y, &g = farkas.g;
  if (y[row + 1] != 0 || y[row + 2] != 0) return false;
  if (mode == kBreak) return y[row] >= 0;
  if (contact.kind == ContactKind::kSliding)
    return g[row] <= contact.mu * (contact.slip[0] * g[row + 1] + contact.slip[1] * g[row + 2]);
  const Rational square = g[row + 1] * g[row + 1] + g[row + 2] * g[row + 2];
  return g[row] <= 0 && contact.mu * contact.mu * square <= g[row] * g[row];
}

// The first contact and mode whose term can be negative.
std::optional<std::pair<std::size_t, Mode>> FindGap(const ExactProblem& problem, const ModeWord& prefix,
                                                    const FarkasVector& farkas) {
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    const auto modes = i < prefix.size() ? std::span(&prefix[i], 1) : ModesOf(contact, problem.dimension);
    for (const Mode mode : modes) {
      if (!TermIsNonnegative(contact, row, mode, farkas, problem.dimension)) return std::pair(i, mode);
    }
    row += contact.HasFrictionRows() ? problem.dimension : 1;
  }
  return std::nullopt;
}

}  // namespace

FarkasVector MakeFarkasVector(const ExactProblem& problem, const ExactVector& y) {
  FarkasVector farkas = {y, ExactVector::Constant(problem.rows(), Rational(0)), 0};
  for (int i = 0; i < problem.rows(); ++i) {
    if (y[i] == 0) continue;
    for (int j = 0; j < problem.rows(); ++j) farkas.g[j] += problem.A(i, j) * y[i];
    farkas.value += problem.b[i] * y[i];
  }
  return farkas;
}

bool TermIsNonnegative(const Contact<Rational>& contact, int row, Mode mode, const FarkasVector& farkas,
                       int dimension) {
  if (dimension == 3 && contact.HasFrictionRows()) return TermIsNonnegativeInSpace(contact, row, mode, farkas);
  const Rational &yN = farkas.y[row], &gN = farkas.g[row];
  const Rational yF = FrictionEntry(contact, row, farkas.y), gF = FrictionEntry(contact, row, farkas.g);
  const Rational along = contact.mu * gF;
  switch (mode) {
    case kHold:
      return gN == 0;
    case kBreak:
      return yN >= 0 && yF == 0;
    case kTouch:
      return gN - SlipOf(contact) * along <= 0 && yF == 0;
    case kStick:
      return gN + abs(along) <= 0;
    case kSlipPlus:
      return gN - along <= 0 && yF >= 0;
    case kSlipMinus:
      return gN + along <= 0 && yF <= 0;
  }
  return false;
}

bool Refutes(const ExactProblem& problem, const ModeWord& prefix, const FarkasVector& farkas) {
  return farkas.value < 0 && !FindGap(problem, prefix, farkas);
}

std::optional<std::string> FindRefutationGap(const ExactProblem& problem, const ModeWord& prefix,
                                             const FarkasVector& farkas) {
  if (farkas.value >= 0) return "y'b = " + ToString(farkas.value) + ", expected a number < 0";
  const auto gap = FindGap(problem, prefix, farkas);
  if (!gap) return std::nullopt;
  return fmt::format("the term of contact {} can be negative in mode {}", gap->first + 1, Name(gap->second));
}

}  // namespace stiction
