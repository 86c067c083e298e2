// SPDX-License-Identifier: Apache-2.0
#include "bench/method.h"

#include <memory>

#include "bench/plain_gauss.h"
#include "certify/exact/enumerate.h"
#include "certify/exact/exact.h"
#include "certify/exact/feasibility_nlp.h"
#include "certify/exact/linear_system.h"
#include "certify/exact/verify_solution.h"
#include "corpus/stopwatch.h"
#include "solver/numeric/fast.h"
#include "solver/problem/gate.h"

namespace stiction {
namespace {

constexpr double kWrongAnswer = 1e-6;  // error (solver/problem/errors.h)

// ---- Time ----------------------------------------------------------------------------------------

// The processor time of another process; wall-clock time if it is gone.
clockid_t ClockOf(pid_t process) {
  clockid_t clock;
  return clock_getcpuclockid(process, &clock) == 0 ? clock : CLOCK_MONOTONIC;
}

// ---- Methods -------------------------------------------------------------------------------------

template <class Scalar>
constexpr const char* kArithmetic = kIsExact<Scalar> ? "exact" : "double";

template <class Scalar>
const ContactProblem<Scalar>& In(const BenchProblem& problem) {
  if constexpr (kIsExact<Scalar>) {
    return problem.exact;
  } else {
    return problem.rounded;
  }
}

bool Stands(const ExactProblem& problem, const ExactProblem::Vector& f) { return !FindViolation(problem, f); }

bool Stands(const ContactProblem<double>& problem, const ContactProblem<double>::Vector& f) {
  return BoundErrors(problem, FrictionLaw::kCoulomb, f.cast<long double>()).Largest() <= kWrongAnswer;
}

template <class Scalar>
struct BenchAnswer {
  Measure measure;
  typename ContactProblem<Scalar>::Vector f;  // if solved
};

// run(problem) returns a BenchAnswer.
template <class Scalar, class Run>
Measure Timed(const BenchProblem& problem, Run run) {
  const ContactProblem<Scalar>& data = In<Scalar>(problem);
  const Stopwatch watch;
  BenchAnswer<Scalar> answer = run(data);
  Measure& measure = answer.measure;
  measure.seconds = watch.Seconds() + measure.library_seconds;
  if (measure.outcome == Outcome::kSolved) measure.wrong = !Stands(data, answer.f);
  measure.refutes |= kIsExact<Scalar> && measure.outcome == Outcome::kRay;
  return measure;
}

template <class Scalar>
BenchMethod PublishedMethod(const std::string& policy) {
  PublishedAlgorithm<Scalar> algorithm({ParsePolicy(policy), {}, {}});
  return {.name = "baraff",
          .reading = policy,
          .arithmetic = kArithmetic<Scalar>,
          .counts = "steps",
          .run = [algorithm](const BenchProblem& problem) mutable {
            return Timed<Scalar>(problem, [&algorithm](const auto& data) {
              const Verdict verdict = algorithm.Run(data);
              return BenchAnswer<Scalar>{{.outcome = verdict.outcome,
                                          .work = verdict.statistics.steps,
                                          .give_ups = verdict.statistics.give_ups},
                                         algorithm.state().f};
            });
          }};
}

template <class Scalar>
BenchMethod CompleteMethod() {
  return {.name = "complete",
          .reading = "",
          .arithmetic = kArithmetic<Scalar>,
          .counts = "pieces",
          .run = [driving = CompleteDriving<Scalar>()](const BenchProblem& problem) mutable {
            return Timed<Scalar>(problem, [&driving](const auto& data) {
              const CompleteVerdict verdict = driving.Run(data);
              return BenchAnswer<Scalar>{{.outcome = verdict.outcome,
                                          .work = verdict.statistics.pieces,
                                          .folds = verdict.statistics.folds,
                                          .descents = verdict.statistics.descents},
                                         driving.f()};
            });
          }};
}

template <class Scalar>
BenchMethod LemkeMethod(Cover cover) {
  return {.name = "lemke",
          .reading = cover == Cover::kOnes ? "ones" : "units",
          .arithmetic = kArithmetic<Scalar>,
          .counts = "pivots",
          .run = [lemke = LemkeAlgorithm<Scalar>({cover, {}, {}})](const BenchProblem& problem) mutable {
            return Timed<Scalar>(problem, [&lemke](const auto& data) {
              const Verdict verdict = lemke.Run(data);
              return BenchAnswer<Scalar>{{.outcome = verdict.outcome, .work = verdict.statistics.pivots},
                                         lemke.f()};
            });
          }};
}

BenchMethod EnumerateMethod() {
  return {.name = "enumerate",
          .reading = "",
          .arithmetic = "exact",
          .counts = "programs",
          .one_in = 20,
          .most_contacts = 4,
          .run = [](const BenchProblem& problem) {
            return Timed<Rational>(problem, [](const auto& data) {
              EnumerationOptions options;
              options.first_solution_only = true;
              const Enumeration modes = EnumerateModes(data, options);
              BenchAnswer<Rational> answer;
              answer.measure.work = modes.programs;
              answer.measure.refutes = modes.ProvesNoSolution();
              if (answer.measure.refutes) answer.measure.outcome = Outcome::kNoSolution;
              if (modes.solutions.empty()) return answer;
              answer.measure.outcome = Outcome::kSolved;
              answer.f = modes.solutions.front().f;
              return answer;
            });
          }};
}

// Solved: an exact solution came out of one of its points.
BenchMethod IpoptMethod(Formulation formulation, int one_in) {
  const auto proposer = std::make_shared<IpoptProposer>();
  return {.name = "ipopt",
          .reading = formulation == Formulation::kNonlinear ? "(17), (18)" : "(5)",
          .arithmetic = "exact",
          .counts = "starts",
          .one_in = one_in,
          .run = [proposer, formulation](const BenchProblem& problem) {
            return Timed<Rational>(problem, [&proposer, formulation](const auto& data) {
              ProposalStatistics statistics;
              ProposalOptions options;
              options.formulation = formulation;
              const Stopwatch watch(ClockOf(proposer->process_id()));
              const auto f = proposer->ProposeSolution(data, options, statistics);
              BenchAnswer<Rational> answer;
              answer.measure.work = statistics.starts;
              answer.measure.library_seconds = std::min(watch.Seconds(), statistics.ipopt_seconds);
              if (!f) return answer;
              answer.measure.outcome = Outcome::kSolved;
              answer.f = *f;
              return answer;
            });
          }};
}

// The linear system of all contacts, whose forces may pull: a unit of time, and no method.
BenchMethod GaussMethod() {
  return {.name = "gauss",
          .reading = "plain loops",
          .arithmetic = "double",
          .counts = "",
          .run = [gauss = PlainGauss()](const BenchProblem& problem) mutable {
            const Stopwatch watch;
            gauss.Solve(problem.rounded.A, problem.rounded.b);
            return Measure{.outcome = Outcome::kUndecided, .seconds = watch.Seconds()};
          }};
}

BenchMethod FastMethod() {
  return {.name = "fast",
          .reading = "",
          .arithmetic = "double",
          .counts = "exchanges",
          .run = [solver = FastSolver<double>()](const BenchProblem& problem) mutable {
            return Timed<double>(problem, [&solver](const auto& data) {
              const FastVerdict verdict = solver.Run(data);
              return BenchAnswer<double>{{.outcome = verdict.outcome, .work = verdict.statistics.exchanges},
                                         solver.f()};
            });
          }};
}

// Of a problem over integers.
QuadraticProgram ProgramOf(const ExactProblem& problem) {
  QuadraticProgram program;
  for (int i = 0; i < problem.rows(); ++i) {
    program.c.push_back(problem.b[i].get_num());
    auto& row = program.M.emplace_back();
    for (int j = 0; j < problem.rows(); ++j) row.push_back(problem.A(i, j).get_num());
  }
  return program;
}

// CGAL's QP_solver, exact, on a problem over integers; without the proof that A is definite.
BenchMethod ExactQuadraticMethod(int one_in) {
  return {.name = "qp",
          .reading = "",
          .arithmetic = "exact",
          .counts = "iterations",
          .one_in = one_in,
          .run = [](const BenchProblem& problem) {
            return Timed<Rational>(problem, [](const auto& data) {
              const QuadraticEnd end = Minimize(ProgramOf(data));
              BenchAnswer<Rational> answer;
              answer.measure.work = end.iterations;
              if (!end.bounded) return answer;
              answer.measure.outcome = Outcome::kSolved;
              answer.f = Eigen::Map<const ExactProblem::Vector>(end.x.data(), data.rows());
              return answer;
            });
          }};
}

}  // namespace

std::vector<BenchMethod> BenchedMethods() {
  return {CompleteMethod<Rational>(),
          PublishedMethod<Rational>("paper"),
          PublishedMethod<Rational>("apex=suspended"),
          PublishedMethod<Rational>("admit=eager,file=yes,apex=suspended"),
          LemkeMethod<Rational>(Cover::kOnes),
          LemkeMethod<Rational>(Cover::kUnits),
          CompleteMethod<double>(),
          IpoptMethod(Formulation::kNonlinear, 10),
          PublishedMethod<double>("paper"),
          LemkeMethod<double>(Cover::kUnits),
          EnumerateMethod()};
}

std::vector<BenchMethod> FrictionlessMethods() {
  return {GaussMethod(), PublishedMethod<double>("paper"),        LemkeMethod<double>(Cover::kUnits),
          FastMethod(),  IpoptMethod(Formulation::kQuadratic, 1), ExactQuadraticMethod(1)};
}

}  // namespace stiction
