// SPDX-License-Identifier: Apache-2.0
// Signals of the interpreter while the library computes, and what computes so that they, or the time, end it.

#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>
#include <optional>

namespace stiction {

// Looks for signals of the interpreter, which are handled in its main thread alone. What a handler throws is
// kept until what computes has ended.
class Signals {
 public:
  const std::atomic<bool>* flag() const { return &interrupted_; }

  // Without the interpreter's lock.
  void Look() {
    const pybind11::gil_scoped_acquire acquired;
    if (thrown_ || PyErr_CheckSignals() == 0) return;
    thrown_.emplace();
    Stop();
  }
  void Stop() { interrupted_ = true; }
  // With it.
  void Throw() {
    if (thrown_) throw pybind11::error_already_set(*thrown_);
  }

 private:
  std::atomic<bool> interrupted_ = false;
  std::optional<pybind11::error_already_set> thrown_;
};

// run(flag), in a thread of its own and without the interpreter's lock. The flag is set by a signal, whose
// exception comes when `run` has ended, and after so many seconds, if they are more than 0.
template <class Run>
auto Interruptible(double seconds, Run run) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kBetweenLooks = std::chrono::milliseconds(50);
  Signals signals;
  std::future<decltype(run(signals.flag()))> result;
  {
    const pybind11::gil_scoped_release released;
    const auto begin = Clock::now();
    result = std::async(std::launch::async, run, signals.flag());
    while (result.wait_for(kBetweenLooks) != std::future_status::ready) {
      signals.Look();
      if (seconds > 0 && std::chrono::duration<double>(Clock::now() - begin).count() >= seconds) signals.Stop();
    }
  }
  signals.Throw();
  return result.get();
}

}  // namespace stiction
