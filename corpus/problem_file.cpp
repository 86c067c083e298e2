// SPDX-License-Identifier: Apache-2.0
// Problem files: the reader, which refuses, and the writer.

#include "corpus/problem_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "corpus/exact_number.h"
#include "solver/problem/check.h"
#include "solver/problem/options.h"
#include "solver/problem/solution.h"

namespace stiction {
namespace {

using Matrix = ExactProblem::Matrix;
using Vector = ExactProblem::Vector;

constexpr std::string_view kFormat = "stiction-problem";
constexpr int kVersion = 1;
constexpr std::array<std::string_view, 4> kKindNames = {"bilateral", "frictionless", "static", "sliding"};

const std::vector<std::string> kProblemKeys = {"format", "version", "dimension", "contacts", "A", "b"};
const std::vector<std::string> kFileKeys = {"format", "version", "name",  "dimension", "contacts",
                                            "A",      "b",       "scene", "origin",    "expect"};

bool HasSlip(const Contact<Rational>& contact) { return contact.kind == ContactKind::kSliding; }

bool IsUnit(const std::array<Rational, 2>& x) { return Rational(x[0] * x[0] + x[1] * x[1]) == 1; }

// ---- Reading ---------------------------------------------------------------------------------

// Reads a problem value by value. Strict: numbers are strings only.
class ProblemReader {
 public:
  explicit ProblemReader(bool strict) : strict_(strict) {}

  ExactProblem Read(const JsonPlace& place) const;

 private:
  Rational Number(const JsonPlace& place) const;
  std::vector<Contact<Rational>> Contacts(const JsonPlace& place, int dimension) const;
  Contact<Rational> OneContact(const JsonPlace& place, int dimension) const;
  Rational Friction(const JsonPlace& contact, std::string_view kind) const;
  std::array<Rational, 2> Slip(const JsonPlace& place, int dimension) const;
  Matrix ContactMatrix(const JsonPlace& place, int rows) const;
  Matrix DenseRows(const JsonPlace& place, int rows) const;
  Matrix Entries(const JsonPlace& place, int rows) const;
  Vector Numbers(const JsonPlace& place, int rows) const;

