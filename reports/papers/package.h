// SPDX-License-Identifier: Apache-2.0
// The data package: what a store found, as a folder that anybody verifies with Python alone, in one command.
//
//   README.txt verify.py    what it is; `python3 verify.py`
//   manifest.json           the campaign; each finding with its problems, their digests, its certificates
//   findings/               as in a report: problems and certificates
//   checkers/               the independent checkers
//   tables/                 as in a report: what was counted
//   SHA256SUMS              of every file but itself

#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "corpus/store/store.h"
#include "corpus/whole_folder.h"
#include "reports/report_files.h"

namespace stiction {

// `checkers`: name -> text (certify/claims/checker_files.h). Writes the directory as a whole; the same content
// of a store gives the same bytes. Returns where a directory with files of others was moved to, if so.
std::filesystem::path WritePackage(const Store& store, const std::filesystem::path& directory,
                                   const std::map<std::string, std::string>& checkers,
                                   Occupied occupied = Occupied::kRefused, const ShowWriting& show = {});

}  // namespace stiction
