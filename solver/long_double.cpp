// SPDX-License-Identifier: Apache-2.0
// Every method over long double. A unit for each scalar: what methods share of Eigen is compiled once for it.

#include "solver/complete/complete.ipp"
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

}  // namespace stiction
