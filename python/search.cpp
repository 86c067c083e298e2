// SPDX-License-Identifier: Apache-2.0
#include "search/search.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <optional>

#include "cli/version.h"
#include "corpus/machine.h"
#include "corpus/record/problem_file.h"
#include "corpus/store/finding_words.h"
#include "python/module.h"
#include "python/signals.h"
#include "reports/tables/campaign_tables.h"
#include "search/adversary/optimized_unit.h"
#include "search/summary.h"
#include "search/testimony.h"

namespace stiction {
namespace {

namespace py = pybind11;

// Whether the search came to its end. `campaign`: the text of a campaign file.
bool RunCampaign(const std::string& campaign_text, const std::string& store,
                 std::optional<std::int64_t> problems, std::optional<double> minutes, int threads,
                 std::optional<double> finishing) {
  const Campaign campaign = AsBegunIn(store, ParseCampaign(campaign_text, "campaign"));
  RequireConsistent(campaign);
  Signals signals;
  SearchOptions options;
  options.store = store;
  options.build = BuildId();
  options.machine = MachineText();
  options.threads = threads;
  options.problems = problems;
  options.minutes = minutes;
  options.finishing = finishing;
  options.interrupted = signals.flag();
  SearchEnd end;
  {
    const py::gil_scoped_release released;
    end = RunSearch(campaign, IdentityOf(campaign), options, [&signals](const SearchProgress&) {
            signals.Look();
          }).end;
  }
  signals.Throw();
  return end == SearchEnd::kDone;
}

// ---- Stores ----

py::dict ToPython(const Discovery& discovery) {
  py::dict dict;
  dict["count"] = discovery.met;
  dict["sentence"] = SentenceOf(*discovery.representative);
  ForEachColumn(*discovery.representative,
                [&dict](const char* name, const auto& value) { dict[py::str(name)] = value; });
  return dict;
}

// A store as it is at this moment.
class PythonStore {
 public:
  explicit PythonStore(const std::string& file) : store_(OpenSound(file)), file_(file) {}

  // The text of a campaign file.
  std::string Campaign() const {
    const stiction::Campaign campaign = CampaignOf(store_.identity(), file_);
    return JsonText(ToJson(campaign), 1) + "\n";
  }

  // Of a search with an objective the best of each generator and number of contacts, the best first.
  py::list Best() const {
    py::list list;
    const stiction::Campaign campaign = CampaignOf(store_.identity(), file_);
    for (const Elite& elite : BestOf(store_, 1)) {
      py::dict dict;
      dict["value"] = ValueOf(elite, campaign);
      dict["generator"] = Row(elite.candidate.generator).name;
      dict["contacts"] = elite.candidate.contacts;
      dict["problem"] = Print(BestFile(elite, campaign));
      list.append(dict);
    }
    return list;
  }

  // In the order of signature; groups of which no problem was kept stand in the table alone.
  py::list Findings() const {
    const std::vector<Finding> findings = store_.Findings();
    py::list list;
    for (const Discovery& discovery : Discoveries(store_.Total(), findings)) {
      if (discovery.representative != nullptr) list.append(ToPython(discovery));
    }
    return list;
  }

  // Name -> names of the columns that are text, and the table as JSON: those of a report.
  py::dict Tables() const {
    const std::vector<Finding> findings = store_.Findings();
    const Record total = store_.Total();
    py::dict tables;
    for (const Table& table : CampaignTables(total, Discoveries(total, findings))) {
      py::list texts;
      for (const Column& column : table.columns) {
        if (column.text) texts.append(column.name);
      }
      tables[py::str(table.name)] = py::make_tuple(texts, JsonText(ToJson(table)));
    }
    return tables;
  }

 private:
  Store store_;
  std::string file_;
};

}  // namespace

void AddSearch(py::module_& module) {
  module.def("search", &RunCampaign);
  py::class_<PythonStore>(module, "Store")
      .def(py::init<const std::string&>())
      .def("campaign", &PythonStore::Campaign)
      .def("findings", &PythonStore::Findings)
      .def("best", &PythonStore::Best)
      .def("tables", &PythonStore::Tables);
}

}  // namespace stiction
