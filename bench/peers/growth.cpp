// SPDX-License-Identifier: Apache-2.0
// Growth with the number of contacts: time, memory and counts of one problem per size.

#include <fmt/format.h>
#include <malloc.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "bench/output.h"
#include "bench/peers/one_thread.h"
#include "bench/peers/tables.h"
#include "bench/structure.h"
#include "certify/exact/answer_json.h"
#include "corpus/json.h"
#include "corpus/order_statistics.h"
#include "search/generators/choices.h"
#include "solver/complete/complete.h"
#include "solver/numeric/body_newton.h"
#include "solver/numeric/fast.h"
#include "solver/published/published.h"

namespace stiction {
namespace {

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

// `-afresh`: every direction system is eliminated afresh. The first run takes the memory; the median of three
// more, where they are short, is the time.
template <class Problem, class Solver>
Growth Grow(const Problem& problem, Solver solver) {
  Growth growth;
  const double held = Held();
  std::vector<double> seconds;
  while (seconds.empty() || (seconds.size() < 4 && seconds[0] < 1)) {
    const Clocks start = ReadClocks();
    const auto verdict = solver.Run(problem);
    seconds.push_back((ReadClocks() - start).Least());
    growth.solved = verdict.outcome == Outcome::kSolved;
    growth.counts = CountersToJson(CountersOf(verdict.statistics));
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

// Least squares.
std::optional<double> Exponent(const std::vector<double>& log_size, const std::vector<double>& log_time) {
  const Eigen::Map<const Eigen::ArrayXd> x(log_size.data(), log_size.size());
  const Eigen::Map<const Eigen::ArrayXd> y(log_time.data(), log_time.size());
  if (x.size() < 2) return std::nullopt;
  return ((x - x.mean()) * (y - y.mean())).sum() / (x - x.mean()).square().sum();
}

Json GrowthJson(const std::string& name, int contacts, const Growth& growth) {
  return {{"method", name},          {"contacts", contacts},
          {"solved", growth.solved}, {"seconds", growth.seconds},
          {"bytes", growth.bytes},   {"counts", growth.counts}};
}

}  // namespace

Json MeasureGrowth(bool friction, const PeersOptions& o) {
  using Published = PublishedAlgorithm<double>;
  using Complete = CompleteDriving<double>;
  const auto afresh = [](auto solver) {
    solver.UpdateFrom(std::numeric_limits<int>::max());
    return solver;
  };
  const std::vector<std::string> drives = {"drives", "pivots"}, stages = {"stages", "pieces"};
  std::vector<GrowthMethod> methods = {
      {"published", drives, "steps", [](auto& problem) { return Grow(problem, Published()); }, false, {}, {}},
      {"published-afresh",
       drives,
       "steps",
       [&](auto& problem) { return Grow(problem, afresh(Published())); },
       false,
       {},
       {}},
      {"complete", stages, "pieces", [](auto& problem) { return Grow(problem, Complete()); }, false, {}, {}},
      {"complete-afresh",
       stages,
       "pieces",
       [&](auto& problem) { return Grow(problem, afresh(Complete())); },
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
  progress::Begin("growth", static_cast<std::int64_t>(sizes.size() * methods.size()));
  for (const int size : sizes) {
    const PeerProblem problem = MakePlanar(size, friction, true, ProblemSeed(o.seed, 5000 + size, 0));
    for (GrowthMethod& method : methods) {
      progress::Done();
      progress::Clear();
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
    const auto exponent = Exponent(method.log_size, method.log_time);
    exponents[method.name] = exponent ? Json(*exponent) : Json();
    if (!o.json && exponent) fmt::print("{}: time like contacts^{:.1f} above 20\n", method.name, *exponent);
  }
  return {{"name", friction ? "growth-planar" : "growth-frictionless"},
          {"points", points},
          {"exponents", exponents}};
}

// Square walls of about so many contacts, whose A is never formed, without a start.
Json MeasureWallGrowth(int dimension, const PeersOptions& o) {
  const int contacts_of_brick = dimension == 2 ? 4 : 8;
  std::vector<int> sizes = {10, 30, 100, 300, 1000, 3000};
  if (dimension == 2) sizes.push_back(10000);
  if (!o.contacts.empty()) sizes = o.contacts;
  const std::string name = dimension == 2 ? "growth-walls" : "growth-walls-in-space";
  if (!o.json) fmt::print("\n{}, in factors, one problem per size: milliseconds, megabytes, counts\n", name);
  progress::Begin("growth", static_cast<std::int64_t>(sizes.size()));
  Json points = Json::array();
  std::vector<double> log_size, log_time;
  for (const int size : sizes) {
    progress::Done();
    progress::Clear();
    const int width = std::max(2, static_cast<int>(std::ceil(std::sqrt(size / double(contacts_of_brick)))));
    Choices choices(ProblemSeed(o.seed, 6000 + width, 0));
    const auto wall = WallInFactors(width, width, {.dimension = dimension}, choices);
    const int contacts = static_cast<int>(wall.contacts.size());
    const Growth growth = Grow(wall, BodyNewton());
    if (growth.solved) {
      log_size.push_back(std::log(contacts));
      log_time.push_back(std::log(growth.seconds));
    }
    points.push_back(GrowthJson("newton-bodies", contacts, growth));
    points.back()["velocities"] = wall.w.size();
    if (o.json) continue;
    fmt::print("{:6} contacts {:12.4f} {:9.3f}   {} points, {} steps, {} factorizations{}\n", contacts,
               1e3 * growth.seconds, 1e-6 * growth.bytes, growth.counts["points"].get<std::int64_t>(),
               growth.counts["newton_steps"].get<std::int64_t>(),
               growth.counts["factorizations"].get<std::int64_t>(), growth.solved ? "" : "   not solved");
  }
  const auto exponent = Exponent(log_size, log_time);
  return {{"name", name},
          {"points", points},
          {"exponents", {{"newton-bodies", exponent ? Json(*exponent) : Json()}}}};
}

}  // namespace stiction
