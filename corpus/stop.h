// SPDX-License-Identifier: Apache-2.0
// Stop: exact arithmetic that may take long ends when somebody says so.

#pragma once

#include <atomic>
#include <stdexcept>
#include <utility>

namespace stiction {

class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("stopped") {}
};

// As long as it lives, exact arithmetic in this thread ends with Stopped once the flag, which must outlive it,
// is set. Null: the one that was there before.
class Stop {
 public:
  explicit Stop(const std::atomic<bool>* flag) : before_(Flag()) {
    if (flag != nullptr) Flag() = flag;
  }
  Stop(const Stop&) = delete;
  Stop& operator=(const Stop&) = delete;
  ~Stop() { Flag() = before_; }

  static bool IsAsked() { return Flag() != nullptr && *Flag(); }
  // In a loop whose turns may take long.
  static void Check() {
    if (IsAsked()) throw Stopped();
  }

 private:
  static const std::atomic<bool>*& Flag() {
    thread_local const std::atomic<bool>* flag = nullptr;
    return flag;
  }

  const std::atomic<bool>* before_;
};

}  // namespace stiction
