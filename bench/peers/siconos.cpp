// SPDX-License-Identifier: Apache-2.0
// Siconos: Lemke's method on the frictionless problem; in the plane Gauss-Seidel to 1e-9 and Lemke's method; in
// space Gauss-Seidel and Newton's method on the map of Alart and Curnier, both to 1e-9.

#include "bench/peers/contender.h"

#ifdef STICTION_PEER_SICONOS
#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <LCP_Solvers.h>
#include <LinearComplementarityProblem.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <NumericsVerbose.h>
#include <SolverOptions.h>
#include <lcp_cst.h>

#include <cstdlib>
#endif

namespace stiction {

#ifdef STICTION_PEER_SICONOS
namespace {

constexpr double kTolerance = 1e-9;
constexpr int kIterations = 100000;

int SolverId(SiconosMethod method) {
  switch (method) {
    case SiconosMethod::kFriction2dNsgs:
      return SICONOS_FRICTION_2D_NSGS;
    case SiconosMethod::kFriction2dLemke:
      return SICONOS_FRICTION_2D_LEMKE;
    case SiconosMethod::kFriction3dNsgs:
      return SICONOS_FRICTION_3D_NSGS;
    case SiconosMethod::kFriction3dNewton:
    case SiconosMethod::kFriction3dHybrid:
      return SICONOS_FRICTION_3D_NSN_AC;
    default:
      return SICONOS_LCP_LEMKE;
  }
}

// As the solvers of friction take it: with rows of friction at every contact. Those that a frictionless contact
// lacks are coupled with nothing, and mu = 0. `rows`: where each row of the problem is.
PeerProblem WithAllRows(const PeerProblem& problem, std::vector<int>& rows) {
  PeerProblem whole;
  whole.dimension = problem.dimension;
  whole.contacts = problem.contacts;
  const int size = problem.dimension * static_cast<int>(problem.contacts.size());
  whole.A = Eigen::MatrixXd::Identity(size, size);
  whole.b = Eigen::VectorXd::Zero(size);
  rows.clear();
  for (int row = 0; row < size; ++row)
    if (row % problem.dimension == 0 || problem.contacts[row / problem.dimension].HasFrictionRows())
      rows.push_back(row);
  whole.A(rows, rows) = problem.A;
  whole.b(rows) = problem.b;
  return whole;
}

// Static friction of the plane as a complementarity problem w = M z + q, three unknowns a contact:
//   z = (fN, fF + mu fN, aF-)   w = (aN, aF+, mu fN - fF),   aF = aF+ - aF-
PeerProblem PlanarLcp(const PeerProblem& problem) {
  const int contacts = static_cast<int>(problem.contacts.size());
  PeerProblem lcp;
  lcp.A = Eigen::MatrixXd::Zero(3 * contacts, 3 * contacts);
  lcp.b = Eigen::VectorXd::Zero(3 * contacts);
  for (int i = 0; i < contacts; ++i) {
    for (int row = 0; row < 2; ++row) {
      lcp.b[3 * i + row] = problem.b[2 * i + row];
      for (int j = 0; j < contacts; ++j) {
        const double along = problem.A(2 * i + row, 2 * j + 1);
        lcp.A(3 * i + row, 3 * j) = problem.A(2 * i + row, 2 * j) - problem.contacts[j].mu * along;
        lcp.A(3 * i + row, 3 * j + 1) = along;
      }
    }
    lcp.A(3 * i + 1, 3 * i + 2) = 1;
    lcp.A(3 * i + 2, 3 * i) = 2 * problem.contacts[i].mu;
    lcp.A(3 * i + 2, 3 * i + 1) = -1;
  }
  return lcp;
}

class SiconosContender : public Contender {
 public:
  explicit SiconosContender(SiconosMethod method) : method_(method) { numerics_set_verbose(0); }

