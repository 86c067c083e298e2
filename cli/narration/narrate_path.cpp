// SPDX-License-Identifier: Apache-2.0
// Complete driving and Lemke's method, piece by piece.

#include <algorithm>
#include <sstream>

#include "certify/exact/exact.h"
#include "cli/narration/narrate.h"
#include "cli/narration/narrate_text.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "solver/complete/cells_json.h"

namespace stiction {
namespace {

// The cell of every contact, from a word of the plane (a letter each) or of space (with blanks between them).
std::vector<std::string> CellsOf(const std::string& word, bool in_space) {
  std::vector<std::string> cells;
  if (in_space) {
    std::istringstream words(word);
    for (std::string cell; words >> cell;) cells.push_back(cell);
  } else {
    for (const char cell : word) {
      if (cell != ' ') cells.emplace_back(1, cell);
    }
  }
  return cells;
}

// "S (sticks)": a cell and what its contact does.
std::string CellText(const std::string& cell) {
  static const Json kDoes = ParseJson({reinterpret_cast<const char*>(kCellsJson), sizeof kCellsJson}, "cells");
  const auto does = kDoes.find(cell.substr(0, 1));
  return does == kDoes.end() ? cell : fmt::format("{} ({})", cell, does->get<std::string>());
}

const char* SignText(int sign) { return sign > 0 ? "> 0" : sign < 0 ? "< 0" : "0"; }

// ---- Complete driving ----------------------------------------------------------------------------

template <class Scalar>
class CompleteNarrator {
 public:
  using Step = Pivot<Scalar>;

  CompleteNarrator(const ProblemFile& file, const Answer<Scalar>& answer, const Telling& how)
      : answer_(answer), names_(file.problem), how_(how) {
    if constexpr (kIsExact<Scalar>) {
      if (!names_.in_space()) published_ = RunExact(file.problem, {}).trace.pivots;
    }
  }

  Narration Tell() const {
    Narration narration;
    narration.table = fmt::format("{:>5} {:>6} {:>4} {:>14}  {:12} {}\n", "piece", "driven", "det", "length",
                                  "cells", "what happens");
    narration.before = fmt::format("Before the first piece f = {}.\n", List(answer_.first_f));
    narration.steps = narration.before;
    for (std::size_t k = 0; k < answer_.pivots.size(); ++k) Add(k, narration);
    return narration;
  }

 private:
  void Add(std::size_t k, Narration& narration) const {
    const Step& step = answer_.pivots[k];
    const std::string event = Event(k), driven = names_.Variable(step.driven);
    narration.pivots.push_back(ToJson(step, event));
    if (how_.vectors) narration.told.push_back(ToldToJson(k, event));
    narration.table += fmt::format("{:>5} {:>6} {:>4} {:>14}  {:12} {}\n", k + 1, driven, step.determinant,
                                   Number(step.s), step.word, event);
    narration.steps +=
        fmt::format("\nPiece {}: {}\n  df = {}   da = {}\n  s = {}: {}\n    f = {}   a = {}\n", k + 1,
                    Why(step), List(step.df), List(step.da), Number(step.s), event, List(step.f), List(step.a));
  }

  std::string Number(const Scalar& x) const { return Text(x, how_.fractions); }
  template <class Numbers>
  std::string List(const Numbers& numbers) const {
    return ListText(numbers, how_.fractions);
  }

  std::string Why(const Step& step) const {
    return fmt::format("{} is driven{}, cells {}, determinant {}", names_.Variable(step.driven),
                       step.determinant < 0 ? " backward" : "", step.word, SignText(step.determinant));
  }

  std::string Event(std::size_t k) const {
    const Step& step = answer_.pivots[k];
    const bool last = k + 1 == answer_.pivots.size();
    if (last) return End(step);
    const Step& next = answer_.pivots[k + 1];
    std::string text = next.drive == step.drive ? Changes(step, next) : End(step);
    if (next.turn == PathTurn::kDescent)
      text = fmt::format("f_{} is back at zero: a descent", names_.Variable(step.driven));
    if (next.turn == PathTurn::kFold) text += "; a fold: the driven force turns back" + GivenUpAt(step);
    return text;
  }

  std::string End(const Step& step) const {
    if (step.limiting < 0) return "no facet ahead";
    return fmt::format("the stage of {} ends", names_.Variable(step.driven));
  }

  // The contacts that enter another cell.
  std::string Changes(const Step& step, const Step& next) const {
    const auto from = CellsOf(step.word, names_.in_space()), to = CellsOf(next.word, names_.in_space());
    std::string text;
    for (std::size_t i = 0; i < from.size() && i < to.size(); ++i) {
      if (from[i] != to[i])
        text += fmt::format("{}contact {} from {} to {}", text.empty() ? "" : ", ", i + 1, CellText(from[i]),
                            CellText(to[i]));
    }
    return text;
  }

