// SPDX-License-Identifier: Apache-2.0
// The records that stand beside the program.

#pragma once

#include <filesystem>
#include <vector>

#include "corpus/store/store.h"
#include "reports/page/frontiers.h"

namespace stiction {

// The folder of the repository that the program was built in, or of the package that installed it.
std::filesystem::path RecordsFolder();
// As a report tells them; none where there is no such folder. InputError if a record cannot be read.
std::vector<FrontierLine> KnownFrontiers();
// What a report tells of the store of an optimized search beside them; nothing of another store.
OwnSearch OwnSearchOf(const Store& store);

}  // namespace stiction
