// SPDX-License-Identifier: Apache-2.0
#include "search/under_test/solver_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <limits>

#include "certify/exact/line_process.h"
#include "corpus/exact_problem.h"
#include "corpus/json.h"
#include "search/under_test/host.h"

namespace stiction {
namespace {

constexpr double kLookEvery = 0.05;  // seconds between looks at its processor time
constexpr double kGreetingSeconds = 60;

// Python and others write what JSON has no word for.
std::string WithNulls(std::string line) {
  for (const char* word : {"-Infinity", "Infinity", "NaN"}) {
    for (std::size_t at = line.find(word); at != line.npos; at = line.find(word))
      line.replace(at, std::strlen(word), "null");
  }
  return line;
}

// Forces as it wrote them; what is no number is not finite. Empty if this is no answer.
std::optional<SolverReply> ReadReply(const std::string& line, int rows) {
  const Json json = Json::parse(WithNulls(line), nullptr, false);
  if (!json.is_object() || !json.contains("solved") || !json["solved"].is_boolean()) return std::nullopt;
  SolverReply reply;
  reply.solved = json["solved"].get<bool>();
  reply.f = Eigen::VectorXd::Zero(rows);
  if (!json.contains("f")) return reply.solved ? std::nullopt : std::optional(reply);
  const Json& f = json["f"];
  if (!f.is_array() || f.size() != static_cast<std::size_t>(rows)) return std::nullopt;
  for (int i = 0; i < rows; ++i)
    reply.f[i] = f[i].is_number() ? f[i].get<double>() : std::numeric_limits<double>::quiet_NaN();
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
  return request.dump() + "\n";
}

SolverUnderTest ReadGreeting(const std::string& line, const std::string& source) {
  const Json json = ParseJson(line, source);
  const JsonPlace root(json, source, "");
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
  const double stated = accuracy.json().is_number() ? accuracy.json().get<double>() : 0;
  if (!(stated > 0)) accuracy.Refuse("a number above 0");
  if (about.name.empty()) root.Required("solver", "a name").Refuse("a name");
  about.accuracy = fmt::format("{}", stated);
  return about;
}

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
  std::vector<int> rows;
  int row = 0;
  for (Contact<double> contact : problem.contacts) {
    rows.push_back(row);
    row += contact.HasFrictionRows() ? problem.dimension : 1;
    if (contact.HasFrictionRows()) contact = {ContactKind::kFrictionless, 0, {}};
    posed.contacts.push_back(contact);
  }
  posed.A = problem.A(rows, rows);
  posed.b = problem.b(rows);
  return posed;
}

std::vector<double> FixedBounds(const ContactProblem<double>& problem) {
  std::vector<double> bounds;
  int row = 0;
  for (const auto& contact : problem.contacts) {
    const double own = problem.A(row, row);
    bounds.push_back(own > 0 ? contact.mu * std::abs(problem.b[row]) / own : 0);
    row += contact.HasFrictionRows() ? problem.dimension : 1;
  }
  return bounds;
}

SolverProcess::SolverProcess(std::vector<std::string> command) : command_(std::move(command)) { Start(); }

SolverProcess::~SolverProcess() {
  if (statm_ >= 0) close(statm_);
}

void SolverProcess::Start() {
  const std::string& file = command_.back();
  process_ = std::make_unique<LineProcess>(command_, "a library NAME.so or a program that may be executed");
  const LineProcess::Line line = process_->Read(LineProcess::After(kGreetingSeconds));
  if (line.end != LineProcess::End::kLine)
    throw InputError(file + ": found no greeting, expected a line of JSON that says what the solver is");
  SolverUnderTest about = ReadGreeting(line.text, file);
  if (!about_.name.empty() && about != about_)
    throw InputError(file +
                     ": found another solver than before, expected the same one as long as it is tested");
  about_ = std::move(about);
  if (statm_ >= 0) close(statm_);
  statm_ = open(fmt::format("/proc/{}/statm", process_->id()).c_str(), O_RDONLY | O_CLOEXEC);
  first_memory_ = last_memory_ = Memory();
  const rlimit none = {0, 0};
  prlimit(process_->id(), RLIMIT_CORE, &none, nullptr);
  const auto most = static_cast<rlim_t>(first_memory_ + kSolverBytes);
  const rlimit memory = {most, most};
  prlimit(process_->id(), RLIMIT_DATA, &memory, nullptr);
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

void SolverProcess::Restart() { process_.reset(); }

SolverReply SolverProcess::Solve(const ContactProblem<double>& posed, double seconds) {
  const std::string request = RequestOf(posed, about_.law);
  SolverReply reply = AskOnce(request, posed.rows(), seconds);
  if (reply.how == kAsleep) reply = AskOnce(request, posed.rows(), seconds);
  return reply;
}

SolverReply SolverProcess::AskOnce(const std::string& request, int rows, double seconds) {
  if (!process_) Start();
  const double before = ProcessSeconds();
  SolverReply reply = Ask(request, rows, seconds);
  if (process_) {
    seconds_ += std::max(0.0, ProcessSeconds() - before);
    last_memory_ = Memory();
  }
  if (reply.end != SolverEnd::kAnswered) Restart();
  return reply;
}

SolverReply SolverProcess::Ask(const std::string& request, int rows, double seconds) {
  const double before = ProcessSeconds();
  const auto deadline = LineProcess::After(kSolverPatience * seconds);
  LineProcess::End end = process_->Write(request, deadline);
  bool is_spent = false;  // the processor time
  while (end == LineProcess::End::kLine) {
    const LineProcess::Line line = process_->Read(std::min(deadline, LineProcess::After(kLookEvery)));
    if (line.end == LineProcess::End::kLine) {
      if (auto reply = ReadReply(line.text, rows)) return *std::move(reply);
      return {SolverEnd::kCrashed, false, {}, "garbled"};
    }
    if (line.end == LineProcess::End::kDied) return Died();
    is_spent = ProcessSeconds() - before > seconds;
    if (is_spent || LineProcess::Clock::now() >= deadline) end = LineProcess::End::kTimeout;
  }
  if (end == LineProcess::End::kDied) return Died();
  return {SolverEnd::kHung, false, {}, is_spent ? "" : std::string(kAsleep)};
}

SolverReply SolverProcess::Died() {
  const bool was_full = last_memory_ - first_memory_ > kSolverBytes / 2;
  const std::string how = was_full ? "out-of-memory" : HowItEnded(process_->WaitStatus());
  process_.reset();
  return {SolverEnd::kCrashed, false, {}, how};
}

}  // namespace stiction
