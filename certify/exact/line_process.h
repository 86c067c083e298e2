// SPDX-License-Identifier: Apache-2.0
// A program of its own that is asked and answers line by line: stiction-ipopt (feasibility_nlp.h), a solver
// under test (search/under_test/).

#ifndef STICTION_CERTIFY_EXACT_LINE_PROCESS_H_
#define STICTION_CERTIFY_EXACT_LINE_PROCESS_H_

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace stiction {

// Its standard input and output are one socket: unlike a pipe it can be written to without SIGPIPE, and without
// touching the signals of this program. It is killed with this object, if it has not ended before.
class LineProcess {
 public:
  using Clock = std::chrono::steady_clock;
  enum class End { kLine, kDied, kTimeout };
  struct Line {
    End end = End::kLine;
    std::string text;
  };

  // The program and its arguments. InputError if it cannot be run, with what was expected of it.
  LineProcess(std::vector<std::string> command, const std::string& expected);
  ~LineProcess();
  LineProcess(const LineProcess&) = delete;
  LineProcess& operator=(const LineProcess&) = delete;

  pid_t id() const { return id_; }
  static Clock::time_point After(double seconds);

  // Writes the request, and returns the next line without its end; after so many seconds kTimeout.
  Line Exchange(const std::string& request, double patience);
  End Write(const std::string& text, Clock::time_point deadline);
  Line Read(Clock::time_point deadline);
  // How a process that died ended, as waitpid tells it. Waits for that.
  int WaitStatus();

 private:
  int Spawn(std::vector<std::string>& command, int socket);
  bool Wait(short events, Clock::time_point deadline) const;
  bool Receive();

  pid_t id_ = -1;
  bool has_ended_ = false;
  int status_ = 0;
  int socket_ = -1;
  std::string received_;
};

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_LINE_PROCESS_H_
