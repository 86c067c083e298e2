// SPDX-License-Identifier: Apache-2.0
// An open file that closes itself.

#ifndef STICTION_CORPUS_DESCRIPTOR_H_
#define STICTION_CORPUS_DESCRIPTOR_H_

#include <unistd.h>

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

}  // namespace stiction

#endif  // STICTION_CORPUS_DESCRIPTOR_H_
