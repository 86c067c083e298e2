// SPDX-License-Identifier: Apache-2.0
// The data of the page of a run, for the program and for Python.

#pragma once

#include <optional>
#include <string>

#include "certify/request/request.h"
#include "corpus/json_text.h"
#include "corpus/record/problem_file.h"

namespace stiction {

// ReplayPageData of the run itself, with what intervals say of it, and beside it of complete driving.
// `solution` is that of PathRequestOf(wanted), `picture` as PictureBeside (reports/pictures/problem_picture.h)
// has it.
SharedJson PageOfRun(const Wanted& wanted, const ProblemFile& file, const std::string& source,
                     const SharedJson& picture, const Solution& solution,
                     const std::optional<InexactAnswer>& over_intervals);

}  // namespace stiction
