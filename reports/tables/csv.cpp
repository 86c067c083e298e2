// SPDX-License-Identifier: Apache-2.0
#include "reports/tables/csv.h"

#include <fmt/format.h>

#include <utility>

#include "corpus/input_error.h"

namespace stiction {
namespace {

constexpr std::string_view kKeyColumns[] = {"generator", "contacts", "policy", "method", "arithmetic"};

void AddKeyColumns(Csv& csv) {
  for (const std::string_view column : kKeyColumns) csv.Add(column);
}

void AddKey(Csv& csv, const TallyKey& key) {
  csv.Add(key.generator).Add(key.contacts).Add(key.policy).Add(key.method).Add(key.arithmetic);
}

void AddStatisticsColumns(Csv& csv, const std::string& prefix) {
  const Statistics none;
  ForEachField(none, [&](const char* name, const char*, std::int64_t) { csv.Add(prefix + name); });
}

void AddStatistics(Csv& csv, const Statistics& statistics) {
  ForEachField(statistics, [&csv](const char*, const char*, std::int64_t value) { csv.Add(value); });
}

void AddOutcomeColumns(Csv& csv, const std::string& prefix) {
  for (const std::string_view name : kOutcomeNames) csv.Add(prefix + std::string(name));
}

template <class Counts>
void AddCounts(Csv& csv, const Counts& counts) {
  for (const std::int64_t count : counts) csv.Add(count);
}

void AddEmpty(Csv& csv, int cells) {
  for (int i = 0; i < cells; ++i) csv.Add("");
}

void AddYesNo(Csv& csv, bool yes) { csv.Add(yes ? "yes" : "no"); }

void AddFindingColumns(Csv& csv) {
  for (const char* column : {"signature", "kind", "count", "unit", "index", "generator", "contacts", "policy",
                             "inexact_outcome", "exact_outcome", "state", "loop_drives", "loop_steps"}) {
    csv.Add(column);
  }
  for (const char* column : {"start", "period", "steps", "whole_grid", "every_policy_loops"}) csv.Add(column);
  AddOutcomeColumns(csv, "found_grid_");
  for (const char* column : {"minimized_contacts", "minimized_start", "minimized_period", "minimized_steps"}) {
    csv.Add(column);
  }
  AddOutcomeColumns(csv, "minimized_grid_");
  for (const char* column : {"problem_file", "original_file", "certificate_file", "existence_file",
                             "original_existence_file", "safe", "minimized_safe", "words", "words_exact"}) {
    csv.Add(column);
  }
  csv.EndRow();
}

void AddRepresentative(Csv& csv, const Finding* finding) {
  if (finding == nullptr) {
    AddEmpty(csv, 7);
    csv.Add("counted");
    return;
  }
  csv.Add(finding->unit)
      .Add(finding->index)
      .Add(finding->generator)
      .Add(finding->contacts)
      .Add(finding->policy);
  csv.Add(finding->inexact_outcome).Add(finding->exact_outcome).Add(finding->done ? "finished" : "pending");
}

void AddLoop(Csv& csv, const std::optional<LoopLength>& loop) {
  if (!loop) return AddEmpty(csv, 2);
  csv.Add(loop->drives).Add(loop->steps);
}

void AddFound(Csv& csv, const Discovery& discovery) {
  if (!discovery.found) return AddEmpty(csv, 5 + kOutcomeCount);
  csv.Add(discovery.found->start).Add(discovery.found->period).Add(discovery.found->steps);
  AddYesNo(csv, discovery.WholeGrid());
  AddYesNo(csv, discovery.EveryPolicyLoops());
  AddCounts(csv, discovery.found->grid.counts);
}

// Empty where it was not decided.
void AddSafe(Csv& csv, const std::optional<RunFacts>& run) {
  if (run && run->safe) return AddYesNo(csv, *run->safe);
  csv.Add("");
}

// How many different words its loops have; empty where the signature is one.
void AddWords(Csv& csv, const Discovery& discovery) {
  if (!discovery.words) return AddEmpty(csv, 2);
  csv.Add(discovery.Words());
  AddYesNo(csv, discovery.words->IsExact());
}

void AddMinimized(Csv& csv, const std::optional<RunFacts>& run) {
  if (!run) return AddEmpty(csv, 4 + kOutcomeCount);
  csv.Add(run->contacts).Add(run->start).Add(run->period).Add(run->steps);
  AddCounts(csv, run->grid.counts);
}

}  // namespace

Csv& Csv::Add(std::string_view text) {
  if (row_started_) text_ += ',';
  row_started_ = true;
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    text_ += text;
    return *this;
  }
  text_ += '"';
  for (const char c : text) text_ += c == '"' ? std::string("\"\"") : std::string(1, c);
  text_ += '"';
  return *this;
}

