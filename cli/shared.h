// SPDX-License-Identifier: Apache-2.0
// Pieces that several verbs share.

#pragma once

#include <fmt/format.h>

#include <atomic>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>

#include "cli/narration/outcome_text.h"
#include "cli/verb.h"
#include "corpus/atomic_file.h"
#include "corpus/exit_code.h"
#include "corpus/formats/read_problem.h"
#include "corpus/json_text.h"
#include "corpus/plain_text.h"
#include "corpus/progress_bar.h"
#include "corpus/record/problem_file.h"
#include "corpus/whole_folder.h"
#include "solver/problem/options.h"
#include "solver/problem/solution.h"

namespace stiction {

// --policy; the value is checked while parsing. `*`, the whole planar grid, only where it makes sense.
enum class Grid { kRefused, kAllowed };
// Empty, or what is wrong with the text.
std::string PolicyError(const std::string& text, Grid grid);
void AddPolicyOption(Verb& verb, std::string& policy, Grid grid);
// Limits and tolerances from their tables.
void AddLimits(Verb& verb, Limits& limits);
void AddTolerances(Verb& verb, Tolerances& tolerances);

// The value of --sides: empty, or what is wrong with the text.
std::string CheckSides(const std::string& text);

// The outcome that `expect` has for a policy: by its canonical name, then "*", otherwise empty.
std::string Expected(const ProblemFile& file, const Policy& policy);

// --replace, of verbs that write a folder.
void AddReplace(Verb& verb, bool& replace);
Occupied OccupiedIf(bool replace);
// Says on standard error where the folder that stood there is now, if it was kept.
void TellAside(const std::filesystem::path& aside);

// From the first call on SIGINT, SIGTERM and SIGHUP set what it returns, and do nothing else: the verb ends by
// itself. SIGHUP stays ignored where it is (nohup).
const std::atomic<bool>& Interruption();

// Text for people on standard output, in lines that fit the terminal.
template <class... Args>
void Tell(fmt::format_string<Args...> text, Args&&... args) {
  std::cout << Folded(fmt::format(text, std::forward<Args>(args)...));
}

// What a verb did that writes a file, as text or, with --json, as an object: on standard output, or on standard
// error where that file stands there (`output` is "-").
void SayWhatWasDone(const std::string& output, bool json, const std::string& text, const SharedJson& object);

// What FILE is, in help.
inline constexpr const char* kFileHelp = "a problem, in any form that is read";
inline constexpr const char* kFileDetails =
    "stiction-problem, short or whole; scene of one problem; Siconos .dat; FCLIB .hdf5; STORE:FINDING";

}  // namespace stiction
