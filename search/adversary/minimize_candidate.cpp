// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/minimize_candidate.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace stiction {
namespace {

int SignificantDigits(std::int64_t value) {
  if (value == 0) return 0;
  while (value % 10 == 0) value /= 10;
  int digits = 0;
  for (; value != 0; value /= 10) ++digits;
  return digits;
}

// Contacts, choices, significant digits of all choices, and the sum of their sizes.
using Plainness = std::array<std::int64_t, 4>;

class CandidateMinimizer {
 public:
  CandidateMinimizer(const Candidate& candidate, const std::function<bool(const Candidate&)>& keep,
                     const std::function<bool()>& cancelled)
      : keep_(keep), cancelled_(cancelled) {
    Take(candidate);
  }

  MinimizedCandidate Run() {
    while (!cancelled_() && (FewerContacts() || FewerChoices() || RounderNumbers())) {
    }
    result_.cancelled = cancelled_();
    return result_;
  }

 private:
  // With its choices clamped.
  void Take(const Candidate& candidate) {
    made_.clear();
    RoundedOf(candidate, &made_);
    result_.candidate = candidate;
    result_.candidate.choices = ValuesOf(made_);
    plainness_ = PlainnessOf(result_.candidate);
  }

  static Plainness PlainnessOf(const Candidate& clamped) {
    Plainness plainness{clamped.contacts, std::ssize(clamped.choices)};
    for (const std::int64_t value : clamped.choices) {
      plainness[2] += SignificantDigits(value);
      plainness[3] += std::abs(value);
    }
    return plainness;
  }

  bool Try(Candidate candidate) {
    std::vector<Choice> made;
    RoundedOf(candidate, &made);
    candidate.choices = ValuesOf(made);
    if (!(PlainnessOf(candidate) < plainness_)) return false;
    ++result_.tried;
    if (!keep_(candidate)) return false;
    ++result_.accepted;
    Take(candidate);
    return true;
  }

  bool FewerContacts() {
    if (result_.candidate.contacts == 1) return false;
    Candidate fewer = result_.candidate;
    --fewer.contacts;
    return Try(fewer);
  }

  // A choice taken out, and what follows moved up: an attempt that was given up, a contact, a load.
  bool FewerChoices() {
    bool progress = false;
    for (std::size_t i = 0; i < result_.candidate.choices.size() && !cancelled_(); ++i) {
      Candidate fewer = result_.candidate;
      fewer.choices.erase(fewer.choices.begin() + static_cast<std::ptrdiff_t>(i));
      progress |= Try(fewer);
      if (i >= result_.candidate.choices.size()) break;
      fewer = result_.candidate;
      fewer.choices[i] = std::clamp<std::int64_t>(0, made_[i].low, made_[i].high);
      progress |= Try(fewer);
    }
    return progress;
  }

  // Every choice to a multiple of a round number near it, the roundest first.
  bool RounderNumbers() {
    constexpr std::array<std::int64_t, 10> kSteps = {1000, 500, 200, 100, 50, 20, 10, 5, 2, 1};
    bool progress = false;
    for (std::size_t i = 0; i < result_.candidate.choices.size() && !cancelled_(); ++i) {
      for (const std::int64_t step : kSteps) {
        if (i >= result_.candidate.choices.size()) break;
        const std::int64_t value = result_.candidate.choices[i];
        const std::int64_t down = value / step * step;
        bool taken = false;
        for (const std::int64_t rounded :
             {down, down + (value < 0 ? -step : step), down + (value < 0 ? step : -step)}) {
          if (rounded == value || rounded < made_[i].low || rounded > made_[i].high) continue;
          Candidate rounder = result_.candidate;
          rounder.choices[i] = rounded;
          taken = Try(rounder);
          if (taken) break;
        }
        progress |= taken;
        if (taken) break;
      }
    }
    return progress;
  }

  const std::function<bool(const Candidate&)>& keep_;
  const std::function<bool()>& cancelled_;
  std::vector<Choice> made_;
  Plainness plainness_ = {};
  MinimizedCandidate result_;
};

}  // namespace

MinimizedCandidate MinimizeCandidate(const Candidate& candidate,
                                     const std::function<bool(const Candidate&)>& keep,
                                     const std::function<bool()>& cancelled) {
  return CandidateMinimizer(candidate, keep, cancelled).Run();
}

}  // namespace stiction
