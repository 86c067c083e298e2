// SPDX-License-Identifier: Apache-2.0
// What is said of a loop comes from the kind of its certificate.

#include "corpus/record/loop_sentence.h"

#include <catch2/catch.hpp>

#include "corpus/grouped.h"
#include "corpus/json.h"

namespace stiction {
namespace {

Json InSpace(const char* claim, const char* kind) {
  return {{"claim", claim},
          {"witness",
           {{"policy", "paper"}, {"kind", kind}, {"start", 5}, {"period", 48}, {"word", {"a", "b", "c"}}}}};
}

// Two runs, of which the second is that of a policy.
Json InPlane() {
  const Json steps = Json::array({1, 2, 3});
  return {
      {"claim", "cycle"},
      {"witness",
       {{"runs",
         {{{"policies", {"paper"}}, {"start", 3}, {"period", 4}, {"pivots", steps}},
          {{"policies", {"scan=highest", "file=yes"}}, {"start", 1}, {"period", 1}, {"pivots", {1, 2}}}}}}}};
}

std::string SentenceOf(const Json& certificate, const std::string& policy = "paper") {
  return LoopSentence(ProvedRunOf(certificate, policy));
}

TEST_CASE("loop sentence: exact states recur") {
  CHECK(SentenceOf(InPlane()) == "the state after 3 drives recurs 4 drives later, for ever");
  CHECK(SentenceOf(InPlane(), "file=yes") == "the state after 1 drive recurs 1 drive later, for ever");
  CHECK(ProvedRunOf(InPlane(), "file=yes").steps == 2);
  CHECK(ProvedRunOf(InPlane(), "paper").Recurs());
}

TEST_CASE("loop sentence: in space the sets of a state recur") {
  CHECK(SentenceOf(InSpace("cycle", "states")) == "the state after 5 drives recurs 48 drives later, for ever");
}

TEST_CASE("loop sentence: of a run that stays in a box no state is said to recur") {
  for (const char* kind : {"box", "punctured"}) {
    const ProvedRun run = ProvedRunOf(InSpace("cycle", kind), "paper");
    CHECK_FALSE(run.Recurs());
    CHECK(Name(run.kind) == "box");
    CHECK(LoopSentence(run) ==
          "from the state after 5 drives on it never leaves a box, the same steps every 48 drives, for ever");
  }
}

TEST_CASE("loop sentence: an endless run is said to repeat no state") {
  CHECK(SentenceOf(InSpace("endless", "box")) ==
        "no state recurs: from the state after 5 drives on it never leaves a box, the same steps every 48 "
        "drives, for "
        "ever");
  CHECK(Name(ProvedRunOf(InSpace("endless", "punctured"), "paper").kind) == "endless");
}

TEST_CASE("loop sentence: a ray ends") {
  const Json ray = {{"claim", "ray"}, {"witness", {{"policy", "paper"}, {"bits", 64}, {"word", {"a", "b"}}}}};
  CHECK(SentenceOf(ray) == "after 2 steps it comes to a step that nothing limits");
}

TEST_CASE("loop sentence: without a certificate nothing is said to recur") {
  CHECK(ProvedRunOf(nullptr, "paper").kind == ProofKind::kNone);
  CHECK(ProvedRunOf({{"claim", "psd"}, {"witness", Json::object()}}, "paper").kind == ProofKind::kNone);
  CHECK(LoopClause({ProofKind::kNone, 2, 1}) ==
        "from the state after 2 drives on the same steps every 1 drive");
}

TEST_CASE("counts: one of a thing is singular, whatever the noun") {
  CHECK(Counted(1, "prefix") == "1 prefix");
  CHECK(Counted(2, "prefix") == "2 prefixes");
  CHECK(Counted(0, "body") == "0 bodies");
  CHECK(Counted(3, "policy") == "3 policies");
  CHECK(Counted(2, "drive") == "2 drives");
  CHECK(Counted(2, "way") == "2 ways");
  CHECK(Counted(1234, "audited run") == "1,234 audited runs");
}

}  // namespace
}  // namespace stiction
