// SPDX-License-Identifier: Apache-2.0
// An open file that closes itself, and a text that is written to one.

#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <utility>

namespace stiction {

class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }

  int number() const { return number_; }
  bool valid() const { return number_ >= 0; }
  // Now, and what close says: 0 or -1 with errno.
  int Close() { return close(std::exchange(number_, -1)); }

 private:
  int number_ = -1;
};

// All of it; false where that cannot be, and errno says why.
inline bool WriteAll(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// A file in memory with this text, at its beginning; not valid where there is no memory for it.
inline Descriptor FileInMemory(const char* name, std::string_view text = {}) {
  Descriptor file(memfd_create(name, MFD_CLOEXEC));
  if (!file.valid() || !WriteAll(file.number(), text)) return {};
  lseek(file.number(), 0, SEEK_SET);
  return file;
}

}  // namespace stiction
