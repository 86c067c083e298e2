// SPDX-License-Identifier: Apache-2.0
#include "reports/report.h"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <system_error>

#include "corpus/input_error.h"
#include "corpus/problem_file.h"
#include "reports/csv.h"
#include "reports/discovery.h"
#include "reports/page.h"

namespace stiction {
namespace {

namespace fs = std::filesystem;

void MakeDirectory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error)
    throw InputError(fmt::format("{}: cannot make the directory: {}", directory.string(), error.message()));
}

void WriteFile(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (!out) throw InputError(fmt::format("{}: cannot write the file", file.string()));
}

// One that an earlier report on the same store may have left.
void RemoveFile(const fs::path& file) {
  std::error_code error;
  fs::remove(file, error);
  if (error) throw InputError(fmt::format("{}: cannot remove the file: {}", file.string(), error.message()));
}

std::string Pretty(const std::string& problem, const std::string& source) {
  return Print(ParseProblem(problem, source));
}

void WriteFinding(const Discovery& discovery, const fs::path& directory) {
  const Finding& finding = *discovery.representative;
  const std::string original = Pretty(finding.problem, finding.signature);
  const bool minimized = !finding.minimized.empty();
  WriteFile(directory / discovery.files.original, original);
  WriteFile(directory / discovery.files.problem,
            minimized ? Pretty(finding.minimized, finding.signature) : original);
  if (discovery.files.certificate.empty()) {
    RemoveFile(directory / ("findings/" + FileName(finding.signature) + ".certificate.json"));
  } else {
    const std::string& own = finding.minimized_certificate;
    WriteFile(directory / discovery.files.certificate, (own.empty() ? finding.certificate : own) + "\n");
  }
}

}  // namespace

void WriteReport(const Store& store, const fs::path& directory) {
  const std::vector<Finding> findings = store.Findings();
  ReportContent content;
  content.identity = store.identity();
  content.units = store.Units().Count();
  content.blocks = static_cast<std::int64_t>(store.Blocks().size());
  content.total = store.Total();
  content.discoveries = Discoveries(content.total, findings);
  MakeDirectory(directory / "findings");
  for (const Discovery& discovery : content.discoveries) {
    if (discovery.representative != nullptr) WriteFinding(discovery, directory);
  }
  WriteFile(directory / "statistics.csv", StatisticsCsv(content.total));
  WriteFile(directory / "verdicts.csv", VerdictsCsv(content.total));
  WriteFile(directory / "steps.csv", StepsCsv(content.total));
  WriteFile(directory / "findings.csv", FindingsCsv(content.discoveries));
  WriteFile(directory / "index.html", Page(content));
}

}  // namespace stiction
