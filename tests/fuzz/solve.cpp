// SPDX-License-Identifier: Apache-2.0
// Every method in every arithmetic on problems at extremes.

#include <fmt/format.h>

#include <algorithm>

#include "certify/exact/hypothesis.h"
#include "certify/exact/properties.h"
#include "certify/request/request.h"
#include "solver/problem/check.h"
#include "tests/fuzz/extreme.h"
#include "tests/fuzz/targets.h"
#include "tests/judge.h"

namespace stiction::fuzz {
namespace {

constexpr Limits kLimits = {.drives = 100, .pivots = 200, .bits = 20000};

struct Combination {
  std::string_view method;
  Arithmetic arithmetic;
};

// Ipopt is a process of its own, each run another.
bool IsProcess(const Combination& c) {
  return c.method == "ipopt" || (c.method == "qp" && c.arithmetic == Arithmetic::kDouble);
}

std::vector<Combination> CombinationsIn(int dimension) {
  std::vector<Combination> all;
  for (int a = 0; a < kArithmeticCount; ++a) {
    const auto arithmetic = static_cast<Arithmetic>(a);
    if (Refusal(kAutomatic, dimension, arithmetic).empty()) all.push_back({kAutomatic, arithmetic});
    for (const MethodFacts& facts : AllMethods()) {
      const Combination c = {facts.name, arithmetic};
      if (facts.IsBuilt(dimension, arithmetic) && !IsProcess(c)) all.push_back(c);
    }
  }
  return all;
}

Request SomeOptions(Bytes& bytes) {
  Request options;
  options.limits = kLimits;
  const int policy = bytes.Integer(0, static_cast<int>(PlanarGrid().size()) - 1);
  if (policy > 0) options.policy = PlanarGrid()[static_cast<std::size_t>(policy)];
  if (bytes.Integer(0, 1) == 1) options.policy.slip = Slip::kRedirect;
  if (bytes.Integer(0, 1) == 1) options.law = FrictionLaw::kCoulomb;
  options.sides = 8 + 4 * bytes.Integer(-1, 1);
  return options;
}

// What is proved: these end in a solution wherever the paper's assumptions hold and nothing slides.
void RequireTheorem(const ExactProblem& problem, const Combination& c, const Solution& solution) {
  const bool finite = c.method == "complete" || c.method == "lemke" || c.method == "enumerate";
  if (!finite || c.arithmetic != Arithmetic::kExact || problem.dimension != 2) return;
  const Outcome outcome = solution.outcome();
  if (outcome == Outcome::kSolved || outcome == Outcome::kLimit) return;
  STICTION_CHECK(HasSlidingContact(problem) || !MeetsAssumptions(problem),
                 fmt::format("{} ends in {} where a solution is certain", c.method, Name(outcome)));
}

bool TakesProblem(const ExactProblem& problem, const Request& options, const Combination& c) {
  Request request = options;
  request.method = c.method;
  request.arithmetic = c.arithmetic;
  const auto solution = Unrefused([&] { return SolveIn(problem, request); });
  if (!solution) return false;  // out of range, or a kind or reading that the method does not have
  const std::string fault = testing::FaultOf(problem, request, *solution);
  STICTION_CHECK(fault.empty(), fmt::format("{} over {}: {}", c.method, Name(c.arithmetic), fault));
  RequireTheorem(problem, c, *solution);
  return true;
}

}  // namespace

// The first byte: zero is all combinations.
bool FuzzSolve(std::string_view input) {
  Bytes bytes(input);
  const int choice = bytes.Integer(0, 255);
  const Request options = SomeOptions(bytes);
  const ExactProblem problem = ExtremeProblem(bytes);
  const std::vector<Combination> all = CombinationsIn(problem.dimension);
  if (choice != 0) return TakesProblem(problem, options, all[static_cast<std::size_t>(choice) % all.size()]);
  bool taken = false;
  for (const Combination& c : all) taken |= TakesProblem(problem, options, c);
  return taken;
}

}  // namespace stiction::fuzz
