// SPDX-License-Identifier: Apache-2.0
// Complete driving: the published algorithm made finite. It folds and descends, and never gives up.
//
// Solves (15), (16) of [Baraff94] for frictionless and planar static contacts. Variables are driven in row
// order. While variable v is driven the earlier ones keep their laws, and the path of (f, a) is a polygonal
// line. Where it turns back, f_v decreases (a fold: the reduced determinant changes its sign); where f_v
// is back at zero, the variable before v is driven again (a descent). complete_driving.md has the proof.
//
// Cells: the law of a finished contact is a union of convex cones, and in each of them all is linear.
//
//   B  break   fN = fF = 0, aN >= 0             NC, friction suspended
//   S  stick   aN = aF = 0, abs(fF) <= mu fN    C, CF
//   +  upper   aN = 0, fF = mu fN, aF <= 0      C, NC+
//   -  lower   aN = 0, fF = -mu fN, aF >= 0     C, NC-
//   0  free    aN = 0, fN >= 0, fF = 0          C, friction suspended: mu = 0, or no friction row
//
// Stages: contacts before v in their cells, forces after v zero, the driven variable on its way:
//
//   v normal     fN >= 0, aN <= 0, fF = 0
//   v friction   aN = 0, 0 <= side fF <= mu fN, side aF <= 0      for side = +1 or -1
//
// A facet is where one of these inequalities is an equation: a cell of a finished contact ends at the next
// one, a stage at its end (on to the next variable) or at its start (a descent).
//
// Ties       and zero signs are told by a symbolic perturbation of b, evaluated where they occur (part
//            5): nothing is assumed of A, b, mu.
//            Over inexact scalars what is within tolerance ties; whatever then contradicts the theory,
//            or leaves a residual, is undecided.
// Exact      A positive semidefinite and b in range(A) end in `solved`, after at most one piece per cell.
// Shapes     f, a: rows x 1. Units: f in N, a in m/s^2.
// Step size  as procedure maxstep, but not step_size.h: all facets of the stage limit a step in both
//            directions, and a tie is told by linear functions of b, not by a fixed order.

#ifndef STICTION_SOLVER_COMPLETE_COMPLETE_H_
#define STICTION_SOLVER_COMPLETE_COMPLETE_H_

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "solver/linear/direction.h"
#include "solver/problem/solution.h"

namespace stiction {

// limits.pivots bounds the pieces; the other limits are not read: the cells bound the stages, and Cramer's
// rule the bits. `residual` is the largest natural residual of an inexact answer that is called solved.
struct CompleteOptions {
  Tolerances tolerances;
  Limits limits;
  double residual = 1e-8;
  int update_from = kUpdateFrom;

  bool operator==(const CompleteOptions&) const = default;
};

// Counters of one run.
struct CompleteStatistics {
  std::int64_t pieces = 0;
  std::int64_t folds = 0;
  std::int64_t descents = 0;
  std::int64_t ties = 0;
  std::int64_t stages = 0;

  bool operator==(const CompleteStatistics&) const = default;
};

// visit(name, help, counter)
template <class S, class Visit>
requires std::is_same_v<std::remove_const_t<S>, CompleteStatistics>
void ForEachField(S& s, Visit visit) {
  visit("pieces", "linear pieces of the path", s.pieces);
  visit("folds", "points of a stage where the driven force turns", s.folds);
  visit("descents", "returns of a driven force to zero", s.descents);
  visit("ties", "times the perturbation of b was consulted", s.ties);
  visit("stages", "stages entered", s.stages);
}

// One linear piece of the path. The pivot: `drive` counts stages; a stage that ends at its start (a descent)
// is the driven variable going from none to none; a contact that opens or closes is named by its normal; no
// variable limits a ray (-1).
template <class Scalar>
struct Piece : Pivot<Scalar> {
  std::vector<IndexSet> cell;  // sets during the piece; Pivot::sets are those after it
  int side = 1;                // of a friction stage
};

template <class Scalar>
using Path = std::vector<Piece<Scalar>>;

struct CompleteVerdict {
  Outcome outcome = Outcome::kUndecided;  // solved, ray, limit, undecided
  std::string_view reason;                // which limit, or why undecided; static text
  CompleteStatistics statistics;
};

enum class Cell : std::uint8_t { kNone, kBreak, kStick, kUpper, kLower, kFree };
inline constexpr std::array<char, 6> kCellNames = {'?', 'B', 'S', '+', '-', '0'};

inline constexpr char Name(Cell cell) { return kCellNames[static_cast<int>(cell)]; }

// A linear function of (f, a) that is not negative in a cell or stage, and zero on one of its facets.
struct Facet {
  enum class Kind : std::uint8_t {
    kForce,         // sign f
    kAcceleration,  // sign a
    kBound,         // mu fN - sign fF; row is the friction row
  };
  Kind kind = Kind::kForce;
  int row = 0;
  int sign = 1;
};

// Reusable. Memory is kept between runs.
template <class Scalar, int Rows = Eigen::Dynamic>
class CompleteDriving {
 public:
  using Problem = ContactProblem<Scalar, Rows>;
  using State = ContactState<Scalar, Rows>;
  using Vector = typename Problem::Vector;

