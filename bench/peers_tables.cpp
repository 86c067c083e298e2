// SPDX-License-Identifier: Apache-2.0
// Tables of contenders: time and answers of all of them on the same problems.
//
// A time is the less of wall-clock and processor time, the median over groups of consecutive problems, of the
// group's mean; contenders take their turns group by group, and no problem is solved twice in a row, which
// would teach the processor its branches. Every answer is then checked: wrong is a residual above 1e-6, or not
// a number; silent is wrong and called a success. The residual is the natural one in the plane, that of
// Coulomb's law in space (solver/problem/residual.h).

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "bench/measure.h"
#include "bench/peers_suite.h"
#include "search/choices.h"
#include "solver/complete/complete.h"
#include "solver/lemke/lemke.h"
#include "solver/numeric/coulomb.h"
#include "solver/numeric/fast.h"
#include "solver/problem/check.h"
#include "solver/problem/residual.h"
#include "solver/published/published.h"

namespace stiction {
namespace {

constexpr double kWrong = 1e-6;

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
const Eigen::VectorXd& ForcesOf(const CompleteDriving<double>& solver) { return solver.f(); }
const Eigen::VectorXd& ForcesOf(const LemkeAlgorithm<double>& solver) { return solver.f(); }
const Eigen::VectorXd& ForcesOf(const FastSolver<double>& solver) { return solver.f(); }
const Eigen::VectorXd& ForcesOf(const CoulombSolver<double>& solver) { return solver.f(); }

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

// Complete driving on polygons of eight sides: another law, whose solutions are within some 27 degrees
// of Coulomb's (solver/complete/complete_driving.md, 9).
class PolygonContender : public Contender {
 public:
  void Load(const std::vector<PeerProblem>& problems) override {
    problems_ = &problems;
    polygons_.assign(problems.front().contacts.size(), FrictionPolygon<double>(8));
  }
  bool Solve(int k) override { return driving_.Run((*problems_)[k], polygons_).outcome == Outcome::kSolved; }
  Eigen::VectorXd Forces() const override { return driving_.f(); }

 private:
  const std::vector<PeerProblem>* problems_ = nullptr;
  std::vector<FrictionPolygon<double>> polygons_;
  CompleteDriving<double> driving_;
};

// ---- One size of one table -------------------------------------------------------------------

// What its answers are judged by: nothing, since it solves a linear system; its own word, since it solves
// another law; or the residual.
enum class Judge { kNone, kClaim, kResidual };

struct Row {
  std::string name;
  std::string package;  // of the peer; empty for our own
  std::function<std::unique_ptr<Contender>()> make;
  Judge judge = Judge::kResidual;
};

struct Cell {
  bool installed = true, capped = false;
  Quartiles seconds;
  double ratio = 0;  // to the first row
  int tried = 0, wrong = 0, silent = 0;
  double residual = 0;  // the median; infinite where it is not a number
};

struct Run {
  std::unique_ptr<Contender> contender;
  double spent = 0;
  std::vector<double> groups;
};

// In space the times of some contenders have a long tail, which a mean would follow: single problems, as soon
// as the clock can tell them.
int GroupOf(const PeerProblem& problem) {
  const int rows = problem.rows();
  if (problem.dimension == 3) return rows <= 6 ? 20 : 1;
  return rows <= 16 ? 20 : rows <= 64 ? 5 : 1;
}

// Of the answer of the last call; infinite if it is not a number.
double ResidualOf(const Contender& contender, const PeerProblem& problem) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Eigen::VectorXd f = contender.Forces();
  if (f.size() != problem.rows()) return kInfinity;
  const Eigen::VectorXd a = problem.A * f + problem.b;
  const double residual =
      problem.dimension == 3 ? CoulombResidual(problem, f, a) : NaturalResidual(problem, f, a);
  return residual < kInfinity ? residual : kInfinity;
}

void TimeGroups(std::vector<Run>& runs, std::vector<Cell>& cells, int problems, int group, double seconds) {
  for (bool any = true; any;) {
    any = false;
    for (int first = 0; first + group <= problems; first += group) {
      for (std::size_t i = 0; i < runs.size(); ++i) {
        Run& run = runs[i];
        if (!cells[i].installed || cells[i].capped || (run.spent > seconds && !run.groups.empty())) continue;
        const Stopwatch watch = StartWatch();
        for (int k = first; k < first + group; ++k) run.contender->Solve(k);
        const double took = watch.Seconds();
        run.spent += took;
        run.groups.push_back(took / group);
        any |= run.spent < seconds;
      }
    }
  }
}

void CheckAnswers(Run& run, Judge judge, const std::vector<PeerProblem>& problems, double seconds, Cell& cell) {
  const Stopwatch watch = StartWatch();
  std::vector<double> residuals;
  for (std::size_t k = 0; k < problems.size() && (k == 0 || watch.Seconds() < seconds); ++k) {
    const bool claims = run.contender->Solve(static_cast<int>(k));
    residuals.push_back(ResidualOf(*run.contender, problems[k]));
    const bool wrong = judge == Judge::kClaim ? !claims : residuals.back() > kWrong;
    ++cell.tried;
    cell.wrong += wrong;
    cell.silent += wrong && claims;
  }
  cell.residual = QuartilesOf(residuals).median;
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
    const Stopwatch watch = StartWatch();
    runs[i].contender->Solve(0);
    cells[i].capped = watch.Seconds() > o.cap;
  }
  const int count = static_cast<int>(problems.size());
  TimeGroups(runs, cells, count, std::min(GroupOf(problems.front()), count), o.seconds);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!cells[i].installed || cells[i].capped) continue;
    cells[i].seconds = QuartilesOf(runs[i].groups);
    cells[i].ratio = cells[i].seconds.median / cells[0].seconds.median;
    if (rows[i].judge != Judge::kNone) CheckAnswers(runs[i], rows[i].judge, problems, 10 * o.seconds, cells[i]);
  }
  return cells;
}