  void Load(const std::vector<PeerProblem>& problems) override {
    loaded_ = std::vector<Loaded>(problems.size());
    for (std::size_t k = 0; k < problems.size(); ++k) {
      PeerProblem problem = problems[k];
      if (method_ != SiconosMethod::kLcpLemke) problem = WithAllRows(problem, loaded_[k].given);
      for (const auto& contact : problem.contacts) loaded_[k].mu.push_back(contact.mu);
      if (method_ == SiconosMethod::kPlanarLcp) problem = PlanarLcp(problem);
      loaded_[k].A = std::move(problem.A);
      loaded_[k].b = std::move(problem.b);
      const int rows = static_cast<int>(loaded_[k].b.size());
      loaded_[k].matrix.reset(NM_create_from_data(NM_DENSE, rows, rows, loaded_[k].A.data()));
    }
    const int rows = static_cast<int>(loaded_.front().b.size());
    if (rows != rows_) ResetOptions();
    rows_ = rows;
    f_.resize(rows_);
    a_.resize(rows_);
  }

  bool Solve(int k) override {
    Loaded& of = loaded_[k];
    solved_ = k;
    f_.setZero();
    a_.setZero();
    int info = 0;
    if (IsLcp()) {
      LinearComplementarityProblem lcp = {rows_, of.matrix.get(), of.b.data()};
      lcp_lexicolemke(&lcp, f_.data(), a_.data(), &info, options_.get());
    } else {
      const bool plane =
          method_ == SiconosMethod::kFriction2dNsgs || method_ == SiconosMethod::kFriction2dLemke;
      const int dimension = plane ? 2 : 3;
      FrictionContactProblem problem = {dimension, rows_ / dimension, of.matrix.get(), of.b.data(),
                                        of.mu.data()};
      const auto driver = plane ? fc2d_driver : fc3d_driver;
      info = driver(&problem, f_.data(), a_.data(), options_.get());
    }
    return info == 0;
  }

  Eigen::VectorXd Forces() const override {
    if (method_ == SiconosMethod::kLcpLemke) return f_;
    const std::vector<int>& given = loaded_[solved_].given;
    return (method_ == SiconosMethod::kPlanarLcp ? ForcesOfPlanarLcp() : f_)(given);
  }

 private:
  // What a method keeps in them between problems is of the size of the first. Not anew for each problem:
  // Siconos 4.4.0 keeps 120 bytes of options that are deleted.
  void ResetOptions() {
    const bool is_newton =
        method_ == SiconosMethod::kFriction3dNewton || method_ == SiconosMethod::kFriction3dHybrid;
    options_.reset(solver_options_create(SolverId(method_)));
    if (IsLcp() || method_ == SiconosMethod::kFriction2dLemke) return;
    options_->dparam[SICONOS_DPARAM_TOL] = kTolerance;
    if (method_ == SiconosMethod::kFriction3dHybrid)
      options_->iparam[SICONOS_FRICTION_3D_NSN_HYBRID_STRATEGY] =
          SICONOS_FRICTION_3D_NSN_HYBRID_STRATEGY_VI_EG_NSN;
    if (!is_newton) options_->iparam[SICONOS_IPARAM_MAX_ITER] = kIterations;
  }

  Eigen::VectorXd ForcesOfPlanarLcp() const {
    const std::vector<double>& mu = loaded_[solved_].mu;
    Eigen::VectorXd f(2 * mu.size());
    for (std::size_t i = 0; i < mu.size(); ++i) {
      f[2 * i] = f_[3 * i];
      f[2 * i + 1] = f_[3 * i + 1] - mu[i] * f_[3 * i];
    }
    return f;
  }

  bool IsLcp() const { return method_ == SiconosMethod::kLcpLemke || method_ == SiconosMethod::kPlanarLcp; }

  struct Release {
    void operator()(NumericsMatrix* matrix) const { std::free(NM_free_not_dense(matrix)); }
    void operator()(SolverOptions* options) const { solver_options_delete(options); }
  };
  struct Loaded {
    Eigen::MatrixXd A;
    Eigen::VectorXd b;
    std::vector<double> mu;
    std::vector<int> given;  // rows that the problem has; none of Lemke's method without friction
    std::unique_ptr<NumericsMatrix, Release> matrix;  // over the entries of A
  };

  SiconosMethod method_;
  std::unique_ptr<SolverOptions, Release> options_;
  std::vector<Loaded> loaded_;
  int rows_ = 0, solved_ = 0;
  Eigen::VectorXd f_, a_;
};

}  // namespace
std::unique_ptr<Contender> MakeSiconos(SiconosMethod method) {
  return std::make_unique<SiconosContender>(method);
}
#else
std::unique_ptr<Contender> MakeSiconos(SiconosMethod) { return nullptr; }
#endif

}  // namespace stiction
