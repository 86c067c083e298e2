// SPDX-License-Identifier: Apache-2.0
// The packages and our own methods over doubles along dials (dials.h). Answers are judged over rationals, by
// Coulomb's law; with friction only those are asked that mean it, without friction all. Nothing is timed.
//
// With --examples a file is written for the first answer of each package and dial that is wrong and called a
// success, where the package answers the tame problems: the problem, and the forces as they were told. A test
// judges them again and needs no package.

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <set>

#include "bench/dials.h"
#include "bench/output.h"
#include "bench/peers/rows.h"
#include "certify/exact/neighbour.h"
#include "certify/exact/solve.h"
#include "corpus/atomic_file.h"
#include "corpus/json.h"
#include "corpus/record/problem_file.h"
#include "corpus/rounded.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

// The normals alone.
ExactProblem WithoutFriction(const ExactProblem& problem) {
  const int contacts = static_cast<int>(problem.contacts.size());
  ExactProblem smooth;
  smooth.contacts.assign(contacts, {ContactKind::kFrictionless, 0, {}});
  smooth.A.resize(contacts, contacts);
  smooth.b.resize(contacts);
  for (int i = 0; i < contacts; ++i) {
    smooth.b[i] = problem.b[2 * i];
    for (int j = 0; j < contacts; ++j) smooth.A(i, j) = problem.A(2 * i, 2 * j);
  }
  return smooth;
}

bool HasFriction(const ExactProblem& problem) {
  return problem.rows() > static_cast<int>(problem.contacts.size());
}

// As many rows as the first; empty where doubles do not hold the numbers.
std::vector<PeerProblem> ProblemsOf(const Source& source, bool friction, const PeersOptions& o) {
  std::vector<PeerProblem> problems;
  for (int index = 0; index < 8 * o.problems && static_cast<int>(problems.size()) < o.problems; ++index) {
    ExactProblem problem = source.make(o.seed, index);
    if (!friction && HasFriction(problem)) problem = WithoutFriction(problem);
    if (friction && !HasFriction(problem)) break;
    try {
      PeerProblem rounded = Rounded<double>(problem);
      if (problems.empty() || rounded.rows() == problems.front().rows()) problems.push_back(std::move(rounded));
    } catch (const RangeError&) {
      break;
    }
  }
  return problems;
}

// Those that mean the law, and ours.
std::vector<PeerRow> RowsOf(bool friction) {
  std::vector<PeerRow> rows;
  for (PeerRow& row : friction ? PlanarRows() : FrictionlessRows()) {
    const bool other_law = row.name.find("findex") != std::string::npos;
    if (rows.empty() || (row.judge == Judge::kResidual && !other_law)) rows.push_back(std::move(row));
  }
  return rows;
}

std::string FileName(const PeerRow& row, const Source& source, bool friction) {
  std::string name;
  for (const char c : row.name + (friction ? "-" : "-frictionless-") + source.family)
    name += std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::tolower(c)) : '-';
  return name + ".json";
}

void WriteExample(const std::string& folder, const PeerRow& row, const std::string& setting,
                  const Source& source, bool friction, const PeerProblem& problem,
                  const std::vector<double>& f) {
  Json forces = Json::array();
  for (const double x : f) forces.push_back(std::isfinite(x) ? ToString(Rational(x)) : fmt::format("{}", x));
  ProblemFile file;
  file.name = FileName(row, source, friction);
  file.name.resize(file.name.size() - 5);
  file.problem = Unrounded(problem);
  file.origin =
      Json{{"package", row.package}, {"method", row.name},  {"setting", setting}, {"dial", source.family},
           {"at", source.setting},   {"called", "success"}, {"forces", forces}};
  std::filesystem::create_directories(folder);
  WriteText(std::filesystem::path(folder) / FileName(row, source, friction), Print(file));
}

// ---- In a child, for some packages abort the program ----------------------------------------------

struct Answered {
  bool claims = false;
  double residual = 0;  // infinite if the forces are no numbers
  std::vector<double> f;

  bool wrong() const { return !(residual <= kWrong); }
};

// What a row answered, by problem; empty where it crashed or took too long.
using Answers = std::vector<std::optional<Answered>>;

