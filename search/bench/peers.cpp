// SPDX-License-Identifier: Apache-2.0
// stiction-peers: stiction beside the solvers of other packages, on the same problems in the same run.
//
// A program of its own, so that stiction is not linked with these packages. A time is the median over groups
// of consecutive problems, of the group's mean; contenders take their turns group by group, and no problem is
// solved twice in a row, which would teach the processor its branches. Every answer is then checked: wrong is
// a natural residual above 1e-6, or not a number; silent is wrong and called a success.

#include "search/bench/peers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <Eigen/Dense>
#include <chrono>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <optional>

#include "corpus/json_text.h"
#include "search/bench/measure.h"
#include "search/choices.h"
#include "solver/complete.h"
#include "solver/fast.h"
#include "solver/lemke.h"
#include "solver/published.h"
#include "solver/residual.h"

namespace stiction {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kWrong = 1e-6;

struct PeersOptions {
  std::vector<std::string> tables = {"full", "half", "planar", "planar-half", "growth"};
  std::vector<int> contacts;
  int problems = 400;
  double seconds = 0.3;
  double cap = 0.5;
  double growth_cap = 3;
  std::uint64_t seed = 1;
  bool json = false;
};

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// ---- Problems --------------------------------------------------------------------------------

// Uniform in [-1, 1].
double Draw(Choices& choices) { return static_cast<double>(choices.Integer(-1000000, 1000000)) * 1e-6; }

// A = J J' for J of rows x rank, entries uniform in [-1, 1]; b uniform in [-1, 1] where rank = rows, otherwise
// b = J y, y uniform: about half of the contacts are active. mu uniform in [1/10, 1], one per contact.
PeerProblem MakeProblem(int contacts, bool friction, bool full_rank, std::uint64_t seed) {
  Choices choices(seed);
  const int rows = friction ? 2 * contacts : contacts, rank = full_rank ? rows : std::max(1, rows / 2);
  Eigen::MatrixXd J(rows, rank);
  for (double& x : J.reshaped()) x = Draw(choices);
  PeerProblem problem;
  problem.A = J * J.transpose();
  Eigen::VectorXd y(rank);
  for (double& x : y) x = Draw(choices);
  problem.b = full_rank ? y : Eigen::VectorXd(J * y);
  for (int i = 0; i < contacts; ++i) {
    const double mu = 0.1 + 0.45 * (1 + Draw(choices));
    problem.contacts.push_back(
        {friction ? ContactKind::kStatic : ContactKind::kFrictionless, friction ? mu : 0, {}});
  }
  return problem;
}

// ---- stiction's own contenders, and the measure ----------------------------------------------

// The linear system A x = -b.
template <class Factorization>
class LinearContender : public Contender {
 public:
  void Load(const std::vector<PeerProblem>& problems) override { problems_ = &problems; }
  bool Solve(int k) override {
    factorization_.compute((*problems_)[k].A);
    x_ = factorization_.solve(-(*problems_)[k].b);
    return true;
  }
  Eigen::VectorXd Forces() const override { return x_; }

 private:
  const std::vector<PeerProblem>* problems_ = nullptr;
  Factorization factorization_;
  Eigen::VectorXd x_;
};

const Eigen::VectorXd& ForcesOf(const PublishedAlgorithm<double>& solver) { return solver.state().f; }
const Eigen::VectorXd& ForcesOf(const CompleteDriving<double>& solver) { return solver.state().f; }
const Eigen::VectorXd& ForcesOf(const LemkeAlgorithm<double>& solver) { return solver.f(); }
const Eigen::VectorXd& ForcesOf(const FastSolver<double>& solver) { return solver.f(); }

template <class Solver>
class OwnContender : public Contender {
 public:
  explicit OwnContender(Solver solver = Solver()) : solver_(std::move(solver)) {}
  void Load(const std::vector<PeerProblem>& problems) override { problems_ = &problems; }
  bool Solve(int k) override { return solver_.Run((*problems_)[k]).outcome == Outcome::kSolved; }
  Eigen::VectorXd Forces() const override { return ForcesOf(solver_); }

