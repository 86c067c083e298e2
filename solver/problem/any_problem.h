// SPDX-License-Identifier: Apache-2.0
// Problem: a = A f + b with the law of every contact, A in the form that it came in.
//
//   dense      ContactProblem: all of A
//   entries    SparseContactProblem: what is not zero
//   factors    FactoredProblem: A = J W J', b = J w + c
//
// Whoever needs another form asks for it: dense() and entries() are made when they are first asked for, once,
// by any thread, and kept. Copies share them. Scalar is an exact type: what is formed is the same problem.

#ifndef STICTION_SOLVER_PROBLEM_ANY_PROBLEM_H_
#define STICTION_SOLVER_PROBLEM_ANY_PROBLEM_H_

#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "solver/problem/factored.h"
#include "solver/problem/problem.h"
#include "solver/problem/units.h"

namespace stiction {

// The same problem with all of A: rows x rows numbers, which memory may not hold.
template <class Scalar, class Matrix>
ContactProblem<Scalar> DenseOf(const ContactProblem<Scalar, Eigen::Dynamic, Matrix>& problem) {
  ContactProblem<Scalar> dense{problem.dimension, problem.contacts, {}, problem.b};
  dense.A = ContactProblem<Scalar>::Matrix::Constant(problem.rows(), problem.rows(), Scalar(0));
  ForEachEntry(problem.A, [&dense](int i, int j, const Scalar& x) { dense.A(i, j) = x; });
  return dense;
}

// The same with the entries of A that are not zero.
template <class Scalar, class Matrix>
SparseContactProblem<Scalar> EntriesOf(const ContactProblem<Scalar, Eigen::Dynamic, Matrix>& problem) {
  std::vector<Eigen::Triplet<Scalar>> entries;
  ForEachEntry(problem.A, [&entries](int i, int j, const Scalar& x) {
    if (x != 0) entries.emplace_back(i, j, x);
  });
  SparseContactProblem<Scalar> sparse{problem.dimension, problem.contacts, {}, problem.b};
  sparse.A.resize(problem.rows(), problem.rows());
  sparse.A.setFromTriplets(entries.begin(), entries.end());
  return sparse;
}

template <class Scalar>
class Problem {
 public:
  using Dense = ContactProblem<Scalar>;
  using Entries = SparseContactProblem<Scalar>;
  using Factored = FactoredProblem<Scalar>;
  using Vector = typename Dense::Vector;

  Problem() : Problem(Dense()) {}
  Problem(Dense dense) : forms_(std::make_shared<Forms>(std::move(dense))) {}        // NOLINT: any form is one
  Problem(Entries entries) : forms_(std::make_shared<Forms>(std::move(entries))) {}  // NOLINT
  Problem(Factored factored) : forms_(std::make_shared<Forms>(std::move(factored))) {}  // NOLINT

  int dimension() const {
    return InItsForm([](const auto& given) { return given.dimension; });
  }
  const std::vector<Contact<Scalar>>& contacts() const {
    return InItsForm([](const auto& given) -> const auto& { return given.contacts; });
  }
  const Vector& b() const {
    return InItsForm([](const auto& given) -> const auto& { return given.b; });
  }
  int rows() const { return static_cast<int>(b().size()); }

  bool IsDense() const { return std::holds_alternative<Dense>(forms_->given); }
  // Null where it did not come in factors.
  const Factored* factors() const { return std::get_if<Factored>(&forms_->given); }

  // visit(problem), as ContactProblem, SparseContactProblem or FactoredProblem.
  template <class Visit>
  decltype(auto) InItsForm(Visit visit) const {
    return std::visit(visit, forms_->given);
  }

  const Dense& dense() const {
    if (const auto* dense = std::get_if<Dense>(&forms_->given)) return *dense;
    std::call_once(forms_->dense_once,
                   [this] { forms_->dense = InItsForm([](const auto& given) { return DenseOf(given); }); });
    return *forms_->dense;
  }
  operator const Dense&() const { return dense(); }  // NOLINT: whatever takes a dense problem takes this one

  const Entries& entries() const {
    if (const auto* entries = std::get_if<Entries>(&forms_->given)) return *entries;
    std::call_once(forms_->entries_once,
                   [this] { forms_->entries = InItsForm([](const auto& given) { return EntriesOf(given); }); });
    return *forms_->entries;
  }

 private:
  struct Forms {
    explicit Forms(std::variant<Dense, Entries, Factored> as_given) : given(std::move(as_given)) {}

    const std::variant<Dense, Entries, Factored> given;
    std::once_flag dense_once, entries_once;
    std::optional<Dense> dense;
    std::optional<Entries> entries;
  };

  std::shared_ptr<Forms> forms_;
};

}  // namespace stiction

#endif  // STICTION_SOLVER_PROBLEM_ANY_PROBLEM_H_
