// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/safe.h"

#include <fmt/format.h>

#include <algorithm>

#include "certify/claims/claim.h"
#include "certify/claims/condition.h"
#include "corpus/exact_number.h"
#include "corpus/grouped.h"
#include "corpus/input_error.h"
#include "corpus/json.h"
#include "solver/linear/elimination.ipp"
#include "solver/problem/check.h"
#include "solver/published/published.h"

namespace stiction {
namespace {

using enum Mode;

// A_N or A_F stands in the reduced matrix with this factor: slip+ has fF = -mu fN.
Rational SlipFactor(const Contact<Rational>& contact, Mode mode) {
  if (mode == kSlipPlus) return -contact.mu;
  return mode == kSlipMinus ? contact.mu : Rational(0);
}

int RowsOf(const Contact<Rational>& contact) { return contact.HasFrictionRows() ? 2 : 1; }

}  // namespace

ExactMatrix ReducedMatrix(const ExactProblem& problem, const ModeWord& word) {
  std::vector<int> rows;         // of A, and the columns that stand alone or first
  std::vector<Rational> factor;  // of the column behind it, which is added
  int row = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (word[i] != kBreak) {
      rows.push_back(row);
      factor.push_back(SlipFactor(problem.contacts[i], word[i]));
    }
    if (word[i] == kStick) {
      rows.push_back(row + 1);
      factor.push_back(0);
    }
    row += RowsOf(problem.contacts[i]);
  }
  const int n = static_cast<int>(rows.size());
  ExactMatrix R(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      R(i, j) = problem.A(rows[i], rows[j]);
      if (factor[j] != 0) R(i, j) += factor[j] * problem.A(rows[i], rows[j] + 1);
    }
  }
  return R;
}

Rational ReducedDeterminant(const ExactProblem& problem, const ModeWord& word) {
  const ExactMatrix R = ReducedMatrix(problem, word);
  const int n = static_cast<int>(R.rows());
  Elimination<Rational> elimination;
  elimination.Assign(R);
  elimination.Run(n, n, n);
  return elimination.Determinant();
}

// By the recurrence of Faddeev and Le Verrier.
std::vector<Rational> ShiftedDeterminant(const ExactMatrix& R) {
  const auto n = R.rows();
  std::vector<Rational> coefficients(n + 1, Rational(1));
  const ExactMatrix I = ExactMatrix::Identity(n, n);
  ExactMatrix M = I;
  for (Eigen::Index k = 1; k <= n; ++k) {
    const ExactMatrix product = R * M;
    const Rational trace = product.trace() / Rational(k);
    coefficients[n - k] = trace;
    M = trace * I - product;
  }
  return coefficients;
}

// ---- Deciding ----------------------------------------------------------------------------------

namespace {

struct TooManyWords : InputError {
  using InputError::InputError;
};

// Depth first. `M` is the Schur complement that is left for the contacts behind the prefix.
struct WordTree {
  const ExactProblem& problem;
  Safety safety;
  ModeWord prefix;

  void Visit(const ExactMatrix& M, const Rational& determinant) {
    if (prefix.size() == problem.contacts.size()) {
      if (safety.determinants.size() == kMaxSafetyWords) {
        throw TooManyWords(fmt::format("safe: more than {} words, the first {} with a positive determinant",
                                       kMaxSafetyWords, kMaxSafetyWords));
      }
      safety.determinants.push_back(determinant);
      return;
    }
    const Contact<Rational>& contact = problem.contacts[prefix.size()];
    for (const Mode mode : ModesOf(contact)) {
      prefix.push_back(mode);
      Descend(M, RowsOf(contact), mode, SlipFactor(contact, mode), determinant);
      prefix.pop_back();
      if (safety.unsafe_word) return;
    }
  }

