// SPDX-License-Identifier: Apache-2.0
#include "search/units/known_signatures.h"

#include <algorithm>
#include <array>

namespace stiction {
namespace {

constexpr std::array<KnownSignature, 17> kKnown = {{
    {"cycle-2c-4d-10s-49a1b31911ac6e78", "two-contact-cycle"},
    {"cycle-2c-4d-10s-aceed2539a95827b", "cycle-or-ray-without-solution"},
    {"cycle-2c-4d-12s-6c339e38a865485c", "smallest-integers"},
    {"cycle-2c-4d-12s-d3aa06422cc47629", "cycle-beside-a-sliding-contact"},
    {"cycle-2c-4d-12s-df923e9a321e6c00", "two-contact-cycle-every-policy-period-4"},
    {"cycle-2c-4d-12s-ee2ae7330dac5a58", "cycle-or-singular-by-policy"},
    {"cycle-2c-4d-14s-350cd3f1c5aed0a7", "two-contact-cycle-every-policy-14-steps"},
    {"cycle-2c-5d-13s-64e5a8995472f145", "two-contact-cycle-found-in-a-body-scene"},
    {"cycle-2c-5d-13s-994636d6770d0838", "two-contact-cycle-13-steps"},
    {"cycle-2c-5d-14s-21b4719a551a063b", "cycle-every-policy-sparse"},
    {"cycle-2c-5d-14s-5f9735605f2f0725", "cycle-every-policy-mu-1"},
    {"cycle-2c-5d-14s-5f9735605f2f0725", "two-contact-cycle-every-policy-period-5"},
    {"cycle-2c-5d-14s-b25341001876a8e6", "cycle-of-a-block-in-a-valley"},
    {"cycle-3c-3d-10s", "cycle-of-sliding-contacts"},
    {"cycle-3c-3d-12s", "three-contact-cycle-with-a-frictionless-one"},
    {"cycle-3c-6d-15s", "safe-tie-cycle-3-contacts"},
    {"cycle-6c-6d-18s", "safe-tie-cycle-7-contacts"},
}};

}  // namespace

std::span<const KnownSignature> KnownSignatures() { return kKnown; }

std::string_view KnownAs(std::string_view signature) {
  const std::string_view alone = signature.substr(0, signature.find('@'));
  const auto known =
      std::find_if(kKnown.begin(), kKnown.end(), [alone](const auto& row) { return row.signature == alone; });
  return known == kKnown.end() ? std::string_view() : known->name;
}

}  // namespace stiction
