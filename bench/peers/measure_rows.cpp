// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/output.h"
#include "bench/peers/rows.h"
#include "corpus/json.h"
#include "solver/problem/lenient.h"

namespace stiction {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Times of one contender.
struct Run {
  std::unique_ptr<Contender> contender;
  Clocks spent;
  std::vector<double> groups, processor;  // s, a problem
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
  const Eigen::VectorXd f = contender.Forces();
  if (f.size() != problem.rows()) return kInfinity;
  const Eigen::VectorXd a = problem.A * f + problem.b;
  return MeasureLeniently(problem, FrictionLaw::kCoulomb, f, a).error;
}

// Whether the first problem is solved within so many seconds of processor time, rounded up, by a child.
bool EndsWithin(double seconds, Contender& contender) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit none = {0, 0};
    const rlim_t limit = static_cast<rlim_t>(std::ceil(seconds));
    const rlimit time = {limit, limit};
    setrlimit(RLIMIT_CORE, &none);
    setrlimit(RLIMIT_CPU, &time);
    contender.Solve(0);
    _exit(0);
  }
  int status = 1;
  return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// Slow ones are timed on some problems nevertheless.
bool HasEnough(const Run& run, double seconds) {
  const double spent = run.spent.Least();
  return spent > 10 * seconds || (spent > seconds && run.groups.size() >= 5);
}

void TimeGroups(std::vector<Run>& runs, int problems, int group, double seconds) {
  for (bool any = true; any;) {
    any = false;
    for (int first = 0; first + group <= problems; first += group) {
      for (Run& run : runs) {
        if (run.contender == nullptr || HasEnough(run, seconds)) continue;
        const Clocks start = ReadClocks();
        for (int k = first; k < first + group; ++k) run.contender->Solve(k);
        const Clocks took = ReadClocks() - start;
        run.spent += took;
        run.groups.push_back(took.Least() / group);
        run.processor.push_back(took.all / group);
        any |= !HasEnough(run, seconds);
      }
    }
  }
}

Score CheckAnswers(Contender& contender, Judge judge, const std::vector<PeerProblem>& problems,
                   double seconds) {
  const double start = ReadClocks().all;
  Score answers;
  std::vector<double> residuals;
  for (std::size_t k = 0; k < problems.size() && (k == 0 || ReadClocks().all - start < seconds); ++k) {
    const bool claims = contender.Solve(static_cast<int>(k));
    residuals.push_back(ResidualOf(contender, problems[k]));
    const bool wrong = judge == Judge::kClaim ? !claims : residuals.back() > kWrong;
    ++answers.tried;
    if (const std::string_view by = contender.AnsweredBy(); !by.empty()) ++answers.by[std::string(by)];
    answers.wrong += wrong;
    answers.silent += wrong && claims;
    answers.refused += !claims;
  }
  answers.residual = QuartilesOf(residuals).median;
  answers.worst = *std::max_element(residuals.begin(), residuals.end());
  return answers;
}

std::unique_ptr<Contender> Loaded(const Setting& setting, const std::vector<PeerProblem>& problems) {
  auto contender = setting.make();
  if (contender != nullptr) contender->Load(problems);
  return contender;
}

// The contender with the fewest wrong answers in the time given, then with the least median residual. Null, and
// the cell says why, if there is none.
std::unique_ptr<Contender> BestSetting(const PeerRow& row, const std::vector<PeerProblem>& problems,
                                       const PeersOptions& o, PeerCell& cell) {
  std::unique_ptr<Contender> best;
  Score best_score;
  cell.installed = false;
  progress::Done();
  for (const Setting& setting : row.settings) {
    auto contender = Loaded(setting, problems);
    if (contender == nullptr) continue;
    cell.installed = true;
    if (!EndsWithin(o.cap, *contender)) continue;
    contender->Solve(0);  // takes its memory
    if (row.settings.size() == 1) return contender;
    const Score score = CheckAnswers(*contender, row.judge, problems, 5 * o.seconds);
    const bool better = score.share() > best_score.share() ||
                        (score.share() == best_score.share() && score.residual < best_score.residual);
    if (best != nullptr && !better) continue;
    best = std::move(contender);
    best_score = score;
    cell.setting = setting.name;
  }
  cell.capped = cell.installed && best == nullptr;
  return best;
}

