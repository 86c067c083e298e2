// SPDX-License-Identifier: Apache-2.0
// Candidate: one problem of an optimized search, as the choices that its generator is given.
//
// Any sequence of integers is a problem that meets the paper's hypotheses exactly (choices.h), and where the
// generator makes scenes, one that can be built. So optimizers change integers, and whatever they do is valid.

#pragma once

#include <cstdint>
#include <vector>

#include "corpus/exact_problem.h"
#include "corpus/json_text.h"
#include "search/generators/generators.h"

namespace stiction {

struct ProblemFile;  // corpus/record/problem_file.h

struct Candidate {
  GeneratorId generator = GeneratorId::kScenes;
  int contacts = 2;
  MuChoice mu = {1, 1};  // of all contacts
  bool gravity_only = false;
  std::vector<std::int64_t> choices;

  bool operator==(const Candidate&) const = default;
};

// Of random choices.
Candidate RandomCandidate(const Candidate& like, std::uint64_t seed);
// The problem, and the choices that were made with their ranges: those of the candidate clamped, without what
// was not asked for.
ContactProblem<double> RoundedOf(const Candidate& candidate, std::vector<Choice>* made);
ExactProblem ExactOf(const Candidate& candidate);
// With its scene where it has one, and the candidate as its origin.
ProblemFile FileOf(const Candidate& candidate, const std::string& name);

SharedJson ToJson(const Candidate& candidate);
// InputError; keys that may stand `beside` say nothing of it.
Candidate CandidateFromJson(const JsonPlace& place, std::vector<std::string> beside = {});
// What the origin of a problem file says, if it has choices. InputError if it holds no choices.
bool HasChoices(const ProblemFile& file);
Candidate CandidateOf(const ProblemFile& file, const std::string& source);

// The coefficient with the smallest denominator in [mu (1 - 2^(1-k)), mu (1 - 2^-k)]; for k = 1 from a quarter
// of mu. Zero stays, and what has no room for its parts: numerator and denominator are at most `most_part`.
MuChoice Lowered(const MuChoice& mu, int k, int most_part);
// The simplest coefficient within one part in four thousand of `mu`; `otherwise` if there is none with such
// parts.
MuChoice SimplestNear(const Rational& mu, const MuChoice& otherwise, int most_part);

}  // namespace stiction
