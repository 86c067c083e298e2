// SPDX-License-Identifier: Apache-2.0
// How far something is that takes long, on standard error: a bar on a terminal, cut to its width; in a log a
// line after ten seconds, then ever more seldom.

#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>

#include "corpus/stopwatch.h"

namespace stiction {

class ProgressBar {
 public:
  explicit ProgressBar(std::FILE* out = stderr);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar() { Clear(); }
  bool IsShown() const { return terminal_; }
  // `fraction`: of what is to be done, 0 to 1.
  void Show(double fraction, const std::string& text);
  // The same of what is told often: the first time, then five times a second.
  void ShowSome(std::int64_t done, std::int64_t of, const std::function<std::string()>& text);
  void Clear() const;
  double Seconds() const { return watch_.Seconds(); }

 private:
  void Log(double fraction, const std::string& text);

  std::FILE* out_;
  bool terminal_;
  Stopwatch watch_{CLOCK_MONOTONIC};
  double last_ = 0;  // line of the log, s
  double next_ = 0;  // call of ShowSome that is heard, s
};

}  // namespace stiction
