// SPDX-License-Identifier: Apache-2.0
// The contact problems of a scene as problem files, for `assemble` and for Python.

#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "corpus/record/problem_file.h"
#include "corpus/record/scene_file.h"
#include "scene/assemble.h"

namespace stiction {

struct SceneProblemOptions {
  std::string level = "forces";  // or "impulses"
  bool factors = false;          // in place of A
  bool full = false;             // one problem, with redundant rows; it keeps its scene

  Level AtLevel() const { return level == "impulses" ? Level::kImpulses : Level::kForces; }
};

// One for each island of the model that was assembled with these options, in its order. Those in factors have
// no A.
template <class Kind>
std::vector<ProblemFile> ProblemsOf(const SceneFileIn<Kind>& file, const ModelIn<Kind, Rational>& model,
                                    const SceneProblemOptions& o) {
  std::vector<ProblemFile> problems;
  for (std::size_t i = 0; i < model.islands.size(); ++i) {
    ProblemFile& problem = problems.emplace_back();
    problem.problem = o.factors ? AnyProblem(model.InFactors(i)) : AnyProblem(model.Problem(i));
    problem.name = file.scene.name;
    if (model.islands.size() > 1) problem.name += fmt::format("-{}", i + 1);
    problem.origin.Add(
        {{"scene", file.scene.name}, {"level", o.level}, {"model", o.full ? "full" : "minimal"}});
    if (o.full) problem.scene = ToJson(file);
  }
  return problems;
}

}  // namespace stiction
