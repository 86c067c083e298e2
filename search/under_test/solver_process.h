// SPDX-License-Identifier: Apache-2.0
// A solver under test in a process of its own, with budgets: processor time for each problem, memory.

#ifndef STICTION_SEARCH_UNDER_TEST_SOLVER_PROCESS_H_
#define STICTION_SEARCH_UNDER_TEST_SOLVER_PROCESS_H_

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "search/under_test/solver.h"
#include "solver/problem/problem.h"

namespace stiction {

class LineProcess;

inline constexpr double kSolverSeconds = 1;  // of processor time, for a problem
// Times as long on the wall clock: far beyond what a busy machine makes of it. What takes so long sleeps, or
// has hardly been given a processor; it is asked once more, in a new process, before it is said to hang.
inline constexpr double kSolverPatience = 60;
inline constexpr std::int64_t kSolverBytes = std::int64_t{1} << 29;  // beyond what it begins with

inline constexpr std::string_view kAsleep = "asleep";

enum class SolverEnd : std::uint8_t { kAnswered, kCrashed, kHung };

struct SolverReply {
  SolverEnd end = SolverEnd::kAnswered;
  bool solved = false;  // as it says
  Eigen::VectorXd f;
  std::string how;  // of a crash: "sigsegv", "exit-3", "out-of-memory", "garbled": what it wrote is no answer;
                    // of a hang: "asleep" where it took the time of the clock alone
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
  explicit SolverProcess(std::vector<std::string> command);
  ~SolverProcess();

  const SolverUnderTest& about() const { return about_; }
  bool IsLibrary() const { return command_.size() > 1; }
  // The problem as posed. One that crashed or hung is started anew by the next call.
  SolverReply Solve(const ContactProblem<double>& posed, double seconds = kSolverSeconds);
  // The next call finds a new process.
  void Restart();
  // Bytes that its data take now; 0 of one that does not run.
  std::int64_t Memory() const;
  // Seconds of processor time that its processes have taken.
  double Seconds() const { return seconds_; }

 private:
  void Start();
  SolverReply AskOnce(const std::string& request, int rows, double seconds);
  SolverReply Ask(const std::string& request, int rows, double seconds);
  SolverReply Died();
  double ProcessSeconds() const;

  std::vector<std::string> command_;
  SolverUnderTest about_;
  std::unique_ptr<LineProcess> process_;
  int statm_ = -1;
  std::int64_t first_memory_ = 0, last_memory_ = 0;
  double seconds_ = 0;
};

}  // namespace stiction

#endif  // STICTION_SEARCH_UNDER_TEST_SOLVER_PROCESS_H_
