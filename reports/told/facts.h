// SPDX-License-Identifier: Apache-2.0
// What a store holds as facts for told.h: a number has the name that report.txt says it by.

#pragma once

#include "corpus/store/store_totals.h"
#include "reports/told/told.h"

namespace stiction {

// Counts, the identity of the campaign, and the tables of all that was counted. The totals must outlive it.
Facts FactsOf(const StoreTotals& totals, const CampaignIdentity& identity);

}  // namespace stiction
