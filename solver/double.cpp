// SPDX-License-Identifier: Apache-2.0
// Every method over double. A unit for each scalar: what methods share of Eigen is compiled once for it.

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

template class Reduction<double>;
template class PublishedAlgorithm<double>;
template class PublishedInSpace<double>;
template class CompleteDriving<double>;
template class LemkeAlgorithm<double>;
template class FastSolver<double>;
template class CoulombSolver<double>;
template class CoulombSolver<double, SparseContactProblem<double>>;
template class ProximalNewton<double>;

template <>
std::span<const Method<double>> Methods<double>() {
  return FloatingMethods<double>();
}
template Answer<double> Solve(const ContactProblem<double>&, const Request&);
template const Method<double>* FindMethod(std::string_view);
template void JudgeAnswer(const ContactProblem<double>&, double, Answer<double>&);
template Answer<double> SolveBy(const Method<double>&, const ContactProblem<double>&, const Request&);

}  // namespace stiction
