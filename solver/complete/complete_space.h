// SPDX-License-Identifier: Apache-2.0
// Complete driving in space, on friction polygons.
//
// Solves the law of static contacts in space with the disc of friction replaced by a polygon (polygon.h): fF is
// a point of mu fN times the polygon at which fF.aF is least. Contacts are established one after the other, the
// normal force first; then friction, by one scalar: the radius rho of the polygon grows from 0 to mu fN.
// Folds, descents and ties are those of complete.h; complete_driving.md, part 9, has the theory.
//
// Cells of a finished contact, with corners d_k, edges t_k and normals n_k of its polygon:
//
//   B    break    f = 0, aN >= 0
//   Vk   corner   fF = mu fN d_k, aN = 0, aF.t_k >= 0 >= aF.t_(k-1), fN >= 0
//   Ek   edge     fF between mu fN d_k and mu fN d_(k+1), aN = 0, aF = -c n_k, c >= 0
//   I    inside   fF in mu fN times the polygon, aN = aF = 0
//   0    free     fN >= 0, aN = 0, fF = -mu fN slip: no friction, mu = 0, or sliding (24)
//   H    hold     aN = 0, fN of any sign: bilateral
//
// A cell is data: forces are combinations of its columns, accelerations vanish along its rows, and its facets
// are linear functions that are not negative in it, each with the cell beyond. Everything else is one loop.
//
// Bilateral contacts are held from the start. Of dependent ones the later stay without a force.
// Exact      A symmetric positive semidefinite, b in range(A), no sliding contact: ends in `solved`, after at
//            most one piece per cell. Over inexact scalars, what contradicts the theory is undecided.
// Shapes     f, a: rows x 1; one polygon per contact, read for static contacts with mu > 0 only.

#ifndef STICTION_SOLVER_COMPLETE_COMPLETE_SPACE_H_
#define STICTION_SOLVER_COMPLETE_COMPLETE_SPACE_H_

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "solver/complete/complete.h"
#include "solver/complete/polygon.h"
#include "solver/linear/null_vector.h"

namespace stiction {

enum class Law : std::uint8_t { kNone, kHold, kBreak, kFree, kCorner, kEdge, kInside };

struct SpaceCell {
  Law law = Law::kNone;
  int side = 0;  // k of a corner or an edge; 1 of a bilateral contact that depends on those before it

  auto operator<=>(const SpaceCell&) const = default;
};

// "B", "V3", "E0", "I", "0", "H", or "?".
inline std::string Name(const SpaceCell& cell) {
  constexpr std::array<char, 7> kNames = {'?', 'H', 'B', '0', 'V', 'E', 'I'};
  const bool has_side = cell.law == Law::kCorner || cell.law == Law::kEdge;
  return kNames[static_cast<int>(cell.law)] + (has_side ? std::to_string(cell.side) : std::string());
}

using SpaceWord = std::vector<SpaceCell>;  // one cell per contact

// The names of the cells, with blanks between them.
inline std::string Name(const SpaceWord& word) {
  std::string text;
  for (const SpaceCell& cell : word) text += (text.empty() ? "" : " ") + Name(cell);
  return text;
}

enum class SpaceStage : std::uint8_t { kNone, kNormal, kFriction };

// One linear piece of the path.
template <class Scalar>
struct SpacePiece {
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  int driven = 0;  // contact
  SpaceStage stage = SpaceStage::kNone;
  SpaceWord word;       // during the piece; the driven contact has none in a normal's stage
  int determinant = 0;  // sign of the reduced determinant
  Vector df, da;
  Scalar driven_rate = Scalar(0);  // of fN or rho
  Scalar s = Scalar(0);
  bool ends = false;  // the stage, at its end
  bool descends = false;
};

// Reusable. Memory is kept between runs.
template <class Scalar>
class SpatialDriving {
 public:
  using Problem = ContactProblem<Scalar>;
  using Vector = typename Problem::Vector;
  using Polygons = std::vector<FrictionPolygon<Scalar>>;
  using Path = std::vector<SpacePiece<Scalar>>;

  explicit SpatialDriving(const CompleteOptions& options = {}) : options_(options) {}

  CompleteOptions& options() { return options_; }

  // Runs from f = 0. Requires a problem of dimension 3 and a polygon per contact.
  CompleteVerdict Run(const Problem& problem, const Polygons& polygons, Path* path = nullptr);