  bool strict_;
};

// Format and version come before the keys: another version may have others.
void ReadHeader(const JsonPlace& place, bool strict) {
  const std::string format = '"' + std::string(kFormat) + '"';
  const JsonPlace found = place.Required("format", format);
  if (found.Text(format) != kFormat) found.Refuse(format);
  const std::string version = std::to_string(kVersion);
  place.Required("version", version).Integer(kVersion, kVersion, version);
  place.AllowKeys(strict ? kProblemKeys : kFileKeys);
}

ExactProblem ProblemReader::Read(const JsonPlace& place) const {
  ReadHeader(place, strict_);
  ExactProblem problem;
  problem.dimension = static_cast<int>(place.Required("dimension", "2 or 3").Integer(2, 3, "2 or 3"));
  problem.contacts = Contacts(place.Required("contacts", "an array of contacts"), problem.dimension);
  const int rows = RowCount(problem.contacts, problem.dimension);
  problem.A = ContactMatrix(place.Required("A", R"(an array of rows, or {"size", "entries"})"), rows);
  problem.b = Numbers(place.Required("b", "an array of numbers"), rows);
  return problem;
}

Rational ProblemReader::Number(const JsonPlace& place) const { return ExactNumber(place, strict_); }

std::vector<Contact<Rational>> ProblemReader::Contacts(const JsonPlace& place, int dimension) const {
  const std::size_t count = place.Size("an array of contacts");
  std::vector<Contact<Rational>> contacts;
  for (std::size_t i = 0; i < count; ++i) contacts.push_back(OneContact(place[i], dimension));
  return contacts;
}

Contact<Rational> ProblemReader::OneContact(const JsonPlace& place, int dimension) const {
  const std::string kinds = fmt::format("one of {}", fmt::join(kKindNames, ", "));
  const JsonPlace named = place.Required("kind", kinds);
  const std::string& name = named.Text(kinds);
  const auto kind = std::find(kKindNames.begin(), kKindNames.end(), name);
  if (kind == kKindNames.end()) named.Refuse(kinds);
  place.AllowKeys({"kind", "mu", "slip"});

  Contact<Rational> contact;
  contact.kind = static_cast<ContactKind>(kind - kKindNames.begin());
  const auto mu = place.Optional("mu");
  if (mu && !contact.HasFrictionRows()) mu->Refuse("no mu on a " + name + " contact");
  const auto slip = place.Optional("slip");
  if (slip && !HasSlip(contact)) slip->Refuse("no slip on a " + name + " contact");
  if (contact.HasFrictionRows()) contact.mu = Friction(place, name);
  if (HasSlip(contact)) {
    contact.slip = Slip(place.Required("slip", "the direction of the sliding velocity"), dimension);
  }
  return contact;
}

Rational ProblemReader::Friction(const JsonPlace& contact, std::string_view kind) const {
  const JsonPlace place = contact.Required("mu", fmt::format("the mu of a {} contact, a number >= 0", kind));
  Rational mu = Number(place);
  if (mu < 0) place.Refuse("mu >= 0");
  return mu;
}

std::array<Rational, 2> ProblemReader::Slip(const JsonPlace& place, int dimension) const {
  if (dimension == 2) {
    constexpr std::string_view kExpected = R"("1" or "-1")";
    const std::string& sign = place.Text(std::string(kExpected));
    if (sign != "1" && sign != "-1") place.Refuse(std::string(kExpected));
    return {Rational(sign == "1" ? 1 : -1), Rational(0)};
  }
  const std::string expected = "a unit vector of two numbers [x, y], x^2 + y^2 = 1";
  if (place.Size(expected) != 2) place.Refuse(expected);
  std::array<Rational, 2> slip = {Number(place[0]), Number(place[1])};
  if (!IsUnit(slip)) place.Refuse(expected);
  return slip;
}

// Refuses an array that does not have one item per row of the contacts.
void RequireLength(const JsonPlace& place, int rows, const std::string& items) {
  const std::string expected = fmt::format("{} {}, one per row of the contacts", rows, items);
  const std::size_t size = place.Size("an array of " + expected);
  if (size != static_cast<std::size_t>(rows)) place.Refuse(fmt::format("{} {}", size, items), expected);
}

// A of more rows is refused before it is made.
constexpr int kMostRows = 4096;

void RequireMemory(const JsonPlace& place, int rows) {
  if (rows <= kMostRows) return;
  constexpr double kEntry = 64, kGiB = 1 << 30;  // bytes
  place.Refuse(fmt::format("{} rows, {:.3g} GiB as a dense matrix", rows, kEntry / kGiB * rows * rows),
               fmt::format("at most {} rows, {:.3g} GiB", kMostRows, kEntry / kGiB * kMostRows * kMostRows));
}

Matrix ProblemReader::ContactMatrix(const JsonPlace& place, int rows) const {
  RequireMemory(place, rows);
  return place.json().is_object() ? Entries(place, rows) : DenseRows(place, rows);
}

Matrix ProblemReader::DenseRows(const JsonPlace& place, int rows) const {
  if (!place.json().is_array()) place.Refuse(R"(an array of rows, or {"size", "entries"})");
  RequireLength(place, rows, "rows");
  Matrix A(rows, rows);
  for (int i = 0; i < rows; ++i) A.row(i) = Numbers(place[i], rows).transpose();
  return A;
}

Matrix ProblemReader::Entries(const JsonPlace& place, int rows) const {
  place.AllowKeys({"size", "entries"});
  const std::string size = fmt::format("{}, the rows of the contacts", rows);
  place.Required("size", size).Integer(rows, rows, size);
  const JsonPlace entries = place.Required("entries", "an array of entries [i, j, value]");
  const std::size_t count = entries.Size("an array of entries [i, j, value]");
  const std::string index = fmt::format("a row number >= 0 and < {}", rows);

  Matrix A(rows, rows);
  std::vector<std::array<int, 2>> listed;
  std::vector<bool> is_listed(static_cast<std::size_t>(rows) * rows);
  const auto flat = [rows](int i, int j) { return static_cast<std::size_t>(i) * rows + j; };
  for (std::size_t k = 0; k < count; ++k) {
    const JsonPlace entry = entries[k];
    if (entry.Size("an entry [i, j, value]") != 3) entry.Refuse("an entry [i, j, value]");
    const int i = static_cast<int>(entry[0].Integer(0, rows - 1, index));
    const int j = static_cast<int>(entry[1].Integer(0, rows - 1, index));
    if (is_listed[flat(i, j)]) entry.Refuse("each entry once");
    is_listed[flat(i, j)] = true;
    listed.push_back({i, j});
    A(i, j) = Number(entry[2]);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const auto [i, j] = listed[k];
    if (is_listed[flat(j, i)]) continue;
    if (i < j) entries[k].Refuse("an entry above the diagonal only beside the one below");
    A(j, i) = A(i, j);
  }
  return A;
}

Vector ProblemReader::Numbers(const JsonPlace& place, int rows) const {
  RequireLength(place, rows, "numbers");
  Vector values(rows);
  for (int i = 0; i < rows; ++i) values(i) = Number(place[i]);
  return values;
}

// One spelling per policy, so that two spellings of one are noticed.
std::string CanonicalPolicy(const std::string& text, const JsonPlace& place) {
  if (text == "*") return text;
  try {
    return PolicyName(ParsePolicy(text));
  } catch (const std::invalid_argument& error) {
    place.Refuse(Shown(text), fmt::format(R"(a policy or "*" ({}))", Shortened(error.what(), 300)));
  }
}

std::map<std::string, std::string> ReadExpect(const JsonPlace& place) {
  place.RequireObject();
  const std::string outcomes = fmt::format("one of {}", fmt::join(kOutcomeNames, ", "));
  std::map<std::string, std::string> expect;
  std::map<std::string, std::string> spelling;  // canonical policy -> as written
  for (const auto& member : place.json().items()) {
    const JsonPlace outcome = place.Child(member.key(), member.value());
    const std::string& name = outcome.Text(outcomes);
    if (std::find(kOutcomeNames.begin(), kOutcomeNames.end(), name) == kOutcomeNames.end())
      outcome.Refuse(outcomes);
    const auto [before, is_new] = spelling.emplace(CanonicalPolicy(member.key(), outcome), member.key());
    if (!is_new)
      outcome.Refuse("a duplicate key", "each policy once (it is " + Shown(before->second) + " too)");
    expect[member.key()] = name;
  }
  return expect;
}

// ---- Writing ---------------------------------------------------------------------------------

void CheckContact(const Contact<Rational>& contact, int dimension) {
  STICTION_CHECK(contact.mu >= 0, "mu = " + ToString(contact.mu) + ", expected >= 0");
  STICTION_CHECK(contact.HasFrictionRows() || contact.mu == 0, "mu on a contact without friction");
  const auto& slip = contact.slip;
  if (HasSlip(contact)) {
    STICTION_CHECK(IsUnit(slip) && (dimension == 3 || slip[1] == 0),
                   "the slip of a sliding contact is no unit vector");
  } else {
    STICTION_CHECK(slip[0] == 0 && slip[1] == 0, "slip on a contact that is not sliding");
  }
}

// What the reader would refuse is not written.
void CheckProblem(const ExactProblem& problem) {
  STICTION_CHECK(problem.dimension == 2 || problem.dimension == 3, "the dimension is neither 2 nor 3");
  for (const Contact<Rational>& contact : problem.contacts) CheckContact(contact, problem.dimension);
  const int rows = RowCount(problem.contacts, problem.dimension);
  STICTION_CHECK(problem.rows() == rows, "b does not have one row per row of the contacts");
  STICTION_CHECK(problem.A.rows() == rows && problem.A.cols() == rows, "A does not fit the contacts");
}

Json ContactToJson(const Contact<Rational>& contact, int dimension) {
  Json json = {{"kind", Name(contact.kind)}};
  if (contact.HasFrictionRows()) json["mu"] = ToString(contact.mu);
  if (!HasSlip(contact)) return json;
  if (dimension == 2) {
    json["slip"] = ToString(contact.slip[0]);
  } else {
    json["slip"] = Json::array({ToString(contact.slip[0]), ToString(contact.slip[1])});
  }
  return json;
}

template <class Numbers>
Json NumbersToJson(const Numbers& numbers) {
  Json json = Json::array();
  for (int i = 0; i < numbers.size(); ++i) json.push_back(ToString(numbers(i)));
  return json;
}

Json RowsToJson(const Matrix& A) {
  Json json = Json::array();
  for (int i = 0; i < A.rows(); ++i) json.push_back(NumbersToJson(A.row(i)));
  return json;
}

// Large, symmetric, and mostly zeros.
bool IsBestSparse(const Matrix& A) {
  constexpr int kSmall = 64;
  const auto rows = A.rows();
  return rows > kSmall && 4 * (A.array() != Rational(0)).count() <= rows * rows && A == A.transpose();
}

// The entries on and below the diagonal that are not zero, row by row.
Json EntriesToJson(const Matrix& A) {
  Json entries = Json::array();
  for (int i = 0; i < A.rows(); ++i) {
    for (int j = 0; j <= i; ++j) {
      if (A(i, j) != 0) entries.push_back(Json::array({i, j, ToString(A(i, j))}));
    }
  }
  return {{"size", A.rows()}, {"entries", std::move(entries)}};
}

// `{"key": value, "key": value}`, spaced for people.
std::string ObjectOnOneLine(const Json& object) {
  std::vector<std::string> members;
  for (const auto& member : object.items()) {
    members.push_back(JsonText(member.key()) + ": " + JsonText(member.value()));
  }
  return fmt::format("{{{}}}", fmt::join(members, ", "));
}

std::string LinePerItem(const Json& array) {
  if (array.empty()) return "[]";
  std::vector<std::string> lines;
  for (const Json& item : array) lines.push_back(item.is_object() ? ObjectOnOneLine(item) : JsonText(item));
  return fmt::format("[\n    {}\n  ]", fmt::join(lines, ",\n    "));
}

// Several lines, all but the first moved in by one level. Strings hold no line breaks in JSON.
std::string Indented(const Json& value) {
  std::string text = JsonText(value, 2);
  for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1))
    text.insert(at + 1, "  ");
  return text;
}

