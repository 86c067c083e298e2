// SPDX-License-Identifier: Apache-2.0
#include "cli/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "certify/claims/claims.h"
#include "certify/exact/answer_json.h"
#include "certify/exact/modes.h"
#include "certify/request/solve_in.h"
#include "corpus/json_text.h"
#include "corpus/named_rows.h"
#include "search/summary.h"
#include "search/under_test/solver_report.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

// ---- Reading the notation ----

// Reads one shape, and collects the names in it.
class ShapeReader {
 public:
  explicit ShapeReader(std::string_view shape) : whole_(shape), rest_(shape) {}

  Json Read() {
    Json schema = OneOfSeveral();
    Require(Next().empty() && remark_.empty(), "the end");
    return schema;
  }
  const std::set<std::string>& names() const { return names_; }

 private:
  // What comes next, without blanks and remarks: an item of punctuation or a word; empty at the end.
  std::string_view Next() {
    for (;;) {
      rest_.remove_prefix(std::min(rest_.find_first_not_of(" \n"), rest_.size()));
      if (!rest_.starts_with("//")) break;
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      remark_ = rest_.substr(2, end - 2);
      remark_.erase(0, remark_.find_first_not_of(' '));
      rest_.remove_prefix(end);
    }
    if (rest_.empty()) return rest_;
    if (rest_.starts_with("...")) return rest_.substr(0, 3);
    for (const char quote : {'"', '`'})
      if (rest_[0] == quote) return rest_.substr(0, rest_.find(quote, 1) + 1);
    const auto is_of_word = [](unsigned char c) {
      return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
    };
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_of_word);
    return rest_.substr(0, std::max<std::size_t>(1, static_cast<std::size_t>(end - rest_.begin())));
  }
  std::string_view Take() {
    const std::string_view next = Next();
    rest_.remove_prefix(next.size());
    return next;
  }
  bool TakeIf(std::string_view item) {
    if (Next() != item) return false;
    Take();
    return true;
  }
  void Require(bool so, std::string_view expected) const {
    STICTION_CHECK(so, fmt::format("shape {}: expected {} before '{}'", whole_, expected, rest_));
  }

  Json OneOfSeveral() {
    Json all = Json::array(), values = Json::array();
    do {
      all.push_back(One());
      if (all.back().contains("const")) values.push_back(all.back()["const"]);
    } while (TakeIf("|"));
    if (all.size() == 1) return all[0];
    return values.size() == all.size() ? Json{{"enum", values}} : Json{{"anyOf", all}};
  }

  Json One() {
    if (TakeIf("{")) return Object();
    if (TakeIf("[")) return List();
    const std::string word(Take());
    Require(!word.empty(), "a shape");
    if (word[0] == '"') return {{"const", word.substr(1, word.size() - 2)}};
    if (word[0] == '`') return {{"type", "string"}, {"pattern", word.substr(1, word.size() - 2)}};
    if (std::isdigit(word.back()) != 0) return {{"const", std::stoll(word)}};
    if (word == "text") return {{"type", "string"}};
    if (word == "truth") return {{"type", "boolean"}};
    if (word == "false") return {{"const", false}};
    if (word == "integer") return Integer();
    if (word == "number" || word == "object" || word == "null") return {{"type", word}};
    if (word == "any") return Json::object();
    names_.insert(word);
    return {{"$ref", "#/$defs/" + word}};
  }

  Json Integer() {
    Json schema = {{"type", "integer"}};
    const std::string range(Next());
    const std::size_t dots = range.find("..");
    if (dots == 0 || dots == range.npos) return schema;
    Take();
    schema["minimum"] = std::stoll(range.substr(0, dots));
    if (dots + 2 < range.size()) schema["maximum"] = std::stoll(range.substr(dots + 2));
    return schema;
  }

  Json List() {
    Json items = Json::array({OneOfSeveral()});
    const bool not_empty = TakeIf("+");
    while (TakeIf(",")) items.push_back(OneOfSeveral());
    Require(TakeIf("]"), "']'");
    if (items.size() > 1)
      return {{"type", "array"}, {"prefixItems", items}, {"items", false}, {"minItems", items.size()}};
    Json schema = {{"type", "array"}, {"items", items[0]}};
    if (not_empty) schema["minItems"] = 1;
    return schema;
  }

  Json Object() {
    Json properties = Json::object(), others = false;
    std::set<std::string> required;
    Next();
    const std::string of_the_whole = std::exchange(remark_, "");
    std::string last;
    while (!TakeIf("}")) {
      if (TakeIf("...")) {
        if (Next() == "}" || Next() == ",") {
          others = true;
        } else {
          Spread(std::string(Take()), properties, required);
        }
      } else if (TakeIf("*")) {
        Require(TakeIf(":"), "':'");
        others = OneOfSeveral();
      } else {
        std::string key(Take());
        if (key[0] == '"') key = key.substr(1, key.size() - 2);
        if (TakeIf("?")) {
          required.erase(key);
        } else {
          required.insert(key);
        }
        Require(TakeIf(":"), "':'");
        properties[key] = OneOfSeveral();
        last = key;
      }
      if (Next() != "}") Require(TakeIf(","), "',' or '}'");
      Next();  // a remark behind the comma is of the member before it
      if (!remark_.empty()) properties[last]["description"] = std::exchange(remark_, "");
    }
    remark_ = of_the_whole;
    Json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", others}};
    if (!required.empty()) schema["required"] = required;
    return schema;
  }

  void Spread(const std::string& name, Json& properties, std::set<std::string>& required);

  std::string_view whole_, rest_;
  std::set<std::string> names_;
  std::string remark_;  // behind what was read last
};

