// SPDX-License-Identifier: Apache-2.0
// Every method over long double. A unit for each scalar: what methods share of Eigen is compiled once for it.

#include "solver/complete/complete.ipp"
#include "solver/floating_methods.ipp"
#include "solver/lemke/lemke.ipp"
#include "solver/numeric/coulomb.ipp"
#include "solver/numeric/fast.ipp"
#include "solver/numeric/proximal.ipp"
#include "solver/problem/reduction.ipp"
#include "solver/published/published.ipp"
#include "solver/published/published_space.ipp"

namespace stiction {

template class Reduction<long double>;
template class PublishedAlgorithm<long double>;
template class PublishedInSpace<long double>;
template class CompleteDriving<long double>;
template class LemkeAlgorithm<long double>;
template class FastSolver<long double>;
template class CoulombSolver<long double>;
template class ProximalNewton<long double>;

template <>
std::span<const Method<long double>> Methods<long double>() {
  return FloatingMethods<long double>();
}
template Answer<long double> Solve(const ContactProblem<long double>&, std::string_view, const SolveOptions&,
                                   Trace<long double>*);
template const Method<long double>* FindMethod(std::string_view);
template void JudgeAnswer(const ContactProblem<long double>&, double, Answer<long double>&);

}  // namespace stiction