std::string PrintedValue(const std::string& key, const Json& value) {
  if (key == "A" && value.is_object())
    return fmt::format(R"({{"size": {}, "entries": {}}})", value["size"].dump(), LinePerItem(value["entries"]));
  if (key == "contacts" || key == "A") return LinePerItem(value);
  if (key == "scene" || key == "origin" || key == "expect") return Indented(value);
  return JsonText(value);
}

// The exact value of a JSON number or string; empty where it has none.
std::optional<Rational> ExactValue(const Json& json) {
  if (json.is_string()) return ParseRational(json.get_ref<const std::string&>());
  if (json.is_number_integer()) {
    const Rational x = *ParseRational(json.dump());
    return IsExactDouble(x) ? std::optional(x) : std::nullopt;
  }
  if (json.is_number_float() && std::isfinite(json.get<double>())) return Rational(json.get<double>());
  return std::nullopt;
}

}  // namespace

Rational ExactNumber(const JsonPlace& place, bool strict) {
  const Json& json = place.json();
  std::optional<Rational> x;
  if (strict && json.is_string() && json.get_ref<const std::string&>().size() > kMostCharactersOfNumber) {
    place.Refuse(fmt::format("a number of at most {} characters", kMostCharactersOfNumber));
  }
  if (!strict || json.is_string()) x = ExactValue(json);
  if (x.has_value()) return *std::move(x);
  if (!strict && json.is_number_integer()) place.Refuse("an integer that is a double exactly, or a string");
  place.Refuse(std::string(strict ? "an exact number as a string" : "a number") +
               R"(, such as "-3/4" (denominator not zero) or "2.5e-3" (exponent within 10000))");
}

