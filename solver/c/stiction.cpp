// SPDX-License-Identifier: Apache-2.0
// Definitions of stiction.h: what is given is checked and copied, solved, and judged by the gate's errors.
// Whatever is thrown on the way ends here.

#include "solver/c/stiction.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <limits>
#include <new>
#include <optional>
#include <string_view>
#include <vector>

#include "solver/numeric/body_newton.h"
#include "solver/numeric/dense_factors.h"
#include "solver/problem/forms.h"
#include "solver/problem/gate.h"
#include "solver/problem/lenient.h"
#include "solver/solve.h"

namespace stiction {
namespace {

// Forces of a contact, for the call after.
struct KnownForces {
  unsigned long long key;
  int kind;
  std::array<double, 3> f;
};

}  // namespace
}  // namespace stiction

struct stiction_context {
  std::optional<stiction::BodyNewton> newton;
  std::vector<stiction::KnownForces> known;  // by key
  int known_dimension = 0;
  char message[256] = "";
};

namespace stiction {
namespace {

using Factored = FactoredProblem<double>;
using Dense = ContactProblem<double>;
using Vector = Eigen::VectorXd;

// ---- What is given ----------------------------------------------------------------------------------

struct Refusal {
  char text[sizeof(stiction_context::message)];
};

[[noreturn, gnu::format(printf, 1, 2)]] void Refuse(const char* format, ...) {
  Refusal refusal;
  std::va_list words;
  va_start(words, format);
  std::vsnprintf(refusal.text, sizeof refusal.text, format, words);
  va_end(words);
  throw refusal;
}

void CheckCount(const char* name, int count) {
  constexpr int kMost = 1 << 28;  // three rows of each are still an int
  if (count < 0 || count > kMost) Refuse("%s is %d; expected 0 to %d", name, count, kMost);
}

template <class T>
void CheckPointer(const char* name, const T* pointer, long long count) {
  if (pointer == nullptr && count > 0) Refuse("%s is NULL; expected %lld numbers", name, count);
}

void CheckNumbers(const char* name, const double* numbers, long long count) {
  CheckPointer(name, numbers, count);
  for (long long i = 0; i < count; ++i) {
    if (!std::isfinite(numbers[i])) Refuse("%s[%lld] is %g; expected a finite number", name, i, numbers[i]);
  }
}

Contact<double> TakenContact(const stiction_contact& given, int i, int dimension) {
  constexpr double kUnit = 1e-9;
  if (given.kind < STICTION_BILATERAL || given.kind > STICTION_SLIDING)
    Refuse("contacts[%d].kind is %d; expected a stiction_kind, 0 to 3", i, given.kind);
  Contact<double> contact;
  contact.kind = static_cast<ContactKind>(given.kind);
  if (!std::isfinite(given.mu) || given.mu < 0)
    Refuse("contacts[%d].mu is %g; expected a finite number >= 0", i, given.mu);
  if (!contact.HasFrictionRows() && given.mu != 0)
    Refuse("contacts[%d].mu is %g; expected 0 of a kind without friction", i, given.mu);
  contact.mu = given.mu;
  if (contact.kind != ContactKind::kSliding) return contact;
  contact.slip = {given.slip[0], dimension == 3 ? given.slip[1] : 0};
  const double length = std::hypot(contact.slip[0], contact.slip[1]);
  if (!(std::abs(length - 1) <= kUnit))
    Refuse("contacts[%d].slip has length %g; expected 1, the sliding velocity's direction", i, length);
  return contact;
}

// Of either form; checks dimension and rows.
template <class Given>
std::vector<Contact<double>> TakenContacts(const Given& given) {
  if (given.dimension != 2 && given.dimension != 3) Refuse("dimension is %d; expected 2 or 3", given.dimension);
  CheckCount("contact_count", given.contact_count);
  CheckPointer("contacts", given.contacts, given.contact_count);
  std::vector<Contact<double>> contacts;
  contacts.reserve(given.contact_count);
  for (int i = 0; i < given.contact_count; ++i)
    contacts.push_back(TakenContact(given.contacts[i], i, given.dimension));
  const int rows = RowCount(contacts, given.dimension);
  if (given.rows != rows)
    Refuse("rows is %d; expected %d, a row of each contact and, with friction, %d more", given.rows, rows,
           given.dimension - 1);
  return contacts;
}

Factored::Matrix::Rows TakenJ(const stiction_factors& given) {
  CheckCount("velocities", given.velocities);
  if (given.rows == 0) return {0, given.velocities};
  CheckPointer("row_starts", given.row_starts, given.rows + 1);
  if (given.row_starts[0] != 0) Refuse("row_starts[0] is %d; expected 0", given.row_starts[0]);
  for (int i = 0; i < given.rows; ++i) {
    if (given.row_starts[i + 1] < given.row_starts[i])
      Refuse("row_starts[%d] is %d; expected at least row_starts[%d], %d", i + 1, given.row_starts[i + 1], i,
             given.row_starts[i]);
  }
  const int count = given.row_starts[given.rows];
  CheckPointer("columns", given.columns, count);
  CheckNumbers("values", given.values, count);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(count);
  for (int i = 0; i < given.rows; ++i) {
    for (int k = given.row_starts[i]; k < given.row_starts[i + 1]; ++k) {
      if (given.columns[k] < 0 || given.columns[k] >= given.velocities)
        Refuse("columns[%d], in row %d, is %d; expected 0 to %d, of %d velocities", k, i, given.columns[k],
               given.velocities - 1, given.velocities);
      entries.emplace_back(i, given.columns[k], given.values[k]);
    }
  }
  Factored::Matrix::Rows J(given.rows, given.velocities);
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

// Sets M, and W as its inverse.
void TakeMasses(const stiction_factors& given, Factored& problem, Factored::Matrix::Matrix& W) {
  constexpr double kSymmetric = 1e-9;  // of the block's largest entry
  CheckCount("block_count", given.block_count);
  CheckPointer("block_sizes", given.block_sizes, given.block_count);
  long long sum = 0, numbers = 0;
  for (int n = 0; n < given.block_count; ++n) {
    const long long size = given.block_sizes[n];
    if (size < 1 || size > given.velocities)
      Refuse("block_sizes[%d] is %lld; expected 1 to %d, the velocities", n, size, given.velocities);
    sum += size;
    numbers += size * size;
  }
  if (sum != given.velocities)
    Refuse("block_sizes add up to %lld; expected %d, the velocities", sum, given.velocities);
  CheckNumbers("mass", given.mass, numbers);
  std::vector<Eigen::Triplet<double>> masses, inverses;
  const double* mass = given.mass;
  for (int n = 0, at = 0; n < given.block_count; at += given.block_sizes[n++]) {
    const int size = given.block_sizes[n];
    const Eigen::MatrixXd block = Eigen::Map<const Eigen::MatrixXd>(mass, size, size);
    mass += size * size;
    if ((block - block.transpose()).cwiseAbs().maxCoeff() > kSymmetric * block.cwiseAbs().maxCoeff())
      Refuse("block %d of mass is not symmetric; expected a symmetric, positive definite one", n);
    const Eigen::LLT<Eigen::MatrixXd> factor((block + block.transpose()) / 2);
    const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(size, size));
    if (factor.info() != Eigen::Success || !inverse.allFinite())
      Refuse("block %d of mass is not positive definite; expected it to be, without the fixed bodies", n);
    for (int j = 0; j < size; ++j) {
      for (int i = 0; i < size; ++i) {
        const double m = (block(i, j) + block(j, i)) / 2, w = (inverse(i, j) + inverse(j, i)) / 2;
        if (m != 0) masses.emplace_back(at + i, at + j, m);
        if (w != 0) inverses.emplace_back(at + i, at + j, w);
      }
    }
  }
  problem.M.resize(given.velocities, given.velocities);
  problem.M.setFromTriplets(masses.begin(), masses.end());
  W.resize(given.velocities, given.velocities);
  W.setFromTriplets(inverses.begin(), inverses.end());
}

Factored Taken(const stiction_factors& given) {
  Factored problem;
  problem.dimension = given.dimension;
  problem.contacts = TakenContacts(given);
  Factored::Matrix::Rows J = TakenJ(given);
  Factored::Matrix::Matrix W;
  TakeMasses(given, problem, W);
  CheckNumbers("w", given.w, given.velocities);
  problem.w = Eigen::Map<const Vector>(given.w, given.velocities);
  problem.c.setZero(given.rows);
  if (given.c != nullptr) {
    CheckNumbers("c", given.c, given.rows);
    problem.c = Eigen::Map<const Vector>(given.c, given.rows);
  }
  problem.b = J * problem.w + problem.c;
  problem.A = {J, W};
  return problem;
}

Dense Taken(const stiction_dense& given) {
  Dense problem;
  problem.dimension = given.dimension;
  problem.contacts = TakenContacts(given);
  const int stride = given.stride == 0 ? given.rows : given.stride;
  if (stride < given.rows) Refuse("stride is %d; expected 0, or at least %d, the rows", stride, given.rows);
  CheckPointer("A", given.A, given.rows);
  problem.A.resize(given.rows, given.rows);
  for (int i = 0; i < given.rows; ++i) {
    for (int j = 0; j < given.rows; ++j) {
      const double x = given.A[static_cast<long long>(i) * stride + j];
      if (!std::isfinite(x)) Refuse("A[%d * stride + %d] is %g; expected a finite number", i, j, x);
      problem.A(i, j) = x;
    }
  }
  CheckNumbers("b", given.b, given.rows);
  problem.b = Eigen::Map<const Vector>(given.b, given.rows);
  return problem;
}

stiction_options Defaults() {
  stiction_options options{};
  options.size = sizeof options;
  options.warm = 1;
  options.residual = kSolvedResidual<double>;
  options.points = BodyNewton::kPoints;
  options.dense_rows = 150;
  return options;
}

stiction_options Taken(const stiction_options* given) {
  if (given == nullptr) return Defaults();
  if (given->size != sizeof(stiction_options))
    Refuse("options.size is %u; expected %u, of version %s; begin with stiction_default_options", given->size,
           static_cast<unsigned>(sizeof(stiction_options)), STICTION_VERSION);
  if (given->warm != 0 && given->warm != 1) Refuse("options.warm is %d; expected 0 or 1", given->warm);
  if (!(given->residual > 0 && given->residual < 1))
    Refuse("options.residual is %g; expected a number between 0 and 1", given->residual);
  if (!(given->noise >= 0) || !std::isfinite(given->noise))
    Refuse("options.noise is %g; expected a finite number >= 0", given->noise);
  CheckCount("options.points", given->points);
  CheckCount("options.dense_rows", given->dense_rows);
  return *given;
}

// ---- Solving ------------------------------------------------------------------------------------------

// The best forces so far.
struct Best {
  Vector f;
  Errors<double> errors;
  const char* method = "none";  // f = 0
  bool warm = false;
};

// As the gate bounds them; accelerations of at most `noise` count as none.
template <class Problem>
Errors<double> ErrorsOf(const Problem& problem, const Vector& f, const stiction_options& options) {
  GateMeter<double> meter;
  return BoundErrors(problem, FrictionLaw::kCoulomb, f, GateOf<double>(options.residual), meter, options.noise);
}

// Whether f = 0 leaves no normal acceleration that is not allowed.
template <class Problem>
bool NeedsNoForces(const Problem& problem) {
  int row = 0;
  for (const Contact<double>& contact : problem.contacts) {
    if (contact.kind == ContactKind::kBilateral ? problem.b[row] != 0 : problem.b[row] < 0) return false;
    row += contact.HasFrictionRows() ? problem.dimension : 1;
  }
  return true;
}

template <class Problem>
class Solving {
 public:
  Solving(const Problem& problem, const stiction_options& options) : problem_(problem), options_(options) {
    best_.f.setZero(problem.rows());
    best_.errors.acceleration = std::numeric_limits<double>::infinity();
    if (NeedsNoForces(problem)) best_.errors = ErrorsOf(problem, best_.f, options);
  }

