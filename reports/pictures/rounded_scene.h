// SPDX-License-Identifier: Apache-2.0
// A scene of a file over doubles, for pictures and simulations.

#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>

#include "corpus/input_error.h"
#include "corpus/record/scene_file.h"

namespace stiction {

// ---- Sums that are finite where all of their numbers are ---------------------------------------

inline double SumOfVector(double x) { return x; }
template <class Numbers>
double SumOfVector(const Numbers& numbers) {
  return numbers.sum();
}
inline double SumOfInertia(double inertia) { return inertia + 1 / inertia; }
inline double SumOfInertia(const Matrix3<double>& inertia) {
  return inertia.sum() + Inverse3<double>(inertia).sum();
}

template <class Kind>
double SumOfNumbers(const BodyIn<Kind, double>& body) {
  return body.mass + 1 / body.mass + SumOfInertia(body.inertia) + body.position.sum() + body.rotation.sum() +
         body.velocity.sum() + SumOfVector(body.spin) + body.acceleration.sum() + body.force.sum() +
         SumOfVector(body.torque);
}

// ---- The scene -----------------------------------------------------------------------------------

// The scene of a file, each number rounded; InputError if one of them is beyond the range of doubles.
template <class Kind>
SceneIn<Kind, double> RoundedScene(const SceneFileIn<Kind>& file, const std::string& source) {
  SceneIn<Kind, double> scene = Round(file.scene);
  const auto require = [&source](double sum, const std::string& place) {
    if (!std::isfinite(sum)) {
      throw InputError(
          fmt::format("{}: {}: found a number beyond the range of doubles, expected none", source, place));
    }
  };
  for (const auto& body : scene.bodies) {
    double sum = SumOfNumbers(body);
    for (const auto& shape : body.shapes) {
      sum += shape.center.sum() + shape.radius;
      for (const auto& corner : shape.corners) sum += corner.sum();
    }
    require(sum, "body " + body.name);
  }
  require(scene.gravity.sum() + scene.mu + scene.gap, "gravity, mu, gap");
  for (const auto& pair : scene.pairs) require(pair.mu.value_or(0), "pairs");
  for (const auto& joint : scene.joints) require(joint.at_a.sum() + joint.at_b.sum(), "joints");
  for (const auto& contact : scene.contacts) require(contact.at_a.sum() + contact.at_b.sum(), "contacts");
  return scene;
}

// ---- How it is simulated -------------------------------------------------------------------------

// A number of a file that is within what the option of its name takes.
inline double Within(const Rational& x, double least, double most, const std::string& place) {
  const double value = x > Rational(most) ? std::numeric_limits<double>::infinity() : ToDouble(x);
  if (value >= least && value <= most) return value;
  throw InputError(fmt::format("{}: found {}, expected {:g} to {:g} s", place, value, least, most));
}
inline constexpr double kLeastTime = 1e-9, kMostStep = 1, kMostSeconds = 1e6;  // s
inline constexpr double kMostRest = 1e6;                                       // m/s
template <class Kind>
double StepOf(const SceneFileIn<Kind>& file, const std::string& source) {
  return Within(file.step, kLeastTime, kMostStep, source + ": step");
}
template <class Kind>
double SecondsOf(const SceneFileIn<Kind>& file, const std::string& source) {
  return Within(file.seconds, kLeastTime, kMostSeconds, source + ": seconds");
}

}  // namespace stiction
