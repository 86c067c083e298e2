// SPDX-License-Identifier: Apache-2.0
// Parents: candidates that an optimizer starts from, out of problems of any origin and of smaller size.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "search/adversary/candidate.h"
#include "search/campaign.h"

namespace stiction {

// Of what `search --from` names:
//
//   a problem in any form that is read, a record   its choices, where its origin has them; otherwise, and where
//                                                  the campaign has psd and not their generator, NearPsd
//   STORE:FINDING                                  the choices that the finding was drawn with
//   STORE                                          the best of a search with an objective, or all findings
//   a folder                                       its files NAME.json, in the order of their names
//
// Of stores and folders only what fits the campaign (ObstacleOf). InputError: what cannot be read, is no
// candidate, or a store or folder of which nothing fits.
std::vector<Candidate> ParentsFrom(const std::string& source, const Campaign& campaign);

// Whether candidates of the generator can stand side by side.
bool HasDirectSums(GeneratorId generator);
// A = diag(A1, A2), b = (b1, b2), with the friction of the first. Empty if the generators differ or have no
// such sums, if one makes b = J y and the other b = A x, or if there are too many contacts.
std::optional<Candidate> DirectSum(const Candidate& left, const Candidate& right);
// Candidates of the size of `like` out of smaller ones: each beside the first of the size that is missing, or a
// random candidate where there is none, drawn from `seed`.
std::vector<Candidate> Enlarged(const std::vector<Candidate>& smaller, const Candidate& like,
                                std::uint64_t seed);

// Why a candidate is no parent of this campaign; empty if it is one. A smaller one is, where it can be
// enlarged.
std::string ObstacleOf(const Candidate& parent, const Campaign& campaign);

// The problem that a search drew, as a candidate: its choices, with the friction of its first contact
// everywhere.
Candidate CandidateOf(const Campaign& campaign, std::int64_t unit, std::int64_t index);

// A candidate of the generator `psd` near a problem: the force of each contact in a unit of its own, A as J J'
// of its eigenvectors and b as A x, both rounded to what the generator draws; with the largest friction.
// InputError unless the problem is planar, of one to eight static contacts.
Candidate NearPsd(const ExactProblem& problem, const std::string& source);

}  // namespace stiction
