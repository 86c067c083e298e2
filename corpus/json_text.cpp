// SPDX-License-Identifier: Apache-2.0
// JSON text: a document builder on nlohmann's SAX parser, and places in documents.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "corpus/grouped.h"
#include "corpus/input_file.h"
#include "corpus/json.h"
#include "solver/problem/check.h"

template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace stiction {
namespace {

// Of a number's literal.
bool IsNotZero(std::string_view literal) {
  return literal.substr(0, literal.find_first_of("eE")).find_first_of("123456789") != literal.npos;
}

// Builds the document from the parser's events, so that every key and number literal is seen.
class DocumentBuilder : public nlohmann::json_sax<Json> {
 public:
  explicit DocumentBuilder(const std::string& source) : source_(source) {}

  Json TakeDocument() { return std::move(document_); }

  bool null() override { return Add(nullptr); }
  bool boolean(bool value) override { return Add(value); }
  bool number_integer(number_integer_t value) override { return Add(value); }
  bool number_unsigned(number_unsigned_t value) override { return Add(value); }
  bool string(string_t& value) override { return Add(std::move(value)); }
  bool start_object(std::size_t) override { return Open(Json::object()); }
  bool start_array(std::size_t) override { return Open(Json::array()); }
  bool end_object() override { return Close(); }
  bool end_array() override { return Close(); }
  bool binary(binary_t&) override { return false; }  // JSON text has none

  // An integer literal arrives here only if 64 bits do not hold it.
  bool number_float(number_float_t value, const string_t& literal) override {
    if (literal.find_first_not_of("-0123456789") == literal.npos && Rational(literal, 10) != Rational(value)) {
      Refuse(PathOfNext(), Shortened(literal), "an integer that is a double exactly, or a string");
    }
    if (value == 0 && IsNotZero(literal)) {
      Refuse(PathOfNext(), Shortened(literal) + ", which is no double but 0",
             fmt::format("a number in the range of doubles; as a string, \"{}\", it is exact",
                         Shortened(literal)));
    }
    return Add(value);
  }

  bool key(string_t& key) override {
    Frame& frame = frames_.back();
    frame.key = key;
    if (!frame.keys.insert(key).second) Refuse(PathOfNext(), "a duplicate key", "each key once");
    return true;
  }

  bool parse_error(std::size_t, const std::string& token, const nlohmann::detail::exception& error) override {
    constexpr int kNumberOverflow = 406;
    if (error.id == kNumberOverflow) {
      Refuse(
          PathOfNext(), Shortened(token),
          fmt::format("a number in the range of doubles; as a string, \"{}\", it is exact", Shortened(token)));
    }
    // "[...] parse error at line 1, column 2: syntax error while parsing ..."
    const std::string_view text = error.what();
    const std::size_t line = std::min(text.find("line "), text.size());
    const std::size_t colon = std::min(text.find(": ", line), text.size());
    const std::string reason(text.substr(std::min(colon + 2, text.size())));
    throw InputError(source_, std::string(text.substr(line, colon - line)), Shortened(reason, 250),
                     "JSON text");
  }

 private:
  struct Frame {
    Json* container;
    std::string key;  // of the next value, in an object
    std::set<std::string> keys;
  };

  [[noreturn]] void Refuse(const std::string& path, const std::string& found,
                           const std::string& expected) const {
    throw InputError(source_, path.empty() ? "$" : path, found, expected);
  }

  std::string PathOfNext() const {
    std::string path;
    for (const Frame& frame : frames_) {
      // The open child of an array is its last element already; only the innermost has its next to come.
      const std::size_t next = frame.container->size() - (&frame == &frames_.back() ? 0 : 1);
      path = frame.container->is_array() ? ElementPath(path, next) : MemberPath(path, frame.key);
    }
    return path;
  }

  // Puts the value where the parser stands. A container stays where it is until it is closed: what
  // contains it does not grow before.
  Json* Put(Json value) {
    if (frames_.empty()) return &(document_ = std::move(value));
    Frame& frame = frames_.back();
    if (frame.container->is_array()) {
      auto& elements = frame.container->get_ref<Json::array_t&>();
      elements.push_back(std::move(value));
      return &elements.back();
    }
    auto& members = frame.container->get_ref<Json::object_t&>();
    members.emplace_back(frame.key, std::move(value));  // emplace would search all keys again
    return &members.back().second;
  }

  bool Add(Json value) {
    Put(std::move(value));
    return true;
  }

  bool Open(Json container) {
    if (frames_.size() == kMaxJsonDepth) {
      Refuse(PathOfNext(), "deeper nesting",
             fmt::format("at most {} levels of arrays and objects", kMaxJsonDepth));
    }
    Json* place = Put(std::move(container));
    frames_.push_back({place, {}, {}});
    return true;
  }

  bool Close() {
    frames_.pop_back();
    return true;
  }

  const std::string& source_;
  Json document_;
  std::vector<Frame> frames_;
};

// nlohmann takes a NUL byte for the end of the text.
void RefuseNul(std::string_view text, const std::string& source) {
  const std::size_t at = text.find('\0');
  if (at == text.npos) return;
  const std::string_view before = text.substr(0, at);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t column = at - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
  throw InputError(source, fmt::format("line {}, column {}", line, column), "a NUL byte", "JSON text");
}

// Whether the text of the value needs no words in place of numbers.
bool IsFinite(const Json& value) {
  STICTION_CHECK(!value.is_binary() && !value.is_discarded(), "JSON text has no such value");
  if (value.is_number_float()) return std::isfinite(value.get<double>());
  return !value.is_structured() || std::all_of(value.begin(), value.end(), IsFinite);
}

// Numbers that are not finite become text.
void PutWords(Json& value) {
  if (value.is_number_float()) value = NumberToJson(value.get<double>());
  if (!value.is_structured()) return;
  for (Json& child : value) PutWords(child);
}

bool IsWord(const std::string& key) {
  const auto is_word_character = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  return !key.empty() && std::all_of(key.begin(), key.end(), is_word_character);
}

}  // namespace

Json ParseJson(std::string_view text, const std::string& source) {
  RefuseNul(text, source);
  if (text.starts_with("\xEF\xBB\xBF")) {
    throw InputError(source, "line 1, column 1", "a byte order mark", "JSON text");
  }
  DocumentBuilder builder(source);
  const bool parsed = Json::sax_parse(text.begin(), text.end(), &builder);
  STICTION_CHECK(parsed, "the JSON parser stopped without an error");
  return builder.TakeDocument();
}

SharedJson::SharedJson() : SharedJson(Json()) {}
SharedJson::SharedJson(std::initializer_list<JsonMember> members) {
  Json json = Json::object();
  for (const auto& [key, value] : members)
    std::visit([&json, &name = key](const auto& x) { json[std::string(name)] = x; }, value);
  value_ = std::make_shared<const Json>(std::move(json));
}
SharedJson::SharedJson(const std::vector<SharedJson>& list)
    : SharedJson(Json(Json::array_t(list.begin(), list.end()))) {}
SharedJson::SharedJson(const std::string& text) : SharedJson(Json(text)) {}
SharedJson::SharedJson(double number) : SharedJson(Json(number)) {}
SharedJson::SharedJson(const Json& value) : value_(std::make_shared<const Json>(value)) {}
SharedJson::SharedJson(Json&& value) : value_(std::make_shared<const Json>(std::move(value))) {}
SharedJson::operator bool() const { return !value_->is_null(); }

void SharedJson::Add(const SharedJson& members) {
  Json sum = *value_;
  sum.update(*members);
  value_ = std::make_shared<const Json>(std::move(sum));
}

std::string ReadText(const std::filesystem::path& file) { return ReadInput(file, kMostInputBytes); }

std::string JsonText(const Json& value, int indent) {
  if (IsFinite(value)) return value.dump(indent, ' ', false, Json::error_handler_t::replace);
  Json worded = value;
  PutWords(worded);
  return worded.dump(indent, ' ', false, Json::error_handler_t::replace);
}

bool IsUtf8(const Json& value) {
  try {
    return !value.dump().empty();
  } catch (const Json::exception&) {
    return false;
  }
}

void RequireWritable(const Json& value) {
  STICTION_CHECK(IsFinite(value), "a number that is not finite is not written to a file");
  STICTION_CHECK(IsUtf8(value), "text that is no UTF-8 is not written to a file");
}

std::string Shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return fmt::format("{}... ({} characters)", text.substr(0, end), text.size());
}

