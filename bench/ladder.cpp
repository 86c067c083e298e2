// SPDX-License-Identifier: Apache-2.0
// bench --suite trade, extremes: speed against accuracy. Every method over every arithmetic on the same
// problems, of the generators or along dials (dials.h), and what the answers are worth.
//
// A call is what a user's program calls: Solve() over numbers of the arithmetic's own, the filtered call for
// filtered, both on data already in memory; its time is that of the call alone. Answers are judged over
// rationals, on the problem that the arithmetic was given (rungs.h).
//
//   silent   called solved within a residual that it does not have, or that no solution exists where one does
//   wrong    the published algorithm ends otherwise than over rationals, and does not say that it is undecided
//   refused  a number of the problem is not one of the arithmetic's

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>

#include "bench/dials.h"
#include "bench/measure.h"
#include "bench/progress.h"
#include "bench/rungs.h"
#include "bench/suite.h"
#include "bench/table.h"
#include "certify/exact/exact.h"
#include "certify/exact/filtered.h"
#include "certify/request/quad.h"
#include "certify/request/solve_in.h"
#include "corpus/exit_code.h"
#include "corpus/input_error.h"
#include "corpus/intervals.h"
#include "corpus/json.h"
#include "corpus/stopwatch.h"
#include "solver/linear/direction.h"
#include "solver/problem/gate.h"

