// SPDX-License-Identifier: Apache-2.0
#include "bench/family.h"

#include <array>
#include <cstdlib>
#include <vector>

#include "corpus/rounded.h"

namespace stiction {
namespace {

constexpr std::array<MuChoice, 7> kFrictions = {{{0, 1}, {1, 5}, {1, 2}, {1, 1}, {2, 1}, {5, 1}, {10, 1}}};
constexpr int kMixed = kFrictions.size();
constexpr int kEntry = 1000, kFree = 1000000;

Rational ToRational(MuChoice mu) {
  Rational value(mu.numerator, mu.denominator);
  value.canonicalize();
  return value;
}

// A and b; the normals are those rows whose number is a multiple of `rows_per_contact`.
void DrawDefinite(int rows, int rows_per_contact, Choices& choices, ExactProblem& problem) {
  std::vector<std::vector<std::int64_t>> J(rows, std::vector<std::int64_t>(rows));
  for (auto& row : J) {
    for (auto& entry : row) entry = choices.Integer(-kEntry, kEntry);
  }
  problem.A.resize(rows, rows);
  problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < rows; ++j) {
      std::int64_t sum = i == j;
      for (int k = 0; k < rows; ++k) sum += J[i][k] * J[j][k];
      problem.A(i, j) = sum;
    }
    std::int64_t free = choices.Integer(-kFree, kFree);
    if (i % rows_per_contact == 0 && choices.Integer(1, 5) <= 3) free = -std::abs(free);
    problem.b[i] = free;
  }
}

ExactProblem Definite(int contacts, int friction, Choices& choices) {
  ExactProblem problem;
  for (int i = 0; i < contacts; ++i) {
    const std::int64_t pick = friction == kMixed ? choices.Integer(0, kFrictions.size() - 1) : friction;
    problem.contacts.push_back({ContactKind::kStatic, ToRational(kFrictions[pick]), {}});
  }
  DrawDefinite(2 * contacts, 2, choices, problem);
  return problem;
}

ExactProblem Generated(GeneratorId generator, int contacts, int friction, Choices& choices) {
  std::span<const MuChoice> palette(kFrictions);
  if (friction != kMixed) palette = palette.subspan(friction, 1);
  ExactProblem problem;
  Generate<Rational, Eigen::Dynamic>(generator, contacts, palette, choices, problem);
  return problem;
}

}  // namespace

BenchProblem MakeBenchProblem(std::optional<GeneratorId> generator, int contacts, std::uint64_t seed,
                              std::int64_t index) {
  Choices choices(ProblemSeed(seed, contacts, index));
  BenchProblem problem;
  const int friction = static_cast<int>(index % (kMixed + 1));
  problem.exact =
      generator ? Generated(*generator, contacts, friction, choices) : Definite(contacts, friction, choices);
  problem.rounded = Rounded<double>(problem.exact);
  return problem;
}

BenchProblem MakeFrictionless(int contacts, std::uint64_t seed, std::int64_t index) {
  Choices choices(ProblemSeed(seed, contacts, index));
  BenchProblem problem;
  problem.exact.contacts.assign(contacts, {ContactKind::kFrictionless, 0, {}});
  DrawDefinite(contacts, 1, choices, problem.exact);
  problem.rounded = Rounded<double>(problem.exact);
  return problem;
}

}  // namespace stiction