 private:
  const std::vector<PeerProblem>* problems_ = nullptr;
  Solver solver_;
};

// ---- One size of one table -------------------------------------------------------------------

struct Row {
  std::string name;
  std::string package;  // of the peer; empty for our own
  std::function<std::unique_ptr<Contender>()> make;
  bool linear = false;  // solves another problem: its answers are not checked
};

struct Cell {
  bool installed = true, capped = false;
  Quartiles seconds;
  double ratio = 0;  // to the first row
  int tried = 0, wrong = 0, silent = 0;
};

struct Run {
  std::unique_ptr<Contender> contender;
  double spent = 0;
  std::vector<double> groups;
};

int GroupOf(int rows) { return rows <= 16 ? 20 : rows <= 64 ? 5 : 1; }

// Whether the answer of the last call is wrong.
bool IsWrong(const Contender& contender, const PeerProblem& problem) {
  const Eigen::VectorXd f = contender.Forces();
  if (f.size() != problem.rows()) return true;
  const Eigen::VectorXd a = problem.A * f + problem.b;
  return !(NaturalResidual(problem, f, a) <= kWrong);
}

void TimeGroups(std::vector<Run>& runs, std::vector<Cell>& cells, int problems, int group, double seconds) {
  for (bool any = true; any;) {
    any = false;
    for (int first = 0; first + group <= problems; first += group) {
      for (std::size_t i = 0; i < runs.size(); ++i) {
        Run& run = runs[i];
        if (!cells[i].installed || cells[i].capped || (run.spent > seconds && !run.groups.empty())) continue;
        const auto start = Clock::now();
        for (int k = first; k < first + group; ++k) run.contender->Solve(k);
        const double took = SecondsSince(start);
        run.spent += took;
        run.groups.push_back(took / group);
        any |= run.spent < seconds;
      }
    }
  }
}

void CheckAnswers(Run& run, const std::vector<PeerProblem>& problems, double seconds, Cell& cell) {
  const auto start = Clock::now();
  for (std::size_t k = 0; k < problems.size() && (k == 0 || SecondsSince(start) < seconds); ++k) {
    const bool claims = run.contender->Solve(static_cast<int>(k));
    const bool wrong = IsWrong(*run.contender, problems[k]);
    ++cell.tried;
    cell.wrong += wrong;
    cell.silent += wrong && claims;
  }
}

std::vector<Cell> MeasureSize(const std::vector<Row>& rows, const std::vector<PeerProblem>& problems,
                              const PeersOptions& o) {
  std::vector<Run> runs(rows.size());
  std::vector<Cell> cells(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    runs[i].contender = rows[i].make();
    cells[i].installed = runs[i].contender != nullptr;
    if (!cells[i].installed) continue;
    runs[i].contender->Load(problems);
    runs[i].contender->Solve(0);  // takes its memory
    const auto start = Clock::now();
    runs[i].contender->Solve(0);
    cells[i].capped = SecondsSince(start) > o.cap;
  }
  const int count = static_cast<int>(problems.size());
  TimeGroups(runs, cells, count, std::min(GroupOf(problems.front().rows()), count), o.seconds);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!cells[i].installed || cells[i].capped) continue;
    cells[i].seconds = QuartilesOf(runs[i].groups);
    cells[i].ratio = cells[i].seconds.median / cells[0].seconds.median;
    if (!rows[i].linear) CheckAnswers(runs[i], problems, 10 * o.seconds, cells[i]);
  }
  return cells;
}

// ---- Tables ----------------------------------------------------------------------------------

struct Table {
  std::string name, title;
  std::vector<int> sizes;
  bool friction, full_rank;
  std::vector<Row> rows;  // the first is the unit of time
};

template <class Solver, class... Options>
Row Own(const std::string& name, Options... options) {
  return {name, "", [=] { return std::make_unique<OwnContender<Solver>>(Solver(options...)); }};
}