ProblemFile ParseProblem(std::string_view text, const std::string& source) {
  const Json json = ParseJson(text, source);
  const JsonPlace place(json, source, "");
  ProblemFile file;
  file.problem = ProblemReader(false).Read(place);
  file.name = place.Required("name", "a string").Text("a string");
  if (const auto scene = place.Optional("scene")) file.scene = scene->json();
  if (const auto origin = place.Optional("origin")) {
    origin->RequireObject();
    file.origin = origin->json();
  }
  if (const auto expect = place.Optional("expect")) file.expect = ReadExpect(*expect);
  return file;
}

ProblemFile ReadProblem(const std::filesystem::path& file) {
  return ParseProblem(ReadText(file), file.string());
}

ExactProblem ProblemFromJson(const Json& json, const std::string& source, const std::string& path,
                             bool strict) {
  return ProblemReader(strict).Read(JsonPlace(json, source, path));
}

Json ProblemToJson(const ExactProblem& problem) {
  CheckProblem(problem);
  Json json = {{"format", kFormat}, {"version", kVersion}, {"dimension", problem.dimension}};
  json["contacts"] = Json::array();
  for (const auto& contact : problem.contacts)
    json["contacts"].push_back(ContactToJson(contact, problem.dimension));
  json["A"] = IsBestSparse(problem.A) ? EntriesToJson(problem.A) : RowsToJson(problem.A);
  json["b"] = NumbersToJson(problem.b);
  return json;
}

std::string_view Name(ContactKind kind) { return kKindNames[static_cast<int>(kind)]; }

Json ToJson(const ProblemFile& file) {
  const Json problem = ProblemToJson(file.problem);
  Json json;
  for (const auto& member : problem.items()) {
    if (member.key() == "dimension") json["name"] = file.name;
    json[member.key()] = member.value();
  }
  if (file.scene) json["scene"] = *file.scene;
  if (file.origin) json["origin"] = *file.origin;
  if (!file.expect.empty()) json["expect"] = file.expect;
  return json;
}

std::string Print(const ProblemFile& file) {
  const Json json = ToJson(file);  // named: items() would not keep it alive
  std::string text = "{";
  for (const auto& member : json.items()) {
    const bool same_line = member.key() == "version" || member.key() == "dimension";
    text += text == "{" ? "\n  " : same_line ? ", " : ",\n  ";
    text += JsonText(member.key()) + ": " + PrintedValue(member.key(), member.value());
  }
  return text + "\n}\n";
}

}  // namespace stiction