  // Eliminates the first contact of M, which has `rows` rows and this mode.
  void Descend(const ExactMatrix& M, int rows, Mode mode, const Rational& factor, const Rational& determinant) {
    const int rest = static_cast<int>(M.rows()) - rows;
    if (mode == kBreak) {
      Visit(M.bottomRightCorner(rest, rest), determinant);
      return;
    }
    ExactMatrix column = M.leftCols(mode == kStick ? 2 : 1);
    for (int i = 0; factor != 0 && i < M.rows(); ++i) column(i, 0) += factor * M(i, 1);
    const Rational pivot =
        mode == kStick ? Rational(column(0, 0) * column(1, 1) - column(0, 1) * column(1, 0)) : column(0, 0);
    if (pivot <= 0) {
      safety.unsafe_word = prefix;  // and all contacts behind it break: the first word that begins so
      safety.unsafe_word->resize(problem.contacts.size(), kBreak);
      safety.determinants.push_back(determinant * pivot);
      return;
    }
    const int k = static_cast<int>(column.cols());
    ExactMatrix inverse = ExactMatrix::Constant(1, 1, Rational(1));  // of the pivot block, times the pivot
    if (mode == kStick) {
      inverse.resize(2, 2);
      inverse << column(1, 1), -column(0, 1), -column(1, 0), column(0, 0);
    }
    const ExactMatrix left = column.bottomRows(rest) * (inverse / pivot);
    const ExactMatrix schur = M.bottomRightCorner(rest, rest) - left * M.block(0, rows, k, rest);
    Visit(schur, determinant * pivot);
  }
};

}  // namespace

void RequireSafetyDecidable(const ExactProblem& problem) {
  if (!PublishedHandles(problem)) {
    throw InputError("safe: a kind or dimension other than planar frictionless and static contacts");
  }
}

bool HasFewWords(const ExactProblem& problem, int most) {
  ExactProblem rough = problem;  // mu = 1: a static contact has all its modes
  for (auto& contact : rough.contacts) contact.mu = contact.HasFrictionRows() ? 1 : 0;
  return Completions(rough, 0) <= most;
}

Safety DecideSafety(const ExactProblem& problem) {
  RequireSafetyDecidable(problem);
  WordTree tree{problem, {}, {}};
  tree.Visit(problem.A, 1);
  return std::move(tree.safety);
}

WeakSafety DecideWeakSafety(const ExactProblem& problem) {
  RequireSafetyDecidable(problem);
  WeakSafety safety;
  for (const ModeWord& word : AllWords(problem)) {
    const int sign = sgn(ReducedDeterminant(problem, word));
    safety.vanishing += sign == 0;
    if (sign < 0 && !safety.negative_word) safety.negative_word = word;
    if (safety.limit_word || sign > 0) continue;
    const auto coefficients = ShiftedDeterminant(ReducedMatrix(problem, word));
    const auto first = std::ranges::find_if(coefficients, [](const Rational& x) { return x != 0; });
    if (*first < 0) safety.limit_word = word;
  }
  return safety;
}

std::optional<bool> IsSafeIfSmall(const ExactProblem& problem) {
  const bool other = std::any_of(problem.contacts.begin(), problem.contacts.end(), [](const auto& contact) {
    return contact.kind == ContactKind::kBilateral || contact.kind == ContactKind::kSliding;
  });
  if (other || problem.contacts.size() > kMostContactsOfSafety) return std::nullopt;
  return !DecideSafety(problem).unsafe_word.has_value();
}

Json SafetyCertificate(const ExactProblem& problem) {
  const Safety safety = DecideSafety(problem);
  const bool too_long = std::ranges::any_of(safety.determinants, [](const Rational& value) {
    return ToString(value).size() > kMostCharactersOfNumber;
  });
  if (too_long)
    throw InputError(
        "found a problem whose certificate of safety no checker would take, expected shorter numbers");
  const bool unsafe = safety.unsafe_word.has_value();
  Json witness;
  if (unsafe) {
    witness = {{"word", WordToJson(*safety.unsafe_word)},
               {"determinant", ToString(safety.determinants.back())}};
  } else {
    Json values = Json::array();
    for (const Rational& value : safety.determinants) values.push_back(ToString(value));
    witness = {{"determinants", std::move(values)}};
  }
  const auto fault = FindFault(unsafe ? CheckUnsafe : CheckSafe, problem, witness);
  STICTION_CHECK(!fault, "a certificate of safety is none: " + fault->path);
  return MakeCertificate(unsafe ? "unsafe" : "safe", problem, std::move(witness));
}

