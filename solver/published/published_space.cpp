// SPDX-License-Identifier: Apache-2.0
// The published algorithm in space over floating-point scalars. Intervals are instantiated in certify.

#include "solver/published/published_space.ipp"

namespace stiction {

template class PublishedInSpace<float>;
template class PublishedInSpace<double>;
template class PublishedInSpace<long double>;

}  // namespace stiction
