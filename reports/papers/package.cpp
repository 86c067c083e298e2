// SPDX-License-Identifier: Apache-2.0
#include "reports/papers/package.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "corpus/json_text.h"
#include "corpus/record/digest.h"
#include "corpus/record/problem_file.h"
#include "reports/papers/package/README_txt.h"
#include "reports/papers/package/verify_py.h"
#include "reports/tables/campaign_tables.h"

namespace stiction {
namespace {

template <class Bytes>
std::string TextOf(const Bytes& bytes) {
  return {std::begin(bytes), std::end(bytes)};
}

// The place of what is said of a problem's own files: name of the certificate, name of the problem.
std::vector<std::pair<std::string, std::string>> CertificatesOf(const Discovery& discovery) {
  const Finding& finding = *discovery.representative;
  const FindingFiles& files = discovery.files;
  const bool of_original = finding.minimized_certificate.empty();
  std::vector<std::pair<std::string, std::string>> certificates;
  const auto add = [&certificates](const std::string& name, const std::string& problem) {
    if (!name.empty()) certificates.emplace_back(name, problem);
  };
  add(files.certificate, of_original ? files.original : files.problem);
  add(files.existence, files.problem);
  add(files.original_existence, files.original);
  return certificates;
}

std::string ClaimOf(const std::string& certificate, const std::string& name) {
  return JsonPlace(certificate, name).Required("claim", "a claim").Text("a claim");
}

SharedJson Entry(const Discovery& discovery, const std::map<std::string, std::string>& files) {
  std::vector<SharedJson> problems, certificates;
  for (const std::string& name : {discovery.files.problem, discovery.files.original}) {
    problems.push_back({{"file", name}, {"digest", ProblemDigest(ParseProblem(files.at(name), name).problem)}});
  }
  for (const auto& [name, problem] : CertificatesOf(discovery)) {
    certificates.push_back({{"file", name}, {"claim", ClaimOf(files.at(name), name)}, {"problem", problem}});
  }
  const Finding& finding = *discovery.representative;
  return {{"signature", discovery.signature},
          {"kind", discovery.kind},
          {"met", discovery.met},
          {"policy", finding.policy},
          {"outcome", finding.exact_outcome},
          {"finished", finding.done},
          {"problems", problems},
          {"certificates", certificates}};
}

SharedJson Campaign(const Store& store) {
  const CampaignIdentity& identity = store.identity();
  const auto builds = store.TotalWork().builds;
  return {{"definition", ToldDefinition(identity)},
          {"seed", identity.seed},
          {"policies", JsonOrText(identity.policies)},
          {"algorithm", identity.algorithm},
          {"units", store.Units().Count()},
          {"builds", std::vector<std::string>(builds.begin(), builds.end())}};
}

}  // namespace

std::filesystem::path WritePackage(const Store& store, const std::filesystem::path& directory,
                                   const std::map<std::string, std::string>& checkers, Occupied occupied,
                                   const ShowWriting& show) {
  WholeFolder whole(directory, "report", occupied);
  ReportFiles folder(whole, show);
  const std::vector<Finding> findings = store.Findings();
  const Record total = store.Total();
  const std::vector<Discovery> discoveries = Discoveries(total, findings);
  std::vector<SharedJson> entries;
  folder.ExpectFindings(std::count_if(discoveries.begin(), discoveries.end(), [](const Discovery& discovery) {
    return discovery.representative != nullptr;
  }));
  for (const Discovery& discovery : discoveries) {
    if (discovery.representative == nullptr) continue;
    const auto files = FilesOf(discovery);
    for (const auto& [name, text] : files) folder.Write(name, text);
    folder.FinishFinding();
    entries.push_back(Entry(discovery, files));
  }
  for (const Table& table : CampaignTables(total, discoveries))
    folder.Write("tables/" + table.name + ".csv", ToCsv(table));
  for (const auto& [name, text] : checkers) folder.Write("checkers/" + name, text);
  folder.Write("README.txt", TextOf(kReadmeTxt));
  folder.Write("verify.py", TextOf(kVerifyPy));
  const SharedJson manifest = {
      {"format", "stiction-package"}, {"version", 1}, {"campaign", Campaign(store)}, {"findings", entries}};
  folder.Write("manifest.json", JsonText(manifest) + "\n");
  folder.WriteSums();
  return whole.Commit();
}

}  // namespace stiction
