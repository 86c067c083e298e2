// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/robust_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "certify/claims/robust.h"
#include "certify/exact/same_run.h"
#include "certify/exact/slope.h"
#include "scene/mechanics.ipp"
#include "scene/rows.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

using Vector = Vector2<Slope>;
using Bodies = std::vector<BodyDynamics<Slope, Plane::kDof>>;
using Rows = std::vector<ConstraintIn<Plane, Slope>>;

// Not below the largest distance of a movable body's centre to one of its contacts.
Interval SizeOf(const TouchingScene& touching) {
  Rational largest = 0;
  for (const auto& contact : touching.contacts) {
    for (const int number : {contact.a, contact.b}) {
      const auto& body = touching.scene.bodies[number];
      if (body.fixed) continue;
      const Vector2<Rational> arm = contact.point - body.position;
      largest = std::max<Rational>(largest, Dot<Rational>(arm, arm));
    }
  }
  return Interval(CGAL::sqrt(Around(largest)).sup());
}

// The numbers of a scene, each off by itself: a new parameter for each.
class Box {
 public:
  Box(const TouchingScene& touching, const Rational& radius)
      : touching_(touching), radius_(Around(radius).sup()), reach_(radius_ * SizeOf(touching)) {
    gravity_ = Turned(touching_.scene.gravity);
    for (const auto& body : touching_.scene.bodies) AddBody(body);
    for (const auto& contact : touching_.contacts) {
      if (!bodies_[contact.a].fixed || !bodies_[contact.b].fixed) AddContact(contact);
    }
  }

  const Bodies& bodies() const { return bodies_; }
  const Rows& constraints() const { return constraints_; }
  ContactProblem<Slope> Problem() const {
    return DenseProblemOf(bodies_, constraints_, FindIslands(bodies_, constraints_, true)[0]);
  }

 private:
  static Slope Number(const Rational& x) { return Slope(Around(x)); }

  // Anywhere in [-by, by].
  Slope Off(const Interval& by) { return Slope::Along(parameters_++, by, {-by.sup(), by.sup()}); }
  Slope Scaled(const Rational& x) { return sgn(x) == 0 ? Slope(0) : Number(x) * (Slope(1) + Off(radius_)); }
  Vector Scaled(const Vector2<Rational>& v) {
    const Slope x = Scaled(v[0]), y = Scaled(v[1]);
    return MakeVector2<Slope>(x, y);
  }
  Vector Moved(const Vector2<Rational>& point) {
    const Slope x = Number(point[0]) + Off(reach_), y = Number(point[1]) + Off(reach_);
    return MakeVector2<Slope>(x, y);
  }

  // By an angle of r e: -r^2 e^2 / 2 <= cos(r e) - 1 <= 0, and sin(r e) = e s with r - r^3 / 6 <= s <= r.
  Vector Turned(const Vector2<Rational>& v) {
    const Interval half_square = square(radius_) / 2, of_sine = radius_ * (1 - half_square / 3);
    const Interval factor(-half_square.sup(), half_square.sup());
    const int angle = parameters_++;
    const Slope cosine = Slope(1) + Slope::Along(angle, factor, {-half_square.sup(), 0});
    const Slope sine = Slope::Along(angle, {of_sine.inf(), radius_.sup()}, {-radius_.sup(), radius_.sup()});
    const Vector given = MakeVector2<Slope>(Number(v[0]), Number(v[1]));
    return Rotate<Slope>(MakeVector2<Slope>(cosine, sine), given);
  }

  void AddBody(const RigidBody<Rational>& body) {
    auto& dynamics = bodies_.emplace_back();
    dynamics.fixed = body.fixed;
    dynamics.W = Zero<decltype(dynamics.W)>();
    dynamics.force = Zero<decltype(dynamics.force)>();
    centres_.push_back(MakeVector2<Slope>(Number(body.position[0]), Number(body.position[1])));
    if (body.fixed) return;
    centres_.back() = Moved(body.position);
    dynamics.W(0, 0) = dynamics.W(1, 1) = Slope(1) / Scaled(body.mass);
    dynamics.W(2, 2) = Slope(1) / Scaled(body.inertia);
    dynamics.force << Scaled(body.force), Scaled(body.torque);
  }

  void AddContact(const TouchPoint<Rational>& contact) {
    const Vector point = Moved(contact.point), normal = Turned(contact.normal);
    const Vector arm_a = point - centres_[contact.a], arm_b = point - centres_[contact.b];
    auto& constraint = constraints_.emplace_back();
    constraint.bodies = {contact.a, contact.b};
    constraint.law.kind = ContactKind::kStatic;
    constraint.law.mu = Scaled(contact.mu);
    for (const Vector& direction : {normal, Quarter<Slope>(normal)}) {
      auto& row = constraint.rows.emplace_back(RowAlong<Plane, Slope>(direction, arm_a, arm_b));
      row.b = Along(direction, contact);
      for (int side = 0; side < 2; ++side)
        row.b += row.J[side].dot(bodies_[constraint.bodies[side]].FreeAcceleration());
    }
  }

  // Gravity between the bodies: none where both fall, whatever it is.
  Slope Along(const Vector& direction, const TouchPoint<Rational>& contact) const {
    if (bodies_[contact.a].fixed == bodies_[contact.b].fixed) return {};
    const Slope along = Dot<Slope>(direction, gravity_);
    return bodies_[contact.b].fixed ? along : -along;
  }

