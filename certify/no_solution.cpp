// SPDX-License-Identifier: Apache-2.0
#include "certify/no_solution.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "certify/certificate.h"
#include "solver/check.h"

namespace stiction {
namespace {

using enum Mode;

// gF, yF of a contact, zero where it has no friction row.
Rational FrictionEntry(const Contact<Rational>& contact, int row, const ExactVector& values) {
  return contact.HasFrictionRows() ? values[row + 1] : Rational(0);
}

Rational SlipOf(const Contact<Rational>& contact) {
  return contact.kind == ContactKind::kSliding ? contact.slip[0] : Rational(0);
}

}  // namespace

FarkasVector MakeFarkasVector(const ExactProblem& problem, const ExactVector& y) {
  FarkasVector farkas = {y, ExactVector::Constant(problem.rows(), Rational(0)), 0};
  for (int i = 0; i < problem.rows(); ++i) {
    if (y[i] == 0) continue;
    for (int j = 0; j < problem.rows(); ++j) farkas.g[j] += problem.A(i, j) * y[i];
    farkas.value += problem.b[i] * y[i];
  }
  return farkas;
}

bool TermIsNonnegative(const Contact<Rational>& contact, int row, Mode mode, const FarkasVector& farkas) {
  const Rational &yN = farkas.y[row], &gN = farkas.g[row];
  const Rational yF = FrictionEntry(contact, row, farkas.y), gF = FrictionEntry(contact, row, farkas.g);
  const Rational along = contact.mu * gF;
  switch (mode) {
    case kHold:
      return gN == 0;
    case kBreak:
      return yN >= 0 && yF == 0;
    case kTouch:
      return gN - SlipOf(contact) * along <= 0 && yF == 0;
    case kStick:
      return gN + abs(along) <= 0;
    case kSlipPlus:
      return gN - along <= 0 && yF >= 0;
    case kSlipMinus:
      return gN + along <= 0 && yF <= 0;
  }
  return false;
}

namespace {

struct Gap {
  std::size_t contact;
  Mode mode;
};

// The first contact and mode whose term can be negative.
std::optional<Gap> FindGap(const ExactProblem& problem, const ModeWord& prefix, const FarkasVector& farkas) {
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    const auto modes = i < prefix.size() ? std::span(&prefix[i], 1) : ModesOf(contact);
    for (const Mode mode : modes) {
      if (!TermIsNonnegative(contact, row, mode, farkas)) return Gap{i, mode};
    }
    row += contact.HasFrictionRows() ? 2 : 1;
  }
  return std::nullopt;
}

}  // namespace

bool Refutes(const ExactProblem& problem, const ModeWord& prefix, const FarkasVector& farkas) {
  return farkas.value < 0 && !FindGap(problem, prefix, farkas);
}

std::optional<std::string> FindRefutationGap(const ExactProblem& problem, const ModeWord& prefix,
                                             const FarkasVector& farkas) {
  if (farkas.value >= 0) return "y'b = " + ToString(farkas.value) + ", expected a number < 0";
  const auto gap = FindGap(problem, prefix, farkas);
  if (!gap) return std::nullopt;
  return fmt::format("the term of contact {} can be negative in mode {}", gap->contact + 1, Name(gap->mode));
}

Json NoSolutionCertificate(const ExactProblem& problem, const Enumeration& enumeration) {
  STICTION_CHECK(enumeration.ProvesNoSolution(), "a certificate of no solution needs a complete enumeration");
  Json prefixes = Json::array();
  for (const RefutedPrefix& refuted : enumeration.refuted) {
    Json modes = Json::array();
    for (const Mode mode : refuted.modes) modes.push_back(Name(mode));
    prefixes.push_back({{"modes", std::move(modes)}, {"y", VectorToJson(refuted.y)}});
  }
  const Json witness = {{"prefixes", std::move(prefixes)}};
  const NoSolutionCheck check = CheckNoSolution(problem, witness);
  STICTION_CHECK(!check.fault, "a certificate of no solution is none: " + check.fault->path);
  return {{"format", "stiction-certificate"},
          {"version", 1},
          {"claim", "no-solution"},
          {"problem", ProblemToJson(problem)},
          {"witness", witness}};
}

// ---- Checking ----------------------------------------------------------------------------------

