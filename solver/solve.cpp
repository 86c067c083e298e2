// SPDX-License-Identifier: Apache-2.0
// The table of methods over the floating-point numbers of the language.

#include "solver/floating_methods.ipp"

namespace stiction {

template <>
std::span<const Method<float>> Methods<float>() {
  return FloatingMethods<float>();
}
template <>
std::span<const Method<double>> Methods<double>() {
  return FloatingMethods<double>();
}
template <>
std::span<const Method<long double>> Methods<long double>() {
  return FloatingMethods<long double>();
}

template Answer<float> Solve(const ContactProblem<float>&, std::string_view, const SolveOptions&,
                             Trace<float>*);
template Answer<double> Solve(const ContactProblem<double>&, std::string_view, const SolveOptions&,
                              Trace<double>*);
template Answer<long double> Solve(const ContactProblem<long double>&, std::string_view, const SolveOptions&,
                                   Trace<long double>*);
template Answer<double> SolveBy(const Method<double>&, const ContactProblem<double>&, const SolveOptions&,
                                Trace<double>*);
template const Method<float>* FindMethod(std::string_view);
template const Method<double>* FindMethod(std::string_view);
template const Method<long double>* FindMethod(std::string_view);
template void JudgeAnswer(const ContactProblem<float>&, double, Answer<float>&);
template void JudgeAnswer(const ContactProblem<double>&, double, Answer<double>&);
template void JudgeAnswer(const ContactProblem<long double>&, double, Answer<long double>&);

}  // namespace stiction
