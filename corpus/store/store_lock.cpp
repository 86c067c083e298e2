// SPDX-License-Identifier: Apache-2.0
#include "corpus/store/store_lock.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <numeric>
#include <optional>
#include <string>

#include "corpus/atomic_file.h"
#include "corpus/input_error.h"

namespace stiction {
namespace {

constexpr int kLine = 256;  // bytes

// The first line is for the file itself.
constexpr off_t Start(int line) { return static_cast<off_t>(line) * kLine; }

struct flock Range(short type, int line) {
  struct flock range = {};
  range.l_type = type;
  range.l_whence = SEEK_SET;
  range.l_start = Start(line);
  range.l_len = 1;
  return range;
}

bool IsHeldByAnother(int file, int line) {
  struct flock range = Range(F_WRLCK, line);
  return fcntl(file, F_OFD_GETLK, &range) == 0 && range.l_type != F_UNLCK;
}

int SetLock(int file, int line, short type, int command) {
  struct flock range = Range(type, line);
  int status = 0;
  do status = fcntl(file, command, &range);
  while (status != 0 && errno == EINTR);
  return status;
}

bool ShareUnits(const Shard& left, const Shard& right) {
  return (left.index - right.index) % std::gcd(left.count, right.count) == 0;
}

std::string LineOf(const Shard& shard) {
  std::array<char, 65> host = {};
  gethostname(host.data(), host.size() - 1);
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  const std::string line = fmt::format("{}/{} process {} on {} since {:%Y-%m-%d %H:%M:%S} UTC", shard.index,
                                       shard.count, getpid(), host.data(), fmt::gmtime(now));
  return fmt::format("{:<{}}\n", line, kLine - 1);
}

struct Holder {
  Shard shard;
  std::string who;
};

// Empty at the end of the file.
std::optional<Holder> ReadLine(int file, int line) {
  std::string text(kLine, ' ');
  if (pread(file, text.data(), kLine, Start(line)) != kLine) return std::nullopt;
  Holder holder;
  int end = 0;
  if (std::sscanf(text.c_str(), "%d/%d %n", &holder.shard.index, &holder.shard.count, &end) != 2 ||
      holder.shard.count < 1)
    holder.shard = {};
  holder.who = text.substr(end, text.find_last_not_of(" \n") + 1 - end);
  return holder;
}

// A lock has this name alone, and nothing in its first byte. A link would have us write into what it leads to.
bool IsLock(int file) {
  struct stat status = {};
  char first = 0;
  return fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink <= 1 &&
         pread(file, &first, 1, 0) >= 0 && first == 0;
}

bool IsSameFile(int file, const std::filesystem::path& name) {
  struct stat opened = {}, named = {};
  return fstat(file, &opened) == 0 && lstat(name.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

}  // namespace

StoreLock::StoreLock(const std::filesystem::path& store, const Shard& shard) : file_(store) {
  file_ += ".lock";
  Open();
  const int line = FreeLine(store, shard);
  const std::string text = LineOf(shard);
  if (pwrite(lock_.number(), text.data(), text.size(), Start(line)) != kLine ||
      SetLock(lock_.number(), line, F_WRLCK, F_OFD_SETLK) != 0) {
    const int error = errno;
    Leave();
    RefuseOutput(file_, error);
  }
  SetLock(lock_.number(), 0, F_UNLCK, F_OFD_SETLK);
}

// The file that has the name, and its first byte.
void StoreLock::Open() {
  do {
    lock_ = Descriptor(open(file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666));
    if (lock_.valid() ? !IsLock(lock_.number()) : errno == ELOOP) {
      throw InputError(
          fmt::format("{}: found a link or another file, expected the lock of a store or nothing: "
                      "move it away",
                      file_.string()));
    }
    if (!lock_.valid() || SetLock(lock_.number(), 0, F_WRLCK, F_OFD_SETLKW) != 0) RefuseOutput(file_, errno);
  } while (!IsSameFile(lock_.number(), file_));  // removed by its last holder meanwhile
}

// The first line that no process holds; InputError if one that shares units with the shard is held.
int StoreLock::FreeLine(const std::filesystem::path& store, const Shard& shard) const {
  int free = 0, line = 1;
  for (; const auto holder = ReadLine(lock_.number(), line); ++line) {
    if (!IsHeldByAnother(lock_.number(), line)) {
      if (free == 0) free = line;
    } else if (ShareUnits(holder->shard, shard)) {
      throw InputError(fmt::format("{}: shard {}/{}: found {} at work on shard {}/{}, expected nobody",
                                   store.string(), shard.index, shard.count, holder->who, holder->shard.index,
                                   holder->shard.count));
    }
  }
  return free > 0 ? free : line;
}

bool StoreLock::IsHeld(const std::filesystem::path& store) {
  const Descriptor file(
      open((store.string() + ".lock").c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  bool held = false;
  for (int line = 1; file.valid() && IsLock(file.number()) && !held && ReadLine(file.number(), line); ++line)
    held = IsHeldByAnother(file.number(), line);
  return held;
}

StoreLock::~StoreLock() { Leave(); }

void StoreLock::Leave() const {
  if (!lock_.valid() || SetLock(lock_.number(), 0, F_WRLCK, F_OFD_SETLKW) != 0) return;
  bool alone = true;
  for (int line = 1; ReadLine(lock_.number(), line); ++line) alone &= !IsHeldByAnother(lock_.number(), line);
  if (alone) unlink(file_.c_str());
}

}  // namespace stiction
