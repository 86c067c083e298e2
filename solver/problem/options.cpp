// SPDX-License-Identifier: Apache-2.0
// The table of policy switches, and policies as text.

#include "solver/problem/options.h"

#include <stdexcept>

namespace stiction {
namespace {

template <class Field, Field Policy::*member>
int Get(const Policy& policy) {
  return static_cast<int>(policy.*member);
}

template <class Field, Field Policy::*member>
void Set(Policy& policy, int value) {
  policy.*member = static_cast<Field>(value);
}

std::array<PolicySwitchRow, kPolicySwitchCount> MakeSwitches() {
  using enum PolicySwitch;
  return {{
      {kScan,
       "scan",
       "which violated variable is driven next",
       "5.5: the main loop \"continually scans for a contact point at which the normal or static "
       "friction conditions are not met\"",
       {{"lowest", "contact order, the normal of a contact before its friction"},
        {"normals-first", "all normals in contact order, then all frictions"},
        {"most-violated",
         "the normal with the largest -aN if any is violated, otherwise the friction "
         "with the largest abs(aF); ties to the lowest index"},
        {"highest", "contacts from the last to the first, normal before friction"}},
       true,
       Get<Scan, &Policy::scan>,
       Set<Scan, &Policy::scan>},
      {kResume,
       "resume",
       "where the scan starts",
       "5.5: \"continually scans\"; 4.3: \"while 3d such that ad < 0\" names no order",
       {{"restart", "at the first contact"}, {"round", "at the contact driven last, its normal first"}},
       true,
       Get<Resume, &Policy::resume>,
       Set<Resume, &Policy::resume>},
      {kAdmit,
       "admit",
       "normals that are satisfied at first sight",
       "4.3: C = NC = empty, only driven indices enter; 4.1: \"NC = {k+1, ..., n-1}; since ai >= 0 for "
       "all i in NC\"",
       {{"lazy", "stay in no set until driven (4.3)"},
        {"eager", "at every outer scan each normal in no set with fN = 0, aN >= 0 enters NC (4.1)"}},
       true,
       Get<Admit, &Policy::admit>,
       Set<Admit, &Policy::admit>},
      {kFile,
       "file",
       "friction that is satisfied at a scan",
       "5.2: \"the static friction condition is trivially met\"; 5.3 files the driven variable only",
       {{"no", "stays in no set until driven"},
        {"yes",
         "is filed into CF, NC+ or NC- by the sign of aF; at fN = 0 with its normal in NC it "
         "counts as established and is filed when the contact is clamped"}},
       true,
       Get<File, &Policy::file>,
       Set<File, &Policy::file>},
      {kGiveUp,
       "give-up",
       "when a variable that wants back into the set it just left is given up",
       "5.5: \"If j attempts to move into a set it just came from, and the previous step size was zero\"",
       {{"first", "if the present step has length zero"},
        {"previous", "if the step before it had length zero (to the letter)"},
        {"second", "if both had length zero"}},
       true,
       Get<GiveUp, &Policy::give_up>,
       Set<GiveUp, &Policy::give_up>},
      {kDrop,
       "drop",
       "what a given-up normal takes along",
       "5.4: give up \"the normal or static friction conditions at the ith contact point\"; 5.5: \"j is "
       "removed from whatever index set it was in\"",
       {{"contact", "its friction variable too"}, {"variable", "nothing"}},
       true,
       Get<Drop, &Policy::drop>,
       Set<Drop, &Policy::drop>},
      {kRezero,
       "rezero",
       "after a friction force given up earlier was driven to zero",
       "5.5: \"we first drive fFi to zero\"",
       {{"rescan", "back to the main loop"},
        {"continue", "its friction is established at once if its normal holds"}},
       true,
       Get<Rezero, &Policy::rezero>,
       Set<Rezero, &Policy::rezero>},
      {kTies,
       "ties",
       "which of several variables limits a step that they limit together",
       "4.3: maxstep takes the strictly smallest s: d, then C, then NC",
       {{"sets", "driven, C, NC, CF, NC-, NC+; the lowest index in each"},
        {"contacts", "driven, then contact by contact, normal before friction"}},
       true,
       Get<Ties, &Policy::ties>,
       Set<Ties, &Policy::ties>},
      {kApex,
       "apex",
       "the friction index while fN = 0",
       "5.2: at fN = 0 the condition is trivially met; 5.3 does not say what becomes of the index",
       {{"kept", "stays in its set, fF = +-mu 0"},
        {"suspended", "rests, and is filed by the sign of aF when the contact is clamped again"}},
       true,
       Get<Apex, &Policy::apex>,
       Set<Apex, &Policy::apex>},
      {kSlip,
       "slip",
       "space only: a recorded direction no longer opposes the acceleration",
       "5.6: \"the friction force maintains the same direction it had when i most recently entered\"",
       {{"literal", "is not watched"},
        {"redirect", "is given up and driven anew"},
        {"polygon", "follows a polygon, by complete driving; no other switch is read"}},
       false,
       Get<Slip, &Policy::slip>,
       Set<Slip, &Policy::slip>},
  }};
}

std::string ValueNames(const PolicySwitchRow& row) {
  std::string names;
  for (const PolicyValue& value : row.values) names += (names.empty() ? "" : ", ") + std::string(value.name);
  return names;
}

void ApplySetting(Policy& policy, std::string_view setting) {
  const std::size_t equals = setting.find('=');
  const std::string_view name = setting.substr(0, equals);
  for (const PolicySwitchRow& row : PolicySwitches()) {
    if (row.name != name) continue;
    const std::string_view wanted = equals == setting.npos ? "" : setting.substr(equals + 1);
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      if (row.values[i].name == wanted) return row.set(policy, static_cast<int>(i));
    }
    throw std::invalid_argument("policy switch '" + std::string(name) + "': found '" + std::string(wanted) +
                                "', expected one of " + ValueNames(row));
  }
  std::string known;
  for (const PolicySwitchRow& row : PolicySwitches())
    known += (known.empty() ? "" : ", ") + std::string(row.name);
  throw std::invalid_argument("policy: found '" + std::string(setting) +
                              "', expected 'paper' or switches from " + known +
                              ", written switch=value and separated by commas");
}

}  // namespace

