// SPDX-License-Identifier: Apache-2.0
// Records: the worst problems that are known, one per frontier, as corpus/records keeps them.
//
// {"format": "stiction-record", "version": 1, "frontier", "what", "objective", "value", "status", "command",
// "build", "processor_seconds", "random", "problem", "certificate"}: all of it is read, and all that is
// claimed can be checked: the value is computed anew from the exact problem, the certificate is accepted and
// speaks of that problem.
//
//   value    p/q. Of `condition` an upper bound with "bounds": [l, u], l > 0: u / l is the value, and all
//            eigenvalues of A are in [l, u].
//   status   "best so far" or "proved", with "proof" naming where
//   random   the best of random problems, of how many, and what drew them: {"value" (null: nothing),
//            "evaluations", "command"}

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "corpus/json_text.h"
#include "corpus/record/problem_file.h"
#include "search/adversary/objective.h"
#include "solver/problem/options.h"

namespace stiction {

struct FrontierRecord {
  std::string frontier;  // name of the file, too
  std::string what;
  const Objective* objective = nullptr;
  Rational value;
  std::optional<std::pair<Rational, Rational>> bounds;
  std::string status = "best so far";
  std::string proof;    // where; empty unless proved
  std::string command;  // that found it
  std::string build;    // that made the record of the problem
  double processor_seconds = 0;
  std::optional<Rational> random_value;
  std::int64_t random_evaluations = 0;
  std::string random_command;
  ProblemFile problem;
  SharedJson certificate;
};

FrontierRecord ParseFrontierRecord(std::string_view text, const std::string& source);  // InputError
FrontierRecord ReadRecord(const std::filesystem::path& file);                          // InputError
// Of a folder, in the order of their names. InputError if there is none.
std::vector<FrontierRecord> ReadRecords(const std::filesystem::path& folder);
// Its members from "frontier" to "command".
SharedJson HeadOf(const FrontierRecord& record);
std::string Print(const FrontierRecord& record);

// A record of this problem: value and certificate made. InputError if the objective has no value there, or none
// that a record can hold exactly.
FrontierRecord MakeRecord(const Objective& objective, const ProblemFile& problem, const Limits& limits);

// What is not as the record says; empty if all is.
std::string FaultOf(const FrontierRecord& record, const Limits& limits);

}  // namespace stiction
