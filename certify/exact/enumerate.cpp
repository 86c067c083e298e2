// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/enumerate.h"

#include <fmt/format.h>

#include <deque>
#include <set>
#include <variant>

#include "certify/exact/farkas.h"
#include "certify/exact/linear_system.h"
#include "certify/exact/verify_solution.h"
#include "solver/linear/elimination.ipp"
#include "solver/problem/check.h"

namespace stiction {

// ---- Whether a solution of a linear program is the only one ------------------------------------

namespace {

int Rank(const std::vector<std::vector<mpz_class>>& rows, int columns) {
  const int count = static_cast<int>(rows.size());
  Elimination<Rational> elimination;
  elimination.Resize(count, columns);
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < columns; ++j) elimination(i, j) = rows[i][j];
  }
  elimination.Run(count, columns, columns);
  return elimination.rank();
}

// Whether x is the only solution. Let N d >= 0, E d = 0 be the conditions that are tight at x, for a change d
// of x. There is no d /= 0 if and only if these rows have full rank and a combination of them with every
// coefficient of N positive vanishes (Stiemke): one more linear program, scaled to coefficients >= 1.
bool IsOnlySolution(const LinearSystem& system, const Point& x) {
  const std::size_t variables = x.size();
  std::vector<std::vector<mpz_class>> normals;
  std::vector<bool> free;
  for (const LinearSystem::Row& row : system.rows) {
    Rational value = row.constant;
    for (std::size_t j = 0; j < variables; ++j) value += row.coefficients[j] * x[j];
    if (value != 0) continue;
    normals.push_back(row.coefficients);
    if (row.relation == Relation::kAtMostZero) {
      for (mpz_class& coefficient : normals.back()) coefficient = -coefficient;
    }
    free.push_back(row.relation == Relation::kZero);
  }
  for (std::size_t j = 0; j < variables; ++j) {
    if (system.free[j] || x[j] != 0) continue;
    normals.emplace_back(variables)[j] = 1;
    free.push_back(false);
  }
  if (Rank(normals, static_cast<int>(variables)) < static_cast<int>(variables)) return false;
  LinearSystem dual;
  dual.free = free;
  for (std::size_t j = 0; j < variables; ++j) {
    LinearSystem::Row& row = dual.rows.emplace_back(LinearSystem::Row{{}, 0, Relation::kZero});
    for (std::size_t k = 0; k < normals.size(); ++k) {
      row.coefficients.push_back(normals[k][j]);
      if (!free[k]) row.constant += normals[k][j];
    }
  }
  return variables == 0 || std::holds_alternative<Point>(Solve(dual));
}

// ---- The search ---------------------------------------------------------------------------------

// A f + b with rows scaled to integers, for the force (1, f_t) of a contact at a time.
class IntegerRows {
 public:
  explicit IntegerRows(const ExactProblem& problem) : problem_(problem) {
    for (int i = 0; i < problem.rows(); ++i) {
      mpz_class scale = problem.b[i].get_den();
      int row = 0;
      for (const auto& contact : problem.contacts) {
        scale = lcm(scale, problem.A(i, row).get_den());
        if (contact.HasFrictionRows()) {
          const Rational limit = contact.mu * problem.A(i, row + 1);
          scale = lcm(scale, limit.get_den());
          ++row;
        }
        ++row;
      }
      scale_.push_back(scale);
    }
  }

  const mpz_class& scale(int i) const { return scale_[i]; }
  mpz_class Constant(int i) const { return Scaled(i, problem_.b[i]); }
  mpz_class Coefficient(int i, int normal_row, const Cone::Edge& edge) const {
    if (edge.f_t == 0) return Scaled(i, problem_.A(i, normal_row));
    return Scaled(i, problem_.A(i, normal_row) + edge.f_t * problem_.A(i, normal_row + 1));
  }

 private:
  mpz_class Scaled(int i, const Rational& x) const {
    const Rational scaled = x * scale_[i];
    STICTION_ASSERT(scaled.get_den() == 1, "a scaled row has integers only");
    return scaled.get_num();
  }

