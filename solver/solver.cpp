// SPDX-License-Identifier: Apache-2.0
// The methods over floating-point scalars. Exact scalars are instantiated in certify.

#include "solver/complete/complete.ipp"
#include "solver/lemke/lemke.ipp"
#include "solver/numeric/fast.ipp"
#include "solver/numeric/proximal.ipp"
#include "solver/problem/reduction.ipp"
#include "solver/published/published.ipp"

namespace stiction {

template class Reduction<float>;
template class Reduction<double>;
template class Reduction<long double>;

template class PublishedAlgorithm<float>;
template class PublishedAlgorithm<double>;
template class PublishedAlgorithm<long double>;

template class CompleteDriving<float>;
template class CompleteDriving<double>;
template class CompleteDriving<long double>;

template class FastSolver<float>;
template class FastSolver<double>;
template class FastSolver<long double>;

template class LemkeAlgorithm<float>;
template class LemkeAlgorithm<double>;
template class LemkeAlgorithm<long double>;

template class ProximalNewton<float>;
template class ProximalNewton<double>;
template class ProximalNewton<long double>;

}  // namespace stiction