Json SafetyCertificateIfDecided(const ExactProblem& problem) {
  try {
    return SafetyCertificate(problem);
  } catch (const TooManyWords&) {
    return nullptr;
  }
}

// ---- Checking ----------------------------------------------------------------------------------

void RequireClaimableSafety(const ExactProblem& problem) {
  if (PublishedHandles(problem)) return;
  throw Rejected{"problem", "a kind or dimension other than planar frictionless and static contacts", "those"};
}

namespace {

// The determinant of the word, which must be the number that is stated.
Rational ReadDeterminant(const ExactProblem& problem, const ModeWord& word, const Json& stated,
                         const std::string& path) {
  const Rational value = ReadNumber(stated, path), determinant = ReducedDeterminant(problem, word);
  if (value == determinant) return determinant;
  throw Rejected{path, Shown(stated),
                 ToString(determinant) + ", the reduced determinant of " + JsonText(WordToJson(word))};
}

}  // namespace

Json CheckSafe(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"determinants"});
  RequireClaimableSafety(problem);
  const Json& stated = witness["determinants"];
  RequireList(stated, "witness.determinants");
  const mpz_class count = Completions(problem, 0);
  if (count != stated.size()) {
    throw Rejected{"witness.determinants", fmt::format("{} items", stated.size()),
                   "a list of " + count.get_str() + ", one for each word"};
  }
  Cost(WordOperations(problem.rows(), static_cast<double>(stated.size()))).AllRows(problem);
  const std::vector<ModeWord> words = AllWords(problem);
  Rational smallest = 1;  // that of the word in which all contacts break
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string path = ElementPath("witness.determinants", k);
    const Rational determinant = ReadDeterminant(problem, words[k], stated[k], path);
    if (determinant <= 0) throw Rejected{path, ToString(determinant), "a number > 0"};
    smallest = std::min(smallest, determinant);
  }
  return {{"words", words.size()}, {"smallest", ToString(smallest)}};
}

Json CheckUnsafe(const ExactProblem& problem, const Json& witness) {
  RequireKeys(witness, "witness", {"determinant", "word"});
  RequireClaimableSafety(problem);
  const Json& stated = witness["word"];
  RequireList(stated, "witness.word", problem.contacts.size(), "modes");
  const ModeWord word = ReadPrefix(stated, "witness.word", problem);
  Cost(EliminationOperations(problem.rows(), 1)).AllRows(problem);
  const Rational value = ReadDeterminant(problem, word, witness["determinant"], "witness.determinant");
  if (value > 0) throw Rejected{"witness.determinant", ToString(value), "a number <= 0"};
  return {{"word", stated}, {"determinant", ToString(value)}};
}

void RequireSafetyIsSaid(const ExactProblem& problem, const std::string& source) {
  RequireHandled(problem, source, "safety");
}

namespace {

// By the determinants; of too many words by the condition number, if it is enough.
Json OfSafety(const ExactProblem& problem) {
  Json decided = SafetyCertificateIfDecided(problem);
  if (!decided.is_null()) return decided;
  if (auto found = ConditionCertificate(problem)) return std::move(*found);
  return fmt::format("there are more than {} words, and the condition number of A does not tell",
                     Grouped(kMaxSafetyWords));
}

}  // namespace

ClaimRows SafetyClaims() {
  static constexpr Claim kClaims[] = {
      Claim{"safe", CheckSafe, "A is safe: ties apart, the published algorithm under apex=suspended ends",
            Alone<OfSafety>, RequireSafetyIsSaid},
      Claim{.name = "unsafe",
            .check = CheckUnsafe,
            .meaning = "a reduced determinant is not positive",
            .negative = true}};
  return {50, kClaims};
}

}  // namespace stiction
