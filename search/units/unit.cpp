// SPDX-License-Identifier: Apache-2.0
#include "search/units/unit.h"

#include <fmt/format.h>

#include <limits>
#include <optional>

#include "corpus/input_error.h"
#include "search/generators/generators.h"
#include "search/lanes/batch.h"
#include "search/units/examiner.h"
#include "solver/problem/lenient.h"
#include "solver/problem/reduction.h"
#include "solver/published/published.ipp"
#include "solver/published/published_space.h"

namespace stiction {

// What tries the problems of a unit, with workspaces of the size of its problems.
class Kernel {
 public:
  virtual ~Kernel() = default;
  virtual void Run(std::int64_t unit, const Task& task, Collector& collector, Examiner& examiner) = 0;
};

namespace {

constexpr double kWrongAnswer = 1e-6;  // lenient error (solver/problem/lenient.h)

// The first problem of a unit that is audited; from there on it is one in `audit_every`. Where it stands is
// drawn, so that units smaller than that are audited no more often than large ones.
std::int64_t FirstAudit(const Campaign& campaign, std::int64_t unit) {
  constexpr auto kNone = std::numeric_limits<std::uint64_t>::max();  // the index of no problem
  return static_cast<std::int64_t>(Mix(ProblemSeed(campaign.seed, static_cast<std::uint64_t>(unit), kNone)) %
                                   static_cast<std::uint64_t>(campaign.audit_every));
}

// draw(choices) for problem after problem of a unit, then attempt(index, policy, audit) under every policy.
template <class Draw, class Attempt>
void TryAll(const Campaign& campaign, std::int64_t unit, const Task& task, WorkMeter& meter, Draw draw,
            Attempt attempt) {
  SampledDraws draws;
  const std::int64_t problems = UnitProblems(campaign, task, unit);
  const std::int64_t first_audit = FirstAudit(campaign, unit);
  for (std::int64_t index = 0; index < problems; ++index) {
    Choices choices(
        ProblemSeed(campaign.seed, static_cast<std::uint64_t>(unit), static_cast<std::uint64_t>(index)));
    draws(index, [&] { draw(choices); });
    const bool audit = index % campaign.audit_every == first_audit;
    for (std::size_t policy = 0; policy < campaign.policies.size(); ++policy) attempt(index, policy, audit);
  }
  meter.Attribute(&ProcessorTime::generation, draws.Nanoseconds(problems));
}

struct Judgement {
  bool wrong = false;      // called solved, with forces that are no solution
  bool suspected = false;  // not a verified solution
};

// Counts a run over doubles. error() is the largest of its forces.
template <class Error>
Judgement Judge(Collector& collector, std::size_t policy, const Drawn& drawn, const Verdict& verdict,
                Error error) {
  collector.Count(policy, drawn, verdict);
  const bool solved = verdict.outcome == Outcome::kSolved;
  const bool wrong = solved && !(error() <= kWrongAnswer);
  collector.tally(policy).wrong += wrong;
  return {wrong, !solved || wrong};
}

// Rows: two for each contact, or dynamic, where bilateral and sliding contacts leave the problem before a run
// (solver/problem/reduction.h).
template <int Rows>
class PlanarKernel : public Kernel {
 public:
  using Vector = typename ContactProblem<double, Rows>::Vector;

  PlanarKernel(const Campaign& campaign, const UnitSolvers& solvers) : campaign_(campaign), solvers_(solvers) {
    for (const Policy& policy : campaign.policies) {
      algorithms_.emplace_back(Request{.policy = policy, .limits = campaign.limits});
    }
  }

  void Run(std::int64_t unit, const Task& task, Collector& collector, Examiner& examiner) override {
    const Surroundings surroundings = SurroundingsOf(campaign_);
    bool reduced = true;
    const auto draw = [&](Choices& choices) {
      drawn_ = Generate<double, Rows>(task.generator, task.contacts, surroundings, choices, problem_);
      if constexpr (Rows == Eigen::Dynamic) {
        whole_ = problem_;
        reduction_.emplace(whole_);
        reduced = reduction_->end() == ReductionEnd::kReduced;
        if (reduced) problem_ = reduction_->problem();
      }
    };
    TryAll(campaign_, unit, task, collector.meter(), draw,
           [&](std::int64_t index, std::size_t policy, bool audit) {
             if (reduced)
               Try(index, policy, audit, collector, examiner);
             else
               Refuse(index, policy, collector, examiner);
           });
  }

 protected:
  // The problem that was drawn last, under one policy.
  void Try(std::int64_t index, std::size_t policy, bool audit, Collector& collector, Examiner& examiner) {
    Verdict verdict = algorithms_[policy].Run(problem_);
    const Vector* f = &algorithms_[policy].state().f;
    Vector distorted;
    if (solvers_.distort) {
      distorted = *f;
      solvers_.distort(verdict, {distorted.data(), static_cast<std::size_t>(distorted.size())});
      f = &distorted;
    }
    Conclude(verdict, index, policy, audit, collector, examiner, [&] { return Error(*f); });
  }

