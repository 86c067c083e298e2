// SPDX-License-Identifier: Apache-2.0
// Time that other programs do not lengthen: the less of wall-clock and processor time. Where other threads or
// processes do the work, Stopwatch(CLOCK_MONOTONIC) is wall-clock time alone. Never negative: a clock that is
// set, as that of a virtual machine may be, can step back.

#pragma once

#include <time.h>

#include <algorithm>
#include <limits>

namespace stiction {

// Infinite if the clock cannot be read: that of a process that is gone.
inline double ReadSeconds(clockid_t clock) {
  timespec time;
  if (clock_gettime(clock, &time) != 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The processor clock is slow to read, and stands outside the other.
class Stopwatch {
 public:
  explicit Stopwatch(clockid_t processor = CLOCK_THREAD_CPUTIME_ID)
      : processor_(processor), processor_start_(ReadSeconds(processor)), start_(ReadSeconds(CLOCK_MONOTONIC)) {}

  double Seconds() const {
    const double elapsed = ReadSeconds(CLOCK_MONOTONIC) - start_;
    return std::max(0.0, std::min(elapsed, ReadSeconds(processor_) - processor_start_));
  }

 private:
  clockid_t processor_;
  double processor_start_, start_;
};

}  // namespace stiction