namespace stiction {
namespace {

// What is called solved claims no less than this, whatever is asked for less.
constexpr double kMargin = 1 + 1e-9;  // rounding of the claim itself

// ---- Calls ---------------------------------------------------------------------------------------

struct Told {
  bool refused = false;
  Outcome outcome = Outcome::kUndecided;
  double seconds = 0;
  double bound = 0;                            // of the residual, that solved claims
  std::optional<ExactProblem::Vector> f = {};  // as the arithmetic has them, exactly
  std::optional<Rung> decided_on = {};         // filtered
};

// A number as the sum of doubles.
template <class Scalar>
Rational Exactly(Scalar x) {
  Rational sum = 0;
  for (int part = 0; part < 4 && x != 0; ++part) {
    const double high = static_cast<double>(x);
    if (!std::isfinite(high)) break;
    sum += Rational(high);
    x -= Scalar(high);
  }
  return sum;
}

template <class Scalar>
Told Tell(const Answer<Scalar>& answer, double seconds, double bound) {
  Told told;
  told.outcome = answer.outcome;
  told.seconds = seconds;
  told.bound = bound;
  if (answer.Solved()) told.f = answer.f.unaryExpr([](const Scalar& x) { return Exactly(x); });
  return told;
}

template <class Scalar>
Told CallOver(const ContactProblem<Scalar>& problem, const std::string& method) {
  const Stopwatch watch;
  const Answer<Scalar> answer = Solve(problem, method);
  return Tell(answer, watch.Seconds(), kSolvedResidual<Scalar>);
}

Told CallExactly(const ExactProblem& problem, const std::string& method) {
  const Stopwatch watch;
  const Answer<Rational> answer = Solve(problem, method);
  Told told;
  told.seconds = watch.Seconds();
  told.outcome = answer.outcome;
  if (answer.Solved()) told.f = answer.f;
  return told;
}

Told CallFiltered(const ExactProblem& problem, const std::string& method) {
  const Stopwatch watch;
  const Solution solution = SolveIn(problem, {.method = method, .arithmetic = Arithmetic::kFiltered});
  Told told;
  told.seconds = watch.Seconds();
  told.outcome = solution.outcome();
  told.decided_on = std::visit([](const auto& answer) { return answer.rung; }, solution.answer);
  if (told.outcome != Outcome::kSolved) return told;
  if (const auto* exact = std::get_if<ExactAnswer>(&solution.answer)) {
    told.f = exact->f;
  } else {
    told.f = std::get<InexactAnswer>(solution.answer).f.unaryExpr([](double x) { return Rational(x); });
    told.bound = kSolvedResidual<double>;
  }
  return told;
}

// ---- Remedies ------------------------------------------------------------------------------------

// A power of two for each contact that brings its diagonal near 1; one for both rows, so that mu stays.
std::vector<double> ScalesOf(const ContactProblem<double>& problem) {
  std::vector<double> scales;
  int row = 0;
  for (const auto& contact : problem.contacts) {
    const int size = contact.HasFrictionRows() ? 2 : 1;
    const double most = problem.A.diagonal().segment(row, size).maxCoeff();
    const double scale = most > 0 ? std::ldexp(1.0, -std::ilogb(most) / 2) : 1;
    scales.insert(scales.end(), size, scale);
    row += size;
  }
  return scales;
}

// f = D f' of the problem with D A D and D b.
Answer<double> SolveScaled(const ContactProblem<double>& problem, const std::string& method) {
  const std::vector<double> scales = ScalesOf(problem);
  const Eigen::Map<const Eigen::VectorXd> D(scales.data(), static_cast<Eigen::Index>(scales.size()));
  ContactProblem<double> scaled = problem;
  scaled.A = D.asDiagonal() * problem.A * D.asDiagonal();
  scaled.b = D.asDiagonal() * problem.b;
  Answer<double> answer = Solve(scaled, method);
  answer.f = answer.f.size() == D.size() ? Eigen::VectorXd(D.asDiagonal() * answer.f) : answer.f;
  JudgeAnswer(problem, kSolvedResidual<double>, answer);
  return answer;
}

// What others add to a singular A: here 1e-10 of its largest diagonal entry.
Answer<double> SolveRegularized(const ContactProblem<double>& problem, const std::string& method) {
  ContactProblem<double> definite = problem;
  const double largest = problem.rows() > 0 ? problem.A.diagonal().maxCoeff() : 0;
  definite.A.diagonal().array() += 1e-10 * largest;
  Answer<double> answer = Solve(definite, method);
  JudgeAnswer(problem, kSolvedResidual<double>, answer);
  return answer;
}

// One step: the equations of the cells where the answer ended, for the residual with twice the digits.
Answer<double> SolveRefined(const ContactProblem<double>& problem, const std::string& method) {
  Answer<double> answer = Solve(problem, method);
  if (answer.f.size() != problem.rows() || !answer.f.allFinite()) return answer;
  GateMeter<double> meter;
  meter.Accelerate(problem, answer.f, Gate{0, 0});
  const Eigen::VectorXd& a = meter.a();
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(problem.contacts);
  // Forces that press and rest are unknown, as their numbers tell.
  const Scale<double> scale = MakeScale(problem, Tolerances{});
  std::vector<IndexSet> sets(problem.rows(), IndexSet::kSeparating);
  for (int i = 0; i < layout.ContactCount(); ++i) {
    const int row = layout.NormalRowOf(i);
    if (!(answer.f[row] > scale.force)) continue;
    sets[row] = IndexSet::kClamped;
    if (!layout.HasFriction(row)) continue;
    const double bound = problem.contacts[i].mu * answer.f[row], slack = bound - std::abs(answer.f[row + 1]);
    const IndexSet limit = answer.f[row + 1] > 0 ? IndexSet::kAtUpper : IndexSet::kAtLower;
    sets[row + 1] = slack > scale.force ? IndexSet::kSticking : limit;
  }
  ContactProblem<double> rest = problem;
  rest.b = a;
  using System = DirectionSystem<double, Eigen::Dynamic>;
  System system;
  system.Start(rest);
  const SetUnknowns<double, Eigen::Dynamic> unknowns{rest, layout, sets};
  if (system.SolveForces(rest, unknowns, scale) != System::Status::kRegular) return answer;
  Answer<double> refined = answer;
  refined.f += system.df();
  JudgeAnswer(problem, kSolvedResidual<double>, refined);
  return refined.residual() < answer.residual() ? refined : answer;
}

enum class Remedy { kNone, kScaled, kRefined, kRegularized };

Told CallWith(Remedy remedy, const ContactProblem<double>& problem, const std::string& method) {
  const auto solve = remedy == Remedy::kScaled    ? &SolveScaled
                     : remedy == Remedy::kRefined ? &SolveRefined
                                                  : &SolveRegularized;
  const Stopwatch watch;
  const Answer<double> answer = solve(problem, method);
  return Tell(answer, watch.Seconds(), kSolvedResidual<double>);
}

// ---- Rows ----------------------------------------------------------------------------------------

constexpr std::array<const char*, 4> kRemedyNames = {"", " scaled", " refined", " regularized"};

struct LadderRow {
  std::string method;
  Arithmetic arithmetic;
  Remedy remedy = Remedy::kNone;