  const Vector& f() const { return f_; }
  const Vector& a() const { return a_; }
  // The direction of a ray.
  const Vector& ray() const { return df_; }
  const SpaceWord& word() const { return word_; }

 private:
  using Triple = std::array<Scalar, 3>;  // of one contact: normal, then tangential; of one row: normal only
  using Row = Eigen::Matrix<Scalar, 1, Eigen::Dynamic>;

  enum class Beyond : std::uint8_t { kCell, kCorners, kStart, kEnd };

  // force.f_i + radius rho + acceleration.a_i of contact i: not negative in the cell. Either the acceleration
  // or the others vanish.
  struct Facet {
    int contact = 0;
    Triple force = {Scalar(0), Scalar(0), Scalar(0)};
    Triple acceleration = {Scalar(0), Scalar(0), Scalar(0)};
    Scalar radius = Scalar(0);
    bool of_acceleration = false;
    Beyond beyond = Beyond::kCell;  // a cell; one of the corners, by the sign of aF; or an end of the stage
    SpaceCell cell;
  };

  struct Shape {
    std::vector<Triple> columns;
    std::vector<Triple> rows;
    std::vector<Facet> facets;
  };

  // A force per unit of an unknown, or of the driven amount, and its accelerations.
  struct Column {
    int contact = 0;
    Triple force;
    Scalar radius = Scalar(0);
    Vector image;
  };

  struct Equation {
    int contact = 0;
    Triple row;
  };

  struct Candidate {
    const Facet* facet = nullptr;
    Scalar rate = Scalar(0);
    Scalar s = Scalar(0);
  };

  void Start(const Problem& problem, const Polygons& polygons, Path* path);
  void HoldBilateral();
  bool Ended() const { return ended_; }
  void End(Outcome outcome, std::string_view reason = {});
  std::int64_t MostPieces() const;
  void Solved();
  bool SolveLastWord();
  void ComputeAccelerations();
  void Unlimited();
  void Impossible(const char* what);

  // Cells.
  bool HasFriction(int contact) const;
  int Size(int contact) const { return first_row_[contact + 1] - first_row_[contact]; }
  void SetCell(int contact, const SpaceCell& cell);
  Shape ShapeOf(int contact, const SpaceCell& cell) const;
  Triple FreeColumn(int contact) const;

  // Nodes.
  void Up();
  void Down();
  void EnterNormal();
  void EnterFriction(const SpaceCell& cell);
  void FinishDriven(const SpaceCell& cell);
  Facet DrivenAmount() const;
  Facet StageEnd() const;
  int CornerAt(int contact, const Facet& at);

  // One stage.
  void TraceStage(Facet entry);
  int Direction();
  void CollectFacets();
  int Nearest(const Facet& entry);
  void Advance(const Scalar& s);
  Facet Cross(const Facet& reached);
  bool BudgetSpent();
  bool IsFinite() const;
  void Record(int determinant);

  // Linear functions.
  void Assemble();
  Vector Image(int contact, const Triple& force) const;
  Scalar Value(const Facet& facet, const Vector& f, const Vector& a, const Scalar& radius) const;
  Scalar Present(const Facet& facet) const { return Value(facet, f_, a_, rho_); }
  Scalar Along(int contact, const Triple& row, const Vector& values) const;
  Scalar Coefficient(const Facet& facet, const Column& column) const;
  int SignAt(const Facet& at, const Facet& of);
  Row Gradient(const Facet& at, const Facet& of);
  int FirstSign(const Row& gradient, bool of_acceleration) const;

  CompleteOptions options_;
  const Problem* problem_ = nullptr;
  const Polygons* polygons_ = nullptr;
  Path* path_ = nullptr;
  std::vector<int> first_row_;  // by contact, and the number of rows
  Scale<Scalar> scale_;

  Vector f_, a_;
  Scalar rho_ = Scalar(0);  // of a friction stage
  SpaceWord word_;
  std::vector<Shape> shapes_;
  CompleteVerdict verdict_;
  std::int64_t most_pieces_ = 0;
  bool ended_ = false;
  bool up_ = true;
  int driven_ = 0;  // contact, or their number at the end
  SpaceStage stage_ = SpaceStage::kNone;

  std::vector<Column> columns_;  // the driven one last
  std::vector<Equation> equations_;
  Vector df_, da_;
  Scalar driven_rate_ = Scalar(0);
  std::vector<Candidate> candidates_;
};

}  // namespace stiction

#endif  // STICTION_SOLVER_COMPLETE_COMPLETE_SPACE_H_
