// SPDX-License-Identifier: Apache-2.0
#include "bench/peak.h"

#include <algorithm>
#include <cstdint>

#include "corpus/stopwatch.h"

namespace stiction {
namespace {

constexpr int kChains = 12;    // that do not wait for each other
constexpr int kBuffer = 1024;  // doubles, of which there are two
alignas(64) double from[kBuffer], to[kBuffer];

struct Loops {
  int lanes;
  double (*operations)(std::int64_t rounds);
  double (*quotients)(std::int64_t rounds);
  void (*bytes)(std::int64_t rounds);
};

// The loops in vectors of so many bytes, for a target.
#define STICTION_PEAK_LOOPS(Name, kBytes, kTarget)                          \
  namespace Name {                                                          \
  using Vector = double __attribute__((vector_size(kBytes)));               \
  kTarget double Operations(std::int64_t rounds) {                          \
    Vector x[kChains];                                                      \
    for (int i = 0; i < kChains; ++i) x[i] = Vector{} + (1.0 + i);          \
    for (std::int64_t round = 0; round < rounds; ++round) {                 \
      for (int i = 0; i < kChains; ++i) x[i] = x[i] * (Vector{} + 0.75);    \
      for (int i = 0; i < kChains; ++i) x[i] = x[i] + (Vector{} + 0.5);     \
    }                                                                       \
    double sum = 0;                                                         \
    for (int i = 0; i < kChains; ++i) sum += x[i][0];                       \
    return sum;                                                             \
  }                                                                         \
  kTarget double Quotients(std::int64_t rounds) {                           \
    Vector x[kChains];                                                      \
    for (int i = 0; i < kChains; ++i) x[i] = Vector{} + (1.0 + i);          \
    for (std::int64_t round = 0; round < rounds; ++round)                   \
      for (int i = 0; i < kChains; ++i) x[i] = (Vector{} + 3.0) / x[i];     \
    double sum = 0;                                                         \
    for (int i = 0; i < kChains; ++i) sum += x[i][0];                       \
    return sum;                                                             \
  }                                                                         \
  kTarget void Bytes(std::int64_t rounds) {                                 \
    const auto* source = reinterpret_cast<const Vector*>(from);             \
    auto* target = reinterpret_cast<Vector*>(to);                           \
    for (std::int64_t round = 0; round < rounds; ++round) {                 \
      for (int i = 0; i < kBuffer * 8 / kBytes; ++i) target[i] = source[i]; \
      asm volatile("" ::: "memory");                                        \
    }                                                                       \
  }                                                                         \
  constexpr Loops kLoops = {kBytes / 8, Operations, Quotients, Bytes};      \
  }

#if defined(__x86_64__)
STICTION_PEAK_LOOPS(baseline, 16, )
STICTION_PEAK_LOOPS(avx2, 32, __attribute__((target("avx2"))))
STICTION_PEAK_LOOPS(avx512, 64, __attribute__((target("avx512f,avx512dq,avx512vl"))))
#else
STICTION_PEAK_LOOPS(baseline, 16, )
namespace avx2 = baseline;
namespace avx512 = baseline;
#endif

Loops LoopsOf(InstructionSet set) {
  return set == InstructionSet::kAvx512 ? avx512::kLoops
         : set == InstructionSet::kAvx2 ? avx2::kLoops
                                        : baseline::kLoops;
}

template <class Run>
double LeastSeconds(Run run) {
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 9; ++k) {
    const Stopwatch watch;
    run();
    least = std::min(least, watch.Seconds());
  }
  return least;
}

}  // namespace

Peak MeasurePeak(InstructionSet set) {
  constexpr std::int64_t kRounds = 200'000;
  const Loops loops = LoopsOf(set);
  const double numbers = static_cast<double>(kRounds) * kChains * loops.lanes;
  volatile double kept = 0;
  Peak peak;
  peak.operations = 2 * numbers / LeastSeconds([&] { kept = loops.operations(kRounds); });
  peak.quotients = numbers / LeastSeconds([&] { kept = loops.quotients(kRounds); });
  peak.bytes = 16.0 * kBuffer * 20'000 / LeastSeconds([&] { loops.bytes(20'000); });
  (void)kept;
  return peak;
}

}  // namespace stiction