  const ExactProblem& problem_;
  std::vector<mpz_class> scale_;  // by row of A
};

class Enumerator {
 public:
  Enumerator(const ExactProblem& problem, const Request& request, const EnumerationWatch& watch)
      : problem_(problem), request_(request), watch_(watch), integers_(problem) {
    layout_.Assign(problem.contacts);
  }

  Enumeration Run() {
    ModeWord prefix;
    Search(prefix, nullptr, 1.0);
    std::set<std::vector<std::string>> witnesses;
    for (const WordSolution& solution : result_.solutions) {
      std::vector<std::string> text;
      for (const Rational& x : solution.f) text.push_back(ToString(x));
      witnesses.insert(std::move(text));
    }
    result_.distinct_witnesses = static_cast<std::int64_t>(witnesses.size());
    return std::move(result_);
  }

 private:
  struct Witness {
    ExactVector f, a;
  };
  // A linear system in the coefficients of the edges of all contacts, and what stands where in it.
  struct Program {
    LinearSystem system;
    std::vector<std::pair<int, Cone::Edge>> variables;  // normal row of the contact, edge
    std::vector<int> rows;                              // row of A
  };

  bool Ended() const { return result_.end != EnumerationEnd::kComplete; }

  // `near`: a witness of the prefix without its last mode. `share`: the part of all words below the prefix.
  void Search(ModeWord& prefix, const Witness* near, double share) {
    ++result_.prefixes;
    Witness own;
    const Witness* witness = near;
    if (near != nullptr && MeetsModes(problem_, prefix, near->f, near->a)) {
      ++result_.reused_witnesses;
    } else if (Refute(prefix)) {
      ++result_.reused_vectors;
      return Report(share);
    } else if (!SolveProgram(prefix, own)) {
      return Report(share);
    } else {
      witness = &own;
    }
    if (prefix.size() == problem_.contacts.size()) {
      AddSolution(prefix, *witness);
      return Report(share);
    }
    const auto modes = ModesOf(problem_.contacts[prefix.size()]);
    for (const Mode mode : modes) {
      prefix.push_back(mode);
      Search(prefix, witness, share / static_cast<double>(modes.size()));
      prefix.pop_back();
      if (Ended()) return;
    }
  }

  // Whether a recent Farkas vector refutes the prefix too.
  bool Refute(const ModeWord& prefix) {
    for (const FarkasVector& farkas : known_) {
      if (!Refutes(problem_, prefix, farkas)) continue;
      result_.refuted.push_back({prefix, farkas.y});
      return true;
    }
    return false;
  }

  // Whether the prefix is feasible: then `witness` is filled, otherwise a refutation is noted. Neither, and
  // false, if the budget is spent.
  bool SolveProgram(const ModeWord& prefix, Witness& witness) {
    if (result_.programs == request_.limits.programs) {
      result_.end = EnumerationEnd::kLimit;
      return false;
    }
    ++result_.programs;
    const Program program = MakeProgram(prefix);
    const auto answer = Solve(program.system);
    if (const Point* x = std::get_if<Point>(&answer)) {
      witness.f = ForceOf(program, *x);
      witness.a = Accelerations(problem_, witness.f);
      STICTION_CHECK(MeetsModes(problem_, prefix, witness.f, witness.a), "a linear program solved wrongly");
      return true;
    }
    NoteRefutation(prefix, program, std::get<Combination>(answer));
    return false;
  }

  void NoteRefutation(const ModeWord& prefix, const Program& program, const Combination& combination) {
    std::vector<mpz_class> integers(problem_.rows());
    mpz_class divisor = 0;
    for (std::size_t k = 0; k < program.rows.size(); ++k) {
      mpz_class& entry = integers[program.rows[k]];
      entry = combination[k] * integers_.scale(program.rows[k]);
      divisor = gcd(divisor, entry);
    }
    ExactVector y(problem_.rows());
    for (int i = 0; i < y.size(); ++i) y[i] = divisor == 0 ? integers[i] : mpz_class(integers[i] / divisor);
    const FarkasVector farkas = MakeFarkasVector(problem_, y);
    const auto gap = FindRefutationGap(problem_, prefix, farkas);
    STICTION_CHECK(!gap, "a Farkas vector of a linear program is wrong: " + gap.value_or(""));
    result_.refuted.push_back({prefix, y});
    known_.push_front(farkas);
    if (known_.size() > kKnown) known_.pop_back();
  }

