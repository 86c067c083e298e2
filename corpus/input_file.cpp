// SPDX-License-Identifier: Apache-2.0
#include "corpus/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "corpus/descriptor.h"
#include "corpus/input_error.h"

namespace stiction {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Refuse(const fs::path& file, const std::string& reason) {
  const std::string name = file == "-" ? "standard input" : file.empty() ? "''" : file.string();
  throw InputError(name + ": found nothing to read (" + reason + "), expected a file");
}

// What a process has open may be a pipe; a pipe with a name of its own may wait for ever.
bool IsOpenAlready(const fs::path& file) {
  return file == "-" || file == "/dev/stdin" || file.native().starts_with("/dev/fd/") ||
         file.native().starts_with("/proc/self/fd/");
}

std::string TooLarge(std::size_t most) { return fmt::format("more than {} bytes", most); }

void RefuseKind(const fs::path& file, int descriptor, std::size_t most) {
  struct stat status = {};
  if (fstat(descriptor, &status) != 0) Refuse(file, std::strerror(errno));
  const mode_t mode = status.st_mode;
  if (S_ISDIR(mode)) Refuse(file, "a directory");
  if (S_ISFIFO(mode) && !IsOpenAlready(file)) Refuse(file, "a named pipe");
  if (S_ISBLK(mode) || (S_ISCHR(mode) && isatty(descriptor) == 0)) Refuse(file, "a device");
  if (S_ISREG(mode) && static_cast<std::size_t>(status.st_size) > most) Refuse(file, TooLarge(most));
}

std::string ReadAll(const fs::path& file, int descriptor, std::size_t most) {
  RefuseKind(file, descriptor, most);
  std::string text;
  std::vector<char> buffer(1 << 16);
  for (;;) {
    const ssize_t size = read(descriptor, buffer.data(), buffer.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) Refuse(file, std::strerror(errno));
    if (size == 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(size));
    if (text.size() > most) Refuse(file, TooLarge(most));
  }
}

}  // namespace

std::string ReadInput(const fs::path& file, std::size_t most) {
  if (file == "-" || file == "/dev/stdin") {
    static const std::string text = ReadAll("-", STDIN_FILENO, most);
    return text;
  }
  // Without O_NONBLOCK a named pipe would keep us here.
  const Descriptor in(open(file.c_str(), O_RDONLY | O_CLOEXEC | (IsOpenAlready(file) ? 0 : O_NONBLOCK)));
  if (!in.valid()) Refuse(file, std::strerror(errno));
  return ReadAll(file, in.number(), most);
}

}  // namespace stiction
