// SPDX-License-Identifier: Apache-2.0
// Method `ipopt`: Ipopt proposes a point, its contact modes are solved exactly. It never decides.
//
// A point f, a = A f + b near a solution tells the modes (modes.h) of the contacts: those whose conditions it
// breaks least. The equations of a word of modes,
//
//   break  fN = fF = 0       touch  aN = 0, fF = -mu u fN      slip+-  aN = 0, fF = -+mu fN
//   hold   aN = 0            stick  aN = aF = 0
//
// are as many as there are unknowns and are solved over rationals. Their solution is returned if it stands
// exact verification of the law; nothing else is. Where the point is near several modes of a contact, or the
// first word fails, other words follow, best first, up to a bound; where they fail, another start of Ipopt.
// So an answer is a solution whatever Ipopt did, and no answer says nothing about the problem.
//
// Ipopt runs in a process of its own (ipopt/stiction_ipopt.cpp): its licence is not ours, it is not
// thread-safe, and it may crash. Protocol: one JSON object per line. It begins with
//
//   {"program": "stiction-ipopt", "protocol": 1}
//
// and answers every line
//
//   {"dimension": 2, "contacts": [{"kind": "static", "mu": 1.0}, {"kind": "sliding", "mu": 1.0, "slip": -1.0},
//    {"kind": "frictionless"}], "A": [[...], ...], "b": [...],
//    "options": {"first_start": 0, "starts": 20, "max_iterations": 200, "seed": 1, "formulation": "nlp"}}
//
// with {"status", "f", "iterations", "starts", "objective", "seconds"}: status `solved` (a start ended at an
// objective of zero, to a tolerance) or `not-solved` (f is the best point; zeros if there is none); or
// {"status": "refused", "reason"}. Starts are numbered; it stops at the first that is solved.
//
// Scale         A and b are divided by their largest entries, exactly, before they become doubles.
// Determinism   Ipopt's iterations depend on the machine's libraries: what is proposed is not part of a unit.
// Source        [Baraff94], 5.1, equations (17), (18); equation (5) without friction.

#ifndef STICTION_CERTIFY_EXACT_FEASIBILITY_NLP_H_
#define STICTION_CERTIFY_EXACT_FEASIBILITY_NLP_H_

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "certify/exact/modes.h"

namespace stiction {

enum class Formulation : std::uint8_t {
  kNonlinear,  // (17), (18) made smooth: every planar problem
  kQuadratic,  // (5): frictionless contacts only
};

struct ProposalOptions {
  Formulation formulation = Formulation::kNonlinear;
  int starts = 20;           // of Ipopt, each from another point; at least 1
  int max_iterations = 200;  // of a start; at least 1
  int words = 64;            // words solved exactly; at least 1
  std::uint64_t seed = 1;    // of the starts
  // A request that takes longer is given up and its process ended: a guard against a hanging library, to be
  // set far above what starts x max_iterations take.
  double patience = 60;

  bool operator==(const ProposalOptions&) const = default;
};

struct ProposalStatistics {
  std::int64_t problems = 0;
  std::int64_t solved = 0;       // with an exactly verified solution
  std::int64_t requests = 0;     // to the process
  std::int64_t starts = 0;       // of Ipopt
  std::int64_t iterations = 0;   // of Ipopt
  std::int64_t words = 0;        // solved exactly
  std::int64_t first_words = 0;  // solutions from the first word of a point
  std::int64_t restarts = 0;     // of the process, after it died or was ended
  std::int64_t timeouts = 0;     // requests given up
  double ipopt_seconds = 0;      // as the process says
  double seconds = 0;            // all

  bool operator==(const ProposalStatistics&) const = default;
};

// visit(name, help, value)
template <class S, class Visit>
requires std::is_same_v<std::remove_const_t<S>, ProposalStatistics>
void ForEachField(S& s, Visit visit) {
  visit("problems", "problems asked for", s.problems);
  visit("solved", "exactly verified solutions", s.solved);
  visit("requests", "requests to the process", s.requests);
  visit("starts", "starts of Ipopt", s.starts);
  visit("iterations", "iterations of Ipopt", s.iterations);
  visit("words", "mode words solved exactly", s.words);
  visit("first_words", "solutions from the first word of a point", s.first_words);
  visit("restarts", "processes started after the first", s.restarts);
  visit("timeouts", "requests given up", s.timeouts);
  visit("ipopt_seconds", "time in Ipopt", s.ipopt_seconds);
  visit("seconds", "time in all", s.seconds);
}

// `stiction-ipopt` beside the running executable, or where a build directory around it, or around the Python
// package, has it, or in bin/ beside the lib/ that this package is installed in. If it is nowhere, the path
// beside the executable.
std::filesystem::path FindIpoptProgram();

class LineProcess;

// Owns one process; one per thread.
class IpoptProposer {
 public:
  // Starts the program. InputError if it cannot be run, or does not speak the protocol.
  explicit IpoptProposer(const std::filesystem::path& program = FindIpoptProgram());
  ~IpoptProposer();
  IpoptProposer(const IpoptProposer&) = delete;
  IpoptProposer& operator=(const IpoptProposer&) = delete;

  // A solution, exactly verified; empty if none was found. Adds to `statistics`. A process that died is started
  // anew and asked again, once per request. InputError: a problem in space; a formulation that does not fit; a
  // friction coefficient beyond the doubles; a program that can no longer be run.
  std::optional<ExactVector> ProposeSolution(const ExactProblem& problem, const ProposalOptions& options,
                                             ProposalStatistics& statistics);

  // The point that Ipopt ends at from its first start, in the units of the problem, as it is; empty if the
  // process gave no answer. InputError as above.
  std::optional<std::vector<double>> ProposePoint(const ExactProblem& problem, const ProposalOptions& options,
                                                  ProposalStatistics& statistics);

  // Of the running process; -1 if it died and has not been started anew.
  int process_id() const;

 private:
  struct Point;

  std::optional<ExactVector> Search(const ExactProblem& problem, const ProposalOptions& options,
                                    ProposalStatistics& statistics);
  std::optional<std::vector<double>> AskForces(const Json& request, int rows, double patience,
                                               ProposalStatistics& statistics);
  std::optional<Point> Ask(const std::string& request, double patience, ProposalStatistics& statistics);
  Point ReadPoint(const std::string& text, ProposalStatistics& statistics) const;

  std::filesystem::path program_;
  std::unique_ptr<LineProcess> process_;  // empty after it died
};

}  // namespace stiction

#endif  // STICTION_CERTIFY_EXACT_FEASIBILITY_NLP_H_
