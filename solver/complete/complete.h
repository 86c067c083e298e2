// SPDX-License-Identifier: Apache-2.0
// Complete driving: the published algorithm made finite. It folds and descends, and never gives up.
//
// Solves (15), (16) of [Baraff94] for frictionless and planar static contacts, and the law of contacts in space
// with the disc of friction replaced by a polygon (polygon.h): fF is a point of mu fN times the polygon at
// which fF.aF is least. Contacts are established one after the other, the normal force first, then friction.
// While one is driven those before it keep their laws, and the path of (f, a) is a polygonal line. Where it
// turns back, the driven force decreases (a fold: the reduced determinant changes its sign); where that force
// is back at zero, what was established before it is driven again (a descent). complete_driving.md has the
// proof.
//
// Cells (cells.h) are data: the forces that are unknown and the accelerations that rest (linear/unknowns.h),
// and facets, linear functions that are not negative in the cell, each with the cell beyond. Everything else is
// one loop, and the plane is the case of a polygon with two corners, +1 and -1.
//
// Stages: contacts before i in their cells, forces after i zero, contact i on its way:
//
//   normal     fN >= 0 >= aN, fF = 0
//   friction   aN = 0, fF obeys the law with the radius rho for mu fN, 0 <= rho <= mu fN
//
// A facet is where one of these inequalities is an equation: a cell of a finished contact ends at the next one,
// a stage at its end (on to the next variable) or at its start (a descent). In the plane a friction stage ends
// where aF is zero, too: nothing would move but rho.
//
// Bilateral contacts are held from the start. Of dependent ones the later stay without a force.
//
// Ties       and zero signs are told by a symbolic perturbation of b, evaluated where they occur (part
//            5): nothing is assumed of A, b, mu.
//            Over inexact scalars what is within tolerance ties; whatever then contradicts the theory,
//            or leaves a residual, is undecided.
// Exact      A positive semidefinite and b in range(A), no sliding contact: ends in `solved`, after at most one
//            piece per cell.
// Shapes     f, a: rows x 1. Units: f in N, a in m/s^2.
// Step size  as procedure maxstep, but not step_size.h: all facets of the stage limit a step in both
//            directions, and a tie is told by linear functions of b, not by a fixed order.
// Plane      Only the values of facets are written twice (PlanarValue, SpatialValue): in the plane each is
//            a row of f or a, or mu fN -+ fF, of a kind known to the compiler. Cells, unknowns, stages and
//            ties are the same. Over doubles that leaves two contacts about a fifth slower than a program for
//            the plane alone was, since unknowns are kept as combinations; four and more are as fast.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "solver/complete/cells.h"
#include "solver/complete/polygon.h"
#include "solver/linear/direction.h"
#include "solver/problem/enclosure.h"
#include "solver/problem/solution.h"

namespace stiction {

// Counts of a run.
inline const Counters kCompleteCounters = {Counter::kPieces, Counter::kFolds, Counter::kDescents,
                                           Counter::kTies, Counter::kStages};

// Of a request tolerances, limits.pivots, which bounds the pieces, and limits.stop are read: the cells bound
// the stages, and Cramer's rule the bits. `residual` is the largest error (problem/errors.h) of an inexact
// answer that is called solved.
//
// Reusable. Memory is kept between runs.
template <class Scalar, int Rows = Eigen::Dynamic>
class CompleteDriving {
 public:
  using Problem = ContactProblem<Scalar, Rows>;
  using Vector = typename Problem::Vector;
  using Polygons = std::vector<FrictionPolygon<Scalar>>;

  explicit CompleteDriving(const Request& request = {}) : request_(request) {}

  Request& request() { return request_; }
  // Unknowns from which on direction systems are updated (linear/updated_system.h).
  void UpdateFrom(int unknowns) { update_from_ = unknowns; }

  // Runs from f = 0. Requires a planar problem of frictionless and static contacts (PublishedHandles).
  // Errors: an exact run that breaks the theory is an InternalError.
  //
  // A pivot of the trace is a linear piece: `drive` counts stages; in a friction stage the driven contact is in
  // a cell of its word, in a normal's stage in none; no variable limits a ray (-1). Sets are those of the
  // plane, and there a stage that ends at its start is the driven variable going from none to none.
  RunEnd<> Run(const Problem& problem, Trace<Scalar>* trace = nullptr);

  // Requires a problem of dimension 3, and a polygon per contact, read for static contacts with mu > 0 only.
  RunEnd<> Run(const Problem& problem, const Polygons& polygons,
               Trace<Scalar>* trace = nullptr) requires(Rows == Eigen::Dynamic);

  // Over enclosures: as PublishedAlgorithm::KnowDependentRows.
  void KnowDependentRows(DependentRows* rows) { dependent_rows_ = rows; }

  // The state in which the last run ended.
  const Vector& f() const { return f_; }
  const Vector& a() const { return a_; }
  // For the outcome `ray` of an exact run with A symmetric and positive semidefinite: v in K with A v = 0 and
  // b.v < 0, so that b is not in range(A).
  const Vector& ray() const { return ray_; }
  const DirectionSystem<Scalar, Rows>& direction() const { return direction_; }
  // The cell of every contact; none for contacts that the run did not finish.
  const CellWord& word() const { return word_; }
  // Their names: without blanks in the plane.
  std::string Word() const;
  // The cells of all stages, which bound the pieces of the last run.
  std::int64_t most_pieces() const { return most_pieces_; }
  // In the plane.
  Cell CellOf(int contact) const { return PlanarCell(word_[contact]); }

