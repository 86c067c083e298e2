// SPDX-License-Identifier: Apache-2.0
#include "certify/witness.h"

#include <fmt/format.h>

#include <algorithm>

#include "corpus/exact_number.h"

namespace stiction {

Json MakeCertificate(const char* claim, const ExactProblem& problem, Json witness) {
  return {{"format", "stiction-certificate"},
          {"version", 1},
          {"claim", claim},
          {"problem", ProblemToJson(problem)},
          {"witness", std::move(witness)}};
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
  if (json.is_number_integer() && json.get<std::int64_t>() >= least) return json.get<std::int64_t>();
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
      throw Rejected{ElementPath(path, i), Shown(json[i]), "one of " + WordToJson(all).dump()};
    }
    prefix.push_back(*mode);
  }
  return prefix;
}

std::optional<Rejected> FindFault(WitnessCheck& check, const ExactProblem& problem, const Json& witness) {
  try {
    check(problem, witness);
    return std::nullopt;
  } catch (const Rejected& rejected) {
    return rejected;
  }
}

}  // namespace stiction
