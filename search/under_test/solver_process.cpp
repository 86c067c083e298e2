// SPDX-License-Identifier: Apache-2.0
#include "search/under_test/solver_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <limits>
#include <set>

#include "certify/exact/line_process.h"
#include "corpus/exact_problem.h"
#include "corpus/json.h"
#include "search/under_test/host.h"
#include "solver/problem/units.h"

namespace stiction {
namespace {

constexpr double kLookEvery = 0.05;      // seconds between looks at its processor time
constexpr double kLeastPatience = 0.25;  // of the clock, however little time it has
constexpr int kMostStarved = 6;          // times as long where it waits for a processor

// What stands in an answer for a number that no double holds.
constexpr std::string_view kBeyondDoubles = "beyond doubles";

// The number that begins at `at`, if it is one that overflows; `end` is behind it.
bool Overflows(const std::string& line, std::size_t at, std::size_t& end) {
  constexpr std::string_view kOfNumbers = "+-.0123456789eE";
  end = std::min(line.find_first_not_of(kOfNumbers, at), line.size());
  double value = 0;
  const auto read = std::from_chars(line.data() + at, line.data() + end, value);
  if (read.ec != std::errc::result_out_of_range || read.ptr != line.data() + end) return false;
  return std::abs(std::strtod(line.substr(at, end - at).c_str(), nullptr)) > 1;  // not one that underflows
}

// A line as JSON: what Python and others write that JSON has no word for is null, and what is beyond doubles a
// text. In one pass.
std::string AsJson(const std::string& line) {
  std::string json;
  json.reserve(line.size());
  const std::string_view text = line;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"') {  // a text, as it is
      std::size_t end = at + 1;
      while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
      end = std::min(end + 1, text.size());
      json.append(text.substr(at, end - at));
      at = end;
      continue;
    }
    std::size_t word = 0;
    for (const std::string_view known : {"-Infinity", "Infinity", "NaN"})
      if (word == 0 && text.substr(at, known.size()) == known) word = known.size();
    if (word > 0) {
      json += "null";
      at += word;
      continue;
    }
    std::size_t end = at + 1;
    if (c == '-' || (c >= '0' && c <= '9')) {
      json.append(Overflows(line, at, end) ? fmt::format("\"{}\"", kBeyondDoubles) : line.substr(at, end - at));
    } else {
      json += c;
    }
    at = end;
  }
  return json;
}

// Forces as it wrote them; null is not finite, nor is what no double holds. Empty if this is no answer, or two.
std::optional<SolverReply> ReadReply(const std::string& line, int rows) {
  std::set<std::string> keys;
  bool is_one = true;
  const auto look = [&](int depth, Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::key && depth == 1)
      is_one = keys.insert(parsed.get<std::string>()).second && is_one;
    return true;
  };
  const Json json = Json::parse(AsJson(line), look, false);
  if (!is_one || !json.is_object() || !json.contains("solved") || !json["solved"].is_boolean())
    return std::nullopt;
  SolverReply reply;
  reply.solved = json["solved"].get<bool>();
  reply.f = Eigen::VectorXd::Zero(rows);
  if (!json.contains("f")) return reply.solved ? std::nullopt : std::optional(reply);
  const Json& f = json["f"];
  if (!f.is_array() || f.size() != static_cast<std::size_t>(rows)) return std::nullopt;
  for (int i = 0; i < rows; ++i) {
    const bool is_beyond = f[i] == kBeyondDoubles;
    if (!f[i].is_number() && !f[i].is_null() && !is_beyond) return std::nullopt;
    reply.is_in_range = reply.is_in_range && !is_beyond;
    reply.f[i] = f[i].is_number() ? f[i].get<double>() : std::numeric_limits<double>::quiet_NaN();
  }
  return reply;
}

