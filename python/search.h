// SPDX-License-Identifier: Apache-2.0
// Campaigns and stores, for the Python package.

#ifndef STICTION_PYTHON_SEARCH_H_
#define STICTION_PYTHON_SEARCH_H_

#include <pybind11/pybind11.h>

namespace stiction {

// search(campaign, store, problems, minutes, threads, finishing), and the class Store.
void AddSearch(pybind11::module_& module);

}  // namespace stiction

#endif  // STICTION_PYTHON_SEARCH_H_
