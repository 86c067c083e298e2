// SPDX-License-Identifier: Apache-2.0
#include "search/under_test/host.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "corpus/descriptor.h"
#include "corpus/json.h"
#include "search/under_test/stiction_solver.h"

namespace stiction {
namespace {

// Functions of the library.
struct Library {
  decltype(&stiction_solver_describe) describe = nullptr;
  decltype(&stiction_solver_create) create = nullptr;
  decltype(&stiction_solver_solve) solve = nullptr;
  decltype(&stiction_solver_destroy) destroy = nullptr;
};

template <class Function>
void Find(void* handle, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(handle, name));
  if (function == nullptr) throw InputError(fmt::format("no function {}", name));
}

// InputError says what is missing.
Library Load(const std::string& file) {
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw InputError(dlerror());
  Library library;
  Find(handle, "stiction_solver_describe", library.describe);
  Find(handle, "stiction_solver_create", library.create);
  Find(handle, "stiction_solver_solve", library.solve);
  Find(handle, "stiction_solver_destroy", library.destroy);
  const stiction_solver_info* const info = library.describe();
  if (info == nullptr) throw InputError("stiction_solver_describe returns nothing");
  const int interface = info->interface;
  if (interface != STICTION_SOLVER_INTERFACE)
    throw InputError(fmt::format("interface {}, expected {}", interface, int{STICTION_SOLVER_INTERFACE}));
  return library;
}

// A problem in the form of the library; keeps its memory, lest a leak hide in ours.
class Posed {
 public:
  void Take(const Json& request, bool is_box) {
    A_.clear();
    for (const Json& row : request.at("A")) A_.insert(A_.end(), row.begin(), row.end());
    b_ = request.at("b").get<std::vector<double>>();
    mu_ = request.at("mu").get<std::vector<double>>();
    kinds_.clear(), low_.clear(), high_.clear(), findex_.clear();
    const int dimension = request.at("dimension");
    const double infinity = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < mu_.size(); ++i) {
      const std::string& kind = request.at("kinds")[i].get_ref<const std::string&>();
      kinds_.push_back(kind == "bilateral"      ? STICTION_BILATERAL
                       : kind == "frictionless" ? STICTION_FRICTIONLESS
                                                : STICTION_STATIC);
      const int normal = static_cast<int>(low_.size());
      Add(kind == "bilateral" ? -infinity : 0, infinity, -1);
      const double bound = is_box ? request.at("bounds")[i].get<double>() : mu_[i];
      for (int k = 1; k < dimension && kind == "static"; ++k) Add(-bound, bound, is_box ? -1 : normal);
    }
    problem_ = {static_cast<int>(mu_.size()),
                dimension,
                static_cast<int>(b_.size()),
                A_.data(),
                b_.data(),
                mu_.data(),
                kinds_.data(),
                low_.data(),
                high_.data(),
                findex_.data()};
    forces_.assign(b_.size(), 0);
  }

  const stiction_solver_problem* problem() const { return &problem_; }
  std::vector<double>& forces() { return forces_; }

 private:
  void Add(double low, double high, int findex) {
    low_.push_back(low);
    high_.push_back(high);
    findex_.push_back(findex);
  }

  std::vector<double> A_, b_, mu_, low_, high_, forces_;
  std::vector<int> kinds_, findex_;
  stiction_solver_problem problem_ = {};
};

// Null where it is not finite.
Json ForcesToJson(const std::vector<double>& forces) {
  Json json = Json::array();
  for (const double force : forces) json.push_back(std::isfinite(force) ? Json(force) : Json());
  return json;
}

int AnswerAll(const std::string& file) {
  const int out = dup(STDOUT_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  Library library;
  try {
    library = Load(file);
  } catch (const InputError& error) {
    WriteAll(out, JsonText({{"error", error.what()}}) + "\n");
    return 1;
  }
  const stiction_solver_info& info = *library.describe();
  const auto text = [](const char* said) { return said == nullptr ? std::string() : std::string(said); };
  const bool is_box = text(info.law) == "box";
  const Json greeting = {{"solver", text(info.name)},
                         {"version", text(info.version)},
                         {"law", text(info.law)},
                         {"accuracy", NumberToJson(info.accuracy)},
                         {"protocol", 1}};
  WriteAll(out, greeting.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n");
  mallopt(M_TOP_PAD, 0);  // what leaks takes new pages at once
  malloc_trim(0);
  void* const solver = library.create();
  Posed posed;
  std::string line;
  while (std::getline(std::cin, line)) {
    posed.Take(Json::parse(line), is_box);
    const int solved = library.solve(solver, posed.problem(), posed.forces().data());
    if (!WriteAll(out, JsonText({{"solved", solved != 0}, {"f", ForcesToJson(posed.forces())}}) + "\n")) break;
  }
  library.destroy(solver);
  return 0;
}

}  // namespace

std::optional<int> RunAsSolverHost(int argc, char** argv) {
  if (argc != 3 || std::string_view(argv[1]) != kSolverHostWord) return std::nullopt;
  return AnswerAll(argv[2]);
}

}  // namespace stiction
