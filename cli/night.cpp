// SPDX-License-Identifier: Apache-2.0
#include "cli/night.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <thread>

#include "corpus/descriptor.h"
#include "corpus/grouped.h"
#include "corpus/record/kinds.h"
#include "search/units/known_signatures.h"

namespace stiction {
namespace {

constexpr double kFirstLine = 10, kLastLine = 600;  // seconds between lines, at first and at last
constexpr std::size_t kNamed = 5;                   // signatures that a line names
constexpr double kPatience = 60;                    // seconds for a command

constexpr std::size_t kNewsAtOnce = 20;  // lines of new groups, after which the others are counted

constexpr int kRed = 31, kGreen = 32;  // of a terminal

// Text for standard error: in colour where that is a terminal and NO_COLOR is not set (no-color.org).
std::string Coloured(const std::string& text, int colour) {
  const char* const refused = std::getenv("NO_COLOR");
  if (isatty(STDERR_FILENO) == 0 || (refused != nullptr && *refused != '\0')) return text;
  return fmt::format("\033[{}m{}\033[0m", colour, text);
}

// "cycle-2c-4d-8s-cc8da49e0296c085: integers, 2 contacts, in the corpus: NAME". Loops and what is grave in
// colour.
std::string LineOf(const Finding& finding) {
  const bool loop = finding.exact_outcome == "cycle" || finding.exact_outcome == "stall";
  const std::string known(KnownAs(finding.signature));
  const std::string name = IsGrave(finding.kind) ? Coloured(finding.signature + " GRAVE", kRed)
                           : loop                ? Coloured(finding.signature, kGreen)
                                                 : finding.signature;
  return fmt::format("{}: {}, {} contact{}{}", name, finding.generator, finding.contacts,
                     finding.contacts == 1 ? "" : "s", known.empty() ? "" : ", in the corpus: " + known);
}

std::string NewsText(const std::vector<Finding>& news) {
  if (news.empty()) return "nothing new";
  std::int64_t known = 0, grave = 0;
  std::string names;
  for (std::size_t i = 0; i < news.size(); ++i) {
    const std::string& signature = news[i].signature;
    known += !KnownAs(signature).empty();
    grave += IsGrave(news[i].kind);
    if (i < kNamed) names += (i > 0 ? ", " : "") + signature;
  }
  if (news.size() > kNamed) names += ", ...";
  std::string text = fmt::format("{} new group{}", news.size(), news.size() == 1 ? "" : "s");
  if (known > 0) text += fmt::format(", {} of them in the corpus", known);
  if (grave > 0) text += fmt::format(", {} GRAVE", grave);
  return text + ": " + names;
}

}  // namespace

std::string TimeOfDay() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(now));
}

ShowFindings Reading(ProgressBar& bar, const std::string& file) {
  const std::string which = file.empty() ? "" : file + ": ";
  return [&bar, which](std::int64_t done, std::int64_t of) {
    bar.ShowSome(done, of,
                 [&] { return fmt::format("{}{} of {} read", which, Grouped(done), Counted(of, "finding")); });
  };
}

// ---- The log ---------------------------------------------------------------------------------

void NightLog::Show(const SearchProgress& progress) {
  if (!problems_) problems_ = progress.problems_before;
  news_.insert(news_.end(), progress.news.begin(), progress.news.end());
  if (bar_.IsShown()) {
    PrintNews();
    return bar_.Show(Fraction(progress), Line(progress));
  }
  const double passed = progress.seconds - last_;
  if (passed >= std::clamp(progress.seconds / 20, kFirstLine, kLastLine) ||
      (!news_.empty() && passed >= kFirstLine))
    Print(progress);
}

void NightLog::Finish(const SearchProgress& progress) {
  if (!problems_) problems_ = progress.problems_before;
  news_.insert(news_.end(), progress.news.begin(), progress.news.end());
  bar_.Clear();
  if (bar_.IsShown()) PrintNews();
  if (!bar_.IsShown() && !news_.empty()) Print(progress);
}

// On a terminal; the bar is drawn again below.
void NightLog::PrintNews() {
  if (news_.empty()) return;
  bar_.Clear();
  const std::string time = TimeOfDay().substr(11);
  for (std::size_t i = 0; i < std::min(news_.size(), kNewsAtOnce); ++i)
    fmt::print(stderr, "{} {}\n", time, LineOf(news_[i]));
  if (news_.size() > kNewsAtOnce)
    fmt::print(stderr, "{} and {} more\n", time,
               Counted(static_cast<std::int64_t>(news_.size() - kNewsAtOnce), "new group"));
  news_.clear();
}

void NightLog::Print(const SearchProgress& progress) {
  fmt::print(stderr, "{} {}; since {:.0f} s ago {}, {}\n", TimeOfDay(), Line(progress),
             progress.seconds - last_, Counted(progress.problems - *problems_, "problem"), NewsText(news_));
  std::fflush(stderr);
  last_ = progress.seconds;
  problems_ = progress.problems;
  news_.clear();
}

