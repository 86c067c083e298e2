// SPDX-License-Identifier: Apache-2.0
#include "corpus/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace stiction {

ProgressBar::ProgressBar(std::FILE* out) : out_(out), terminal_(isatty(fileno(out)) != 0) {}

void ProgressBar::Show(double fraction, const std::string& text) {
  constexpr int kWidth = 20;
  if (!terminal_) return Log(fraction, text);
  const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * kWidth);
  fmt::print(out_, "\r\033[K[{}{}] {}", std::string(filled, '#'), std::string(kWidth - filled, '.'), text);
  std::fflush(out_);
}

void ProgressBar::Log(double fraction, const std::string& text) {
  constexpr double kFirst = 10, kLast = 600;  // seconds between lines
  const double now = watch_.Seconds();
  if (now - last_ < std::clamp(now / 20, kFirst, kLast)) return;
  last_ = now;
  fmt::print(out_, "{:.0f} s, {:.0f} %: {}\n", now, 100 * std::clamp(fraction, 0.0, 1.0), text);
  std::fflush(out_);
}

void ProgressBar::Clear() const {
  if (!terminal_) return;
  fmt::print(out_, "\r\033[K");
  std::fflush(out_);
}

}  // namespace stiction
