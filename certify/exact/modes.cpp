// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/modes.h"

#include <array>

#include "certify/exact/verify_solution.h"
#include "solver/problem/check.h"

namespace stiction {

std::string_view Name(Mode mode) {
  static constexpr std::array<std::string_view, 6> kNames = {"hold",  "break", "touch",
                                                             "stick", "slip+", "slip-"};
  return kNames[static_cast<int>(mode)];
}

namespace {

using enum Mode;

bool HasFrictionModes(const Contact<Rational>& contact) {
  return contact.kind == ContactKind::kStatic && contact.mu > 0;
}

}  // namespace

std::span<const Mode> ModesOf(const Contact<Rational>& contact, int dimension) {
  static constexpr std::array<Mode, 1> kBilateral = {kHold};
  static constexpr std::array<Mode, 2> kOneSided = {kBreak, kTouch};
  static constexpr std::array<Mode, 4> kFriction = {kBreak, kStick, kSlipPlus, kSlipMinus};
  if (contact.kind == ContactKind::kBilateral) return kBilateral;
  if (dimension == 2 && HasFrictionModes(contact)) return kFriction;
  return kOneSided;
}

mpz_class Completions(const ExactProblem& problem, std::size_t length) {
  mpz_class count = 1;
  for (std::size_t i = length; i < problem.contacts.size(); ++i)
    count *= ModesOf(problem.contacts[i], problem.dimension).size();
  return count;
}

std::vector<ModeWord> AllWords(const ExactProblem& problem) {
  std::vector<ModeWord> words = {{}};
  for (const auto& contact : problem.contacts) {
    std::vector<ModeWord> longer;
    for (const ModeWord& word : words) {
      for (const Mode mode : ModesOf(contact)) {
        longer.push_back(word);
        longer.back().push_back(mode);
      }
    }
    words = std::move(longer);
  }
  return words;
}

// ---- Modes as cones ----------------------------------------------------------------------------

namespace {

// fF of the force with fN = 1 of a contact that has one direction only.
Rational SingleEdge(const Contact<Rational>& contact) {
  return contact.kind == ContactKind::kSliding ? Rational(-contact.mu * contact.slip[0]) : Rational(0);
}

}  // namespace

Cone ConeOf(const Contact<Rational>& contact, Mode mode) {
  const Rational mu = contact.mu;
  switch (mode) {
    case kHold:
      return {{{0, true}}, Relation::kZero, Relation::kFree};
    case kBreak:
      return {{}, Relation::kAtLeastZero, Relation::kFree};
    case kTouch:
      return {{{SingleEdge(contact)}}, Relation::kZero, Relation::kFree};
    case kStick:
      return {{{mu}, {-mu}}, Relation::kZero, Relation::kZero};
    case kSlipPlus:
      return {{{-mu}}, Relation::kZero, Relation::kAtLeastZero};
    case kSlipMinus:
      return {{{mu}}, Relation::kZero, Relation::kAtMostZero};
  }
  STICTION_FAIL("no such mode");
}

Cone RelaxedCone(const Contact<Rational>& contact) {
  if (contact.kind == ContactKind::kBilateral) return ConeOf(contact, kHold);
  Cone cone = ConeOf(contact, HasFrictionModes(contact) ? kStick : kTouch);
  cone.a_n = Relation::kAtLeastZero;
  cone.a_t = Relation::kFree;
  return cone;
}

bool MeetsModes(const ExactProblem& problem, const ModeWord& prefix, const ExactVector& f,
                const ExactVector& a) {
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    const Cone cone = i < prefix.size() ? ConeOf(contact, prefix[i]) : RelaxedCone(contact);
    const bool rough = contact.HasFrictionRows();
    if (!Holds(cone.a_n, a[row]) || (rough && !Holds(cone.a_t, a[row + 1]))) return false;
    if (cone.edges.empty() && (f[row] != 0 || (rough && f[row + 1] != 0))) return false;
    if (rough && cone.edges.size() == 1 && f[row + 1] != cone.edges[0].f_t * f[row]) return false;
    row += rough ? 2 : 1;
  }
  return !FindViolationApart(problem, f, a);
}

}  // namespace stiction