std::string RequestOf(const ContactProblem<double>& posed, SolverLaw law) {
  Json A = Json::array(), mu = Json::array(), kinds = Json::array();
  for (int i = 0; i < posed.rows(); ++i)
    A.push_back(std::vector<double>(posed.A.row(i).begin(), posed.A.row(i).end()));
  for (const auto& contact : posed.contacts) {
    mu.push_back(contact.mu);
    kinds.push_back(Name(contact.kind));
  }
  Json request = {{"dimension", posed.dimension},
                  {"A", std::move(A)},
                  {"b", std::vector<double>(posed.b.begin(), posed.b.end())},
                  {"mu", std::move(mu)},
                  {"kinds", std::move(kinds)}};
  if (law == SolverLaw::kBox) request["bounds"] = FixedBounds(posed);
  return JsonText(request) + "\n";
}

// What it says of itself; `keeps_memory`: that it is not to be asked for leaks.
SolverUnderTest ReadGreeting(const std::string& line, const std::string& source, bool& keeps_memory) {
  const JsonPlace root(line, source);
  root.RequireObject();
  if (const auto error = root.Optional("error")) throw InputError(source + ": " + error->Text("a text"));
  const auto text = [&root](const char* key) { return root.Required(key, "a text").Text("a text"); };
  root.Required("protocol", "1").Integer(1, 1, "1");
  SolverUnderTest about = {text("solver"), text("version"), {}, ""};
  const std::string law = text("law");
  const auto* const known = std::find(kSolverLawNames.begin(), kSolverLawNames.end(), law);
  if (known == kSolverLawNames.end())
    root.Required("law", "a law").Refuse(fmt::format("one of {}", fmt::join(kSolverLawNames, ", ")));
  about.law = static_cast<SolverLaw>(known - kSolverLawNames.begin());
  const JsonPlace accuracy = root.Required("accuracy", "a number above 0");
  const double stated = accuracy.Number("a number above 0");
  if (!(stated > 0)) accuracy.Refuse("a number above 0");
  if (about.name.empty()) root.Required("solver", "a name").Refuse("a name");
  const auto leaks = root.Optional("leaks");
  keeps_memory = leaks && !leaks->Truth("true or false: whether leaks are looked for");
  about.accuracy = fmt::format("{}", stated);
  return about;
}

// Stops a search: its counts would be of two solvers.
class SolverChanged : public InputError {
 public:
  using InputError::InputError;
};

std::string HowItEnded(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("exit-{}", WEXITSTATUS(status));
  const char* const name = sigabbrev_np(WTERMSIG(status));
  std::string how = name == nullptr ? std::to_string(WTERMSIG(status)) : name;
  std::ranges::transform(how, how.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return "sig" + how;
}

}  // namespace

std::vector<std::string> SolverCommand(const std::filesystem::path& file) {
  const std::string path = std::filesystem::absolute(file).string();
  const std::string name = file.filename().string();
  if (name.ends_with(".so") || name.find(".so.") != name.npos) return {"/proc/self/exe", kSolverHostWord, path};
  return {path};
}

ContactProblem<double> PosedFor(SolverLaw law, const ContactProblem<double>& problem) {
  if (law != SolverLaw::kFrictionless) return problem;
  ContactProblem<double> posed;
  posed.dimension = problem.dimension;
  const std::vector<int> rows = NormalRowsOf(problem);
  for (Contact<double> contact : problem.contacts) {
    if (contact.HasFrictionRows()) contact = {ContactKind::kFrictionless, 0, {}};
    posed.contacts.push_back(contact);
  }
  posed.A = problem.A(rows, rows);
  posed.b = problem.b(rows);
  return posed;
}

std::vector<double> FixedBounds(const ContactProblem<double>& problem) {
  std::vector<double> bounds;
  ForEachContact(problem, [&](int i, int row, int) {
    const double own = problem.A(row, row);
    bounds.push_back(own > 0 ? problem.contacts[i].mu * std::abs(problem.b[row]) / own : 0);
  });
  return bounds;
}

