// SPDX-License-Identifier: Apache-2.0
// The records that stand beside the program.

#ifndef STICTION_CLI_RECORDS_H_
#define STICTION_CLI_RECORDS_H_

#include <filesystem>
#include <vector>

#include "corpus/store/store.h"
#include "reports/page/frontiers.h"

namespace stiction {

// Of the repository that the program was built in, or of the package that installed it.
std::filesystem::path RecordsFolder();
// As a report tells them; none where there is no such folder. InputError if a record cannot be read.
std::vector<FrontierLine> KnownFrontiers();
// Of a store of an optimized search what a report tells beside them; none of another.
OwnSearch OwnSearchOf(const Store& store);

}  // namespace stiction

#endif  // STICTION_CLI_RECORDS_H_