  // Where the published algorithm, under `paper`, gives a variable up at the very forces of a fold.
  std::string GivenUpAt(const Step& fold) const {
    const auto given_up = std::find_if(published_.begin(), published_.end(),
                                       [&fold](const Step& step) { return step.gave_up && step.f == fold.f; });
    if (given_up == published_.end()) return "";
    return fmt::format(". Here, at step {}, the published algorithm gives {} up under `paper` (5.4, 5.5)",
                       given_up - published_.begin() + 1, names_.Variable(given_up->limiting));
  }

  // How the path goes on after a piece, where not forward.
  const char* Mark(std::size_t k) const {
    const PathTurn turn = k + 1 < answer_.pivots.size() ? answer_.pivots[k + 1].turn : PathTurn::kNone;
    return turn == PathTurn::kFold ? "fold" : turn == PathTurn::kDescent ? "descent" : "";
  }

  // What a page shows beside the numbers of ToJson.
  Json ToldToJson(std::size_t k, const std::string& event) const {
    const Step& step = answer_.pivots[k];
    return {{"group", step.drive}, {"label", names_.Variable(step.driven)},
            {"why", Why(step)},    {"event", event},
            {"mark", Mark(k)},     {"da", ListJson(step.da)}};
  }

  Json ToJson(const Step& step, const std::string& event) const {
    Json json = {{"drive", step.drive},    {"driven", names_.Variable(step.driven)},
                 {"word", step.word},      {"determinant", step.determinant},
                 {"step", InJson(step.s)}, {"event", event}};
    if (!how_.vectors) return json;
    json["df"] = ListJson(step.df);
    json["f"] = ListJson(step.f);
    json["a"] = ListJson(step.a);
    return json;
  }

  const Answer<Scalar>& answer_;
  VariableTexts names_;
  Telling how_;
  std::vector<Step> published_;  // the published algorithm, in the plane over rationals
};

// ---- Lemke's method ------------------------------------------------------------------------------

template <class Scalar>
Json LemkePivotToJson(const Pivot<Scalar>& pivot, bool vectors) {
  Json json = {{"pivot", pivot.drive},
               {"entering", pivot.entering},
               {"leaving", pivot.leaving},
               {"step", InJson(pivot.s)},
               {"z0", InJson(pivot.cover)}};
  if (!vectors) return json;
  json["f"] = ListJson(pivot.f);
  json["a"] = ListJson(pivot.a);
  return json;
}

template <class Scalar>
Json LemkeToldToJson(const Pivot<Scalar>& pivot, const std::string& leaving, FractionText fractions) {
  const std::string event =
      fmt::format("{} enters, {} leaves; z0 = {}", pivot.entering, leaving, Text(pivot.cover, fractions));
  return {{"group", pivot.drive}, {"label", pivot.entering}, {"why", ""}, {"event", event}, {"mark", ""}};
}

}  // namespace

template <class Scalar>
Narration NarrateComplete(const ProblemFile& file, const Answer<Scalar>& answer, const Telling& how) {
  return CompleteNarrator<Scalar>(file, answer, how).Tell();
}

template <class Scalar>
Narration NarrateLemke(const ProblemFile&, const Answer<Scalar>& answer, const Telling& how) {
  Narration narration;
  narration.table =
      fmt::format("{:>5} {:>8} {:>8} {:>14} {:>14}\n", "pivot", "enters", "leaves", "length", "z0");
  for (const Pivot<Scalar>& pivot : answer.pivots) {
    const std::string leaving = pivot.leaving.empty() ? "(ray)" : pivot.leaving;
    narration.pivots.push_back(LemkePivotToJson(pivot, how.vectors));
    if (how.vectors) narration.told.push_back(LemkeToldToJson(pivot, leaving, how.fractions));
    narration.table += fmt::format("{:>5} {:>8} {:>8} {:>14} {:>14}\n", pivot.drive, pivot.entering, leaving,
                                   Text(pivot.s, how.fractions), Text(pivot.cover, how.fractions));
    narration.steps +=
        fmt::format("\nPivot {}: {} enters, by {}; {} leaves\n    z0 = {}   f = {}   a = {}\n", pivot.drive,
                    pivot.entering, Text(pivot.s, how.fractions), leaving, Text(pivot.cover, how.fractions),
                    ListText(pivot.f, how.fractions), ListText(pivot.a, how.fractions));
  }
  return narration;
}

template Narration NarrateComplete(const ProblemFile&, const ExactAnswer&, const Telling&);
template Narration NarrateComplete(const ProblemFile&, const InexactAnswer&, const Telling&);
template Narration NarrateLemke(const ProblemFile&, const ExactAnswer&, const Telling&);
template Narration NarrateLemke(const ProblemFile&, const InexactAnswer&, const Telling&);

}  // namespace stiction
