// SPDX-License-Identifier: Apache-2.0
#include "search/lanes/batch.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "solver/problem/check.h"

namespace stiction {
namespace {

// A batched run is far from both: otherwise what a limit stops would have to be told in lanes.
constexpr std::int64_t kLeastLimit = 1000;

const LaneCodes* CodesOf(InstructionSet set) {
  switch (set) {
    case InstructionSet::kNone:
      break;
#ifdef STICTION_LANES
    case InstructionSet::kAvx2:
      return &kAvx2Lanes;
    case InstructionSet::kAvx512:
      return &kAvx512Lanes;
#else
    default:
      break;
#endif
  }
  STICTION_CHECK(false, "a batch has an instruction set");
  return nullptr;
}

template <int Rows>
LaneCode<Rows> CodeOf(InstructionSet set) {
  const LaneCodes& codes = *CodesOf(set);
  if constexpr (Rows == 4) {
    return codes.two_contacts;
  } else if constexpr (Rows == 6) {
    return codes.three_contacts;
  } else {
    return codes.four_contacts;
  }
}

std::optional<LaneFamily> FamilyOf(GeneratorId id) {
  switch (id) {
    case GeneratorId::kIntegers:
      return LaneFamily::kIntegers;
    case GeneratorId::kPsd:
      return LaneFamily::kPsd;
    case GeneratorId::kSmall:
      return LaneFamily::kSmall;
    default:
      return std::nullopt;
  }
}

// As MakeScale: a tolerance below the rounding of doubles would only hide that it is too small.
double Tolerance(double asked) { return std::max(asked, 8 * std::numeric_limits<double>::epsilon()); }

}  // namespace

std::string_view Name(InstructionSet set) {
  constexpr std::array<std::string_view, 3> kNames = {"none", "AVX2", "AVX-512"};
  return kNames[static_cast<std::size_t>(set)];
}

std::vector<InstructionSet> InstructionSets() {
  std::vector<InstructionSet> sets = {InstructionSet::kNone};
#ifdef STICTION_LANES
  if (__builtin_cpu_supports("avx2")) sets.push_back(InstructionSet::kAvx2);
  if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    sets.push_back(InstructionSet::kAvx512);
#endif
  return sets;
}

bool IsBatched(const Request& request) {
  return request.policy == Policy{} && request.limits.stop == nullptr && request.limits.drives >= kLeastLimit &&
         request.limits.pivots >= kLeastLimit;
}

bool IsDrawnInLanes(GeneratorId id) { return FamilyOf(id).has_value(); }

template <int Rows>
Batch<Rows>::Batch(InstructionSet set, const Request& request)
    : code_(CodeOf<Rows>(set)),
      tolerances_{Tolerance(request.tolerances.acceleration), Tolerance(request.tolerances.force),
                  Tolerance(request.tolerances.pivot)},
      block_{} {
  STICTION_CHECK(IsBatched(request), "a request that can be batched");
}

template <int Rows>
void Batch<Rows>::Put(int i, const Problem& problem, const Drawn& drawn) {
  block_.friction[i] = drawn.friction;
  block_.columns[i] = drawn.rank;
  for (int row = 0; row < Rows; ++row) {
    block_.b[row][i] = problem.b[row];
    for (int j = 0; j < Rows; ++j) block_.A[row][j][i] = problem.A(row, j);
  }
  for (int contact = 0; contact < Rows / 2; ++contact) block_.mu[contact][i] = problem.contacts[contact].mu;
}

template <int Rows>
void Batch<Rows>::Get(int i, Problem& problem) const {
  problem.dimension = 2;
  for (int row = 0; row < Rows; ++row) {
    problem.b[row] = block_.b[row][i];
    for (int j = 0; j < Rows; ++j) problem.A(row, j) = block_.A[row][j][i];
  }
  for (int contact = 0; contact < Rows / 2; ++contact) {
    problem.contacts[contact] = {};
    problem.contacts[contact].mu = block_.mu[contact][i];
  }
}

template <int Rows>
void Batch<Rows>::Draw(GeneratorId id, std::span<const MuChoice> palette, std::uint64_t seed,
                       std::uint64_t unit, std::int64_t first, int count) {
  const auto family = FamilyOf(id);
  STICTION_CHECK(family.has_value(), "a generator that lanes can draw");
  if (mu_.empty()) {
    for (const MuChoice& mu : palette)
      mu_.push_back(static_cast<double>(mu.numerator) / static_cast<double>(mu.denominator));
  }
  code_.draw(block_, {*family, UnitSeed(seed, unit), kSeedStep, first, count, mu_.data(), mu_.size()});
}

template <int Rows>
void Batch<Rows>::Run(int count) {
  code_.run(block_, count, tolerances_);
}

template <int Rows>
Verdict Batch<Rows>::VerdictOf(int i) const {
  const LaneEnd& end = block_.ends[i];
  Verdict verdict;
  verdict.outcome = Outcome::kSolved;
  Statistics& s = verdict.statistics;
  s.drives = end.drives;
  s.steps = s.pivots = end.steps;
  s.zero_steps = end.zero_steps;
  s.longest_zero_run = end.longest_zero_run;
  s.singular_directions = end.singular_directions;
  s.outer_scans = end.drives + 1;
  return verdict;
}

template class Batch<4>;
template class Batch<6>;
template class Batch<8>;

}  // namespace stiction
