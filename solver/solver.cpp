// SPDX-License-Identifier: Apache-2.0
// The methods over floating-point scalars. Exact scalars are instantiated in certify.

#include "solver/complete.ipp"
#include "solver/fast.ipp"
#include "solver/lemke.ipp"
#include "solver/proximal.ipp"
#include "solver/published.ipp"

namespace stiction {

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

template class ProximalNewton<double>;
template class ProximalNewton<long double>;

}  // namespace stiction
