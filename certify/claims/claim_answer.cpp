// SPDX-License-Identifier: Apache-2.0
#include "certify/claims/claim_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "certify/claims/claims.h"
#include "corpus/grouped.h"
#include "corpus/json.h"

namespace stiction {
namespace {

const Claim* FindClaim(const std::vector<Claim>& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &Claim::name);
  return found == all.end() ? nullptr : &*found;
}

// What a certificate says, in words.
std::string MeaningOf(std::string_view claim) {
  const std::vector<Claim> all = AllClaims();
  const Claim* row = FindClaim(all, claim);
  if (row == nullptr) return "";
  return std::string(row->proves.empty() ? row->meaning : row->proves);
}

}  // namespace

std::string_view Name(ClaimState state) {
  switch (state) {
    case ClaimState::kProved:
      return "proved";
    case ClaimState::kDisproved:
      return "disproved";
    case ClaimState::kNotDecided:
      break;
  }
  return "not decided";
}

ClaimState PolicyCounts::State() const {
  if (asked > 0 && so == asked) return ClaimState::kProved;
  return so + open < asked ? ClaimState::kDisproved : ClaimState::kNotDecided;
}

ClaimAnswer ByCertificate(SharedJson found, const std::string& why_none) {
  ClaimAnswer answer;
  if (!found->is_object()) {
    answer.reason = found->is_string() ? found->get<std::string>() : why_none;
    return answer;
  }
  const std::vector<Claim> all = AllClaims();
  const Claim* row = FindClaim(all, found->at("claim").get<std::string>());
  answer.state = row != nullptr && row->negative ? ClaimState::kDisproved : ClaimState::kProved;
  answer.certificate = std::move(found);
  return answer;
}

std::string PoliciesSentence(const PolicyCounts& counts, std::string_view does, std::string_view plural) {
  const std::string asked = Grouped(counts.asked);
  if (counts.so == counts.asked) return fmt::format("all {} policies {}", asked, plural);
  std::string text =
      fmt::format("{} of {} policies {}", Grouped(counts.so), asked, counts.so == 1 ? does : plural);
  if (counts.so == 0)
    text = counts.open == 0 ? fmt::format("none of {} policies {}", asked, does)
                            : fmt::format("none of {} policies is shown to {}", asked, plural);
  const char* before = "; ";
  for (const auto& [end, count] : counts.otherwise) {
    text += fmt::format("{}{} {} {}", before, Grouped(count), count == 1 ? "ends in" : "end in", end);
    before = ", ";
  }
  return text;
}

SharedJson ToJson(const ClaimAnswer& answer, std::string_view claim) {
  Json json = {{"asked", claim}, {"state", Name(answer.state)}, {"certificate", answer.certificate}};
  if (!answer.reason.empty()) json["reason"] = answer.reason;
  if (const auto& counts = answer.policies) {
    json["policies"] = {{"asked", counts->asked},
                        {"so", counts->so},
                        {"certified", counts->certified},
                        {"otherwise", counts->otherwise}};
    if (!counts->example.empty()) json["policies"]["example"] = counts->example;
  }
  return json;
}

bool IsWholeCertificate(const Json& answer) {
  if (answer["certificate"].is_null() || answer["state"] == Name(ClaimState::kNotDecided)) return false;
  return answer["state"] == Name(ClaimState::kProved) || answer["certificate"]["claim"] != answer["asked"];
}

std::string ClaimSentence(const Json& answer) {
  const Json& certificate = answer["certificate"];
  const std::string named = certificate.is_object()   ? certificate["claim"].get<std::string>()
                            : certificate.is_string() ? certificate.get<std::string>()
                                                      : "";
  std::string text = answer["state"];
  if (!named.empty() && named != answer["asked"]) text += ", " + named;
  const std::string why = answer.value("reason", MeaningOf(named));
  return why.empty() ? text : text + ": " + why;
}

}  // namespace stiction
