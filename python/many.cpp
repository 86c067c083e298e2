// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <thread>
#include <variant>
#include <vector>

#include "certify/request/request.h"
#include "corpus/rounded.h"
#include "corpus/stopwatch.h"
#include "python/module.h"
#include "python/signals.h"

namespace stiction {
namespace {

namespace py = pybind11;

using Doubles = py::array_t<double, 0>;

// read(i, problem): number i of the arrays, into a problem of its contacts, whose memory is kept.
using ReadNumbers = std::function<void(py::ssize_t, ContactProblem<double>&)>;

ReadNumbers ReaderOf(const Doubles& A, const Doubles& b, const Doubles& mu) {
  return [A = A.unchecked<3>(), b = b.unchecked<2>(), mu = mu.unchecked<2>()](py::ssize_t i, auto& problem) {
    const int rows = problem.rows();
    for (std::size_t k = 0; k < problem.contacts.size(); ++k)
      problem.contacts[k].mu = mu(i, static_cast<py::ssize_t>(k));
    for (int j = 0; j < rows; ++j) {
      for (int k = 0; k < rows; ++k) problem.A(j, k) = A(i, j, k);
      problem.b[j] = b(i, j);
    }
  };
}

// Columns of answers. Threads write rows of their own; what they have in common is locked.
class Columns {
 public:
  Columns(py::ssize_t count, int rows)
      : f_({count, py::ssize_t{rows}}),
        a_({count, py::ssize_t{rows}}),
        outcomes_(count),
        starts_(count),
        periods_(count) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    for (Doubles* array : {&f_, &a_}) std::fill_n(array->mutable_data(), array->size(), kNone);
    f_data_ = f_.mutable_data();
    a_data_ = a_.mutable_data();
    rows_ = rows;
  }

  void Set(py::ssize_t i, const Solution& solution) {
    std::visit(
        [&](const auto& answer) {
          outcomes_.mutable_data()[i] = static_cast<std::uint8_t>(answer.outcome);
          starts_.mutable_data()[i] = answer.start;
          periods_.mutable_data()[i] = answer.period;
          Copy(answer.f, f_data_ + i * rows_);
          Copy(answer.a, a_data_ + i * rows_);
        },
        solution.answer);
  }
  // Of the problems from `first` on, solved in so much time.
  void Add(py::ssize_t first, const std::vector<Solution>& solutions, double seconds) {
    const std::lock_guard lock(mutex_);
    seconds_ += seconds;
    for (std::size_t k = 0; k < solutions.size(); ++k) {
      const Counters& counters = std::visit(
          [](const auto& answer) -> const Counters& { return answer.counters; }, solutions[k].answer);
      counters.ForEach([&](Counter c, std::int64_t value) {
        std::vector<std::int64_t>& column = counters_[static_cast<std::size_t>(c)];
        column.resize(static_cast<std::size_t>(outcomes_.size()));
        column[static_cast<std::size_t>(first) + k] = value;
      });
    }
  }

  py::dict Taken() const {
    py::dict counters, columns;
    for (std::size_t c = 0; c < counters_.size(); ++c) {
      const auto& column = counters_[c];
      if (column.empty()) continue;
      counters[py::str(std::string(Name(static_cast<Counter>(c))))] =
          py::array_t<std::int64_t>(static_cast<py::ssize_t>(column.size()), column.data());
    }
    std::vector<std::string> names;
    for (int k = 0; k <= kOutcomeCount; ++k) names.emplace_back(Name(static_cast<Outcome>(k)));
    columns["outcomes"] = names;
    columns["outcome"] = outcomes_;
    columns["f"] = f_;
    columns["a"] = a_;
    columns["start"] = starts_;
    columns["period"] = periods_;
    columns["statistics"] = counters;
    columns["seconds"] = seconds_;
    return columns;
  }

 private:
  static double Nearest(double x) { return x; }
  static double Nearest(const Rational& x) { return ToDouble(x); }
  void Copy(const auto& vector, double* to) const {
    for (int k = 0; k < vector.size() && k < rows_; ++k) to[k] = Nearest(vector[k]);
  }

