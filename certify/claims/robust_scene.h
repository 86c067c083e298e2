// SPDX-License-Identifier: Apache-2.0
// Robust loops of scenes: how far all that a scene is built of may be off at once while the published algorithm
// still loops.
//
// L is the largest distance of a body's centre of mass to one of its contacts, of bodies that can move. The box
// of radius r about a scene holds all scenes with the same contacts, each of these off by itself:
//
//   mass, moment of inertia, given force (each component) and moment of a body, mu of a contact
//                                                       by a factor in [1 - r, 1 + r]
//   both coordinates of a body's centre of mass and of a contact's point         by at most r L
//   a contact's normal, the direction of gravity                                 turned by at most r radians
//
// The same contacts: the same pairs of bodies touch, at these points with these normals; whether bodies of some
// shape would is not asked. What is fixed stays where it is. (tests/setup/tolerance.py draws from this box.)
//
// Theorem. Let a run over slopes (slope.h) with a parameter for each of these numbers prove the loop of the
// scene's own problem, all contacts in one, as robust.h asks of intervals. Then the problem of every scene of
// the box loops, with this start and period.
// Proof. A = J W J' and b = J W F, and what a run makes of them, are functions of the parameters, which the
// slopes enclose; so every decision is the same all over the box, and robust.h's proof holds. QED
// Quantities that meet a limit at once in all scenes are told as such where bodies that are held explain it
// (HeldBodies); where the scene itself has other ties nothing is proved.
//
// Units    r is a number without one, L is in m.

#pragma once

#include <optional>
#include <vector>

#include "certify/exact/exact.h"
#include "certify/exact/rejected.h"
#include "scene/assemble.h"

namespace stiction {

// A scene with its contacts, and their problem.
struct TouchingScene {
  Scene<Rational> scene;
  std::vector<TouchPoint<Rational>> contacts;  // in the order of the problem
  ExactProblem problem;
};

// What keeps a scene from having a box, by its place in the file. Boxes are defined for scenes of the plane
// that are at rest, without joints, with a contact.
std::optional<Rejected> UnfitForBox(const Scene<Rational>& scene);

// Requires a scene that is not unfit.
TouchingScene Touching(const Scene<Rational>& scene);

// The largest radius that is proved, as RadiusOfLoop (robust.h) searches for it.
std::optional<Rational> RadiusOfSceneLoop(const TouchingScene& scene, const Request& request);

// Whether the theorem holds for this radius, 0 <= radius < 1. `run`: that of the scene's problem.
bool SceneLoopsWithin(const TouchingScene& scene, const ExactRun& run, const Request& request,
                      const Rational& radius);

// Whether in every scene of the box row `row` of the problem does not accelerate where the marked ones do not.
bool Follows(const TouchingScene& scene, const Rational& radius, const std::vector<bool>& zero, int row);

// Whether A, b and mu of a problem are among those that enclose the box: so they are for all scenes of the box.
bool IsInBox(const TouchingScene& scene, const Rational& radius, const ExactProblem& problem);

}  // namespace stiction