  const TouchingScene& touching_;
  Interval radius_, reach_;
  int parameters_ = 0;
  Vector gravity_;
  Bodies bodies_;  // their forces are without gravity
  std::vector<Vector> centres_;
  Rows constraints_;
};

// What rows know of others in all scenes of a box: three independent rows that do not accelerate hold a body,
// if what is on their other side is held; between bodies that are held nothing accelerates.
class HeldBodies final : public DependentRows {
 public:
  explicit HeldBodies(const Box& box) : bodies_(box.bodies()), constraints_(box.constraints()) {}

  bool Follows(const std::vector<bool>& zero, int row) override {
    std::vector<bool> held;
    for (const auto& body : bodies_) held.push_back(body.fixed);
    for (bool more = true; more;) {
      more = false;
      for (std::size_t body = 0; body < held.size(); ++body) {
        if (held[body] || !IsHeld(static_cast<int>(body), zero, held)) continue;
        held[body] = more = true;
      }
    }
    const auto [a, b] = constraints_[row / 2].bodies;
    return held[a] && held[b];
  }

 private:
  using Row = Eigen::Matrix<Slope, Plane::kDof, 1>;

  bool IsHeld(int body, const std::vector<bool>& zero, const std::vector<bool>& held) const {
    std::vector<const Row*> rows;
    for (std::size_t i = 0; i < zero.size(); ++i) {
      const auto& constraint = constraints_[i / 2];
      for (int side = 0; side < 2; ++side) {
        if (zero[i] && constraint.bodies[side] == body && held[constraint.bodies[1 - side]])
          rows.push_back(&constraint.rows[i % 2].J[side]);
      }
    }
    for (std::size_t k = 2; k < rows.size(); ++k) {
      for (std::size_t j = 1; j < k; ++j) {
        for (std::size_t i = 0; i < j; ++i) {
          if (AreIndependent(*rows[i], *rows[j], *rows[k])) return true;
        }
      }
    }
    return false;
  }

  // In every scene.
  static bool AreIndependent(const Row& x, const Row& y, const Row& z) {
    const Slope determinant = x.dot(CrossProduct<Slope>(y, z));
    return Unsure<Slope>::TellsSign(determinant) && !IsSurelyZero(determinant);
  }

  const Bodies& bodies_;
  const Rows& constraints_;
};

bool Holds(const Slope& slope, const Rational& x) {
  return x >= Rational(slope.range().inf()) && x <= Rational(slope.range().sup());
}

bool IsZero(const Vector2<Rational>& v) { return sgn(v[0]) == 0 && sgn(v[1]) == 0; }

}  // namespace

std::optional<Rejected> UnfitForBox(const Scene<Rational>& scene) {
  if (!scene.joints.empty())
    return Rejected{"joints", fmt::format("{} joints", scene.joints.size()),
                    "none: no box is defined for them"};
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const auto& body = scene.bodies[i];
    const std::string path = fmt::format("bodies[{}]", i);
    if (!IsZero(body.velocity) || sgn(body.spin) != 0)
      return Rejected{path, "a velocity or spin", "a body at rest"};
    if (body.fixed && !IsZero(body.acceleration))
      return Rejected{path + ".acceleration", "an acceleration", "none"};
  }
  if (FindContacts(scene).empty()) return Rejected{"contacts", "no contact", "at least one"};
  return std::nullopt;
}

TouchingScene Touching(const Scene<Rational>& scene) {
  STICTION_CHECK(!UnfitForBox(scene), "a scene at rest, without joints, with a contact");
  TouchingScene touching = {scene, FindContacts(scene), {}};
  touching.problem = Assemble(scene, touching.contacts, Level::kForces, /*minimal=*/false).Problem(0);
  return touching;
}

bool SceneLoopsWithin(const TouchingScene& scene, const ExactRun& run, const Request& request,
                      const Rational& radius) {
  STICTION_CHECK(sgn(radius) >= 0 && radius < 1, "a radius from 0 to 1");
  if (run.verdict.outcome != Outcome::kCycle) return false;
  try {
    const Box box(scene, radius);
    HeldBodies rows(box);
    return SameRun(box.Problem(), run, request, &rows);
  } catch (const CGAL::Uncertain_conversion_exception&) {
    return false;  // a mass may vanish
  }
}

bool Follows(const TouchingScene& scene, const Rational& radius, const std::vector<bool>& zero, int row) {
  const Box box(scene, radius);
  return HeldBodies(box).Follows(zero, row);
}

bool IsInBox(const TouchingScene& scene, const Rational& radius, const ExactProblem& problem) {
  const ContactProblem<Slope> box = Box(scene, radius).Problem();
  STICTION_CHECK(box.rows() == problem.rows(), "a problem of the same contacts");
  for (int i = 0; i < box.rows(); ++i) {
    if (!Holds(box.b[i], problem.b[i])) return false;
    for (int j = 0; j < box.rows(); ++j) {
      if (!Holds(box.A(i, j), problem.A(i, j))) return false;
    }
  }
  return std::equal(box.contacts.begin(), box.contacts.end(), problem.contacts.begin(),
                    [](const auto& wide, const auto& exact) { return Holds(wide.mu, exact.mu); });
}

std::optional<Rational> RadiusOfSceneLoop(const TouchingScene& scene, const Request& request) {
  const ExactRun run = RunExact(scene.problem, request);
  return LargestRadius([&](const Rational& radius) { return SceneLoopsWithin(scene, run, request, radius); });
}

}  // namespace stiction
