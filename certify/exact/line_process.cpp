// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/line_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "certify/exact/process_guard.h"
#include "corpus/input_error.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

constexpr double kLook = 0.05;            // seconds between looks at `stopped`
constexpr double kPatienceOfEnd = 1;      // for the end of a process whose output ended
constexpr double kPatienceOfGuard = 1.2;  // which gives up after one
constexpr double kPatienceOfStart = 60;
constexpr const char* kMark = "STICTION_MARK";

// Behind standard input, output and error, one of which may be closed.
Descriptor Behind(int number) {
  if (number > STDERR_FILENO) return Descriptor(number);
  const Descriptor low(number);
  return Descriptor(fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
}

std::array<Descriptor, 2> SocketPair() {
  std::array<int, 2> ends;
  STICTION_CHECK(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0, std::strerror(errno));
  return {Behind(ends[0]), Behind(ends[1])};
}

std::array<Descriptor, 2> Pipe() {
  std::array<int, 2> ends;
  STICTION_CHECK(pipe2(ends.data(), O_CLOEXEC) == 0, std::strerror(errno));
  std::array<Descriptor, 2> pipe = {Behind(ends[0]), Behind(ends[1])};
  fcntl(pipe[0].number(), F_SETFL, O_NONBLOCK);
  return pipe;
}

std::string NewMark() {
  static std::atomic<int> count = 0;
  return fmt::format("{}={}.{}.", kMark, getpid(), ++count);
}

std::vector<char*> EnvironmentWith(std::string& mark) {
  std::vector<char*> environment;
  for (char** variable = environ; *variable != nullptr; ++variable)
    if (!std::string_view(*variable).starts_with(kMark)) environment.push_back(*variable);
  environment.push_back(mark.data());
  environment.push_back(nullptr);
  return environment;
}

}  // namespace

LineProcess::Clock::time_point LineProcess::After(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

LineProcess::LineProcess(std::vector<std::string> command, const std::string& expected, LineBounds bounds)
    : bounds_(std::move(bounds)), mark_(NewMark()) {
  try {
    Start(command, expected);
  } catch (...) {
    EndGuard();
    throw;
  }
}

void LineProcess::Start(const std::vector<std::string>& command, const std::string& expected) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const std::vector<char*> environment = EnvironmentWith(mark_);
  std::array<Descriptor, 2> socket = SocketPair(), control = SocketPair(), errors;
  if (bounds_.errors) errors = Pipe();
  guard_ = fork();
  if (guard_ == 0)
    Guard({control[1].number(), socket[1].number(), errors[1].number()}, arguments.data(), environment.data());
  const int error = guard_ < 0 ? errno : 0;
  STICTION_CHECK(guard_ > 0, fmt::format("no new process: {}", std::strerror(error)));
  socket_ = std::move(socket[0]);
  control_ = std::move(control[0]);
  errors_ = std::move(errors[0]);
  GuardMessage message = {GuardWord::kFailed, ECHILD};
  pollfd line = {control_.number(), POLLIN, 0};
  while (poll(&line, 1, static_cast<int>(kPatienceOfStart * 1000)) < 0 && errno == EINTR) {
  }
  if (recv(control_.number(), &message, sizeof message, MSG_DONTWAIT) != sizeof message)
    message = {GuardWord::kFailed, ETIMEDOUT};
  if (message.word == GuardWord::kStarted) {
    id_ = message.value;
    return;
  }
  throw InputError(fmt::format("{}: cannot be run: {}; expected {}", command.front(),
                               std::strerror(message.value), expected));
}

LineProcess::~LineProcess() { EndGuard(); }

// The guard ends once it has killed all; one that was stopped or killed itself is not waited for.
void LineProcess::EndGuard() {
  if (guard_ <= 0) return;
  PassErrors();
  shutdown(control_.number(), SHUT_WR);
  kill(guard_, SIGCONT);  // the program may have stopped it
  const auto deadline = After(kPatienceOfGuard);
  bool has_ended = false;
  while (!has_ended && Clock::now() < deadline) {
    std::array<char, 256> rest;
    pollfd line = {control_.number(), POLLIN, 0};
    if (poll(&line, 1, 100) <= 0) continue;
    const ssize_t count = recv(control_.number(), rest.data(), rest.size(), MSG_DONTWAIT);
    has_ended = count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR);
  }
  if (!has_ended) kill(guard_, SIGKILL);
  int status = 0;
  while (waitpid(guard_, &status, 0) < 0 && errno == EINTR) {
  }
  guard_ = -1;
  if (!WIFSIGNALED(status)) return;
  if (id_ > 0) kill(-id_, SIGKILL);
  KillMarked(mark_);
}

