// SPDX-License-Identifier: Apache-2.0
// Many problems of the same contacts at once, on several threads, for the Python package.

#ifndef STICTION_PYTHON_MANY_H_
#define STICTION_PYTHON_MANY_H_

#include <pybind11/numpy.h>

#include "certify/exact/solve.h"

namespace stiction {

// Of finite doubles: A is n x rows x rows, b n x rows, mu n x contacts, of any strides. `like`: a problem of
// the same contacts but for mu, of which none slides. Each is solved as SolveIn does; columns by name:
// `outcome`, a number of `outcomes`; f and a, n x rows, NaN where there are none; start, period; counters, by
// name; `seconds`, of processor time of the calls alone, all threads together. InputError of the first that is
// refused.
pybind11::dict SolveMany(const ExactProblem& like, const pybind11::array_t<double, 0>& A,
                         const pybind11::array_t<double, 0>& b, const pybind11::array_t<double, 0>& mu,
                         Request request, int threads);

}  // namespace stiction

#endif  // STICTION_PYTHON_MANY_H_
