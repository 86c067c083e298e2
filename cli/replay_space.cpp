// SPDX-License-Identifier: Apache-2.0
#include "cli/replay_space.h"

#include <fmt/format.h>

#include <cmath>

#include "certify/certificate.h"
#include "certify/published_space.h"
#include "certify/space.h"
#include "cli/shared.h"

namespace stiction {
namespace {

constexpr const char* kNoProof =
    "a state stands again after rounding: forces are irrational, and this is no proof";

RoundedSpaceRun RunIn(const std::string& arithmetic, const ExactProblem& problem,
                      const PublishedOptions& options, KeepTrace keep) {
  if (arithmetic == "float") return RunRoundedInSpace<float>(problem, options, keep);
  if (arithmetic == "double") return RunRoundedInSpace<double>(problem, options, keep);
  return RunRoundedInSpace<long double>(problem, options, keep);
}

RoundedSpaceRun RunAgain(const std::string& arithmetic, const ExactProblem& problem,
                         const PublishedOptions& options) {
  if (arithmetic == "float") return RunSuspicionInSpace<float>(problem, options);
  if (arithmetic == "double") return RunSuspicionInSpace<double>(problem, options);
  return RunSuspicionInSpace<long double>(problem, options);
}

template <class Vector>
std::string List(const Vector& values) {
  std::vector<std::string> numbers;
  for (const double x : values) numbers.push_back(fmt::format("{:.6g}", x + 0.0));  // no -0
  return fmt::format("({})", fmt::join(numbers, ", "));
}

std::string List(const ExactVector& values) {
  std::vector<std::string> numbers;
  for (const Rational& x : values) numbers.push_back(ToString(x));
  return fmt::format("({})", fmt::join(numbers, ", "));
}

std::string DescribeRounded(const Verdict& verdict) {
  if (verdict.outcome != Outcome::kCycle) return Describe(verdict);
  return fmt::format("cycle: after rounding, the state after {} drives stands again {} drives later",
                     verdict.start, verdict.period);
}

// What bilateral and sliding contacts do all the time, one line each.
std::string Kinds(const ExactProblem& problem) {
  std::string text;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const Contact<Rational>& contact = problem.contacts[i];
    if (contact.kind == ContactKind::kBilateral)
      text += fmt::format("Contact {0} is bilateral: a_N{0} = 0 is kept (4.5).\n", i + 1);
    if (contact.kind == ContactKind::kSliding) {
      text += fmt::format("Contact {0} slides: f_F{0} = -{1} ({2}, {3}) f_N{0} (24).\n", i + 1,
                          ToString(contact.mu), ToString(contact.slip[0]), ToString(contact.slip[1]));
    }
  }
  return text;
}

// ---- The published algorithm -------------------------------------------------------------------

// NC+ of the program is NCF of 5.6.
const char* SetName(IndexSet set) { return set == IndexSet::kAtUpper ? "NCF" : Name(set); }

class SpaceNarrator {
 public:
  SpaceNarrator(const ExactProblem& problem, const RoundedSpaceRun& run) : run_(run) {
    layout_.Assign(problem.contacts, 3);
  }

  // "N1", or "F1" for both components of friction.
  std::string Variable(int row) const {
    return (layout_.IsNormal(row) ? "N" : "F") + std::to_string(layout_.ContactOf(row) + 1);
  }

  // One component: "F1x" or "F1y" along the axes that the contact has at the time.
  std::string Component(int row) const {
    if (layout_.IsNormal(row)) return Variable(row);
    return Variable(row) + (layout_.IsNormal(row - 1) ? "x" : "y");
  }

  std::string Driven(const Pivot<double>& pivot) const {
    return pivot.goal == DriveGoal::kZero ? Variable(pivot.driven) : Component(pivot.driven);
  }

  std::string Line(std::size_t k) const {
    const Pivot<double>& pivot = run_.trace[k];
    return fmt::format("{:>4} {:>5} {:>6} {:>9} {:>14.6g}  {}\n", k + 1, pivot.drive, Driven(pivot),
                       Name(pivot.goal), pivot.s, Event(pivot));
  }

  std::string Step(std::size_t k) const {
    const Pivot<double>& pivot = run_.trace[k];
    const bool first = k == 0 || run_.trace[k - 1].drive != pivot.drive;
    std::string text = first ? Start(pivot, k) : "";
    text += fmt::format("  df = {}   da = {}\n  s = {:.6g}: {}\n    f = {}   a = {}\n    {}\n", List(pivot.df),
                        List(pivot.da), pivot.s, Event(pivot), List(pivot.f), List(pivot.a), Sets(pivot));
    return text;
  }

