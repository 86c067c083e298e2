// SPDX-License-Identifier: Apache-2.0
#include "search/units/minimize.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "certify/exact/exact.h"
#include "certify/exact/properties.h"
#include "certify/exact/published_space.h"
#include "corpus/input_error.h"
#include "search/generators/choices.h"
#include "search/generators/rounding.h"
#include "search/units/signature.h"
#include "solver/problem/reduction.h"

namespace stiction {
namespace {

// Calls visit(x) for every number of the problem, entries of A on and above the diagonal once.
template <class Visit>
void ForEachNumber(const ExactProblem& problem, Visit visit) {
  for (int i = 0; i < problem.rows(); ++i) {
    for (int j = i; j < problem.rows(); ++j) visit(problem.A(i, j));
    visit(problem.b[i]);
  }
}

// The problem of the rows that are kept.
ExactProblem Restrict(const ExactProblem& problem, std::vector<Contact<Rational>> contacts,
                      const std::vector<int>& rows) {
  return {problem.dimension, std::move(contacts), problem.A(rows, rows), problem.b(rows)};
}

ExactProblem WithoutContact(const ExactProblem& problem, int dropped) {
  std::vector<Contact<Rational>> contacts;
  std::vector<int> rows;
  ForEachContact(problem, [&](int contact, int row, int size) {
    if (contact == dropped) return;
    contacts.push_back(problem.contacts[contact]);
    for (int k = 0; k < size; ++k) rows.push_back(row + k);
  });
  return Restrict(problem, std::move(contacts), rows);
}

// What bilateral contacts leave of the problem (4.5): the same run, without them. Sliding contacts stay.
std::optional<ExactProblem> WithoutBilateral(const ExactProblem& problem) {
  ExactProblem unsliding = problem;
  std::vector<Contact<Rational>> kept;
  for (auto& contact : unsliding.contacts) {
    if (contact.kind != ContactKind::kBilateral) kept.push_back(contact);
    if (contact.kind == ContactKind::kSliding) contact.kind = ContactKind::kStatic;  // of as many rows
  }
  if (kept.size() == problem.contacts.size()) return std::nullopt;
  const Reduction<Rational> reduction(unsliding);
  if (reduction.end() != ReductionEnd::kReduced) return std::nullopt;
  ExactProblem remaining = reduction.problem();
  remaining.contacts = std::move(kept);
  return remaining;
}

std::optional<ExactProblem> WithoutFriction(const ExactProblem& problem, int contact) {
  if (!problem.contacts[contact].HasFrictionRows()) return std::nullopt;
  std::vector<Contact<Rational>> contacts = problem.contacts;
  contacts[contact] = {ContactKind::kFrictionless, 0, {}};
  std::vector<int> rows;
  int row = 0;
  for (int k = 0; k < static_cast<int>(problem.contacts.size()); ++k) {
    rows.push_back(row++);
    if (!problem.contacts[k].HasFrictionRows()) continue;
    for (int t = 1; t < problem.dimension; ++t, ++row) {
      if (k != contact) rows.push_back(row);
    }
  }
  return Restrict(problem, std::move(contacts), rows);
}

// Largest entries to round to.
// clang-format off
constexpr std::int64_t kRoundSizes[] = {
    2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20, 24, 32, 48, 64, 100, 200, 500, 1000, 10000, 1000000, 1000000000,
    1000000000000, 1000000000000000};
// clang-format on

// A few seconds for three contacts, much less for two.
constexpr int kMostRowsOfGlobalPasses = 6;
constexpr int kAttemptsOfSize = 300;

class Minimizer {
 public:
  Minimizer(const ExactProblem& problem, const MinimizeOptions& options)
      : options_(options), result_{problem, 0, 0, false}, simplicity_(SimplicityOf(problem)) {}

  Minimized Run() {
    if (!options_.keeps) {
      if (const auto lack = Lacks(result_.problem)) throw InputError("minimize: " + *lack);
    }
    bool progress = true;
    while (progress && !Cancelled()) {
      progress = Try(WithoutBilateral(result_.problem));
      progress |= DropContacts();
      progress |= ChangeContacts(WithoutFriction);
      progress |= ChangeContacts(Stretched);
      progress |= RoundAll();
      progress |= RoundFactors();
      progress |= DivideCommonFactors();
      progress |= SimplifyEntries();
      progress |= SimplifyCoefficients();
      if (!progress && options_.further) progress = RoundAtRandom() || ChangePairs();
    }
    return std::move(result_);
  }

