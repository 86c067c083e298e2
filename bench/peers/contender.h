// SPDX-License-Identifier: Apache-2.0
// Contenders of the peers' table: one solver each, of stiction or of a package that was found at build time.

#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "solver/problem/problem.h"

namespace stiction {

using PeerProblem = ContactProblem<double>;

// Problems of one size at a time.
class Contender {
 public:
  virtual ~Contender() = default;
  // Brings the problems into the contender's form; not timed. They outlive the contender.
  virtual void Load(const std::vector<PeerProblem>& problems) = 0;
  // Solves problem `index`; timed. Returns whether the contender claims success. What the contender destroys
  // of its data is restored here.
  virtual bool Solve(int index) = 0;
  // Forces of the last call of Solve; not timed.
  virtual Eigen::VectorXd Forces() const = 0;
  // Of several methods the one that made them; empty where there is but one.
  virtual std::string_view AnsweredBy() const { return {}; }
};

// Dantzig's pivoting with an updated factorization, the descendant of [Baraff94]. `friction`: by the friction
// index of these libraries, which is not Coulomb's law; `cfm`: dantzig.h. Null where the package is
// missing.
std::unique_ptr<Contender> MakeOde(bool friction, double cfm);  // libode-dev
std::unique_ptr<Contender> MakeDart(bool friction);             // libdart-external-odelcpsolver-dev
std::unique_ptr<Contender> MakeBullet(bool friction);           // libbullet-dev
std::unique_ptr<Contender> MakeBulletLemke();                   // likewise; Lemke's method without friction
// libsiconos-numerics-dev
enum class SiconosMethod {
  kLcpLemke,
  kFriction2dNsgs,
  kFriction2dLemke,
  kPlanarLcp,  // Lemke's method on the complementarity problem of planar friction, made beforehand
  kFriction3dNsgs,
  kFriction3dNewton,
  kFriction3dHybrid,  // Newton's method from where extragradient steps end
};
std::unique_ptr<Contender> MakeSiconos(SiconosMethod method);

std::unique_ptr<Contender> MakeOurs();  // of this suite, as a library under test

}  // namespace stiction
