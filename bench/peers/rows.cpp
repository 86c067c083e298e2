// SPDX-License-Identifier: Apache-2.0
// The rows of the peers' tables: linear solvers, the packages, and stiction's own methods.

#include "bench/peers/rows.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <type_traits>

#include "bench/peers/native_lu.h"
#include "bench/peers/plain_gauss.h"
#include "certify/exact/answer_json.h"
#include "solver/complete/complete.h"
#include "solver/lemke/lemke.h"
#include "solver/numeric/coulomb.h"
#include "solver/numeric/fast.h"
#include "solver/published/published.h"
#include "solver/solve.h"

namespace stiction {
namespace {

// ---- Contenders ------------------------------------------------------------------------------

class OneOfOurs : public Contender {
 public:
  void Load(const std::vector<PeerProblem>& problems) override { problems_ = &problems; }

 protected:
  const PeerProblem& At(int k) const { return (*problems_)[k]; }

 private:
  const std::vector<PeerProblem>* problems_ = nullptr;
};

// The linear system A x = -b.
template <class Factorization>
class LinearContender : public OneOfOurs {
 public:
  bool Solve(int k) override {
    factorization_.compute(At(k).A);
    x_ = factorization_.solve(-At(k).b);
    return true;
  }
  Eigen::VectorXd Forces() const override { return x_; }

 private:
  Factorization factorization_;
  Eigen::VectorXd x_;
};

class NativeLuContender : public OneOfOurs {
 public:
  bool Solve(int k) override {
    x_.resize(At(k).rows());
    lu_.Solve(At(k).rows(), At(k).A.data(), At(k).b.data(), x_.data());
    return true;
  }
  Eigen::VectorXd Forces() const override { return x_; }

 private:
  NativeLu lu_;
  Eigen::VectorXd x_;
};

class GaussContender : public OneOfOurs {
 public:
  bool Solve(int k) override {
    gauss_.Solve(At(k).A, At(k).b);
    return true;
  }
  Eigen::VectorXd Forces() const override { return gauss_.x(); }

 private:
  PlainGauss gauss_;
};

const Eigen::VectorXd& ForcesOf(const PublishedAlgorithm<double>& solver) { return solver.state().f; }
const Eigen::VectorXd& ForcesOf(const CompleteDriving<double>& solver) { return solver.f(); }
const Eigen::VectorXd& ForcesOf(const LemkeAlgorithm<double>& solver) { return solver.f(); }
const Eigen::VectorXd& ForcesOf(const FastSolver<double>& solver) { return solver.f(); }
const Eigen::VectorXd& ForcesOf(const CoulombSolver<double>& solver) { return solver.f(); }

// A method that keeps its memory between problems.
template <class Solver>
class SolverContender : public OneOfOurs {
 public:
  explicit SolverContender(Solver solver = Solver()) : solver_(std::move(solver)) {}
  bool Solve(int k) override { return solver_.Run(At(k)).outcome == Outcome::kSolved; }
  Eigen::VectorXd Forces() const override { return ForcesOf(solver_); }

 private:
  Solver solver_;
};

// The library's one call, memory and gate included.
class CallContender : public OneOfOurs {
 public:
  explicit CallContender(std::string method) : method_(std::move(method)) {}
  bool Solve(int k) override {
    answer_ = stiction::Solve(At(k), {.method = method_});
    return answer_.Solved();
  }
  Eigen::VectorXd Forces() const override { return answer_.f; }
  std::string_view AnsweredBy() const override {
    return method_ == kAutomatic ? stiction::AnsweredBy(answer_.method, answer_.counters) : std::string_view();
  }

 private:
  std::string method_;
  Answer<double> answer_;
};

// Complete driving on polygons of eight sides: another law, whose solutions are within some 27 degrees
// of Coulomb's (solver/complete/complete_driving.md, 9).
class PolygonContender : public OneOfOurs {
 public:
  void Load(const std::vector<PeerProblem>& problems) override {
    OneOfOurs::Load(problems);
    polygons_.assign(problems.front().contacts.size(), FrictionPolygon<double>(8));
  }
  bool Solve(int k) override { return driving_.Run(At(k), polygons_).outcome == Outcome::kSolved; }
  Eigen::VectorXd Forces() const override { return driving_.f(); }

