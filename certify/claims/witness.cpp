// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/witness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string_view>
#include <vector>

#include "corpus/exact_number.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"

namespace stiction {

Json MakeCertificate(const char* claim, const ExactProblem& problem, Json witness) {
  return {{"format", "stiction-certificate"},
          {"version", 1},
          {"claim", claim},
          {"problem", ProblemToJson(problem)},
          {"witness", std::move(witness)}};
}

Json WordToJson(const ModeWord& word) {
  Json json = Json::array();
  for (const Mode mode : word) json.push_back(Name(mode));
  return json;
}

void RequireKeys(const Json& json, const std::string& path, const std::set<std::string>& keys) {
  if (!json.is_object()) throw Rejected{path, Shown(json), "an object"};
  const std::string expected = fmt::format("{}", fmt::join(keys, ", "));
  for (const auto& [key, value] : json.items()) {
    if (!keys.contains(key)) throw Rejected{path + "." + key, "an unknown key", expected};
  }
  for (const std::string& key : keys) {
    if (!json.contains(key)) throw Rejected{path, "no key '" + key + "'", expected};
  }
}

void RequireEqual(const Rational& found, const Rational& expected, const std::string& path) {
  if (found != expected) throw Rejected{path, ToString(found), ToString(expected)};
}

void RequireList(const Json& json, const std::string& path) {
  if (!json.is_array()) throw Rejected{path, Shown(json), "a list"};
}

void RequireList(const Json& json, const std::string& path, std::size_t size, const char* items) {
  if (json.is_array() && json.size() == size) return;
  throw Rejected{path, Shown(json), fmt::format("a list of {} {}", size, items)};
}

Rational ReadNumber(const Json& json, const std::string& path) {
  const auto* text = json.get_ptr<const std::string*>();  // null if it is no text
  if (text != nullptr && text->size() > kMostCharactersOfNumber) {
    throw Rejected{path, Shown(json), fmt::format("at most {} characters", kMostCharactersOfNumber)};
  }
  if (text != nullptr) {
    if (const auto value = ParseRational(*text)) return *value;
  }
  throw Rejected{path, Shown(json), "an exact number as a string"};
}

std::int64_t ReadInteger(const Json& json, const std::string& path, std::int64_t least) {
  const bool fits = json.is_number_unsigned() ? json.get<std::uint64_t>() <= std::uint64_t{INT64_MAX}
                                              : json.is_number_integer();
  if (fits && json.get<std::int64_t>() >= least) return json.get<std::int64_t>();
  throw Rejected{path, Shown(json), fmt::format("an integer >= {}", least)};
}

ExactVector ReadVector(const Json& json, const std::string& path, int size) {
  RequireList(json, path, static_cast<std::size_t>(size), "numbers");
  ExactVector values(size);
  for (int i = 0; i < size; ++i) values[i] = ReadNumber(json[i], ElementPath(path, i));
  return values;
}

ModeWord ReadPrefix(const Json& json, const std::string& path, const ExactProblem& problem) {
  const std::size_t contacts = problem.contacts.size();
  if (!json.is_array() || json.size() > contacts) {
    throw Rejected{path, Shown(json), fmt::format("a list of at most {} modes", contacts)};
  }
  ModeWord prefix;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const auto modes = ModesOf(problem.contacts[i], problem.dimension);
    const auto* name = json[i].get_ptr<const std::string*>();  // null if it is no text
    const auto mode =
        std::ranges::find_if(modes, [name](Mode m) { return name != nullptr && *name == Name(m); });
    if (mode == modes.end()) {
      const ModeWord all(modes.begin(), modes.end());
      throw Rejected{ElementPath(path, i), Shown(json[i]), "one of " + JsonText(WordToJson(all))};
    }
    prefix.push_back(*mode);
  }
  return prefix;
}

// ---- Cost --------------------------------------------------------------------------------------

