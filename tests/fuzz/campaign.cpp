// SPDX-License-Identifier: Apache-2.0
#include "search/campaign.h"

#include <stdexcept>

#include "solver/problem/check.h"
#include "tests/fuzz/targets.h"

namespace stiction::fuzz {
namespace {

constexpr std::size_t kMostTasks = 100000;

// A campaign with this definition, or with these policies.
bool TakesIdentity(const CampaignIdentity& identity) {
  const auto campaign = Unrefused([&identity] { return CampaignOf(identity, "input"); });
  if (!campaign) return false;
  const CampaignIdentity own = IdentityOf(*campaign);
  STICTION_CHECK(CampaignOf(own, "its own identity") == *campaign, "a campaign that is read back to another");
  if (campaign->contacts.size() * campaign->generators.size() > kMostTasks) return true;
  const std::vector<Task> schedule = Schedule(*campaign);
  for (const std::int64_t problems : {std::int64_t{0}, std::int64_t{1}, std::int64_t{1} << 53}) {
    const std::int64_t units = UnitsFor(*campaign, problems);
    STICTION_CHECK((units == 0) == (problems == 0) && units <= problems, "units without a problem");
  }
  STICTION_CHECK(UnitProblems(*campaign, TaskOf(schedule, 12345), 12345) >= 1, "a unit without problems");
  return true;
}

CampaignIdentity DefaultIdentity() { return IdentityOf(Campaign()); }

bool TakesPolicy(const std::string& text) {
  try {
    const Policy policy = ParsePolicy(text);
    STICTION_CHECK(ParsePolicy(PolicyName(policy)) == policy, "a policy that is read back to another");
    return true;
  } catch (const std::invalid_argument& refused) {
    STICTION_CHECK(std::string_view(refused.what()).starts_with("policy"),
                   "a refusal that does not say of what");
    return false;
  }
}

bool TakesMu(const std::string& text) {
  const auto mu = Unrefused([&text] { return ParseMu(text); });
  if (!mu) return false;
  STICTION_CHECK(Rational(mu->numerator, mu->denominator) == *ParseRational(text),
                 "another friction coefficient");
  return true;
}

}  // namespace

bool FuzzCampaign(std::string_view bytes) {
  const std::string text(bytes);
  CampaignIdentity identity = DefaultIdentity();
  if (text.starts_with('{')) {
    identity.definition = text;
    return TakesIdentity(identity);
  }
  if (text.starts_with('[')) {
    identity.policies = text;
    return TakesIdentity(identity);
  }
  return TakesPolicy(text) || TakesMu(text);
}

}  // namespace stiction::fuzz
