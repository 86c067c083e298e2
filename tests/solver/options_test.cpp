// SPDX-License-Identifier: Apache-2.0
// The table of policy switches, and policies as text.

#include "solver/problem/options.h"

#include <catch2/catch.hpp>
#include <set>

namespace stiction {
namespace {

using Catch::Contains;

std::string Refusal(const std::string& text) {
  try {
    ParsePolicy(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST_CASE("policies: the switches and values are those of the specification, in its order") {
  const std::vector<std::vector<std::string_view>> table = {
      {"scan", "lowest", "normals-first", "most-violated", "highest"},
      {"resume", "restart", "round"},
      {"admit", "lazy", "eager"},
      {"file", "no", "yes"},
      {"give-up", "first", "previous", "second"},
      {"drop", "contact", "variable"},
      {"rezero", "rescan", "continue"},
      {"ties", "sets", "contacts"},
      {"apex", "kept", "suspended"},
      {"slip", "literal", "redirect", "polygon"},
  };
  REQUIRE(table.size() == PolicySwitches().size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    const PolicySwitchRow& row = PolicySwitches()[i];
    CHECK(static_cast<std::size_t>(row.id) == i);
    CHECK(row.planar == (row.name != "slip"));
    std::vector<std::string_view> words = {row.name};
    for (const PolicyValue& value : row.values) words.push_back(value.name);
    CHECK(words == table[i]);
  }
}

TEST_CASE("policies: every switch says what the text leaves open, and quotes where") {
  for (const PolicySwitchRow& row : PolicySwitches()) {
    CAPTURE(row.name);
    CHECK_FALSE(row.question.empty());
    CHECK_FALSE(row.reads.empty());
    for (const PolicyValue& value : row.values) CHECK_FALSE(value.meaning.empty());
  }
}

TEST_CASE("policies: get and set of a switch reach the same field and no other") {
  for (const PolicySwitchRow& row : PolicySwitches()) {
    for (int value = 0; value < static_cast<int>(row.values.size()); ++value) {
      Policy policy;
      row.set(policy, value);
      for (const PolicySwitchRow& other : PolicySwitches()) {
        CHECK(other.get(policy) == (other.id == row.id ? value : 0));
      }
    }
  }
}

TEST_CASE("policies: the planar grid has 1536 policies of different names, paper first") {
  std::set<std::string> names;
  for (const Policy& policy : PlanarGrid()) names.insert(PolicyName(policy));
  CHECK(PlanarGrid().size() == 1536);
  CHECK(names.size() == 1536);
  CHECK(PlanarGrid().front() == Policy{});
  CHECK(PolicyName(PlanarGrid()[1]) == "apex=suspended");
  CHECK(PolicyName(PlanarGrid().back()) ==
        "scan=highest,resume=round,admit=eager,file=yes,give-up=second,drop=variable,rezero=continue,"
        "ties=contacts,apex=suspended");
}

TEST_CASE("policies: every policy is read back from its name") {
  for (Policy policy : PlanarGrid()) {
    CHECK(ParsePolicy(PolicyName(policy)) == policy);
    policy.slip = Slip::kPolygon;
    CHECK(ParsePolicy(PolicyName(policy)) == policy);
  }
}

TEST_CASE("policies: any order and explicit defaults are read, and names are written canonically") {
  CHECK(PolicyName(ParsePolicy("ties=contacts,give-up=second")) == "give-up=second,ties=contacts");
  CHECK(PolicyName(ParsePolicy("scan=lowest")) == "paper");
  CHECK(PolicyName(ParsePolicy("apex=kept,scan=highest,file=no")) == "scan=highest");
  CHECK(ParsePolicy("paper") == Policy{});
}

TEST_CASE("policies: what is wrong with a policy is named") {
  CHECK_THAT(Refusal("scna=lowest"), Contains("'scna=lowest'") && Contains("scan, resume, admit"));
  CHECK_THAT(Refusal("scan=loudest"),
             Contains("'scan'") && Contains("'loudest'") && Contains("lowest, normals-first"));
  CHECK_THAT(Refusal("ties=contacts,give-up=frist"), Contains("'frist'"));
  CHECK_THAT(Refusal("scan"), Contains("'scan'"));
  CHECK_THAT(Refusal("scan="), Contains("'scan'"));
  CHECK_THAT(Refusal(""), Contains("expected 'paper'"));
  CHECK_THAT(Refusal("ties=contacts,"), Contains("expected 'paper'"));
  CHECK_THAT(Refusal("scan=lowest "), Contains("'lowest '"));
  CHECK_THAT(Refusal("paper,ties=contacts"), Contains("'paper'"));
}

TEST_CASE("policies: a switch that stands twice is refused, even with one value") {
  CHECK_THAT(Refusal("ties=contacts,ties=sets"), Contains("'ties' stands twice"));
  CHECK_THAT(Refusal("ties=sets,drop=variable,ties=sets"), Contains("'ties' stands twice"));
}

TEST_CASE("policies: two policies agree on a set of switches if they have its values in common") {
  const Policy left = ParsePolicy("scan=highest,ties=contacts"),
               right = ParsePolicy("scan=highest,drop=variable");
  CHECK(AgreeOn(0, left, right));
  CHECK(AgreeOn(Bit(PolicySwitch::kScan) | Bit(PolicySwitch::kResume), left, right));
  CHECK_FALSE(AgreeOn(Bit(PolicySwitch::kTies), left, right));
  CHECK_FALSE(AgreeOn(Bit(PolicySwitch::kScan) | Bit(PolicySwitch::kDrop), left, right));
}

}  // namespace
}  // namespace stiction
