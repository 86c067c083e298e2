// SPDX-License-Identifier: Apache-2.0
// The published algorithm, step by step, in the words of the paper.

#include "cli/narration/narrate.h"
#include "cli/narration/narrate_text.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"

namespace stiction {

std::string KindsText(const ExactProblem& problem, FractionText fractions) {
  const VariableTexts names(problem);
  std::string text;
  for (int i = 0; i < names.layout().ContactCount(); ++i) {
    const Contact<Rational>& contact = problem.contacts[i];
    const std::string normal = names.Variable(names.layout().NormalRowOf(i));
    if (contact.kind == ContactKind::kBilateral)
      text += fmt::format("Contact {0} is bilateral: {1} stays in C, a_{1} = 0 (4.5).\n", i + 1, normal);
    if (contact.kind != ContactKind::kSliding) continue;
    const std::string along =
        names.in_space() ? fmt::format("-{} ({}, {})", Text(contact.mu, fractions),
                                       Text(contact.slip[0], fractions), Text(contact.slip[1], fractions))
                         : Text(Rational(-contact.mu * contact.slip[0]), fractions);
    text += fmt::format("Contact {0} slides: f_F{0} = {1} f_{2} (24).\n", i + 1, along, normal);
  }
  return text;
}

namespace {

template <class Scalar>
class BaraffNarrator {
 public:
  using Step = Pivot<Scalar>;
  using Vector = typename Answer<Scalar>::Vector;

  BaraffNarrator(const ProblemFile& file, const Answer<Scalar>& answer, const Telling& how)
      : problem_(file.problem), answer_(answer), names_(file.problem), how_(how) {}

  Narration Tell() const {
    const std::string kinds = KindsText(problem_, how_.fractions);
    Narration narration;
    narration.table = kinds + fmt::format("{:>4} {:>5} {:>6} {:>9} {:>14}  {}\n", "step", "drive", "driven",
                                          "goal", "length", "what happens");
    narration.before = kinds + Beginning(kinds.empty());
    narration.table += MarkAfter(0);
    narration.steps = narration.before + MarkAfter(0);
    for (std::size_t k = 0; k < answer_.pivots.size(); ++k) {
      narration.pivots.push_back(ToJson(answer_.pivots[k]));
      if (how_.vectors) narration.told.push_back(ToldToJson(k));
      narration.table += Line(k) + MarkAfter(k + 1);
      narration.steps += Told(k) + MarkAfter(k + 1);
    }
    narration.steps += "\n";
    const std::string ray = Ray();
    narration.table += ray;
    narration.steps += ray;
    return narration;
  }

 private:
  // ---- The parts of a step ----

  std::string Beginning(bool nothing_else) const {
    if (nothing_else) return fmt::format("f = 0, a = b = {}; all sets are empty (4.3).\n", List(FirstA()));
    return fmt::format("Before the first drive f = {}, a = {}; all other variables are in no set (4.3).\n",
                       List(answer_.first_f), List(FirstA()));
  }

  std::string Line(std::size_t k) const {
    const Step& step = answer_.pivots[k];
    return fmt::format("{:>4} {:>5} {:>6} {:>9} {:>14}  {}\n", k + 1, step.drive, Driven(step), Name(step.goal),
                       Number(step.s), Event(step));
  }

  std::string Told(std::size_t k) const {
    const Step& step = answer_.pivots[k];
    const std::string start = BeginsDrive(k) ? fmt::format("\nDrive {}: {}\n", step.drive, Start(k)) : "";
    return start + fmt::format("  df = {}   da = {}\n  s = {}: {}\n    f = {}   a = {}\n    {}\n",
                               List(step.df), List(step.da), Number(step.s), Event(step), List(step.f),
                               List(step.a), Sets(step));
  }

  bool BeginsDrive(std::size_t k) const {
    return k == 0 || answer_.pivots[k - 1].drive != answer_.pivots[k].drive;
  }

  // The direction without an end; with sliding contacts the impulsive direction of section 6.
  std::string Ray() const {
    if (answer_.ray.size() == 0) return "";
    return fmt::format("no limit to the step along df = {}\n", List(answer_.ray));
  }

  Vector FirstA() const { return FirstAccelerations(problem_, answer_); }

  // ---- The state that recurs ----

  // Drives that have ended after so many steps; of a loop inside one drive the steps themselves.
  std::int64_t Ended(std::size_t steps) const {
    if (answer_.outcome != Outcome::kCycle) return static_cast<std::int64_t>(steps);
    if (steps == 0) return 0;
    const std::int64_t drive = answer_.pivots[steps - 1].drive;
    return steps < answer_.pivots.size() && !BeginsDrive(steps) ? drive - 1 : drive;
  }

