// SPDX-License-Identifier: Apache-2.0
// bench --suite methods, frictionless: times of every method on the same problems (family.h). bench --suite
// work counts what they do.
//
// Every answer is verified: exact ones by FindViolation, doubles by the gate, both outside the time taken. A
// time is one call of an algorithm that keeps its memory between calls, for any number of contacts, with the
// forces copied out: the less of wall-clock time and processor time, since a busy machine interrupts what takes
// longer than its time slices. Methods take turns at blocks of problems; times are compared problem by problem.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>

#include "bench/family.h"
#include "bench/measure.h"
#include "bench/one_thread.h"
#include "bench/plain_gauss.h"
#include "bench/progress.h"
#include "bench/suite.h"
#include "bench/table.h"
#include "certify/exact/enumerate.h"
#include "certify/exact/exact.h"
#include "certify/exact/feasibility_nlp.h"
#include "certify/exact/linear_system.h"
#include "certify/exact/solve.h"
#include "certify/exact/verify_solution.h"
#include "corpus/exit_code.h"
#include "corpus/json.h"
#include "corpus/stopwatch.h"
#include "solver/lemke/lemke.h"
#include "solver/numeric/fast.h"
#include "solver/problem/lenient.h"
#include "solver/published/published.h"

namespace stiction {
namespace {

constexpr double kWrongAnswer = 1e-6;  // lenient error (solver/problem/lenient.h)

// ---- Methods -------------------------------------------------------------------------------------

struct BenchMethod {
  std::string name, reading, arithmetic;  // policy, cover or formulation
  int one_in = 1;                         // of so many problems it is given one
  int most_contacts = kMostOfAnySuite;
  std::function<Measure(const BenchProblem&)> run;

