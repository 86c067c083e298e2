// SPDX-License-Identifier: Apache-2.0
#include "corpus/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "corpus/plain_text.h"

namespace stiction {

ProgressBar::ProgressBar(std::FILE* out) : out_(out), terminal_(isatty(fileno(out)) != 0) {}

void ProgressBar::Show(double fraction, const std::string& text) {
  constexpr std::size_t kWidth = 20;
  if (!terminal_) return Log(fraction, text);
  const auto filled = static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * kWidth);
  std::string line =
      fmt::format("[{}{}] {}", std::string(filled, '#'), std::string(kWidth - filled, '.'), text);
  const std::size_t most = TextWidth(fileno(out_)) - 1;  // behind the last column some terminals begin a line
  if (line.size() > most) line.resize(most);
  fmt::print(out_, "\r\033[K{}", line);
  std::fflush(out_);
}

void ProgressBar::ShowSome(std::int64_t done, std::int64_t of, const std::function<std::string()>& text) {
  const double now = watch_.Seconds();
  if (now < next_) return;
  next_ = now + 0.2;
  Show(static_cast<double>(done) / static_cast<double>(std::max<std::int64_t>(1, of)), text());
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
