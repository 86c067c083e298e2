// SPDX-License-Identifier: Apache-2.0
// Whether what a store holds can be what its campaign left, read as strictly as a problem file.
//
// Seals (corpus/store/store_rows.h) tell what was changed by accident. This tells what no search writes: a kind
// that does not exist, a unit of another generator, a certificate of another problem, a statistic with an
// unknown key. Nothing is solved or verified again: `stiction check` does that.

#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "search/campaign.h"

namespace stiction {

// InputError that names the file, the row, what was found and what was expected.
// `show`, if any, is told how many of how many findings were looked at.
using ShowFindings = std::function<void(std::int64_t done, std::int64_t of)>;
void RequireSound(const Store& store, const std::string& file, const ShowFindings& show = {});
void RequireSound(const Finding& finding, const Campaign& campaign, const std::string& file);
void RequireSound(const Record& total, const Campaign& campaign, const std::string& file);

// A store to read, of which all is as it must be.
Store OpenSound(const std::string& file, const ShowFindings& show = {});

}  // namespace stiction