 private:
  // What keeps a candidate from being interesting; empty if it is. Cheapest tests first.
  std::optional<std::string> Lacks(const ExactProblem& candidate) const {
    if (!IsSymmetric(candidate)) return "A is not symmetric";
    if (!IsPositiveSemidefinite(candidate)) return "A is not positive semidefinite";
    if (!IsInRange(candidate)) return "b is not in range(A)";
    const Policy& first = options_.policies.front();
    if (candidate.dimension == 3) return LacksInSpace(candidate);
    const ExactRun run = RunExact(candidate, {.policy = first, .limits = options_.limits});
    if (run.verdict.outcome != options_.keep) {
      return EndsElsewhere(first, run.verdict.outcome);
    }
    if (options_.signature && Signature(candidate, run) != *options_.signature)
      return "it has another signature";
    if (options_.policies.size() > 1 &&
        !AllEndIn(options_.keep, candidate, options_.policies, options_.limits)) {
      return fmt::format("not every policy asked for ends in {}", Name(options_.keep));
    }
    return std::nullopt;
  }

  std::optional<std::string> LacksInSpace(const ExactProblem& candidate) const {
    for (const Policy& policy : options_.policies) {
      const InexactAnswer answer =
          RunIntervalsInSpace(candidate, {.policy = policy, .limits = options_.limits});
      if (answer.outcome != options_.keep) return EndsElsewhere(policy, answer.outcome);
      if (options_.period && answer.period != *options_.period) return "it has another period";
    }
    return std::nullopt;
  }

  std::string EndsElsewhere(const Policy& policy, Outcome outcome) const {
    return fmt::format("under {} it ends in {}, not in {}", PolicyName(policy), Name(outcome),
                       Name(options_.keep));
  }

  bool Cancelled() {
    result_.cancelled = result_.cancelled || options_.cancelled();
    return result_.cancelled;
  }

  // Takes the candidate if it is simpler and interesting.
  bool Try(const ExactProblem& candidate) {
    if (Cancelled()) return false;
    const Simplicity simplicity = SimplicityOf(candidate);
    if (!(simplicity < simplicity_)) return false;
    ++result_.candidates;
    if (options_.keeps ? !options_.keeps(candidate) : Lacks(candidate).has_value()) return false;
    ++result_.accepted;
    result_.problem = candidate;
    simplicity_ = simplicity;
    return true;
  }
  bool Try(const std::optional<ExactProblem>& candidate) { return candidate && Try(*candidate); }

  int ContactCount() const { return static_cast<int>(result_.problem.contacts.size()); }

  bool DropContacts() {
    bool progress = false;
    for (int contact = ContactCount() - 1; contact >= 0; --contact) {
      progress |= Try(WithoutContact(result_.problem, contact));
    }
    return progress;
  }

  template <class Change>
  bool ChangeContacts(Change change) {
    bool progress = false;
    for (int contact = 0; contact < ContactCount(); ++contact)
      progress |= Try(change(result_.problem, contact));
    return progress;
  }

  std::array<ExactProblem, 3> InSeveralUnits() const {
    return {Stretched(result_.problem, -1), Equilibrated(result_.problem), result_.problem};
  }

  // Small integers at once, in several units and with a ridge that makes A definite. The first size that works
  // is taken.
  bool RoundAll() {
    const std::array<ExactProblem, 3> bases = InSeveralUnits();
    const std::array<Ridge, 6> ridges = {
        {{0, 0}, {1, 0}, {0, Rational(1, 64)}, {0, Rational(1, 16)}, {0, Rational(1, 4)}, {1, Rational(1, 4)}}};
    for (const std::int64_t size : kRoundSizes) {
      for (const ExactProblem& base : bases) {
        for (const Ridge& ridge : ridges) {
          for (const std::int64_t size_b : {std::max<std::int64_t>(2, size / 2), size}) {
            if (Try(RoundedTo(base, size, size_b, ridge))) return true;
          }
        }
      }
    }
    return false;
  }

  bool RoundFactors() {
    const std::array<ExactProblem, 3> bases = InSeveralUnits();
    for (int bits = 1; bits <= 24; ++bits) {
      for (const ExactProblem& base : bases) {
        if (Try(WithRoundedFactors(base, bits))) return true;
      }
    }
    return false;
  }

  bool DivideCommonFactors() {
    const bool progress = Try(WithoutCommonFactors(result_.problem).first);
    return Try(WithoutCommonFactors(result_.problem).second) || progress;
  }

  // Entries (i, j) of A with their mirrors; j = rows stands for b_i.
  std::vector<std::pair<int, int>> Places() const {
    const int rows = result_.problem.rows();
    std::vector<std::pair<int, int>> places;
    for (int i = 0; i < rows; ++i) {
      for (int j = i; j <= rows; ++j) places.emplace_back(i, j);
    }
    return places;
  }

