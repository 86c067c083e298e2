// SPDX-License-Identifier: Apache-2.0
// StopReading: the exact arithmetic that reading a file may take ends when somebody says so.

#pragma once

#include <atomic>
#include <stdexcept>
#include <utility>

namespace stiction {

class ReadingStopped : public std::runtime_error {
 public:
  ReadingStopped() : std::runtime_error("stopped while the file was read") {}
};

// As long as it lives, what is read in this thread ends with ReadingStopped once the flag, which must outlive
// it, is set.
class StopReading {
 public:
  explicit StopReading(const std::atomic<bool>& flag) : before_(std::exchange(Flag(), &flag)) {}
  StopReading(const StopReading&) = delete;
  StopReading& operator=(const StopReading&) = delete;
  ~StopReading() { Flag() = before_; }

  // In a loop whose turns may take long.
  static void Check() {
    if (Flag() != nullptr && *Flag()) throw ReadingStopped();
  }

 private:
  static const std::atomic<bool>*& Flag() {
    thread_local const std::atomic<bool>* flag = nullptr;
    return flag;
  }

  const std::atomic<bool>* before_;
};

}  // namespace stiction