std::vector<Row> FrictionlessRows() {
  using Lu = LinearContender<Eigen::PartialPivLU<Eigen::MatrixXd>>;
  using Llt = LinearContender<Eigen::LLT<Eigen::MatrixXd>>;
  return {
      {"Eigen LU", "", [] { return std::make_unique<Lu>(); }, true},
      {"Eigen LLT", "", [] { return std::make_unique<Llt>(); }, true},
      {"ODE", "libode-dev", [] { return MakeOde(false); }},
      {"DART", "libdart-external-odelcpsolver-dev", [] { return MakeDart(false); }},
      {"Bullet", "libbullet-dev", [] { return MakeBullet(false); }},
      {"Siconos Lemke", "libsiconos-numerics-dev", [] { return MakeSiconos(SiconosMethod::kLcpLemke); }},
      Own<PublishedAlgorithm<double>>("published"),
      Own<CompleteDriving<double>>("complete"),
      Own<FastSolver<double>>("fast"),
  };
}

std::vector<Row> PlanarRows() {
  using Lu = LinearContender<Eigen::PartialPivLU<Eigen::MatrixXd>>;
  LemkeOptions units;
  units.cover = Cover::kUnits;
  return {
      {"Eigen LU", "", [] { return std::make_unique<Lu>(); }, true},
      {"Siconos NSGS 1e-9", "libsiconos-numerics-dev",
       [] { return MakeSiconos(SiconosMethod::kFriction2dNsgs); }},
      {"Siconos Lemke", "libsiconos-numerics-dev", [] { return MakeSiconos(SiconosMethod::kFriction2dLemke); }},
      {"ODE findex", "libode-dev", [] { return MakeOde(true); }},
      {"DART findex", "libdart-external-odelcpsolver-dev", [] { return MakeDart(true); }},
      {"Bullet findex", "libbullet-dev", [] { return MakeBullet(true); }},
      Own<PublishedAlgorithm<double>>("published"),
      Own<CompleteDriving<double>>("complete"),
      Own<LemkeAlgorithm<double>>("lemke", units),
      Own<FastSolver<double>>("fast"),
  };
}

std::vector<Table> Tables() {
  const std::vector<int> frictionless = {3, 6, 10, 30, 75, 150}, planar = {2, 3, 4, 8, 16, 32};
  return {
      {"full", "frictionless, A of full rank", frictionless, false, true, FrictionlessRows()},
      {"half", "frictionless, A of rank n/2, b in its range", frictionless, false, false, FrictionlessRows()},
      {"planar", "planar static friction, A of full rank, mu per contact", planar, true, true, PlanarRows()},
      {"planar-half", "planar static friction, A of half rank, b in its range", planar, true, false,
       PlanarRows()},
  };
}

std::string CellText(const Cell& cell) {
  if (!cell.installed) return "not inst.";
  if (cell.capped) return "-";
  std::string text = fmt::format("{:.2f}", cell.ratio);
  if (cell.wrong > 0) text += fmt::format(" {}/{}/{}", cell.wrong, cell.silent, cell.tried);
  return text;
}

Json CellJson(int size, const Row& row, const Cell& cell) {
  Json json = {{"contacts", size}, {"installed", cell.installed}, {"capped", cell.capped}};
  if (!cell.installed || cell.capped) return json;
  json["ratio"] = cell.ratio;
  json["seconds"] = {cell.seconds.low, cell.seconds.median, cell.seconds.high};
  if (row.linear) return json;
  json["tried"] = cell.tried;
  json["wrong"] = cell.wrong;
  json["silent"] = cell.silent;
  return json;
}

Json MeasureTable(const Table& table, const PeersOptions& o) {
  std::vector<std::vector<Cell>> columns;
  const std::vector<int>& sizes = o.contacts.empty() ? table.sizes : o.contacts;
  for (const int size : sizes) {
    std::vector<PeerProblem> problems;
    const int count = size <= 10 ? o.problems : size <= 30 ? o.problems / 2 : o.problems / 8;
    for (int k = 0; k < std::max(1, count); ++k) {
      problems.push_back(MakeProblem(size, table.friction, table.full_rank, ProblemSeed(o.seed, size, k)));
    }
    columns.push_back(MeasureSize(table.rows, problems, o));
  }
  Json rows = Json::array();
  if (!o.json) {
    fmt::print("\n{}: time / LU of A, answers wrong/silent/tried where any is wrong\n{:20}", table.title,
               "contacts");
    for (const int size : sizes) fmt::print("{:>19}", size);
    fmt::print("\n{:20}", "LU, microseconds");
    for (const auto& column : columns) fmt::print("{:>19.2f}", 1e6 * column[0].seconds.median);
    fmt::print("\n");
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    Json cells = Json::array();
    if (!o.json) fmt::print("{:20}", table.rows[i].name);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      cells.push_back(CellJson(sizes[c], table.rows[i], columns[c][i]));
      if (!o.json) fmt::print("{:>19}", CellText(columns[c][i]));
    }
    if (!o.json) fmt::print("\n");
    rows.push_back({{"name", table.rows[i].name}, {"package", table.rows[i].package}, {"cells", cells}});
  }
  std::fflush(stdout);
  return {{"name", table.name}, {"title", table.title}, {"rows", rows}};
}

