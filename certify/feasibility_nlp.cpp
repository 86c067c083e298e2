// SPDX-License-Identifier: Apache-2.0
#include "certify/feasibility_nlp.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <queue>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "certify/verify_solution.h"
#include "solver/check.h"

namespace stiction {

namespace {

using enum Mode;
using Clock = std::chrono::steady_clock;

constexpr int kProtocol = 1;
constexpr double kGreetingPatience = 30;  // seconds; loading libraries on a busy machine

Clock::time_point After(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

double SecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

}  // namespace

// ---- The process ---------------------------------------------------------------------------------

// A running stiction-ipopt, whose standard input and output are one socket: unlike a pipe it can be written to
// without SIGPIPE, and without touching the signals of this program. It ends when the socket is closed.
class IpoptProposer::Process {
 public:
  enum class End { kLine, kDied, kTimeout };
  struct Line {
    End end = End::kLine;
    std::string text;
  };

  // InputError if it cannot be run.
  explicit Process(const std::filesystem::path& program) {
    std::array<int, 2> ends;
    STICTION_CHECK(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0, std::strerror(errno));
    socket_ = ends[0];
    const int error = Spawn(program.string(), ends[1]);
    close(ends[1]);
    if (error == 0) return;
    close(socket_);
    throw InputError(fmt::format("{}: cannot be run: {}; expected the program stiction-ipopt", program.string(),
                                 std::strerror(error)));
  }

  ~Process() {
    close(socket_);
    kill(id_, SIGKILL);  // it holds nothing
    while (waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }

  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  int id() const { return id_; }

  // kLine once all is written.
  End Write(const std::string& text, Clock::time_point deadline) {
    for (std::size_t written = 0; written < text.size();) {
      const ssize_t count =
          send(socket_, text.data() + written, text.size() - written, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count > 0) {
        written += static_cast<std::size_t>(count);
      } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
        if (!Wait(POLLOUT, deadline)) return End::kTimeout;
      } else if (errno != EINTR) {
        return End::kDied;
      }
    }
    return End::kLine;
  }

  // The next line, without its end.
  Line Read(Clock::time_point deadline) {
    while (true) {
      const std::size_t end = received_.find('\n');
      if (end != std::string::npos) {
        Line line{End::kLine, received_.substr(0, end)};
        received_.erase(0, end + 1);
        return line;
      }
      if (!Wait(POLLIN, deadline)) return {End::kTimeout, {}};
      if (!Receive()) return {End::kDied, {}};
    }
  }

  Line Exchange(const std::string& request, Clock::time_point deadline) {
    const End end = Write(request, deadline);
    return end == End::kLine ? Read(deadline) : Line{end, {}};
  }

 private:
  // In a process group of its own, so that an interrupt at the terminal is ours to handle. An errno, or 0.
  int Spawn(std::string program, int socket) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none;
    sigemptyset(&none);
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, socket, STDOUT_FILENO);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    std::array<char*, 2> arguments = {program.data(), nullptr};
    const int error = posix_spawn(&id_, program.c_str(), &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
  }

  // False if the deadline comes first. The socket is ready, too, if the process died.
  bool Wait(short events, Clock::time_point deadline) const {
    while (true) {
      const double left = std::chrono::duration<double>(deadline - Clock::now()).count();
      if (left <= 0) return false;
      pollfd socket = {socket_, events, 0};
      const double milliseconds = std::min(std::ceil(left * 1000), 1e9);
      if (poll(&socket, 1, static_cast<int>(milliseconds)) > 0) return true;
    }
  }

  // False if there will be nothing more.
  bool Receive() {
    std::array<char, 65536> buffer;
    const ssize_t count = recv(socket_, buffer.data(), buffer.size(), 0);
    if (count < 0 && errno == EINTR) return true;
    if (count <= 0) return false;
    received_.append(buffer.data(), static_cast<std::size_t>(count));
    return true;
  }

  pid_t id_ = -1;
  int socket_ = -1;
  std::string received_;
};

namespace {

// Whether `line` is what a program of this protocol says first.
bool IsGreeting(const std::string& line) {
  const Json json = Json::parse(line, nullptr, false);
  return json.is_object() && json.value("program", Json()) == "stiction-ipopt" &&
         json.value("protocol", Json()) == kProtocol;
}

}  // namespace

std::filesystem::path FindIpoptProgram() {
  static constexpr const char* kName = "stiction-ipopt";
  std::error_code error;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* place : {"", "..", "certify/ipopt", "../certify/ipopt"}) {
    const auto candidate = (folder / place / kName).lexically_normal();
    if (std::filesystem::is_regular_file(candidate, error)) return candidate;
  }
  return folder / kName;
}

