// SPDX-License-Identifier: Apache-2.0
// A search beside Siconos's Lemke on the same problems: those of `integers`.
//
// All three are given the problems, in their own form, and solve them: the published algorithm as a search runs
// it (in lanes at two contacts, and what leaves them alone); Siconos's driver for planar friction, which is
// wrong where coefficients differ; and its lcp_lexicolemke on the complementarity problem of three unknowns a
// contact. The search itself draws the problems besides, judges the forces, and decides over rationals what is
// suspected or audited. Times are processor time of the thread, by turns.

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "bench/output.h"
#include "bench/peers/tables.h"
#include "corpus/input_error.h"
#include "corpus/json.h"
#include "corpus/order_statistics.h"
#include "corpus/stopwatch.h"
#include "search/lanes/batch.h"
#include "search/units/unit.h"
#include "solver/problem/lenient.h"
#include "solver/published/published.ipp"

namespace stiction {
namespace {

constexpr std::int64_t kProblems = 20'000;  // several that are audited
constexpr int kRuns = 5;

Campaign CampaignOf(int contacts, std::uint64_t seed) {
  Campaign campaign;
  campaign.seed = seed;
  campaign.generators = {GeneratorId::kIntegers};
  campaign.contacts = {contacts};
  campaign.unit_problems = kProblems << std::max(0, contacts - 2);
  return campaign;
}

// The problems of its unit 0.
std::vector<PeerProblem> ProblemsOf(const Campaign& campaign) {
  std::vector<PeerProblem> problems(kProblems);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    Choices choices(ProblemSeed(campaign.seed, 0, i));
    Generate<double, Eigen::Dynamic>(GeneratorId::kIntegers, campaign.contacts.front(),
                                     SurroundingsOf(campaign), choices, problems[i]);
  }
  return problems;
}

// The problems in the form in which a search solves them.
class Solver {
 public:
  virtual ~Solver() = default;
  virtual void SolveAll() = 0;
};

template <int Rows>
class OneByOne : public Solver {
 public:
  explicit OneByOne(const std::vector<PeerProblem>& problems) {
    for (const PeerProblem& problem : problems) {
      ContactProblem<double, Rows>& fixed = problems_.emplace_back();
      fixed.A = problem.A;
      fixed.b = problem.b;
      std::copy(problem.contacts.begin(), problem.contacts.end(), fixed.contacts.begin());
    }
  }
  void SolveAll() override {
    for (const auto& problem : problems_) algorithm_.Run(problem);
  }
  void Solve(std::size_t i) { algorithm_.Run(problems_[i]); }
  const ContactProblem<double, Rows>& problem(std::size_t i) const { return problems_[i]; }

 private:
  std::vector<ContactProblem<double, Rows>> problems_;
  PublishedAlgorithm<double, Rows> algorithm_;
};

template <int Rows>
class InLanes : public Solver {
 public:
  explicit InLanes(const std::vector<PeerProblem>& problems) : alone_(problems), size_(problems.size()) {
    for (std::size_t i = 0; i < size_; ++i) {
      if (i % kBlockProblems == 0)
        batches_.push_back(std::make_unique<Batch<Rows>>(BestInstructionSet(), Request{}));
      batches_.back()->Put(static_cast<int>(i % kBlockProblems), alone_.problem(i), {});
    }
  }
  void SolveAll() override {
    for (std::size_t first = 0; first < size_; first += kBlockProblems) {
      Batch<Rows>& batch = *batches_[first / kBlockProblems];
      const int count = static_cast<int>(std::min<std::size_t>(kBlockProblems, size_ - first));
      batch.Run(count);
      for (int i = 0; i < count; ++i) {
        if (batch.IsLeft(i)) alone_.Solve(first + static_cast<std::size_t>(i));
      }
    }
  }

