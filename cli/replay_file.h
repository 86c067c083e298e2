// SPDX-License-Identifier: Apache-2.0
// What `replay` follows a method on: a problem (corpus/formats/read_problem.h), and the picture of its scene.

#ifndef STICTION_CLI_REPLAY_FILE_H_
#define STICTION_CLI_REPLAY_FILE_H_

#include <string>

#include "corpus/record/problem_file.h"

namespace stiction {

struct ReplayFile {
  ProblemFile file;
  Json picture;  // reports/pictures/problem_picture.h; null where there is no scene of this very problem
};

ReplayFile ReadReplayFile(const std::string& file);

}  // namespace stiction

#endif  // STICTION_CLI_REPLAY_FILE_H_
