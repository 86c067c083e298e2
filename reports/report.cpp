// SPDX-License-Identifier: Apache-2.0
#include "reports/report.h"

#include <map>
#include <string>

#include "corpus/digest.h"
#include "corpus/problem_file.h"
#include "reports/csv.h"
#include "reports/discovery.h"
#include "reports/figures.h"
#include "reports/page.h"
#include "reports/since.h"

namespace stiction {
namespace {

std::string Pretty(const std::string& problem, const std::string& source) {
  return Print(ParseProblem(problem, source));
}

// Writes the files of a report, and at last what they are.
class ReportFiles {
 public:
  explicit ReportFiles(const WholeFolder& folder) : folder_(folder) {}

  void Write(const std::string& name, const std::string& text) {
    folder_.Write(name, text);
    digests_[name] = Sha256(text);
  }
  // In the format of sha256sum.
  void WriteManifest() const {
    std::string manifest;
    for (const auto& [name, digest] : digests_) manifest += digest + "  " + name + "\n";
    folder_.Write("SHA256SUMS", manifest);
  }

 private:
  const WholeFolder& folder_;
  std::map<std::string, std::string> digests_;
};

// `name` is empty for a certificate that the finding does not have.
void WriteCertificate(ReportFiles& folder, const std::string& name, const std::string& text) {
  if (!name.empty()) folder.Write(name, text + "\n");
}

void WriteFiles(const Discovery& discovery, ReportFiles& folder) {
  const Finding& finding = *discovery.representative;
  const FindingFiles& files = discovery.files;
  const std::string original = Pretty(finding.problem, finding.signature);
  const bool minimized = !finding.minimized.empty();
  folder.Write(files.original, original);
  folder.Write(files.problem, minimized ? Pretty(finding.minimized, finding.signature) : original);
  const std::string& own = finding.minimized_certificate;
  WriteCertificate(folder, files.certificate, own.empty() ? finding.certificate : own);
  WriteCertificate(folder, files.existence, minimized ? finding.minimized_existence : finding.existence);
  WriteCertificate(folder, files.original_existence, finding.existence);
}

// What was searched, as stiction search reads it; the definition as it stands if that is no JSON object.
std::string CampaignFile(const CampaignIdentity& identity) {
  Json campaign = Json::parse(identity.definition, nullptr, false);
  const Json policies = Json::parse(identity.policies, nullptr, false);
  if (!campaign.is_object()) return identity.definition + "\n";
  if (policies.is_array()) campaign["policies"] = policies;
  return JsonText(campaign, 1) + "\n";
}

}  // namespace

std::filesystem::path WriteReport(const Store& store, const std::filesystem::path& directory, Occupied occupied,
                                  const std::vector<std::filesystem::path>& benches,
                                  const std::filesystem::path& since) {
  ReportContent content;
  if (!since.empty()) content.since = ReadSince(since);
  for (const auto& file : benches) {
    for (RungLine& line : ReadRungs(file)) content.rungs.push_back(std::move(line));
  }
  WholeFolder whole(directory, "report", occupied);
  ReportFiles folder(whole);
  const std::vector<Finding> findings = store.Findings();
  content.identity = store.identity();
  content.units = store.Units().Count();
  content.blocks = static_cast<std::int64_t>(store.Blocks().size());
  content.total = store.Total();
  content.work = store.TotalWork();
  content.discoveries = Discoveries(content.total, findings);
  for (const Discovery& discovery : content.discoveries) {
    if (discovery.representative != nullptr) WriteFiles(discovery, folder);
  }
  folder.Write("statistics.csv", StatisticsCsv(content.total));
  folder.Write("verdicts.csv", VerdictsCsv(content.total));
  folder.Write("strata.csv", StrataCsv(content.total));
  folder.Write("steps.csv", StepsCsv(content.total));
  folder.Write("loops.csv", LoopsCsv(content.total));
  folder.Write("zero_steps.csv", ZeroStepsCsv(content.total));
  folder.Write("agreement.csv", AgreementCsv(content.total));
  folder.Write("solutions.csv", SolutionsCsv(content.total));
  folder.Write("findings.csv", FindingsCsv(content.discoveries));
  folder.Write("ipopt.csv", IpoptCsv(content.discoveries));
  folder.Write("campaign.json", CampaignFile(content.identity));
  if (content.since) folder.Write("since.csv", SinceCsv(*content.since, content.discoveries));
  const std::vector<FigureTable> figures = Figures(content);
  for (const FigureTable& figure : figures) folder.Write("figures/" + figure.name + ".csv", FigureCsv(figure));
  folder.Write("index.html", Page(content, figures));
  folder.WriteManifest();
  return whole.Commit();
}

}  // namespace stiction