// ---- Requests ------------------------------------------------------------------------------------

namespace {

// f = force f', where f' solves the problem with A / max abs(A_ij), b / max abs(b_i).
struct ScaledProblem {
  std::vector<double> mu, slip;  // by contact
  std::vector<std::vector<double>> A;
  std::vector<double> b;
  Rational force;
};

template <class Values>
Rational Largest(const Values& values) {
  Rational largest = 0;
  for (const Rational& value : values.reshaped()) largest = std::max(largest, Rational(abs(value)));
  return largest == 0 ? Rational(1) : largest;
}

ScaledProblem MakeScaled(const ExactProblem& problem) {
  const Rational A_unit = Largest(problem.A), b_unit = Largest(problem.b);
  ScaledProblem scaled;
  for (const auto& contact : problem.contacts) {
    scaled.mu.push_back(ToDouble(contact.mu));
    scaled.slip.push_back(ToDouble(contact.slip[0]));
    if (!std::isfinite(scaled.mu.back())) {
      throw InputError("mu: found " + Shortened(ToString(contact.mu)) + ", expected a finite double for ipopt");
    }
  }
  for (int i = 0; i < problem.rows(); ++i) {
    scaled.b.push_back(ToDouble(problem.b[i] / b_unit));
    auto& row = scaled.A.emplace_back();
    for (int j = 0; j < problem.rows(); ++j) row.push_back(ToDouble(problem.A(i, j) / A_unit));
  }
  scaled.force = b_unit / A_unit;
  return scaled;
}

const char* KindName(ContactKind kind) {
  static constexpr std::array<const char*, 4> kNames = {"bilateral", "frictionless", "static", "sliding"};
  return kNames[static_cast<int>(kind)];
}

// One start a request, since words near a point that is no solution may have one. first_start is to be set.
Json MakeRequest(const ExactProblem& problem, const ScaledProblem& scaled, const ProposalOptions& options) {
  Json contacts = Json::array();
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    Json& contact = contacts.emplace_back(Json{{"kind", KindName(problem.contacts[i].kind)}});
    if (problem.contacts[i].HasFrictionRows()) contact["mu"] = scaled.mu[i];
    if (problem.contacts[i].kind == ContactKind::kSliding) contact["slip"] = scaled.slip[i];
  }
  const bool quadratic = options.formulation == Formulation::kQuadratic;
  return {{"dimension", problem.dimension},
          {"contacts", contacts},
          {"A", scaled.A},
          {"b", scaled.b},
          {"options",
           {{"max_iterations", options.max_iterations},
            {"starts", 1},
            {"seed", options.seed},
            {"formulation", quadratic ? "qp" : "nlp"}}}};
}

void RequireHandled(const ExactProblem& problem, const ProposalOptions& options) {
  STICTION_CHECK(options.starts >= 1 && options.max_iterations >= 1 && options.words >= 1,
                 "ipopt: starts, iterations and words are at least 1");
  STICTION_CHECK(options.patience > 0 && options.patience <= 1e6, "ipopt: patience is from 0 to 1e6 seconds");
  if (problem.dimension != 2) throw InputError("dimension: found 3, expected 2 for ipopt");
  if (options.formulation == Formulation::kNonlinear) return;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    if (problem.contacts[i].kind == ContactKind::kFrictionless) continue;
    throw InputError(fmt::format("contacts[{}].kind: found {}, expected frictionless for equation (5)", i,
                                 KindName(problem.contacts[i].kind)));
  }
}

}  // namespace

// What the process answered.
struct IpoptProposer::Point {
  std::vector<double> f;
  int starts = 0;
};

// ---- Words near a point --------------------------------------------------------------------------

