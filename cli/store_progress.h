// SPDX-License-Identifier: Apache-2.0
// How far a store is read: a bar on a terminal, lines in a log after ten seconds.

#ifndef STICTION_CLI_STORE_PROGRESS_H_
#define STICTION_CLI_STORE_PROGRESS_H_

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "corpus/grouped.h"
#include "corpus/progress_bar.h"
#include "corpus/stopwatch.h"
#include "search/testimony.h"

namespace stiction {

class StoreProgress {
 public:
  ~StoreProgress() { Clear(); }
  // Of several stores, the one that is read is named.
  ShowFindings Reading(const std::string& file = {}) {
    const std::string which = file.empty() ? "" : file + ": ";
    return [this, which](std::int64_t done, std::int64_t of) {
      Show(done, of,
           [&] { return fmt::format("{}{} of {} findings read", which, Grouped(done), Grouped(of)); });
    };
  }
  void Clear() const { bar_.Clear(); }

 protected:
  // The first, and then five a second.
  template <class Text>
  void Show(std::int64_t done, std::int64_t of, Text text) {
    const double now = watch_.Seconds();
    if (now < next_) return;
    next_ = now + 0.2;
    bar_.Show(static_cast<double>(done) / static_cast<double>(std::max<std::int64_t>(1, of)), text());
  }

 private:
  ProgressBar bar_;
  Stopwatch watch_{CLOCK_MONOTONIC};
  double next_ = 0;  // s
};

}  // namespace stiction

#endif  // STICTION_CLI_STORE_PROGRESS_H_
