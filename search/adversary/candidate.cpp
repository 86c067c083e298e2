// SPDX-License-Identifier: Apache-2.0
#include "search/adversary/candidate.h"

#include <fmt/format.h>

#include <span>

#include "corpus/json_text.h"
#include "corpus/record/problem_file.h"
#include "corpus/record/scene_file.h"
#include "search/campaign.h"
#include "search/generators/scenes.h"

namespace stiction {
namespace {

Surroundings SurroundingsOf(const Candidate& candidate) {
  return {std::span<const MuChoice>(&candidate.mu, 1), candidate.gravity_only};
}

template <class Scalar>
ContactProblem<Scalar> ProblemOf(const Candidate& candidate, std::vector<Choice>* made) {
  Choices choices = Choices::Replay(candidate.choices, made);
  ContactProblem<Scalar> problem;
  Generate<Scalar, Eigen::Dynamic>(candidate.generator, candidate.contacts, SurroundingsOf(candidate), choices,
                                   problem);
  return problem;
}

// The fraction with the smallest denominator in [low, high], by the tree of Stern and Brocot. 0 < low <= high.
Rational SimplestBetween(const Rational& low, const Rational& high) {
  const mpz_class whole = low.get_num() / low.get_den();
  if (low == Rational(whole)) return low;
  if (Rational(whole) + 1 <= high) return Rational(whole) + 1;
  return Rational(whole) + 1 / SimplestBetween(1 / Rational(high - whole), 1 / Rational(low - whole));
}

// `otherwise` where a part is too large.
MuChoice ChoiceOf(const Rational& mu, const MuChoice& otherwise, int most_part) {
  if (mu.get_num() > most_part || mu.get_den() > most_part) return otherwise;
  return {static_cast<int>(mu.get_num().get_si()), static_cast<int>(mu.get_den().get_si())};
}

}  // namespace

Candidate RandomCandidate(const Candidate& like, std::uint64_t seed) {
  Candidate candidate = like;
  std::vector<Choice> made;
  Choices choices(seed, &made);
  ContactProblem<double> problem;
  Generate<double, Eigen::Dynamic>(like.generator, like.contacts, SurroundingsOf(like), choices, problem);
  candidate.choices = ValuesOf(made);
  return candidate;
}

ContactProblem<double> RoundedOf(const Candidate& candidate, std::vector<Choice>* made) {
  return ProblemOf<double>(candidate, made);
}

ExactProblem ExactOf(const Candidate& candidate) { return ProblemOf<Rational>(candidate, nullptr); }

ProblemFile FileOf(const Candidate& candidate, const std::string& name) {
  ProblemFile file;
  file.name = name;
  file.problem = ExactOf(candidate);
  file.origin = ToJson(candidate);
  Choices choices = Choices::Replay(candidate.choices);
  if (auto scene = GenerateScene(candidate.generator, candidate.contacts, SurroundingsOf(candidate), choices)) {
    scene->name = name;
    SceneFile scene_file;
    scene_file.scene = *std::move(scene);
    file.scene = ToJson(scene_file);
  }
  return file;
}

SharedJson ToJson(const Candidate& candidate) {
  return {{"generator", std::string(Row(candidate.generator).name)},
          {"contacts", candidate.contacts},
          {"mu", ToString(Rational(candidate.mu.numerator) / Rational(candidate.mu.denominator))},
          {"gravity_only", candidate.gravity_only},
          {"choices", candidate.choices}};
}

Candidate CandidateFromJson(const JsonPlace& place, std::vector<std::string> beside) {
  beside.insert(beside.begin(), {"generator", "contacts", "mu", "gravity_only", "choices"});
  place.AllowKeys(beside);
  Candidate candidate;
  candidate.generator = ReadGenerator(place.Required("generator", "the name of a generator"));
  candidate.contacts = static_cast<int>(
      place.Required("contacts", "a number of contacts").Integer(1, kMaxContacts, "a number of contacts"));
  candidate.mu = ReadMu(place.Required("mu", "a friction coefficient as a string"));
  const JsonPlace gravity = place.Required("gravity_only", "true or false");
  candidate.gravity_only = gravity.Truth();
  if (candidate.gravity_only && !Row(candidate.generator).has_gravity)
    gravity.Refuse("false, since this generator has no bodies");
  const JsonPlace choices = place.Required("choices", "a list of integers");
  for (std::size_t i = 0; i < choices.Size("a list of integers"); ++i) {
    candidate.choices.push_back(
        choices[i].Integer(-(std::int64_t{1} << 62), std::int64_t{1} << 62, "an integer of at most 62 bits"));
  }
  return candidate;
}

bool HasChoices(const ProblemFile& file) {
  return file.origin && JsonPlace(file.origin, file.name, "").Optional("choices");
}

Candidate CandidateOf(const ProblemFile& file, const std::string& source) {
  if (!HasChoices(file)) {
    throw InputError(fmt::format(
        "{}: origin: found none with choices, expected a problem of an optimized search, as `problem "
        "STORE --best` writes it",
        source));
  }
  return CandidateFromJson(JsonPlace(file.origin, source + ": origin", ""), {"objective"});
}

MuChoice Lowered(const MuChoice& mu, int k, int most_part) {
  if (mu.numerator == 0) return mu;
  const Rational old = Rational(mu.numerator) / Rational(mu.denominator);
  const Rational less = old / Rational(mpz_class(1) << k);
  return ChoiceOf(SimplestBetween(k == 1 ? Rational(old / 4) : Rational(old - 2 * less), old - less), mu,
                  most_part);
}

MuChoice SimplestNear(const Rational& mu, const MuChoice& otherwise, int most_part) {
  if (mu <= 0) return otherwise;
  return ChoiceOf(SimplestBetween(mu * Rational(4095, 4096), mu * Rational(4097, 4096)), otherwise, most_part);
}

}  // namespace stiction
