// SPDX-License-Identifier: Apache-2.0
#include "reports/report_files.h"

#include "corpus/record/digest.h"
#include "corpus/record/problem_file.h"

namespace stiction {
namespace {

std::string Pretty(const std::string& problem, const std::string& source) {
  return Print(ParseProblem(problem, source));
}

}  // namespace

void ReportFiles::Write(const std::string& name, const std::string& text) {
  folder_.Write(name, text);
  digests_[name] = Sha256(text);
  if (show_) show_(findings_, of_, static_cast<std::int64_t>(digests_.size()));
}

void ReportFiles::WriteSums() const {
  std::string sums;
  for (const auto& [name, digest] : digests_) sums += digest + "  " + name + "\n";
  folder_.Write("SHA256SUMS", sums);
}

std::map<std::string, std::string> FilesOf(const Discovery& discovery) {
  const Finding& finding = *discovery.representative;
  const FindingFiles& names = discovery.files;
  const std::string original = Pretty(finding.problem, finding.signature);
  const bool minimized = !finding.minimized.empty();
  std::map<std::string, std::string> files;
  files[names.original] = original;
  files[names.problem] = minimized ? Pretty(finding.minimized, finding.signature) : original;
  // The name is empty for a certificate that the finding does not have.
  const auto certificate = [&files](const std::string& name, const std::string& text) {
    if (!name.empty()) files[name] = text + "\n";
  };
  const std::string& own = finding.minimized_certificate;
  certificate(names.certificate, own.empty() ? finding.certificate : own);
  certificate(names.existence, minimized ? finding.minimized_existence : finding.existence);
  certificate(names.original_existence, finding.existence);
  return files;
}

}  // namespace stiction
