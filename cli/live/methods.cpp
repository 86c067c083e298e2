// SPDX-License-Identifier: Apache-2.0
// The methods of a page: of certify/exact/methods.cpp those that have a path; over floating-point numbers, in
// space, the published algorithm, which takes roots.

#include <array>

#include "certify/exact/polygons.h"
#include "certify/exact/solve.h"
#include "solver/floating_methods.ipp"
#include "solver/problem/reduction.ipp"
#include "solver/published/published_space.ipp"

namespace stiction {
namespace {

template <SpaceEngine kEngine>
Answer<Rational> RunOnPolygons(const ExactProblem& problem, const Request& request) {
  return SolveWeakly(problem, request, kEngine);
}

}  // namespace

template <>
std::span<const Method<Rational>> Methods<Rational>() {
  static const std::array rows = {CompleteRow<Rational>({&RunOnPolygons<SpaceEngine::kComplete>, true}),
                                  LemkeRow<Rational>({&RunOnPolygons<SpaceEngine::kLemke>, true}),
                                  BaraffRow<Rational>({})};
  return rows;
}
template <>
std::span<const Method<double>> Methods<double>() {
  static const std::array rows = {BaraffRow<double>({&RunBaraffInSpace<double>}, {})};
  return rows;
}

template Answer<Rational> Solve(const ExactProblem&, const Request&);
template const Method<Rational>* FindMethod(std::string_view);
template Answer<double> Solve(const ContactProblem<double>&, const Request&);
template Answer<double> SolveBy(const Method<double>&, const ContactProblem<double>&, const Request&);
template void JudgeAnswer(const ContactProblem<double>&, double, Answer<double>&);
template class Reduction<double>;
template class PublishedInSpace<double>;

}  // namespace stiction
