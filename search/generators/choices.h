// SPDX-License-Identifier: Apache-2.0
// Choices: everything random in one problem, a sequence of integers.
//
// A problem is a function of its choices. They come from one 64-bit seed (splitmix64) or from a recorded
// sequence that a minimizer has edited: any sequence is valid, since each value is clamped into the range
// that is asked for, and a sequence that has run out goes on with the value nearest zero. Only integer
// arithmetic is used, so that a seed means the same choices on every machine.
//
// Source      splitmix64: Steele, Lea, Flood, "Fast splittable pseudorandom number generators", OOPSLA
//             2014. Several numbers from one word: the fraction word / 2^64 is read digit by digit in the
//             base that is asked for; after digits of ranges r1, r2, ... a value's probability is off by
//             at most r1 r2 ... / 2^64.

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace stiction {

// The finalizer of splitmix64: a bijection of 64-bit words.
constexpr std::uint64_t Mix(std::uint64_t word) {
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
  return word ^ (word >> 31);
}

// The seed of problem `index` in unit `unit` of a campaign. Within a unit no two seeds are equal.
inline constexpr std::uint64_t kSeedStep = 0xd1342543de82ef95u;  // odd, and not the increment of Choices
constexpr std::uint64_t UnitSeed(std::uint64_t campaign_seed, std::uint64_t unit) {
  const std::uint64_t campaign = Mix(campaign_seed + kSeedStep);
  return Mix(campaign + kSeedStep * (unit + 1));
}
constexpr std::uint64_t ProblemSeed(std::uint64_t campaign_seed, std::uint64_t unit, std::uint64_t index) {
  return Mix(UnitSeed(campaign_seed, unit) + kSeedStep * (index + 1));
}

// A choice that was made, and the range that was asked for.
struct Choice {
  std::int64_t value = 0, low = 0, high = 0;

  bool operator==(const Choice&) const = default;
};

// What was chosen, without the ranges.
inline std::vector<std::int64_t> ValuesOf(std::span<const Choice> choices) {
  std::vector<std::int64_t> values;
  for (const Choice& choice : choices) values.push_back(choice.value);
  return values;
}

class Choices {
 public:
  // Choices from a seed, noted down in `record` where one is given.
  explicit Choices(std::uint64_t seed, std::vector<Choice>* record = nullptr) : state_(seed), record_(record) {}

  // Choices from `sequence`, which must outlive them; `record` receives the values after clamping.
  static Choices Replay(std::span<const std::int64_t> sequence, std::vector<Choice>* record = nullptr) {
    Choices choices(0, record);
    choices.replaying_ = true;
    choices.rest_ = sequence;
    return choices;
  }

  // Uniform in [low, high]. Requires low <= high.
  std::int64_t Integer(std::int64_t low, std::int64_t high) {
    std::int64_t value;
    if (replaying_) [[unlikely]] {
      value = NextRecorded(low, high);
    } else {
      const std::uint64_t range = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low) + 1;
      const std::uint64_t word = Word();
      const std::uint64_t digit = range == 0 ? word : HighWord(word, range);  // 0: all of 64 bits
      value = static_cast<std::int64_t>(static_cast<std::uint64_t>(low) + digit);
    }
    if (record_ != nullptr) [[unlikely]]
      record_->push_back({value, low, high});
    return value;
  }

  // `count` choices in [kLow, kHigh]: calls take(i, value) for i = 0, 1, ... Several share one word. The
  // values differ from those of as many calls of Integer, but are recorded and replayed alike.
  template <int kLow, int kHigh, class Take>
  void ForEach(int count, Take take) {
    if (replaying_) [[unlikely]] {
      for (int i = 0; i < count; ++i) take(i, static_cast<int>(Integer(kLow, kHigh)));
      return;
    }
    constexpr std::uint64_t kRange = static_cast<std::uint64_t>(std::int64_t{kHigh} - kLow + 1);
    constexpr int kDigits = DigitsPerWord(kRange);
    for (int first = 0; first < count; first += kDigits) {
      const std::array<int, kDigits> values = Digits<kLow, kRange, kDigits>(Word());
      const int used = std::min(kDigits, count - first);
      for (int i = 0; i < used; ++i) take(first + i, values[i]);
      if (record_ != nullptr) [[unlikely]]
        for (int i = 0; i < used; ++i) record_->push_back({values[i], kLow, kHigh});
    }
  }

 private:
  __extension__ using Word128 = unsigned __int128;

  static std::uint64_t HighWord(std::uint64_t x, std::uint64_t y) {
    return static_cast<std::uint64_t>((Word128{x} * y) >> 64);
  }

  // As many digits as keep the error of a probability at or below 2^-32; powers of two have none.
  static constexpr int DigitsPerWord(std::uint64_t range) {
    const bool exact = (range & (range - 1)) == 0;
    int digits = 1;
    for (Word128 product = Word128{range} * range; product <= Word128{1} << (exact ? 64 : 32) && digits < 16;
         product *= range) {
      ++digits;
    }
    return digits;
  }

  template <int kLow, std::uint64_t kRange, int kDigits>
  static std::array<int, kDigits> Digits(std::uint64_t fraction) {
    std::array<int, kDigits> values;
    for (int& value : values) {
      value = kLow + static_cast<int>(HighWord(fraction, kRange));
      fraction *= kRange;
    }
    return values;
  }

  std::uint64_t Word() {
    state_ += 0x9e3779b97f4a7c15u;
    return Mix(state_);
  }

  std::int64_t NextRecorded(std::int64_t low, std::int64_t high) {
    std::int64_t value = 0;
    if (!rest_.empty()) {
      value = rest_.front();
      rest_ = rest_.subspan(1);
    }
    return std::clamp(value, low, high);
  }

  std::uint64_t state_;
  std::vector<Choice>* record_;
  bool replaying_ = false;
  std::span<const std::int64_t> rest_;
};

}  // namespace stiction
