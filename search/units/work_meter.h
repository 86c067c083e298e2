// SPDX-License-Identifier: Apache-2.0
// What a thread spends the processor time of a unit on.
//
// The processor clock of a thread is slow to read, so it is read twice, and the parts between are measured on
// the wall clock and scaled to it: time in which the thread did not run is spread over all parts.

#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "corpus/record/work.h"
#include "corpus/stopwatch.h"

namespace stiction {

class WorkMeter {
 public:
  using Part = std::int64_t ProcessorTime::*;

  // From now on time counts as `part`. Returns what it counted as before.
  Part Switch(Part part) {
    const std::int64_t now = Now();
    elapsed_.*part_ += std::max<std::int64_t>(0, now - last_);  // a clock may be set back
    last_ = now;
    return std::exchange(part_, part);
  }
  // Nanoseconds that were sampled of the part that counts now belong to another.
  void Attribute(Part part, std::int64_t nanoseconds) {
    Switch(part_);
    const std::int64_t moved = std::clamp<std::int64_t>(nanoseconds, 0, elapsed_.*part_);
    elapsed_.*part_ -= moved;
    elapsed_.*part += moved;
  }
  // Since the meter was made, in processor time.
  ProcessorTime Read() {
    Switch(part_);
    const double wall = static_cast<double>(elapsed_.Total());
    const double processor = std::max(0.0, ReadSeconds(CLOCK_THREAD_CPUTIME_ID) - processor_start_);
    const double scale = wall > 0 ? 1e6 * processor / wall : 0;
    ProcessorTime time = elapsed_;
    ForEachPart(time, [scale](const char*, const char*, std::int64_t& value) {
      value = static_cast<std::int64_t>(scale * static_cast<double>(value));
    });
    return time;
  }

  static std::int64_t Now() {
    timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
  }

 private:
  Part part_ = &ProcessorTime::doubles;
  double processor_start_ = ReadSeconds(CLOCK_THREAD_CPUTIME_ID);
  std::int64_t last_ = Now();
  ProcessorTime elapsed_;  // nanoseconds of the wall clock
};

// While it lives, time counts as `part`.
class Spending {
 public:
  Spending(WorkMeter& meter, WorkMeter::Part part) : meter_(meter), before_(meter.Switch(part)) {}
  Spending(const Spending&) = delete;
  Spending& operator=(const Spending&) = delete;
  ~Spending() { meter_.Switch(before_); }

 private:
  WorkMeter& meter_;
  WorkMeter::Part before_;
};

// Draws are quicker than a clock can tell of each: one in so many is measured, less what the clock itself
// takes.
class SampledDraws {
 public:
  static constexpr std::int64_t kOneIn = 64;

  template <class Draw>
  void operator()(std::int64_t index, Draw draw) {
    if (index % kOneIn != 0) return draw();
    const std::int64_t before = WorkMeter::Now(), start = WorkMeter::Now();
    draw();
    const std::int64_t end = WorkMeter::Now();
    sampled_ += std::max<std::int64_t>(0, end - start - (start - before));
    ++samples_;
  }
  // Of so many draws.
  std::int64_t Nanoseconds(std::int64_t draws) const { return samples_ == 0 ? 0 : sampled_ * draws / samples_; }

 private:
  std::int64_t sampled_ = 0, samples_ = 0;
};

}  // namespace stiction
