// SPDX-License-Identifier: Apache-2.0
// stiction-ipopt: contact forces by nonlinear programming. It proposes; who asks must verify.
//
// Section 5.1 of [Baraff94] describes static friction as: minimize z of (17) subject to (18). With
// a = A f + b, z has absolute values and (18) a product. The same problem in smooth form takes the variables
// of the linear complementarity problem (solver/lemke/lemke.h), x = (f+, f-, l beside fN), fF = f+ - f-:
//
//   minimize    sum of fN aN + f+ (aF + l) + f- (l - aF) + l (mu fN - f+ - f-)
//   subject to  x >= 0,  aN >= 0,  aF + l >= 0,  l - aF >= 0,  mu fN - f+ - f- >= 0
//
// Every term of the sum is >= 0, and it is zero exactly at the solutions of (15), (16). For l = abs(aF) and
// f+ f- = 0 the sum is (17) wherever aF fF <= 0. All functions are linear or quadratic; constraints are linear:
// the complementarity is in the objective alone, since as constraints it would leave no interior. The
// objective is not convex: Ipopt may end in a local minimum above zero, hence several starts. Without
// friction the problem is the quadratic program (5).
//
// Other kinds: bilateral contacts have a free fN and aN = 0; sliding ones fF = -mu u fN (24), substituted.
//
// Protocol      one JSON object per line, in and out; certify/exact/feasibility_nlp.h.
// Determinism   of one binary on one machine: starts come from the seed. Bounded by starts x max_iterations.