namespace {

std::string Shortened(const Json& json) {
  std::string text = json.dump();
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

[[noreturn]] void Reject(const std::string& path, std::string found, std::string expected) {
  throw WitnessFault{path, std::move(found), std::move(expected)};
}

// An object with exactly these keys.
void RequireKeys(const Json& json, const std::string& path, const std::vector<std::string>& keys) {
  const auto is_known = [&](const auto& item) { return std::ranges::count(keys, item.key()) == 1; };
  const bool right =
      json.is_object() && json.size() == keys.size() && std::ranges::all_of(json.items(), is_known);
  if (!right) Reject(path, Shortened(json), fmt::format("an object of {}", fmt::join(keys, ", ")));
}

ExactVector ReadVector(const Json& json, const std::string& path, int size) {
  if (!json.is_array() || static_cast<int>(json.size()) != size) {
    Reject(path, Shortened(json), fmt::format("a list of {} numbers", size));
  }
  ExactVector values(size);
  for (int i = 0; i < size; ++i) {
    const auto value = json[i].is_string() ? ParseRational(json[i].get<std::string>()) : std::nullopt;
    if (!value) Reject(fmt::format("{}[{}]", path, i), Shortened(json[i]), "an exact number as a string");
    values[i] = *value;
  }
  return values;
}

ModeWord ReadPrefix(const Json& json, const std::string& path, const ExactProblem& problem) {
  const std::size_t contacts = problem.contacts.size();
  if (!json.is_array() || json.size() > contacts) {
    Reject(path, Shortened(json), fmt::format("a list of at most {} modes", contacts));
  }
  ModeWord prefix;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const auto modes = ModesOf(problem.contacts[i]);
    const auto mode = std::ranges::find_if(modes, [&](Mode m) { return json[i] == std::string(Name(m)); });
    if (mode == modes.end()) {
      std::vector<std::string_view> names;
      for (const Mode m : modes) names.push_back(Name(m));
      Reject(fmt::format("{}[{}]", path, i), Shortened(json[i]), fmt::format("{}", fmt::join(names, " or ")));
    }
    prefix.push_back(*mode);
  }
  return prefix;
}

// The number of words that begin with a prefix of this length.
mpz_class Completions(const ExactProblem& problem, std::size_t length) {
  mpz_class count = 1;
  for (std::size_t i = length; i < problem.contacts.size(); ++i) count *= ModesOf(problem.contacts[i]).size();
  return count;
}

// No prefix begins another, so their completions are disjoint; then counting them is enough.
void RequireCover(const ExactProblem& problem, const std::vector<ModeWord>& prefixes) {
  const std::string path = "witness.prefixes";
  const std::set<ModeWord> listed(prefixes.begin(), prefixes.end());
  if (listed.size() < prefixes.size()) Reject(path, "a prefix twice", "each once");
  mpz_class covered = 0;
  for (std::size_t k = 0; k < prefixes.size(); ++k) {
    covered += Completions(problem, prefixes[k].size());
    for (ModeWord shorter = prefixes[k]; !shorter.empty();) {
      shorter.pop_back();
      if (listed.contains(shorter)) {
        Reject(fmt::format("{}[{}].modes", path, k), "an extension of another prefix", "none");
      }
    }
  }
  const mpz_class words = Completions(problem, 0);
  if (covered != words) Reject(path, covered.get_str() + " words", words.get_str() + ", all of them");
}

Json CheckPrefixes(const ExactProblem& problem, const Json& witness) {
  if (problem.dimension != 2) Reject("problem.dimension", std::to_string(problem.dimension), "2");
  RequireKeys(witness, "witness", {"prefixes"});
  const Json& listed = witness["prefixes"];
  if (!listed.is_array()) Reject("witness.prefixes", Shortened(listed), "a list");
  std::vector<ModeWord> prefixes;
  for (std::size_t k = 0; k < listed.size(); ++k) {
    const std::string path = fmt::format("witness.prefixes[{}]", k);
    RequireKeys(listed[k], path, {"modes", "y"});
    prefixes.push_back(ReadPrefix(listed[k]["modes"], path + ".modes", problem));
    const ExactVector y = ReadVector(listed[k]["y"], path + ".y", problem.rows());
    if (const auto gap = FindRefutationGap(problem, prefixes.back(), MakeFarkasVector(problem, y))) {
      Reject(path + ".y", *gap, "a refutation of the prefix");
    }
  }
  RequireCover(problem, prefixes);
  return {{"words", Completions(problem, 0).get_str()}, {"prefixes", prefixes.size()}};
}

}  // namespace

NoSolutionCheck CheckNoSolution(const ExactProblem& problem, const Json& witness) {
  try {
    return {std::nullopt, CheckPrefixes(problem, witness)};
  } catch (const WitnessFault& fault) {
    return {fault, nullptr};
  }
}

}  // namespace stiction
