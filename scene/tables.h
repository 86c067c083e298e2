// SPDX-License-Identifier: Apache-2.0
// What comes out of a simulation, as tables: bodies, contacts, energy, drift, and how bodies moved. Each column
// is described here once: files, the Python package and the documentation have their names from here.
//
// A step k goes from the state k to the state k + 1; state 0 is the scene as given. `bodies`, `energy` and
// `drift` have the states, `contacts` has the contacts and forces that the step from state k found: they are
// those of that step, at its start. Of a step that was done in parts (simulate.h) they are those of its last
// part.

#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scene/creep.h"
#include "scene/simulate.h"

namespace stiction {

using OutputCell = std::variant<std::int64_t, double, std::string>;

// How a row's cell is got; its type is that of the column.
template <class Row>
using OutputValue =
    std::variant<std::int64_t (*)(const Row&), double (*)(const Row&), std::string (*)(const Row&)>;

template <class Row>
struct OutputColumn {
  std::string name;  // ends in its unit, as "vx_m_per_s"
  std::string unit;  // empty of words and counts
  std::string meaning;
  OutputValue<Row> value;

  OutputCell Of(const Row& row) const {
    return std::visit([&row](const auto of) { return OutputCell(of(row)); }, value);
  }
};

// Its name, or "body 1", ...
template <class Kind>
std::string NameOfBody(const SceneIn<Kind, double>& scene, int body) {
  const std::string& name = scene.bodies[body].name;
  return name.empty() ? "body " + std::to_string(body + 1) : name;
}

// A table, and what a row of it is made of.
template <class Row>
struct OutputTable {
  std::string name;  // of its file
  std::vector<OutputColumn<Row>> columns;
};

// Numbers of bodies, pieces and contacts start from 0.
template <class Kind>
struct BodyRow {
  std::int64_t step = 0;
  double time = 0;  // s
  const SceneIn<Kind, double>& scene;
  int body = 0;
};
template <class Kind>
struct ContactRow {
  std::int64_t step = 0;
  double time = 0;  // s, of the start of the step
  const SceneIn<Kind, double>& scene;
  int number = 0;
  const TouchPointIn<Kind, double>& contact;
  const AppliedForceIn<Kind>* force = nullptr;  // null: none
};
struct StateRow {
  double time = 0;  // s
  Energy energy;
  Drift drift;
};
template <class Kind>
struct MotionRow {
  const SceneIn<Kind, double>& scene;
  BodyMotion motion;
};

template <class Kind>
const OutputTable<BodyRow<Kind>>& BodyTable();
template <class Kind>
const OutputTable<ContactRow<Kind>>& ContactTable();
const OutputTable<StateRow>& EnergyTable();
const OutputTable<StateRow>& DriftTable();
template <class Kind>
const OutputTable<MotionRow<Kind>>& MotionTable();

// What a contact does, in a word: "slides", "sticks" or "free", by its force and slip (AppliedForceIn).
//   free     it bears no force
//   slides   it bears one, and slides faster than kRestSpeed (creep.h)
//   sticks   it bears one, and does not
template <class Kind>
std::string_view DoesOf(const AppliedForceIn<Kind>* force);

// What bears on each body in the last step. Joints bear on theirs always.
template <class Kind>
std::vector<Support> SupportsOf(const SimulationIn<Kind>& simulation);

// take(row) for every row of the present state, and of the last step.
template <class Kind, class Take>
void ForEachBodyRow(const SimulationIn<Kind>& simulation, Take take) {
  const auto& scene = simulation.scene();
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i)
    take(BodyRow<Kind>{simulation.statistics().frames, simulation.time(), scene, i});
}
template <class Kind, class Take>
void ForEachContactRow(const SimulationIn<Kind>& simulation, double time, Take take) {
  const auto& contacts = simulation.contacts();
  std::vector<const AppliedForceIn<Kind>*> forces(contacts.size(), nullptr);
  for (const auto& force : simulation.forces()) {
    if (!force.from_joint) forces[force.source] = &force;
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    take(ContactRow<Kind>{simulation.statistics().frames - 1, time, simulation.scene(), static_cast<int>(i),
                          contacts[i], forces[i]});
  }
}

}  // namespace stiction
