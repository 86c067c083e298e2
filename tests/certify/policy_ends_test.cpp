// SPDX-License-Identifier: Apache-2.0
// How policies end, as an answer: counts, the example, and what is said of it.

#include "certify/claims/policy_ends.h"

#include <catch2/catch.hpp>

#include "solver/problem/options.h"

namespace stiction {
namespace {

PolicyEnds End(const std::vector<std::string>& policies, Outcome outcome) {
  PolicyEnds end;
  for (const std::string& policy : policies) end.policies.push_back(ParsePolicy(policy));
  end.outcome = outcome;
  return end;
}

constexpr ClaimedVerb kLoops = {"loops", "loop"};

}  // namespace

TEST_CASE("policy ends: a claim of all holds if it does of each, and fails of one") {
  const PolicyEnds loops = End({"file=yes", "ties=contacts"}, Outcome::kCycle),
                   solved = End({"paper"}, Outcome::kSolved), open = End({"apex=suspended"}, Outcome::kLimit);
  const auto answer = [](const std::vector<PolicyEnds>& ends) {
    return AnswerOfEnds(ends, kLoops, EndsIn(Outcome::kCycle));
  };
  CHECK(answer({loops}).state == ClaimState::kProved);
  CHECK(answer({loops, open}).state == ClaimState::kNotDecided);
  CHECK(answer({loops, open, solved}).state == ClaimState::kDisproved);
  const ClaimAnswer all = answer({loops, open, solved});
  REQUIRE(all.policies.has_value());
  CHECK(all.policies->asked == 4);
  CHECK(all.policies->so == 2);
  CHECK(all.policies->open == 1);
  CHECK(all.policies->otherwise == std::map<std::string, std::int64_t>{{"limit", 1}, {"solved", 1}});
}

TEST_CASE(
    "policy ends: the example refutes where one does, and is of the published reading if that is among them") {
  const PolicyEnds first = End({"file=yes"}, Outcome::kSolved), paper = End({"paper"}, Outcome::kSolved),
                   last = End({"ties=contacts"}, Outcome::kSolved),
                   open = End({"apex=suspended"}, Outcome::kLimit);
  const auto example = [](const std::vector<PolicyEnds>& ends) {
    return AnswerOfEnds(ends, kLoops, EndsIn(Outcome::kCycle)).policies->example;
  };
  CHECK(example({first, last}) == PolicyName(first.policies.front()));
  CHECK(example({first, paper, last}) == "paper");
  CHECK(example({open, first, last}) == PolicyName(first.policies.front()));
  CHECK(example({open}) == PolicyName(open.policies.front()));
  CHECK(example({End({"file=yes"}, Outcome::kCycle)}).empty());
}

}  // namespace stiction