  // The best forces; f = 0 where nothing was found that has errors.
  const Best& Finish() {
    if (!std::isfinite(best_.errors.Largest())) best_.errors = ErrorsOf(problem_, best_.f, options_);
    return best_;
  }
  bool IsSolved() const { return best_.errors.Largest() <= options_.residual; }

  // How far the forces of the call before are off: of all but noise.
  double LenientErrorOf(const Factored& factors, const Vector& f) const {
    LenientUnits<double> units;
    return MeasureLeniently(factors, FrictionLaw::kCoulomb, f, factors.Accelerations(f), units, options_.noise)
        .error;
  }

  // Keeps the better forces.
  void Offer(const Vector& f, std::string_view method, bool warm) {
    if (f.size() != problem_.rows() || !f.allFinite()) return;
    const Errors<double> errors = ErrorsOf(problem_, f, options_);
    if (errors.Largest() < best_.errors.Largest()) best_ = {f, errors, method.data(), warm};
  }

  // `factors`: the problem, in factors.
  void ByNewton(BodyNewton& newton, const Factored& factors, const Vector* start) {
    using Newton = BodyNewton;
    newton.request() = {.residual = options_.residual / 2,  // the gate adds what rounding may hide
                        .noise = options_.noise};
    newton.aim = std::min(Newton::kAim, options_.residual / 2);
    newton.points = options_.points;
    newton.warm_eps = Newton::kWarmEps;
    newton.failures = Newton::kFailures;
    if (start != nullptr) {
      const double error = LenientErrorOf(factors, *start);
      newton.warm_eps = std::clamp(kEpsPerError * error, Newton::kWarmEps, kMostEps);
      newton.failures = kFailures + problem_.rows() / kRowsPerFailure;
    }
    newton.Run(factors, start);
    Offer(newton.f(), "newton", start != nullptr);
  }