double NightLog::Fraction(const SearchProgress& progress) const {
  double fraction = 0;
  if (minutes_) fraction = progress.seconds / (*minutes_ * 60);
  if (progress.units_wanted && *progress.units_wanted > 0) {
    fraction = std::max(fraction,
                        static_cast<double>(progress.units_done) / static_cast<double>(*progress.units_wanted));
  }
  return std::min(fraction, 1.0);
}

std::string NightLog::Line(const SearchProgress& progress) const {
  if (progress.only_finishes)
    return fmt::format("{} finished, {} to finish", Counted(progress.finished, "finding"),
                       Grouped(progress.pending));
  const double fraction = Fraction(progress);
  const auto now = static_cast<double>(progress.problems - progress.problems_before);
  std::string text = fmt::format(
      "{}, {} a second, {} in {}, {} to finish", Counted(progress.problems, "problem"),
      Grouped(static_cast<std::int64_t>(now / std::max(progress.seconds, 1e-9))),
      Counted(progress.findings, "finding"), Counted(progress.groups, "group"), Grouped(progress.pending));
  if (progress.left_out > 0) text += fmt::format(" and {} left out", Grouped(progress.left_out));
  if (progress.time.Total() > 0 && progress.time.finishing > 0)
    text += fmt::format(", finishing {} % of the time", 100 * progress.time.finishing / progress.time.Total());
  if (fraction > 0) text += fmt::format(", {:.0f} s left", progress.seconds * (1 - fraction) / fraction);
  return text;
}

// ---- Commands --------------------------------------------------------------------------------

SharedJson ToJson(const Finding& finding) {
  const auto embedded = [&finding](const std::string& text) {
    return text.empty() ? SharedJson() : SharedJson(JsonPlace(text, finding.signature).json());
  };
  return {{"signature", finding.signature},
          {"kind", finding.kind},
          {"grave", IsGrave(finding.kind)},
          {"known", std::string(KnownAs(finding.signature))},
          {"unit", finding.unit},
          {"index", finding.index},
          {"generator", finding.generator},
          {"contacts", finding.contacts},
          {"policy", finding.policy},
          {"inexact_outcome", finding.inexact_outcome},
          {"exact_outcome", finding.exact_outcome},
          {"problem", embedded(finding.problem)},
          {"facts", embedded(finding.facts)}};
}

namespace {

std::vector<std::string> EnvironmentOf(const Finding& finding, const std::string& store) {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (std::strncmp(*variable, "STICTION_", 9) != 0) variables.emplace_back(*variable);
  }
  const auto add = [&variables](const char* name, const std::string& value) {
    variables.push_back(fmt::format("STICTION_{}={}", name, value));
  };
  add("SIGNATURE", finding.signature);
  add("KIND", finding.kind);
  add("GRAVE", IsGrave(finding.kind) ? "1" : "0");
  add("KNOWN", std::string(KnownAs(finding.signature)));
  add("CONTACTS", std::to_string(finding.contacts));
  add("UNIT", std::to_string(finding.unit));
  add("INDEX", std::to_string(finding.index));
  add("STORE", store);
  return variables;
}

// In a group of its own: a signal of the terminal that ends the search does not end it, and all of it can be
// killed. Zero if it cannot be started; errno says why.
pid_t Start(const std::string& command, int input, const std::vector<std::string>& variables) {
  std::vector<char*> environment;
  for (const std::string& variable : variables) environment.push_back(const_cast<char*>(variable.c_str()));
  environment.push_back(nullptr);
  const char* words[] = {"/bin/sh", "-c", command.c_str(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);  // standard output is the summary's
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t id = 0;
  errno = posix_spawn(&id, words[0], &actions, &attributes, const_cast<char**>(words), environment.data());
  const bool started = errno == 0;
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return started ? id : 0;
}

// How it ended; empty if well.
std::string WaitFor(pid_t id) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kPatience);
  int status = 0;
  while (waitpid(id, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) {
      kill(-id, SIGKILL);
      waitpid(id, &status, 0);
      return fmt::format("was still running after {:.0f} s, and was killed", kPatience);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (WIFSIGNALED(status)) return fmt::format("was ended by signal {}", WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? "" : fmt::format("ended with status {}", WEXITSTATUS(status));
}

}  // namespace

void RunOnFinding(const std::string& command, const std::string& store, const Finding& finding) {
  const Descriptor input = FileInMemory("finding", JsonText(ToJson(finding)) + "\n");
  const pid_t id = input.valid() ? Start(command, input.number(), EnvironmentOf(finding, store)) : 0;
  const std::string trouble = id > 0 ? WaitFor(id) : fmt::format("cannot be started: {}", std::strerror(errno));
  if (!trouble.empty())
    fmt::print(stderr, "{} --on-finding: the command for {} {}\n", TimeOfDay(), finding.signature, trouble);
}

}  // namespace stiction