  template <class ErrorOf>
  void Conclude(const Verdict& verdict, std::int64_t index, std::size_t policy, bool audit,
                Collector& collector, Examiner& examiner, ErrorOf error) {
    const auto [wrong, suspected] = Judge(collector, policy, drawn_, verdict, error);
    if (suspected || audit) examiner.RunAgain(index, policy, verdict.outcome, wrong, suspected);
  }

  const Campaign& campaign_;
  ContactProblem<double, Rows> problem_;
  Drawn drawn_;

 private:
  // A problem that bilateral and sliding contacts cannot leave over doubles: exact arithmetic decides.
  void Refuse(std::int64_t index, std::size_t policy, Collector& collector, Examiner& examiner) {
    Verdict verdict;
    verdict.outcome = Outcome::kSingular;
    collector.Count(policy, drawn_, verdict);
    examiner.RunAgain(index, policy, verdict.outcome, /*wrong=*/false, /*suspected=*/true);
  }

  // Of f alone: the accelerations are computed anew. Of the whole problem, whose A is symmetric.
  double Error(const Vector& f) {
    if constexpr (Rows == Eigen::Dynamic) {
      const Vector forces = reduction_->Forces(f), a = whole_.A * forces + whole_.b;
      return MeasureLeniently(whole_, FrictionLaw::kCoulomb, forces, a, units_).error;
    }
    Vector a = problem_.b;
    const int rows = problem_.rows();
    for (int i = 0; i < rows; ++i) {
      double sum = problem_.b[i];
      for (int j = 0; j < rows; ++j) sum += problem_.A(i, j) * f[j];
      a[i] = sum;
    }
    return MeasureLeniently(problem_, FrictionLaw::kCoulomb, f, a, units_).error;
  }

  const UnitSolvers& solvers_;
  std::vector<PublishedAlgorithm<double, Rows>> algorithms_;
  ContactProblem<double> whole_;                // of other kinds, before reduction
  std::optional<Reduction<double>> reduction_;  // likewise
  LenientUnits<double> units_;
};

// The same under the policy `paper`, many problems at once; what leaves the lanes is run by itself.
template <int Rows>
class BatchedKernel final : public PlanarKernel<Rows> {
 public:
  BatchedKernel(const Campaign& campaign, const UnitSolvers& solvers)
      : PlanarKernel<Rows>(campaign, solvers), batch_(solvers.lanes, RequestOf(campaign)) {}

  static bool Handles(const Campaign& campaign, const UnitSolvers& solvers) {
    return solvers.lanes != InstructionSet::kNone && !solvers.distort && campaign.policies.size() == 1 &&
           IsBatched(RequestOf(campaign));
  }

  void Run(std::int64_t unit, const Task& task, Collector& collector, Examiner& examiner) override {
    const std::int64_t problems = UnitProblems(campaign_, task, unit);
    const std::int64_t first_audit = FirstAudit(campaign_, unit);
    for (std::int64_t first = 0; first < problems; first += kBlockProblems) {
      const int count = static_cast<int>(std::min<std::int64_t>(kBlockProblems, problems - first));
      DrawBlock(unit, task, first, count, collector);
      batch_.Run(count);
      for (int i = 0; i < count; ++i) {
        const std::int64_t index = first + i;
        const bool audit = index % campaign_.audit_every == first_audit;
        drawn_ = batch_.DrawnOf(i);
        if (batch_.IsLeft(i)) {
          batch_.Get(i, problem_);
          this->Try(index, 0, audit, collector, examiner);
        } else {
          this->Conclude(batch_.VerdictOf(i), index, 0, audit, collector, examiner,
                         [&] { return batch_.Error(i); });
        }
      }
    }
  }

 private:
  using PlanarKernel<Rows>::campaign_, PlanarKernel<Rows>::problem_, PlanarKernel<Rows>::drawn_;

  static Request RequestOf(const Campaign& campaign) {
    return {.policy = campaign.policies.front(), .limits = campaign.limits};
  }

  void DrawBlock(std::int64_t unit, const Task& task, std::int64_t first, int count, Collector& collector) {
    const Spending spending(collector.meter(), &ProcessorTime::generation);
    const Surroundings surroundings = SurroundingsOf(campaign_);
    const auto u = static_cast<std::uint64_t>(unit);
    if (IsDrawnInLanes(task.generator))
      return batch_.Draw(task.generator, surroundings.palette, campaign_.seed, u, first, count);
    for (int i = 0; i < count; ++i) {
      Choices choices(ProblemSeed(campaign_.seed, u, static_cast<std::uint64_t>(first + i)));
      const Drawn drawn =
          Generate<double, Rows>(task.generator, task.contacts, surroundings, choices, problem_);
      batch_.Put(i, problem_, drawn);
    }
  }