std::string Shown(const Json& value) { return Shortened(JsonText(value)); }

std::string PlainValue(const Json& json, bool grouped, std::string_view separator) {
  if (json.is_string()) return json.get<std::string>();
  if (grouped && json.is_number_integer()) return Grouped(json.get<std::int64_t>());
  if (!json.is_array()) return JsonText(json);
  std::vector<std::string> parts;
  for (const Json& element : json) parts.push_back(PlainValue(element, grouped));
  return fmt::format("{}", fmt::join(parts, separator));
}

std::vector<std::pair<std::string, std::string>> PlainValues(const Json& object, bool grouped) {
  std::vector<std::pair<std::string, std::string>> values;
  if (!object.is_object()) return values;
  for (const auto& [key, value] : object.items()) values.emplace_back(key, PlainValue(value, grouped));
  return values;
}

std::string MemberPath(const std::string& path, const std::string& key) {
  if (!IsWord(key)) return path + "[" + Shown(key) + "]";
  return (path.empty() ? "" : path + ".") + Shortened(key);
}

std::string ElementPath(const std::string& path, std::size_t index) {
  return fmt::format("{}[{}]", path, index);
}

JsonPlace::JsonPlace(std::string_view text, const std::string& source)
    : document_(std::make_shared<const Json>(ParseJson(text, source))), json_(*document_), source_(source) {}