SolverProcess::SolverProcess(std::vector<std::string> command, std::function<bool()> stopped, double greeting)
    : command_(std::move(command)), stopped_(std::move(stopped)), greeting_(greeting) {
  Start();
}

SolverProcess::~SolverProcess() {
  if (statm_ >= 0) close(statm_);
}

void SolverProcess::Start() {
  const std::string& file = command_.back();
  process_ = std::make_unique<LineProcess>(
      command_, "a library NAME.so or a program that may be executed",
      LineBounds{kSolverLine, stopped_, [this](std::string_view text) { TakeErrors(text); }});
  const auto start = LineProcess::Clock::now();
  const LineProcess::Line line = process_->Read(LineProcess::After(greeting_));
  const double took = std::chrono::duration<double>(LineProcess::Clock::now() - start).count();
  if (line.end != LineProcess::End::kLine) {
    const std::optional<int> status =
        line.end == LineProcess::End::kDied ? process_->WaitStatus() : std::nullopt;
    process_.reset();
    seconds_ += took;
    throw InputError(
        fmt::format("{}: found no greeting{}, expected a line of JSON that says what the solver is", file,
                    status ? ": it ended, " + HowItEnded(*status) : ""));
  }
  SolverUnderTest about = ReadGreeting(line.text, file, keeps_memory_);
  if (!about_.name.empty() && about != about_)
    throw SolverChanged(file +
                        ": found another solver than before, expected the same one as long as it is tested");
  about_ = std::move(about);
  // The next time no longer than it takes, or as a problem may.
  greeting_ = std::min(greeting_, kSolverPatience * std::max(kSolverSeconds, took));
  if (statm_ >= 0) close(statm_);
  statm_ = open(fmt::format("/proc/{}/statm", process_->id()).c_str(), O_RDONLY | O_CLOEXEC);
  first_memory_ = last_memory_ = Memory();
  const auto most = static_cast<rlim_t>(first_memory_ + kSolverBytes);
  const rlimit memory = {most, most};
  prlimit(process_->id(), RLIMIT_DATA, &memory, nullptr);
}

// False, with what there is to say, if it does not greet this time.
bool SolverProcess::StartAgain(SolverReply& reply) {
  try {
    Start();
    return true;
  } catch (const SolverChanged&) {
    throw;
  } catch (const InputError&) {
    process_.reset();
    reply = {.end = SolverEnd::kCrashed, .f = {}, .how = std::string(kNoGreeting)};
    if (stopped_()) reply = {.end = SolverEnd::kStopped, .f = {}, .how = ""};
    return false;
  }
}

// A line at a time and without what moves a cursor, as far as the bound goes.
void SolverProcess::TakeErrors(std::string_view text) {
  if (errors_ > kSolverErrors) return;
  std::string shown;
  bool is_more = false;
  for (const char c : text) {
    is_more = errors_ + shown.size() >= kSolverErrors;
    if (is_more) break;
    if (line_begins_) shown += "solver: ";
    line_begins_ = c == '\n';
    const auto byte = static_cast<unsigned char>(c);
    shown += c == '\n' || c == '\t' || (byte >= 0x20 && byte != 0x7f) ? c : '?';
  }
  errors_ += shown.size();
  if (is_more) {
    errors_ = kSolverErrors + 1;
    shown += fmt::format("{}solver: writes more than that on standard error; what follows is not shown\n",
                         line_begins_ ? "" : "\n");
  }
  std::fwrite(shown.data(), 1, shown.size(), stderr);
}

std::int64_t SolverProcess::Memory() const {
  char text[128] = {};
  if (!process_ || statm_ < 0 || pread(statm_, text, sizeof text - 1, 0) <= 0) return 0;
  long long total = 0, resident = 0, shared = 0, code = 0, unused = 0, data = 0;
  if (std::sscanf(text, "%lld %lld %lld %lld %lld %lld", &total, &resident, &shared, &code, &unused, &data) !=
      6)
    return 0;
  return data * sysconf(_SC_PAGESIZE);
}

