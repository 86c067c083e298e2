// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/campaign_identity.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "corpus/json.h"
#include "corpus/plain_text.h"

namespace stiction {
namespace {

// A definition key by key, of a value that is an object each of its keys too ("solver name"); of one that is no
// object the whole.
std::map<std::string, std::string> PartsOf(const CampaignIdentity& identity) {
  std::map<std::string, std::string> parts;
  const Json definition = Json::parse(identity.definition, nullptr, false);
  if (definition.is_object()) {
    for (const auto& [key, value] : definition.items()) {
      if (!value.is_object()) {
        parts[key] = PlainValue(value);
        continue;
      }
      for (const auto& [member, inner] : value.items()) parts[key + " " + member] = PlainValue(inner);
    }
  } else {
    parts["definition"] = identity.definition;
  }
  const Json policies = Json::parse(identity.policies, nullptr, false);
  parts["policies"] = policies.is_array() ? PlainValue(policies) : identity.policies;
  parts["seed"] = std::to_string(identity.seed);
  parts["version of the algorithm"] = std::to_string(identity.algorithm);
  return parts;
}

// Of a value that is long, its beginning.
std::string Brief(const std::string& value) {
  constexpr std::size_t kMost = 40;
  if (value.empty()) return "none";
  return value.size() <= kMost ? value : value.substr(0, kMost - 3) + "...";
}

}  // namespace

SharedJson JsonOrText(const std::string& text) {
  Json json = Json::parse(text, nullptr, false);
  return json.is_discarded() ? Json(text) : json;
}

SharedJson RemarksOf(const CampaignIdentity& identity) {
  Json remarks = JsonOrText(identity.remarks);
  return remarks.is_object() ? remarks : Json::object();
}

SharedJson ToldDefinition(const CampaignIdentity& identity) {
  Json definition = JsonOrText(identity.definition);
  if (definition.is_object()) definition.update(*RemarksOf(identity));
  return definition;
}

std::string CampaignText(const CampaignIdentity& identity) {
  Json campaign = ToldDefinition(identity);
  const Json policies = Json::parse(identity.policies, nullptr, false);
  if (!campaign.is_object()) return identity.definition + "\n";
  if (policies.is_array()) campaign["policies"] = policies;
  return JsonText(campaign, 1) + "\n";
}

std::vector<CampaignDifference> DifferencesOf(const CampaignIdentity& a, const CampaignIdentity& b) {
  auto of_a = PartsOf(a), of_b = PartsOf(b);
  std::vector<CampaignDifference> differences;
  for (const auto& [part, value] : of_a) {
    if (of_b[part] != value) differences.push_back({part, value, of_b[part]});
  }
  for (const auto& [part, value] : of_b) {
    if (!of_a.contains(part)) differences.push_back({part, "", value});
  }
  return differences;
}

std::string Difference(const CampaignIdentity& stored, const CampaignIdentity& wanted) {
  constexpr std::size_t kMost = 3;
  const std::vector<CampaignDifference> differences = DifferencesOf(stored, wanted);
  std::string text;
  for (std::size_t i = 0; i < std::min(kMost, differences.size()); ++i) {
    const auto& [part, there, here] = differences[i];
    text += fmt::format("{}{} {}, not {}", i > 0 ? "; " : "", part, Brief(there), Brief(here));
  }
  return differences.size() <= kMost ? text : fmt::format("{}; and {} more", text, differences.size() - kMost);
}

}  // namespace stiction
