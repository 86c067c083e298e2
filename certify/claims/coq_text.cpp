// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/coq_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "certify/claims/by_factors.h"
#include "certify/claims/witness.h"
#include "corpus/input_error.h"
#include "corpus/json.h"
#include "corpus/record/digest.h"
#include "solver/problem/options.h"

namespace stiction {
namespace {

// ---- Numbers, vectors, contacts ----

// 7, -2 or 3 # 5: as Coq reads them between the semicolons of a list.
std::string Number(const Rational& x) {
  std::string text = ToString(x);
  const std::size_t bar = text.find('/');
  return bar == std::string::npos ? text : text.replace(bar, 1, " # ");
}

std::string Number(const Json& x) { return Number(ReadNumber(x, "$")); }

// As an argument.
std::string Grouped(const Rational& x) {
  const std::string text = Number(x);
  return text.find(' ') == std::string::npos ? text : "(" + text + ")";
}

template <class Items, class Text>
std::string List(const Items& items, Text text, std::string_view between = "; ") {
  std::string list;
  for (const auto& item : items) list += (list.empty() ? "" : std::string(between)) + text(item);
  return "[" + list + "]";
}

constexpr std::string_view kNextRow = ";\n     ";

std::string Vector(const Json& x) {
  return List(x, [](const Json& number) { return Number(number); });
}
std::string Matrix(const Json& rows) { return List(rows, Vector, kNextRow); }

std::string Vector(const ExactProblem::Vector& x) {
  return List(std::span(x.data(), x.size()), [](const Rational& number) { return Number(number); });
}

std::string MatrixOf(const ExactProblem& problem) {
  std::vector<ExactProblem::Vector> rows;
  for (int i = 0; i < problem.rows(); ++i) rows.emplace_back(problem.A.row(i).transpose());
  return List(
      rows, [](const ExactProblem::Vector& row) { return Vector(row); }, kNextRow);
}

std::string ContactText(const Contact<Rational>& contact, int dimension) {
  switch (contact.kind) {
    case ContactKind::kBilateral:
      return "Bilateral";
    case ContactKind::kFrictionless:
      return "Frictionless";
    case ContactKind::kStatic:
      return "Static " + Grouped(contact.mu);
    case ContactKind::kSliding: {
      const auto slip = std::span(contact.slip).first(dimension - 1);
      return fmt::format("Sliding {} {}", Grouped(contact.mu),
                         List(slip, [](const Rational& x) { return Number(x); }));
    }
  }
  return {};
}

// ---- Claims about A, b and forces: certify/coq/claims ----

std::string Prefix(const Json& prefix) {
  static const std::map<std::string, std::string> kModes = {{"hold", "Hold"},      {"break", "Break"},
                                                            {"touch", "Touch"},    {"stick", "Stick"},
                                                            {"slip+", "SlipPlus"}, {"slip-", "SlipMinus"}};
  const auto mode = [](const Json& name) { return kModes.at(name.get<std::string>()); };
  return fmt::format("({}, {})", List(prefix["modes"], mode), Vector(prefix["y"]));
}

std::string Forces(const Json& witness) {
  return fmt::format("Definition forces : list Q := {}.\n", Vector(witness["f"]));
}
std::string ForcesUpToBound(const Json& witness) {
  return Forces(witness) + fmt::format("Definition bound : Q := {}.\n", Number(witness["bound"]));
}
std::string Factors(const Json& witness) {
  return fmt::format("(* A = L D L' *)\nDefinition L : list (list Q) := {}.\nDefinition D : list Q := {}.\n",
                     Matrix(witness["L"]), Vector(witness["D"]));
}
std::string Dual(const Json& witness) {
  return fmt::format("(* b - A'y is in the dual of the friction cones *)\nDefinition y : list Q := {}.\n",
                     Vector(witness["y"]));
}
std::string Refutation(const Json& witness) {
  return fmt::format(
      "(* modes of the first contacts, and a y that no forces in these modes survive: every word begins so *)\n"
      "Definition prefixes : list (list mode * list Q) :=\n    {}.\n",
      List(witness["prefixes"], Prefix, kNextRow));
}

struct CoqClaim {
  std::string_view name, statement, theorem, arguments;
  std::string (*witness)(const Json&);
  std::string_view words;
};

constexpr std::array<CoqClaim, 5> kClaimsOfForces = {
    {{"solution-exists", "solution_exists", "solution_holds", "forces", Forces,
      "there are forces that obey the law"},
     {"coulomb-solution", "coulomb_solution_exists bound", "coulomb_solution_holds", "bound forces",
      ForcesUpToBound, "there are forces that obey Coulomb's law up to the bound"},
     {"no-solution", "no_solution", "no_solution_holds", "prefixes", Refutation, "no forces obey the law"},
     {"psd", "positive_semidefinite", "psd_holds", "L D", Factors, "A is symmetric and positive semidefinite"},
     {"h", "hypothesis_H", "H_holds", "y", Dual,
      "(H): b.v >= 0 for every v in the friction cones with A v = 0"}}};

constexpr std::string_view kCounterexample = "counterexample";

std::string Head(const ExactProblem& problem, const std::string& words, std::string_view imports) {
  return fmt::format(
      "(* SPDX-License-Identifier: Apache-2.0 *)\n"
      "(* Written by `stiction certify --coq`. It proves: {}.\n"
      "   Problem {} *)\n"
      "From Coq Require Import QArith List.\n{}Import ListNotations.\nLocal Open Scope Q_scope.\n\n",
      words, ProblemDigest(problem), imports);
}

std::string TextOfForces(const CoqClaim& claim, const Json& witness, const ExactProblem& problem) {
  const auto contact = [&problem](const Contact<Rational>& c) { return ContactText(c, problem.dimension); };
  return Head(problem, std::string(claim.words), "From Stiction.claims Require Import Statement Claims.\n") +
         fmt::format(
             "(* dimension, contacts, A, b *)\nDefinition the_problem : problem := Problem {}\n    {}\n    {}\n"
             "    {}.\n\n{}\n"
             "Theorem the_claim : {} the_problem.\n"
             "Proof. apply (@{} the_problem {}). vm_cast_no_check (eq_refl true). Qed.\n"
             "Print Assumptions the_claim.\n",
             problem.dimension, List(problem.contacts, contact), MatrixOf(problem), Vector(problem.b),
             claim.witness(witness), claim.statement, claim.theorem, claim.arguments);
}

// ---- Loops of the published algorithm in the plane: certify/coq/loops ----

// The values of the planar switches, in the order of PolicySwitches().
std::string PolicyText(const Policy& policy) {
  static const std::vector<std::vector<std::string_view>> kValues = {
      {"lowest", "normals_first", "most_violated", "highest"},
      {"restart", "round"},
      {"lazy", "eager"},
      {"unfiled", "filed_at_scan"},
      {"first", "previous", "second"},
      {"drop_contact", "drop_variable"},
      {"rescan", "continue"},
      {"by_sets", "by_contacts"},
      {"kept", "suspended_at_apex"}};
  std::string text = "Policy";
  for (std::size_t k = 0; k < kValues.size(); ++k)
    text += fmt::format(" {}", kValues[k].at(PolicySwitches()[k].get(policy)));
  return text;
}

using StartAndPeriod = std::pair<std::int64_t, std::int64_t>;

// (policy, its start and period) in the order of the grid.
std::vector<std::pair<Policy, StartAndPeriod>> CyclesOf(const Json& witness) {
  std::map<std::string, StartAndPeriod> cycles;
  for (const Json& run : witness["runs"]) {
    const StartAndPeriod at = {run["start"].get<std::int64_t>(), run["period"].get<std::int64_t>()};
    for (const Json& policy : run["policies"]) cycles[policy.get<std::string>()] = at;
  }
  std::vector<std::pair<Policy, StartAndPeriod>> listed;
  for (const Policy& policy : PlanarGrid()) {
    const auto found = cycles.find(PolicyName(policy));
    if (found != cycles.end()) listed.emplace_back(policy, found->second);
  }
  return listed;
}

// As (k, (start, period)) for k in a row, seven in a line.
std::string Table(const std::vector<std::pair<Policy, StartAndPeriod>>& cycles) {
  std::string text;
  int groups = 0;
  for (auto first = cycles.begin(); first != cycles.end(); ++groups) {
    const auto last =
        std::find_if(first, cycles.end(), [&](const auto& cycle) { return cycle.second != first->second; });
    const std::string_view between = groups == 0 ? "  " : groups % 7 == 0 ? ";\n  " : "; ";
    text += fmt::format("{}({}, ({}, {}))", between, last - first, first->second.first, first->second.second);
    first = last;
  }
  return text;
}

// How many policies have each start and period, the most frequent first.
std::string Counts(const std::vector<std::pair<Policy, StartAndPeriod>>& cycles) {
  std::map<StartAndPeriod, int> counts;
  for (const auto& cycle : cycles) ++counts[cycle.second];
  std::vector<std::pair<StartAndPeriod, int>> sorted(counts.begin(), counts.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& x, const auto& y) { return x.second > y.second; });
  std::string text;
  for (const auto& [at, count] : sorted)
    text += fmt::format(" /\\\n  count {} {} = {}%nat", at.first, at.second, count);
  return text;
}

std::string TextOfLoops(const Json& witness, const ExactProblem& problem) {
  const auto cycles = CyclesOf(witness);
  const bool every = cycles.size() == PlanarGrid().size();
  const std::string_view policies = every ? "all_policies" : "policies";
  std::string text =
      Head(problem,
           "the published algorithm never ends under these policies, nor ever\n"
           "   stands at a solution, though A is symmetric positive definite, and there is a solution",
           "From Stiction.loops Require Import Statement Loop Counterexample.\n");
  text += fmt::format("Definition the_problem : problem rationals := Problem\n    {}\n    {}\n    {}.\n\n{}\n",
                      MatrixOf(problem), Vector(problem.b),
                      List(problem.contacts, [](const Contact<Rational>& c) { return Number(c.mu); }),
                      Factors(witness) + "\n(* a solution *)\n" + Forces(witness));
  if (!every) {
    text += fmt::format("Definition policies : list policy :=\n    {}.\n\n",
                        List(
                            cycles, [](const auto& cycle) { return PolicyText(cycle.first); }, kNextRow));
  }
  text += fmt::format(
      "(* (k, (start, period)) for k policies in a row, in the order of {0} *)\n"
      "Definition table : list (nat * nat) := expand [\n{1}]%nat.\n\n"
      "Lemma checked : check_counterexample the_problem L D forces {0} table = true.\n"
      "Proof. vm_cast_no_check (eq_refl true). Qed.\n\n"
      "Theorem counterexample : {2} {3} the_problem.\n"
      "Proof. exact ({4} _ _ _ _ {5}_ checked). Qed.\n\n"
      "(* The first state at the top of the main loop that recurs, and after how many drives. *)\n"
      "Theorem starts_and_periods : forall pol s period, In (pol, (s, period)) (combine {0} table) ->\n"
      "  cycles the_problem pol s period.\n"
      "Proof. exact (policies_cycle _ _ _ _ _ _ checked). Qed.\n\n"
      "Definition count s period := length (filter (fun x => Nat.eqb (fst x) s && Nat.eqb (snd x) period) "
      "table).\n"
      "Theorem counts : length table = {6}%nat{7}.\n"
      "Proof. repeat split; vm_compute; reflexivity. Qed.\n"
      "Print Assumptions counterexample.\n",
      policies, Table(cycles), every ? "loops_under_every_policy" : "loops_under_policies policies",
      problem.rows(), every ? "every_policy_loops" : "policies_loop", every ? "" : "_ ", cycles.size(),
      Counts(cycles));
  return text;
}

}  // namespace

std::vector<std::string> ClaimsForCoq() {
  std::vector<std::string> names;
  for (const CoqClaim& claim : kClaimsOfForces) names.emplace_back(claim.name);
  names.emplace_back(kCounterexample);
  return names;
}

std::string CoqText(const Json& certificate, const ExactProblem& problem, const std::string& source) {
  const std::string name = certificate["claim"].get<std::string>();
  const Json& witness = certificate["witness"];
  if (HasFactors(witness)) throw InputError(source, "factors", "a witness of factors", "none (--coq)");
  if (name == kCounterexample) {
    for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
      if (problem.contacts[i].kind != ContactKind::kStatic)
        throw InputError(source, fmt::format("contacts[{}].kind", i),
                         std::string(Name(problem.contacts[i].kind)),
                         "static: the algorithm that Coq has knows no other (--coq)");
    }
    return TextOfLoops(witness, problem);
  }
  for (const CoqClaim& claim : kClaimsOfForces)
    if (claim.name == name) return TextOfForces(claim, witness, problem);
  throw InputError(fmt::format("{}: found a certificate of the claim {}, expected with --coq one of {}", source,
                               name, fmt::join(ClaimsForCoq(), ", ")));
}

}  // namespace stiction
