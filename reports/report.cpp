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

// `named` is one of the finding's files, or empty if it has none; `name` is what it would be.
void WriteCertificate(const fs::path& directory, const std::string& named, const std::string& name,
                      const std::string& text) {
  if (named.empty()) {
    RemoveFile(directory / name);
  } else {
    WriteFile(directory / named, text + "\n");
  }
}

void WriteFinding(const Discovery& discovery, const fs::path& directory) {
  const Finding& finding = *discovery.representative;
  const FindingFiles& files = discovery.files;
  const std::string original = Pretty(finding.problem, finding.signature);
  const bool minimized = !finding.minimized.empty();
  WriteFile(directory / files.original, original);
  WriteFile(directory / files.problem, minimized ? Pretty(finding.minimized, finding.signature) : original);
  const std::string stem = "findings/" + FileName(finding.signature);
  const std::string& own = finding.minimized_certificate;
  WriteCertificate(directory, files.certificate, stem + ".certificate.json",
                   own.empty() ? finding.certificate : own);
  WriteCertificate(directory, files.existence, stem + ".existence.certificate.json",
                   minimized ? finding.minimized_existence : finding.existence);
  WriteCertificate(directory, files.original_existence, stem + ".original.existence.certificate.json",
                   finding.existence);
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
  WriteFile(directory / "agreement.csv", AgreementCsv(content.total));
  WriteFile(directory / "solutions.csv", SolutionsCsv(content.total));
  WriteFile(directory / "findings.csv", FindingsCsv(content.discoveries));
  WriteFile(directory / "index.html", Page(content));
}

}  // namespace stiction
