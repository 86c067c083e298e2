// SPDX-License-Identifier: Apache-2.0
// Fields of a record, each described once, below the record itself: by a row of its table files are read,
// written and checked, and options, labels of pages and schemas are made.
//
//   struct Campaign { std::int64_t audit_every = 5000; };
//   inline constexpr auto kCampaignFields = std::to_array<FieldOf<Campaign>>({
//       {"audit_every", &Campaign::audit_every, "audited: one problem in", "run one problem in so many
//       exactly"}});
//
// fields.ipp reads and writes; cli/search.cpp makes options.

#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace stiction {

class JsonPlace;

// What a file has of a value that is more than a number, a truth or a text.
template <class R>
struct FormOf {
  std::string_view shape;  // cli/schema.h
  void (*read)(const JsonPlace& place, R& record);
  nlohmann::ordered_json (*write)(const R& record);  // null: left out
};

enum class FieldUse : std::uint8_t {
  kDefines,  // records that differ in it are different
  kApart,    // the same, and it is kept beside the definition
  kRemark,   // says nothing of what is done
};

// The largest integer that every program reads as it is.
inline constexpr std::int64_t kMostOfField = std::int64_t{1} << 53;

template <class R>
struct FieldOf {
  using Integer = std::int64_t& (*)(R&);

  std::string_view name;  // key of a file, keyword in Python; "audit_every" is the option --audit-every
  std::variant<std::int64_t R::*, Integer, std::uint64_t R::*, bool R::*, std::string R::*, const FormOf<R>*>
      at;
  std::string_view label = {};    // on pages; empty: the name
  std::string_view help = {};     // of its option; empty: it has none of that name
  std::string_view details = {};  // what more its help says
  FieldUse use = FieldUse::kDefines;
  // Of an integer: its range, and the value that is left out. A text is one line.
  std::int64_t least = 1, most = kMostOfField;
  std::optional<std::int64_t> unsaid = {};
};

// A member of what is printed and never read, with its shape (cli/schema.h): "rung?" is left out where it is
// null.
template <class R>
struct ToldOf {
  std::string_view name, shape, help;
  nlohmann::ordered_json (*write)(const R& record);
};

inline constexpr std::size_t kMostBytesOfLine = 200;

}  // namespace stiction