  Json ToJson(const Pivot<double>& pivot, bool vectors) const {
    Json json = {{"drive", pivot.drive},
                 {"driven", Driven(pivot)},
                 {"goal", Name(pivot.goal)},
                 {"step", NumberToJson(pivot.s)},
                 {"limiting", Variable(pivot.limiting)},
                 {"from", SetName(pivot.from)},
                 {"to", SetName(pivot.to)}};
    if (pivot.turned_away) json["turned_away"] = true;
    if (!vectors) return json;
    json["df"] = NumbersToJson(pivot.df);
    json["f"] = NumbersToJson(pivot.f);
    json["a"] = NumbersToJson(pivot.a);
    Json sets = Json::object(), recorded = Json::object();
    for (int row = 0; row < static_cast<int>(pivot.sets.size()); ++row) {
      if (layout_.IsNormal(row) || layout_.IsNormal(row - 1)) sets[Variable(row)] = SetOf(pivot, row);
      if (pivot.sets[row] == IndexSet::kAtUpper)
        recorded[Variable(row)] = NumbersToJson(pivot.recorded[layout_.ContactOf(row)]);
    }
    json["sets"] = std::move(sets);
    json["recorded"] = std::move(recorded);
    return json;
  }

 private:
  // `half`: ax = 0 is kept, and ay is not (readings.md, 8).
  std::string SetOf(const Pivot<double>& pivot, int row) const {
    const bool half = !layout_.IsNormal(row) && pivot.sets[row] == IndexSet::kSticking &&
                      pivot.sets[row + 1] != IndexSet::kSticking;
    return half ? "half" : SetName(pivot.sets[row]);
  }

  std::string Sets(const Pivot<double>& pivot) const {
    std::vector<std::string> texts;
    for (const char* set : {"C", "NC", "CF", "NCF", "half"}) {
      std::vector<std::string> members;
      for (int row = 0; row < static_cast<int>(pivot.sets.size()); ++row) {
        const bool first = layout_.IsNormal(row) || layout_.IsNormal(row - 1);
        if (!first || SetOf(pivot, row) != set) continue;
        const bool slips = pivot.sets[row] == IndexSet::kAtUpper;
        members.push_back(Variable(row) +
                          (slips ? " along " + List(pivot.recorded[layout_.ContactOf(row)]) : ""));
      }
      if (set != std::string("half") || !members.empty())
        texts.push_back(fmt::format("{} = {{{}}}", set, fmt::join(members, ", ")));
    }
    return fmt::format("{}", fmt::join(texts, "  "));
  }

  std::string Start(const Pivot<double>& pivot, std::size_t k) const {
    const int row = pivot.driven;
    const double a = k == 0 ? run_.initial_a[row] : run_.trace[k - 1].a[row];
    std::string text = fmt::format("\nDrive {}: {}", pivot.drive, Driven(pivot));
    if (layout_.IsNormal(row))
      return text +
             fmt::format(". a_{0} = {1:.6g} < 0: increase f_{0} until it is 0 (4.1).\n", Variable(row), a);
    if (pivot.goal == DriveGoal::kZero)
      return text + fmt::format(". f_{0} is not 0: first drive it to zero (5.5).\n", Variable(row));
    const int friction = layout_.NormalRowOf(layout_.ContactOf(row)) + 1;
    return text + fmt::format(". Until a_{0} = 0 or abs(f_{1}) = mu f_N{2} (5.6); f_{1} changes along {3}.\n",
                              Component(row), Variable(row), layout_.ContactOf(row) + 1,
                              List(std::array<double, 2>{pivot.df[friction], pivot.df[friction + 1]}));
  }

  std::string Reached(const Pivot<double>& pivot) const {
    const std::string name = Variable(pivot.limiting);
    switch (pivot.wanted) {
      case IndexSet::kClamped:
        return fmt::format("a_{} = 0", name);
      case IndexSet::kSticking:
        if (pivot.limiting == pivot.driven) return fmt::format("a_{} = 0", Component(pivot.driven));
        return pivot.turned_away ? fmt::format("d.a_{0} = 0 and a_{0} /= 0", name)
                                 : fmt::format("a_{} = 0", name);
      case IndexSet::kAtUpper:
        return fmt::format("abs(f_{}) = mu f_N{}", name, layout_.ContactOf(pivot.limiting) + 1);
      default:
        return fmt::format("f_{} = 0", name);
    }
  }

