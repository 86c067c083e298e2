// SPDX-License-Identifier: Apache-2.0
// Files that a report and a data package have in common: those of the findings, and the tables.

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "corpus/whole_folder.h"
#include "reports/tables/discovery.h"

namespace stiction {

// How far a folder is: of how many findings the files are there, of how many, and how many files.
using ShowWriting = std::function<void(std::int64_t findings, std::int64_t of, std::int64_t files)>;

// Writes the files of a folder, and at last what they are. `show`, if any, is called after each.
class ReportFiles {
 public:
  explicit ReportFiles(const WholeFolder& folder, ShowWriting show = {})
      : folder_(folder), show_(std::move(show)) {}

  // So many findings will have files; one of them has all of its own.
  void ExpectFindings(std::int64_t of) { of_ = of; }
  void FinishFinding() { ++findings_; }

  void Write(const std::string& name, const std::string& text);
  // SHA256SUMS, in the format of sha256sum.
  void WriteSums() const;

 private:
  const WholeFolder& folder_;
  ShowWriting show_;
  std::int64_t findings_ = 0, of_ = 0;
  std::map<std::string, std::string> digests_;
};

// Name -> text of the files that discovery.files names. Requires a representative; its problems are parsed, and
// InputError says what is none.
std::map<std::string, std::string> FilesOf(const Discovery& discovery);

}  // namespace stiction
