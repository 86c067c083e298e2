// SPDX-License-Identifier: Apache-2.0
// The signatures of the loops of the corpus, so that a search can tell what is new from what is known. With
// more than two contacts a signature is only counts (signature.h), and so is what it is known by.

#pragma once

#include <span>
#include <string_view>

namespace stiction {

struct KnownSignature {
  std::string_view signature;  // under the policy `paper`
  std::string_view name;       // of a case in corpus/ or corpus/sliding/
};

// By signature, then by name; a test holds them against the corpus.
std::span<const KnownSignature> KnownSignatures();

// The first case with this signature, also under another policy; empty if there is none.
std::string_view KnownAs(std::string_view signature);

}  // namespace stiction