  std::string Name() const {
    return std::string(stiction::Name(arithmetic)) + kRemedyNames[static_cast<int>(remedy)];
  }
};

std::vector<LadderRow> LadderRows() {
  using enum Arithmetic;
  std::vector<LadderRow> rows;
  for (const char* method : {"complete", "lemke", "fast", "baraff"}) {
    for (const Arithmetic arithmetic : {kFloat, kDouble, kLongDouble, kQuad, kFiltered, kExact}) {
      if (Refusal(method, 2, arithmetic).empty()) rows.push_back({method, arithmetic});
      if (arithmetic != kDouble) continue;
      for (const Remedy remedy : {Remedy::kScaled, Remedy::kRefined, Remedy::kRegularized})
        rows.push_back({method, arithmetic, remedy});
    }
  }
  return rows;
}

Told RunRow(const LadderRow& row, const RungProblem& problem) {
  if (row.arithmetic == Arithmetic::kExact) return CallExactly(problem.exact(), row.method);
  if (row.arithmetic == Arithmetic::kFiltered) return CallFiltered(problem.exact(), row.method);
  const bool narrow = row.arithmetic == Arithmetic::kFloat;
  if (narrow ? !problem.in_float() : !problem.in_double()) return {.refused = true};
  if (row.remedy != Remedy::kNone) return CallWith(row.remedy, *problem.in_double(), row.method);
  switch (row.arithmetic) {
    case Arithmetic::kFloat:
      return CallOver(*problem.in_float(), row.method);
    case Arithmetic::kDouble:
      return CallOver(*problem.in_double(), row.method);
    case Arithmetic::kLongDouble:
      return CallOver(
          Converted<long double>(*problem.in_double(), [](double x) { return static_cast<long double>(x); }),
          row.method);
    default:
      return CallOver(Converted<Quad>(*problem.in_double(), [](double x) { return Quad(x); }), row.method);
  }
}

// ---- Lines ---------------------------------------------------------------------------------------

Json QuartilesJson(const std::vector<double>& values, double unit) {
  if (values.empty()) return nullptr;
  const Quartiles q = QuartilesOf(values);
  return {q.low * unit, q.median * unit, q.high * unit};
}

// What a row made of several problems.
struct Tally {
  std::int64_t problems = 0, solved = 0, undecided = 0, other = 0, refused = 0, wrong = 0, silent = 0;
  std::array<std::int64_t, kRungCount> decided_on = {};
  std::vector<double> seconds, residuals;  // of the calls; of answers called solved, over rationals

  // `has_solution`: that there is one is known.
  void Count(const LadderRow& row, const RungProblem& problem, const Told& told, bool has_solution) {
    ++problems;
    refused += told.refused;
    if (told.refused) return;
    seconds.push_back(told.seconds);
    if (told.decided_on) ++decided_on[static_cast<int>(*told.decided_on)];
    const bool open = told.outcome == Outcome::kUndecided || told.outcome == Outcome::kLimit;
    undecided += open;
    other += !open && told.outcome != Outcome::kSolved;
    bool is_silent = told.outcome == Outcome::kNoSolution && has_solution;
    if (told.outcome == Outcome::kSolved) {
      ++solved;
      const Gate gate = row.arithmetic == Arithmetic::kFloat ? GateOf<float>() : GateOf<double>();
      residuals.push_back(ExactResidual(problem.Given(row.arithmetic), *told.f, gate));
      is_silent = !(residuals.back() <= told.bound * kMargin);
    }
    silent += is_silent;
    const bool differs =
        row.method == "baraff" && !open && told.outcome != problem.PublishedEnd(row.arithmetic);
    wrong += is_silent || differs;
  }

