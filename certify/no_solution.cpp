// SPDX-License-Identifier: Apache-2.0
#include "certify/no_solution.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "certify/certificate.h"
#include "certify/witness.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

using enum Mode;

// gF, yF of a contact, zero where it has no friction row.
Rational FrictionEntry(const Contact<Rational>& contact, int row, const ExactVector& values) {
  return contact.HasFrictionRows() ? values[row + 1] : Rational(0);
}

Rational SlipOf(const Contact<Rational>& contact) {
  return contact.kind == ContactKind::kSliding ? contact.slip[0] : Rational(0);
}

}  // namespace

FarkasVector MakeFarkasVector(const ExactProblem& problem, const ExactVector& y) {
  FarkasVector farkas = {y, ExactVector::Constant(problem.rows(), Rational(0)), 0};
  for (int i = 0; i < problem.rows(); ++i) {
    if (y[i] == 0) continue;
    for (int j = 0; j < problem.rows(); ++j) farkas.g[j] += problem.A(i, j) * y[i];
    farkas.value += problem.b[i] * y[i];
  }
  return farkas;
}

namespace {

// The same in space: of touch and break, of contacts with friction rows.
bool TermIsNonnegativeInSpace(const Contact<Rational>& contact, int row, Mode mode,
                              const FarkasVector& farkas) {
  const ExactVector &y = farkas.y, &g = farkas.g;
  if (y[row + 1] != 0 || y[row + 2] != 0) return false;
  if (mode == kBreak) return y[row] >= 0;
  if (contact.kind == ContactKind::kSliding)
    return g[row] <= contact.mu * (contact.slip[0] * g[row + 1] + contact.slip[1] * g[row + 2]);
  const Rational square = g[row + 1] * g[row + 1] + g[row + 2] * g[row + 2];
  return g[row] <= 0 && contact.mu * contact.mu * square <= g[row] * g[row];
}

}  // namespace

bool TermIsNonnegative(const Contact<Rational>& contact, int row, Mode mode, const FarkasVector& farkas,
                       int dimension) {
  if (dimension == 3 && contact.HasFrictionRows()) return TermIsNonnegativeInSpace(contact, row, mode, farkas);
  const Rational &yN = farkas.y[row], &gN = farkas.g[row];
  const Rational yF = FrictionEntry(contact, row, farkas.y), gF = FrictionEntry(contact, row, farkas.g);
  const Rational along = contact.mu * gF;
  switch (mode) {
    case kHold:
      return gN == 0;
    case kBreak:
      return yN >= 0 && yF == 0;
    case kTouch:
      return gN - SlipOf(contact) * along <= 0 && yF == 0;
    case kStick:
      return gN + abs(along) <= 0;
    case kSlipPlus:
      return gN - along <= 0 && yF >= 0;
    case kSlipMinus:
      return gN + along <= 0 && yF <= 0;
  }
  return false;
}

namespace {

struct Gap {
  std::size_t contact;
  Mode mode;
};

// The first contact and mode whose term can be negative.
std::optional<Gap> FindGap(const ExactProblem& problem, const ModeWord& prefix, const FarkasVector& farkas) {
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    const auto modes = i < prefix.size() ? std::span(&prefix[i], 1) : ModesOf(contact, problem.dimension);
    for (const Mode mode : modes) {
      if (!TermIsNonnegative(contact, row, mode, farkas, problem.dimension)) return Gap{i, mode};
    }
    row += contact.HasFrictionRows() ? problem.dimension : 1;
  }
  return std::nullopt;
}

}  // namespace

bool Refutes(const ExactProblem& problem, const ModeWord& prefix, const FarkasVector& farkas) {
  return farkas.value < 0 && !FindGap(problem, prefix, farkas);
}

std::optional<std::string> FindRefutationGap(const ExactProblem& problem, const ModeWord& prefix,
                                             const FarkasVector& farkas) {
  if (farkas.value >= 0) return "y'b = " + ToString(farkas.value) + ", expected a number < 0";
  const auto gap = FindGap(problem, prefix, farkas);
  if (!gap) return std::nullopt;
  return fmt::format("the term of contact {} can be negative in mode {}", gap->contact + 1, Name(gap->mode));
}

Json NoSolutionCertificate(const ExactProblem& problem, const Enumeration& enumeration) {
  STICTION_CHECK(enumeration.ProvesNoSolution(), "a certificate of no solution needs a complete enumeration");
  Json prefixes = Json::array();
  for (const RefutedPrefix& refuted : enumeration.refuted) {
    prefixes.push_back({{"modes", WordToJson(refuted.modes)}, {"y", VectorToJson(refuted.y)}});
  }
  const Json witness = {{"prefixes", std::move(prefixes)}};
  const auto fault = FindFault(CheckNoSolution, problem, witness);
  STICTION_CHECK(!fault, "a certificate of no solution is none: " + fault->path);
  return MakeCertificate("no-solution", problem, witness);
}

// ---- Checking ----------------------------------------------------------------------------------

namespace {

// No prefix begins another, so their completions are disjoint; then counting them is enough.
void RequireCover(const ExactProblem& problem, const std::vector<ModeWord>& prefixes) {
  const std::string path = "witness.prefixes";
  const std::set<ModeWord> listed(prefixes.begin(), prefixes.end());
  if (listed.size() < prefixes.size()) throw Rejected{path, "a prefix twice", "each once"};
  mpz_class covered = 0;
  for (std::size_t k = 0; k < prefixes.size(); ++k) {
    covered += Completions(problem, prefixes[k].size());
    for (ModeWord shorter = prefixes[k]; !shorter.empty();) {
      shorter.pop_back();
      if (listed.contains(shorter)) {
        throw Rejected{ElementPath(path, k) + ".modes", "an extension of another prefix", "none"};
      }
    }
  }
  const mpz_class words = Completions(problem, 0);
  if (covered != words) throw Rejected{path, covered.get_str() + " words", words.get_str() + ", all of them"};
}

}  // namespace

Json CheckNoSolution(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"prefixes"});
  const Json& listed = witness["prefixes"];
  RequireList(listed, "witness.prefixes");
  std::vector<ModeWord> prefixes;
  const Cost cost = Cost(ProductOperations(problem, static_cast<double>(listed.size()))).LongestRow(problem);
  for (std::size_t k = 0; k < listed.size(); ++k) {
    const std::string path = ElementPath("witness.prefixes", k);
    RequireKeys(listed[k], path, {"modes", "y"});
    prefixes.push_back(ReadPrefix(listed[k]["modes"], path + ".modes", problem));
    const ExactVector y = ReadVector(listed[k]["y"], path + ".y", problem.rows());
    Cost(cost).Vector(y, 2);
    if (const auto gap = FindRefutationGap(problem, prefixes.back(), MakeFarkasVector(problem, y))) {
      throw Rejected{path + ".y", *gap, "a refutation of the prefix"};
    }
  }
  RequireCover(problem, prefixes);
  return {{"words", Completions(problem, 0).get_str()}, {"prefixes", prefixes.size()}};
}

}  // namespace stiction
