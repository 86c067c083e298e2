// SPDX-License-Identifier: Apache-2.0
// Vectors of doubles, one to a lane, in the instruction set that the including file is compiled for. Everything
// here is local to that file.

#pragma once

#include <immintrin.h>

#include <cstdint>

namespace stiction {
namespace {

#if defined(__AVX512DQ__) && defined(__AVX512VL__)
constexpr int kLanes = 8;
#else
constexpr int kLanes = 4;
#endif

using Real = double __attribute__((vector_size(8 * kLanes)));
using Word = std::uint64_t __attribute__((vector_size(8 * kLanes)));
using Mask = decltype(Real{} < Real{});  // all bits of a lane, or none

inline Real All(double x) { return x - Real{}; }
inline Word AllWords(std::uint64_t x) { return x - Word{}; }
inline Mask Never() { return Mask{}; }
inline Real Select(Mask m, Real x, Real y) { return m ? x : y; }
inline Real Abs(Real x) { return (Real)((Word)x & AllWords(0x7fffffffffffffffu)); }
inline Real Max(Real x, Real y) { return Select(x < y, y, x); }  // as std::max and std::min
inline Real Min(Real x, Real y) { return Select(y < x, y, x); }

inline Real Load(const double* from) {
  Real x;
  __builtin_memcpy(&x, from, sizeof x);
  return x;
}
inline void Store(Real x, double* to) { __builtin_memcpy(to, &x, sizeof x); }

// Bit i: lane i.
inline unsigned BitsOf(Mask m) {
#if defined(__AVX512DQ__) && defined(__AVX512VL__)
  return _mm512_movepi64_mask((__m512i)m);
#else
  return static_cast<unsigned>(_mm256_movemask_pd((__m256d)m));
#endif
}
inline bool Any(Mask m) { return BitsOf(m) != 0; }

constexpr unsigned kEveryLane = (1u << kLanes) - 1;

}  // namespace
}  // namespace stiction
