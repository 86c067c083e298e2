// SPDX-License-Identifier: Apache-2.0
#include "search/units/unit.h"

#include <map>
#include <tuple>

#include "search/units/examiner.h"
#include "search/units/kernel.h"

namespace stiction {

struct UnitRunner::Implementation {
  Implementation(const Campaign& c, const UnitSolvers& s) : campaign(c), solvers(s), schedule(Schedule(c)) {}

  Campaign campaign;
  UnitSolvers solvers;
  std::vector<Task> schedule;
  std::map<std::tuple<int, int, bool>, std::unique_ptr<Kernel>> kernels;  // contacts, dimension, other kinds
};

UnitRunner::UnitRunner(const Campaign& campaign, const UnitSolvers& solvers)
    : implementation_(std::make_unique<Implementation>(campaign, solvers)) {}
UnitRunner::~UnitRunner() = default;

UnitResult UnitRunner::Run(std::int64_t unit) {
  Implementation& self = *implementation_;
  const Task task = TaskOf(self.schedule, unit);
  const GeneratorRow& row = Row(task.generator);
  std::unique_ptr<Kernel>& kernel = self.kernels[{task.contacts, row.dimension, row.HasOtherKinds()}];
  if (kernel == nullptr) kernel = MakeKernel(self.campaign, self.solvers, task);
  Collector collector(self.campaign, task, unit);
  Examiner examiner(collector, self.solvers.exact);
  kernel->Run(unit, task, collector, examiner);
  return collector.Take();
}

}  // namespace stiction
