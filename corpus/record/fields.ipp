// SPDX-License-Identifier: Apache-2.0
// Reading, writing and shapes of records that are described by fields.

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <type_traits>

#include "corpus/json_text.h"
#include "corpus/record/fields.h"

namespace stiction {

// One line that JSON can have, not too long.
inline bool IsLine(const std::string& text) {
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  return text.size() <= kMostBytesOfLine && std::ranges::none_of(text, is_control) && IsUtf8(text);
}
inline const std::string kLineExpected = fmt::format("one line of text of at most {} bytes", kMostBytesOfLine);

// act(value), of what a field stands for; or act(form).
template <class R, class Act>
auto WithValue(const FieldOf<R>& field, R& record, const Act& act) {
  return std::visit(
      [&](const auto at) {
        if constexpr (std::is_same_v<decltype(at), const typename FieldOf<R>::Integer>)
          return act(at(record));
        else if constexpr (std::is_member_pointer_v<decltype(at)>)
          return act(record.*at);
        else
          return act(*at);
      },
      field.at);
}

template <class R>
void ReadField(const FieldOf<R>& field, const JsonPlace& place, R& record) {
  WithValue(field, record, [&](auto& value) {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, FormOf<R>>) {
      value.read(place, record);
    } else if constexpr (std::is_same_v<Value, bool>) {
      value = place.Truth();
    } else if constexpr (std::is_same_v<Value, std::string>) {
      value = place.Text(kLineExpected);
      if (!IsLine(value)) place.Refuse(kLineExpected);
    } else {
      const std::string expected = fmt::format("an integer from {} to {}", field.least, field.most);
      value = static_cast<Value>(place.Integer(field.least, field.most, expected));
    }
  });
}

// Null: left out.
template <class R>
Json WriteField(const FieldOf<R>& field, R record) {
  return WithValue(field, record, [&](const auto& value) -> Json {
    using Value = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, FormOf<R>>)
      return value.write(record);
    else if constexpr (std::is_same_v<Value, bool>)
      return value ? Json(true) : Json();
    else if constexpr (std::is_same_v<Value, std::string>)
      return value.empty() ? Json() : Json(value);
    else
      return field.unsaid && std::cmp_equal(value, *field.unsaid) ? Json() : Json(value);
  });
}

// What a file leaves out stays as it is. `others`: keys that stand beside the fields. What is wrong with the
// keys and with any field goes to `faults`.
template <class R>
void ReadFields(std::span<const FieldOf<R>> fields, const JsonPlace& root, R& record, Faults& faults,
                std::vector<std::string> others = {}) {
  for (const FieldOf<R>& field : fields) others.emplace_back(field.name);
  faults.Try([&] { root.AllowKeys(others); });
  for (const FieldOf<R>& field : fields) {
    faults.Try([&] {
      if (const auto place = root.Optional(std::string(field.name))) ReadField(field, *place, record);
    });
  }
}

// Those of one use, added to an object.
template <class R>
void WriteFields(std::span<const FieldOf<R>> fields, FieldUse use, const R& record, Json& json) {
  for (const FieldOf<R>& field : fields) {
    if (field.use != use) continue;
    if (Json value = WriteField(field, record); !value.is_null())
      json[std::string(field.name)] = std::move(value);
  }
}

// "{audit_every?: integer 1..9, ...}", with the members of `others` before.
template <class R>
std::string ShapeOf(std::span<const FieldOf<R>> fields, const std::string& others) {
  std::string shape = "{" + others;
  R record;
  for (const FieldOf<R>& field : fields) {
    shape +=
        fmt::format(", {}?: {}", field.name, WithValue(field, record, [&](const auto& value) -> std::string {
                      using Value = std::remove_cvref_t<decltype(value)>;
                      if constexpr (std::is_same_v<Value, FormOf<R>>)
                        return std::string(value.shape);
                      else if constexpr (std::is_same_v<Value, bool>)
                        return "truth";
                      else if constexpr (std::is_same_v<Value, std::string>)
                        return "text";
                      else
                        return fmt::format("integer {}..{}", field.least, field.most);
                    }));
    const std::string_view means = field.help.empty() ? field.label : field.help;
    if (!means.empty()) shape += fmt::format("  // {}\n", means);
  }
  return shape + "}";
}

template <class R>
void WriteTold(std::span<const ToldOf<R>> members, const R& record, Json& json) {
  for (const ToldOf<R>& member : members) {
    Json value = member.write(record);
    const bool may_lack = member.name.back() == '?';
    if (may_lack && value.is_null()) continue;
    json[std::string(member.name.substr(0, member.name.size() - may_lack))] = std::move(value);
  }
}

template <class R>
std::string ShapeOf(std::span<const ToldOf<R>> members) {
  std::string shape = "{";
  for (const ToldOf<R>& member : members) {
    shape += fmt::format("{}: {},", member.name, member.shape);
    shape += member.help.empty() ? " " : fmt::format("  // {}\n", member.help);
  }
  return shape + "}";
}

}  // namespace stiction