double SolverProcess::ProcessSeconds() const {
  clockid_t clock;
  timespec time = {};
  if (clock_getcpuclockid(process_->id(), &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// That it could run, and had no processor.
double SolverProcess::SecondsInQueue() const {
  double running = 0, waiting = 0;  // nanoseconds
  std::ifstream(fmt::format("/proc/{}/schedstat", process_->id())) >> running >> waiting;
  return 1e-9 * waiting;
}

void SolverProcess::Restart() { process_.reset(); }

SolverReply SolverProcess::Solve(const ContactProblem<double>& posed, double seconds) {
  const std::string request = RequestOf(posed, about_.law);
  SolverReply reply = AskOnce(request, posed.rows(), seconds);
  if (reply.how == kAsleep) reply = AskOnce(request, posed.rows(), seconds);
  return reply;
}

SolverReply SolverProcess::AskOnce(const std::string& request, int rows, double seconds) {
  SolverReply reply;
  if (!process_ && !StartAgain(reply)) return reply;
  const double before = ProcessSeconds();
  const auto start = LineProcess::Clock::now();
  reply = Ask(request, rows, seconds);
  const std::chrono::duration<double> clock = LineProcess::Clock::now() - start;
  if (reply.how == kAsleep || reply.how == "closed") {
    seconds_ += clock.count();
  } else if (process_) {
    seconds_ += std::max(0.0, ProcessSeconds() - before);
  }
  if (process_) last_memory_ = Memory();
  if (reply.end != SolverEnd::kAnswered) Restart();
  return reply;
}

SolverReply SolverProcess::Ask(const std::string& request, int rows, double seconds) {
  const auto crashed = [](const char* how) {
    return SolverReply{.end = SolverEnd::kCrashed, .f = {}, .how = how};
  };
  if (process_->HasMore()) return crashed("unasked");
  const double before = ProcessSeconds(), queued = SecondsInQueue();
  const double patience = std::max(kLeastPatience, kSolverPatience / 2 * seconds);
  const auto start = LineProcess::Clock::now();
  LineProcess::End end = process_->Write(request, LineProcess::After(patience));
  bool is_spent = false;  // the processor time
  while (end == LineProcess::End::kLine || end == LineProcess::End::kTimeout) {
    const LineProcess::Line line =
        process_->Read(LineProcess::After(end == LineProcess::End::kLine ? kLookEvery : 0));
    if (line.end == LineProcess::End::kLine) {
      if (auto reply = ReadReply(line.text, rows)) return *std::move(reply);
      return crashed("garbled");
    }
    if (line.end != LineProcess::End::kTimeout) {
      end = line.end;
      break;
    }
    is_spent = ProcessSeconds() - before > seconds;
    const double clock = std::chrono::duration<double>(LineProcess::Clock::now() - start).count();
    const bool is_asleep = clock - (SecondsInQueue() - queued) > patience || clock > kMostStarved * patience;
    if (end == LineProcess::End::kTimeout || is_spent || is_asleep)
      return {.end = SolverEnd::kHung, .f = {}, .how = is_spent ? "" : std::string(kAsleep)};
  }
  if (end == LineProcess::End::kFlood) return crashed("flood");
  if (end == LineProcess::End::kStopped) return {.end = SolverEnd::kStopped, .f = {}, .how = ""};
  return Died();
}

SolverReply SolverProcess::Died() {
  const bool was_full = last_memory_ - first_memory_ > kSolverBytes / 2;
  const std::optional<int> status = process_->WaitStatus();
  if (!status && stopped_()) return {.end = SolverEnd::kStopped, .f = {}, .how = ""};
  const std::string how = !status    ? (process_->IsGuarded() ? "closed" : "killed-its-guard")
                          : was_full ? "out-of-memory"
                                     : HowItEnded(*status);
  return {.end = SolverEnd::kCrashed, .f = {}, .how = how};
}

}  // namespace stiction
