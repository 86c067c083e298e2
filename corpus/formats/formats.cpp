// SPDX-License-Identifier: Apache-2.0
#include "corpus/formats/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "corpus/atomic_file.h"
#include "corpus/formats/fclib.h"
#include "corpus/formats/siconos.h"
#include "corpus/printable.h"

namespace stiction {
namespace {

constexpr std::string_view kHdf5Signature = "\x89HDF\r\n\x1a\n";

// A name as JSON can have it.
std::string NameOf(const std::filesystem::path& file) { return Printable(file.filename().string()); }

const PublishedFormat& FormatNamed(const std::string& name) {
  for (const PublishedFormat& format : PublishedFormats()) {
    if (format.name == name) return format;
  }
  throw InputError("format '" + name + "': expected siconos-lcp, siconos-fc or fclib");
}

// ---- What a format cannot hold ----------------------------------------------------------------

void RequireContacts(const AnyProblem& problem, const std::string& source, const std::string& format) {
  const bool lcp = format == "siconos-lcp", fclib = format == "fclib";
  const char* expected = lcp     ? "frictionless: an LCP has no others"
                         : fclib ? "static contacts, and bilateral ones behind them"
                                 : "static: a friction problem has no others";
  bool bilateral = false;
  for (std::size_t i = 0; i < problem.contacts().size(); ++i) {
    const ContactKind kind = problem.contacts()[i].kind;
    bilateral |= kind == ContactKind::kBilateral;
    const bool fits = lcp         ? kind == ContactKind::kFrictionless
                      : !fclib    ? kind == ContactKind::kStatic
                      : bilateral ? kind == ContactKind::kBilateral
                                  : kind == ContactKind::kStatic;
    if (!fits) throw InputError(source, fmt::format("contacts[{}].kind", i), std::string(Name(kind)), expected);
  }
}

// FCLIB writes V alone, for V and V'.
void RequireMirrorImage(const ExactEntries& problem, const std::string& source) {
  int rows = 0;
  for (const auto& contact : problem.contacts) rows += contact.HasFrictionRows() ? problem.dimension : 0;
  for (const auto& [at, value] : ByRows(problem.A)) {
    const auto [i, j] = at;
    if ((i < rows) == (j < rows) || problem.A.coeff(j, i) == value) continue;
    throw InputError(source, fmt::format("A[{}][{}]", i, j), "an entry unlike its mirror",
                     "A_ij = A_ji between static and bilateral contacts");
  }
}

class Rounder {
 public:
  Rounder(const std::string& source, Rounding rounding) : source_(source), rounding_(rounding) {}

  void Round(Rational& x, const std::string& path) {
    const double nearest = ToDouble(x);
    if (!std::isfinite(nearest)) {
      throw InputError(source_, path, Shortened(ToString(x)), "a number in the range of doubles");
    }
    const Rational value(nearest);
    if (value == x) return;
    if (rounding_ == Rounding::kRefused) {
      throw InputError(source_, path, Shortened(ToString(x)), "a number that is a double exactly, or --round");
    }
    ++report_.rounded;
    const Rational change = abs(Rational((value - x) / x));
    if (change > report_.largest_change) report_.largest_change = change;
    x = value;
  }

  const ExportReport& report() const { return report_; }

 private:
  const std::string source_;
  Rounding rounding_;
  ExportReport report_;
};

ExportReport RoundAll(ExactEntries& problem, const std::string& source, Rounding rounding) {
  Rounder rounder(source, rounding);
  SparseMatrix A = ByRows(problem.A);
  for (auto& [at, value] : A) rounder.Round(value, fmt::format("A[{}][{}]", at.first, at.second));
  problem.A = ToEigen(A, problem.rows(), problem.rows());
  for (int i = 0; i < problem.rows(); ++i) rounder.Round(problem.b[i], fmt::format("b[{}]", i));
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    rounder.Round(problem.contacts[i].mu, fmt::format("contacts[{}].mu", i));
  }
  return rounder.report();
}

SiconosStorage SiconosStorageNamed(const std::string& name) {
  if (name == "dense") return SiconosStorage::kDense;
  if (name == "blocks") return SiconosStorage::kBlocks;
  return name == "triplet" ? SiconosStorage::kTriplet : SiconosStorage::kColumns;
}

FclibStorage FclibStorageNamed(const std::string& name) {
  if (name == "rows") return FclibStorage::kRows;
  return name == "triplet" ? FclibStorage::kTriplet : FclibStorage::kColumns;
}

}  // namespace

const std::vector<PublishedFormat>& PublishedFormats() {
  static const std::vector<PublishedFormat> formats = {
      {"siconos-lcp", {"dense", "blocks", "columns", "triplet"}},
      {"siconos-fc", {"dense", "blocks", "columns", "triplet"}},
      {"fclib", {"columns", "rows", "triplet"}},
  };
  return formats;
}

ProblemFile ReadPublished(const std::filesystem::path& file, const std::string& format) {
  if (!format.empty()) FormatNamed(format);
  return ParsePublished(ReadText(file), file, format);
}

bool LooksPublished(std::string_view text) {
  const std::size_t at = text.find_first_not_of(" \t\r\n");
  return text.starts_with(kHdf5Signature) ||
         (at != text.npos && std::string_view("+-.0123456789").find(text[at]) != text.npos);
}

ProblemFile ParsePublished(std::string text, const std::filesystem::path& file, const std::string& format) {
  const std::string source = file.string();
  ProblemFile problem;
  if (format == "fclib" || (format.empty() && text.starts_with(kHdf5Signature))) {
    problem = ParseFclib(std::move(text), source);
  } else {
    std::optional<SiconosKind> kind;
    if (!format.empty()) kind = format == "siconos-lcp" ? SiconosKind::kLcp : SiconosKind::kFriction;
    problem = ParseSiconos(text, kind, source);
  }
  problem.name = NameOf(file.stem());
  problem.origin.Add({{"file", NameOf(file)}});
  const bool is_small = problem.problem.factors() == nullptr && !StaysSparse(problem.problem);
  if (is_small) problem.problem = problem.problem.dense();
  return problem;
}

ExportReport WritePublished(const ProblemFile& problem, const std::filesystem::path& file,
                            const std::string& format, const std::string& storage, Rounding rounding) {
  const PublishedFormat& row = FormatNamed(format);
  const std::string chosen = storage.empty() ? row.storages.front() : storage;
  if (std::find(row.storages.begin(), row.storages.end(), chosen) == row.storages.end()) {
    throw InputError(
        fmt::format("storage '{}': expected one of {} for {}", storage, fmt::join(row.storages, ", "), format));
  }
  RequireContacts(problem.problem, problem.name, format);
  ExactEntries rounded = problem.problem.entries();
  if (format == "fclib") RequireMirrorImage(rounded, problem.name);
  const ExportReport report = RoundAll(rounded, problem.name, rounding);
  if (format == "fclib") {
    WriteText(file, PrintFclib(rounded, problem.name, FclibStorageNamed(chosen)));
    return report;
  }
  const SiconosKind kind = format == "siconos-lcp" ? SiconosKind::kLcp : SiconosKind::kFriction;
  WriteText(file, PrintSiconos(rounded, kind, SiconosStorageNamed(chosen)));
  return report;
}

}  // namespace stiction