const std::array<PolicySwitchRow, kPolicySwitchCount>& PolicySwitches() {
  static const std::array<PolicySwitchRow, kPolicySwitchCount> switches = MakeSwitches();
  return switches;
}

std::string PolicyName(const Policy& policy) {
  std::string name;
  for (const PolicySwitchRow& row : PolicySwitches()) {
    const int value = row.get(policy);
    if (value == 0) continue;
    name += (name.empty() ? "" : ",") + std::string(row.name) + "=" + std::string(row.values[value].name);
  }
  return name.empty() ? "paper" : name;
}

Policy ParsePolicy(std::string_view text) {
  Policy policy;
  if (text == "paper") return policy;
  std::string seen;  // switches met, each between commas
  while (true) {
    const std::size_t comma = text.find(',');
    const std::string_view setting = text.substr(0, comma);
    ApplySetting(policy, setting);
    const std::string name = "," + std::string(setting.substr(0, setting.find('='))) + ",";
    if (seen.find(name) != seen.npos) {
      throw std::invalid_argument("policy: switch '" + name.substr(1, name.size() - 2) + "' stands twice");
    }
    seen += name;
    if (comma == text.npos) return policy;
    text.remove_prefix(comma + 1);
  }
}

const std::vector<Policy>& PlanarGrid() {
  static const std::vector<Policy> grid = [] {
    std::vector<Policy> policies = {Policy{}};
    for (const PolicySwitchRow& row : PolicySwitches()) {
      if (!row.planar) continue;
      std::vector<Policy> extended;
      for (const Policy& policy : policies) {
        for (std::size_t value = 0; value < row.values.size(); ++value) {
          extended.push_back(policy);
          row.set(extended.back(), static_cast<int>(value));
        }
      }
      policies = std::move(extended);
    }
    return policies;
  }();
  return grid;
}

std::vector<Policy> ParsePolicies(std::string_view text) {
  return text == "*" ? PlanarGrid() : std::vector<Policy>{ParsePolicy(text)};
}

bool AgreeOn(SwitchMask mask, const Policy& left, const Policy& right) {
  for (const PolicySwitchRow& row : PolicySwitches()) {
    if ((mask & Bit(row.id)) != 0 && row.get(left) != row.get(right)) return false;
  }
  return true;
}

}  // namespace stiction
