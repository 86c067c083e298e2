// SPDX-License-Identifier: Apache-2.0
#include "cli/verb.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <type_traits>

#include "cli/help.h"
#include "corpus/named_rows.h"
#include "corpus/rational.h"

namespace stiction {
namespace {

// What one word of a field is read as.
template <class T>
T WordFor(const T&);
template <class T>
T WordFor(const std::optional<T>&);
template <class T>
T WordFor(const std::vector<T>&);
template <class T>
using WordOf = decltype(WordFor(std::declval<T>()));

// All of the word as a number, in decimal.
template <class Number>
bool Read(const std::string& word, Number& number) {
  const char* const last = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data(), last, number);
  return error == std::errc() && end == last;
}

// A fraction too, as files have them.
bool Read(const std::string& word, double& number) {
  if (word.find('/') == word.npos) return Read<double>(word, number);
  const auto exact = ParseRational(word);
  if (!exact) return false;
  number = ToDouble(*exact);
  return std::isfinite(number) && (number != 0 || *exact == 0);
}

bool Read(const std::string& word, std::string& text) {
  text = word;
  return true;
}

template <class T>
void Set(T& field, T value) {
  field = std::move(value);
}
template <class T>
void Set(std::optional<T>& field, T value) {
  field = std::move(value);
}
template <class T>
void Set(std::vector<T>& field, T value) {
  field.push_back(std::move(value));
}

std::string DefaultOf(const std::string& field) { return field; }
template <class Number>
std::string DefaultOf(const Number& field) {
  return field == Number(0) ? "" : fmt::format("{}", field);
}
template <class T>
std::string DefaultOf(const std::optional<T>&) {
  return "";
}
template <class T>
std::string DefaultOf(const std::vector<T>& field) {
  return fmt::format("{}", fmt::join(field, " "));
}

// "an integer from 1 to 1024"
std::string ExpectedNumber(const OptionRow& row) {
  const std::string number = row.TypeName() == "INTEGER" ? "an integer" : "a number";
  if (std::holds_alternative<std::optional<std::uint64_t>*>(row.field)) return number + " from 0 to 2^64 - 1";
  if (row.min == -std::numeric_limits<double>::infinity()) return number;
  return fmt::format("{} from {:g} to {}", number, row.min,
                     row.max == kMostInteger ? "2^53" : fmt::format("{:g}", row.max));
}

std::string ErrorOf(const OptionRow& row, const std::string& word) {
  if (!row.choices.empty()) {
    const std::vector<std::string> names = NamesOf(row.choices);
    if (std::find(names.begin(), names.end(), word) == names.end()) {
      const std::string nearest = Nearest(word, names);
      std::string hint = nearest.empty() ? "" : "; did you mean " + nearest + "?";
      if (word.find(',') != std::string::npos) hint = "; several have blanks between them, not commas";
      return fmt::format("found '{}', expected one of {}{}", word, fmt::join(names, ", "), hint);
    }
  }
  return row.check ? row.check(word) : "";
}

template <class T>
std::string TakeWord(const OptionRow& row, const std::string& word, T& field) {
  WordOf<T> value{};
  bool good = Read(word, value);
  if constexpr (std::is_arithmetic_v<WordOf<T>>) {
    const double number = static_cast<double>(value);
    good = good && row.min <= number && number <= row.max;  // not so of nan
  }
  if (!good) return fmt::format("found '{}', expected {}", word, ExpectedNumber(row));
  std::string error = ErrorOf(row, word);
  if (error.empty()) Set(field, std::move(value));
  return error;
}

}  // namespace

OptionRow& OptionRow::OneOf(const std::vector<std::string>& names) {
  for (const std::string& choice : names) choices.push_back({choice, ""});
  return *this;
}

bool OptionRow::IsRepeated() const {
  return std::holds_alternative<std::vector<int>*>(field) ||
         std::holds_alternative<std::vector<std::string>*>(field);
}

std::vector<std::string> OptionRow::Spellings() const {
  const std::size_t comma = name.find(',');
  if (comma == name.npos) return {name};
  return {name.substr(0, comma), name.substr(comma + 1)};
}

std::string_view OptionRow::TypeName() const {
  return std::visit(
      [](const auto* bound) -> std::string_view {
        using Word = WordOf<std::remove_cvref_t<decltype(*bound)>>;
        if constexpr (std::is_same_v<Word, bool>) return "";
        if constexpr (std::is_integral_v<Word>) return "INTEGER";
        return std::is_floating_point_v<Word> ? "NUMBER" : "TEXT";
      },
      field);
}

std::string Take(const OptionRow& row, const std::vector<std::string>& words) {
  return std::visit(
      [&row, &words](auto* bound) -> std::string {
        using T = std::remove_pointer_t<decltype(bound)>;
        if constexpr (!std::is_same_v<T, bool>) {
          for (const std::string& word : words) {
            std::string error = TakeWord(row, word, *bound);
            if (!error.empty()) return error;
          }
        }
        return "";
      },
      row.field);
}

OptionRow& Verb::Add(RowKind kind, std::string_view name, Field field, std::string_view help) {
  OptionRow& row = rows.emplace_back();
  row.kind = kind;
  row.name = name;
  row.field = field;
  row.help = help;
  if (kind != RowKind::kFlag)
    row.default_value = std::visit([](const auto* bound) { return DefaultOf(*bound); }, field);
  return row;
}

}  // namespace stiction
