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

using Rows = std::vector<MethodFacts>;

void Mark(MethodFacts& facts, int dimension, Arithmetic arithmetic, bool built) {
  facts.built[dimension - 2][static_cast<int>(arithmetic)] |= built;
}

// The methods, which are built in each of the arithmetics alike.
template <class Scalar>
void Add(std::span<const Method<Scalar>> methods, std::initializer_list<Arithmetic> arithmetics, Rows& rows) {
  for (const Method<Scalar>& method : methods) {
    auto row = std::ranges::find(rows, method.name, &MethodFacts::name);
    if (row == rows.end())
      row = rows.insert(
          row, {method.name, method.title, method.source, method.ends, method.path, method.heading, {}});
    for (const int dimension : {2, 3})
      for (const Arithmetic arithmetic : arithmetics)
        Mark(*row, dimension, arithmetic, method.IsBuilt(dimension));
  }
}

Rows MakeFacts() {
  Rows rows;
  Add(Methods<Rational>(), {kExact}, rows);
  for (MethodFacts& facts : rows)  // what is decided exactly can be told in floating-point numbers, too
    for (const Arithmetic told : {kFloat, kDouble, kQuad}) Mark(facts, 2, told, facts.IsBuilt(2, kExact));
  Add(Methods<double>(), {kFloat, kDouble, kQuad}, rows);
  Add(MethodsOverDoubles(), {kDouble}, rows);
  // What is run over balls is a rung of filtered runs, and the one of intervals.
  Add(Methods<Ball<double>>(), {kInterval, kFiltered}, rows);
  Add(Methods<Interval>(), {kInterval}, rows);
  // What the fast method ends in over doubles is certified (CertifyDoubles), in the plane.
  Mark(*std::ranges::find(rows, "fast", &MethodFacts::name), 2, kFiltered, true);
  return rows;
}

}  // namespace

const std::vector<MethodFacts>& AllMethods() {
  static const std::vector<MethodFacts> facts = MakeFacts();
  return facts;
}

const MethodFacts* FindMethodFacts(std::string_view name) {
  const auto& all = AllMethods();
  const auto row = std::ranges::find(all, name, &MethodFacts::name);
  return row == all.end() ? nullptr : &*row;
}

}  // namespace stiction
