// SPDX-License-Identifier: Apache-2.0
#include "certify/safe.h"

#include <CGAL/Polynomial.h>
#include <CGAL/Polynomial_traits_d.h>
#include <CGAL/gmpxx.h>
#include <fmt/format.h>

#include <algorithm>

#include "solver/check.h"
#include "solver/elimination.ipp"

namespace stiction {
namespace {

using enum Mode;

// A_N or A_F stands in the reduced matrix with this factor: slip+ has fF = -mu fN.
Rational SlipFactor(const Contact<Rational>& contact, Mode mode) {
  if (mode == kSlipPlus) return -contact.mu;
  return mode == kSlipMinus ? contact.mu : Rational(0);
}

int RowsOf(const Contact<Rational>& contact) { return contact.HasFrictionRows() ? 2 : 1; }

// All words in order, given the modes of each contact.
std::vector<ModeWord> WordsOf(const std::vector<std::span<const Mode>>& modes) {
  std::vector<ModeWord> words = {{}};
  for (const auto& choices : modes) {
    std::vector<ModeWord> longer;
    for (const ModeWord& word : words) {
      for (const Mode mode : choices) {
        longer.push_back(word);
        longer.back().push_back(mode);
      }
    }
    words = std::move(longer);
  }
  return words;
}

std::vector<std::span<const Mode>> ModesOfAll(const ExactProblem& problem) {
  std::vector<std::span<const Mode>> modes;
  for (const auto& contact : problem.contacts) modes.push_back(ModesOf(contact));
  return modes;
}

mpz_class WordCount(const ExactProblem& problem) {
  mpz_class count = 1;
  for (const auto& contact : problem.contacts) count *= ModesOf(contact).size();
  return count;
}

}  // namespace

Rational ReducedDeterminant(const ExactProblem& problem, const ModeWord& word) {
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
  Elimination<Rational> elimination;
  elimination.Assign(R);
  elimination.Run(n, n, n);
  return elimination.Determinant();
}

// ---- Deciding ----------------------------------------------------------------------------------

namespace {

// Depth first. `M` is the Schur complement that is left for the contacts behind the prefix.
struct WordTree {
  const ExactProblem& problem;
  Safety safety;
  ModeWord prefix;