  // From the forces of the call before, if there are any; then from none.
  void ByNewton(std::optional<BodyNewton>& newton, const Factored& factors, const Vector& start) {
    if (options_.points == 0) return;
    if (!newton) newton.emplace();
    if (start.size() > 0) ByNewton(*newton, factors, &start);
    if (!IsSolved()) ByNewton(*newton, factors, nullptr);
  }

  void ByDenseMethods(const Dense& problem) {
    const Answer<double> answer = Solve(problem, {.residual = options_.residual});
    Offer(answer.f, answer.method, false);
  }

 private:
  // From given forces: the first eps is in proportion to their error, so that what changed little is found by a
  // step or two, and what changed much does not lead astray; and Newton's method may fail so often before it
  // begins without. A box and a stack of five in space, pushed at random by 1e-5, 1e-3 or 0.1 of their weight:
  // 27, 30 and 140 us a call and .2, .5 and 2.2 ms, where eps = 1e-6 took .2 and 3 ms.
  static constexpr double kEpsPerError = 10, kMostEps = 3e-2;
  static constexpr int kFailures = 2, kRowsPerFailure = 40;

  const Problem& problem_;
  const stiction_options& options_;
  Best best_;
};

// Forces of the call before; empty where no contact has any.
template <class Given>
Vector Start(const stiction_context& context, const Given& given) {
  if (context.known.empty() || context.known_dimension != given.dimension) return {};
  Vector start = Vector::Zero(given.rows);
  bool any = false;
  for (int i = 0, row = 0; i < given.contact_count; ++i) {
    const int kind = given.contacts[i].kind, rows = kind < STICTION_STATIC ? 1 : given.dimension;
    const unsigned long long key = given.keys != nullptr ? given.keys[i] : i;
    const auto found =
        std::lower_bound(context.known.begin(), context.known.end(), key,
                         [](const auto& one, unsigned long long other) { return one.key < other; });
    if (found != context.known.end() && found->key == key && found->kind == kind) {
      for (int k = 0; k < rows; ++k) start[row + k] = found->f[k];
      any = true;
    }
    row += rows;
  }
  return any ? start : Vector();
}

template <class Given>
void Remember(stiction_context& context, const Given& given, const Vector& f) {
  context.known.clear();
  context.known_dimension = given.dimension;
  for (int i = 0, row = 0; i < given.contact_count; ++i) {
    const int kind = given.contacts[i].kind, rows = kind < STICTION_STATIC ? 1 : given.dimension;
    KnownForces known{given.keys != nullptr ? given.keys[i] : i, kind, {}};
    for (int k = 0; k < rows; ++k) known.f[k] = f[row + k];
    context.known.push_back(known);
    row += rows;
  }
  std::stable_sort(context.known.begin(), context.known.end(),
                   [](const auto& one, const auto& other) { return one.key < other.key; });
}

// Writes the answer, when there is nothing left that may throw. v: of the bodies.
template <class Problem>
stiction_verdict Told(stiction_context& context, const Best& best, const Problem& problem, const Vector& v,
                      const stiction_options& options, stiction_answer& answer) {
  GateMeter<double> meter;
  meter.Accelerate(problem, best.f, Gate{0, 0});
  const Vector& a = meter.a();
  for (int i = 0; i < problem.rows(); ++i) {
    answer.forces[i] = best.f[i];
    if (answer.accelerations != nullptr) answer.accelerations[i] = a[i];
  }
  if (answer.body_accelerations != nullptr) std::copy(v.begin(), v.end(), answer.body_accelerations);
  answer.errors = {best.errors.acceleration, best.errors.force, best.errors.contact};
  answer.warm = best.warm;
  answer.method = best.method;
  if (best.errors.Largest() <= options.residual) return STICTION_SOLVED;
  std::snprintf(context.message, sizeof context.message,
                "undecided: the least error found is %.3g, at contact %d, by method %s; expected at most %.3g",
                best.errors.Largest(), best.errors.contact, best.method, options.residual);
  return STICTION_UNDECIDED;
}

void CheckAnswer(const stiction_answer* answer, int rows) {
  if (answer == nullptr) Refuse("answer is NULL; expected a stiction_answer");
  if (answer->forces == nullptr && rows > 0)
    Refuse("answer.forces is NULL; expected room for %d numbers", rows);
}

stiction_verdict SolveFactors(stiction_context& context, const stiction_factors* given,
                              const stiction_options* wishes, stiction_answer* answer) {
  if (given == nullptr) Refuse("problem is NULL; expected a stiction_factors");
  const stiction_options options = Taken(wishes);
  const Factored problem = Taken(*given);
  CheckAnswer(answer, problem.rows());
  Solving<Factored> solving(problem, options);
  if (!solving.IsSolved() && problem.w.size() > 0)
    solving.ByNewton(context.newton, problem, options.warm ? Start(context, *given) : Vector());
  if (!solving.IsSolved() && problem.rows() <= options.dense_rows) solving.ByDenseMethods(DenseOf(problem));
  const Best& best = solving.Finish();
  context.known.clear();
  if (solving.IsSolved()) Remember(context, *given, best.f);
  return Told(context, best, problem, problem.w + problem.Responses(best.f), options, *answer);
}

stiction_verdict SolveNumbers(stiction_context& context, const stiction_dense* given,
                              const stiction_options* wishes, stiction_answer* answer) {
  if (given == nullptr) Refuse("problem is NULL; expected a stiction_dense");
  const stiction_options options = Taken(wishes);
  const Dense problem = Taken(*given);
  CheckAnswer(answer, problem.rows());
  Solving<Dense> solving(problem, options);
  if (!solving.IsSolved()) {
    if (const auto factors = FactorsOf(problem); factors && factors->w.size() > 0)
      solving.ByNewton(context.newton, *factors, options.warm ? Start(context, *given) : Vector());
  }
  if (!solving.IsSolved()) solving.ByDenseMethods(problem);
  const Best& best = solving.Finish();
  context.known.clear();
  if (solving.IsSolved()) Remember(context, *given, best.f);
  return Told(context, best, problem, {}, options, *answer);
}

// What call() returns, or what its exception says.
template <class Call>
stiction_verdict Guarded(stiction_context* context, Call call) noexcept {
  if (context == nullptr) return STICTION_REFUSED;
  char(&message)[sizeof context->message] = context->message;
  stiction_verdict verdict = STICTION_FAILED;
  message[0] = 0;
  try {
    return call();
  } catch (const Refusal& refusal) {
    std::memcpy(message, refusal.text, sizeof message);
    return STICTION_REFUSED;
  } catch (const std::bad_alloc&) {
    verdict = STICTION_NO_MEMORY;
    std::snprintf(message, sizeof message, "there is not enough memory for this problem");
  } catch (const std::exception& error) {
    std::snprintf(message, sizeof message, "a fault of the library: %s", error.what());
  } catch (...) {
    std::snprintf(message, sizeof message, "a fault of the library");
  }
  context->newton.reset();  // it may have been left in between
  context->known.clear();
  return verdict;
}

}  // namespace
}  // namespace stiction

extern "C" {

stiction_context* stiction_create(void) {
  try {
    return new stiction_context;
  } catch (...) {
    return nullptr;
  }
}

void stiction_destroy(stiction_context* context) { delete context; }

void stiction_default_options(stiction_options* options, unsigned size) {
  if (options == nullptr) return;
  const stiction_options defaults = stiction::Defaults();
  std::memset(options, 0, size);
  std::memcpy(options, &defaults, std::min<std::size_t>(size, sizeof defaults));
}

stiction_verdict stiction_solve(stiction_context* context, const stiction_factors* problem,
                                const stiction_options* options, stiction_answer* answer) {
  return stiction::Guarded(context, [=] { return stiction::SolveFactors(*context, problem, options, answer); });
}

stiction_verdict stiction_solve_dense(stiction_context* context, const stiction_dense* problem,
                                      const stiction_options* options, stiction_answer* answer) {
  return stiction::Guarded(context, [=] { return stiction::SolveNumbers(*context, problem, options, answer); });
}

const char* stiction_message(const stiction_context* context) {
  return context == nullptr ? "context is NULL; expected one of stiction_create" : context->message;
}

const char* stiction_version(void) { return STICTION_VERSION; }

}  // extern "C"
