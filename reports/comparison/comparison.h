// SPDX-License-Identifier: Apache-2.0
// Two campaigns side by side: what differs, and whether by more than noise.
//
// What both have counted of one generator, number of contacts, policy, method and arithmetic is compared, as a
// whole and by friction. Every test is Fisher's (exact_tests.h), steps by how many runs took more than the
// median of both together (the median test of Brown and Mood, A. M. Mood, Introduction to the Theory of
// Statistics, 1950: exact, too, given the pooled steps); all are corrected together (Holm). They take problems
// for independent draws.

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "corpus/json_text.h"
#include "corpus/store/store.h"
#include "corpus/whole_folder.h"
#include "reports/comparison/exact_tests.h"
#include "reports/told/told.h"

namespace stiction {

inline constexpr double kNoiseLevel = 0.05;

struct ComparedRate {
  TallyKey key;
  std::string friction;            // of all contacts; empty: any
  std::string measure;             // "loops"
  std::string meaning;             // "runs that loop, confirmed exactly"
  Ratio a, b;                      // shares
  std::optional<double> p;         // where the two can differ at all
  std::optional<double> adjusted;  // corrected for all tests of the comparison

  bool MoreThanNoise() const { return adjusted && *adjusted <= kNoiseLevel; }
};

// Steps of a run in the campaign's arithmetic: how many runs took 0, 1, ..., 62, and 63 or more.
struct ComparedSteps {
  using Bins = std::array<std::int64_t, Tally::kBins>;

  TallyKey key;
  Bins a = {}, b = {};
  std::int64_t sum_a = 0, sum_b = 0;
};

struct Comparison {
  std::vector<std::string> differences;  // of the two campaigns, one line each
  std::vector<ComparedRate> rates;
  std::vector<ComparedSteps> steps;
  std::vector<TallyKey> only_a, only_b;  // counted in one alone
  std::int64_t tests = 0;

  bool MoreThanNoise() const;
};

// InputError, which names the files, where there is nothing to compare: stores of one campaign, or no
// generator, size and policy that both have run.
Comparison Compare(const Store& a, const std::string& file_a, const Store& b, const std::string& file_b);

// For `text` and `page`, `a` and `b` being the names of the two (told/told.h).
Told Tell(const Comparison& comparison, const std::string& file_a, const std::string& file_b);
// As plain text.
std::string ComparisonText(const Comparison& comparison, const std::string& file_a, const std::string& file_b);
// A row per rate that was compared.
Table ComparisonTable(const Comparison& comparison);
// Every rate, with what differs by design, and what one alone has.
SharedJson ComparisonToJson(const Comparison& comparison);
// A row per number of steps that occurred.
Table ComparisonStepsTable(const Comparison& comparison);

// index.html, comparison.txt, comparison.csv, comparison_steps.csv and SHA256SUMS, as a
// whole. Returns where a directory with files of others was moved to, if so.
std::filesystem::path WriteComparison(const Comparison& comparison, const std::string& file_a,
                                      const std::string& file_b, const std::filesystem::path& directory,
                                      Occupied occupied = Occupied::kRefused);

// index.html of campaigns, or of solvers under test, side by side: what is told for a `page`; `figures`: what
// it draws.
std::string ComparisonPage(const char* title, const char* question, const Told& told,
                           const std::vector<Table>& figures = {});

}  // namespace stiction
