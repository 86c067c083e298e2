// SPDX-License-Identifier: Apache-2.0
#include "certify/request/solve_in.h"

#include "certify/exact/inexact.h"
#include "certify/request/cascade.h"

namespace stiction {
namespace {

Solution SolvePosed(Posed posed, const Request& request) {
  RequireReading(posed.dimension(), request);
  return request.method == kAutomatic ? SolveInTurn(posed, request) : SolveNamed(posed, request);
}

}  // namespace

Solution SolveIn(const AnyProblem& problem, const Request& request, Stopwatch* watch) {
  return SolvePosed(Posed(problem, watch), request);
}

Solution SolveDoubles(const ContactProblem<double>& problem, const Request& request) {
  return SolvePosed(Posed(problem), request);
}

}  // namespace stiction