  Batch<Rows> batch_;
};

// Problems that are decided with certified signs from the start.
class CertifiedKernel final : public Kernel {
 public:
  explicit CertifiedKernel(const Campaign& campaign) : campaign_(campaign) {}

  void Run(std::int64_t unit, const Task& task, Collector& collector, Examiner& examiner) override {
    TryAll(
        campaign_, unit, task, collector.meter(), [](Choices&) {},
        [&](std::int64_t index, std::size_t policy, bool audit) {
          examiner.RunCertified(index, policy, audit);
        });
  }

 private:
  const Campaign& campaign_;
};

// Problems of space.
class SpaceKernel final : public Kernel {
 public:
  SpaceKernel(const Campaign& campaign, const UnitSolvers& solvers) : campaign_(campaign), solvers_(solvers) {}

  void Run(std::int64_t unit, const Task& task, Collector& collector, Examiner& examiner) override {
    const auto draw = [&](Choices& choices) {
      drawn_ = Generate(task.generator, task.contacts, SurroundingsOf(campaign_), choices, problem_);
    };
    TryAll(campaign_, unit, task, collector.meter(), draw,
           [&](std::int64_t index, std::size_t policy, bool audit) {
             Try(index, policy, audit, collector, examiner);
           });
  }

 private:
  void Try(std::int64_t index, std::size_t policy, bool audit, Collector& collector, Examiner& examiner) {
    algorithm_.request() = {.policy = campaign_.policies[policy], .limits = campaign_.limits};
    const Verdict end = algorithm_.Run(problem_);
    Verdict verdict = {end.outcome, end.reason, end.statistics, end.start, end.period};
    ContactProblem<double>::Vector f = algorithm_.f();
    if (solvers_.distort) solvers_.distort(verdict, {f.data(), static_cast<std::size_t>(f.size())});
    const auto [wrong, suspected] = Judge(collector, policy, drawn_, verdict, [&] {
      const ContactProblem<double>::Vector a = problem_.A * f + problem_.b;
      return MeasureLeniently(problem_, FrictionLaw::kBaraff, f, a, units_).error;
    });
    if (suspected || audit) examiner.RunOverIntervals(index, policy, verdict, wrong, suspected);
  }

  const Campaign& campaign_;
  const UnitSolvers& solvers_;
  PublishedInSpace<double> algorithm_;
  LenientUnits<double> units_;
  ContactProblem<double> problem_;
  Drawn drawn_;
};

template <int Contacts>
std::unique_ptr<Kernel> MakePlanar(const Campaign& campaign, const UnitSolvers& solvers) {
  constexpr int kRows = 2 * Contacts;
  if constexpr (HasLanes(kRows)) {
    if (BatchedKernel<kRows>::Handles(campaign, solvers))
      return std::make_unique<BatchedKernel<kRows>>(campaign, solvers);
  }
  return std::make_unique<PlanarKernel<kRows>>(campaign, solvers);
}

// Null unless there are 1 to kMaxContacts.
template <int Contacts = 1>
std::unique_ptr<Kernel> MakePlanar(int contacts, const Campaign& campaign, const UnitSolvers& solvers) {
  if (contacts == Contacts) return MakePlanar<Contacts>(campaign, solvers);
  if constexpr (Contacts < kMaxContacts) return MakePlanar<Contacts + 1>(contacts, campaign, solvers);
  return nullptr;
}

// Of problems like those of `task`. `campaign` and `solvers` must outlive it.
std::unique_ptr<Kernel> MakeKernel(const Campaign& campaign, const UnitSolvers& solvers, const Task& task) {
  if (Row(task.generator).InSpace()) return std::make_unique<SpaceKernel>(campaign, solvers);
  if (campaign.arithmetic != Arithmetic::kDouble) return std::make_unique<CertifiedKernel>(campaign);
  if (Row(task.generator).HasOtherKinds())
    return std::make_unique<PlanarKernel<Eigen::Dynamic>>(campaign, solvers);
  auto kernel = MakePlanar(task.contacts, campaign, solvers);
  if (kernel == nullptr)
    throw InputError(fmt::format("campaign: found {} contacts, expected 1 to {}", task.contacts, kMaxContacts));
  return kernel;
}

}  // namespace

UnitRunner::UnitRunner(const Campaign& campaign, const UnitSolvers& solvers)
    : campaign_(campaign), solvers_(solvers), schedule_(Schedule(campaign)) {}
UnitRunner::~UnitRunner() = default;

UnitResult UnitRunner::Run(std::int64_t unit) {
  const Task task = TaskOf(schedule_, unit);
  const GeneratorRow& row = Row(task.generator);
  std::unique_ptr<Kernel>& kernel = kernels_[{task.contacts, row.dimension, row.HasOtherKinds()}];
  if (kernel == nullptr) kernel = MakeKernel(campaign_, solvers_, task);
  Collector collector(campaign_, task, unit);
  Examiner examiner(collector, solvers_.exact);
  kernel->Run(unit, task, collector, examiner);
  return collector.Take();
}

}  // namespace stiction