  // A line where the state that recurs stands first, and one where it does so again.
  std::string MarkAfter(std::size_t steps) const {
    if (!IsLoop(answer_.outcome)) return "";
    const std::int64_t ended = Ended(steps);
    if (steps > 0 && ended == Ended(steps - 1)) return "";
    if (ended == answer_.start) return "---- this state will recur ----\n";
    if (ended == answer_.start + answer_.period)
      return kIsExact<Scalar> ? "---- the same state again: what came since is repeated for ever ----\n"
                              : "---- the same state again, after rounding ----\n";
    return "";
  }

  // ---- Words ----

  std::string Number(const Scalar& x) const { return Text(x, how_.fractions); }
  template <class Numbers>
  std::string List(const Numbers& numbers) const {
    return ListText(numbers, how_.fractions);
  }

  // NC+ of the program is NCF of 5.6.
  std::string SetText(IndexSet set) const {
    return names_.in_space() && set == IndexSet::kAtUpper ? "NCF" : Name(set);
  }

  std::string Driven(const Step& step) const {
    return step.goal == DriveGoal::kZero ? names_.Variable(step.driven) : names_.Component(step.driven);
  }

  // Why this variable is driven, and toward what.
  std::string Start(std::size_t k) const {
    const Step& step = answer_.pivots[k];
    const int row = step.driven;
    const std::string name = names_.Component(row);
    const Scalar a = k == 0 ? FirstA()[row] : answer_.pivots[k - 1].a[row];
    const std::string driven = Driven(step);
    if (names_.IsNormal(row))
      return driven + fmt::format(". a_{0} = {1} < 0: increase f_{0} until it is 0 (4.1).", name, Number(a));
    if (step.goal == DriveGoal::kZero)
      return driven + fmt::format(". Its friction was given up earlier: first drive f_{} to zero (5.5).",
                                  names_.Variable(row));
    return driven + (names_.in_space() ? AlongDirection(step) : TowardLimit(step, a));
  }

  std::string TowardLimit(const Step& step, const Scalar& a) const {
    const bool up = step.df[step.driven] > 0;
    return fmt::format(". a_{0} = {1}: {2} f_{0} until a_{0} = 0 or f_{0} = {3}mu f_{4} (5.2).",
                       names_.Variable(step.driven), Number(a), up ? "increase" : "decrease", up ? "" : "-",
                       names_.Variable(step.driven - 1));
  }

  std::string AlongDirection(const Step& step) const {
    const int normal = names_.Normal(step.driven);
    const std::array<Scalar, 2> along = {step.df[normal + 1], step.df[normal + 2]};
    return fmt::format(". Until a_{0} = 0 or abs(f_{1}) = mu f_{2} (5.6); f_{1} changes along {3}.",
                       names_.Component(step.driven), names_.Variable(step.driven), names_.Variable(normal),
                       List(along));
  }

  std::string Reached(const Step& step) const {
    const int row = step.limiting;
    const std::string name =
        row == step.driven && step.wanted == IndexSet::kSticking ? names_.Component(row) : names_.Variable(row);
    const std::string normal = names_.Variable(names_.Normal(row));
    if (step.turned_away) return fmt::format("d.a_{0} = 0 and a_{0} /= 0", name);
    if (step.wanted == IndexSet::kClamped || step.wanted == IndexSet::kSticking)
      return fmt::format("a_{} = 0", name);
    if (LimitSign(step.wanted) == 0) return fmt::format("f_{} = 0", name);
    if (names_.in_space()) return fmt::format("abs(f_{}) = mu f_{}", name, normal);
    return fmt::format("f_{} = {}mu f_{}", name, LimitSign(step.wanted) > 0 ? "" : "-", normal);
  }

  std::string Along(const Step& step) const {
    if (!names_.in_space() || step.to != IndexSet::kAtUpper) return "";
    return " along " + List(step.recorded[names_.layout().ContactOf(step.limiting)]);
  }

  // Whether ax = 0 is kept, and ay is not (readings.md, 8).
  bool IsHalf(const Step& step) const {
    return names_.in_space() && step.limiting == step.driven && names_.IsTangential(step.driven) &&
           step.to == IndexSet::kSticking;
  }

  std::string Event(const Step& step) const {
    const std::string name = names_.Variable(step.limiting), reached = Reached(step);
    if (step.gave_up)
      return fmt::format("{}; {} is in {} and wants back into {}: given up (5.4, 5.5)", reached, name,
                         SetText(step.from), SetText(step.wanted));
    if (step.turned_away) return fmt::format("{}; {} leaves NCF and turns away (slip=redirect)", reached, name);
    if (step.limiting != step.driven)
      return fmt::format("{}; {} moves from {} to {}{}", reached, name, SetText(step.from), SetText(step.to),
                         Along(step));
    if (step.to == IndexSet::kNone) return fmt::format("{}; the drive ends, {} is in no set", reached, name);
    if (IsHalf(step)) return fmt::format("{}, which is kept; y follows", reached);
    return fmt::format("{}; the drive ends, {} joins {}{}", reached, name, SetText(step.to), Along(step));
  }

