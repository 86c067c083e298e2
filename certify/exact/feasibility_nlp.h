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

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "certify/exact/nearby_words.h"
#include "corpus/json_text.h"
#include "solver/problem/answer.h"

namespace stiction {

// `stiction-ipopt` beside the running executable, or where a build directory around it, or around the Python
// package, has it, or in bin/ beside the lib/ that this package is installed in. If it is nowhere, the path
// beside the executable.
std::filesystem::path FindIpoptProgram();

class LineProcess;

// Owns one process; one per thread.
class IpoptProposer {
 public:
  // Of what is asked from now on.
  int starts = 20;           // of Ipopt, each from another point; at least 1
  int max_iterations = 200;  // of a start; at least 1
  int words = 64;            // near a point, solved exactly; at least 1
  std::uint64_t seed = 1;    // of the starts
  // A request that takes longer, in seconds, is given up and its process ended: a guard against a hanging
  // library, to be set far above what starts x max_iterations take.
  double patience = 60;

  // Starts the program. InputError if it cannot be run, or does not speak the protocol.
  explicit IpoptProposer(const std::filesystem::path& program = FindIpoptProgram());
  ~IpoptProposer();
  IpoptProposer(const IpoptProposer&) = delete;
  IpoptProposer& operator=(const IpoptProposer&) = delete;

  // A solution, exactly verified; undecided if none was found. Counters: starts, iterations, words. A process
  // that died is started anew and asked again, once per request. InputError: a problem in space; a friction
  // coefficient beyond the doubles; a program that can no longer be run.
  Answer<Rational> ProposeSolution(const ExactProblem& problem);

  // Method `qp` over doubles: the point that Ipopt ends at from its first start with equation (5), as it is, in
  // the units of the problem; undecided, since nothing is concluded from its failure, and its point is for the
  // gate to judge (solver/solve.h). Without f where there was no answer. Counter: iterations. InputError as
  // above, and for a contact that is not frictionless.
  Answer<double> ProposePoint(const ExactProblem& problem);

  // Of the running process; -1 if it died and has not been started anew.
  int process_id() const;
  // Time in Ipopt since the beginning, as the process says.
  double ipopt_seconds() const { return ipopt_seconds_; }

 private:
  Json MakeRequest(const ExactProblem& problem, const ScaledProblem& scaled, const char* formulation) const;
  std::optional<std::vector<double>> AskForces(const Json& request, int rows, Counters& counters);
  std::optional<std::vector<double>> Ask(const std::string& request, Counters& counters);
  std::vector<double> ReadPoint(const std::string& text, Counters& counters);

  std::filesystem::path program_;
  std::unique_ptr<LineProcess> process_;  // empty after it died
  double ipopt_seconds_ = 0;
};

}  // namespace stiction
