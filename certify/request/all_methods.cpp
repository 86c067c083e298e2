// SPDX-License-Identifier: Apache-2.0
// The tables of methods as one: which are built, in which dimension and arithmetic.

#include <algorithm>
#include <initializer_list>

#include "certify/exact/filtered.h"
#include "certify/exact/interval.h"
#include "certify/request/solve_in.h"

namespace stiction {
namespace {

using enum Arithmetic;

class FactsList {
 public:
  // The methods, which are built in each of the arithmetics alike.
  template <class Scalar>
  void Add(std::span<const Method<Scalar>> methods, std::initializer_list<Arithmetic> arithmetics) {
    for (const Method<Scalar>& method : methods) {
      MethodFacts& facts = RowOf(method);
      for (const int dimension : {2, 3}) {
        for (const Arithmetic arithmetic : arithmetics)
          Mark(facts, dimension, arithmetic, method.IsBuilt(dimension));
      }
    }
  }

  // What is decided exactly can be told in floating-point numbers, too.
  void AddToldExactly() {
    for (MethodFacts& facts : rows_) {
      for (const Arithmetic told : {kFloat, kDouble, kQuad}) Mark(facts, 2, told, facts.IsBuilt(2, kExact));
    }
  }

  // What the method ends in over doubles is certified (CertifyDoubles), in the plane.
  void AddCertified(std::string_view name) {
    for (MethodFacts& facts : rows_) {
      if (facts.name == name) Mark(facts, 2, kFiltered, true);
    }
  }

  std::vector<MethodFacts> Take() { return std::move(rows_); }

 private:
  static void Mark(MethodFacts& facts, int dimension, Arithmetic arithmetic, bool built) {
    facts.built[dimension - 2][static_cast<int>(arithmetic)] |= built;
  }

  template <class Scalar>
  MethodFacts& RowOf(const Method<Scalar>& method) {
    const auto known = std::find_if(rows_.begin(), rows_.end(), [&](auto& m) { return m.name == method.name; });
    if (known != rows_.end()) return *known;
    return rows_.emplace_back(
        MethodFacts{method.name, method.title, method.source, method.ends, method.path, method.heading, {}});
  }

  std::vector<MethodFacts> rows_;
};

std::vector<MethodFacts> MakeFacts() {
  FactsList list;
  list.Add(Methods<Rational>(), {kExact});
  list.AddToldExactly();
  list.Add(Methods<double>(), {kFloat, kDouble, kQuad});
  list.Add(MethodsOverDoubles(), {kDouble});
  // What is run over balls is a rung of filtered runs, and the one of intervals.
  list.Add(Methods<Ball<double>>(), {kInterval, kFiltered});
  list.Add(Methods<Interval>(), {kInterval});
  list.AddCertified("fast");
  return list.Take();
}

}  // namespace

const std::vector<MethodFacts>& AllMethods() {
  static const std::vector<MethodFacts> facts = MakeFacts();
  return facts;
}

const MethodFacts* FindMethodFacts(std::string_view name) {
  const auto& all = AllMethods();
  const auto row = std::find_if(all.begin(), all.end(), [name](auto& m) { return m.name == name; });
  return row == all.end() ? nullptr : &*row;
}

}  // namespace stiction
