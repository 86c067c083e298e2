// SPDX-License-Identifier: Apache-2.0
#include "certify/request/solve_in.h"

#include "certify/exact/inexact.h"
#include "certify/request/cascade.h"
#include "corpus/stop.h"

namespace stiction {
namespace {

Solution SolvePosed(Posed posed, const Request& request) try {
  RequireReading(posed.dimension(), request);
  const Stop stop(request.limits.stop);
  return request.method == kAutomatic ? SolveInTurn(posed, request) : SolveNamed(posed, request);
} catch (const Stopped&) {
  InexactAnswer none;
  none.method = request.method;
  none.arithmetic = request.arithmetic;
  none.reason = kStopped;
  return {.answer = std::move(none)};
}

}  // namespace

Solution SolveIn(const AnyProblem& problem, const Request& request, Stopwatch* watch) {
  return SolvePosed(Posed(problem, watch), request);
}

Solution SolveDoubles(const ContactProblem<double>& problem, const Request& request) {
  return SolvePosed(Posed(problem), request);
}

}  // namespace stiction
