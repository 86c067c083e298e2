// SPDX-License-Identifier: Apache-2.0
// A program of its own that is asked and answers line by line: stiction-ipopt (feasibility_nlp.h), a solver
// under test (search/under_test/). Nothing that it does stops or outlives the process that asks it.

#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/descriptor.h"

namespace stiction {

// What a process may write, and who is told.
struct LineBounds {
  std::size_t line = std::size_t{1} << 26;  // bytes of a line, and of what was not asked for
  // Looked at while a process is waited for, about twenty times a second; true ends the wait.
  std::function<bool()> stopped = {};
  // Gets what the process writes on standard error. If empty, it writes on ours.
  std::function<void(std::string_view)> errors = {};
};

// Its standard input and output are one socket: unlike a pipe it can be written to without SIGPIPE, and without
// touching the signals of this program.
//
// Between the two stands a guard (process_guard.h): when this object goes, or its process dies in whatever way,
// the guard kills the program and all that it started, in whatever group or session.
class LineProcess {
 public:
  using Clock = std::chrono::steady_clock;
  // kFlood: a line beyond the bound. kStopped: `stopped` said so.
  enum class End { kLine, kDied, kTimeout, kFlood, kStopped };
  struct Line {
    End end = End::kLine;
    std::string text;
  };

  // The program and its arguments. InputError if it cannot be run, with what was expected of it.
  LineProcess(std::vector<std::string> command, const std::string& expected, LineBounds bounds = {});
  ~LineProcess();
  LineProcess(const LineProcess&) = delete;
  LineProcess& operator=(const LineProcess&) = delete;

  // Of the program.
  pid_t id() const { return id_; }
  static Clock::time_point After(double seconds);

  // Writes the request, and returns the next line without its end; after so many seconds kTimeout.
  Line Exchange(const std::string& request, double patience);
  End Write(const std::string& text, Clock::time_point deadline);
  // kDied once its output ends, or it ended and all that it wrote was read, whoever else holds its output.
  Line Read(Clock::time_point deadline);
  // Whether it wrote more than was read.
  bool HasMore();
  // How a process that died ended, as waitpid tells it. Waits a second at most: empty of one that closed its
  // output and lives on, or killed its guard.
  std::optional<int> WaitStatus();
  // False once its guard is gone, which only the program can have killed.
  bool IsGuarded() const { return is_guarded_; }

 private:
  void Start(const std::vector<std::string>& command, const std::string& expected);
  bool Wait(short events, Clock::time_point deadline);
  void Listen();
  void PassErrors();
  bool Receive();
  bool IsStopped() const { return bounds_.stopped && bounds_.stopped(); }
  void EndGuard();

  LineBounds bounds_;
  std::string mark_;  // in the environment of the program and of all that it starts
  pid_t guard_ = -1, id_ = -1;
  Descriptor socket_, control_, errors_;
  std::optional<int> status_;
  bool is_guarded_ = true;    // until the guard is gone
  bool is_readable_ = false;  // the socket, at the last look
  std::string received_;
  std::size_t scanned_ = 0;  // of `received_`, without the end of a line
};

}  // namespace stiction
