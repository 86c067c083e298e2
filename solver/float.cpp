// SPDX-License-Identifier: Apache-2.0
// Every method over float. A unit for each scalar: what methods share of Eigen is compiled once for it.

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

template class Reduction<float>;
template class PublishedAlgorithm<float>;
template class PublishedInSpace<float>;
template class CompleteDriving<float>;
template class LemkeAlgorithm<float>;
template class FastSolver<float>;
template class CoulombSolver<float>;
template class ProximalNewton<float>;

template <>
std::span<const Method<float>> Methods<float>() {
  return FloatingMethods<float>();
}
template Answer<float> Solve(const ContactProblem<float>&, const Request&);
template const Method<float>* FindMethod(std::string_view);
template void JudgeAnswer(const ContactProblem<float>&, double, Answer<float>&);

}  // namespace stiction
