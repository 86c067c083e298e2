// SPDX-License-Identifier: Apache-2.0
// What is asked of a solver by names, by the program and from Python.

#ifndef STICTION_ANSWERS_REQUEST_H_
#define STICTION_ANSWERS_REQUEST_H_

#include <string>
#include <string_view>

#include "certify/solve.h"

namespace stiction {

// Of `options`, policy and law are set by their names here.
struct Wanted {
  std::string method{kAutomatic};
  std::string arithmetic;  // empty: the usual one
  std::string policy = "paper";
  std::string law = "baraff";
  SolveOptions options = {};
  std::string_view dashes = "--";  // before the name of an option, where an error tells of it
};

// The request, checked against the table of methods. A polygon reading of the published algorithm in space is
// complete driving. InputError that names what is no name or does not fit the problem of `source`.
SolveRequest RequestOf(const Wanted& wanted, const ExactProblem& problem, const std::string& source);

}  // namespace stiction

#endif  // STICTION_ANSWERS_REQUEST_H_
