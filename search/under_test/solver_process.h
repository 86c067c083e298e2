// SPDX-License-Identifier: Apache-2.0
// A solver under test in a process of its own, with budgets: processor time and time of the clock for each
// problem, memory, bytes that it writes. Whatever it does, a call ends within its budget, or as soon as the
// search is stopped, and nothing that it started outlives it (certify/exact/line_process.h).

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "search/under_test/solver.h"
#include "solver/problem/problem.h"

namespace stiction {

class LineProcess;

inline constexpr double kSolverSeconds = 1;  // of processor time, for a problem
// Times as long on the wall clock, in which the solver waits and not for a processor. What takes half of that
// is asked once more, in a new process, before it is said to hang.
inline constexpr double kSolverPatience = 10;
inline constexpr std::int64_t kSolverBytes = std::int64_t{1} << 29;  // beyond what it begins with
inline constexpr std::size_t kSolverLine = std::size_t{1} << 20;     // bytes of an answer
inline constexpr std::size_t kSolverErrors = std::size_t{1} << 16;   // of standard error that are shown
inline constexpr double kGreetingSeconds = 60;                       // until it says what it is

inline constexpr std::string_view kAsleep = "asleep", kNoGreeting = "no-greeting";

enum class SolverEnd : std::uint8_t { kAnswered, kCrashed, kHung, kStopped };

struct SolverReply {
  SolverEnd end = SolverEnd::kAnswered;
  bool solved = false;      // as it says
  bool is_in_range = true;  // false: it wrote a number that no double holds, as 1e999
  Eigen::VectorXd f;
  // Of a crash: "sigsegv", "exit-3", "out-of-memory"; "garbled": what it wrote is no answer; "unasked": it
  // wrote more than was asked for; "flood": more than kSolverLine without the end of a line; "closed": it
  // closed its output and lives on; "no-greeting", of a process that was started anew; "killed-its-guard". Of a
  // hang: "asleep" where it took the time of the clock alone.
  std::string how;
};

// What runs a file: a library (NAME.so, NAME.so.1) in a process of this program, any other file as a program.
std::vector<std::string> SolverCommand(const std::filesystem::path& file);

// The problem as a law poses it: without friction, or as it is.
ContactProblem<double> PosedFor(SolverLaw law, const ContactProblem<double>& problem);
// Bounds of friction under the law `box`, by contact: mu times the force that alone would stop the normal's
// row, abs(bN) / A_NN.
std::vector<double> FixedBounds(const ContactProblem<double>& problem);

class SolverProcess {
 public:
  // Starts it to ask what it is. InputError where it cannot be run, or says something else than it should.
  // `stopped` ends any wait: the call is kStopped, and the solver has no process. `greeting`: s.
  explicit SolverProcess(
      std::vector<std::string> command, std::function<bool()> stopped = [] { return false; },
      double greeting = kGreetingSeconds);
  ~SolverProcess();

  const SolverUnderTest& about() const { return about_; }
  bool IsLibrary() const { return command_.size() > 1; }
  // Whether it declares that its memory is no matter of ours ("leaks": false).
  bool KeepsMemory() const { return keeps_memory_; }
  // The problem as posed. One that crashed or hung is started anew by the next call.
  SolverReply Solve(const ContactProblem<double>& posed, double seconds = kSolverSeconds);
  // The next call finds a new process.
  void Restart();
  // Bytes that its data take now; 0 of one that does not run.
  std::int64_t Memory() const;
  // Seconds of processor time that its processes have taken, and of the clock in which they slept.
  double Seconds() const { return seconds_; }

 private:
  void Start();
  bool StartAgain(SolverReply& reply);
  SolverReply AskOnce(const std::string& request, int rows, double seconds);
  SolverReply Ask(const std::string& request, int rows, double seconds);
  SolverReply Died();
  void TakeErrors(std::string_view text);
  double ProcessSeconds() const;
  double SecondsInQueue() const;

  std::vector<std::string> command_;
  std::function<bool()> stopped_;
  double greeting_;
  SolverUnderTest about_;
  bool keeps_memory_ = false;
  std::unique_ptr<LineProcess> process_;
  int statm_ = -1;
  std::int64_t first_memory_ = 0, last_memory_ = 0;
  double seconds_ = 0;
  std::size_t errors_ = 0;  // bytes of standard error that were shown; one more than may be: the end was told
  bool line_begins_ = true;
};

}  // namespace stiction