#include <fcntl.h>
#include <unistd.h>

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace stiction {
namespace {

using Json = nlohmann::ordered_json;
using Vector = std::vector<double>;

constexpr int kProtocol = 1;
// At the end of a start: a sum of products, of a problem whose numbers are of the order of 1.
constexpr double kSolvedObjective = 1e-7;

// ---- Contacts ------------------------------------------------------------------------------------

struct Contact {
  std::string kind;
  double mu = 0, slip = 0;
  int row = 0;  // its normal

  bool HasFrictionRow() const { return kind == "static" || kind == "sliding"; }
};

void Require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument(message);
}

Contact ReadContact(const Json& json, int row) {
  Contact contact{json.at("kind"), json.value("mu", 0.0), json.value("slip", 0.0), row};
  Require(contact.kind == "bilateral" || contact.kind == "frictionless" || contact.HasFrictionRow(),
          "no such kind: " + contact.kind);
  Require(contact.mu >= 0, "a negative mu");
  return contact;
}

// ---- The program ---------------------------------------------------------------------------------

// Minimize the sum of x_j w_j, w = M x + q, subject to x >= 0, w >= 0; a free x_j has w_j = 0 instead.
struct Program {
  std::vector<Vector> M;
  Vector q;
  std::vector<bool> free;
  std::vector<Vector> forces;  // f = forces x: rows x variables

  int size() const { return static_cast<int>(q.size()); }
};

bool IsRough(const Contact& contact) { return contact.kind == "static" && contact.mu > 0; }

// Variables contact by contact: fN, and for static contacts with friction f+, f-, l.
Program MakeProgram(const std::vector<Contact>& contacts, const std::vector<Vector>& A, const Vector& b) {
  Program program;
  const int rows = static_cast<int>(b.size());
  int size = 0;
  for (const Contact& contact : contacts) size += IsRough(contact) ? 4 : 1;
  program.M.assign(size, Vector(size, 0.0));
  program.q.assign(size, 0.0);
  program.free.assign(size, false);
  program.forces.assign(rows, Vector(size, 0.0));
  int j = 0;
  for (const Contact& contact : contacts) {
    program.forces[contact.row][j] = 1;
    if (contact.kind == "sliding") program.forces[contact.row + 1][j] = -contact.mu * contact.slip;
    if (IsRough(contact)) {
      program.forces[contact.row + 1][j + 1] = 1;
      program.forces[contact.row + 1][j + 2] = -1;
    }
    j += IsRough(contact) ? 4 : 1;
  }
  const auto add_acceleration = [&](int to, int row, double sign) {
    program.q[to] += sign * b[row];
    for (int i = 0; i < rows; ++i) {
      for (int k = 0; k < size; ++k) program.M[to][k] += sign * A[row][i] * program.forces[i][k];
    }
  };
  j = 0;
  for (const Contact& contact : contacts) {
    add_acceleration(j, contact.row, 1);
    program.free[j] = contact.kind == "bilateral";
    if (IsRough(contact)) {
      add_acceleration(j + 1, contact.row + 1, 1);
      add_acceleration(j + 2, contact.row + 1, -1);
      program.M[j + 1][j + 3] += 1;
      program.M[j + 2][j + 3] += 1;
      program.M[j + 3][j] += contact.mu;
      program.M[j + 3][j + 1] -= 1;
      program.M[j + 3][j + 2] -= 1;
    }
    j += IsRough(contact) ? 4 : 1;
  }
  return program;
}

// ---- Requests ------------------------------------------------------------------------------------

struct Request {
  std::vector<Contact> contacts;
  Program program;
  int first_start = 0, starts = 1, max_iterations = 200;
  std::uint64_t seed = 0;
  bool quadratic = false;
};

Request ReadRequest(const std::string& line) {
  const Json json = Json::parse(line);
  Request request;
  Require(json.at("dimension") == 2, "dimension: expected 2");
  int rows = 0;
  for (const Json& contact : json.at("contacts")) {
    request.contacts.push_back(ReadContact(contact, rows));
    rows += request.contacts.back().HasFrictionRow() ? 2 : 1;
  }
  const auto A = json.at("A").get<std::vector<Vector>>();
  const auto b = json.at("b").get<Vector>();
  Require(static_cast<int>(b.size()) == rows && static_cast<int>(A.size()) == rows,
          "A, b: expected one row per variable");
  for (const Vector& row : A) Require(static_cast<int>(row.size()) == rows, "A: expected a square matrix");
  request.program = MakeProgram(request.contacts, A, b);
  const Json& options = json.at("options");
  request.first_start = options.value("first_start", 0);
  request.starts = options.at("starts");
  request.max_iterations = options.at("max_iterations");
  request.seed = options.at("seed");
  const std::string formulation = options.at("formulation");
  Require(formulation == "nlp" || formulation == "qp", "formulation: expected nlp or qp");
  request.quadratic = formulation == "qp";
  for (const Contact& contact : request.contacts) {
    Require(!request.quadratic || contact.kind == "frictionless", "qp: expected frictionless contacts only");
  }
  Require(request.first_start >= 0 && request.starts >= 1 && request.max_iterations >= 1,
          "options out of range");
  return request;
}

Vector Slacks(const Program& program, const double* x) {
  Vector w = program.q;
  for (int i = 0; i < program.size(); ++i) {
    for (int j = 0; j < program.size(); ++j) w[i] += program.M[i][j] * x[j];
  }
  return w;
}

// The objective.
double Gap(const Program& program, const double* x) {
  const Vector w = Slacks(program, x);
  double sum = 0;
  for (int i = 0; i < program.size(); ++i) sum += program.free[i] ? 0.0 : x[i] * w[i];
  return sum;
}

// How far x is from its constraints.
double Infeasibility(const Program& program, const Vector& x) {
  const Vector w = Slacks(program, x.data());
  double worst = 0;
  for (int i = 0; i < program.size(); ++i) {
    worst = std::max(worst, program.free[i] ? std::abs(w[i]) : std::max(-w[i], -x[i]));
  }
  return worst;
}

// ---- Starts --------------------------------------------------------------------------------------

// splitmix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  double Uniform(double low, double high) {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t word = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9u;
    word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
    word ^= word >> 31;
    return low + (high - low) * static_cast<double>(word >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

// The first start is the same for every seed: all forces equal, no friction. Others differ in magnitude too.
Vector Start(const Request& request, int start) {
  const Program& program = request.program;
  static constexpr double kMagnitudes[] = {1, 0.1, 10};
  Random random(request.seed * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(start));
  const double magnitude = kMagnitudes[start % 3];
  Vector x(program.size(), 0.0);
  std::vector<int> limits;  // the variables l
  int j = 0;
  for (const Contact& contact : request.contacts) {
    x[j] = start == 0 ? 1.0 : magnitude * random.Uniform(0, 2);
    if (IsRough(contact)) {
      const double friction = start == 0 ? 0.0 : contact.mu * x[j] * random.Uniform(-1, 1);
      x[j + 1] = std::max(friction, 0.0);
      x[j + 2] = std::max(-friction, 0.0);
      limits.push_back(j + 3);
    }
    j += IsRough(contact) ? 4 : 1;
  }
  const Vector w = Slacks(program, x.data());
  for (const int l : limits) x[l] = std::abs(w[l - 2]);  // abs(aF)
  return x;
}

// ---- Ipopt ---------------------------------------------------------------------------------------

class Complementarity : public Ipopt::TNLP {
 public:
  using Index = Ipopt::Index;
  using Number = Ipopt::Number;

  Complementarity(const Program& program, const Vector& start) : program_(program), x_(start) {}

  const Vector& x() const { return x_; }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override {
    n = m = program_.size();
    jacobian = n * n;
    hessian = n * (n + 1) / 2;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* x_low, Number* x_high, Index, Number* w_low, Number* w_high) override {
    for (int i = 0; i < n; ++i) {
      x_low[i] = program_.free[i] ? -kInfinite : 0;
      x_high[i] = kInfinite;
      w_low[i] = -program_.q[i];
      w_high[i] = program_.free[i] ? -program_.q[i] : kInfinite;
    }
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index, bool, Number*) override {
    std::copy(x_.begin(), x_.end(), x);
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& value) override {
    value = Gap(program_, x);
    return true;
  }

  bool eval_grad_f(Index n, const Number* x, bool, Number* gradient) override {
    const Vector w = Slacks(program_, x);
    for (int j = 0; j < n; ++j) {
      gradient[j] = program_.free[j] ? 0.0 : w[j];
      for (int i = 0; i < n; ++i) gradient[j] += program_.free[i] ? 0.0 : program_.M[i][j] * x[i];
    }
    return true;
  }

  // w - q.
  bool eval_g(Index n, const Number* x, bool, Index, Number* values) override {
    const Vector w = Slacks(program_, x);
    for (int i = 0; i < n; ++i) values[i] = w[i] - program_.q[i];
    return true;
  }

  bool eval_jac_g(Index n, const Number*, bool, Index, Index, Index* row, Index* column,
                  Number* values) override {
    for (int i = 0, k = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j, ++k) {
        if (values == nullptr) {
          row[k] = i;
          column[k] = j;
        } else {
          values[k] = program_.M[i][j];
        }
      }
    }
    return true;
  }

  bool eval_h(Index n, const Number*, bool, Number factor, Index, const Number*, bool, Index, Index* row,
              Index* column, Number* values) override {
    for (int i = 0, k = 0; i < n; ++i) {
      for (int j = 0; j <= i; ++j, ++k) {
        if (values == nullptr) {
          row[k] = i;
          column[k] = j;
        } else {
          values[k] =
              factor * ((program_.free[i] ? 0 : program_.M[i][j]) + (program_.free[j] ? 0 : program_.M[j][i]));
        }
      }
    }
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*, const Number*, Index,
                         const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    x_.assign(x, x + n);
  }

 private:
  static constexpr double kInfinite = 1e19;  // Ipopt's own

  const Program& program_;
  Vector x_;  // the start, then the result
};

// One application for all problems: making it anew doubles the time.
class Solver {
 public:
  Solver() : application_(new Ipopt::IpoptApplication(false)) {
    const auto options = application_->Options();
    options->SetIntegerValue("print_level", 0);
    options->SetStringValue("sb", "yes");  // no banner
    options->SetStringValue("jac_c_constant", "yes");
    options->SetStringValue("jac_d_constant", "yes");
    options->SetStringValue("hessian_constant", "yes");
    options->SetNumericValue("tol", 1e-9);
    options->SetNumericValue("bound_relax_factor", 0);
    // "" instead of an options file in the working directory.
    if (application_->Initialize("") != Ipopt::Solve_Succeeded)
      throw std::runtime_error("Ipopt does not start");
  }

  struct Result {
    Vector x;
    int iterations = 0;
  };

  Result Run(const Program& program, const Vector& start, int max_iterations) {
    application_->Options()->SetIntegerValue("max_iter", max_iterations);
    Ipopt::SmartPtr<Complementarity> problem = new Complementarity(program, start);
    application_->OptimizeTNLP(GetRawPtr(problem));
    Result result{problem->x(), 0};
    const auto statistics = application_->Statistics();
    if (IsValid(statistics)) result.iterations = statistics->IterationCount();
    return result;
  }

 private:
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application_;
};

// ---- Answers -------------------------------------------------------------------------------------

struct Answer {
  bool solved = false;
  Vector x;
  double objective = 0;
  double infeasibility = 0;
  int starts = 0;
  std::int64_t iterations = 0;
};

bool IsFinite(const Vector& x) {
  return std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
}

// Starts until one ends at zero; otherwise the best.
Answer Solve(Solver& solver, const Request& request) {
  const Program& program = request.program;
  Answer best;
  while (!best.solved && best.starts < request.starts) {
    const Vector start = Start(request, request.first_start + best.starts++);
    const Solver::Result result = solver.Run(program, start, request.max_iterations);
    best.iterations += result.iterations;
    if (!IsFinite(result.x)) continue;
    const double objective = Gap(program, result.x.data()), infeasibility = Infeasibility(program, result.x);
    if (!std::isfinite(objective) || !std::isfinite(infeasibility)) continue;
    if (!best.x.empty() && std::max(objective, infeasibility) >= std::max(best.objective, best.infeasibility))
      continue;
    best.x = result.x;
    best.objective = objective;
    best.infeasibility = infeasibility;
    best.solved = std::max(objective, infeasibility) <= kSolvedObjective;
  }
  return best;
}

Vector Forces(const Program& program, const Vector& x) {
  Vector f(program.forces.size(), 0.0);
  if (x.empty()) return f;
  for (std::size_t i = 0; i < f.size(); ++i) {
    for (int j = 0; j < program.size(); ++j) f[i] += program.forces[i][j] * x[j];
  }
  return f;
}

Json Reply(Solver& solver, const std::string& line) {
  const auto begin = std::chrono::steady_clock::now();
  const Request request = ReadRequest(line);
  const Program& program = request.program;
  Answer answer;
  if (program.size() == 0) {
    answer.solved = true;  // Ipopt refuses a problem without variables
  } else {
    answer = Solve(solver, request);
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  return {{"status", answer.solved ? "solved" : "not-solved"},
          {"f", Forces(program, answer.x)},
          {"iterations", answer.iterations},
          {"starts", answer.starts},
          {"objective", answer.objective},
          {"seconds", elapsed.count()}};
}

// Standard output is for answers only: whatever else writes there, in any language, writes to nowhere.
int TakeStandardOutput() {
  const int out = dup(STDOUT_FILENO), nowhere = open("/dev/null", O_WRONLY);
  if (out < 0 || nowhere < 0 || dup2(nowhere, STDOUT_FILENO) < 0)
    throw std::runtime_error("no standard output");
  close(nowhere);
  return out;
}

// False once nobody reads any more.
bool WriteLine(int out, const Json& json) {
  const std::string text = json.dump() + "\n";
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t count = write(out, text.data() + written, text.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    written += static_cast<std::size_t>(count);
  }
  return true;
}

int Serve() {
  const int out = TakeStandardOutput();
  Solver solver;
  bool read = WriteLine(out, {{"program", "stiction-ipopt"}, {"protocol", kProtocol}});
  for (std::string line; read && std::getline(std::cin, line);) {
    Json reply;
    try {
      reply = Reply(solver, line);
    } catch (const std::exception& error) {
      reply = {{"status", "refused"}, {"reason", error.what()}};
    }
    read = WriteLine(out, reply);
  }
  return 0;
}

}  // namespace
}  // namespace stiction

int main() {
  try {
    return stiction::Serve();
  } catch (const std::exception& error) {
    std::cerr << "stiction-ipopt: " << error.what() << '\n';
    return 70;
  }
}