  std::string Event(const Pivot<double>& pivot) const {
    const std::string name = Variable(pivot.limiting), reached = Reached(pivot);
    if (pivot.gave_up)
      return fmt::format("{}; {} is in {} and wants back into {}: given up (5.4, 5.5)", reached, name,
                         SetName(pivot.from), SetName(pivot.wanted));
    if (pivot.turned_away)
      return fmt::format("{}; {} leaves NCF and turns away (slip=redirect)", reached, name);
    const bool slips = pivot.to == IndexSet::kAtUpper;
    const std::string along = slips ? " along " + List(pivot.recorded[layout_.ContactOf(pivot.limiting)]) : "";
    if (pivot.limiting != pivot.driven)
      return fmt::format("{}; {} moves from {} to {}{}", reached, name, SetName(pivot.from), SetName(pivot.to),
                         along);
    if (pivot.to == IndexSet::kNone) return fmt::format("{}; the drive ends, {} is in no set", reached, name);
    const bool half = !layout_.IsNormal(pivot.driven) && pivot.to == IndexSet::kSticking &&
                      layout_.IsNormal(pivot.driven - 1);
    if (half) return fmt::format("{}, which is kept; y follows", reached);
    return fmt::format("{}; the drive ends, {} joins {}{}", reached, name, SetName(pivot.to), along);
  }

  const RoundedSpaceRun& run_;
  RowLayout<Eigen::Dynamic> layout_;
};

Json VerdictToJson(const PublishedSpaceVerdict& verdict) {
  Json json = {{"outcome", Name(verdict.outcome)}, {"start", verdict.start}, {"period", verdict.period}};
  if (!verdict.reason.empty()) json["reason"] = verdict.reason;
  if (verdict.outcome == Outcome::kCycle) json["evidence"] = kNoProof;
  return json;
}

void RequireReading(const Policy& policy) {
  if (PublishedReadsInSpace(policy)) return;
  throw InputError(
      fmt::format("--policy {}: expected file=no, apex=kept and slip=literal or slip=redirect in "
                  "space, where no other reading of these is built",
                  PolicyName(policy)));
}

}  // namespace

SpaceReplay ReplayPublishedInSpace(const ProblemFile& file, const PublishedOptions& options,
                                   const std::string& arithmetic, bool vectors) {
  RequireReading(options.policy);
  const RoundedSpaceRun run = RunIn(arithmetic, file.problem, options, KeepTrace::kYes);
  const SpaceNarrator narrator(file.problem, run);
  SpaceReplay replay;
  replay.outcome = run.verdict.outcome;
  Json& json = replay.json = VerdictToJson(run.verdict);
  std::string end;
  if (!run.ray.empty()) end = fmt::format("no limit to the step along df = {}\n", List(run.ray));
  end += DescribeRounded(run.verdict) + "\n";
  if (replay.outcome == Outcome::kCycle) end += fmt::format("({})\n", kNoProof);
  if (replay.outcome != Outcome::kSolved) {
    const PublishedSpaceVerdict again = RunAgain(arithmetic, file.problem, options).verdict;
    replay.outcome = again.outcome;
    json = VerdictToJson(again);
    json["suspected"] = VerdictToJson(run.verdict);
    end += fmt::format("run again in long double, with finer tolerances: {}\n", DescribeRounded(again));
  }
  json["method"] = "baraff";
  json["policy"] = PolicyName(options.policy);
  json["arithmetic"] = arithmetic;
  json["statistics"] = StatisticsToJson(run.verdict.statistics);
  json["f"] = NumbersToJson(run.f);
  if (!run.ray.empty()) json["ray"] = NumbersToJson(run.ray);
  if (vectors) json["initial"] = {{"f", NumbersToJson(run.initial_f)}, {"a", NumbersToJson(run.initial_a)}};
  json["pivots"] = Json::array();
  const std::string head =
      fmt::format("{}: {} contacts in space, policy {}, {}\n{}", file.name, file.problem.contacts.size(),
                  PolicyName(options.policy), arithmetic, Kinds(file.problem));
  replay.table = head + fmt::format("{:>4} {:>5} {:>6} {:>9} {:>14}  {}\n", "step", "drive", "driven", "goal",
                                    "length", "what happens");
  replay.steps =
      head + fmt::format("Before the first drive f = {}, a = {}.\n", List(run.initial_f), List(run.initial_a));
  for (std::size_t k = 0; k < run.trace.size(); ++k) {
    json["pivots"].push_back(narrator.ToJson(run.trace[k], vectors));
    replay.table += narrator.Line(k);
    replay.steps += narrator.Step(k);
  }
  replay.table += end;
  replay.steps += "\n" + end;
  return replay;
}

std::vector<Policy> GridInSpace() {
  std::vector<Policy> grid;
  for (const Slip slip : {Slip::kLiteral, Slip::kRedirect}) {
    for (Policy policy : PlanarGrid()) {
      policy.slip = slip;
      if (PublishedReadsInSpace(policy)) grid.push_back(policy);
    }
  }
  return grid;
}

Verdict DecideRounded(const ExactProblem& problem, const PublishedOptions& options,
                      const std::string& arithmetic) {
  const PublishedSpaceVerdict first = RunIn(arithmetic, problem, options, KeepTrace::kNo).verdict;
  return first.outcome == Outcome::kSolved ? first : RunAgain(arithmetic, problem, options).verdict;
}

