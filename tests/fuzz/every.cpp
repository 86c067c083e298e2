// SPDX-License-Identifier: Apache-2.0
// From the bytes of a file through every reader, every method and every writer: what `solve`, `survey`,
// `explain` and `import` do with it, in one process.

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include "certify/exact/answer_json.h"
#include "certify/request/entries.h"
#include "certify/request/facts.h"
#include "certify/request/request.h"
#include "cli/narration/explained.h"
#include "corpus/formats/read_problem.h"
#include "corpus/json.h"
#include "corpus/record/digest.h"
#include "solver/problem/check.h"
#include "tests/fuzz/same.h"
#include "tests/fuzz/targets.h"

namespace stiction::fuzz {
namespace {

constexpr Limits kLimits = {.drives = 50, .pivots = 100, .bits = 5000};
constexpr int kMostRows = 12;
constexpr std::int64_t kMostBits = 2000;  // of a number

// A file in memory, under the name that the process has for it.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : descriptor_(memfd_create("input", MFD_CLOEXEC)) {
    STICTION_CHECK(descriptor_ >= 0, "no file in memory");
    STICTION_CHECK(write(descriptor_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()),
                   "a file in memory that is cut");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { close(descriptor_); }

  std::string name() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  int descriptor_;
};

void RequireJson(const Json& value, std::string_view of) {
  STICTION_CHECK(Json::accept(JsonText(value)), fmt::format("{}: an answer that is no JSON", of));
}

bool IsSmall(const ExactProblem& problem) {
  const auto fits = [](const Rational& x) { return Bits(x) <= kMostBits; };
  bool all = problem.rows() <= kMostRows;
  for (int i = 0; all && i < problem.rows(); ++i) {
    all = fits(problem.b[i]);
    for (int j = 0; all && j < problem.rows(); ++j) all = fits(problem.A(i, j));
  }
  for (const auto& contact : problem.contacts) all = all && fits(contact.mu);
  return all;
}

// In every arithmetic that it is built in, by the law of the method and by Coulomb's.
void TakeMethods(const ProblemFile& file, const std::string& source) {
  for (const MethodFacts& facts : AllMethods()) {
    for (int a = 0; a < kArithmeticCount; ++a) {
      Wanted wanted;
      wanted.method = facts.name;
      wanted.arithmetic = Name(static_cast<Arithmetic>(a));
      wanted.request.limits = kLimits;
      Unrefused([&] {
        const Request request = RequestOf(wanted, file.problem, source);
        const Solution solution = SolveAsked(file.problem, request, source);
        RequireJson(SolutionToJson(solution, file.problem.dimension()),
                    fmt::format("{} over {}", wanted.method, wanted.arithmetic));
        return true;
      });
    }
  }
}

void TakeEntries(const AnyProblem& problem) {
  for (const std::string_view method : MethodsOfEntries(problem)) {
    const Solution solution{SolveEntries(problem, {.method = method, .limits = kLimits})};
    RequireJson(SolutionToJson(solution, problem.dimension()), method);
  }
}

void RequireWritten(const ProblemFile& file) {
  const std::string text = Print(file);
  STICTION_CHECK(Json::accept(text), "a problem file that is no JSON");
  STICTION_CHECK(IsSame(ParseProblem(text, "what was written").problem, file.problem),
                 "a problem that is read back to another");
}

}  // namespace

bool FuzzEvery(std::string_view bytes) {
  const MemoryFile input(bytes);
  const std::string source = input.name();
  const auto read = Unrefused([&] { return ReadProblem(source, kAnyRows); });
  if (!read) return false;
  const ProblemFile& file = *read;
  if (file.problem.rows() > kMostRows || !IsSmall(file.problem)) return true;
  RequireWritten(file);
  STICTION_CHECK(!ProblemDigest(file.problem).empty(), "a problem without a digest");
  TakeMethods(file, source);
  TakeEntries(file.problem);
  RequireJson(Surveyed(file.problem, kLimits), "survey");
  const Json explained = *Explained(file, {source, kLimits});
  RequireJson(explained, "explain");
  STICTION_CHECK(!ExplainedText(explained).empty(), "nothing to say of a problem");
  return true;
}

}  // namespace stiction::fuzz
