// SPDX-License-Identifier: Apache-2.0
// Problem files: the reader, which refuses, and the writer.

#include "corpus/record/problem_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "corpus/exact_number.h"
#include "corpus/json.h"
#include "corpus/printable.h"
#include "corpus/record/sparse_matrix.h"
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
const std::vector<std::string> kFileKeys = {"format", "version", "name",    "dimension", "contacts", "mu",
                                            "A",      "b",       "factors", "scene",     "origin",   "expect"};

bool HasSlip(const Contact<Rational>& contact) { return contact.kind == ContactKind::kSliding; }

bool IsUnit(const std::array<Rational, 2>& x) { return Rational(x[0] * x[0] + x[1] * x[1]) == 1; }

// ---- Reading ---------------------------------------------------------------------------------

using Contacts = std::vector<Contact<Rational>>;

void Append(Contacts& contacts, const Contacts& more) {
  contacts.insert(contacts.end(), more.begin(), more.end());
}

// Reads a problem value by value. Strict: numbers are strings only, and nothing has a default.
class ProblemReader {
 public:
  explicit ProblemReader(bool strict) : strict_(strict) {}

  // Adds what is wrong with the problem to `faults`; the result holds only where there is nothing.
  AnyProblem Read(const JsonPlace& place, Faults& faults) const;

 private:
  void ReadHeader(const JsonPlace& place) const;
  AnyProblem WithMatrix(const JsonPlace& place, int rows, ExactProblem problem, Faults& faults) const;
  Rational Number(const JsonPlace& place) const;
  Contacts AllContacts(const JsonPlace& place, int dimension, Faults& faults) const;
  Contacts StaticContacts(const JsonPlace& mu, int dimension, int rows, Faults& faults) const;
  Contacts OneContact(const JsonPlace& place, int dimension, Faults& faults) const;
  Contacts StaticContact(const JsonPlace& mu, int dimension) const;
  Rational Friction(const JsonPlace& place) const;
  std::array<Rational, 2> Slip(const JsonPlace& place, int dimension) const;
  Matrix DenseRows(const JsonPlace& place, int rows) const;
  SparseMatrix Entries(const JsonPlace& place, int rows, Faults& faults) const;
  Vector Numbers(const JsonPlace& place, int rows) const;

  bool strict_;
};

constexpr const char* kMatrixExpected = R"(an array of rows, or {"size", "entries"})";
constexpr const char* kMatrixOrFactors = R"(an array of rows, or {"size", "entries"}; or factors for A and b)";

// What another file of ours is for.
std::string NextStepWith(const Json& format) {
  if (format == "stiction-certificate") return " (stiction check verifies a certificate)";
  if (format == "stiction-scene") return " (stiction assemble makes problems of a scene)";
  if (format == "stiction-campaign") return " (stiction search runs a campaign)";
  return "";
}

// A file of another format or version has other keys: it is refused by these alone.
void ProblemReader::ReadHeader(const JsonPlace& place) const {
  place.RequireObject();
  const std::string format = '"' + std::string(kFormat) + '"', version = std::to_string(kVersion);
  const auto found = place.Optional("format");
  if (found && found->json() != kFormat) found->Refuse(format + NextStepWith(found->json()));
  const auto number = place.Optional("version");
  if (number) number->Integer(kVersion, kVersion, version);
  if (!strict_) return;
  place.Required("format", format);
  place.Required("version", version);
}

// ---- Sizes, as far as a file tells them ----

// Rows by the length of b, otherwise of a dense A or of J; -1 where none tells.
int RowsTold(const JsonPlace& place) {
  const auto b = place.Optional("b"), A = place.Optional("A"), factors = place.Optional("factors");
  if (b && b->json().is_array()) return static_cast<int>(b->json().size());
  if (A && A->json().is_array()) return static_cast<int>(A->json().size());
  return factors ? RowsOfFactors(*factors) : -1;
}

// How many contacts have friction, and how many have not; by `mu` alone -1 where it does not tell.
struct ContactCounts {
  int with_friction = -1, without = 0;

  bool Fit(int rows, int dimension) const {
    return with_friction < 0 ? rows % dimension == 0 : without + dimension * with_friction == rows;
  }
};

ContactCounts CountsTold(const JsonPlace& place) {
  ContactCounts counts;
  const auto contacts = place.Optional("contacts"), mu = place.Optional("mu");
  if (!contacts || !contacts->json().is_array()) {
    if (mu && mu->json().is_array()) counts.with_friction = static_cast<int>(mu->json().size());
    return counts;
  }
  counts.with_friction = 0;
  for (const Json& contact : contacts->json()) {
    const Json kind = contact.is_object() ? contact.value("kind", Json()) : Json();
    const bool has_none = kind == "bilateral" || kind == "frictionless";
    ++(has_none ? counts.without : counts.with_friction);
  }
  return counts;
}