namespace {

// A second mode of a contact is tried if the point breaks its conditions by no more than this, on a scale where
// the largest entries of A and b are 1. Wide, since at a degenerate solution Ipopt's accuracy is a root of its
// tolerance, and near a singular A worse; the order and number of words bound what this costs.
constexpr double kNear = 0.1;

struct RankedMode {
  Mode mode;
  double broken;  // by how much the point breaks the conditions
};

double ConditionsBroken(Mode mode, double mu, double slip, double f_n, double f_t, double a_n, double a_t) {
  const double negative = std::max(-f_n, 0.0);
  switch (mode) {
    case kHold:
      return std::abs(a_n);
    case kBreak:
      return std::abs(f_n) + std::abs(f_t) + std::max(-a_n, 0.0);
    case kTouch:
      return negative + std::abs(a_n) + std::abs(f_t + mu * slip * f_n);
    case kStick:
      return std::abs(a_n) + std::abs(a_t) + std::max(std::abs(f_t) - mu * f_n, 0.0);
    case kSlipPlus:
      return negative + std::abs(a_n) + std::abs(f_t + mu * f_n) + std::max(-a_t, 0.0);
    case kSlipMinus:
      return negative + std::abs(a_n) + std::abs(f_t - mu * f_n) + std::max(a_t, 0.0);
  }
  STICTION_FAIL("no such mode");
}

// By contact, best first: the best mode and those that are near.
std::vector<std::vector<RankedMode>> RankModes(const ExactProblem& problem, const ScaledProblem& scaled,
                                               const std::vector<double>& f) {
  std::vector<double> a = scaled.b;
  for (std::size_t i = 0; i < f.size(); ++i) {
    for (std::size_t j = 0; j < f.size(); ++j) a[i] += scaled.A[i][j] * f[j];
  }
  std::vector<std::vector<RankedMode>> ranked;
  int row = 0;
  for (std::size_t i = 0; i < problem.contacts.size(); ++i) {
    const auto& contact = problem.contacts[i];
    const bool rough = contact.HasFrictionRows();
    auto& modes = ranked.emplace_back();
    for (const Mode mode : ModesOf(contact)) {
      modes.push_back({mode, ConditionsBroken(mode, scaled.mu[i], scaled.slip[i], f[row],
                                              rough ? f[row + 1] : 0, a[row], rough ? a[row + 1] : 0)});
    }
    std::stable_sort(modes.begin(), modes.end(), [](auto& x, auto& y) { return x.broken < y.broken; });
    while (modes.size() > 1 && modes.back().broken > kNear) modes.pop_back();
    row += rough ? 2 : 1;
  }
  return ranked;
}

// The words made of ranked modes, in the order of the sum of `broken`.
class WordsByRank {
 public:
  explicit WordsByRank(std::vector<std::vector<RankedMode>> modes) : modes_(std::move(modes)) {
    Push(std::vector<int>(modes_.size(), 0));
  }

  std::optional<ModeWord> Next() {
    if (waiting_.empty()) return std::nullopt;
    const std::vector<int> ranks = waiting_.top().second;
    waiting_.pop();
    ModeWord word;
    for (std::size_t i = 0; i < ranks.size(); ++i) word.push_back(modes_[i][ranks[i]].mode);
    // Every word is reached once: by raising ranks from the first contact to the last.
    for (std::size_t i = ranks.size(); i-- > 0;) {
      if (ranks[i] + 1 < static_cast<int>(modes_[i].size())) {
        std::vector<int> raised = ranks;
        ++raised[i];
        Push(std::move(raised));
      }
      if (ranks[i] > 0) break;
    }
    return word;
  }

 private:
  using Entry = std::pair<double, std::vector<int>>;

  void Push(std::vector<int> ranks) {
    double sum = 0;
    for (std::size_t i = 0; i < ranks.size(); ++i) sum += modes_[i][ranks[i]].broken;
    waiting_.emplace(sum, std::move(ranks));
  }

  std::vector<std::vector<RankedMode>> modes_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting_;
};

// ---- The equations of a word ---------------------------------------------------------------------

// A force that a word leaves open: x (e_row + f_t e_(row + 1)).
struct Unknown {
  int row;
  Rational f_t;
};

struct WordEquations {
  std::vector<Unknown> unknowns;
  std::vector<int> zero_accelerations;  // rows; as many
};

WordEquations EquationsOf(const ExactProblem& problem, const ModeWord& word) {
  WordEquations equations;
  int row = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const auto& contact = problem.contacts[i];
    Rational f_t = 0;
    if (word[i] == kSlipPlus) f_t = -contact.mu;
    if (word[i] == kSlipMinus) f_t = contact.mu;
    if (word[i] == kTouch && contact.kind == ContactKind::kSliding) f_t = -contact.mu * contact.slip[0];
    if (word[i] != kBreak) {
      equations.unknowns.push_back({row, f_t});
      equations.zero_accelerations.push_back(row);
    }
    if (word[i] == kStick) {
      equations.unknowns.push_back({row + 1, 0});
      equations.zero_accelerations.push_back(row + 1);
    }
    row += contact.HasFrictionRows() ? 2 : 1;
  }
  return equations;
}