const NamedShape& Named(const std::string& name) {
  const NamedShape* const named = RowNamed(NamedShapes(), name);
  STICTION_CHECK(named != nullptr, "no shape has the name " + name);
  return *named;
}

void ShapeReader::Spread(const std::string& name, Json& properties, std::set<std::string>& required) {
  ShapeReader reader(Named(name).shape);
  const Json schema = reader.Read();
  properties.update(schema["properties"]);
  if (schema.contains("required")) required.insert(schema["required"].begin(), schema["required"].end());
  names_.insert(reader.names_.begin(), reader.names_.end());
}

// ---- Shapes that have a name ----

// "a" | "b", of names.
template <class Names>
std::string OneOf(const Names& names) {
  return fmt::format("\"{}\"", fmt::join(names, "\" | \""));
}

std::string OneOfModes() {
  std::vector<std::string_view> names = {"open", "closed"};  // of complete driving's words
  for (const Mode mode :
       {Mode::kHold, Mode::kBreak, Mode::kTouch, Mode::kStick, Mode::kSlipPlus, Mode::kSlipMinus})
    names.push_back(Name(mode));
  return OneOf(names);
}

}  // namespace

const std::vector<NamedShape>& NamedShapes() {
  static const std::vector<NamedShape> shapes = {
      {"exact", R"(`^-?\d+(/\d+)?$`)", "a rational number"},
      {"rounded", R"(number | "inf" | "-inf" | "nan")", "a floating-point number; text where it is not finite"},
      {"any_number", "exact | rounded | [rounded, rounded]", "a pair: an interval"},
      {"vector", "[any_number]", "one number for each row of the problem"},
      {"counters", "{*: integer 0..}", "counters by name"},
      {"outcome", OneOf(kOutcomeNames) + R"( | "no-solution")", ""},
      {"arithmetic", OneOf(kArithmeticNames), ""},
      {"rung", OneOf(kRungNames), "the arithmetic that decided"},
      {"method", OneOf(NamesOf(AllMethods())) + R"( | "auto")", "auto: of a problem without rows"},
      {"claim", OneOf(NamesOf(AllClaims())), ""},
      {"law", OneOf(std::array{Name(FrictionLaw::kBaraff), Name(FrictionLaw::kCoulomb)}), ""},
      {"mode", OneOfModes(), ""},
      {"digest", "`^(sha256:[0-9a-f]{64})?$`", ""},
      {"written", "[text]", "files or folders; - is standard output"},
      {"interval", "{low: number, high: number}", "exact, at 95 %"},
      {"errors", kErrorsShape, "errors of an answer over rounded numbers"},
      {"end", kEndShape, "how a run ended"},
      {"suspected", kSuspicionShape, "what a run said that was done again with more digits"},
      {"solution", kSolutionShape, "an answer of a method"},
      {"answer", "{...solution, assumptions: [assumption]}", "of solve"},
      {"assumption", R"({
         assumption: "symmetric" | "psd" | "in-range" | "h", i?: integer, j?: integer, x?: [exact], y?: [exact],
         v?: [exact], value?: exact, quotient?: number,
         undecided?: text,  // why bounds do not tell whether it fails
         witness?: text,  // the call that writes a vector that is too long for here
       })",
       "an assumption of the paper that fails, with what shows it"},
      {"problem", R"({
         format: "stiction-problem", version: integer, name?: text, dimension: 2 | 3, contacts: [object],
         A?: [any] | object, b?: [any], factors?: object, ...
       })",
       "a stiction-problem file"},
      {"certificate", R"({format: "stiction-certificate", version: integer, claim: text, problem: problem,
                          witness: any, ...})",
       "a stiction-certificate file"},
      {"size", "{contacts: integer, rows: integer, nonzeros: integer, bits: integer}", ""},
      {"threshold", "{low: exact, high: exact, word: [mode], polynomial: [exact]}",
       "a friction coefficient that is a root of the polynomial, between low and high"},
      {"share", "{count: integer, of: integer}", ""},
      {"group", "{generator: text, contacts: integer, policy: text, method: text, arithmetic: arithmetic}",
       "runs that are counted together"},
      {"facts", "{found?: object, minimized?: object, ipopt?: object, ...}",
       "of a finding: the problem as found and as minimized, what all policies make of each, certificates, "
       "Ipopt"},
      {"times", ShapeOfTimes(), "processor time, s"},
      {"summary", ShapeOfSummary(), "what a store holds"},
      {"optimized", ShapeOfOptimized(), "what the store of a search with an objective holds"},
      {"tested", ShapeOfSolver(), "what the store of a search that tests a solver holds"},
  };
  return shapes;
}

SharedJson SchemaOf(std::string_view title, std::string_view description, std::string_view shape) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", title},
                 {"description", description}};
  ShapeReader reader(shape);
  schema.update(reader.Read());
  Json named = Json::object();
  std::vector<std::string> open(reader.names().begin(), reader.names().end());
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    if (named.contains(name)) continue;
    const NamedShape& one = Named(name);
    ShapeReader of_it(one.shape);
    named[name] = of_it.Read();
    if (!one.description.empty()) named[name]["description"] = one.description;
    open.insert(open.end(), of_it.names().begin(), of_it.names().end());
  }
  if (!named.empty()) schema["$defs"] = named;
  return schema;
}

}  // namespace stiction