Answered Judged(Contender& contender, const PeerProblem& problem, int k) {
  Answered answered;
  answered.claims = contender.Solve(k);
  const Eigen::VectorXd f = contender.Forces();
  answered.residual = std::numeric_limits<double>::infinity();
  if (f.size() != problem.rows()) return answered;
  answered.f.assign(f.data(), f.data() + f.size());
  if (f.allFinite())
    answered.residual = ExactResidual(Unrounded(problem), f.unaryExpr([](double x) { return Rational(x); }));
  return answered;
}

void LimitTime(double seconds) {
  const rlimit none = {0, 0};
  const rlim_t limit = static_cast<rlim_t>(std::ceil(seconds));
  const rlimit time = {limit, limit};
  setrlimit(RLIMIT_CORE, &none);
  setrlimit(RLIMIT_CPU, &time);
}

// From problem `first` on, as long as it goes; each answer is written to the file as soon as it is there.
void AnswerInChild(const Setting& setting, const std::vector<PeerProblem>& problems, int first, double seconds,
                   std::FILE* file) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    LimitTime(seconds);
    auto contender = setting.make();
    contender->Load(problems);
    for (int k = first; k < static_cast<int>(problems.size()); ++k) {
      const Answered answered = Judged(*contender, problems[k], k);
      const auto size = answered.f.size();
      std::fwrite(&answered.claims, sizeof answered.claims, 1, file);
      std::fwrite(&answered.residual, sizeof answered.residual, 1, file);
      std::fwrite(&size, sizeof size, 1, file);
      std::fwrite(answered.f.data(), sizeof(double), size, file);
      std::fflush(file);
    }
    _exit(0);
  }
  if (child > 0) waitpid(child, nullptr, 0);
}

// Of a file that may end in the middle of an answer.
std::optional<Answered> ReadAnswer(std::FILE* file) {
  Answered answered;
  std::size_t size = 0;
  const bool there = std::fread(&answered.claims, sizeof answered.claims, 1, file) == 1 &&
                     std::fread(&answered.residual, sizeof answered.residual, 1, file) == 1 &&
                     std::fread(&size, sizeof size, 1, file) == 1;
  if (!there) return std::nullopt;
  answered.f.resize(size);
  if (std::fread(answered.f.data(), sizeof(double), size, file) != size) return std::nullopt;
  return answered;
}

// A child for all problems; where it dies, another begins after the problem at hand. Three deaths end it.
Answers AnswersOf(const Setting& setting, const std::vector<PeerProblem>& problems, double seconds) {
  constexpr int kMostDeaths = 3;
  Answers answers;
  for (int deaths = 0; answers.size() < problems.size() && deaths < kMostDeaths; ++deaths) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
    STICTION_CHECK(file != nullptr, "a temporary file");
    AnswerInChild(setting, problems, static_cast<int>(answers.size()), seconds, file.get());
    std::rewind(file.get());
    while (auto answer = ReadAnswer(file.get())) answers.push_back(std::move(answer));
    if (answers.size() < problems.size()) answers.emplace_back();
  }
  answers.resize(problems.size());
  return answers;
}

std::int64_t CountOf(const Answers& answers, bool (*which)(const Answered&)) {
  return std::count_if(answers.begin(), answers.end(), [which](const auto& a) { return a && which(*a); });
}
std::int64_t Solved(const Answers& answers) {
  return CountOf(answers, [](const Answered& a) { return !a.wrong(); });
}

// The setting that solves most; empty if the package is missing.
struct BestAnswers {
  std::string setting;
  Answers answers;
};
BestAnswers AnswersOf(const PeerRow& row, const std::vector<PeerProblem>& problems, double seconds) {
  BestAnswers best;
  for (const Setting& setting : row.settings) {
    if (setting.make() == nullptr) continue;
    Answers answers = AnswersOf(setting, problems, seconds);
    if (best.answers.empty() || Solved(answers) > Solved(best.answers))
      best = {setting.name, std::move(answers)};
  }
  return best;
}

// ---- Lines ---------------------------------------------------------------------------------------

