// SPDX-License-Identifier: Apache-2.0
// Remainder: what a method for frictionless and static contacts runs on, and its run in the terms of the whole
// problem.
//
// Bilateral and sliding contacts leave the problem first (reduction.h). Afterwards rows and contacts are those
// of the whole problem again: bilateral variables stand in C from the start (4.5), the friction of sliding
// contacts in no set, and forces and accelerations are those of all rows. A problem without such contacts
// remains as it is, and nothing is computed.

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "solver/problem/reduction.h"
#include "solver/problem/solution.h"

namespace stiction {

template <class Scalar>
class Remainder {
 public:
  using Problem = ContactProblem<Scalar>;
  using Vector = typename Problem::Vector;

  // Keeps a reference: `whole` must outlive it.
  explicit Remainder(const Problem& whole, const Tolerances& tolerances = {}, bool exchanges = false)
      : whole_(whole) {
    if (Reduction<Scalar>::Concerns(whole)) reduction_.emplace(whole, tolerances, exchanges);
  }

  const Problem& whole() const { return whole_; }
  // Requires Obstacle().empty().
  const Problem& problem() const { return reduction_ ? reduction_->problem() : whole_; }
  // Why there is nothing to run on; empty where there is.
  std::string_view Obstacle() const { return reduction_ ? Reason(reduction_->end()) : std::string_view(); }

  // Forces of all rows from those of problem(), N; a change of them likewise.
  Vector Forces(const Vector& x) const { return reduction_ ? reduction_->Forces(x) : x; }
  Vector Direction(const Vector& dx) const { return reduction_ ? reduction_->Direction(dx) : dx; }
  Vector Accelerations(const Vector& f) const { return whole_.A * f + whole_.b; }

  int Row(int row) const { return reduction_ && row >= 0 ? reduction_->row_of()[row] : row; }
  int ContactOf(int contact) const {
    return reduction_ && contact >= 0 ? reduction_->contact_of()[contact] : contact;
  }
  // One set per row; bilateral rows are in `bilateral`.
  std::vector<IndexSet> Sets(std::vector<IndexSet> sets, IndexSet bilateral) const {
    return reduction_ ? reduction_->Spread(sets, bilateral, IndexSet::kNone) : sets;
  }
  // The letters of all contacts from those of problem(), one each; a bilateral one is always held, '='. None
  // where contacts are exchanged.
  std::string Word(const std::string& word) const;

  // A step of a run on problem().
  Pivot<Scalar> Restored(Pivot<Scalar> pivot) const;

 private:
  std::vector<std::array<Scalar, 2>> ByContact(const std::vector<std::array<Scalar, 2>>& values) const;

  const Problem& whole_;
  std::optional<Reduction<Scalar>> reduction_;
};

// The letters of all contacts from those of what bilateral contacts left: one is always held, '='.
template <class Contacts>
std::string WholeWord(const Contacts& contacts, const std::string& word) {
  if (word.empty()) return word;
  std::string all;
  std::size_t next = 0;
  for (const auto& contact : contacts) all += contact.kind == ContactKind::kBilateral ? '=' : word.at(next++);
  return all;
}

template <class Scalar>
std::string Remainder<Scalar>::Word(const std::string& word) const {
  if (reduction_ && reduction_->HasExchanges()) return {};
  return reduction_ ? WholeWord(whole_.contacts, word) : word;
}

template <class Scalar>
std::vector<std::array<Scalar, 2>> Remainder<Scalar>::ByContact(
    const std::vector<std::array<Scalar, 2>>& values) const {
  std::vector<std::array<Scalar, 2>> all(whole_.contacts.size(), {Scalar(0), Scalar(0)});
  for (std::size_t i = 0; i < values.size(); ++i) all[ContactOf(static_cast<int>(i))] = values[i];
  return all;
}

template <class Scalar>
Pivot<Scalar> Remainder<Scalar>::Restored(Pivot<Scalar> pivot) const {
  if (!reduction_) return pivot;
  pivot.driven = Row(pivot.driven);
  pivot.limiting = Row(pivot.limiting);
  pivot.df = Direction(pivot.df);
  pivot.da = whole_.A * pivot.df;
  pivot.f = Forces(pivot.f);
  pivot.a = Accelerations(pivot.f);
  pivot.sets = Sets(std::move(pivot.sets), IndexSet::kClamped);
  pivot.word = Word(pivot.word);
  if (!pivot.recorded.empty()) pivot.recorded = ByContact(pivot.recorded);
  return pivot;
}

}  // namespace stiction
