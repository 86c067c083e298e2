// SPDX-License-Identifier: Apache-2.0
// What waits to be finished: fewest contacts first, a bounded number of each kind, grave ones always.

#include "search/units/backlog.h"

#include <catch2/catch.hpp>
#include <string>

#include "corpus/record/kinds.h"

namespace stiction {
namespace {

Finding Unfinished(const std::string& signature, int contacts, std::int64_t unit,
                   std::string_view kind = "cycle") {
  Finding finding;
  finding.signature = signature;
  finding.kind = kind;
  finding.contacts = contacts;
  finding.unit = unit;
  return finding;
}

std::string TakeAll(Backlog& backlog) {
  std::string signatures;
  while (const auto entry = backlog.Take()) signatures += entry->finding.signature;
  return signatures;
}

TEST_CASE("backlog: fewest contacts come first, then the earliest problem") {
  Backlog backlog({});
  backlog.Add(Unfinished("a", 3, 1));
  backlog.Add(Unfinished("b", 2, 9));
  backlog.Add(Unfinished("c", 2, 4));
  CHECK(backlog.waiting() == 3);
  CHECK(TakeAll(backlog) == "cba");
  CHECK(backlog.waiting() == 0);
}

TEST_CASE("backlog: of a kind and number of contacts so many wait, and the rest is counted") {
  Backlog backlog(2);
  for (const char* signature : {"a", "b", "c", "d"}) backlog.Add(Unfinished(signature, 2, signature[0]));
  backlog.Add(Unfinished("e", 3, 1));
  backlog.Add(Unfinished("f", 2, 1, "ray"));
  backlog.Add(Unfinished("g", 2, 99, kSafeCycle));
  CHECK(backlog.waiting() == 5);
  CHECK(backlog.left_out() == 2);
  CHECK(TakeAll(backlog) == "fabge");
  backlog.Add(Unfinished("h", 2, 1));  // what was taken keeps its place
  CHECK(backlog.left_out() == 3);
  Backlog grave(1);
  for (const char* signature : {"a", "b"}) grave.Add(Unfinished(signature, 2, 1, kDisagreementOfMethods));
  CHECK(grave.waiting() == 2);
}

TEST_CASE("backlog: what is finished takes a place") {
  Backlog backlog(1);
  Finding done = Unfinished("a", 2, 1);
  done.done = true;
  backlog.Add(done);
  backlog.Add(Unfinished("b", 2, 2));
  CHECK(backlog.waiting() == 0);
  CHECK(backlog.left_out() == 1);
}

TEST_CASE("backlog: another representative takes the place of the one before") {
  Backlog backlog(1);
  backlog.Add(Unfinished("a", 2, 5));
  backlog.Add(Unfinished("a", 2, 3));
  CHECK(backlog.waiting() == 1);
  auto entry = backlog.Take();
  REQUIRE(entry);
  CHECK(entry->finding.unit == 3);
  backlog.Add(Unfinished("a", 2, 1));  // while it is in work
  backlog.GiveBack(*std::move(entry));
  CHECK(backlog.waiting() == 1);
  CHECK(backlog.Take()->finding.unit == 1);
  backlog.Add(Unfinished("b", 2, 1));
  CHECK(backlog.left_out() == 1);
  backlog.Add(Unfinished("b", 2, 0));
  CHECK(backlog.left_out() == 1);
}

TEST_CASE("backlog: what ran out of time comes after what was not tried") {
  Backlog backlog({});
  backlog.Add(Unfinished("a", 1, 1));
  backlog.Add(Unfinished("b", 5, 1));
  auto entry = backlog.Take();
  ++entry->tries;
  backlog.GiveBack(*std::move(entry));
  CHECK(TakeAll(backlog) == "ba");
}

TEST_CASE("finishing: a thread spends its share on it, and a try more while there are units") {
  FinishingTime time{0.2};
  CHECK(time.ForTry(0, true) == 2);
  CHECK(time.ForTry(2, true) == 32);
  time.searching = 40;
  CHECK(time.ForTry(1, true) == Approx(10 + 8));
  time.finishing = 11;
  CHECK(time.ForTry(0, true) == 0);
  CHECK(FinishingTime{0, 1000}.ForTry(0, true) == 0);
  CHECK(FinishingTime{1, 0, 1000}.ForTry(0, true) == FinishingTime::kNoBound);
}

TEST_CASE("finishing: after the last unit it ends with the share, or with half a minute") {
  FinishingTime time{0.2};
  CHECK(time.ForTry(0, false) == 2);
  time.finishing = 29;
  CHECK(time.ForTry(3, false) == Approx(1));
  time.finishing = 30;
  CHECK(time.ForTry(3, false) <= 0);
  time.searching = 400;
  CHECK(time.ForTry(1, false) == 8);
  CHECK(time.ForTry(3, false) == Approx(70));
  time.finishing = 100;
  CHECK(time.ForTry(0, false) <= 0);
  CHECK(FinishingTime{0}.ForTry(0, false) <= 0);
  CHECK(FinishingTime{1, 0, 1000}.ForTry(5, false) == FinishingTime::kNoBound);
}

}  // namespace
}  // namespace stiction
