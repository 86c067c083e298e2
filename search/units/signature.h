// SPDX-License-Identifier: Apache-2.0
// Signature of a loop: what stays of it when contacts are permuted, tangents reversed, units changed.
//
// The word of a loop is the sequence of its steps within one period: driven variable, goal, limiting
// variable, its sets before and after, and whether the step had length zero; no numbers. Contacts are
// named in the order in which they appear, tangents turned so that the first limit of each contact is the
// upper one, and of all rotations of the period the smallest word is taken.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "certify/exact/exact.h"

namespace stiction {

// A loop as it is counted.
struct LoopFacts {
  std::string signature;
  int contacts = 0;  // in the period, as the counts of the signature
  std::int64_t drives = 0, steps = 0, zero_steps = 0;
  std::uint64_t word = 0;  // its hash, for any number of contacts
  bool named = false;      // whether the signature has the word
};

// The word itself, readable: one item per step, e.g. "aF>bF:CF/NC+ ...". Requires outcome cycle or stall.
std::string LoopWord(const ExactProblem& problem, const ExactRun& run);

// "cycle-2c-4d-10s-1f0c...": outcome, contacts in the period, its drives and steps, and the hash of the word if
// the period has at most two contacts. Of these a search meets the same words again and again; with more
// contacts almost every loop has a word of its own: there the counts alone make the groups, and a campaign
// counts the different words of each (corpus/record/statistics.h). Of another outcome than a loop only its name
// and the number of contacts remain: "singular-3c". In space the counts alone, of all contacts.
std::string Signature(const ExactProblem& problem, const ExactRun& run);
// The same from certified pivots: a length is zero if it is zero there. Rational and double.
template <class Scalar>
std::string Signature(const ExactProblem& problem, const Verdict& verdict,
                      const std::vector<Pivot<Scalar>>& pivots);
// Requires outcome cycle or stall. Rational and double.
template <class Scalar>
LoopFacts FactsOfLoop(const ExactProblem& problem, const Verdict& verdict,
                      const std::vector<Pivot<Scalar>>& pivots);
// "cycle-2c-4d", "ray-2c": by counts that a verdict alone gives.
std::string CountsSignature(std::size_t contacts, Outcome outcome, std::int64_t period);

}  // namespace stiction