  void Visit(const ExactMatrix& M, const Rational& determinant) {
    if (prefix.size() == problem.contacts.size()) {
      if (safety.determinants.size() == kMaxSafetyWords) {
        throw InputError(fmt::format("safe: more than {} words, the first {} with a positive determinant",
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

void RequireSupported(const ExactProblem& problem) {
  if (!PublishedHandles(problem)) {
    throw InputError("safe: a kind or dimension other than planar frictionless and static contacts");
  }
}

}  // namespace

Safety DecideSafety(const ExactProblem& problem) {
  RequireSupported(problem);
  WordTree tree{problem, {}, {}};
  tree.Visit(problem.A, 1);
  return std::move(tree.safety);
}

namespace {

Json WordToJson(const ModeWord& word) {
  Json modes = Json::array();
  for (const Mode mode : word) modes.push_back(Name(mode));
  return modes;
}

}  // namespace

std::optional<bool> IsSafeIfSmall(const ExactProblem& problem) {
  if (problem.contacts.size() > kMostContactsOfSafety) return std::nullopt;
  return !DecideSafety(problem).unsafe_word.has_value();
}

Json SafetyCertificate(const ExactProblem& problem) {
  const Safety safety = DecideSafety(problem);
  Json witness;
  if (safety.unsafe_word) {
    witness = {{"word", WordToJson(*safety.unsafe_word)},
               {"determinant", ToString(safety.determinants.back())}};
  } else {
    Json values = Json::array();
    for (const Rational& value : safety.determinants) values.push_back(ToString(value));
    witness = {{"determinants", std::move(values)}};
  }
  const SafetyCheck check = safety.unsafe_word ? CheckUnsafe(problem, witness) : CheckSafe(problem, witness);
  STICTION_CHECK(!check.fault, "a certificate of safety is none: " + check.fault->path);
  return {{"format", "stiction-certificate"},
          {"version", 1},
          {"claim", safety.unsafe_word ? "unsafe" : "safe"},
          {"problem", ProblemToJson(problem)},
          {"witness", std::move(witness)}};
}

// ---- Checking ----------------------------------------------------------------------------------

namespace {

std::string Shortened(const Json& json) {
  std::string text = json.dump();
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

[[noreturn]] void Reject(const std::string& path, std::string found, std::string expected) {
  throw WitnessFault{path, std::move(found), std::move(expected)};
}

// An object with exactly these keys, of a problem that the claim is about.
void RequireWitness(const ExactProblem& problem, const Json& witness, const std::vector<std::string>& keys) {
  if (!PublishedHandles(problem)) {
    Reject("problem", "a kind or dimension other than planar frictionless and static contacts", "those");
  }
  const auto is_known = [&](const auto& item) { return std::ranges::count(keys, item.key()) == 1; };
  const bool right =
      witness.is_object() && witness.size() == keys.size() && std::ranges::all_of(witness.items(), is_known);
  if (!right) Reject("witness", Shortened(witness), fmt::format("an object of {}", fmt::join(keys, ", ")));
}

// The determinant of the word, which must be the number that is stated.
Rational ReadDeterminant(const ExactProblem& problem, const ModeWord& word, const Json& stated,
                         const std::string& path) {
  const auto value = stated.is_string() ? ParseRational(stated.get<std::string>()) : std::nullopt;
  if (!value) Reject(path, Shortened(stated), "an exact number as a string");
  const Rational determinant = ReducedDeterminant(problem, word);
  if (*value != determinant) {
    Reject(path, Shortened(stated),
           ToString(determinant) + ", the reduced determinant of " + WordToJson(word).dump());
  }
  return determinant;
}

Json CheckDeterminants(const ExactProblem& problem, const Json& witness) {
  RequireWitness(problem, witness, {"determinants"});
  const Json& stated = witness["determinants"];
  const mpz_class count = WordCount(problem);
  if (!stated.is_array() || count != stated.size()) {
    Reject("witness.determinants",
           stated.is_array() ? fmt::format("{} items", stated.size()) : Shortened(stated),
           "a list of " + count.get_str() + ", one for each word");
  }
  const std::vector<ModeWord> words = WordsOf(ModesOfAll(problem));
  Rational smallest = 1;  // that of the word in which all contacts break
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string path = fmt::format("witness.determinants[{}]", k);
    const Rational determinant = ReadDeterminant(problem, words[k], stated[k], path);
    if (determinant <= 0) Reject(path, ToString(determinant), "a number > 0");
    smallest = std::min(smallest, determinant);
  }
  return {{"words", words.size()}, {"smallest", ToString(smallest)}};
}

Json CheckWord(const ExactProblem& problem, const Json& witness) {
  RequireWitness(problem, witness, {"word", "determinant"});
  const Json& stated = witness["word"];
  const std::size_t contacts = problem.contacts.size();
  if (!stated.is_array() || stated.size() != contacts) {
    Reject("witness.word", Shortened(stated), fmt::format("a list of {} modes", contacts));
  }
  ModeWord word;
  for (std::size_t i = 0; i < contacts; ++i) {
    const auto modes = ModesOf(problem.contacts[i]);
    const auto mode = std::ranges::find_if(modes, [&](Mode m) { return stated[i] == std::string(Name(m)); });
    if (mode == modes.end()) {
      Reject(fmt::format("witness.word[{}]", i), Shortened(stated[i]),
             fmt::format("a mode of a contact of its kind, contact {}", i + 1));
    }
    word.push_back(*mode);
  }
  const Rational value = ReadDeterminant(problem, word, witness["determinant"], "witness.determinant");
  if (value > 0) Reject("witness.determinant", ToString(value), "a number <= 0");
  return {{"word", stated}, {"determinant", ToString(value)}};
}

template <class Check>
SafetyCheck CatchFault(const Check& check) {
  try {
    return {std::nullopt, check()};
  } catch (const WitnessFault& fault) {
    return {fault, nullptr};
  }
}

}  // namespace

SafetyCheck CheckSafe(const ExactProblem& problem, const Json& witness) {
  return CatchFault([&] { return CheckDeterminants(problem, witness); });
}

SafetyCheck CheckUnsafe(const ExactProblem& problem, const Json& witness) {
  return CatchFault([&] { return CheckWord(problem, witness); });
}

// ---- The threshold -----------------------------------------------------------------------------

namespace {

using Polynomial = CGAL::Polynomial<Rational>;

Rational ValueAt(const Polynomial& p, const Rational& x) {
  Rational value = 0;
  for (int k = p.degree(); k >= 0; --k) value = value * x + p[k];
  return value;
}

// det R(word) as a polynomial in mu: Newton's interpolation at 0, 1, ..., as many slips as there are.
Polynomial DeterminantPolynomial(ExactProblem problem, const ModeWord& word) {
  const auto is_slip = [](Mode mode) { return mode == kSlipPlus || mode == kSlipMinus; };
  Polynomial p(Rational(0)), basis(Rational(1));
  for (int point = 0; point <= std::ranges::count_if(word, is_slip); ++point) {
    for (auto& contact : problem.contacts) contact.mu = point;
    const Rational missing = ReducedDeterminant(problem, word) - ValueAt(p, point);
    p += basis * Polynomial(Rational(missing / ValueAt(basis, point)));
    basis *= Polynomial(Rational(-point), Rational(1));
  }
  return p;
}

// Distinct real roots of a polynomial that is not zero, counted by Sturm's theorem.
class SturmChain {
 public:
  explicit SturmChain(const Polynomial& p) : chain_{CGAL::make_square_free(p)} {
    Polynomial next = CGAL::differentiate(chain_[0]);
    while (!next.is_zero()) {
      chain_.push_back(next);
      Polynomial quotient, remainder;
      Polynomial::euclidean_division(chain_[chain_.size() - 2], next, quotient, remainder);
      next = -remainder;
    }
  }

  const Polynomial& square_free() const { return chain_[0]; }
  // Low is not a root or is left out, high is counted.
  int RootsIn(const Rational& low, const Rational& high) const { return Variations(low) - Variations(high); }

 private:
  int Variations(const Rational& x) const {
    int variations = 0, last = 0;
    for (const Polynomial& p : chain_) {
      const int sign = sgn(ValueAt(p, x));
      if (sign * last < 0) ++variations;
      if (sign != 0) last = sign;
    }
    return variations;
  }

  std::vector<Polynomial> chain_;  // the square-free part, its derivative, minus the remainders
};

// The smallest positive root: low < root <= high, no other positive root <= high.
struct FirstRoot {
  SturmChain chain;
  Rational low, high;

  void Halve() {
    const Rational middle = (low + high) / 2;
    (chain.RootsIn(low, middle) > 0 ? high : low) = middle;
  }
};

// Requires: p has a root in (0, high].
FirstRoot IsolateFirstRoot(SturmChain chain, const Rational& high) {
  FirstRoot root = {std::move(chain), 0, high};
  while (root.chain.RootsIn(root.low, root.high) > 1) root.Halve();
  return root;
}

bool IsSmaller(FirstRoot left, FirstRoot right) {
  const Polynomial common = CGAL::gcd(left.chain.square_free(), right.chain.square_free());
  const Rational low = std::max(left.low, right.low), high = std::min(left.high, right.high);
  // A common root where both intervals overlap is the only root of either in its interval.
  if (low < high && SturmChain(common).RootsIn(low, high) > 0) return false;
  while (left.low < right.high && right.low < left.high) {
    left.Halve();
    right.Halve();
  }
  return left.high <= right.low;
}

// A power of two above all roots (Cauchy). Requires: p is not zero.
Rational RootBound(const Polynomial& p) {
  Rational largest = 0, bound = 1;
  for (int k = 0; k < p.degree(); ++k) largest = std::max(largest, Rational(abs(p[k] / p.lcoeff())));
  while (bound <= 1 + largest) bound *= 2;
  return bound;
}

bool IsPositiveAboveZero(const Polynomial& p) {
  for (int k = 0; k <= p.degree(); ++k) {
    if (p[k] != 0) return p[k] > 0;
  }
  return false;
}

SafetyThreshold MakeThreshold(const ModeWord& word, const Polynomial& p) {
  return {word, std::vector<Rational>(p.begin(), p.end()), 0, 0};
}

// The rational number with the smallest denominator in [low, high]. Requires: 0 <= low < high.
Rational SimplestBetween(const Rational& low, const Rational& high) {
  mpz_class floor;
  mpz_fdiv_q(floor.get_mpz_t(), low.get_num_mpz_t(), low.get_den_mpz_t());
  if (low == floor) return low;
  if (floor + 1 <= high) return floor + 1;
  return floor + 1 / SimplestBetween(1 / (high - floor), 1 / (low - floor));
}

// Narrows the interval, and makes it a point if the root is the simplest number in it.
void Refine(SafetyThreshold& threshold, FirstRoot root) {
  while (root.high - root.low > Rational(1, 1 << 20)) root.Halve();
  const Rational simplest = SimplestBetween(root.low, root.high);
  const bool is_root = simplest > root.low && ValueAt(root.chain.square_free(), simplest) == 0;
  threshold.low = is_root ? simplest : root.low;
  threshold.high = is_root ? simplest : root.high;
}

}  // namespace

std::optional<SafetyThreshold> FindSafetyThreshold(const ExactProblem& problem) {
  RequireSupported(problem);
  ExactProblem rough = problem;  // mu = 1: a static contact has all its modes
  for (auto& contact : rough.contacts) contact.mu = contact.HasFrictionRows() ? 1 : 0;
  if (WordCount(rough) > kMaxSafetyWords) {
    throw InputError(fmt::format("safe: more than {} words", kMaxSafetyWords));
  }
  std::optional<SafetyThreshold> threshold;
  std::optional<FirstRoot> smallest;
  for (const ModeWord& word : WordsOf(ModesOfAll(rough))) {
    const Polynomial p = DeterminantPolynomial(rough, word);
    if (!IsPositiveAboveZero(p)) return MakeThreshold(word, p);
    const Rational bound = smallest ? smallest->high : RootBound(p);
    SturmChain chain(p);
    if (chain.RootsIn(0, bound) == 0) continue;
    FirstRoot root = IsolateFirstRoot(std::move(chain), bound);
    if (smallest && !IsSmaller(root, *smallest)) continue;
    threshold = MakeThreshold(word, p);
    smallest = std::move(root);
  }
  if (smallest) Refine(*threshold, *smallest);
  return threshold;
}

}  // namespace stiction
