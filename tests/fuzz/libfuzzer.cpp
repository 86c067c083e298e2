// SPDX-License-Identifier: Apache-2.0
// One target as a program of libFuzzer. STICTION_FUZZ_RUN is its function. What it throws ends the process, and
// libFuzzer writes the input to a file.

#include <cstdint>
#include <cstring>
#include <string>

#include "tests/fuzz/json_mutation.h"
#include "tests/fuzz/targets.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  stiction::fuzz::STICTION_FUZZ_RUN({reinterpret_cast<const char*>(data), size});
  return 0;
}

// Documents are changed as documents twice out of three times, everything else byte by byte.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  stiction::Choices choices(seed);
  const std::string text(reinterpret_cast<const char*>(data), size);
  const bool document = text.starts_with('{') || text.starts_with('[');
  if (!document || choices.Integer(0, 2) == 0) return LLVMFuzzerMutate(data, size, most);
  const std::string other = stiction::fuzz::MutatedJson(text, choices);
  if (other == text || other.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::memcpy(data, other.data(), other.size());
  return other.size();
}
