// SPDX-License-Identifier: Apache-2.0
// What most units read of other libraries, precompiled once (CMakeLists.txt). No unit relies on it: each
// includes what it uses, and builds without precompiled headers as well.
#include <fmt/format.h>
#include <gmpxx.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>
