// SPDX-License-Identifier: Apache-2.0
// Parts of the Python package that stand in sources of their own.

#pragma once

#include <pybind11/numpy.h>

#include "certify/exact/solve.h"

namespace stiction {

// Many problems of the same contacts at once, on several threads. Of finite doubles: A is n x rows x rows, b n
// x rows, mu n x contacts, of any strides. `like`: a problem of the same contacts but for mu, of which none
// slides. Each is solved as SolveIn does; columns by name: `outcome`, a number of `outcomes`; f and a, n x
// rows, NaN where there are none; start, period; counters, by name; `seconds`, of processor time of the calls
// alone, all threads together. InputError of the first that is refused.
pybind11::dict SolveMany(const ExactProblem& like, const pybind11::array_t<double, 0>& A,
                         const pybind11::array_t<double, 0>& b, const pybind11::array_t<double, 0>& mu,
                         Request request, int threads);

// search(campaign, store, problems, minutes, threads, finishing), and the class Store.
void AddSearch(pybind11::module_& module);

// simulate and simulation_page(text, source, seconds, step, rest, full), and assemble(text, source, level,
// factors, full), of a scene file's text.
void AddSimulate(pybind11::module_& module);

}  // namespace stiction
