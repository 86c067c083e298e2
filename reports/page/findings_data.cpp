// SPDX-License-Identifier: Apache-2.0
#include "reports/page/findings_data.h"

#include "corpus/json.h"
#include "corpus/rational.h"
#include "corpus/record/kinds.h"
#include "corpus/record/problem_file.h"
#include "reports/page/page.h"

namespace stiction {
namespace {

Json NumbersToJson(const ExactProblem& problem) {
  Json A = Json::array(), b = Json::array();
  for (int row = 0; row < problem.rows(); ++row) {
    Json numbers = Json::array();
    for (int column = 0; column < problem.rows(); ++column) numbers.push_back(ToString(problem.A(row, column)));
    A.push_back(std::move(numbers));
    b.push_back(ToString(problem.b[row]));
  }
  return {{"names", RowNames(problem)}, {"A", std::move(A)}, {"b", std::move(b)}, {"mu", MuColumn(problem)}};
}

Json FilesToJson(const FindingFiles& files) {
  return {files.problem,   files.original,           files.certificate,
          files.existence, files.original_existence, files.picture};
}

Json FindingToJson(const Discovery& discovery, const std::optional<Since>& since) {
  const Finding& finding = *discovery.representative;
  Json json = {{"signature", discovery.signature},
               {"kind", discovery.kind},
               {"loop", discovery.IsLoop()},
               {"stands_out", discovery.IsLoop() || IsGrave(discovery.kind)},
               {"whole", discovery.WholeGrid()},
               {"state", StateOf(discovery)},
               {"contacts", finding.contacts},
               {"smallest", discovery.SmallestContacts()},
               {"met", discovery.met},
               {"generator", finding.generator},
               {"unit", finding.unit},
               {"index", finding.index},
               {"policy", finding.policy}};
  if (discovery.loop) {
    json["drives"] = discovery.loop->drives;
    json["steps"] = discovery.loop->steps;
  }
  if (discovery.words) {
    json["words"] = discovery.Words();
    json["words_exact"] = discovery.words->IsExact();
  }
  if (since) json["change"] = since->ChangeOf(discovery);
  if (discovery.found) json["grid"] = GridText(discovery.found->grid);
  if (discovery.minimized) json["minimized_grid"] = GridText(discovery.minimized->grid);
  const std::string& text = SimplestText(finding);
  const ExactProblem problem = ParseProblem(text, finding.signature).problem;
  if (discovery.minimized) {
    const ProblemSize size = SizeOf(problem);
    json["nonzeros"] = size.nonzeros;
    json["bits"] = size.bits;
  }
  json["story"] = StoryOf(discovery);
  json["commands"] = CommandsOf(discovery);
  json["files"] = FilesToJson(discovery.files);
  json["numbers"] = text.size() > kLongestProblem ? Json() : NumbersToJson(problem);
  return json;
}

}  // namespace

Json FindingsToJson(const std::vector<Discovery>& discoveries, const std::optional<Since>& since) {
  Json json = Json::array();
  for (const Discovery* discovery : ByInterest(discoveries)) json.push_back(FindingToJson(*discovery, since));
  return json;
}

}  // namespace stiction
