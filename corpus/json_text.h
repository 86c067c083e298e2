// SPDX-License-Identifier: Apache-2.0
// JSON text, read strictly and without loss, and places in it. json.h has the values themselves.
//
// What nlohmann lets pass is refused here: duplicate keys, integers that would silently be rounded to a
// double, a NUL byte (which would end the text), and nesting deep enough to overflow the stack.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "corpus/input_error.h"

namespace stiction {

using Json = nlohmann::ordered_json;

class SharedJson;
using JsonMember =
    std::pair<std::string_view, std::variant<bool, std::int64_t, std::uint64_t, double, std::string_view,
                                             std::vector<std::int64_t>, std::vector<double>,
                                             std::vector<std::string>, SharedJson, std::vector<SharedJson>>>;

// A value that is handed on: copies share it, and who only makes objects and lists of values needs no json.h. A
// reference to what a temporary one holds dangles.
class SharedJson {
 public:
  SharedJson();                                           // null
  SharedJson(std::initializer_list<JsonMember> members);  // an object
  explicit SharedJson(const std::vector<SharedJson>& list);
  explicit SharedJson(const std::string& text);
  explicit SharedJson(double number);
  static SharedJson Object() { return std::initializer_list<JsonMember>(); }
  SharedJson(const Json& value);
  SharedJson(Json&& value);
  operator const Json&() const { return *value_; }
  const Json& operator*() const { return *value_; }
  const Json* operator->() const { return value_.get(); }
  explicit operator bool() const;  // whether it is not null
  // Adds the members of an object to this one or to null; other copies stay as they are.
  void Add(const SharedJson& members);

 private:
  std::shared_ptr<const Json> value_;
};

// Arrays and objects within each other, the document included.
inline constexpr std::size_t kMaxJsonDepth = 100;

// The document; `source` names the text in errors. Syntax errors come with line and column (in bytes),
// everything else with its JSON path. Integers of 64 bits are kept as they are; a longer one is refused
// unless it is a double exactly. Other numbers become the nearest double; one that is too large is refused, and
// one that is not 0 and would become 0.
Json ParseJson(std::string_view text, const std::string& source);

// The bytes of a file; InputError if it cannot be read.
std::string ReadText(const std::filesystem::path& file);

// The text of `value`, on one line if `indent` is negative: always JSON, whatever the value holds. Every text
// of ours is made here. Bytes that are no UTF-8, as a file or its name may have, become U+FFFD; numbers that
// are not finite, for which nlohmann would write `null`, become "inf", "-inf" and "nan" (NumberToJson).
std::string JsonText(const Json& value, int indent = -1);

// Whether all text in it is, a string's own included.
bool IsUtf8(const Json& value);
// Of what is read again: InternalError where its text would say something else.
void RequireWritable(const Json& value);

// `value` on one line, cut if it is long: for messages only.
std::string Shown(const Json& value);
// `text` cut to `most` bytes, never inside a UTF-8 character.
std::string Shortened(const std::string& text, std::size_t most = 60);

// A value in plain words: texts without quotes, elements of arrays behind ", ", integers `grouped` or not.
std::string PlainValue(const Json& json, bool grouped = false, std::string_view separator = ", ");
// The members of an object, in the same words; none of what is no object.
std::vector<std::pair<std::string, std::string>> PlainValues(const Json& object, bool grouped = false);

// Paths as errors write them: `contacts[0].mu`, `expect["ties=contacts"]`. The empty path is the document.
std::string MemberPath(const std::string& path, const std::string& key);
std::string ElementPath(const std::string& path, std::size_t index);

// A value of a document that knows where it stands. Keeps references: the document and the source must
// outlive it. Every accessor that is not satisfied throws InputError.
class JsonPlace {
 public:
  JsonPlace(const Json& json, const std::string& source, std::string path)
      : json_(json), source_(source), path_(std::move(path)) {}
  // The document that ParseJson reads; this place and its copies keep it, the places in it do not.
  JsonPlace(std::string_view text, const std::string& source);

  const Json& json() const { return json_; }
  const std::string& source() const { return source_; }

  [[noreturn]] void Refuse(const std::string& found, const std::string& expected) const;
  // Found is the value itself.
  [[noreturn]] void Refuse(const std::string& expected) const { Refuse(Shown(json_), expected); }

  bool IsNull() const;

  // Objects.
  void RequireObject() const;
  // Whether it is one whose `format` is this, or, if `unsaid`, has none.
  bool HasFormat(std::string_view format, bool unsaid = false) const;
  // All unknown keys are told at once.
  void AllowKeys(const std::vector<std::string>& keys) const;
  JsonPlace Required(const std::string& key, const std::string& expected) const;
  std::optional<JsonPlace> Optional(const std::string& key) const;
  JsonPlace Child(const std::string& key, const Json& value) const;
  std::vector<std::pair<std::string, JsonPlace>> Members() const;
  // Of a file whose keys another format or version would not have.
  void RequireFormat(const std::string& format, int version = 1) const;

  // Arrays.
  std::size_t Size(const std::string& expected) const;
  JsonPlace operator[](std::size_t index) const;

  const std::string& Text(const std::string& expected) const;
  // An integer literal from `least` to `most`; 1.0 and true are none.
  std::int64_t Integer(std::int64_t least, std::int64_t most, const std::string& expected) const;
  double Number(const std::string& expected) const;
  bool Truth(const std::string& expected = "true or false") const;

 private:
  std::shared_ptr<const Json> document_;  // of the root of a text
  const Json& json_;
  const std::string& source_;
  std::string path_;
};

// What is wrong with the parts of a document, told at once.
class Faults {
 public:
  // `source` must outlive it.
  explicit Faults(const std::string& source) : source_(source) {}

  // Reads a part; what it refuses is kept.
  template <class Read>
  void Try(const Read& read) {
    try {
      read();
    } catch (const InputError& error) {
      Add(error.what());
    }
  }
  bool empty() const { return told_.empty(); }
  void Take(const Faults& others) { told_.insert(told_.end(), others.told_.begin(), others.told_.end()); }
  // InputError, if there are any: at most ten of them, and how many more there are.
  void Throw() const;

 private:
  void Add(std::string message);

  const std::string& source_;
  std::vector<std::string> told_;  // without the source
};

}  // namespace stiction
