// SPDX-License-Identifier: Apache-2.0
// Simulations, for the Python package.

#ifndef STICTION_PYTHON_SIMULATE_H_
#define STICTION_PYTHON_SIMULATE_H_

#include <pybind11/pybind11.h>

namespace stiction {

// simulate and simulation_page(text, source, seconds, step, rest, full), and assemble(text, source, level,
// factors, full), of a scene file's text.
void AddSimulate(pybind11::module_& module);

}  // namespace stiction

#endif  // STICTION_PYTHON_SIMULATE_H_
