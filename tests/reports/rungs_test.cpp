// SPDX-License-Identifier: Apache-2.0
// Measurements of rungs in a report: files as bench writes them, and what is refused.

#include "reports/page/rungs.h"

#include <catch2/catch.hpp>

#include "corpus/atomic_file.h"
#include "corpus/input_error.h"
#include "corpus/json.h"
#include "tests/scratch.h"

namespace stiction {
namespace {

using Catch::Matchers::Contains;

const std::string kHead =
    "family,setting,method,arithmetic,problems,solved,undecided,other,refused,wrong,wrong_share_low,wrong_"
    "share_high,"
    "silent,silent_share_low,silent_share_high,microseconds_low,microseconds_median,microseconds_high,residual_"
    "low,"
    "residual_median,residual_high,worst_residual,decided_on_double,decided_on_double-double,decided_on_"
    "exact\n";

std::string Line(const std::string& family, const std::string& method, const std::string& arithmetic,
                 const std::string& counts = "25,20,3,1,1,2", const std::string& times = "1.5,2.5,3.5") {
  return family + ",8," + method + "," + arithmetic + "," + counts + ",0,0.2,0,0,0.1," + times +
         ",0,1e-17,1e-16,2e-16,0,0,0\n";
}

std::vector<RungLine> Read(const std::string& text) {
  const testing::Scratch scratch;
  WriteText(scratch / "rungs.csv", text);
  return ReadRungs(scratch / "rungs.csv");
}

TEST_CASE("rungs: a line of every column") {
  const auto lines = Read(kHead + Line("masses", "complete", "double") +
                          Line("masses", "fast", "float", "25,0,0,0,25,0", ",,"));
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].family == "masses");
  CHECK(lines[0].counts == Numbers{{"problems", 25},
                                   {"solved", 20},
                                   {"undecided", 3},
                                   {"other", 1},
                                   {"refused", 1},
                                   {"asked", 24},
                                   {"wrong", 2},
                                   {"silent", 0}});
  CHECK(lines[0].microseconds == std::vector{2.5});
  CHECK(lines[0].worst_residual == 2e-16);
  CHECK(lines[1].microseconds.empty());
}

TEST_CASE("rungs: a file that is none of bench is refused by its place") {
  CHECK_THROWS_WITH(Read(""), Contains("found no line"));
  CHECK_THROWS_WITH(Read("family,setting\nmasses,8\n"), Contains(":1: found no column method"));
  CHECK_THROWS_WITH(Read(kHead + "masses,8\n"), Contains("row 2: found 2 cells, expected 25"));
  CHECK_THROWS_WITH(Read(kHead + Line("masses", "fast", "double", "25,x,3,1,1,2")),
                    Contains("row 2: solved: found 'x'"));
  CHECK_THROWS_WITH(Read(kHead + Line("masses", "fast", "double", "25,-4,27,1,1,2")),
                    Contains("solved: found '-4'"));
  CHECK_THROWS_WITH(Read(kHead + Line("masses", "fast", "double", "25,20,3,1,0,2")),
                    Contains("do not add up to 25"));
  CHECK_THROWS_WITH(Read(kHead + "masses,8,fast,double,25,20,3,1,1,2,0,0.2,3,0,0.1,1,2,3,0,0,0,0,0,0,0\n"),
                    Contains("do not add up to 25"));  // silent is a part of wrong
  CHECK_THROWS_WITH(Read(kHead + Line("masses", "fast", "double", "25,20,3,1,1,2", "1,nan,2")),
                    Contains("microseconds_median"));
  CHECK_THROWS_AS(ReadRungs("/nowhere/rungs.csv"), InputError);
}

TEST_CASE("rungs: a table with the families one below the other, and a figure") {
  const auto lines =
      Read(kHead + Line("masses", "complete", "double") + Line("<b>", "fast", "float", "25,0,0,0,25,0", ",,") +
           Line("masses", "complete", "filtered"));
  Facts facts;
  AddRungs(facts, lines);
  CHECK(facts.numbers.at("rungs_timed") == 1);
  std::string families;
  const std::vector<Table> tables = facts.tables.at("rungs")();
  for (const Table::Row& row : tables.front().rows) families += Shown(row.cells[0]) + " ";
  CHECK(families == "masses masses <b> ");
  const Json rows = ToJson(RungsFigure(lines))->at("rows");
  REQUIRE(rows.size() == 2);  // the third has no time
  CHECK(rows[1] == Json({"masses", "complete", "filtered", 2.5, 5.0 / 24, 24, 20, 2, 3}));
}

}  // namespace
}  // namespace stiction
