// SPDX-License-Identifier: Apache-2.0
// The page of benchmarks alone, and the records with what an optimized search sets beside them.

#include <catch2/catch.hpp>

#include "corpus/json.h"
#include "reports/page/page.h"

namespace stiction {
namespace {

using Catch::Matchers::Contains;

std::vector<FrontierLine> KnownRecords() {
  return {{.name = "steps-3-contacts",
           .what = "steps",
           .objective = "steps",
           .high = true,
           .value = "78",
           .status = "best so far",
           .command = "search",
           .random = "42",
           .evaluations = 1000,
           .random_command = "draw"},
          {.name = "friction-gravity-3-contacts",
           .what = "friction",
           .objective = "friction",
           .high = false,
           .value = "1/88",
           .status = "best so far",
           .command = "search",
           .random = "",
           .evaluations = 300,
           .random_command = "draw"}};
}

RungLine Measured(const std::string& arithmetic, std::int64_t wrong, std::int64_t silent) {
  return {.family = "masses",
          .method = "complete",
          .arithmetic = arithmetic,
          .counts = {{"problems", 25},
                     {"solved", 24},
                     {"undecided", 0},
                     {"other", 0},
                     {"refused", 1},
                     {"asked", 24},
                     {"wrong", wrong},
                     {"silent", silent}},
          .microseconds = {2.5},
          .worst_residual = 0};
}

TEST_CASE("measured: the figure of the records has numbers, and nothing where nothing was reached") {
  const Json rows = ToJson(FrontiersFigure(KnownRecords()))->at("rows");
  REQUIRE(rows.size() == 2);
  CHECK(rows[0] == Json({"steps-3-contacts", "steps", "higher", 78, 42, 1000, "steps"}));
  CHECK(rows[1][2] == "lower");
  CHECK(rows[1][3] == 0.0113636);
  CHECK(rows[1][4].is_null());
}

TEST_CASE("measured: the best of a search stands beside the records of its objective and size alone") {
  const std::vector<FrontierLine> records = KnownRecords();
  for (const int contacts : {3, 4}) {
    const std::vector<OwnBest> own = {{"friction", "fine-scenes", "1", "1/5", contacts}};
    Facts facts;
    AddFrontiers(facts, records, own);
    CHECK(facts.numbers.at("records") == 2);
    const std::string beside = Shown(facts.tables.at("own")().front().rows.at(0).cells.back());
    CHECK(beside == (contacts == 3 ? "friction-gravity-3-contacts 1/88" : ""));
  }
}

TEST_CASE("measured: the page counts rounded numbers apart from exact ones, and remedies as no arithmetic") {
  ReportContent content;
  content.rungs = {Measured("double", 2, 1), Measured("double scaled", 3, 0), Measured("filtered", 0, 0)};
  content.benches = {"/somewhere/trade.csv"};
  const std::string page = Page("measured", content, Tell(content, {"measured"}), {RungsFigure(content.rungs)});
  for (const char* said :
       {"1 method over 2 arithmetics, on 1 kind of problems",
        "Over rounded numbers of 48 runs 5 were wrong, 1 of them silently",
        "of 24 runs 0 were wrong, 0 of them silently", "./run report --bench bench/trade.csv -o again"}) {
    INFO(said);
    CHECK((page.find(said) != std::string::npos));
  }
  CHECK((page.find("frontiers.csv") == std::string::npos));  // no records were given
}

TEST_CASE("measured: a file has a name that shells and links take as it is") {
  CHECK(BenchName("/a/b/trade.csv") == "bench/trade.csv");
  const std::string odd = BenchName("a b#c.csv");
  CHECK(odd.find_first_of(" #") == std::string::npos);
  CHECK(odd != BenchName("a b_c.csv"));
}

}  // namespace
}  // namespace stiction
