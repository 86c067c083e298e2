// SPDX-License-Identifier: Apache-2.0
// Contenders on the same problems, by turns: times, and what their answers are worth.
//
// time      the less of wall-clock time and of the processor time of all threads; groups of consecutive
//           problems where one is too short for the clock. No problem is solved twice in a row, which would
//           teach the processor its branches.
// ratio     of the times of the same group, to the first row
// answers   solved: a lenient error of at most kWrong (solver/problem/lenient.h), in space of
//           Coulomb's law, whatever is claimed; wrong: anything else; silent: wrong and called a success;
//           refused: called a failure, right or wrong.
// capped    a contender that needs more than a bound for the first problem, or dies on it: tried in a process
//           of its own

#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/peers/one_thread.h"
#include "bench/peers/tables.h"
#include "corpus/order_statistics.h"

namespace stiction {

inline constexpr double kWrong = 1e-6;

// What its answers are judged by: nothing, since it solves a linear system; its own word, since it solves
// another law; or the residual.
enum class Judge { kNone, kClaim, kResidual };

struct Setting {
  std::string name;                                  // empty: the only one
  std::function<std::unique_ptr<Contender>()> make;  // null if its package is missing
};

struct PeerRow {
  std::string name;
  std::string package;            // of the peer; empty for our own
  std::vector<Setting> settings;  // the best on the problems at hand is measured
  Judge judge = Judge::kResidual;
};

struct Score {
  int tried = 0, wrong = 0, silent = 0, refused = 0;
  double residual = 0, worst = 0;  // median, most; infinite where one is not a number
  std::map<std::string, int> by;   // of `auto`: the method that answered, how often

  double share() const { return tried > 0 ? 1 - static_cast<double>(wrong) / tried : 0; }  // solved
};

struct PeerCell {
  bool installed = true, capped = false;
  std::string setting;
  Quartiles seconds, ratio;  // of one problem
  Quartiles processor;       // of one problem, s: of all threads
  Clocks spent;              // in all of its timed calls
  Score answers;

  bool measured() const { return installed && !capped; }
};

// Requires problems, all of as many rows, and rows. By row.
std::vector<PeerCell> MeasureRows(const std::vector<PeerRow>& rows, const std::vector<PeerProblem>& problems,
                                  const PeersOptions& o);

// The rows that random.cpp and structure.cpp share: without friction, in the plane, in space.
std::vector<PeerRow> FrictionlessRows();
std::vector<PeerRow> PlanarRows();
std::vector<PeerRow> SpatialRows();

// Peers that solve a larger share than a row of ours, or as large a share in less time.
struct Ahead {
  std::string ours, peer;
  double ratio = 0, our_ratio = 0, share = 0, our_share = 0;
};
std::vector<Ahead> PeersAhead(const std::vector<PeerRow>& rows, const std::vector<PeerCell>& cells,
                              std::string_view ours);
std::string AheadText(const std::vector<Ahead>& ahead);

Json CellJson(const PeerRow& row, const PeerCell& cell);
Json ToJson(const std::vector<Ahead>& ahead);

}  // namespace stiction
