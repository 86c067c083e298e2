// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "corpus/record/problem_file.h"
#include "corpus/record/scene_file.h"
#include "scene/assemble.h"
#include "solver/problem/check.h"
#include "tests/fuzz/targets.h"

namespace stiction::fuzz {
namespace {

constexpr std::size_t kMostBodies = 6, kMostCorners = 10, kMostText = 1 << 15;

template <class Kind>
bool IsSmall(const SceneIn<Kind, Rational>& scene) {
  return scene.bodies.size() <= kMostBodies && scene.joints.size() + scene.contacts.size() <= 2 * kMostBodies &&
         std::ranges::all_of(scene.bodies, [](const auto& body) {
           return body.shapes.size() <= 3 && std::ranges::all_of(body.shapes, [](const auto& shape) {
                    return shape.corners.size() <= kMostCorners;
                  });
         });
}

template <class Kind, class Scalar>
std::vector<ContactProblem<Scalar>> AssembleAll(const SceneIn<Kind, Scalar>& scene, Level level, bool minimal) {
  const auto contacts = FindContacts(scene);
  const auto model = Assemble(scene, contacts, level, minimal);
  Explain(scene, contacts, model, level);
  std::vector<ContactProblem<Scalar>> problems;
  for (std::size_t i = 0; i < model.islands.size(); ++i) problems.push_back(model.Problem(i));
  return problems;
}

// Over rationals A = J W J' is symmetric to the last digit, and what is assembled can be written and read.
void RequireProblem(const ExactProblem& problem) {
  STICTION_CHECK(problem.A == problem.A.transpose(), "an A of bodies that is not symmetric");
  ProblemFile file;
  file.name = "assembled";
  file.problem = problem;
  ParseProblem(Print(file), "what was assembled");
}

// What is simulated is finite: cli/scene.cpp refuses the rest.
template <class Kind>
bool IsFinite(const SceneIn<Kind, double>& scene) {
  return std::ranges::all_of(scene.bodies, [](const auto& body) {
    const bool shaped = std::ranges::all_of(body.shapes, [](const auto& shape) {
      return shape.center.allFinite() && std::isfinite(shape.radius) &&
             std::ranges::all_of(shape.corners, [](const auto& corner) { return corner.allFinite(); });
    });
    return shaped && body.position.allFinite() && body.rotation.allFinite();
  });
}

template <class Kind>
void RequireAssembled(const SceneIn<Kind, Rational>& scene) {
  for (const Level level : {Level::kForces, Level::kImpulses}) {
    for (const bool minimal : {true, false}) {
      for (const ExactProblem& problem : AssembleAll(scene, level, minimal)) RequireProblem(problem);
    }
  }
  const SceneIn<Kind, double> rounded = Round(scene);
  if (IsFinite(rounded)) AssembleAll(rounded, Level::kForces, true);
}

template <class Kind>
bool TakesScene(std::string_view text) {
  const auto file = Unrefused([text] { return ParseScene<Kind>(text, "input"); });
  if (!file) return false;
  const std::string printed = Print(*file);
  if (printed.size() > kMostText) return true;
  STICTION_CHECK(Print(ParseScene<Kind>(printed, "what was written")) == printed,
                 "a scene that is read back to another");
  if (IsSmall(file->scene)) RequireAssembled(file->scene);
  return true;
}

}  // namespace

bool FuzzScene(std::string_view bytes) { return TakesScene<Plane>(bytes) || TakesScene<Space>(bytes); }

}  // namespace stiction::fuzz