// ---- Growth ----------------------------------------------------------------------------------

struct Growth {
  double seconds = 0, bytes = 0;
  bool solved = false;
  Json counts;
};

// Bytes that the process has from malloc.
double Held() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

template <class Statistics>
Json CountsOf(const Statistics& statistics) {
  Json json = Json::object();
  ForEachField(statistics, [&](const char* name, const char*, std::int64_t value) { json[name] = value; });
  return json;
}

// `-afresh`: every direction system is eliminated afresh. The first run takes the memory; the median of three
// more, where they are short, is the time.
template <class Solver>
Growth Grow(const PeerProblem& problem, Solver solver) {
  Growth growth;
  const double held = Held();
  std::vector<double> seconds;
  while (seconds.empty() || (seconds.size() < 4 && seconds[0] < 1)) {
    const auto start = Clock::now();
    const auto verdict = solver.Run(problem);
    seconds.push_back(SecondsSince(start));
    growth.solved = verdict.outcome == Outcome::kSolved;
    growth.counts = CountsOf(verdict.statistics);
    if (seconds.size() == 1) growth.bytes = Held() - held;
  }
  if (seconds.size() > 1) seconds.erase(seconds.begin());
  growth.seconds = QuartilesOf(seconds).median;
  return growth;
}

struct GrowthMethod {
  std::string name;
  std::vector<std::string> shown;  // counters in the text
  std::string step;                // counter of the steps that directions are solved for; empty: it has none
  std::function<Growth(const PeerProblem&)> run;
  bool stopped = false;
  std::vector<double> log_size, log_time;
};

// Least squares over the sizes above 20.
std::optional<double> Exponent(const GrowthMethod& method) {
  const Eigen::Map<const Eigen::ArrayXd> x(method.log_size.data(), method.log_size.size());
  const Eigen::Map<const Eigen::ArrayXd> y(method.log_time.data(), method.log_time.size());
  if (x.size() < 2) return std::nullopt;
  return ((x - x.mean()) * (y - y.mean())).sum() / (x - x.mean()).square().sum();
}

Json GrowthJson(const std::string& name, int contacts, const Growth& growth) {
  return {{"method", name},          {"contacts", contacts},
          {"solved", growth.solved}, {"seconds", growth.seconds},
          {"bytes", growth.bytes},   {"counts", growth.counts}};
}