// A reduced echelon form of C x = d over rationals.
class Echelon {
 public:
  // Rows of (C, d).
  explicit Echelon(std::vector<std::vector<Rational>> rows) : rows_(std::move(rows)) {
    const int columns = static_cast<int>(rows_.size());
    std::size_t rank = 0;
    for (int column = 0; column < columns && rank < rows_.size(); ++column) {
      if (!Pivot(rank, column)) continue;
      pivots_.push_back(column);
      ++rank;
    }
    for (std::size_t i = rank; i < rows_.size(); ++i) consistent_ = consistent_ && rows_[i].back() == 0;
  }

  bool consistent() const { return consistent_; }
  bool regular() const { return pivots_.size() == rows_.size(); }

  // The solution whose free variables are those of x.
  std::vector<Rational> Complete(std::vector<Rational> x) const {
    for (const int column : pivots_) x[column] = 0;
    std::vector<Rational> solution = x;
    for (std::size_t i = 0; i < pivots_.size(); ++i) {
      Rational value = rows_[i].back();
      for (std::size_t j = 0; j < x.size(); ++j) {
        if (x[j] != 0) value -= rows_[i][j] * x[j];
      }
      solution[pivots_[i]] = value;
    }
    return solution;
  }

 private:
  // False if the column has no pivot in row `rank` or below.
  bool Pivot(std::size_t rank, int column) {
    std::size_t pivot = rank;
    while (pivot < rows_.size() && rows_[pivot][column] == 0) ++pivot;
    if (pivot == rows_.size()) return false;
    std::swap(rows_[rank], rows_[pivot]);
    const Rational inverse = 1 / rows_[rank][column];
    for (Rational& value : rows_[rank]) value *= inverse;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const Rational factor = rows_[i][column];
      if (i == rank || factor == 0) continue;
      for (std::size_t j = 0; j < rows_[i].size(); ++j) {
        if (rows_[rank][j] != 0) rows_[i][j] -= factor * rows_[rank][j];
      }
    }
    return true;
  }

  std::vector<std::vector<Rational>> rows_;
  std::vector<int> pivots_;  // column by row
  bool consistent_ = true;
};

Echelon Eliminate(const ExactProblem& problem, const WordEquations& equations) {
  std::vector<std::vector<Rational>> rows;
  for (const int i : equations.zero_accelerations) {
    auto& row = rows.emplace_back();
    for (const Unknown& unknown : equations.unknowns) {
      row.push_back(problem.A(i, unknown.row));
      if (unknown.f_t != 0) row.back() += unknown.f_t * problem.A(i, unknown.row + 1);
    }
    row.push_back(-problem.b[i]);
  }
  return Echelon(std::move(rows));
}

ExactVector Forces(const ExactProblem& problem, const WordEquations& equations,
                   const std::vector<Rational>& x) {
  ExactVector f = ExactVector::Constant(problem.rows(), Rational(0));
  for (std::size_t j = 0; j < x.size(); ++j) {
    f[equations.unknowns[j].row] += x[j];
    if (equations.unknowns[j].f_t != 0) f[equations.unknowns[j].row + 1] += equations.unknowns[j].f_t * x[j];
  }
  return f;
}

// The law of every kind; the shorter check besides, where it applies.
bool IsSolution(const ExactProblem& problem, const ExactVector& f) {
  if (FindLawViolation(problem, f)) return false;
  const bool simple = std::all_of(problem.contacts.begin(), problem.contacts.end(), [](const auto& contact) {
    return contact.kind == ContactKind::kFrictionless || contact.kind == ContactKind::kStatic;
  });
  STICTION_CHECK(!simple || !FindViolation(problem, f), "two exact checks of a solution agree");
  return true;
}

// `near`: forces close to the point, of few bits. Where the equations leave forces free they are taken as zero,
// then as in `near`: inside its word Ipopt's point has room for the others to follow.
std::optional<ExactVector> SolveWord(const ExactProblem& problem, const ModeWord& word,
                                     const std::vector<Rational>& near) {
  const WordEquations equations = EquationsOf(problem, word);
  const Echelon echelon = Eliminate(problem, equations);
  if (!echelon.consistent()) return std::nullopt;
  std::vector<Rational> free(equations.unknowns.size());
  const ExactVector f = Forces(problem, equations, echelon.Complete(free));
  if (IsSolution(problem, f)) return f;
  if (echelon.regular()) return std::nullopt;
  for (std::size_t j = 0; j < free.size(); ++j) free[j] = near[equations.unknowns[j].row];
  const ExactVector other = Forces(problem, equations, echelon.Complete(free));
  return IsSolution(problem, other) ? std::optional(other) : std::nullopt;
}

// Multiples of 2^-20, so that their numbers are short; in the units of the problem.
std::vector<Rational> Rounded(const std::vector<double>& f, const Rational& unit) {
  std::vector<Rational> rounded;
  for (const double x : f) rounded.push_back(Rational(std::round(x * 0x1p20) * 0x1p-20) * unit);
  return rounded;
}

