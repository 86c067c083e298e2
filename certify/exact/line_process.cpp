// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/line_process.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "corpus/input_error.h"
#include "solver/problem/check.h"

namespace stiction {

LineProcess::Clock::time_point LineProcess::After(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

LineProcess::LineProcess(std::vector<std::string> command, const std::string& expected) {
  std::array<int, 2> ends;
  STICTION_CHECK(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0, std::strerror(errno));
  socket_ = ends[0];
  const int error = Spawn(command, ends[1]);
  close(ends[1]);
  if (error == 0) return;
  close(socket_);
  throw InputError(
      fmt::format("{}: cannot be run: {}; expected {}", command.front(), std::strerror(error), expected));
}

// In a process group of its own, so that an interrupt at the terminal is ours to handle. An errno, or 0.
int LineProcess::Spawn(std::vector<std::string>& command, int socket) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  sigset_t none;
  sigemptyset(&none);
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, socket, STDOUT_FILENO);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int error = posix_spawn(&id_, arguments.front(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

LineProcess::~LineProcess() {
  close(socket_);
  if (!has_ended_) kill(id_, SIGKILL);  // it holds nothing
  WaitStatus();
}

int LineProcess::WaitStatus() {
  while (!has_ended_ && waitpid(id_, &status_, 0) < 0 && errno == EINTR) {
  }
  has_ended_ = true;
  return status_;
}

LineProcess::Line LineProcess::Exchange(const std::string& request, double patience) {
  const Clock::time_point deadline = After(patience);
  const End end = Write(request, deadline);
  return end == End::kLine ? Read(deadline) : Line{end, {}};
}

// kLine once all is written.
LineProcess::End LineProcess::Write(const std::string& text, Clock::time_point deadline) {
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t count =
        send(socket_, text.data() + written, text.size() - written, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count > 0) {
      written += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (!Wait(POLLOUT, deadline)) return End::kTimeout;
    } else if (errno != EINTR) {
      return End::kDied;
    }
  }
  return End::kLine;
}

// The next line, without its end.
LineProcess::Line LineProcess::Read(Clock::time_point deadline) {
  while (true) {
    const std::size_t end = received_.find('\n');
    if (end != std::string::npos) {
      Line line{End::kLine, received_.substr(0, end)};
      received_.erase(0, end + 1);
      return line;
    }
    if (!Wait(POLLIN, deadline)) return {End::kTimeout, {}};
    if (!Receive()) return {End::kDied, {}};
  }
}

// False if the deadline comes first. The socket is ready, too, if the process died.
bool LineProcess::Wait(short events, Clock::time_point deadline) const {
  while (true) {
    const double left = std::chrono::duration<double>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd socket = {socket_, events, 0};
    const double milliseconds = std::min(std::ceil(left * 1000), 1e9);
    if (poll(&socket, 1, static_cast<int>(milliseconds)) > 0) return true;
  }
}

// False if there will be nothing more.
bool LineProcess::Receive() {
  std::array<char, 65536> buffer;
  const ssize_t count = recv(socket_, buffer.data(), buffer.size(), 0);
  if (count < 0 && errno == EINTR) return true;
  if (count <= 0) return false;
  received_.append(buffer.data(), static_cast<std::size_t>(count));
  return true;
}

}  // namespace stiction