Quartiles RatiosOf(const Run& run, const Run& unit) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(run.groups.size(), unit.groups.size()); ++i)
    ratios.push_back(run.groups[i] / unit.groups[i]);
  return QuartilesOf(ratios);
}

Json QuartilesJson(const Quartiles& q) { return {q.low, q.median, q.high}; }

// null: not a number.
Json NumberJson(double x) { return std::isfinite(x) ? Json(x) : Json(); }

}  // namespace

std::vector<PeerCell> MeasureRows(const std::vector<PeerRow>& rows, const std::vector<PeerProblem>& problems,
                                  const PeersOptions& o) {
  std::vector<Run> runs(rows.size());
  std::vector<PeerCell> cells(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) runs[i].contender = BestSetting(rows[i], problems, o, cells[i]);
  const int count = static_cast<int>(problems.size());
  TimeGroups(runs, count, std::min(GroupOf(problems.front()), count), o.seconds);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!cells[i].measured()) continue;
    cells[i].seconds = QuartilesOf(runs[i].groups);
    cells[i].processor = QuartilesOf(runs[i].processor);
    cells[i].ratio = RatiosOf(runs[i], runs[0]);
    cells[i].spent = runs[i].spent;
    if (rows[i].judge == Judge::kNone) continue;
    cells[i].answers = CheckAnswers(*runs[i].contender, rows[i].judge, problems, 10 * o.seconds);
  }
  return cells;
}

std::vector<Ahead> PeersAhead(const std::vector<PeerRow>& rows, const std::vector<PeerCell>& cells,
                              std::string_view ours) {
  std::vector<Ahead> ahead;
  for (std::size_t mine = 0; mine < rows.size(); ++mine) {
    if (rows[mine].name != ours || !cells[mine].measured()) continue;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].package.empty() || !cells[i].measured()) continue;
      const double share = cells[i].answers.share(), our_share = cells[mine].answers.share();
      const double ratio = cells[i].ratio.median, our_ratio = cells[mine].ratio.median;
      if (share > our_share || (share == our_share && share > 0 && ratio < our_ratio))
        ahead.push_back({std::string(ours), rows[i].name, ratio, our_ratio, share, our_share});
    }
  }
  return ahead;
}

std::string AheadText(const std::vector<Ahead>& ahead) {
  std::string text;
  for (const Ahead& peer : ahead) {
    text += fmt::format("{}{} {:.2f} against {:.2f}", text.empty() ? "" : ", ", peer.peer, peer.ratio,
                        peer.our_ratio);
    if (peer.share != peer.our_share)
      text += fmt::format(" (solves {:.0f} % against {:.0f} %)", 100 * peer.share, 100 * peer.our_share);
  }
  return text;
}

Json CellJson(const PeerRow& row, const PeerCell& cell) {
  Json json = {{"installed", cell.installed}, {"capped", cell.capped}};
  if (!cell.measured()) return json;
  json["setting"] = cell.setting;
  json["ratio"] = cell.ratio.median;
  json["ratios"] = QuartilesJson(cell.ratio);
  json["ratio_90"] = cell.ratio.ninety;
  json["seconds"] = QuartilesJson(cell.seconds);
  json["processor_seconds"] = QuartilesJson(cell.processor);
  json["clocks"] = ToJson(cell.spent);
  if (row.judge == Judge::kNone) return json;
  const Score& answers = cell.answers;
  json.update({{"tried", answers.tried},
               {"wrong", answers.wrong},
               {"silent", answers.silent},
               {"refused", answers.refused},
               {"share", answers.share()},
               {"residual", NumberJson(answers.residual)},
               {"worst", NumberJson(answers.worst)}});
  if (!answers.by.empty()) json["answered by"] = answers.by;
  return json;
}

Json ToJson(const std::vector<Ahead>& ahead) {
  Json json = Json::array();
  for (const Ahead& peer : ahead) {
    json.push_back({{"ours", peer.ours},
                    {"peer", peer.peer},
                    {"ratio", peer.ratio},
                    {"our_ratio", peer.our_ratio},
                    {"share", peer.share},
                    {"our_share", peer.our_share}});
  }
  return json;
}

}  // namespace stiction