// The words near one point that were not tried before.
std::optional<ExactVector> SolveNearbyWords(const ExactProblem& problem, const ScaledProblem& scaled,
                                            const std::vector<double>& f, int budget, std::set<ModeWord>& tried,
                                            ProposalStatistics& statistics) {
  const std::vector<Rational> near = Rounded(f, scaled.force);
  WordsByRank words(RankModes(problem, scaled, f));
  bool first = true;
  for (int count = 0; count < budget; ++count, first = false) {
    const auto word = words.Next();
    if (!word) break;
    if (!tried.insert(*word).second) continue;
    ++statistics.words;
    auto solution = SolveWord(problem, *word, near);
    if (!solution) continue;
    statistics.first_words += first;
    return solution;
  }
  return std::nullopt;
}

}  // namespace

// ---- The proposer --------------------------------------------------------------------------------

IpoptProposer::IpoptProposer(const std::filesystem::path& program) : program_(program) { StartProcess(); }

IpoptProposer::~IpoptProposer() = default;

int IpoptProposer::process_id() const { return process_ ? process_->id() : -1; }

void IpoptProposer::StartProcess() {
  auto process = std::make_unique<Process>(program_);
  const Process::Line line = process->Read(After(kGreetingPatience));
  if (line.end == Process::End::kLine && IsGreeting(line.text)) {
    process_ = std::move(process);
    return;
  }
  throw InputError(fmt::format(
      "{}: found {}, expected the program stiction-ipopt, protocol {}", program_.string(),
      line.end == Process::End::kLine ? "\"" + Shortened(line.text) + "\"" : "no greeting", kProtocol));
}

std::optional<IpoptProposer::Point> IpoptProposer::Ask(const std::string& request, double patience,
                                                       ProposalStatistics& statistics) {
  ++statistics.requests;
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (!process_) {
      ++statistics.restarts;
      StartProcess();
    }
    // Kept only if it answers: whatever is thrown ends it.
    std::unique_ptr<Process> process = std::move(process_);
    const Process::Line line = process->Exchange(request, After(patience));
    if (line.end == Process::End::kLine) {
      Point point = ReadPoint(line.text, statistics);
      process_ = std::move(process);
      return point;
    }
    if (line.end == Process::End::kTimeout) {
      ++statistics.timeouts;
      return std::nullopt;
    }
  }
  return std::nullopt;
}

IpoptProposer::Point IpoptProposer::ReadPoint(const std::string& text, ProposalStatistics& statistics) const {
  const Json json = ParseJson(text, program_.string());
  STICTION_CHECK(json.value("status", "") != "refused", "stiction-ipopt refused: " + Shown(json));
  Point point;
  try {
    point = {json.at("f").get<std::vector<double>>(), json.at("starts").get<int>()};
    statistics.iterations += json.at("iterations").get<std::int64_t>();
    statistics.ipopt_seconds += json.at("seconds").get<double>();
  } catch (const Json::exception& error) {
    throw InputError(
        fmt::format("{}: found {} ({}), expected an answer", program_.string(), Shown(json), error.what()));
  }
  statistics.starts += point.starts;
  return point;
}

std::optional<ExactVector> IpoptProposer::Search(const ExactProblem& problem, const ProposalOptions& options,
                                                 ProposalStatistics& statistics) {
  const ScaledProblem scaled = MakeScaled(problem);
  Json request = MakeRequest(problem, scaled, options);
  std::set<ModeWord> tried;
  for (int start = 0; start < options.starts; ++start) {
    request["options"]["first_start"] = start;
    const auto point = Ask(JsonText(request) + "\n", options.patience, statistics);
    if (!point) return std::nullopt;
    if (static_cast<int>(point->f.size()) != problem.rows()) {
      throw InputError(
          fmt::format("{}: found {} forces, expected {}", program_.string(), point->f.size(), problem.rows()));
    }
    auto solution = SolveNearbyWords(problem, scaled, point->f, options.words, tried, statistics);
    if (solution) return solution;
  }
  return std::nullopt;
}

std::optional<ExactVector> IpoptProposer::ProposeSolution(const ExactProblem& problem,
                                                          const ProposalOptions& options,
                                                          ProposalStatistics& statistics) {
  const Clock::time_point begin = Clock::now();
  RequireHandled(problem, options);
  auto solution = Search(problem, options, statistics);
  ++statistics.problems;
  statistics.solved += solution.has_value();
  statistics.seconds += SecondsSince(begin);
  return solution;
}

}  // namespace stiction
