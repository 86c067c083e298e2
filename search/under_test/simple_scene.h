// SPDX-License-Identifier: Apache-2.0
// What a solver under test does wrong, in a scene that is as simple as minimizing makes it.
//
// A generator of scenes makes them of choices, which are made simpler (search/adversary/minimize_candidate.h)
// while the solver, given the problem of the scene in doubles, fails alike. A candidate has one coefficient of
// friction: of a scene with several each that the campaign has is tried; under the law `frictionless` there is
// none, and mu = 0.

#pragma once

#include <functional>
#include <optional>

#include "corpus/store/store.h"
#include "search/adversary/candidate.h"
#include "search/campaign.h"
#include "search/under_test/solver.h"

namespace stiction {

// Empty where the generator makes no scenes, or none with one coefficient of friction fails, or it was
// cancelled. `fails`: whether the solver does on a problem as posed.
std::optional<Candidate> SimpleSceneOf(const Finding& finding, const Campaign& campaign,
                                       const std::function<bool(const ContactProblem<double>&)>& fails,
                                       const std::function<bool()>& cancelled);

// The scene with its problem as it is posed to the solver. Requires a generator of scenes.
ProblemFile PosedFileOf(const Candidate& scene, SolverLaw law, const std::string& name);

}  // namespace stiction
