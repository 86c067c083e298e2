// SPDX-License-Identifier: Apache-2.0
// Examiner: looks at a problem of a unit again, with certified signs, over rationals, by other methods.

#pragma once

#include "certify/exact/exact.h"
#include "certify/exact/filtered.h"
#include "search/units/collector.h"
#include "search/units/exact_methods.h"
#include "search/units/regenerate.h"

namespace stiction {

class Examiner {
 public:
  Examiner(Collector& collector, const ExactMethods& methods)
      : collector_(collector), campaign_(collector.campaign()), methods_(methods) {}

  // A problem that is looked at again. `suspected`: the inexact run did not end in a verified solution.
  // Certified signs decide; what they leave open, what is audited, and a few of the others are examined over
  // rationals.
  void RunAgain(std::int64_t index, std::size_t policy, Outcome inexact, bool wrong, bool suspected);
  // Problem `index` where the campaign asks for certified signs from the start.
  void RunCertified(std::int64_t index, std::size_t policy, bool audit);
  // The same in space, over intervals: `undecided` is a verdict, which makes no finding unless doubles suspect
  // a loop.
  void RunOverIntervals(std::int64_t index, std::size_t policy, const Verdict& inexact, bool wrong,
                        bool suspected);

 private:
  using Place = Collector::Place;

  Regenerated DrawAgain(std::int64_t index);
  InexactAnswer RunInSpace(const ExactProblem& problem, std::size_t policy);
  ExactRun RunExactly(const ExactProblem& problem, std::size_t policy);
  Request RequestOf(std::size_t policy) const;
  // What a problem is drawn by for the methods that run on a few only.
  std::uint64_t DrawOf(std::int64_t index) const;
  bool IsDrawn(std::uint64_t draw) const;
  OnRung Filter(const ExactProblem& problem, std::size_t policy, const Rungs& rungs);
  // The outcome in exact arithmetic: that of certified signs, or of a run over rationals.
  Outcome Decide(const Place& place, const ExactProblem& problem, const OnRung& filtered, bool suspected);
  // What is not solved, by certified signs: complete driving must solve the first of a group in the unit.
  void Confirm(const Place& place, const ExactProblem& problem, const OnRung& filtered);
  // Runs exactly, counts, compares; returns the exact outcome. `filtered`: what was said with certified signs,
  // null if nothing. Other methods see what is drawn, and the first of each group that is not solved.
  Outcome Examine(const Place& place, const ExactProblem& problem, const Verdict* filtered, bool suspected,
                  bool drawn = true);
  // Whether it is the first of its group in the unit.
  template <class Scalar>
  bool FindUnsolved(const Place& place, const Verdict& verdict, const std::vector<Pivot<Scalar>>& pivots,
                    const ExactProblem& problem);
  // Certified signs are those of rationals: the same end after the same steps.
  void CompareFiltered(const Place& place, const Verdict& filtered, const ExactRun& run,
                       const ExactProblem& problem);
  // Complete driving on polygons ends in a solution of its own law, which is proved; that more corners lead to
  // one of (21), (22) is not.
  void CompareInSpace(const Place& place, Outcome published, const ExactProblem& problem);
  // Holds the methods against each other. All generators promise A positive semidefinite and b in range(A), as
  // FindDisagreement requires; that there is a solution is counted where none slides. Lemke's method where
  // asked for, otherwise by lot.
  void Compare(const Place& place, const ExactRun& published, const ExactProblem& problem, bool with_lemke);
  // The answer of complete driving is the first.
  void CompareAnswers(const Place& place, Outcome published, const ExactProblem& problem,
                      const Answers& answers);
  bool IsSafe(const ExactProblem& problem);
  // In a safe problem nothing is given up under apex=suspended, unless there are ties.
  void CheckSafety(const Place& place, const ExactRun& published, const ExactProblem& problem);

  Collector& collector_;
  const Campaign& campaign_;
  const ExactMethods& methods_;
};

}  // namespace stiction