// ---- Tables ----------------------------------------------------------------------------------

struct Table {
  std::string name, title;
  std::vector<int> sizes;
  std::function<PeerProblem(int contacts, std::uint64_t seed)> make;
  std::vector<Row> rows;   // the first is the unit of time
  bool residuals = false;  // in the text, too
};

template <class Solver, class... Options>
Row Own(const std::string& name, Options... options) {
  return {name, "", [=] { return std::make_unique<OwnContender<Solver>>(Solver(options...)); }};
}

std::vector<Row> FrictionlessRows() {
  using Lu = LinearContender<Eigen::PartialPivLU<Eigen::MatrixXd>>;
  using Llt = LinearContender<Eigen::LLT<Eigen::MatrixXd>>;
  return {
      {"Eigen LU", "", [] { return std::make_unique<Lu>(); }, Judge::kNone},
      {"Eigen LLT", "", [] { return std::make_unique<Llt>(); }, Judge::kNone},
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
      {"Eigen LU", "", [] { return std::make_unique<Lu>(); }, Judge::kNone},
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

std::vector<Row> SpatialRows() {
  using Lu = LinearContender<Eigen::PartialPivLU<Eigen::MatrixXd>>;
  CoulombOptions from_polygons;
  from_polygons.start = CoulombStart::kComplete;
  return {
      {"Eigen LU", "", [] { return std::make_unique<Lu>(); }, Judge::kNone},
      {"Siconos NSGS 1e-9", "libsiconos-numerics-dev",
       [] { return MakeSiconos(SiconosMethod::kFriction3dNsgs); }},
      {"Siconos NSN-AC 1e-9", "libsiconos-numerics-dev",
       [] { return MakeSiconos(SiconosMethod::kFriction3dNewton); }},
      {"polygons", "", [] { return std::make_unique<PolygonContender>(); }, Judge::kClaim},
      Own<CoulombSolver<double>>("complete", from_polygons),
      Own<CoulombSolver<double>>("fast"),
  };
}

std::vector<Table> Tables() {
  const std::vector<int> frictionless = {3, 6, 10, 30, 75, 150}, planar = {2, 3, 4, 8, 16, 32},
                         spatial = {1, 2, 5, 10, 30, 100};
  const auto plane = [](bool friction, bool full_rank) {
    return [=](int contacts, std::uint64_t seed) { return MakePlanar(contacts, friction, full_rank, seed); };
  };
  const auto space = [](bool definite) {
    return [=](int contacts, std::uint64_t seed) { return MakeSpatial(contacts, definite, seed); };
  };
  return {
      {"full", "frictionless, A of full rank", frictionless, plane(false, true), FrictionlessRows()},
      {"half", "frictionless, A of rank n/2, b in its range", frictionless, plane(false, false),
       FrictionlessRows()},
      {"planar", "planar static friction, A of full rank, mu per contact", planar, plane(true, true),
       PlanarRows()},
      {"planar-half", "planar static friction, A of half rank, b in its range", planar, plane(true, false),
       PlanarRows()},
      {"space", "Coulomb's law in space, contacts of random bodies, A definite", spatial, space(true),
       SpatialRows(), true},
      {"space-half", "the same with n/4 bodies: A of rank 3n/2 of 3n, b in its range", spatial, space(false),
       SpatialRows(), true},
  };
}

std::string CellText(const Cell& cell, bool residual) {
  if (!cell.installed) return "not inst.";
  if (cell.capped) return "-";
  std::string text = fmt::format("{:.2f}", cell.ratio);
  if (residual && cell.tried > 0) text += fmt::format(" {:.0e}", cell.residual);
  if (cell.wrong > 0) text += fmt::format(" {}/{}/{}", cell.wrong, cell.silent, cell.tried);
  return text;
}

Json CellJson(int size, const Row& row, const Cell& cell) {
  Json json = {{"contacts", size}, {"installed", cell.installed}, {"capped", cell.capped}};
  if (!cell.installed || cell.capped) return json;
  json["ratio"] = cell.ratio;
  json["seconds"] = {cell.seconds.low, cell.seconds.median, cell.seconds.high};
  if (row.judge == Judge::kNone) return json;
  json["tried"] = cell.tried;
  json["wrong"] = cell.wrong;
  json["silent"] = cell.silent;
  json["residual"] = std::isfinite(cell.residual) ? Json(cell.residual) : Json();
  return json;
}

Json MeasureAll(const Table& table, const PeersOptions& o) {
  std::vector<std::vector<Cell>> columns;
  const std::vector<int>& sizes = o.contacts.empty() ? table.sizes : o.contacts;
  for (const int size : sizes) {
    std::vector<PeerProblem> problems;
    const int count = size <= 10 ? o.problems : size <= 30 ? o.problems / 2 : o.problems / 8;
    for (int k = 0; k < std::max(1, count); ++k) {
      problems.push_back(table.make(size, ProblemSeed(o.seed, size, k)));
    }
    columns.push_back(MeasureSize(table.rows, problems, o));
  }
  Json rows = Json::array();
  const int width = table.residuals ? 24 : 19;
  if (!o.json) {
    fmt::print("\n{}: time / LU of A{}, answers wrong/silent/tried where any is wrong\n{:20}", table.title,
               table.residuals ? ", median residual" : "", "contacts");
    for (const int size : sizes) fmt::print("{:>{}}", size, width);
    fmt::print("\n{:20}", "LU, microseconds");
    for (const auto& column : columns) fmt::print("{:>{}.2f}", 1e6 * column[0].seconds.median, width);
    fmt::print("\n");
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    Json cells = Json::array();
    if (!o.json) fmt::print("{:20}", table.rows[i].name);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      cells.push_back(CellJson(sizes[c], table.rows[i], columns[c][i]));
      if (!o.json) fmt::print("{:>{}}", CellText(columns[c][i], table.residuals), width);
    }
    if (!o.json) fmt::print("\n");
    rows.push_back({{"name", table.rows[i].name}, {"package", table.rows[i].package}, {"cells", cells}});
  }
  std::fflush(stdout);
  return {{"name", table.name}, {"title", table.title}, {"rows", rows}};
}

}  // namespace

std::vector<std::string> PeerTableNames() {
  std::vector<std::string> names;
  for (const Table& table : Tables()) names.push_back(table.name);
  return names;
}

Json MeasureTable(const std::string& name, const PeersOptions& o) {
  const std::vector<Table> tables = Tables();
  const auto table = std::find_if(tables.begin(), tables.end(), [&](auto& t) { return t.name == name; });
  STICTION_CHECK(table != tables.end(), "the table is one of PeerTableNames()");
  return MeasureAll(*table, o);
}

}  // namespace stiction