  std::string Title() const { return name + " " + (reading.empty() ? "" : "(" + reading + ") ") + arithmetic; }
};

template <class Scalar>
constexpr const char* kArithmetic = kIsExact<Scalar> ? "exact" : "double";

const ExactProblem& In(const BenchProblem& problem, const Rational*) { return problem.exact; }
const ContactProblem<double>& In(const BenchProblem& problem, const double*) { return problem.rounded; }

bool Stands(const ExactProblem& problem, const ExactProblem::Vector& f) { return !FindViolation(problem, f); }

bool Stands(const ContactProblem<double>& problem, const ContactProblem<double>::Vector& f) {
  const Eigen::VectorXd a = problem.A * f + problem.b;
  LenientUnits<double> units;
  return MeasureLeniently(problem, FrictionLaw::kCoulomb, f, a, units).error <= kWrongAnswer;
}

// The counter of what another process took, in nanoseconds of it.
constexpr const char* kElsewhere = "nanoseconds elsewhere";

// call(problem) returns an Answer<Scalar>.
template <class Scalar, class Call>
std::function<Measure(const BenchProblem&)> Timed(Call call) {
  return [call](const BenchProblem& problem) mutable {
    const auto& data = In(problem, static_cast<const Scalar*>(nullptr));
    const Stopwatch watch;
    const Answer<Scalar> answer = call(data);
    const double elsewhere = 1e-9 * static_cast<double>(ValueOf(answer.counters, kElsewhere));
    Measure measure{.outcome = answer.outcome, .library_seconds = elsewhere};
    measure.seconds = watch.Seconds() + elsewhere;
    if (answer.outcome == Outcome::kSolved) measure.wrong = !Stands(data, answer.f);
    measure.refutes =
        kIsExact<Scalar> && (answer.outcome == Outcome::kRay || answer.outcome == Outcome::kNoSolution);
    return measure;
  };
}

const auto& ForcesOf(const auto& solver) {
  if constexpr (requires { solver.state().f; }) {
    return solver.state().f;
  } else {
    return solver.f();
  }
}

// An algorithm that keeps its memory between calls.
template <class Scalar, class Solver>
BenchMethod Kept(const std::string& name, const std::string& reading, Solver solver) {
  return {.name = name,
          .reading = reading,
          .arithmetic = kArithmetic<Scalar>,
          .run = Timed<Scalar>([solver](const auto& data) mutable {
            Answer<Scalar> answer;
            answer.outcome = solver.Run(data).outcome;
            answer.f = ForcesOf(solver);
            return answer;
          })};
}

template <class Scalar>
BenchMethod Published(const std::string& policy) {
  return Kept<Scalar>("baraff", policy, PublishedAlgorithm<Scalar>({ParsePolicy(policy), {}, {}}));
}
template <class Scalar>
BenchMethod Complete() {
  return Kept<Scalar>("complete", "", CompleteDriving<Scalar>());
}
template <class Scalar>
BenchMethod Lemke(Cover cover) {
  return Kept<Scalar>("lemke", cover == Cover::kOnes ? "ones" : "units",
                      LemkeAlgorithm<Scalar>({cover, {}, {}}));
}

ExactAnswer Ended(Outcome outcome, ExactProblem::Vector f = {}) {
  ExactAnswer answer;
  answer.outcome = outcome;
  answer.f = std::move(f);
  return answer;
}

BenchMethod Enumerate() {
  return {.name = "enumerate",
          .reading = "",
          .arithmetic = "exact",
          .one_in = 20,
          .most_contacts = 4,
          .run = Timed<Rational>([](const auto& data) {
            EnumerationOptions options;
            options.first_solution_only = true;
            const Enumeration modes = EnumerateModes(data, options);
            if (modes.solutions.empty())
              return Ended(modes.ProvesNoSolution() ? Outcome::kNoSolution : Outcome::kUndecided);
            return Ended(Outcome::kSolved, modes.solutions.front().f);
          })};
}

// The processor time of another process; wall-clock time if it is gone.
clockid_t ClockOf(pid_t process) {
  clockid_t clock;
  return clock_getcpuclockid(process, &clock) == 0 ? clock : CLOCK_MONOTONIC;
}

// Solved: an exact solution came out of one of its points.
BenchMethod Ipopt(Formulation formulation, int one_in) {
  const auto proposer = std::make_shared<IpoptProposer>();
  return {.name = "ipopt",
          .reading = formulation == Formulation::kNonlinear ? "(17), (18)" : "(5)",
          .arithmetic = "exact",
          .one_in = one_in,
          .run = Timed<Rational>([proposer, formulation](const auto& data) {
            ProposalStatistics statistics;
            ProposalOptions options;
            options.formulation = formulation;
            const Stopwatch watch(ClockOf(proposer->process_id()));
            const auto f = proposer->ProposeSolution(data, options, statistics);
            ExactAnswer answer = f ? Ended(Outcome::kSolved, *f) : Ended(Outcome::kUndecided);
            const double seconds = std::min(watch.Seconds(), statistics.ipopt_seconds);
            Add(answer.counters, kElsewhere, std::llround(1e9 * seconds));
            return answer;
          })};
}

// The linear system of all contacts, whose forces may pull: a unit of time, and no method.
BenchMethod Gauss() {
  return {.name = "gauss",
          .reading = "plain loops",
          .arithmetic = "double",
          .run = [gauss = PlainGauss()](const BenchProblem& problem) mutable {
            const Stopwatch watch;
            gauss.Solve(problem.rounded.A, problem.rounded.b);
            return Measure{.seconds = watch.Seconds()};
          }};
}

// CGAL's QP_solver, exact, on a problem over integers; without the proof that A is definite.
BenchMethod ExactQuadratic() {
  return {.name = "qp", .reading = "", .arithmetic = "exact", .run = Timed<Rational>([](const auto& problem) {
                                                                QuadraticProgram program;
                                                                for (int i = 0; i < problem.rows(); ++i) {
                                                                  program.c.push_back(problem.b[i].get_num());
                                                                  auto& row = program.M.emplace_back();
                                                                  for (int j = 0; j < problem.rows(); ++j)
                                                                    row.push_back(problem.A(i, j).get_num());
                                                                }
                                                                const QuadraticEnd end = Minimize(program);
                                                                if (!end.bounded)
                                                                  return Ended(Outcome::kUndecided);
                                                                return Ended(
                                                                    Outcome::kSolved,
                                                                    Eigen::Map<const ExactProblem::Vector>(
                                                                        end.x.data(), problem.rows()));
                                                              })};
}

// The first is the unit of times. Starts Ipopt's process: InputError if it cannot be run.
std::vector<BenchMethod> MethodsWithFriction() {
  return {Complete<double>(),
          Complete<Rational>(),
          Published<Rational>("paper"),
          Published<Rational>("apex=suspended"),
          Published<Rational>("admit=eager,file=yes,apex=suspended"),
          Lemke<Rational>(Cover::kOnes),
          Lemke<Rational>(Cover::kUnits),
          Ipopt(Formulation::kNonlinear, 10),
          Published<double>("paper"),
          Lemke<double>(Cover::kUnits),
          Enumerate()};
}

// Section 4, and beside it elimination of A f = -b, Lemke's method, the fast method, and the quadratic program
// by Ipopt over doubles and by CGAL exactly.
std::vector<BenchMethod> MethodsWithoutFriction() {
  return {Gauss(),
          Published<double>("paper"),
          Lemke<double>(Cover::kUnits),
          Kept<double>("fast", "", FastSolver<double>()),
          Ipopt(Formulation::kQuadratic, 1),
          ExactQuadratic()};
}

// ---- Measuring -----------------------------------------------------------------------------------

// Problems of one size. A method that is given fewer has the first ones.
struct Sample {
  int contacts = 0;
  std::vector<std::vector<Measure>> measures;  // by method, problem
};

// make(index) returns a BenchProblem. What cannot be true is added to `mismatches`.
template <class Make>
Sample Measured(std::vector<BenchMethod>& methods, int contacts, std::int64_t problems, Make make,
                std::vector<std::string>& mismatches) {
  constexpr int kBlock = 64;  // problems, before the next method has its turn
  progress::Begin(fmt::format("runs at {} contacts", contacts), std::ssize(methods) * problems);
  Sample sample{contacts, {}};
  sample.measures.resize(methods.size());
  for (std::int64_t first = 0; first < problems; first += kBlock) {
    const std::int64_t end = std::min(problems, first + kBlock);
    std::vector<BenchProblem> block;
    for (std::int64_t i = first; i < end; ++i) block.push_back(make(i));
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const BenchMethod& method = methods[m];
      const std::int64_t part = (problems + method.one_in - 1) / method.one_in;
      const std::int64_t last = contacts > method.most_contacts ? 0 : std::min(end, part);
      for (std::int64_t i = first; i < last; ++i)
        sample.measures[m].push_back(method.run(block[static_cast<std::size_t>(i - first)]));
      progress::Done(end - first);
    }
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(problems); ++i) {
    std::vector<NamedMeasure> of_problem;
    for (std::size_t m = 0; m < methods.size(); ++m) {
      if (i < sample.measures[m].size())
        of_problem.push_back({methods[m].Title(), methods[m].arithmetic == "exact", sample.measures[m][i]});
    }
    if (const auto mismatch = FindMismatch(of_problem))
      mismatches.push_back(fmt::format("{} contacts, problem {}: {}", contacts, i, *mismatch));
  }
  progress::Clear();
  return sample;
}

// ---- Tables --------------------------------------------------------------------------------------

Json Cell(const Quartiles& q) { return {q.low, q.median, q.high}; }

std::int64_t SolvedOf(const std::vector<Measure>& measures) {
  return std::count_if(measures.begin(), measures.end(), [](const Measure& m) { return m.Solved(); });
}

Quartiles Microseconds(const std::vector<Measure>& measures, double Measure::*seconds = &Measure::seconds) {
  std::vector<double> values;
  for (const Measure& m : measures) values.push_back(1e6 * m.*seconds);
  return QuartilesOf(values);
}

// Ratios of the seconds of problems that both were given.
Quartiles RatioOf(const std::vector<Measure>& left, const std::vector<Measure>& right,
                  double Measure::*seconds = &Measure::seconds) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i)
    ratios.push_back(left[i].*seconds / right[i].seconds);
  return QuartilesOf(ratios);
}

