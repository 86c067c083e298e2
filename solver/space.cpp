// SPDX-License-Identifier: Apache-2.0
// The methods in space over floating-point scalars. Exact scalars are instantiated in certify.

#include "solver/numeric/coulomb.ipp"

namespace stiction {

template class CoulombSolver<float>;
template class CoulombSolver<double>;
template class CoulombSolver<long double>;
template class CoulombSolver<double, SparseContactProblem<double>>;

}  // namespace stiction