  Json LineOf(const Source& source, const LadderRow& row) const {
    const Interval of_wrong = ShareInterval(wrong, problems - refused),
                   of_silent = ShareInterval(silent, problems - refused);
    Json worst;
    if (!residuals.empty()) worst = *std::max_element(residuals.begin(), residuals.end());
    return {{"family", source.family},
            {"setting", source.setting},
            {"method", row.method},
            {"arithmetic", row.Name()},
            {"problems", problems},
            {"solved", solved},
            {"undecided", undecided},
            {"other", other},
            {"refused", refused},
            {"wrong", wrong},
            {"wrong_share", {of_wrong.low, of_wrong.high}},
            {"silent", silent},
            {"silent_share", {of_silent.low, of_silent.high}},
            {"microseconds", QuartilesJson(seconds, 1e6)},
            {"residual", QuartilesJson(residuals, 1)},
            {"worst_residual", worst},
            {"decided_on", decided_on}};
  }
};

// A line for each row.
Json Measure(const Source& source, const std::vector<LadderRow>& rows, std::int64_t problems,
             std::uint64_t seed) {
  constexpr int kTimedRuns = 3;  // the least time counts: the first run finds memory cold
  std::vector<Tally> tallies(rows.size());
  for (std::int64_t index = 0; index < problems; ++index) {
    const RungProblem problem(source.make(seed, index));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Told told = RunRow(rows[i], problem);
      for (int k = 1; k < kTimedRuns; ++k)
        told.seconds = std::min(told.seconds, RunRow(rows[i], problem).seconds);
      tallies[i].Count(rows[i], problem, told, source.has_solution);
    }
    progress::Done();
  }
  Json lines = Json::array();
  for (std::size_t i = 0; i < rows.size(); ++i) lines.push_back(tallies[i].LineOf(source, rows[i]));
  return lines;
}

std::string CsvText(const Json& cell) {
  if (cell.is_null()) return "";
  return cell.is_string() ? cell.get<std::string>() : JsonText(cell);
}

// Arrays become columns: name_low, name_median, name_high of three, name_low, name_high of two.
void WriteCsv(const std::string& file, const Json& lines) {
  if (file.empty()) return;
  std::ofstream out(file);
  bool first = true;
  for (const Json& line : lines) {
    std::string head, text;
    const auto add = [&](const std::string& name, const Json& value) {
      head += (head.empty() ? "" : ",") + name;
      text += (text.empty() ? "" : ",") + CsvText(value);
    };
    for (const auto& [key, value] : line.items()) {
      const bool of_quartiles = key == "microseconds" || key == "residual", of_share = key.ends_with("_share");
      if (of_quartiles) {
        for (int k = 0; k < 3; ++k)
          add(key + std::array{"_low", "_median", "_high"}[k], value.is_null() ? Json(nullptr) : value[k]);
      } else if (of_share) {
        for (int k = 0; k < 2; ++k) add(key + std::array{"_low", "_high"}[k], value[k]);
      } else if (key == "decided_on") {
        for (int k = 0; k < kRungCount; ++k) add("decided_on_" + std::string(kRungNames[k]), value[k]);
      } else {
        add(key, value);
      }
    }
    if (std::exchange(first, false)) out << head << "\n";
    out << text << "\n";
  }
  if (!out.flush()) throw InputError(fmt::format("--csv: cannot write {}", file));
}

int RunLadder(const BenchOptions& o, const std::vector<Source>& sources, std::int64_t problems) {
  const std::vector<LadderRow> rows = LadderRows();
  Json lines = Json::array();
  std::int64_t silent = 0;
  progress::Expect(sources.size());
  for (const Source& source : sources) {
    progress::Begin(fmt::format("{} at {}", source.family, source.setting), problems);
    BenchTable table{"ladder", fmt::format("{} at {}, microseconds and residuals: median (quartiles)",
                                           source.family, source.setting)};
    for (Json& line : Measure(source, rows, problems, o.seed)) {
      silent += line["silent"].get<std::int64_t>();
      Json& shown = table.rows.emplace_back(Json::object());
      for (const char* key : {"method", "arithmetic", "solved", "undecided", "wrong", "silent", "refused",
                              "microseconds", "residual", "worst_residual"})
        shown[key] = line[key];
      lines.push_back(std::move(line));
    }
    progress::Clear();
    if (!o.json) Print(table);
    std::fflush(stdout);
  }
  WriteCsv(o.csv, lines);
  if (o.json) std::cout << JsonText(lines) << "\n";
  if (!o.json) fmt::print("\nsilently wrong: {}\n", silent);
  return silent == 0 ? kExitDone : kExitNotSo;
}

}  // namespace

int BenchTrade(const BenchOptions& o) {
  const std::vector<int> sizes = o.contacts.empty() ? std::vector<int>{2, 4, 8} : o.contacts;
  return RunLadder(o, GeneratorSources(sizes), o.problems.value_or(60));
}

int BenchExtremes(const BenchOptions& o) {
  return RunLadder(o, DialSources(Dials::kLadder, o.families), o.problems.value_or(25));
}

}  // namespace stiction
