// SPDX-License-Identifier: Apache-2.0
// A running stiction-ipopt; feasibility_nlp.h describes what it is asked, and why it is a process of its own.

#ifndef STICTION_CERTIFY_EXACT_IPOPT_PROCESS_H_
#define STICTION_CERTIFY_EXACT_IPOPT_PROCESS_H_

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

namespace stiction {

// Its standard input and output are one socket: unlike a pipe it can be written to without SIGPIPE, and without
// touching the signals of this program. It ends when the socket is closed.
class IpoptProcess {
 public:
  using Clock = std::chrono::steady_clock;
  enum class End { kLine, kDied, kTimeout };
  struct Line {
    End end = End::kLine;
    std::string text;
  };

  // Runs the program and waits for its greeting. InputError if it cannot be run, or does not speak the
  // protocol.
  static std::unique_ptr<IpoptProcess> Start(const std::filesystem::path& program);
  ~IpoptProcess();
  IpoptProcess(const IpoptProcess&) = delete;
  IpoptProcess& operator=(const IpoptProcess&) = delete;

  pid_t id() const { return id_; }

  // Writes the request, and returns the next line without its end; after so many seconds kTimeout.
  Line Exchange(const std::string& request, double patience);

 private:
  explicit IpoptProcess(const std::filesystem::path& program);
  int Spawn(std::string program, int socket);
  End Write(const std::string& text, Clock::time_point deadline);
  Line Read(Clock::time_point deadline);
  bool Wait(short events, Clock::time_point deadline) const;
  bool Receive();

  pid_t id_ = -1;
  int socket_ = -1;
  std::string received_;
};

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_IPOPT_PROCESS_H_
