// SPDX-License-Identifier: Apache-2.0
#include "certify/request/quad.h"

#include "solver/complete/complete.ipp"
#include "solver/floating_methods.ipp"
#include "solver/lemke/lemke.ipp"
#include "solver/numeric/coulomb.ipp"
#include "solver/numeric/fast.ipp"
#include "solver/numeric/proximal.ipp"
#include "solver/problem/reduction.ipp"
#include "solver/published/published.ipp"
#include "solver/published/published_space.ipp"

namespace stiction {

template <>
std::span<const Method<Quad>> Methods<Quad>() {
  return FloatingMethods<Quad>();
}

template Answer<Quad> Solve(const ContactProblem<Quad>&, const Request&);
template const Method<Quad>* FindMethod(std::string_view);
template void JudgeAnswer(const ContactProblem<Quad>&, double, Answer<Quad>&);

}  // namespace stiction