  explicit CompleteDriving(const CompleteOptions& options = {}) : options_(options) {}

  CompleteOptions& options() { return options_; }

  // Runs from f = 0. Requires a planar problem of frictionless and static contacts (PublishedHandles).
  // Errors: an exact run that breaks the theory is an InternalError.
  CompleteVerdict Run(const Problem& problem, Path<Scalar>* path = nullptr);

  // The state in which the last run ended.
  const State& state() const { return state_; }
  // For the outcome `ray` of an exact run with A symmetric and positive semidefinite: v in K with A v = 0 and
  // b.v < 0, so that b is not in range(A).
  const Vector& ray() const { return direction_.df(); }
  const DirectionSystem<Scalar, Rows>& direction() const { return direction_; }
  // The word: the cell of every contact; kNone for contacts that the run did not finish.
  Cell CellOf(int contact) const;
  std::string Word() const;

 private:
  using Row = Eigen::Matrix<Scalar, 1, Eigen::Dynamic>;

  // A facet ahead, and the distance to it along the direction.
  struct Candidate {
    Facet facet;
    Scalar rate = Scalar(0);  // > 0: how fast the facet's function decreases
    Scalar s = Scalar(0);
  };

  void Start(const Problem& problem, Path<Scalar>* path);
  bool Ended() const { return ended_; }
  void End(Outcome outcome, std::string_view reason = {});
  std::int64_t MostPieces() const;
  void Solved();
  void Unlimited();
  void Impossible(const char* what);

  // Nodes: between stages.
  void Up();
  void Down();
  void DownToContactBefore();
  void Release(int row, int side, const Facet& entry);

  // One stage: its pieces.
  void TraceStage(Facet entry);
  void CollectFacets();
  void Offer(const Facet& facet);
  int Nearest(const Facet& entry);
  void Advance(const Candidate& reached);
  void Snap(const Facet& reached);
  void Record(int determinant);
  void RecordEnd(const Candidate& reached);
  void EndStage(const Facet& reached);
  Facet Cross(const Facet& reached);
  Facet Close(int normal);
  Facet Open(int normal);
  bool BudgetSpent();
  bool IsFinite() const;

  // Values of facet functions, and their signs under the perturbation.
  Facet DrivenForce() const { return {Facet::Kind::kForce, driven_, side_}; }
  Scalar Value(const Facet& facet, const Vector& f, const Vector& a) const;
  int SignAt(const Facet& at, const Facet& of);
  // Rates of change with b: of `facet` at the point of the present cell on the facet `at`.
  Row Gradient(const Facet& at, const Facet& of) const;
  Scalar ForceCoefficient(int row, int column) const;
  Scalar Coefficient(const Facet& facet, int column) const;
  int FirstSign(const Row& gradient, Facet::Kind kind) const;

  CompleteOptions options_;
  const Problem* problem_ = nullptr;
  Path<Scalar>* path_ = nullptr;
  RowLayout<Rows> layout_;
  Scale<Scalar> scale_;
  DirectionSystem<Scalar, Rows> direction_;

  State state_;
  CompleteVerdict verdict_;
  std::int64_t most_pieces_ = 0;
  bool ended_ = false;
  int driven_ = 0;  // row, or the number of rows at the end
  int side_ = 1;    // of a friction stage; 1 in a normal stage
  bool up_ = true;
  std::vector<Candidate> candidates_;
};

}  // namespace stiction

#endif  // STICTION_SOLVER_COMPLETE_COMPLETE_H_
