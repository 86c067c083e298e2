// SPDX-License-Identifier: Apache-2.0
// A loop over several threads: TBB's. How its library hands work from thread to thread the thread sanitizer
// does not see, as it instruments our code only; there the loop is one over threads of our own.

#pragma once

#include <cstddef>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define STICTION_OWN_THREADS
#endif
#elif defined(__SANITIZE_THREAD__)
#define STICTION_OWN_THREADS
#endif

#ifdef STICTION_OWN_THREADS
#include <array>
#include <atomic>
#include <thread>
#else
#include <tbb/parallel_for.h>
#endif

namespace stiction {

// body(i) for 0 <= i < count, in any order, some at the same time.
template <class Body>
void ForEachInParallel(std::size_t count, const Body& body) {
#ifdef STICTION_OWN_THREADS
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) body(i);
  };
  const std::array<std::jthread, 2> threads = {std::jthread(work), std::jthread(work)};
#else
  tbb::parallel_for(std::size_t{0}, count, body);
#endif
}

}  // namespace stiction

#undef STICTION_OWN_THREADS
