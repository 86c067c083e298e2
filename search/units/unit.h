// SPDX-License-Identifier: Apache-2.0
// Unit: a fixed number of problems of one generator and size, tried one after the other.
//
// Each problem is solved over doubles, under every policy of the campaign. Whatever does not end in a
// verified `solved` there is only a suspicion: the same choices then give the exact problem, which is run with
// certified signs (certify/exact/filtered.h), or over rationals where these leave a sign open, and both
// verdicts are counted. What is not solved then is a finding, and complete driving must solve it: by certified
// signs, with a solution that is verified over rationals. What is audited, and one suspicion in
// `complete_every`, is run over rationals throughout, and by other methods, which must agree
// (certify/claims/agreement.h). A campaign may ask for certified signs, or rationals, from the start. In space,
// where the published algorithm takes square roots, intervals stand for exact numbers: what they prove is
// exact, otherwise they say `undecided`. Nothing but (campaign, unit number) decides what comes out. In the
// plane the path of a problem that raises no suspicion allocates nothing.

#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "search/campaign.h"
#include "search/lanes/instructions.h"
#include "search/units/exact_methods.h"

namespace stiction {

class Kernel;  // unit.cpp

struct UnitResult {
  std::int64_t problems = 0;
  Record record;
  std::vector<Finding>
      candidates;      // first of each signature, at most representatives_per_unit beside the grave ones
  std::string elites;  // of a campaign with an objective: adversary/optimized_unit.h
  ProcessorTime time;  // that this run of it took
};

// What a unit solves with; a search leaves it as it is.
struct UnitSolvers {
  ExactMethods exact = {};
  // Changes what a run over doubles says, and its forces; not called where it is empty.
  std::function<void(Verdict&, std::span<double> f)> distort = {};
  // What problems of two contacts are batched with. Results do not depend on it.
  InstructionSet lanes = BestInstructionSet();
};

// Keeps its workspaces between units. One per thread.
class UnitRunner {
 public:
  explicit UnitRunner(const Campaign& campaign, const UnitSolvers& solvers = {});
  ~UnitRunner();
  UnitRunner(const UnitRunner&) = delete;
  UnitRunner& operator=(const UnitRunner&) = delete;

  UnitResult Run(std::int64_t unit);

 private:
  Campaign campaign_;
  UnitSolvers solvers_;
  std::vector<Task> schedule_;
  std::map<std::tuple<int, int, bool>, std::unique_ptr<Kernel>> kernels_;  // contacts, dimension, other kinds
};

}  // namespace stiction