// The dimension that the sizes tell. Without friction the problem is the same in both: 2.
int DimensionTold(const JsonPlace& place) {
  const JsonPlace nothing = place.Child("dimension", place.json());
  const int rows = RowsTold(place);
  const ContactCounts counts = CountsTold(place);
  const bool has_contacts = place.Optional("contacts") || place.Optional("mu");
  if (rows < 0 || !has_contacts) return 0;  // what is missing is told
  const bool plane = counts.Fit(rows, 2), space = counts.Fit(rows, 3);
  if (counts.with_friction == 0 || rows == 0 || (plane && !space)) return 2;
  if (space && !plane) return 3;
  nothing.Refuse("nothing", fmt::format("2 or 3: {} rows fit {}", rows, plane ? "both" : "neither"));
}

// Contacts, A and b are read as far as they can be, whatever is wrong with the others.
AnyProblem ProblemReader::Read(const JsonPlace& place, Faults& faults) const {
  ReadHeader(place);
  ExactProblem problem;
  faults.Try([&] { place.AllowKeys(strict_ ? kProblemKeys : kFileKeys); });
  problem.dimension = 0;
  faults.Try([&] {
    const auto given = place.Optional("dimension");
    if (!given && !strict_) {
      problem.dimension = DimensionTold(place);
      return;
    }
    problem.dimension = static_cast<int>(place.Required("dimension", "2 or 3").Integer(2, 3, "2 or 3"));
  });
  const auto mu = place.Optional("mu");
  Faults of_contacts(place.source());
  of_contacts.Try([&] {
    const auto contacts = place.Optional("contacts");
    if (contacts && mu && !strict_)
      mu->Refuse("mu beside contacts", "one of the two: each contact has its own mu");
    if (!contacts && mu && !strict_) {
      problem.contacts = StaticContacts(*mu, problem.dimension, RowsTold(place), of_contacts);
    } else {
      const char* expected = strict_ ? "an array of contacts" : "an array of contacts, or mu of static ones";
      problem.contacts = AllContacts(place.Required("contacts", expected), problem.dimension, of_contacts);
    }
  });
  faults.Take(of_contacts);
  const bool are_counted = of_contacts.empty() && problem.dimension != 0;
  const int rows = are_counted ? RowCount(problem.contacts, problem.dimension) : RowsTold(place);
  AnyProblem result = WithMatrix(place, rows, std::move(problem), faults);
  // What is missing or wrong above is told; whatever else leaves the sizes open is refused here.
  if (faults.empty() && (!are_counted || rows < 0)) {
    faults.Try([&] {
      place.Child("dimension", place.json())
          .Refuse("nothing, and no sizes that tell it",
                  "2 or 3, and b, A or factors.J with a row each for the contacts");
    });
  }
  return result;
}

// The problem with A and b, or with the factors of both.
AnyProblem ProblemReader::WithMatrix(const JsonPlace& place, int rows, ExactProblem problem,
                                     Faults& faults) const {
  const auto factors = strict_ ? std::nullopt : place.Optional("factors");
  if (factors) {
    for (const char* key : {"A", "b"}) {
      const auto beside = place.Optional(key);
      faults.Try([&] {
        if (beside)
          beside->Refuse(fmt::format("{} beside factors", key), "one of the two: factors say A and b");
      });
    }
    auto read = ReadFactors(*factors, problem.dimension, problem.contacts, rows, faults);
    return read ? AnyProblem(*std::move(read)) : AnyProblem(std::move(problem));
  }
  std::optional<SparseMatrix> entries;
  faults.Try([&] {
    const JsonPlace A = place.Required("A", strict_ ? kMatrixExpected : kMatrixOrFactors);
    if (rows < 0) return;
    if (A.json().is_object())
      entries = Entries(A, rows, faults);
    else
      problem.A = DenseRows(A, rows);
  });
  faults.Try([&] {
    const JsonPlace b = place.Required("b", "an array of numbers");
    if (rows >= 0) problem.b = Numbers(b, rows);
  });
  if (!entries) return problem;
  return ExactEntries{problem.dimension, std::move(problem.contacts), ToEigen(*entries, rows, rows),
                      std::move(problem.b)};
}

Rational ProblemReader::Number(const JsonPlace& place) const { return ExactNumber(place, strict_); }