namespace {

std::int64_t CharactersOf(std::string_view text) {
  return std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
}

std::int64_t LengthOf(const Json& json) {
  std::int64_t length = 2;
  if (const auto* text = json.get_ptr<const std::string*>()) return length + CharactersOf(*text);
  if (json.is_array())
    for (const Json& item : json) length += LengthOf(item);
  if (json.is_object())
    for (const auto& [key, item] : json.items()) length += CharactersOf(key) + LengthOf(item);
  return length;
}

// The largest integer whose square is not larger.
std::int64_t Root(double square) {
  auto root = static_cast<std::int64_t>(std::sqrt(std::max(square, 0.0)));
  while (static_cast<double>(root) * static_cast<double>(root) > square) --root;
  while (static_cast<double>(root + 1) * static_cast<double>(root + 1) <= square) ++root;
  return root;
}

// Row i of A and b.
std::vector<Rational> RowOf(const ExactProblem& problem, int i) {
  std::vector<Rational> row = {problem.b[i]};
  for (int j = 0; j < problem.rows(); ++j) row.push_back(problem.A(i, j));
  return row;
}

}  // namespace

Budget::Budget(std::initializer_list<const Json*> values) : before_(length_) {
  length_ = 0;
  for (const Json* value : values) length_ += LengthOf(*value);
}

void RefuseCost(const std::string& found, const std::string& most) {
  throw TooDear{{"certificate", found, "no more than the limit" + most}};
}

void RequireWork(double work) {
  const double most = Budget::MostWork();
  if (work <= most) return;
  RefuseCost(fmt::format("a claim of work {:.0f}", work),
             fmt::format(" of {:.0f}, by its length of {}", most, Budget::Length()));
}

double ProductOperations(double n, double times) { return std::floor(times * (n * n + 64 * n + 320) / 16); }

double EliminationOperations(double n, double times) {
  return std::floor(times * (n * n * n + 60 * n * n) / 24);
}

double WordOperations(double n, double times) {
  return std::floor(times * (n * n * n + 40 * n * n + 500 * n + 1000) / 300);
}

double StepOperations(double n, double policies) {
  return std::floor(n * n * n / 4) + 3 * n * n + 100 * n + (5 * n + 40) * policies;
}

double StepInSpaceOperations(double n, double coordinates, double times) {
  return std::floor(times * (1 + coordinates) * (n * n * n + 20 * n * n + 300 * n) / 4);
}

Cost::Cost(double operations) {
  RequireWork(operations * Budget::kShort);
  most_ = Root(std::floor(Budget::MostWork() / std::max(operations, 1.0)) - Budget::kShort);
}

void Cost::Add(std::int64_t bits) {
  bits_ += bits;
  if (bits_ <= most_) return;
  RefuseCost(fmt::format("numbers that grow beyond {} bits", most_),
             ": fewer bits, for as many operations as the claim takes");
}

// Of the common denominator and of the largest numerator; it need not be known exactly beyond the limit.
std::int64_t Cost::Bits(std::span<const Rational> numbers) const {
  using Parts = Fractions<Rational>;
  Parts::Integer denominator = 1;
  std::int64_t numerator = 1;
  for (const Rational& x : numbers) {
    Parts::Include(denominator, x);
    if (BitLength<Parts::Integer>::Of(denominator) > most_) return most_ + 1;
  }
  for (const Rational& x : numbers)
    numerator = std::max(numerator, BitLength<Parts::Integer>::Of(Parts::Numerator(x, denominator)));
  return BitLength<Parts::Integer>::Of(denominator) + numerator;
}

Cost& Cost::Numbers(std::span<const Rational> numbers, int times) {
  Add(times * Bits(numbers));
  return *this;
}

Cost& Cost::Vector(const ExactVector& x, int times) {
  return Numbers({x.data(), static_cast<std::size_t>(x.size())}, times);
}

Cost& Cost::AddBits(std::int64_t bits) {
  Add(bits);
  return *this;
}

std::int64_t Cost::BitsOf(const ExactVector& x) const {
  return Bits({x.data(), static_cast<std::size_t>(x.size())});
}

Cost& Cost::LongestRow(const ExactProblem& problem) {
  std::int64_t longest = 0;
  for (int i = 0; i < problem.rows(); ++i) {
    const ExactVector column = problem.A.col(i);
    longest = std::max({longest, Bits(RowOf(problem, i)), Bits({column.data(), std::size_t(column.size())})});
    if (longest > most_) break;
  }
  Add(longest);
  return *this;
}