BenchTable TimeTable(const std::vector<BenchMethod>& methods, const std::vector<Sample>& samples) {
  BenchTable table{"times",
                   "microseconds a problem, and times that of complete driving over doubles: quartiles"};
  for (const Sample& sample : samples) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const std::vector<Measure>& measures = sample.measures[m];
      if (measures.empty()) continue;
      table.rows.push_back(
          {{"contacts", sample.contacts},
           {"method", methods[m].name},
           {"reading", methods[m].reading},
           {"arithmetic", methods[m].arithmetic},
           {"problems", measures.size()},
           {"solved", SolvedOf(measures)},
           {"wrong", std::count_if(measures.begin(), measures.end(), std::mem_fn(&Measure::wrong))},
           {"us", Cell(Microseconds(measures))},
           {"ratio", Cell(RatioOf(measures, sample.measures[0]))}});
    }
  }
  return table;
}

BenchTable FrictionlessTable(const std::vector<Sample>& samples) {
  BenchTable table{
      "frictionless",
      "without friction, microseconds: plain Gauss on A f = -b, section 4, Lemke, fast, inside Ipopt "
      "program (5), and the program exactly by CGAL (qp)"};
  for (const Sample& sample : samples) {
    const auto& gauss = sample.measures[0];
    const auto& baraff = sample.measures[1];
    const auto& lemke = sample.measures[2];
    const auto& fast = sample.measures[3];
    const auto& program = sample.measures[4];
    const auto& exact = sample.measures[5];
    table.rows.push_back({{"contacts", sample.contacts},
                          {"problems", baraff.size()},
                          {"baraff solved", SolvedOf(baraff)},
                          {"lemke solved", SolvedOf(lemke)},
                          {"fast solved", SolvedOf(fast)},
                          {"ipopt solved", SolvedOf(program)},
                          {"qp solved", SolvedOf(exact)},
                          {"gauss us", Cell(Microseconds(gauss))},
                          {"baraff us", Cell(Microseconds(baraff))},
                          {"baraff/gauss", Cell(RatioOf(baraff, gauss))},
                          {"lemke/baraff", Cell(RatioOf(lemke, baraff))},
                          {"fast/baraff", Cell(RatioOf(fast, baraff))},
                          {"ipopt us", Cell(Microseconds(program, &Measure::library_seconds))},
                          {"ipopt/baraff", Cell(RatioOf(program, baraff, &Measure::library_seconds))},
                          {"qp us", Cell(Microseconds(exact))},
                          {"qp/baraff", Cell(RatioOf(exact, baraff))}});
  }
  return table;
}

