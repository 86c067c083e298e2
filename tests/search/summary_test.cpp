// SPDX-License-Identifier: Apache-2.0
// The summary of a store: every number is a sum over its records, and what is grave stands first.

#include "search/summary.h"

#include <catch2/catch.hpp>
#include <map>
#include <string>

#include "corpus/json.h"
#include "corpus/record/kinds.h"
#include "tests/scratch.h"
#include "tests/two_policies.h"

namespace stiction {
namespace {

using testing::MinimizedTo;
using testing::Scratch;

Finding Waiting(const std::string& signature, std::string_view kind, std::int64_t unit) {
  return testing::Waiting(signature, kind, unit, "{}");
}

Store StoreWith(const std::filesystem::path& file) {
  const std::string definition = R"({"format":"stiction-campaign","version":1,"contacts":[2]})";
  Store store(file, {definition, 7, R"(["paper"])"});
  const Finding cycle = Waiting("cycle-2c-4d-10s-00", "cycle", 0),
                other = Waiting("cycle-2c-4d-12s-00", "cycle", 0);
  const Finding grave = Waiting("safe-cycle-2c-4d-10s-00", kSafeCycle, 1), ray = Waiting("ray-2c", "ray", 1);
  Record record = testing::TwoPolicies();
  record.signatures[grave.signature] = 3;
  store.AddUnit({}, 0, record, {cycle, other});
  store.AddUnit({}, 1, record, {grave, ray});
  store.Finish(MinimizedTo(cycle, "a long problem", R"({"cycle":1536})"));
  store.Finish(MinimizedTo(other, "short", R"({"cycle":36,"solved":1500})"));
  store.Finish(MinimizedTo(grave, "the longest problem of all", R"({"cycle":1536})"));
  return store;
}

TEST_CASE("summary: numbers are sums over all units, problems count once, runs for every policy") {
  const Scratch scratch;
  const Json summary = SummaryToJson(StoreWith(scratch / "s.store"));
  CHECK(summary.at("units") == 2);
  CHECK(summary.at("problems") == 60);
  CHECK(summary.at("runs") == 120);
  CHECK(summary.at("suspicions") == 8);
  CHECK(summary.at("confirmed") == 6);
  CHECK(summary.at("audited") == 14);
  CHECK(summary.at("misjudged") == 10);
  CHECK(summary.at("wrong") == 22);
  CHECK(summary.at("existence_checked") == 26);
  CHECK(summary.at("existence_solved") == 24);
  CHECK(summary.at("compared") == 34);
  CHECK(summary.at("enumerated") == 38);
  CHECK(summary.at("disagreements_of_methods") == 46);
  CHECK(summary.at("safety_decided") == 58);
  CHECK(summary.at("safe") == 62);
  CHECK(summary.at("safe_gave_up") == 74);
  CHECK(summary.at("loops") == 92);
  CHECK(summary.at("loops_without_zero_steps") == 6);
  CHECK(summary.at("loops_of_zero_steps_alone") == 4);
  CHECK(summary.at("finished") == 3);
  CHECK(summary.at("pending") == 1);
  CHECK(summary.at("whole_grid") == 2);
  CHECK(summary.at("failures").get<std::map<std::string, int>>() ==
        std::map<std::string, int>{{"cycle", 4}, {"ray", 2}, {"doubles-differ", 2}, {"wrong-answer", 22}});
  CHECK(summary.at("groups").at("cycle") == 2);
}

TEST_CASE("summary: grave findings are named, and stand before all others") {
  const Scratch scratch;
  const Store store = StoreWith(scratch / "s.store");
  const Json summary = SummaryToJson(store);
  REQUIRE(summary.at("grave").size() == 1);
  CHECK(summary.at("grave")[0].at("signature") == "safe-cycle-2c-4d-10s-00");
  CHECK(summary.at("groups").begin().key() == "safe-cycle");
  const Json& simplest = summary.at("minimized");
  REQUIRE(simplest.size() == 3);
  CHECK(simplest[0].at("signature") == "safe-cycle-2c-4d-10s-00");
  CHECK(simplest[1].at("signature") == "cycle-2c-4d-12s-00");  // of the shorter problem
  CHECK(simplest[2].at("signature") == "cycle-2c-4d-10s-00");
}

}  // namespace
}  // namespace stiction