Cost& Cost::AllRows(const ExactProblem& problem) {
  std::vector<Rational> mu;
  for (const Contact<Rational>& contact : problem.contacts)
    if (contact.HasFrictionRows()) mu.push_back(contact.mu);
  const std::int64_t friction = Bits(mu);
  for (int i = 0; i < problem.rows(); ++i) Add(Bits(RowOf(problem, i)) + friction);
  return *this;
}

namespace {

// Rows that A couples: no entry lies in the rows of one group and the columns of another.
std::vector<std::vector<int>> GroupsOf(const std::vector<std::vector<int>>& columns) {
  const int n = static_cast<int>(columns.size());
  std::vector<int> first(n);
  std::iota(first.begin(), first.end(), 0);
  const auto group = [&first](int i) {
    while (first[i] != i) i = first[i] = first[first[i]];
    return i;
  };
  for (int i = 0; i < n; ++i)
    for (const int j : columns[i]) first[group(j)] = group(i);
  std::map<int, std::vector<int>> groups;
  for (int i = 0; i < n; ++i) groups[group(i)].push_back(i);
  std::vector<std::vector<int>> listed;
  for (auto& [_, rows] : groups) listed.push_back(std::move(rows));
  return listed;
}

// What certificates.md says of a product, before it is made: added up over groups of rows.
class ProductCost {
 public:
  explicit ProductCost(const ExactProblem& problem)
      : problem_(problem), columns_(problem.rows()), rows_(problem.rows()) {
    for (int i = 0; i < problem.rows(); ++i)
      for (int j = 0; j < problem.rows(); ++j)
        if (problem.A(i, j) != 0) columns_[i].push_back(j), rows_[j].push_back(i);
  }

  const std::vector<std::vector<int>>& columns() const { return columns_; }

  void AddGroup(const std::vector<int>& group, const ExactVector& x, int times) {
    Cost cost(static_cast<double>(group.size()));
    std::int64_t longest = 0, entries = 0;
    std::vector<Rational> part;
    for (const int i : group) {
      longest = std::max({longest, cost.Bits(Row(i)), cost.Bits(Column(i))});
      entries += static_cast<std::int64_t>(columns_[i].size());
      part.push_back(x[i]);
    }
    cost.AddBits(longest).Numbers(part, times);
    const double bits = static_cast<double>(cost.bits());
    work_ += static_cast<double>(group.size()) * (Budget::kShort + bits * bits) +
             std::floor(static_cast<double>(entries) * static_cast<double>(longest) * bits / 8);
    RequireWork(work_);
  }

 private:
  // Of A and b, without zeros.
  std::vector<Rational> Row(int i) const {
    std::vector<Rational> row = {problem_.b[i]};
    for (const int j : columns_[i]) row.push_back(problem_.A(i, j));
    return row;
  }
  std::vector<Rational> Column(int j) const {
    std::vector<Rational> column;
    for (const int i : rows_[j]) column.push_back(problem_.A(i, j));
    return column;
  }

  const ExactProblem& problem_;
  std::vector<std::vector<int>> columns_, rows_;  // of every row, and of every column, those of its entries
  double work_ = 0;
};

}  // namespace

void RequireCheapProduct(const ExactProblem& problem, const ExactVector& x) {
  ProductCost cost(problem);
  for (const auto& group : GroupsOf(cost.columns())) cost.AddGroup(group, x, 1);
}

void RequireCheapSquare(const ExactProblem& problem, const ExactVector& x) {
  std::vector<int> all(problem.rows());
  std::iota(all.begin(), all.end(), 0);
  ProductCost(problem).AddGroup(all, x, 2);
}

std::optional<Rejected> FindFault(WitnessCheck& check, const ExactProblem& problem, const Json& witness) {
  const SharedJson described = ProblemToJson(problem);
  const Budget budget({&*described, &witness});
  try {
    check(problem, witness);
    return std::nullopt;
  } catch (const TooDear&) {
    return std::nullopt;
  } catch (const Rejected& rejected) {
    return rejected;
  }
}

}  // namespace stiction
