// SPDX-License-Identifier: Apache-2.0
#include "bench/peers/one_thread.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "corpus/input_error.h"
#include "corpus/json.h"
#include "corpus/stopwatch.h"

namespace stiction {
namespace {

bool IsOne(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && std::string_view(value) == "1";
}

}  // namespace

void RequireOneThread(char** argv) {
  if (std::all_of(kThreadVariables.begin(), kThreadVariables.end(), IsOne)) return;
  for (const char* variable : kThreadVariables) setenv(variable, "1", 1);
  execv("/proc/self/exe", argv);
  throw InputError(fmt::format("{}: cannot be started anew: {}", argv[0], std::strerror(errno)));
}

Clocks& Clocks::operator+=(const Clocks& other) {
  wall += other.wall;
  all += other.all;
  own += other.own;
  return *this;
}

Clocks operator-(const Clocks& left, const Clocks& right) {
  return {left.wall - right.wall, left.all - right.all, left.own - right.own};
}

Clocks ReadClocks() {
  Clocks clocks;
  clocks.own = ReadSeconds(CLOCK_THREAD_CPUTIME_ID);
  clocks.all = ReadSeconds(CLOCK_PROCESS_CPUTIME_ID);
  clocks.wall = ReadSeconds(CLOCK_MONOTONIC);
  return clocks;
}

int ThreadCount() {
  const std::filesystem::directory_iterator tasks("/proc/self/task");
  return static_cast<int>(std::distance(begin(tasks), end(tasks)));
}

std::vector<std::string> LoadedBlas() {
  std::vector<std::string> names;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const std::string name = line.substr(line.rfind('/') + 1);
    const bool is_blas = name.find("blas") != std::string::npos || name.find("lapack.") != std::string::npos;
    if (is_blas && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

Json ThreadsJson() {
  Json variables = Json::object();
  for (const char* variable : kThreadVariables) variables[variable] = std::getenv(variable);
  return {{"variables", variables}, {"blas", LoadedBlas()}};
}

std::string ThreadsText() {
  const std::vector<std::string> blas = LoadedBlas();
  return fmt::format("one thread for every package: {}=1; BLAS loaded: {}", fmt::join(kThreadVariables, "=1 "),
                     blas.empty() ? "none" : fmt::format("{}", fmt::join(blas, ", ")));
}

Json ToJson(const Clocks& clocks) {
  return {{"wall", clocks.wall}, {"all_threads", clocks.all}, {"one_thread", clocks.own}};
}

std::string ClocksText(const Clocks& clocks) {
  return fmt::format(
      "{:.1f} s of wall-clock time; processor time of all threads {:.1f} s, of the one that calls {:.1f} s; "
      "threads "
      "of this process: {}",
      clocks.wall, clocks.all, clocks.own, ThreadCount());
}

}  // namespace stiction