 private:
  using Row = Eigen::Matrix<Scalar, 1, Eigen::Dynamic>;

  enum class Stage : std::uint8_t { kNormal, kFriction };

  using Kind = Facet::Kind;

  // A facet ahead, and the distance to it along the direction.
  struct Candidate {
    Facet facet;
    Scalar rate = Scalar(0);  // > 0: how fast the facet's function decreases
    Scalar s = Scalar(0);
  };

  RunEnd<> Follow(const Problem& problem, const Polygons* polygons, Trace<Scalar>* trace);
  void Start(const Problem& problem, const Polygons* polygons, Trace<Scalar>* trace);
  void HoldBilateral();
  bool Ended() const { return ended_; }
  void End(Outcome outcome, std::string_view reason = {});
  std::int64_t MostPieces() const;
  void Solved();
  bool SolveLastWord(const Scalar& tolerance);
  void ComputeAccelerations();
  Scalar Residual() const;
  void Unlimited(int sign = 1);
  void Impossible(const char* what);

  // Cells.
  bool InSpace() const { return polygons_ != nullptr; }
  int RowOf(int contact) const { return layout_.NormalRowOf(contact); }
  int Size(int contact) const;
  bool IsBilateral(int contact) const { return problem_->contacts[contact].kind == ContactKind::kBilateral; }
  bool HasFriction(int contact) const;
  bool FrictionIsDriven(int contact) const { return contact == driven_ && stage_ == Stage::kFriction; }
  void SetCell(int contact, LawCell cell);
  void SetUnknowns(int contact, LawCell cell);
  void SetDriven();
  void SetFreeForce(int contact, RowCombination<Scalar>& force) const;
  void SetCornerForce(int contact, int k, RowCombination<Scalar>& force) const;
  void SetRadial(int contact, int k, RowCombination<Scalar>& force) const;
  template <class Visit>
  void ForEachFacet(int contact, Visit visit) const;
  template <class Visit>
  void ForEachCornerFacet(int contact, int k, Visit visit) const;

  // Nodes: between stages.
  void Up();
  void Down();
  void DownToStick(int contact);
  void EnterNormal();
  void EnterFriction(LawCell cell, const Scalar& radius);
  void FinishDriven(LawCell cell);
  Facet DrivenAmount() const;
  Facet StageEnd() const;
  int CornerAt(int contact, const Facet& at);

  // One stage: its pieces.
  void TraceStage(Facet entry);
  int Direction();
  void CollectFacets();
  template <class OfKind>
  void Offer(OfKind kind, const Facet& facet);
  int Nearest(const Facet& entry);
  void Advance(const Scalar& s);
  void Snap(const Facet& reached);
  void SnapToCells();
  void EndStage(const Facet& reached);
  Facet Cross(const Facet& reached);
  bool BudgetSpent();
  bool IsFinite() const;
  void Record(int determinant, PathTurn turn);
  void RecordEnd(const Candidate& reached);
  std::vector<IndexSet> Sets() const;

  // Values of facet functions, and their signs under the perturbation.
  template <class Force, class Acceleration>
  Scalar Evaluate(const Facet& facet, Force f, Acceleration a, const Scalar& radius) const;
  Scalar Value(const Facet& facet, const Vector& f, const Vector& a, const Scalar& radius) const {
    return InSpace() ? SpatialValue(facet, f, a, radius) : PlanarValue(facet.kind, facet, f, a, radius);
  }
  Scalar SpatialValue(const Facet& facet, const Vector& f, const Vector& a, const Scalar& radius) const;
  template <class OfKind>
  Scalar PlanarValue(OfKind kind, const Facet& facet, const Vector& f, const Vector& a,
                     const Scalar& radius) const;
  Scalar Present(const Facet& facet) const { return Value(facet, f_, a_, rho_); }
  template <class At>
  Scalar Outward(int contact, int k, At at) const;
  int SignAt(const Facet& at, const Facet& of);
  // Rates of change with b: of `facet` at the point of the present cell on the facet `at`.
  Row Gradient(const Facet& at, const Facet& of) const;
  Scalar Coefficient(const Facet& facet, const RowCombination<Scalar>& force, bool driven) const;
  void AddGradient(const Facet& facet, const Scalar& factor, Row& gradient) const;
  int FirstSign(const Row& gradient, bool of_acceleration) const;

  Request request_;
  int update_from_ = kUpdateFrom;
  const Problem* problem_ = nullptr;
  const Polygons* polygons_ = nullptr;  // null in the plane
  Trace<Scalar>* trace_ = nullptr;
  RowLayout<Rows> layout_;
  Scale<Scalar> scale_;
  DirectionSystem<Scalar, Rows> direction_;
  DependentRows* dependent_rows_ = nullptr;

  Vector f_, a_, ray_;
  Scalar rho_ = Scalar(0);   // of a friction stage
  Scalar rate_ = Scalar(0);  // of the driven amount, fN or rho, along the direction
  CellWord word_;
  ListedUnknowns<Scalar, Rows> unknowns_;

  RunEnd<> verdict_;
  std::int64_t most_pieces_ = 0;
  bool ended_ = false;
  bool up_ = true;
  int driven_ = 0;  // contact, or their number at the end
  Stage stage_ = Stage::kNormal;
  std::vector<Candidate> candidates_;
  std::vector<Scalar> may_be_ahead_;  // over enclosures: facets of unsure rates, not reached before
};

}  // namespace stiction