std::optional<int> LineProcess::WaitStatus() {
  const auto deadline = After(kPatienceOfEnd);
  while (!status_ && is_guarded_ && Clock::now() < deadline && !IsStopped()) {
    pollfd line = {control_.number(), POLLIN, 0};
    poll(&line, 1, static_cast<int>(kLook * 1000));
    Listen();
  }
  PassErrors();
  return status_;
}

// What the guard tells.
void LineProcess::Listen() {
  GuardMessage message = {};
  const ssize_t count = recv(control_.number(), &message, sizeof message, MSG_DONTWAIT);
  if (count == sizeof message) {
    if (message.word == GuardWord::kEnded) status_ = message.value;
  } else if (count >= 0 || (errno != EAGAIN && errno != EINTR)) {
    is_guarded_ = false;
  }
}

void LineProcess::PassErrors() {
  if (!errors_.valid()) return;
  std::array<char, 65536> buffer;
  const ssize_t count = read(errors_.number(), buffer.data(), buffer.size());
  if (count > 0) bounds_.errors({buffer.data(), static_cast<std::size_t>(count)});
  if (count == 0) errors_ = Descriptor();  // ended
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
        send(socket_.number(), text.data() + written, text.size() - written, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count > 0) {
      written += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (IsStopped()) return End::kStopped;
      if (status_ || !is_guarded_) return End::kDied;
      if (!Wait(POLLOUT, deadline)) return End::kTimeout;
    } else if (errno != EINTR) {
      return End::kDied;
    }
  }
  return End::kLine;
}

// The next line, without its end. Each byte is looked at once.
LineProcess::Line LineProcess::Read(Clock::time_point deadline) {
  while (true) {
    const std::size_t end = received_.find('\n', scanned_);
    if (end != std::string::npos) {
      scanned_ = 0;
      Line line{End::kLine, received_.substr(0, end)};
      received_.erase(0, end + 1);
      return line;
    }
    scanned_ = received_.size();
    if (scanned_ > bounds_.line) return {End::kFlood, {}};
    if (IsStopped()) return {End::kStopped, {}};
    if (!Wait(POLLIN, deadline)) return {End::kTimeout, {}};
    const bool may_be_last = status_ || !is_guarded_;
    if (is_readable_ ? !Receive() : may_be_last) return {End::kDied, {}};
  }
}

bool LineProcess::HasMore() {
  pollfd socket = {socket_.number(), POLLIN, 0};
  if (received_.empty() && poll(&socket, 1, 0) > 0 && (socket.revents & POLLIN) != 0) Receive();
  return !received_.empty();
}

// False if the deadline comes first. True after each look: perhaps the socket is ready, perhaps the process
// ended.
bool LineProcess::Wait(short events, Clock::time_point deadline) {
  const double left = std::chrono::duration<double>(deadline - Clock::now()).count();
  if (left <= 0) return false;
  std::array<pollfd, 3> files = {pollfd{socket_.number(), events, 0},
                                 pollfd{status_ || !is_guarded_ ? -1 : control_.number(), POLLIN, 0},
                                 pollfd{errors_.number(), POLLIN, 0}};
  const double milliseconds = std::ceil(1000 * std::min(left, status_ || !is_guarded_ ? 0 : kLook));
  const int ready = poll(files.data(), files.size(), static_cast<int>(milliseconds));
  is_readable_ = ready > 0 && files[0].revents != 0;
  if (ready > 0 && files[1].revents != 0) Listen();
  if (ready > 0 && files[2].revents != 0) PassErrors();
  // The last of what it wrote may have come between the look and its end.
  if (!is_readable_ && (status_ || !is_guarded_)) is_readable_ = poll(files.data(), 1, 0) > 0;
  return true;
}

// False if there will be nothing more.
bool LineProcess::Receive() {
  std::array<char, 65536> buffer;
  const ssize_t count = recv(socket_.number(), buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return true;
  if (count <= 0) return false;
  received_.append(buffer.data(), static_cast<std::size_t>(count));
  return true;
}

}  // namespace stiction
