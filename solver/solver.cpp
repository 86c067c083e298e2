// SPDX-License-Identifier: Apache-2.0
// The published algorithm over floating-point scalars. Exact scalars are instantiated in certify.

#include "solver/published.ipp"

namespace stiction {

template class PublishedAlgorithm<float>;
template class PublishedAlgorithm<double>;
template class PublishedAlgorithm<long double>;

}  // namespace stiction