Csv& Csv::Add(std::int64_t value) { return Add(std::string_view(std::to_string(value))); }

void Csv::EndRow() {
  text_ += "\r\n";
  row_started_ = false;
}

std::vector<std::vector<std::string>> ReadCsv(std::string_view text, const std::string& source) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> row(1);
  bool quoted = false;
  const auto end_row = [&] {
    if (!rows.empty() && row.size() != rows.front().size())
      throw InputError(fmt::format("{}: row {}: found {} cells, expected {}", source, rows.size() + 1,
                                   row.size(), rows.front().size()));
    rows.push_back(std::exchange(row, std::vector<std::string>(1)));
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      row.back() += text[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      row.emplace_back();
    } else if (!quoted && c == '\n') {
      end_row();
    } else if (quoted || c != '\r') {
      row.back() += c;
    }
  }
  if (quoted)
    throw InputError(fmt::format("{}: row {}: found a quotation that does not end", source, rows.size() + 1));
  if (row.size() > 1 || !row.back().empty()) end_row();
  return rows;
}

std::string StatisticsCsv(const Record& record) {
  Csv csv;
  AddKeyColumns(csv);
  csv.Add("problems");
  AddOutcomeColumns(csv, "");
  for (const char* column : {"audited", "misjudged", "wrong", "with_zero_steps", "with_give_ups"})
    csv.Add(column);
  AddStatisticsColumns(csv, "sum_");
  AddStatisticsColumns(csv, "max_");
  csv.EndRow();
  for (const auto& [key, tally] : record.tallies) {
    AddKey(csv, key);
    csv.Add(tally.problems);
    AddCounts(csv, tally.outcomes);
    csv.Add(tally.audited).Add(tally.misjudged).Add(tally.wrong);
    csv.Add(tally.with_zero_steps).Add(tally.with_give_ups);
    AddStatistics(csv, tally.sums);
    AddStatistics(csv, tally.maxima);
    csv.EndRow();
  }
  return csv.text();
}

std::string VerdictsCsv(const Record& record) {
  Csv csv;
  AddKeyColumns(csv);
  csv.Add("inexact_outcome").Add("exact_outcome").Add("count").EndRow();
  for (const auto& [key, tally] : record.tallies) {
    for (int inexact = 0; inexact < kOutcomeCount; ++inexact) {
      for (int exact = 0; exact < kOutcomeCount; ++exact) {
        const std::int64_t count = tally.verdicts[inexact][exact];
        if (count == 0) continue;
        AddKey(csv, key);
        csv.Add(kOutcomeNames[inexact]).Add(kOutcomeNames[exact]).Add(count).EndRow();
      }
    }
  }
  return csv.text();
}

std::string StepsCsv(const Record& record) {
  Csv csv;
  AddKeyColumns(csv);
  csv.Add("steps").Add("or_more").Add("problems").EndRow();
  for (const auto& [key, tally] : record.tallies) {
    for (int steps = 0; steps < Tally::kBins; ++steps) {
      if (tally.steps[steps] == 0) continue;
      AddKey(csv, key);
      csv.Add(steps);
      AddYesNo(csv, steps == Tally::kBins - 1);
      csv.Add(tally.steps[steps]).EndRow();
    }
  }
  return csv.text();
}

std::string StrataCsv(const Record& record) {
  Csv csv;
  AddKeyColumns(csv);
  for (const char* column : {"friction", "rank", "problems", "steps", "zero_steps", "audited", "misjudged"})
    csv.Add(column);
  AddOutcomeColumns(csv, "");
  AddOutcomeColumns(csv, "exact_");
  csv.EndRow();
  for (const auto& [key, tally] : record.tallies) {
    for (const auto& [stratum_key, stratum] : tally.strata) {
      AddKey(csv, key);
      csv.Add(stratum_key.friction).Add(stratum_key.rank);
      csv.Add(stratum.problems).Add(stratum.steps).Add(stratum.zero_steps);
      csv.Add(stratum.audited).Add(stratum.misjudged);
      AddCounts(csv, stratum.outcomes);
      AddCounts(csv, stratum.exact);
      csv.EndRow();
    }
  }
  return csv.text();
}