Contacts ProblemReader::AllContacts(const JsonPlace& place, int dimension, Faults& faults) const {
  const std::size_t count = place.Size("an array of contacts");
  Contacts contacts;
  for (std::size_t i = 0; i < count; ++i)
    faults.Try([&] { Append(contacts, OneContact(place[i], dimension, faults)); });
  return contacts;
}

// Of the short form: one mu for all, or one a contact.
Contacts ProblemReader::StaticContacts(const JsonPlace& mu, int dimension, int rows, Faults& faults) const {
  Contacts contacts;
  if (mu.json().is_array()) {
    for (std::size_t i = 0; i < mu.json().size(); ++i)
      faults.Try([&] { Append(contacts, StaticContact(mu[i], dimension)); });
    return contacts;
  }
  const Contacts each = StaticContact(mu, dimension);
  const int count = rows >= 0 && dimension != 0 ? (rows + dimension - 1) / dimension : 1;
  for (int i = 0; i < count; ++i) Append(contacts, each);
  return contacts;
}

bool IsInfinite(const JsonPlace& mu) { return mu.json() == "inf"; }

// Of friction without a bound the cone is the half-space fN >= 0: a frictionless row, and bilateral ones that
// hold the contact where it is, also while it parts.
Contacts ProblemReader::StaticContact(const JsonPlace& mu, int dimension) const {
  if (strict_ || !IsInfinite(mu)) return {{.kind = ContactKind::kStatic, .mu = Friction(mu), .slip = {}}};
  Contacts rows(std::max(dimension, 1), {.kind = ContactKind::kBilateral, .mu = 0, .slip = {}});
  rows[0].kind = ContactKind::kFrictionless;
  return rows;
}

Contacts ProblemReader::OneContact(const JsonPlace& place, int dimension, Faults& faults) const {
  const std::string kinds = fmt::format("one of {}", fmt::join(kKindNames, ", "));
  place.RequireObject();
  faults.Try([&] { place.AllowKeys({"kind", "mu", "slip"}); });
  const JsonPlace named = place.Required("kind", kinds);
  const std::string& name = named.Text(kinds);
  const auto kind = std::find(kKindNames.begin(), kKindNames.end(), name);
  if (kind == kKindNames.end()) named.Refuse(kinds);

  Contact<Rational> contact;
  Contacts of_static;
  contact.kind = static_cast<ContactKind>(kind - kKindNames.begin());
  const auto mu = place.Optional("mu"), slip = place.Optional("slip");
  faults.Try([&] {
    if (mu && !contact.HasFrictionRows()) mu->Refuse("no mu on a " + name + " contact");
    if (!contact.HasFrictionRows()) return;
    const JsonPlace given = place.Required("mu", fmt::format("the mu of a {} contact, a number >= 0", name));
    if (contact.kind == ContactKind::kStatic) {
      of_static = StaticContact(given, dimension);
    } else {
      contact.mu = Friction(given);
    }
  });
  faults.Try([&] {
    if (slip && !HasSlip(contact)) slip->Refuse("no slip on a " + name + " contact");
    if (!HasSlip(contact)) return;
    const JsonPlace given = place.Required("slip", "the direction of the sliding velocity");
    if (dimension != 0) contact.slip = Slip(given, dimension);
  });
  return of_static.empty() ? Contacts{contact} : of_static;
}

