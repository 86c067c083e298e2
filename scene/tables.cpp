// SPDX-License-Identifier: Apache-2.0
#include "scene/tables.h"

#include <cmath>

namespace stiction {
namespace {

// Columns of a vector's coordinates: "STEM" with %, which stands for x, y or z, and what `of` has.
template <class Row, int... kAxes>
void AddAxes(std::vector<OutputColumn<Row>>& columns, const std::string& name, const std::string& unit,
             const std::string& meaning, std::integer_sequence<int, kAxes...>, auto of) {
  const auto named = [&name](char axis) {
    std::string text = name;
    text[text.find('%')] = axis;
    return text;
  };
  (columns.push_back(
       {named("xyz"[kAxes]), unit, meaning, [](const Row& row) { return decltype(of)()(row)[kAxes]; }}),
   ...);
}

template <class Kind>
constexpr std::make_integer_sequence<int, Kind::kDimension> kAxesOf = {};

// ---- Bodies ----------------------------------------------------------------------------------

template <class Row>
void AddTurn(std::vector<OutputColumn<Row>>& columns, const SceneIn<Plane, double>*) {
  columns.push_back({"angle_rad", "rad", "anticlockwise, from -pi to pi", [](const Row& row) {
                       const auto& rotation = row.scene.bodies[row.body].rotation;
                       return std::atan2(rotation[1], rotation[0]);
                     }});
}
template <class Row>
void AddTurn(std::vector<OutputColumn<Row>>& columns, const SceneIn<Space, double>*) {
  const auto add = [&columns]<int kPart>(const char* name, std::integral_constant<int, kPart>) {
    columns.push_back({name, "", "unit quaternion w, x, y, z: from the body's coordinates to the world's",
                       [](const Row& row) { return row.scene.bodies[row.body].rotation.normalized()[kPart]; }});
  };
  add("qw", std::integral_constant<int, 0>());
  add("qx", std::integral_constant<int, 1>());
  add("qy", std::integral_constant<int, 2>());
  add("qz", std::integral_constant<int, 3>());
}

template <class Row>
void AddSpin(std::vector<OutputColumn<Row>>& columns, const SceneIn<Plane, double>*) {
  columns.push_back({"spin_rad_per_s", "rad/s", "anticlockwise, as of the velocity",
                     [](const Row& row) { return row.scene.bodies[row.body].spin; }});
}
template <class Row>
void AddSpin(std::vector<OutputColumn<Row>>& columns, const SceneIn<Space, double>*) {
  AddAxes(columns, "spin_%_rad_per_s", "rad/s", "angular velocity, a vector of the world, as of the velocity",
          kAxesOf<Space>, [](const Row& row) { return row.scene.bodies[row.body].spin; });
}

// ---- Contacts --------------------------------------------------------------------------------

// A force of the contact by row: normal, then tangential.
template <class Row>
double ForceOfRow(const Row& row, std::size_t number) {
  return row.force != nullptr && number < row.force->rows.size() ? row.force->rows[number] : 0;
}

template <class Row>
void AddTangential(std::vector<OutputColumn<Row>>& columns, const SceneIn<Plane, double>*) {
  columns.push_back({"tangential_N", "N", "friction on a, along the normal turned by a quarter anticlockwise",
                     [](const Row& row) { return ForceOfRow(row, 1); }});
}
template <class Row>
void AddTangential(std::vector<OutputColumn<Row>>& columns, const SceneIn<Space, double>*) {
  columns.push_back({"tangential_N", "N", "length of the friction on a",
                     [](const Row& row) { return std::hypot(ForceOfRow(row, 1), ForceOfRow(row, 2)); }});
}

}  // namespace

template <class Kind>
const OutputTable<BodyRow<Kind>>& BodyTable() {
  using Row = BodyRow<Kind>;
  static const OutputTable<Row> table = [] {
    constexpr const SceneIn<Kind, double>* kNone = nullptr;
    OutputTable<Row> made{"bodies", {}};
    auto& columns = made.columns;
    columns.push_back({"step", "", "number of the state", [](const Row& row) { return row.step; }});
    columns.push_back({"time_s", "s", "its time", [](const Row& row) { return row.time; }});
    columns.push_back({"body", "", "number of the body in the scene, from 0",
                       [](const Row& row) { return std::int64_t{row.body}; }});
    columns.push_back({"name", "", "its name, or \"body 1\", ...",
                       [](const Row& row) { return NameOfBody(row.scene, row.body); }});
    AddAxes(columns, "%_m", "m", "centre of mass", kAxesOf<Kind>,
            [](const Row& row) { return row.scene.bodies[row.body].position; });
    AddTurn(columns, kNone);
    AddAxes(columns, "v%_m_per_s", "m/s", "velocity of the centre of mass, of the middle of the step before",
            kAxesOf<Kind>, [](const Row& row) { return row.scene.bodies[row.body].velocity; });
    AddSpin(columns, kNone);
    return made;
  }();
  return table;
}
template const OutputTable<BodyRow<Plane>>& BodyTable();
template const OutputTable<BodyRow<Space>>& BodyTable();

template <class Kind>
const OutputTable<ContactRow<Kind>>& ContactTable() {
  using Row = ContactRow<Kind>;
  static const OutputTable<Row> table = [] {
    constexpr const SceneIn<Kind, double>* kNone = nullptr;
    OutputTable<Row> made{"contacts", {}};
    auto& columns = made.columns;
    const auto whole = [&columns](const char* name, const char* meaning, OutputValue<Row> of) {
      columns.push_back({name, "", meaning, of});
    };
    whole("step", "number of the state that the step goes from", [](const Row& row) { return row.step; });
    columns.push_back({"time_s", "s", "its time", [](const Row& row) { return row.time; }});
    whole("contact", "number within the step, from 0", [](const Row& row) { return std::int64_t{row.number}; });
    whole("a", "number of the one body", [](const Row& row) { return std::int64_t{row.contact.a}; });
    whole("b", "number of the other, whose surface has the point",
          [](const Row& row) { return std::int64_t{row.contact.b}; });
    whole("name_a", "name of a", [](const Row& row) { return NameOfBody(row.scene, row.contact.a); });
    whole("name_b", "name of b", [](const Row& row) { return NameOfBody(row.scene, row.contact.b); });
    whole("shape_a", "number in the shapes of a, from 0; -1 of a contact that the scene gives",
          [](const Row& row) { return std::int64_t{row.contact.shape_a}; });
    whole("shape_b", "likewise of b", [](const Row& row) { return std::int64_t{row.contact.shape_b}; });
    AddAxes(columns, "%_m", "m", "the point", kAxesOf<Kind>, [](const Row& row) { return row.contact.point; });
    AddAxes(columns, "n%", "", "normal of length 1, from b to a", kAxesOf<Kind>,
            [](const Row& row) { return row.contact.normal; });
    columns.push_back({"gap_m", "m", "distance along the normal, negative for overlap",
                       [](const Row& row) { return row.contact.gap; }});
    columns.push_back({"mu", "", "friction coefficient", [](const Row& row) { return row.contact.mu; }});
    columns.push_back(
        {"normal_N", "N", "force on a along the normal", [](const Row& row) { return ForceOfRow(row, 0); }});
    AddTangential(columns, kNone);
    AddAxes(columns, "f%_N", "N", "the whole force on a; on b acts its opposite", kAxesOf<Kind>,
            [](const Row& row) {
              using Vector = typename Kind::template Vector<double>;
              return row.force != nullptr ? row.force->force : Vector(Zero<Vector>());
            });
    whole("does",
          "`free`: no force; `sticks`: a force, and it slides by no more than 1e-6 m/s; `slides`: faster",
          [](const Row& row) { return std::string(DoesOf<Kind>(row.force)); });
    return made;
  }();
  return table;
}
template const OutputTable<ContactRow<Plane>>& ContactTable();
template const OutputTable<ContactRow<Space>>& ContactTable();

// ---- The rest --------------------------------------------------------------------------------

namespace {

OutputColumn<StateRow> TimeOfState() {
  return {"time_s", "s", "of the state", [](const StateRow& row) { return row.time; }};
}

}  // namespace

const OutputTable<StateRow>& EnergyTable() {
  using Row = StateRow;
  static const OutputTable<Row> table{
      "energy",
      {TimeOfState(),
       {"kinetic_J", "J", "with the velocities of the middle of the step before",
        [](const Row& row) { return row.energy.kinetic; }},
       {"potential_J", "J", "of gravity, zero at the origin",
        [](const Row& row) { return row.energy.potential; }},
       {"total_J", "J", "their sum", [](const Row& row) { return row.energy.total(); }}}};
  return table;
}

const OutputTable<StateRow>& DriftTable() {
  using Row = StateRow;
  static const OutputTable<Row> table{
      "drift",
      {TimeOfState(),
       {"joints_m", "m", "how far joints have come apart at most, or the sine of an angle",
        [](const Row& row) { return row.drift.joints; }},
       {"overlap_m", "m", "the deepest overlap", [](const Row& row) { return row.drift.overlap; }}}};
  return table;
}

template <class Kind>
const OutputTable<MotionRow<Kind>>& MotionTable() {
  using Row = MotionRow<Kind>;
  static const OutputTable<Row> table{
      "motion",
      {{"body", "", "number of the body, which is not fixed",
        [](const Row& row) { return std::int64_t{row.motion.body}; }},
       {"name", "", "its name", [](const Row& row) { return NameOfBody(row.scene, row.motion.body); }},
       {"moved_m", "m", "how far any of its points got within the window, the second half of the run",
        [](const Row& row) { return row.motion.moved; }},
       {"window_s", "s", "length of the window", [](const Row& row) { return row.motion.seconds; }},
       {"speed_m_per_s", "m/s", "the same within the last quarter of the run, by its time",
        [](const Row& row) { return row.motion.speed; }},
       {"does", "",
        "the first that holds: `rests`: at most 1e-6 m/s; `flies`: nothing bears on it; `creeps`: at most 1e-3 "
        "m/s; "
        "`slides`: one of its contacts does; `moves`",
        [](const Row& row) { return std::string(row.motion.word); }}}};
  return table;
}
template const OutputTable<MotionRow<Plane>>& MotionTable();
template const OutputTable<MotionRow<Space>>& MotionTable();

template <class Kind>
std::string_view DoesOf(const AppliedForceIn<Kind>* force) {
  if (force == nullptr || force->force.isZero(0)) return "free";
  return force->slip > kRestSpeed ? "slides" : "sticks";
}
template std::string_view DoesOf(const AppliedForceIn<Plane>*);
template std::string_view DoesOf(const AppliedForceIn<Space>*);

template <class Kind>
std::vector<Support> SupportsOf(const SimulationIn<Kind>& simulation) {
  std::vector<Support> supports(simulation.scene().bodies.size());
  for (const auto& joint : simulation.scene().joints)
    supports[joint.a].is_borne = supports[joint.b].is_borne = true;
  for (const auto& force : simulation.forces()) {
    if (force.from_joint || DoesOf(&force) == "free") continue;
    for (const int body : force.bodies) {
      supports[body].is_borne = true;
      supports[body].slides |= DoesOf(&force) == "slides";
    }
  }
  return supports;
}
template std::vector<Support> SupportsOf(const SimulationIn<Plane>&);
template std::vector<Support> SupportsOf(const SimulationIn<Space>&);

}  // namespace stiction