  Doubles f_, a_;
  double *f_data_ = nullptr, *a_data_ = nullptr;
  int rows_ = 0;
  py::array_t<std::uint8_t> outcomes_;
  py::array_t<std::int64_t> starts_, periods_;
  std::mutex mutex_;
  double seconds_ = 0;
  std::array<std::vector<std::int64_t>, kCounterCount> counters_;  // by Count
};

// Units of neighbouring problems, which threads take one after another.
class Many {
 public:
  Many(const ReadNumbers& read, py::ssize_t count, const ContactProblem<double>& like, const Request& request,
       int threads, Columns& columns)
      : read_(read),
        count_(count),
        like_(like),
        request_(request),
        threads_(threads),
        columns_(columns),
        refused_at_(count) {}

  void Run() {
    std::vector<std::thread> workers;
    for (int k = 1; k < threads_; ++k) workers.emplace_back([this] { Work(); });
    Work();
    for (std::thread& worker : workers) worker.join();
    if (refused_) std::rethrow_exception(refused_);
  }

 private:
  void Work() {
    const py::ssize_t size = std::clamp<py::ssize_t>(count_ / (8 * threads_), 1, 64);
    std::vector<ContactProblem<double>> problems(static_cast<std::size_t>(size), like_);
    std::vector<ExactProblem> exact;
    while (!request_.limits.Stopped()) {
      const py::ssize_t first = next_.fetch_add(size), count = std::min(count_ - first, size);
      if (count <= 0 || first > refused_at_) return;
      for (py::ssize_t k = 0; k < count; ++k) read_(first + k, problems[static_cast<std::size_t>(k)]);
      if (request_.arithmetic == Arithmetic::kDouble) {
        SolveUnit(first, count, problems, &SolveDoubles);
        continue;
      }
      exact.clear();
      for (py::ssize_t k = 0; k < count; ++k) exact.push_back(Unrounded(problems[static_cast<std::size_t>(k)]));
      SolveUnit(first, count, exact,
                [](const ExactProblem& problem, const Request& request) { return SolveIn(problem, request); });
    }
  }

  void SolveUnit(py::ssize_t first, py::ssize_t count, const auto& problems, auto solve) {
    std::vector<Solution> solutions;
    solutions.reserve(static_cast<std::size_t>(count));
    const Stopwatch watch;
    for (py::ssize_t k = 0; k < count; ++k) {
      try {
        solutions.push_back(solve(problems[static_cast<std::size_t>(k)], request_));
      } catch (const InputError& error) {
        return Refuse(first + k, error);
      }
    }
    const double seconds = watch.Seconds();
    for (py::ssize_t k = 0; k < count; ++k) columns_.Set(first + k, solutions[static_cast<std::size_t>(k)]);
    columns_.Add(first, solutions, seconds);
  }

  // The first one is told, whichever thread comes to its end first.
  void Refuse(py::ssize_t i, const InputError& error) {
    const std::lock_guard lock(mutex_);
    if (i >= refused_at_) return;
    refused_at_ = i;
    refused_ = std::make_exception_ptr(InputError(fmt::format("problem {}: {}", i, error.what())));
  }

  const ReadNumbers& read_;
  const py::ssize_t count_;
  const ContactProblem<double>& like_;
  const Request& request_;
  const int threads_;
  Columns& columns_;
  std::atomic<py::ssize_t> next_ = 0;
  std::mutex mutex_;
  std::atomic<py::ssize_t> refused_at_;
  std::exception_ptr refused_;
};

}  // namespace

py::dict SolveMany(const ExactProblem& like, const Doubles& A, const Doubles& b, const Doubles& mu,
                   Request request, int threads) {
  const ReadNumbers read = ReaderOf(A, b, mu);
  const auto rounded =
      Converted<double>(like, [](const Rational& x) { return ToDouble(x); });  // mu, A, b: read
  Columns columns(A.shape(0), like.rows());
  Interruptible(0, [&](const std::atomic<bool>* stop) {
    request.limits.stop = stop;
    Many(read, A.shape(0), rounded, request, threads, columns).Run();
    return true;
  });
  return columns.Taken();
}

}  // namespace stiction