Rational ProblemReader::Friction(const JsonPlace& place) const {
  if (IsInfinite(place)) place.Refuse("a number >= 0: friction without a bound is that of a static contact");
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

// A dense matrix of more rows is refused before it is made.
void RequireMemory(const JsonPlace& place, int rows, int most = kMostDenseRows) {
  if (rows <= most) return;
  constexpr double kEntry = 64, kGiB = 1 << 30;  // bytes
  place.Refuse(fmt::format("{} rows, {:.3g} GiB as a dense matrix", rows, kEntry / kGiB * rows * rows),
               fmt::format("at most {} rows", most) +
                   R"(; stiction solve and survey take more, written as {"size", "entries"} or as factors)");
}

Matrix ProblemReader::DenseRows(const JsonPlace& place, int rows) const {
  RequireMemory(place, rows);
  if (!place.json().is_array()) place.Refuse(kMatrixExpected);
  RequireLength(place, rows, "rows");
  Matrix A(rows, rows);
  for (int i = 0; i < rows; ++i) A.row(i) = Numbers(place[i], rows).transpose();
  return A;
}

SparseMatrix ProblemReader::Entries(const JsonPlace& place, int rows, Faults& faults) const {
  faults.Try([&] { place.AllowKeys({"size", "entries"}); });
  const std::string size = fmt::format("{}, the rows of the contacts", rows);
  place.Required("size", size).Integer(rows, rows, size);
  const JsonPlace entries = place.Required("entries", "an array of entries [i, j, value]");
  SparseMatrix A = ReadEntries(entries, rows, rows, strict_);
  for (std::size_t k = 0; k < entries.json().size(); ++k) {
    const int i = entries.json()[k][0].get<int>(), j = entries.json()[k][1].get<int>();
    const bool is_new = A.emplace(std::pair(j, i), A.at({i, j})).second;
    if (is_new && i < j) entries[k].Refuse("an entry above the diagonal only beside the one below");
  }
  std::erase_if(A, [](const auto& entry) { return entry.second == 0; });
  return A;
}

Vector ProblemReader::Numbers(const JsonPlace& place, int rows) const {
  RequireLength(place, rows, "numbers");
  Vector values(rows);
  for (int i = 0; i < rows; ++i) values(i) = Number(place[i]);
  return values;
}

// What is asked for as dense.
void RequireMemory(const AnyProblem& problem, const JsonPlace& place, int most = kMostDenseRows) {
  RequireMemory(place.Child(problem.factors() != nullptr ? "factors" : "A", place.json()), problem.rows(),
                most);
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
  const std::string outcomes = fmt::format("one of {}", fmt::join(kOutcomeNames, ", "));
  std::map<std::string, std::string> expect;
  std::map<std::string, std::string> spelling;  // canonical policy -> as written
  for (const auto& [key, outcome] : place.Members()) {
    const std::string& name = outcome.Text(outcomes);
    if (std::find(kOutcomeNames.begin(), kOutcomeNames.end(), name) == kOutcomeNames.end())
      outcome.Refuse(outcomes);
    const auto [before, is_new] = spelling.emplace(CanonicalPolicy(key, outcome), key);
    if (!is_new)
      outcome.Refuse("a duplicate key", "each policy once (it is " + Shown(before->second) + " too)");
    expect[key] = name;
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
void CheckContacts(const Contacts& contacts, int dimension, int rows) {
  STICTION_CHECK(dimension == 2 || dimension == 3, "the dimension is neither 2 nor 3");
  for (const Contact<Rational>& contact : contacts) CheckContact(contact, dimension);
  STICTION_CHECK(rows == RowCount(contacts, dimension), "b does not have one row per row of the contacts");
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

Json MatrixToJson(const Matrix& A, int rows) {
  STICTION_CHECK(A.rows() == rows && A.cols() == rows, "A does not fit the contacts");
  return IsBestSparse(A) ? EntriesToJson(A) : RowsJson(A);
}

// The same of any sparse matrix. An entry without its mirror stands beside a zero.
Json EntriesToJson(const Eigen::SparseMatrix<Rational>& A) {
  Json entries = Json::array();
  const auto add = [&entries](int i, int j, const Rational& x) {
    entries.push_back(Json::array({i, j, ToString(x)}));
  };
  const SparseMatrix by_rows = ByRows(A);
  for (const auto& [at, value] : by_rows) {
    const auto [i, j] = at;
    const auto mirror = by_rows.find({j, i});
    if (mirror == by_rows.end()) add(j, i, 0);
    if (i >= j || mirror == by_rows.end() || mirror->second != value) add(i, j, value);
  }
  return {{"size", A.rows()}, {"entries", std::move(entries)}};
}

// All but A and b.
Json ContactsToJson(const std::vector<Contact<Rational>>& contacts, int dimension, int rows) {
  CheckContacts(contacts, dimension, rows);
  Json json = {{"format", kFormat}, {"version", kVersion}, {"dimension", dimension}};
  json["contacts"] = Json::array();
  for (const auto& contact : contacts) json["contacts"].push_back(ContactToJson(contact, dimension));
  return json;
}

// In the form that it has.
Json AnyProblemToJson(const AnyProblem& problem) {
  Json json = ContactsToJson(problem.contacts(), problem.dimension(), problem.rows());
  if (problem.factors() != nullptr) {
    json["factors"] = ToJson(*problem.factors());
    return json;
  }
  json["A"] =
      problem.IsDense() ? MatrixToJson(problem.dense().A, problem.rows()) : EntriesToJson(problem.entries().A);
  json["b"] = ListJson(problem.b());
  return json;
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

std::string PrintedEntries(const Json& value) {
  return fmt::format(R"({{"size": {}, "entries": {}}})", JsonText(value["size"]),
                     LinePerItem(value["entries"]));
}

std::string PrintedFactors(const Json& factors) {
  std::vector<std::string> members;
  for (const auto& [key, value] : factors.items())
    members.push_back(JsonText(key) + ": " + (key == "J" ? PrintedEntries(value) : JsonText(value)));
  return fmt::format("{{{}}}", fmt::join(members, ",\n  "));
}

std::string PrintedValue(const std::string& key, const Json& value) {
  if (key == "A" && value.is_object()) return PrintedEntries(value);
  if (key == "factors") return PrintedFactors(value);
  if (key == "contacts" || key == "A") return LinePerItem(value);
  if (key == "scene" || key == "origin" || key == "expect") return Indented(value);
  return JsonText(value);
}

std::string PrintFile(const Json& json) {
  RequireWritable(json);
  std::string text = "{";
  for (const auto& member : json.items()) {
    const bool same_line = member.key() == "version" || member.key() == "dimension";
    text += text == "{" ? "\n  " : same_line ? ", " : ",\n  ";
    text += JsonText(member.key()) + ": " + PrintedValue(member.key(), member.value());
  }
  return text + "\n}\n";
}

// The exact value of a JSON number or string; empty where it has none.
std::optional<Rational> ExactValue(const Json& json) {
  if (json.is_string()) return ParseRational(json.get_ref<const std::string&>());
  if (json.is_number_integer()) {
    const Rational x = *ParseRational(JsonText(json));
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
  const bool is_tiny = json.is_number_float() && std::fpclassify(json.get<double>()) == FP_SUBNORMAL;
  if (!strict && is_tiny) {
    place.Refuse(fmt::format("{}, where doubles have fewer digits", Shown(json)),
                 fmt::format("a number of magnitude {} or more; as a string it is exact",
                             std::numeric_limits<double>::min()));
  }
  if (x.has_value()) return *std::move(x);
  if (!strict && json.is_number_integer()) place.Refuse("an integer that is a double exactly, or a string");
  place.Refuse(std::string(strict ? "an exact number as a string" : "a number") +
               R"(, such as "-3/4" (denominator not zero) or "2.5e-3" (exponent within 10000))");
}

ProblemFile ParseProblem(std::string_view text, const std::string& source, int most_rows) {
  const JsonPlace place(text, source);
  Faults faults(source);
  ProblemFile file;
  file.problem = ProblemReader(false).Read(place, faults);
  file.name = Printable(std::filesystem::path(source).stem().string());
  faults.Try([&] {
    if (const auto name = place.Optional("name")) file.name = name->Text("a string");
  });
  if (const auto scene = place.Optional("scene")) file.scene = scene->json();
  faults.Try([&] {
    const auto origin = place.Optional("origin");
    if (!origin) return;
    origin->RequireObject();
    file.origin = origin->json();
  });
  faults.Try([&] {
    if (const auto expect = place.Optional("expect")) file.expect = ReadExpect(*expect);
  });
  faults.Throw();
  RequireMemory(file.problem, place, most_rows);
  return file;
}

void RequireFewRows(const AnyProblem& problem, const std::string& source) {
  if (problem.rows() <= kMostDenseRows) return;
  throw InputError(source, "rows", std::to_string(problem.rows()),
                   fmt::format("at most {} for a dense matrix; stiction solve and stiction survey take more",
                               kMostDenseRows));
}

bool StaysSparse(const AnyProblem& problem) {
  return problem.rows() > (problem.factors() != nullptr ? kMostDenseRows / 4 : kMostDenseRows);
}

ExactProblem ProblemFromJson(const Json& json, const std::string& source, const std::string& path,
                             bool strict) {
  const JsonPlace place(json, source, path);
  Faults faults(source);
  const AnyProblem read = ProblemReader(strict).Read(place, faults);
  faults.Throw();
  RequireMemory(read, place);
  return read;
}

SharedJson ProblemToJson(const ExactProblem& problem) {
  Json json = ContactsToJson(problem.contacts, problem.dimension, problem.rows());
  json["A"] = MatrixToJson(problem.A, problem.rows());
  json["b"] = ListJson(problem.b);
  return json;
}

std::string_view Name(ContactKind kind) { return kKindNames[static_cast<int>(kind)]; }

SharedJson ToJson(const ProblemFile& file) {
  const Json problem = AnyProblemToJson(file.problem);
  Json json;
  for (const auto& member : problem.items()) {
    if (member.key() == "dimension") json["name"] = file.name;
    json[member.key()] = member.value();
  }
  if (file.scene) json["scene"] = file.scene;
  if (file.origin) json["origin"] = file.origin;
  if (!file.expect.empty()) json["expect"] = file.expect;
  return json;
}

std::string Print(const ProblemFile& file) { return PrintFile(ToJson(file)); }

}  // namespace stiction
