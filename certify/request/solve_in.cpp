// SPDX-License-Identifier: Apache-2.0
#include "certify/request/solve_in.h"

#include <fmt/format.h>

#include <algorithm>

#include "certify/exact/inexact.h"
#include "certify/request/cascade.h"
#include "corpus/grouped.h"
#include "corpus/record/problem_file.h"

namespace stiction {
namespace {

constexpr int kExactRows = 60, kExactRowsInSpace = 24;  // from which on `auto` solves over doubles

bool IsFloating(Arithmetic arithmetic) {
  return arithmetic == Arithmetic::kFloat || arithmetic == Arithmetic::kDouble ||
         arithmetic == Arithmetic::kQuad;
}

std::vector<std::string_view> ArithmeticsOf(const MethodFacts& facts, int dimension) {
  std::vector<std::string_view> names;
  for (int i = 0; i < kArithmeticCount; ++i) {
    if (facts.IsBuilt(dimension, static_cast<Arithmetic>(i))) names.push_back(kArithmeticNames[i]);
  }
  return names;
}

std::vector<std::string_view> MethodsOf(int dimension, Arithmetic arithmetic) {
  std::vector<std::string_view> names;
  for (const MethodFacts& facts : AllMethods()) {
    if (facts.IsBuilt(dimension, arithmetic)) names.push_back(facts.name);
  }
  return names;
}

}  // namespace

std::optional<Arithmetic> FindArithmetic(std::string_view name) {
  const auto at = std::find(kArithmeticNames.begin(), kArithmeticNames.end(), name);
  if (at == kArithmeticNames.end()) return std::nullopt;
  return static_cast<Arithmetic>(at - kArithmeticNames.begin());
}

std::string Refusal(std::string_view method, int dimension, Arithmetic arithmetic) {
  const bool filtered = arithmetic == Arithmetic::kFiltered && dimension == 2;
  const bool any =
      method == kAutomatic && (IsFloating(arithmetic) || arithmetic == Arithmetic::kExact || filtered);
  const MethodFacts* facts = FindMethodFacts(method);
  if (any || (facts != nullptr && facts->IsBuilt(dimension, arithmetic))) return "";
  const char* where = dimension == 2 ? "the plane" : "space";
  std::string text =
      fmt::format("method {} with arithmetic {} in {}: not built", method, Name(arithmetic), where);
  const auto arithmetics =
      facts == nullptr ? std::vector<std::string_view>() : ArithmeticsOf(*facts, dimension);
  if (!arithmetics.empty()) return text + fmt::format("; expected one of {}", fmt::join(arithmetics, ", "));
  const auto methods = MethodsOf(dimension, arithmetic);
  if (!methods.empty())
    return text +
           fmt::format("; methods with arithmetic {} there: {}", Name(arithmetic), fmt::join(methods, ", "));
  return text + "; expected one of float, double, quad, filtered, exact";
}

ArithmeticChoice UsualArithmetic(std::string_view method, const AnyProblem& problem) {
  using enum Arithmetic;
  const int most = problem.dimension() == 2 ? kExactRows : kExactRowsInSpace;
  if (method == kAutomatic && StaysSparse(problem)) {
    if (problem.factors() != nullptr)
      return {kDouble, Counted(problem.rows(), "row") + " in factors: over doubles, A is not formed"};
    return {kDouble, fmt::format("more than {} rows: over doubles, A sparse", kMostDenseRows)};
  }
  if (method == kAutomatic && problem.rows() > most)
    return {kDouble, fmt::format("{} rows, more than {}: rationals would take long", problem.rows(), most)};
  if (method == "fast") return {kDouble, "the method is made for doubles"};
  if (Refusal(method, problem.dimension(), kExact).empty())
    return {kExact, "nothing is lost, and there are few rows"};
  if (Refusal(method, problem.dimension(), kInterval).empty())
    return {kInterval, "the method takes roots: intervals prove what they decide"};
  return {kDouble, "the method is built for nothing better"};
}

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
