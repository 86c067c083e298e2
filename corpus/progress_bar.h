// SPDX-License-Identifier: Apache-2.0
// How far something is that takes long, on standard error: a bar on a terminal, cut to its width; in a log a
// line after ten seconds, then ever more seldom.

#ifndef STICTION_CORPUS_PROGRESS_BAR_H_
#define STICTION_CORPUS_PROGRESS_BAR_H_

#include <cstdio>
#include <string>

#include "corpus/stopwatch.h"

namespace stiction {

class ProgressBar {
 public:
  explicit ProgressBar(std::FILE* out = stderr);
  bool IsShown() const { return terminal_; }
  // `fraction`: of what is to be done, 0 to 1.
  void Show(double fraction, const std::string& text);
  void Clear() const;

 private:
  void Log(double fraction, const std::string& text);

  std::FILE* out_;
  bool terminal_;
  Stopwatch watch_{CLOCK_MONOTONIC};
  double last_ = 0;  // line of the log, s
};

}  // namespace stiction

#endif  // STICTION_CORPUS_PROGRESS_BAR_H_