  // ---- Sets ----

  // Of a variable; `half` where one component of friction is kept.
  std::string SetOf(const Step& step, int row) const {
    const bool half = names_.in_space() && !names_.IsNormal(row) && step.sets[row] == IndexSet::kSticking &&
                      step.sets[row + 1] != IndexSet::kSticking;
    return half ? "half" : SetText(step.sets[row]);
  }

  std::string Member(const Step& step, int row) const {
    const bool slips = names_.in_space() && step.sets[row] == IndexSet::kAtUpper;
    const std::string name = names_.Variable(row);
    return slips ? name + " along " + List(step.recorded[names_.layout().ContactOf(row)]) : name;
  }

  // Sets in the paper's names, with their members; the program's own only where they have any.
  std::vector<std::pair<std::string, std::vector<std::string>>> SetsOf(const Step& step) const {
    using Names = std::vector<const char*>;
    static const Names plane = {"C", "NC", "CF", "NC-", "NC+", "suspended"},
                       space = {"C", "NC", "CF", "NCF", "half"};
    std::vector<std::pair<std::string, std::vector<std::string>>> sets;
    for (const std::string set : names_.in_space() ? space : plane) {
      std::vector<std::string> members;
      for (int row = 0; row < static_cast<int>(step.sets.size()); ++row) {
        if (names_.IsVariable(row) && SetOf(step, row) == set) members.push_back(Member(step, row));
      }
      const bool own = set == "half" || set == "suspended";
      if (!own || !members.empty()) sets.push_back({set, std::move(members)});
    }
    return sets;
  }

  std::string Sets(const Step& step) const {
    std::vector<std::string> texts;
    for (const auto& [set, members] : SetsOf(step))
      texts.push_back(fmt::format("{} = {{{}}}", set, fmt::join(members, names_.in_space() ? ", " : " ")));
    return fmt::format("{}", fmt::join(texts, "  "));
  }

  // ---- JSON ----

  // What a page shows beside the numbers of ToJson.
  Json ToldToJson(std::size_t k) const {
    const Step& step = answer_.pivots[k];
    Json sets = Json::array();
    for (const auto& [set, members] : SetsOf(step)) sets.push_back({set, members});
    return {{"group", step.drive},
            {"label", Driven(step)},
            {"why", BeginsDrive(k) ? Start(k) : ""},
            {"event", Event(step)},
            {"mark", step.gave_up ? "given up" : ""},
            {"moved", names_.Variable(step.limiting)},
            {"da", ListJson(step.da)},
            {"sets", std::move(sets)}};
  }

  Json ToJson(const Step& step) const {
    Json json = {{"drive", step.drive},
                 {"driven", Driven(step)},
                 {"goal", Name(step.goal)},
                 {"step", InJson(step.s)},
                 {"limiting", names_.Variable(step.limiting)},
                 {"from", SetText(step.from)},
                 {"to", SetText(step.to)}};
    if (step.turned_away) json["turned_away"] = true;
    if (!how_.vectors) return json;
    json["df"] = ListJson(step.df);
    json["f"] = ListJson(step.f);
    json["a"] = ListJson(step.a);
    if (names_.in_space()) AddSets(step, json);
    return json;
  }

  void AddSets(const Step& step, Json& json) const {
    Json sets = Json::object(), recorded = Json::object();
    for (int row = 0; row < static_cast<int>(step.sets.size()); ++row) {
      if (names_.IsVariable(row)) sets[names_.Variable(row)] = SetOf(step, row);
      if (step.sets[row] == IndexSet::kAtUpper)
        recorded[names_.Variable(row)] = ListJson(step.recorded[names_.layout().ContactOf(row)]);
    }
    json["sets"] = std::move(sets);
    json["recorded"] = std::move(recorded);
  }

  const ExactProblem& problem_;
  const Answer<Scalar>& answer_;
  VariableTexts names_;
  Telling how_;
};

}  // namespace

template <class Scalar>
Narration NarrateBaraff(const ProblemFile& file, const Answer<Scalar>& answer, const Telling& how) {
  return BaraffNarrator<Scalar>(file, answer, how).Tell();
}

template Narration NarrateBaraff(const ProblemFile&, const ExactAnswer&, const Telling&);
template Narration NarrateBaraff(const ProblemFile&, const InexactAnswer&, const Telling&);

}  // namespace stiction
