// SPDX-License-Identifier: Apache-2.0
// The tables of a simulation (scene/tables.h) as files, written as the run goes: NAME.csv, NAME.jsonl, or both.
//
// A CSV file is RFC 4180 with a line of names, lines end in LF. A file of JSON lines has an object for each
// row, with the columns of the CSV in their order. Numbers are the shortest that read back to the same double,
// in both; one that is not finite is a text. columns.csv says of every column its unit and what it means.

#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "corpus/json_text.h"
#include "scene/creep.h"

namespace stiction {

// scene/tables.h
struct StateRow;
// scene/simulate.h
template <class Kind>
class SimulationIn;

struct TableForms {
  bool csv = true, json_lines = false;
};

// All tables of a run, and the track of its bodies.
template <class Kind>
class RunTables {
 public:
  // OutputError where they cannot be written, also later.
  RunTables(const std::filesystem::path& folder, TableForms forms);
  ~RunTables();

  // The first state; then each that a step led to, from the one at `time`, with its contacts.
  void AddFirst(const SimulationIn<Kind>& simulation, const StateRow& state);
  void AddStep(const SimulationIn<Kind>& simulation, double time, const StateRow& state);
  void Flush();
  // How the bodies moved up to now, which goes to a table, too. At the end.
  std::vector<BodyMotion> Motions() const;
  std::vector<BodyMotion> WriteMotions(const SceneIn<Kind, double>& scene);

 private:
  struct Files;
  std::unique_ptr<Files> files_;
};

// A list of objects, as the table has them.
template <class Kind>
SharedJson MotionsToJson(const SceneIn<Kind, double>& scene, const std::vector<BodyMotion>& motions);

}  // namespace stiction