 private:
  std::vector<FrictionPolygon<double>> polygons_;
  CompleteDriving<double> driving_;
};

// ---- Rows ------------------------------------------------------------------------------------

constexpr const char* kSiconos = "libsiconos-numerics-dev";

template <class Linear>
PeerRow LinearRow(const std::string& name) {
  return {name, "", {{"", [] { return std::make_unique<Linear>(); }}}, Judge::kNone};
}

template <class Solver, class... Options>
PeerRow OurRow(const std::string& name, Options... options) {
  return {name, "", {{"", [=] { return std::make_unique<SolverContender<Solver>>(Solver(options...)); }}}};
}

PeerRow CallRow(const std::string& method) {
  return {method, "", {{"", [=] { return std::make_unique<CallContender>(method); }}}};
}

PeerRow SiconosRow(const std::string& name, SiconosMethod method) {
  return {name, kSiconos, {{"", [=] { return MakeSiconos(method); }}}};
}

// Newton's method from f = 0, or from where extragradient steps end.
PeerRow NewtonRow() {
  return {"Siconos NSN-AC 1e-9",
          kSiconos,
          {{"plain", [] { return MakeSiconos(SiconosMethod::kFriction3dNewton); }},
           {"hybrid", [] { return MakeSiconos(SiconosMethod::kFriction3dHybrid); }}}};
}

std::vector<PeerRow> LinearRows() {
  return {LinearRow<LinearContender<Eigen::PartialPivLU<Eigen::MatrixXd>>>("Eigen LU"),
          LinearRow<NativeLuContender>("Eigen LU, native"), LinearRow<GaussContender>("Gauss, plain loops")};
}

// ODE as it is, and with that constraint force mixing of several, ODE's own 1e-10 among them, that answers
// best.
std::vector<PeerRow> DantzigRows(bool friction) {
  const std::string law = friction ? " findex" : "";
  PeerRow mixed = {"ODE" + law + ", CFM", "libode-dev", {}};
  for (const double cfm : {1e-12, 1e-10, 1e-8, 1e-6})
    mixed.settings.push_back({fmt::format("{:.0e}", cfm), [=] { return MakeOde(friction, cfm); }});
  return {
      {"ODE" + law, "libode-dev", {{"", [=] { return MakeOde(friction, 0); }}}},
      mixed,
      {"DART" + law, "libdart-external-odelcpsolver-dev", {{"", [=] { return MakeDart(friction); }}}},
      {"Bullet" + law, "libbullet-dev", {{"", [=] { return MakeBullet(friction); }}}},
  };
}

std::vector<PeerRow> Joined(const std::vector<std::vector<PeerRow>>& lists) {
  std::vector<PeerRow> rows;
  for (const auto& list : lists) rows.insert(rows.end(), list.begin(), list.end());
  return rows;
}

}  // namespace

std::vector<PeerRow> FrictionlessRows() {
  return Joined({LinearRows(),
                 {LinearRow<LinearContender<Eigen::LLT<Eigen::MatrixXd>>>("Eigen LLT")},
                 DantzigRows(false),
                 {SiconosRow("Siconos Lemke", SiconosMethod::kLcpLemke),
                  OurRow<PublishedAlgorithm<double>>("published"), OurRow<CompleteDriving<double>>("complete"),
                  OurRow<FastSolver<double>>("fast"), CallRow("proximal"), CallRow("auto")}});
}

std::vector<PeerRow> PlanarRows() {
  return Joined({LinearRows(),
                 {SiconosRow("Siconos NSGS 1e-9", SiconosMethod::kFriction2dNsgs),
                  SiconosRow("Siconos Lemke", SiconosMethod::kFriction2dLemke)},
                 DantzigRows(true),
                 {OurRow<PublishedAlgorithm<double>>("published"), OurRow<CompleteDriving<double>>("complete"),
                  OurRow<LemkeAlgorithm<double>>("lemke", Request{}, Cover::kUnits),
                  OurRow<FastSolver<double>>("fast"), CallRow("proximal"), CallRow("auto")}});
}

std::vector<PeerRow> SpatialRows() {
  const PeerRow polygons = {
      "polygons", "", {{"", [] { return std::make_unique<PolygonContender>(); }}}, Judge::kClaim};
  return Joined({LinearRows(),
                 {SiconosRow("Siconos NSGS 1e-9", SiconosMethod::kFriction3dNsgs), NewtonRow()},
                 DantzigRows(true),
                 {polygons, OurRow<CoulombSolver<double>>("complete", Request{}, CoulombStart::kComplete),
                  OurRow<CoulombSolver<double>>("fast"), CallRow("auto")}});
}

}  // namespace stiction
