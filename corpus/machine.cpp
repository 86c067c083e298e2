// SPDX-License-Identifier: Apache-2.0
#include "corpus/machine.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

namespace stiction {
namespace {

double MemoryInGibibytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 30);
}

}  // namespace

std::string ProcessorModel(std::string_view cpuinfo) {
  constexpr std::string_view kKey = "model name";
  for (std::size_t start = 0; start < cpuinfo.size();) {
    const std::size_t end = std::min(cpuinfo.find('\n', start), cpuinfo.size());
    const std::string_view line = cpuinfo.substr(start, end - start);
    const std::size_t colon = line.find(':');
    if (line.starts_with(kKey) && colon != line.npos) {
      const std::size_t text = line.find_first_not_of(" \t", colon + 1);
      return text == line.npos ? "" : std::string(line.substr(text));
    }
    start = end + 1;
  }
  return "";
}

std::string MachineText() {
  std::ifstream file("/proc/cpuinfo");
  const std::string cpuinfo{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::string> parts;
  if (std::string model = ProcessorModel(cpuinfo); !model.empty()) parts.push_back(std::move(model));
  if (const unsigned cores = std::thread::hardware_concurrency(); cores > 0)
    parts.push_back(fmt::format("{} core{}", cores, cores == 1 ? "" : "s"));
  if (const double memory = MemoryInGibibytes(); memory > 0)
    parts.push_back(fmt::format("{} GiB", std::lround(memory)));
  if (utsname system; uname(&system) == 0)
    parts.push_back(fmt::format("{} {} {}", system.sysname, system.release, system.machine));
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace stiction