std::string WorkCsv(const Work& work) {
  Csv csv;
  csv.Add("what").Add("meaning").Add("value").EndRow();
  for (const std::string& machine : work.machines) csv.Add("machine").Add("").Add(machine).EndRow();
  ForEachPart(work.time, [&csv](const char* name, const char* meaning, std::int64_t value) {
    csv.Add(name).Add(meaning).Add(fmt::format("{:.6f}", static_cast<double>(value) * 1e-6)).EndRow();
  });
  return csv.text();
}

std::string LoopsCsv(const Record& record) {
  Csv csv;
  csv.Add("contacts");
  ForEachCounter(LoopTally{}, [&csv](const char* name, std::int64_t) { csv.Add(name); });
  csv.EndRow();
  for (const auto& [contacts, tally] : record.loops) {
    csv.Add(contacts);
    ForEachCounter(tally, [&csv](const char*, std::int64_t value) { csv.Add(value); });
    csv.EndRow();
  }
  return csv.text();
}

std::string ZeroStepsCsv(const Record& record) {
  Csv csv;
  csv.Add("contacts").Add("zero_steps").Add("loops").EndRow();
  for (const auto& [contacts, tally] : record.loops) {
    for (const auto& [zero_steps, loops] : tally.by_zero_steps)
      csv.Add(contacts).Add(zero_steps).Add(loops).EndRow();
  }
  return csv.text();
}

std::string AgreementCsv(const Record& record) {
  Csv csv;
  csv.Add("contacts");
  ForEachCounter(ExistenceTally{}, [&csv](const char* name, std::int64_t) { csv.Add(name); });
  ForEachCounter(AgreementTally{}, [&csv](const char* name, std::int64_t) { csv.Add(name); });
  csv.EndRow();
  const auto add = [&csv](const char*, std::int64_t value) { csv.Add(value); };
  for (const auto& [contacts, existence] : record.existence) {
    csv.Add(contacts);
    ForEachCounter(existence, add);
    const auto agreement = record.agreement.find(contacts);
    ForEachCounter(agreement == record.agreement.end() ? AgreementTally{} : agreement->second, add);
    csv.EndRow();
  }
  return csv.text();
}

std::string SolutionsCsv(const Record& record) {
  Csv csv;
  csv.Add("contacts").Add("counted").Add("count").Add("problems").EndRow();
  for (const auto& [contacts, tally] : record.agreement) {
    for (const auto& [words, problems] : tally.words)
      csv.Add(contacts).Add("words").Add(words).Add(problems).EndRow();
    for (const auto& [solutions, problems] : tally.solutions)
      csv.Add(contacts).Add("solutions").Add(solutions).Add(problems).EndRow();
  }
  return csv.text();
}

std::string FindingsCsv(const std::vector<Discovery>& discoveries) {
  Csv csv;
  AddFindingColumns(csv);
  for (const Discovery& discovery : discoveries) {
    csv.Add(discovery.signature).Add(discovery.kind).Add(discovery.met);
    AddRepresentative(csv, discovery.representative);
    AddLoop(csv, discovery.loop);
    AddFound(csv, discovery);
    AddMinimized(csv, discovery.minimized);
    const FindingFiles& files = discovery.files;
    csv.Add(files.problem).Add(files.original).Add(files.certificate);
    csv.Add(files.existence).Add(files.original_existence);
    AddSafe(csv, discovery.found);
    AddSafe(csv, discovery.minimized);
    AddWords(csv, discovery);
    csv.EndRow();
  }
  return csv.text();
}

std::string IpoptCsv(const std::vector<Discovery>& discoveries) {
  Csv csv;
  for (const char* column : {"signature", "kind", "outcome", "starts"}) csv.Add(column);
  csv.EndRow();
  for (const Discovery& discovery : discoveries) {
    if (!discovery.ipopt) continue;
    csv.Add(discovery.signature).Add(discovery.kind);
    csv.Add(discovery.ipopt->outcome).Add(discovery.ipopt->starts).EndRow();
  }
  return csv.text();
}

}  // namespace stiction