 private:
  OneByOne<Rows> alone_;
  std::size_t size_;
  std::vector<std::unique_ptr<Batch<Rows>>> batches_;
};

template <int Rows>
std::unique_ptr<Solver> MakeFixed(const std::vector<PeerProblem>& problems) {
  if constexpr (HasLanes(Rows)) {
    if (BestInstructionSet() != InstructionSet::kNone) return std::make_unique<InLanes<Rows>>(problems);
  }
  return std::make_unique<OneByOne<Rows>>(problems);
}

std::unique_ptr<Solver> MakeSolver(int contacts, const std::vector<PeerProblem>& problems) {
  if (contacts == 2) return MakeFixed<4>(problems);
  if (contacts == 3) return MakeFixed<6>(problems);
  if (contacts == 4) return MakeFixed<8>(problems);
  if (contacts == 5) return MakeFixed<10>(problems);
  throw InputError(fmt::format("--contacts: found {}, expected 2 to 5 for the table lemke", contacts));
}

template <class Run>
double SecondsOf(Run run) {
  const double start = ReadSeconds(CLOCK_THREAD_CPUTIME_ID);
  run();
  return ReadSeconds(CLOCK_THREAD_CPUTIME_ID) - start;
}

int CountWrong(const std::vector<PeerProblem>& problems, Contender& contender) {
  int wrong = 0;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    contender.Solve(static_cast<int>(i));
    const Eigen::VectorXd f = contender.Forces();
    const Eigen::VectorXd a = problems[i].A * f + problems[i].b;
    wrong += !(MeasureLeniently(problems[i], FrictionLaw::kCoulomb, f, a).error <= 1e-6);
  }
  return wrong;
}

Json SpreadJson(const std::vector<double>& values) {
  const Quartiles s = QuartilesOf(values);
  return {s.least, s.median, s.most};
}

Json Row(const char* name, SiconosMethod method, int contacts, const PeersOptions& o) {
  const Campaign campaign = CampaignOf(contacts, o.seed);
  const std::vector<PeerProblem> problems = ProblemsOf(campaign);
  const auto contender = MakeSiconos(method);
  if (contender == nullptr) return {{"contacts", contacts}, {"peer", name}};
  contender->Load(problems);
  const int wrong = CountWrong(problems, *contender);  // and warms up
  progress::Done();
  UnitRunner runner(campaign);
  const auto solver = MakeSolver(contacts, problems);
  runner.Run(0);
  solver->SolveAll();
  std::vector<double> whole, ours, theirs, ratios;
  for (int run = 0; run < kRuns; ++run) {
    whole.push_back(kProblems / SecondsOf([&] { runner.Run(0); }));
    const double mine = SecondsOf([&] { solver->SolveAll(); });
    const double other = SecondsOf([&] {
      for (int i = 0; i < kProblems; ++i) contender->Solve(i);
    });
    ours.push_back(kProblems / mine);
    theirs.push_back(kProblems / other);
    ratios.push_back(other / mine);
    progress::Done();
  }
  return {{"contacts", contacts},
          {"peer", name},
          {"peer, problems a second", SpreadJson(theirs)},
          {"solved a second", SpreadJson(ours)},
          {"times as many", SpreadJson(ratios)},
          {"whole search", SpreadJson(whole)},
          {"problems", kProblems},
          {"wrong of the peer", wrong}};
}

}  // namespace

Json MeasureLemke(const PeersOptions& o) {
  Json rows = Json::array();
  BenchTable measured{"lemke",
                      "Siconos's Lemke and the published algorithm on the same problems of integers: times as "
                      "many solved"};
  progress::Begin("beside Lemke",
                  2 * (o.contacts.empty() ? 3 : static_cast<int>(o.contacts.size())) * (kRuns + 1));
  for (const int contacts : o.contacts.empty() ? std::vector<int>{2, 3, 5} : o.contacts) {
    rows.push_back(Row("Siconos Lemke, LCP", SiconosMethod::kPlanarLcp, contacts, o));
    rows.push_back(Row("Siconos Lemke, fc2d", SiconosMethod::kFriction2dLemke, contacts, o));
  }
  progress::Clear();
  for (const Json& row : rows) {
    if (row.contains("problems")) measured.rows.push_back(row);
  }
  if (!o.json) Print(measured);
  return {{"name", "lemke"}, {"rows", rows}};
}

}  // namespace stiction