void JsonPlace::Refuse(const std::string& found, const std::string& expected) const {
  throw InputError(source_, path_.empty() ? "$" : path_, found, expected);
}

bool JsonPlace::IsNull() const { return json_.is_null(); }

bool JsonPlace::HasFormat(std::string_view format, bool unsaid) const {
  return json_.is_object() && (json_.contains("format") ? json_["format"] == format : unsaid);
}

void JsonPlace::RequireObject() const {
  if (!json_.is_object()) Refuse("an object");
}

void JsonPlace::AllowKeys(const std::vector<std::string>& keys) const {
  RequireObject();
  std::vector<std::string> unknown;
  for (const auto& member : json_.items()) {
    if (std::find(keys.begin(), keys.end(), member.key()) == keys.end())
      unknown.push_back(MemberPath(path_, member.key()));
  }
  if (unknown.empty()) return;
  throw InputError(source_, fmt::format("{}", fmt::join(unknown, ", ")),
                   unknown.size() == 1 ? "an unknown key" : "unknown keys",
                   fmt::format("only {}", fmt::join(keys, ", ")));
}

JsonPlace JsonPlace::Required(const std::string& key, const std::string& expected) const {
  RequireObject();
  const auto found = json_.find(key);
  if (found == json_.end()) Child(key, json_).Refuse("nothing", expected);
  return Child(key, *found);
}

std::optional<JsonPlace> JsonPlace::Optional(const std::string& key) const {
  RequireObject();
  const auto found = json_.find(key);
  if (found == json_.end()) return std::nullopt;
  return Child(key, *found);
}

JsonPlace JsonPlace::Child(const std::string& key, const Json& value) const {
  return JsonPlace(value, source_, MemberPath(path_, key));
}

std::vector<std::pair<std::string, JsonPlace>> JsonPlace::Members() const {
  RequireObject();
  std::vector<std::pair<std::string, JsonPlace>> members;
  for (const auto& [key, value] : json_.items()) members.emplace_back(key, Child(key, value));
  return members;
}

void JsonPlace::RequireFormat(const std::string& format, int version) const {
  const std::string expected = '"' + format + '"', number = std::to_string(version);
  const JsonPlace found = Required("format", expected);
  if (found.Text(expected) != format) found.Refuse(expected);
  Required("version", number).Integer(version, version, number);
}

std::size_t JsonPlace::Size(const std::string& expected) const {
  if (!json_.is_array()) Refuse(expected);
  return json_.size();
}

JsonPlace JsonPlace::operator[](std::size_t index) const {
  return JsonPlace(json_[index], source_, ElementPath(path_, index));
}

const std::string& JsonPlace::Text(const std::string& expected) const {
  if (!json_.is_string()) Refuse(expected);
  return json_.get_ref<const std::string&>();
}

std::int64_t JsonPlace::Integer(std::int64_t least, std::int64_t most, const std::string& expected) const {
  const bool fits = json_.is_number_unsigned()
                        ? json_.get<std::uint64_t>() <= static_cast<std::uint64_t>(INT64_MAX)
                        : json_.is_number_integer();
  if (!fits) Refuse(expected);
  const std::int64_t value = json_.get<std::int64_t>();
  if (value < least || value > most) Refuse(expected);
  return value;
}

double JsonPlace::Number(const std::string& expected) const {
  if (!json_.is_number()) Refuse(expected);
  return json_.get<double>();
}

bool JsonPlace::Truth(const std::string& expected) const {
  if (!json_.is_boolean()) Refuse(expected);
  return json_.get<bool>();
}

void Faults::Add(std::string message) {
  const std::string prefix = source_ + ": ";
  if (message.starts_with(prefix)) message.erase(0, prefix.size());
  told_.push_back(std::move(message));
}

void Faults::Throw() const {
  constexpr std::size_t kMost = 10;
  if (told_.empty()) return;
  const std::vector<std::string> first(told_.begin(), told_.begin() + std::min(kMost, told_.size()));
  const std::string more = told_.size() > kMost ? fmt::format("; and {} more", told_.size() - kMost) : "";
  throw InputError(fmt::format("{}: {}{}", source_, fmt::join(first, "; "), more));
}

Json NumberToJson(double x) {
  if (std::isnan(x)) return "nan";  // whose sign is the machine's
  return std::isfinite(x) ? Json(x) : Json(fmt::format("{}", x));
}

}  // namespace stiction
