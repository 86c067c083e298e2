// SPDX-License-Identifier: Apache-2.0
// Kernel: what tries the problems of a unit, with workspaces of the size of its problems.

#ifndef STICTION_SEARCH_UNITS_KERNEL_H_
#define STICTION_SEARCH_UNITS_KERNEL_H_

#include <cstdint>
#include <memory>

#include "search/campaign.h"

namespace stiction {

class Collector;
class Examiner;
struct UnitSolvers;

class Kernel {
 public:
  virtual ~Kernel() = default;
  virtual void Run(std::int64_t unit, const Task& task, Collector& collector, Examiner& examiner) = 0;
};

// Of problems like those of `task`. `campaign` and `solvers` must outlive it.
std::unique_ptr<Kernel> MakeKernel(const Campaign& campaign, const UnitSolvers& solvers, const Task& task);

}  // namespace stiction

#endif  // STICTION_SEARCH_UNITS_KERNEL_H_