  Program MakeProgram(const ModeWord& prefix) const {
    Program program;
    std::vector<Relation> relations;
    for (int i = 0; i < layout_.ContactCount(); ++i) {
      const auto& contact = problem_.contacts[i];
      const int row = layout_.NormalRowOf(i);
      const Cone cone = i < static_cast<int>(prefix.size()) ? ConeOf(contact, prefix[i]) : RelaxedCone(contact);
      for (const Cone::Edge& edge : cone.edges) {
        program.variables.emplace_back(row, edge);
        program.system.free.push_back(edge.free);
      }
      const auto add_row = [&](int index, Relation relation) {
        if (relation == Relation::kFree) return;
        program.rows.push_back(index);
        relations.push_back(relation);
      };
      add_row(row, cone.a_n);
      if (contact.HasFrictionRows()) add_row(row + 1, cone.a_t);
    }
    for (std::size_t k = 0; k < program.rows.size(); ++k) {
      const int i = program.rows[k];
      LinearSystem::Row& row =
          program.system.rows.emplace_back(LinearSystem::Row{{}, integers_.Constant(i), relations[k]});
      for (const auto& [normal, edge] : program.variables) {
        row.coefficients.push_back(integers_.Coefficient(i, normal, edge));
      }
    }
    return program;
  }

  ExactVector ForceOf(const Program& program, const Point& x) const {
    ExactVector f = ExactVector::Constant(problem_.rows(), Rational(0));
    for (std::size_t k = 0; k < x.size(); ++k) {
      const auto& [row, edge] = program.variables[k];
      f[row] += x[k];
      if (edge.f_t != 0) f[row + 1] += edge.f_t * x[k];
    }
    return f;
  }

  void AddSolution(const ModeWord& word, const Witness& witness) {
    const auto violation = FindViolation(problem_, witness.f);
    STICTION_CHECK(!violation, "a mode has a solution that breaks a law: " + violation.value_or(""));
    result_.solutions.push_back({word, witness.f, IsUnique(word, witness.f)});
  }

  // Coordinates of f along the edges of the word; they are unique, since edges of a contact are independent.
  bool IsUnique(const ModeWord& word, const ExactVector& f) const {
    const Program program = MakeProgram(word);
    Point x;
    for (std::size_t k = 0; k < program.variables.size(); ++k) {
      const auto& [row, edge] = program.variables[k];
      const bool second = k > 0 && program.variables[k - 1].first == row;
      const bool two = second || (k + 1 < program.variables.size() && program.variables[k + 1].first == row);
      x.push_back(two ? Rational((f[row] + f[row + 1] / edge.f_t) / 2) : f[row]);
    }
    return IsOnlySolution(program.system, x);
  }

  void Report(double share) {
    if (Ended()) return;
    result_.decided += share;
    if (request_.limits.Stopped() || (watch_ && !watch_(result_))) result_.end = EnumerationEnd::kStopped;
  }

  static constexpr std::size_t kKnown = 64;  // Farkas vectors tried again

  const ExactProblem& problem_;
  const Request& request_;
  const EnumerationWatch& watch_;
  RowLayout<Eigen::Dynamic> layout_;
  IntegerRows integers_;
  std::deque<FarkasVector> known_;  // the latest first
  Enumeration result_;
};

}  // namespace

Enumeration EnumerateModes(const ExactProblem& problem, const Request& request, const EnumerationWatch& watch) {
  if (problem.dimension != 2) {
    throw InputError(fmt::format("method enumerate: a problem of dimension {}, expected 2", problem.dimension));
  }
  return Enumerator(problem, request, watch).Run();
}

}  // namespace stiction
