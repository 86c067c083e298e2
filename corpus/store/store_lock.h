// SPDX-License-Identifier: Apache-2.0
// One process at a time works on a shard of a store.
//
// Beside the store stands NAME.lock with one line of fixed length for each process that works on it: its shard,
// its process id, host, and since when. While the process lives it holds a lock of the system on its line, so a
// line whose process is gone, however it went, counts for nothing. The first byte of the file is locked by
// whoever reads or adds lines. The last process removes the file.

#pragma once

#include <filesystem>

#include "corpus/descriptor.h"
#include "corpus/store/store.h"

namespace stiction {

class StoreLock {
 public:
  // InputError that names the holder if another process works on units of this shard: shards i/N and j/M share
  // units exactly if i = j modulo gcd(N, M), and the whole store is 0/1. OutputError if the file cannot be
  // made.
  StoreLock(const std::filesystem::path& store, const Shard& shard);
  StoreLock(const StoreLock&) = delete;
  StoreLock& operator=(const StoreLock&) = delete;
  ~StoreLock();

  // Whether any process works on the store.
  static bool IsHeld(const std::filesystem::path& store);

 private:
  void Open();
  void Leave() const;  // removes the file if nobody else works on the store
  int FreeLine(const std::filesystem::path& store, const Shard& shard) const;

  std::filesystem::path file_;
  Descriptor lock_;
};

}  // namespace stiction
