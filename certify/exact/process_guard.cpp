// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/process_guard.h"

#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

namespace stiction {
namespace {

constexpr int kMostOfCleaning = 200;  // turns, of 5 ms at most

void Ignore(int) {}

void Tell(int control, GuardWord word, int value) {
  const GuardMessage message = {word, value};
  while (send(control, &message, sizeof message, MSG_NOSIGNAL) < 0 && errno == EINTR) {
  }
}

// All but the three; the store of a search, and the lock on it, must not live as long as the guard does.
void CloseOthers(const GuardFiles& files) {
  std::array<int, 3> kept = {files.control, files.socket, files.errors};
  std::sort(kept.begin(), kept.end());
  unsigned first = STDERR_FILENO + 1;
  for (const int file : kept) {
    if (file < static_cast<int>(first)) continue;
    if (file > static_cast<int>(first)) syscall(SYS_close_range, first, file - 1, 0);
    first = static_cast<unsigned>(file) + 1;
  }
  syscall(SYS_close_range, first, ~0U, 0);
}

// In the child that becomes the program. What cannot be run is told as an errno.
[[noreturn]] void Become(const GuardFiles& files, pid_t guard, int failure, char* const* arguments,
                         char* const* environment) {
  setsid();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != guard) _exit(127);  // it died before that
  const rlimit none = {0, 0};
  setrlimit(RLIMIT_CORE, &none);
  struct sigaction usual = {};
  usual.sa_handler = SIG_DFL;
  for (int number = 1; number < NSIG; ++number) sigaction(number, &usual, nullptr);
  sigset_t empty;
  sigemptyset(&empty);
  sigprocmask(SIG_SETMASK, &empty, nullptr);
  dup2(files.socket, STDIN_FILENO);
  dup2(files.socket, STDOUT_FILENO);
  if (files.errors >= 0) dup2(files.errors, STDERR_FILENO);
  execve(arguments[0], arguments, environment);
  const int error = errno;
  [[maybe_unused]] const ssize_t written = write(failure, &error, sizeof error);
  _exit(127);
}

// Its id, or 0 if it cannot be run, which is told.
pid_t StartProgram(const GuardFiles& files, char* const* arguments, char* const* environment) {
  std::array<int, 2> failure = {-1, -1};  // closed by a program that runs
  const pid_t guard = getpid();
  const bool has_pipe = pipe2(failure.data(), O_CLOEXEC) == 0;
  const pid_t program = has_pipe ? fork() : -1;
  if (program == 0) Become(files, guard, failure[1], arguments, environment);
  int error = program < 0 ? errno : 0;
  if (has_pipe) close(failure[1]);
  if (program > 0)
    while (read(failure[0], &error, sizeof error) < 0 && errno == EINTR) {
    }
  if (has_pipe) close(failure[0]);
  Tell(files.control, error == 0 ? GuardWord::kStarted : GuardWord::kFailed, error == 0 ? program : error);
  return error == 0 ? program : 0;
}

// The number behind the name of a program in /proc/ID/stat: state, then parent. -1 of what is gone.
pid_t ParentOf(const char* id) {
  std::array<char, 64> name = {"/proc/"};
  std::size_t end = 6;
  for (; *id != 0 && end < 40; ++id) name[end++] = *id;
  for (const char* rest = "/stat"; *rest != 0; ++rest) name[end++] = *rest;
  const int file = open(name.data(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return -1;
  std::array<char, 512> text = {};
  const ssize_t size = read(file, text.data(), text.size() - 1);
  close(file);
  ssize_t at = size - 1;
  while (at > 0 && text[static_cast<std::size_t>(at)] != ')') --at;
  pid_t parent = 0;
  for (ssize_t i = at + 4; at > 0 && i < size && text[static_cast<std::size_t>(i)] >= '0'; ++i)
    parent = 10 * parent + (text[static_cast<std::size_t>(i)] - '0');
  return parent;
}

struct DirectoryEntry {  // of getdents64
  std::uint64_t inode;
  std::int64_t offset;
  unsigned short length;
  unsigned char type;
  char name[1];
};

void KillChildren() {
  const int folder = open("/proc", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  const pid_t self = getpid();
  alignas(DirectoryEntry) std::array<char, 8192> entries;
  for (long size; (size = syscall(SYS_getdents64, folder, entries.data(), entries.size())) > 0;) {
    for (long at = 0; at < size;) {
      const auto* entry = reinterpret_cast<const DirectoryEntry*>(entries.data() + at);
      at += entry->length;
      if (entry->name[0] < '1' || entry->name[0] > '9' || ParentOf(entry->name) != self) continue;
      pid_t child = 0;
      for (const char* digit = entry->name; *digit != 0; ++digit) child = 10 * child + (*digit - '0');
      kill(child, SIGKILL);
    }
  }
  close(folder);
}

// Until there is no child left; what the kernel itself does not let go of is left to it after a second.
void KillAll(pid_t program, const sigset_t& waiting) {
  kill(-program, SIGKILL);
  for (int turn = 0; turn < kMostOfCleaning; ++turn) {
    pid_t ended = 0;
    while ((ended = waitpid(-1, nullptr, WNOHANG)) > 0) {
    }
    if (ended < 0 && errno == ECHILD) return;
    if (turn > 0) KillChildren();
    const timespec pause = {0, 5'000'000};
    ppoll(nullptr, 0, &pause, &waiting);  // a child that ends is a signal
  }
}

// What has ended. The program stays a zombie, so that its group is nobody else's, until all are killed.
void Reap(pid_t program, int control, bool& ended) {
  siginfo_t info = {};
  if (ended || waitid(P_PID, static_cast<id_t>(program), &info, WEXITED | WNOHANG | WNOWAIT) != 0) return;
  if (info.si_pid == program) {
    const int number = info.si_status;
    Tell(control, GuardWord::kEnded, info.si_code == CLD_EXITED ? W_EXITCODE(number, 0) : number);
    ended = true;
    return;
  }
  int status = 0;
  for (pid_t child; !ended && (child = waitpid(-1, &status, WNOHANG)) > 0;) {
    if (child != program) continue;
    Tell(control, GuardWord::kEnded, status);
    ended = true;
  }
}

// Whether there were any.
bool KillMarkedOnce(std::string_view mark) {
  bool found = false;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
    const std::string name = entry.path().filename();
    if (std::isdigit(static_cast<unsigned char>(name[0])) == 0) continue;
    std::ifstream file(entry.path() / "environ", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (text.find(mark) == std::string::npos) continue;
    found = true;
    kill(std::atoi(name.c_str()), SIGKILL);
  }
  return found;
}

}  // namespace

void Guard(const GuardFiles& files, char* const* arguments, char* const* environment) {
  sigset_t all, waiting;
  sigfillset(&all);
  sigfillset(&waiting);
  sigdelset(&waiting, SIGCHLD);
  sigprocmask(SIG_SETMASK, &all, nullptr);
  struct sigaction wake = {};
  wake.sa_handler = Ignore;
  sigaction(SIGCHLD, &wake, nullptr);
  setsid();
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  CloseOthers(files);
  const pid_t program = StartProgram(files, arguments, environment);
  if (program == 0) _exit(0);
  close(files.socket);
  if (files.errors >= 0) close(files.errors);
  bool ended = false;
  while (true) {
    Reap(program, files.control, ended);
    pollfd line = {files.control, POLLIN, 0};
    const int ready = ppoll(&line, 1, nullptr, &waiting);
    if (ready > 0 || (ready < 0 && errno != EINTR)) break;  // closed: nothing is ever said
  }
  KillAll(program, waiting);
  _exit(0);
}

void KillMarked(std::string_view mark) {
  constexpr int kMost = 100, kQuiet = 5;  // looks: a process that begins while one goes on may not be seen
  constexpr auto kBetween = std::chrono::milliseconds(20);
  int quiet = 0;
  for (int look = 0; look < kMost && quiet < kQuiet; ++look) {
    if (look > 0) std::this_thread::sleep_for(kBetween);
    quiet = KillMarkedOnce(mark) ? 0 : quiet + 1;
  }
}

}  // namespace stiction