Json MeasureGrowth(bool friction, const PeersOptions& o) {
  using Published = PublishedAlgorithm<double>;
  using Complete = CompleteDriving<double>;
  PublishedOptions published;
  CompleteOptions complete;
  published.update_from = complete.update_from = std::numeric_limits<int>::max();
  const std::vector<std::string> drives = {"drives", "pivots"}, stages = {"stages", "pieces"};
  std::vector<GrowthMethod> methods = {
      {"published", drives, "steps", [](auto& problem) { return Grow(problem, Published()); }, false, {}, {}},
      {"published-afresh",
       drives,
       "steps",
       [&](auto& problem) { return Grow(problem, Published(published)); },
       false,
       {},
       {}},
      {"complete", stages, "pieces", [](auto& problem) { return Grow(problem, Complete()); }, false, {}, {}},
      {"complete-afresh",
       stages,
       "pieces",
       [&](auto& problem) { return Grow(problem, Complete(complete)); },
       false,
       {},
       {}},
      {"fast",
       {"exchanges", "factorizations"},
       "",
       [](auto& problem) { return Grow(problem, FastSolver<double>()); },
       false,
       {},
       {}},
  };
  std::vector<int> sizes =
      o.contacts.empty() ? std::vector<int>{2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000} : o.contacts;
  if (friction && o.contacts.empty()) sizes.pop_back();  // as many rows
  Json points = Json::array(), exponents = Json::object();
  if (!o.json) {
    fmt::print("\ngrowth, {}, one problem per size: milliseconds, megabytes, counts\n",
               friction ? "planar static friction" : "frictionless");
  }
  for (const int size : sizes) {
    const PeerProblem problem = MakeProblem(size, friction, true, ProblemSeed(o.seed, 5000 + size, 0));
    for (GrowthMethod& method : methods) {
      if (method.stopped) {
        if (!o.json) fmt::print("{:6} {:16} {:>12}\n", size, method.name, "-");
        continue;
      }
      const Growth growth = method.run(problem);
      method.stopped = growth.seconds > o.growth_cap;
      if (size > 20 && growth.solved) {
        method.log_size.push_back(std::log(size));
        method.log_time.push_back(std::log(growth.seconds));
      }
      points.push_back(GrowthJson(method.name, size, growth));
      if (o.json) continue;
      fmt::print("{:6} {:16} {:>12.4f} {:>9.3f}", size, method.name, 1e3 * growth.seconds, 1e-6 * growth.bytes);
      for (const auto& counter : method.shown) {
        const auto count = growth.counts[counter].get<std::int64_t>();
        if (method.step.empty()) {
          fmt::print("   {} {}", count, counter);
        } else {
          fmt::print("   {:.2f} {} a contact", static_cast<double>(count) / size, counter);
        }
      }
      if (!method.step.empty()) {
        const auto steps = growth.counts[method.step].get<double>();
        fmt::print("   {:.1f} us a step", 1e6 * growth.seconds / std::max(1.0, steps));
      }
      fmt::print("{}\n", growth.solved ? "" : "   not solved");
      std::fflush(stdout);
    }
  }
  for (const GrowthMethod& method : methods) {
    const auto exponent = Exponent(method);
    exponents[method.name] = exponent ? Json(*exponent) : Json();
    if (!o.json && exponent) fmt::print("{}: time like contacts^{:.1f} above 20\n", method.name, *exponent);
  }
  return {{"name", friction ? "growth-planar" : "growth-frictionless"},
          {"points", points},
          {"exponents", exponents}};
}

// ---- The program -----------------------------------------------------------------------------

int RunPeers(const PeersOptions& o) {
  Json results = Json::array();
  const auto wanted = [&o](const std::string& name) {
    return std::find(o.tables.begin(), o.tables.end(), name) != o.tables.end();
  };
  for (const Table& table : Tables()) {
    if (wanted(table.name)) results.push_back(MeasureTable(table, o));
  }
  if (wanted("growth")) {
    for (const bool friction : {false, true}) results.push_back(MeasureGrowth(friction, o));
  }
  if (o.json) std::cout << JsonText({{"seed", o.seed}, {"tables", results}}) << "\n";
  return 0;
}

}  // namespace
}  // namespace stiction

int main(int argc, char** argv) {
  stiction::PeersOptions o;
  CLI::App program("stiction beside the solvers of other packages", "stiction-peers");
  std::vector<std::string> tables = {"growth"};
  for (const auto& table : stiction::Tables()) tables.push_back(table.name);
  program.add_option("--table", o.tables, "tables to measure")
      ->capture_default_str()
      ->check(CLI::IsMember(tables));
  program.add_option("--contacts", o.contacts, "numbers of contacts, instead of each table's own")
      ->check(CLI::Range(1, 2000));
  program.add_option("--problems", o.problems, "of a size; half and an eighth of it above 10 and 30 contacts")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  program.add_option("--seconds", o.seconds, "time for each row and size")->capture_default_str();
  program.add_option("--cap", o.cap, "a row that needs more seconds for one problem shows '-'")
      ->capture_default_str();
  program.add_option("--seed", o.seed, "of the problems")->capture_default_str();
  program.add_flag("--json", o.json, "machine output");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  }
  return stiction::RunPeers(o);
}