// ---- Complete driving --------------------------------------------------------------------------

namespace {

// "N2" or "F2": what a stage drives.
std::string StageName(const SpacePiece<Rational>& piece) {
  return (piece.stage == SpaceStage::kNormal ? "N" : "F") + std::to_string(piece.driven + 1);
}

// What ends piece k: an end of the stage, or a contact that enters another cell.
std::string EventAfter(const std::vector<SpacePiece<Rational>>& path, std::size_t k, Outcome outcome) {
  const SpacePiece<Rational>& piece = path[k];
  const std::string name = StageName(piece);
  if (piece.ends)
    return piece.stage == SpaceStage::kNormal
               ? fmt::format("a_{} = 0: the stage ends", name)
               : fmt::format("the polygon has its full size mu f_N{}: the stage ends", piece.driven + 1);
  if (piece.descends) return fmt::format("{} is back at its start: a descent", name);
  if (k + 1 == path.size()) return outcome == Outcome::kRay ? "no facet ahead" : "the run ends here";
  std::string text;
  for (std::size_t i = 0; i < piece.word.size(); ++i) {
    const std::string from = Name(piece.word[i]), to = Name(path[k + 1].word[i]);
    if (from != to)
      text += fmt::format("{}contact {} from {} to {}", text.empty() ? "" : ", ", i + 1, from, to);
  }
  const bool folds = (piece.driven_rate > 0) != (path[k + 1].driven_rate > 0);
  return text + (folds ? "; a fold" : "");
}

Json PieceToJson(const SpacePiece<Rational>& piece, const ExactVector& f, const std::string& event) {
  return {{"driven", StageName(piece)},       {"word", Name(piece.word)},
          {"determinant", piece.determinant}, {"rate", ToString(piece.driven_rate)},
          {"step", ToString(piece.s)},        {"event", event},
          {"df", VectorToJson(piece.df)},     {"f", VectorToJson(f)}};
}

}  // namespace

SpaceReplay ReplayComplete(const ProblemFile& file, int sides, const Limits& limits) {
  const ExactProblem& problem = file.problem;
  std::vector<SpacePiece<Rational>> path;
  const SpaceRun run = RunSpace(
      problem, RationalPolygons(problem.contacts.size(), FrictionPolygon<Rational>(sides)), limits, &path);
  SpaceReplay replay;
  replay.outcome = run.verdict.outcome;
  ExactVector f = run.f;  // before the first piece: what bilateral contacts need
  for (const SpacePiece<Rational>& piece : path) f -= piece.s * piece.df;
  replay.table = replay.steps =
      fmt::format("{}: {} contacts in space, complete driving on polygons of {} sides, exact\n{}", file.name,
                  problem.contacts.size(), sides, Kinds(problem));
  replay.table += fmt::format("{:>5} {:>6} {:>4} {:>14}  {:20} {}\n", "piece", "driven", "det", "length",
                              "cells", "what happens");
  replay.steps += fmt::format("Before the first piece f = {}.\n", List(f));
  replay.json = {{"outcome", Name(run.verdict.outcome)},
                 {"method", "complete"},
                 {"arithmetic", "exact"},
                 {"sides", sides},
                 {"word", Name(run.word)},
                 {"f", VectorToJson(run.f)},
                 {"initial", {{"f", VectorToJson(f)}}},
                 {"pieces", Json::array()}};
  for (std::size_t k = 0; k < path.size(); ++k) {
    const SpacePiece<Rational>& piece = path[k];
    const std::string event = EventAfter(path, k, run.verdict.outcome), word = Name(piece.word);
    f += piece.s * piece.df;
    replay.json["pieces"].push_back(PieceToJson(piece, f, event));
    replay.table += fmt::format("{:>5} {:>6} {:>4} {:>14}  {:20} {}\n", k + 1, StageName(piece),
                                piece.determinant, ToString(piece.s), word, event);
    const ExactVector a = problem.A * f + problem.b;
    replay.steps += fmt::format(
        "\nPiece {}: {} is driven, cells {}, determinant {}\n  df = {}   da = {}\n  s = {}: {}\n    f = {}   a "
        "= "
        "{}\n",
        k + 1, StageName(piece), word,
        piece.determinant > 0   ? "> 0"
        : piece.determinant < 0 ? "< 0"
                                : "0",
        List(piece.df), List(piece.da), ToString(piece.s), event, List(f), List(a));
  }
  std::string end(Name(run.verdict.outcome));
  if (!run.verdict.reason.empty()) end += fmt::format(": {}", run.verdict.reason);
  end += fmt::format(", cells {}\n", Name(run.word));
  replay.table += end;
  replay.steps += "\n" + end;
  return replay;
}

}  // namespace stiction
