// SPDX-License-Identifier: Apache-2.0
#include "reports/tables/run_tables.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <string>

#include "corpus/json_text.h"
#include "corpus/output_error.h"
#include "reports/tables/table.h"
#include "scene/tables.h"

namespace stiction {
namespace {

// With a point or an exponent, so that no reader takes it for an integer: -0.0 would lose its sign.
std::string NumberText(double x) {
  std::string text = fmt::format("{}", x);
  if (std::isfinite(x) && text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

bool IsText(const OutputCell& cell) {
  const auto* number = std::get_if<double>(&cell);
  return std::holds_alternative<std::string>(cell) || (number != nullptr && !std::isfinite(*number));
}

void Open(std::ofstream& file, const std::filesystem::path& path) {
  file.open(path, std::ios::binary);
  if (!file) throw OutputError(path.string() + ": it cannot be written");
}

template <class Row>
void DescribeColumns(const OutputTable<Row>& table, std::string& text) {
  for (const auto& column : table.columns) {
    text += fmt::format("{},{},{},{}\n", table.name, QuotedForCsv(column.name), QuotedForCsv(column.unit),
                        QuotedForCsv(column.meaning));
  }
}

// A cell as the files have it: of a text without quotes.
std::string TextOf(const OutputCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* x = std::get_if<double>(&cell)) return NumberText(*x);
  return fmt::format("{}", std::get<std::int64_t>(cell));
}

// columns.csv
template <class Kind>
void WriteColumns(const std::filesystem::path& folder) {
  std::string text = "table,column,unit,meaning\n";
  DescribeColumns(BodyTable<Kind>(), text);
  DescribeColumns(ContactTable<Kind>(), text);
  DescribeColumns(EnergyTable(), text);
  DescribeColumns(DriftTable(), text);
  DescribeColumns(MotionTable<Kind>(), text);
  std::ofstream columns;
  Open(columns, folder / "columns.csv");
  if (!(columns << text).flush()) throw OutputError(folder.string() + ": its tables cannot be written");
}

}  // namespace

// The files of one table.
template <class Row>
class TableFiles {
 public:
  TableFiles(const std::filesystem::path& folder, const OutputTable<Row>& table, TableForms forms);
  void Add(const Row& row);
  void Flush();

 private:
  const OutputTable<Row>& table_;
  std::ofstream csv_, json_lines_;
  std::vector<std::string> keys_;  // as JSON, with what stands before the value
  std::string folder_;
};

template <class Row>
TableFiles<Row>::TableFiles(const std::filesystem::path& folder, const OutputTable<Row>& table,
                            TableForms forms)
    : table_(table), folder_(folder.string()) {
  if (forms.csv) Open(csv_, folder / (table.name + ".csv"));
  if (forms.json_lines) Open(json_lines_, folder / (table.name + ".jsonl"));
  std::string names;
  for (const auto& column : table.columns) {
    names += (names.empty() ? "" : ",") + QuotedForCsv(column.name);
    keys_.push_back((keys_.empty() ? "{" : ", ") + JsonText(SharedJson(column.name)) + ": ");
  }
  if (forms.csv) csv_ << names << '\n';
}

template <class Row>
void TableFiles<Row>::Add(const Row& row) {
  std::string line, object;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    const OutputCell cell = table_.columns[i].Of(row);
    const std::string text = TextOf(cell);
    if (csv_.is_open()) line += (i == 0 ? "" : ",") + QuotedForCsv(text);
    if (json_lines_.is_open()) object += keys_[i] + (IsText(cell) ? JsonText(SharedJson(text)) : text);
  }
  if (csv_.is_open()) csv_ << line << '\n';
  if (json_lines_.is_open()) json_lines_ << object << "}\n";
}

template <class Row>
void TableFiles<Row>::Flush() {
  for (std::ofstream* file : {&csv_, &json_lines_}) {
    if (file->is_open() && !file->flush()) throw OutputError(folder_ + ": its tables cannot be written");
  }
}

template <class Kind>
struct RunTables<Kind>::Files {
  Files(const std::filesystem::path& folder, TableForms forms)
      : bodies(folder, BodyTable<Kind>(), forms),
        contacts(folder, ContactTable<Kind>(), forms),
        energy(folder, EnergyTable(), forms),
        drift(folder, DriftTable(), forms),
        motions(folder, MotionTable<Kind>(), forms) {}

  TableFiles<BodyRow<Kind>> bodies;
  TableFiles<ContactRow<Kind>> contacts;
  TableFiles<StateRow> energy, drift;
  TableFiles<MotionRow<Kind>> motions;
  MotionTrack<Kind> track;
};

template <class Kind>
RunTables<Kind>::RunTables(const std::filesystem::path& folder, TableForms forms)
    : files_(std::make_unique<Files>(folder, forms)) {
  if (forms.csv || forms.json_lines) WriteColumns<Kind>(folder);
}

template <class Kind>
RunTables<Kind>::~RunTables() = default;

template <class Kind>
void RunTables<Kind>::AddFirst(const SimulationIn<Kind>& simulation, const StateRow& state) {
  ForEachBodyRow(simulation, [this](const BodyRow<Kind>& row) { files_->bodies.Add(row); });
  files_->energy.Add(state);
  files_->drift.Add(state);
  files_->track.Add(state.time, simulation.scene(), SupportsOf(simulation));
}

template <class Kind>
void RunTables<Kind>::AddStep(const SimulationIn<Kind>& simulation, double time, const StateRow& state) {
  ForEachContactRow(simulation, time, [this](const ContactRow<Kind>& row) { files_->contacts.Add(row); });
  AddFirst(simulation, state);
}

template <class Kind>
void RunTables<Kind>::Flush() {
  files_->bodies.Flush();
  files_->contacts.Flush();
  files_->energy.Flush();
  files_->drift.Flush();
  files_->motions.Flush();
}

template <class Kind>
std::vector<BodyMotion> RunTables<Kind>::Motions() const {
  return files_->track.Motions();
}

template <class Kind>
std::vector<BodyMotion> RunTables<Kind>::WriteMotions(const SceneIn<Kind, double>& scene) {
  std::vector<BodyMotion> motions = Motions();
  for (const BodyMotion& motion : motions) files_->motions.Add({scene, motion});
  Flush();
  return motions;
}

template class RunTables<Plane>;
template class RunTables<Space>;

template <class Kind>
SharedJson MotionsToJson(const SceneIn<Kind, double>& scene, const std::vector<BodyMotion>& motions) {
  std::vector<SharedJson> rows;
  for (const BodyMotion& motion : motions) {
    SharedJson row;
    for (const auto& column : MotionTable<Kind>().columns)
      std::visit([&](const auto& value) { row.Add({{column.name, value}}); }, column.Of({scene, motion}));
    rows.push_back(std::move(row));
  }
  return SharedJson(rows);
}
template SharedJson MotionsToJson(const SceneIn<Plane, double>&, const std::vector<BodyMotion>&);
template SharedJson MotionsToJson(const SceneIn<Space, double>&, const std::vector<BodyMotion>&);

}  // namespace stiction
