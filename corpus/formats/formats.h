// SPDX-License-Identifier: Apache-2.0
// The formats of others by name: which one a file has, reading it, writing one.

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/record/problem_file.h"

namespace stiction {

// One row per format: its name, and how its matrices can be stored, the usual way first.
struct PublishedFormat {
  std::string name;
  std::vector<std::string> storages;
};
const std::vector<PublishedFormat>& PublishedFormats();

// Reads a file in one of the formats; `format` is a name of the table, or empty: then the content decides. The
// name of the problem is that of the file. InputError: what cannot be read, with its place.
ProblemFile ReadPublished(const std::filesystem::path& file, const std::string& format = "");
// The same of the text of that file.
ProblemFile ParsePublished(std::string text, const std::filesystem::path& file, const std::string& format = "");
// Whether a text begins as one of them: HDF5, or numbers.
bool LooksPublished(std::string_view text);

struct ExportReport {
  int rounded = 0;          // numbers that are no doubles, written as the nearest ones
  Rational largest_change;  // of these, relative to the number; 0 if none
};

enum class Rounding { kRefused, kAllowed };

// Writes a problem. InputError: a contact that the format does not have; a number that is no double, unless
// `rounding` allows it, or none even then (infinite); what cannot be written.
ExportReport WritePublished(const ProblemFile& problem, const std::filesystem::path& file,
                            const std::string& format, const std::string& storage, Rounding rounding);

}  // namespace stiction