  bool SimplifyEntries() {
    bool progress = false;
    for (const auto& place : Places()) progress |= SimplifyEntry(place);
    return progress;
  }

  bool SimplifyEntry(const std::pair<int, int>& place) {
    const bool positive = place.first == place.second;
    for (const Rational& number : SimplerNumbers(EntryAt(result_.problem, place), positive)) {
      ExactProblem candidate = result_.problem;
      SetEntryAt(candidate, place, number);
      if (Try(candidate)) return true;
    }
    return false;
  }

  // Further than one change at a time goes: small integers near the problem in several units, each entry
  // rounded up or down by lot. The same lots every time, so that what is left after this pass is left by it
  // again.
  bool RoundAtRandom() {
    if (result_.problem.rows() > kMostRowsOfGlobalPasses) return false;
    const std::array<ExactProblem, 3> bases = InSeveralUnits();
    for (int size = 2; size <= 12; ++size) {
      for (int attempt = 0; attempt < kAttemptsOfSize && !Cancelled(); ++attempt) {
        Choices lots(ProblemSeed(1994, static_cast<std::uint64_t>(size), static_cast<std::uint64_t>(attempt)));
        const ExactProblem& base = bases[static_cast<std::size_t>(attempt) % bases.size()];
        if (Try(RoundedByLot(base, size, lots))) return true;
      }
    }
    return false;
  }

  // Two entries at once, each one more, one less, zero, or turned.
  bool ChangePairs() {
    if (result_.problem.rows() > kMostRowsOfGlobalPasses) return false;
    const std::vector<std::pair<int, int>> places = Places();
    for (std::size_t p = 0; p < places.size(); ++p) {
      for (std::size_t q = 0; q < p && !Cancelled(); ++q) {
        for (const Rational& first : Neighbours(EntryAt(result_.problem, places[p]))) {
          for (const Rational& second : Neighbours(EntryAt(result_.problem, places[q]))) {
            ExactProblem candidate = result_.problem;
            SetEntryAt(candidate, places[p], first);
            SetEntryAt(candidate, places[q], second);
            if (Try(candidate)) return true;
          }
        }
      }
    }
    return false;
  }

  static Rational EntryAt(const ExactProblem& problem, const std::pair<int, int>& place) {
    const auto [i, j] = place;
    return j == problem.rows() ? problem.b[i] : problem.A(i, j);
  }
  static void SetEntryAt(ExactProblem& problem, const std::pair<int, int>& place, const Rational& value) {
    const auto [i, j] = place;
    if (j == problem.rows()) {
      problem.b[i] = value;
    } else {
      problem.A(i, j) = problem.A(j, i) = value;
    }
  }
  static std::array<Rational, 4> Neighbours(const Rational& x) {
    return {Rational(0), Rational(x - 1), Rational(x + 1), Rational(-x)};
  }

  bool SimplifyCoefficients() {
    bool progress = false;
    for (int contact = 0; contact < ContactCount(); ++contact) {
      if (!result_.problem.contacts[contact].HasFrictionRows()) continue;
      for (const Rational& number : SimplerNumbers(result_.problem.contacts[contact].mu, true)) {
        ExactProblem candidate = result_.problem;
        candidate.contacts[contact].mu = number;
        if (!Try(candidate)) continue;
        progress = true;
        break;
      }
    }
    return progress;
  }

  const MinimizeOptions& options_;
  Minimized result_;
  Simplicity simplicity_;
};

}  // namespace

bool Simplicity::operator<(const Simplicity& other) const {
  return std::tie(contacts, rows, nonzeros, bits, magnitude) <
         std::tie(other.contacts, other.rows, other.nonzeros, other.bits, other.magnitude);
}

Simplicity SimplicityOf(const ExactProblem& problem) {
  Simplicity simplicity;
  simplicity.contacts = static_cast<std::int64_t>(problem.contacts.size());
  simplicity.rows = problem.rows();
  const auto add = [&simplicity](const Rational& x) {
    simplicity.bits += static_cast<std::int64_t>(mpz_sizeinbase(x.get_num_mpz_t(), 2));
    if (x.get_den() != 1) simplicity.bits += static_cast<std::int64_t>(mpz_sizeinbase(x.get_den_mpz_t(), 2));
    if (x < 0) ++simplicity.bits;
    simplicity.magnitude += Rational(mpz_class(abs(x.get_num()) + x.get_den()));
  };
  ForEachNumber(problem, [&](const Rational& x) {
    simplicity.nonzeros += x != 0;
    add(x);
  });
  for (const auto& contact : problem.contacts) add(contact.mu);
  return simplicity;
}

Minimized Minimize(const ExactProblem& problem, const MinimizeOptions& options) {
  return Minimizer(problem, options).Run();
}

}  // namespace stiction
