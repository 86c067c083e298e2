// SPDX-License-Identifier: Apache-2.0
// StopAfter: a flag that is set when the time is up; for Limits::stop.

#ifndef STICTION_CLI_STOP_AFTER_H_
#define STICTION_CLI_STOP_AFTER_H_

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace stiction {

class StopAfter {
 public:
  // Zero or less: never.
  explicit StopAfter(double seconds) {
    if (seconds > 0) timer_ = std::jthread([this, seconds](const std::stop_token& end) { Wait(end, seconds); });
  }

  const std::atomic<bool>* flag() const { return &stopped_; }

 private:
  void Wait(const std::stop_token& end, double seconds) {
    std::mutex mutex;
    std::unique_lock lock(mutex);
    const bool ended = std::condition_variable_any().wait_for(lock, end, std::chrono::duration<double>(seconds),
                                                              [&end] { return end.stop_requested(); });
    if (!ended) stopped_ = true;
  }

  std::atomic<bool> stopped_ = false;
  std::jthread timer_;  // last: it ends before the flag does
};

}  // namespace stiction

#endif  // STICTION_CLI_STOP_AFTER_H_