int Report(const BenchOptions& options, const BenchTable& table, const std::vector<std::string>& mismatches) {
  if (options.json) {
    std::cout << JsonText({{"suite", options.suite},
                           {"seed", options.seed},
                           {"generator", options.generator ? Row(*options.generator).name : "definite"},
                           {"one_thread", ThreadsJson()},
                           {table.name, table.rows},
                           {"mismatches", mismatches}})
              << "\n";
  } else {
    fmt::print("{}\n", ThreadsText());
    Print(table);
    fmt::print("\n{} mismatches\n", mismatches.size());
    for (const std::string& mismatch : mismatches) fmt::print("{}\n", mismatch);
  }
  return mismatches.empty() ? kExitDone : kExitNotSo;
}

}  // namespace

int BenchMethods(const BenchOptions& options) {
  const std::int64_t problems = options.problems.value_or(800);
  const std::vector<int> contacts =
      options.contacts.empty() ? std::vector<int>{2, 3, 4, 5, 6} : options.contacts;
  progress::Expect(contacts.size());
  std::vector<BenchMethod> methods = MethodsWithFriction();
  std::vector<Sample> samples;
  std::vector<std::string> mismatches;
  for (const int n : contacts) {
    const auto make = [&](std::int64_t index) {
      return MakeBenchProblem(options.generator, n, options.seed, index);
    };
    samples.push_back(Measured(methods, n, problems, make, mismatches));
  }
  return Report(options, TimeTable(methods, samples), mismatches);
}

int BenchFrictionless(const BenchOptions& options) {
  const std::vector<int> sizes =
      options.contacts.empty() ? std::vector<int>{3, 6, 12, 25, 50, 100, 150} : options.contacts;
  progress::Expect(sizes.size());
  std::vector<BenchMethod> methods = MethodsWithoutFriction();
  std::vector<Sample> samples;
  std::vector<std::string> mismatches;
  for (const int n : sizes) {
    // Exact arithmetic makes many contacts slow to solve and to verify.
    const std::int64_t most = n <= 12 ? 48 : n <= 25 ? 24 : n <= 50 ? 8 : 4;
    samples.push_back(Measured(
        methods, n, std::min(options.problems.value_or(48), most),
        [&](std::int64_t index) { return MakeFrictionless(n, options.seed, index); }, mismatches));
  }
  return Report(options, FrictionlessTable(samples), mismatches);
}

}  // namespace stiction
