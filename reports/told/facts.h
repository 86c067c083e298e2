// SPDX-License-Identifier: Apache-2.0
// What a store holds as facts for told.h: a number has the name that report.txt says it by.

#ifndef STICTION_REPORTS_TOLD_FACTS_H_
#define STICTION_REPORTS_TOLD_FACTS_H_

#include "corpus/store/store_totals.h"
#include "reports/told/told.h"

namespace stiction {

// Counts, the identity of the campaign, and the tables of all that was counted. The totals must outlive it.
Facts FactsOf(const StoreTotals& totals, const CampaignIdentity& identity);

}  // namespace stiction

#endif  // STICTION_REPORTS_TOLD_FACTS_H_