Json LineOf(const Source& source, const PeerRow& row, const BestAnswers& best) {
  Json line = {{"dial", source.family}, {"at", source.setting}, {"name", row.name}, {"package", row.package}};
  line["installed"] = !best.answers.empty();
  if (best.answers.empty()) return line;
  double worst = 0;
  for (const auto& answer : best.answers) worst = answer ? std::max(worst, answer->residual) : worst;
  line.update({{"setting", best.setting},
               {"tried", best.answers.size()},
               {"solved", Solved(best.answers)},
               {"silent", CountOf(best.answers, [](const Answered& a) { return a.wrong() && a.claims; })},
               {"refused", CountOf(best.answers, [](const Answered& a) { return !a.claims; })},
               {"crashed", std::count(best.answers.begin(), best.answers.end(), std::nullopt)},
               {"worst", std::isfinite(worst) ? Json(worst) : Json()}});
  return line;
}

void PrintLine(const Json& line) {
  fmt::print("  {:12} {:>5}  {:26} ", line["dial"].get<std::string>(), line["at"].get<int>(),
             line["name"].get<std::string>());
  if (!line["installed"].get<bool>()) return fmt::print("not installed\n");
  fmt::print("{:>5} of {:<5} {:>7} {:>8} {:>8} {:>10} {}\n", line["solved"].get<int>(),
             line["tried"].get<int>(), line["silent"].get<int>(), line["refused"].get<int>(),
             line["crashed"].get<int>(),
             line["worst"].is_null() ? "-" : fmt::format("{:.0e}", line["worst"].get<double>()),
             line["setting"].get<std::string>());
}

// Rounded to doubles a problem may have lost its solution.
bool IsSolvable(const PeerProblem& problem) {
  return Solve(Unrounded(problem), {.method = "complete"}).Solved();
}

// The first wrong answer of a package and dial that is called a success, of a problem with a solution.
class Examples {
 public:
  explicit Examples(const std::string& folder) : folder_(folder) {}

  void Take(const PeerRow& row, const Source& source, bool friction, const BestAnswers& best,
            const std::vector<PeerProblem>& problems) {
    if (source.family == "tame" && Solved(best.answers) == static_cast<std::int64_t>(problems.size()))
      tame_.insert(row.name);
    if (folder_.empty() || row.package.empty() || tame_.count(row.name) == 0) return;
    for (std::size_t k = 0; k < problems.size(); ++k) {
      const auto& answer = best.answers[k];
      const bool silent = answer && answer->claims && answer->wrong() && !answer->f.empty();
      if (!silent || !IsSolvable(problems[k])) continue;
      if (written_.insert(row.name + source.family).second)
        WriteExample(folder_, row, best.setting, source, friction, problems[k], answer->f);
      return;
    }
  }

 private:
  std::string folder_;
  std::set<std::string> tame_, written_;  // rows that answer all tame problems; rows with dials
};

}  // namespace

Json MeasureExtremes(bool friction, const PeersOptions& o) {
  const std::vector<PeerRow> rows = RowsOf(friction);
  Examples examples(o.examples);
  Json lines = Json::array();
  if (!o.json)
    fmt::print("\n{}\n  {:12} {:>5}  {:26} {:>14} {:>7} {:>8} {:>8} {:>10}\n",
               friction ? "with friction" : "without friction", "dial", "at", "", "solved", "silent", "refused",
               "crashed", "worst");
  const std::vector<Source> sources = DialSources(Dials::kLadder, {});
  progress::Begin("dials", std::ssize(sources));
  for (const Source& source : sources) {
    progress::Done();
    const auto problems = ProblemsOf(source, friction, o);
    if (problems.empty()) continue;
    for (std::size_t i = 1; i < rows.size(); ++i) {  // the first is the unit of times
      const BestAnswers best = AnswersOf(rows[i], problems, o.cap);
      progress::Done(0);
      progress::Clear();
      if (!best.answers.empty()) examples.Take(rows[i], source, friction, best, problems);
      lines.push_back(LineOf(source, rows[i], best));
      if (!o.json) PrintLine(lines.back());
    }
    std::fflush(stdout);
  }
  return {{"name", friction ? "extremes" : "extremes-frictionless"}, {"lines", lines}};
}

}  // namespace stiction
