// SPDX-License-Identifier: Apache-2.0
// stiction._stiction: problems, and what solves, replays, certifies and checks them, for the Python package.
//
// Answers are those of the program's --json, as dictionaries and lists; stiction/__init__.py gives them types.
// Whatever computes does so without the interpreter's lock.

#include "python/module.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>

#include "certify/claims/certificate.h"
#include "certify/exact/answer_json.h"
#include "certify/exact/neighbour.h"
#include "certify/exact/solve.h"
#include "certify/request/request.h"
#include "cli/narration/explained.h"
#include "cli/narration/followed.h"
#include "cli/narration/listed.h"
#include "cli/narration/page_of_run.h"
#include "cli/narration/published_ends.h"
#include "corpus/atomic_file.h"
#include "corpus/formats/read_problem.h"
#include "corpus/intervals.h"
#include "corpus/json.h"
#include "corpus/output_error.h"
#include "corpus/plain_text.h"
#include "corpus/record/digest.h"
#include "corpus/rounded.h"
#include "corpus/stopwatch.h"
#include "python/signals.h"
#include "reports/pictures/problem_picture.h"
#include "reports/viewer.h"
#include "search/campaign.h"
#include "search/generators/generators.h"

namespace stiction {
namespace {

namespace py = pybind11;

const std::string kSource = "Problem";  // in errors of a problem

// A problem, and beside it A and b at their nearest doubles, which arrays of numpy look at; that of A is made
// when it is first asked for, by a caller that holds the lock.
class PythonProblem {
 public:
  explicit PythonProblem(ProblemFile file)
      : file_(std::move(file)),
        doubles_{.contacts = {}, .A = {}, .b = file_.problem.b().unaryExpr(&ToDouble)} {}

  const ProblemFile& file() const { return file_; }
  const AnyProblem& problem() const { return file_.problem; }
  // As methods take it, by a caller that holds the lock.
  const AnyProblem& in_factors() {
    if (!in_factors_) in_factors_ = InFactors(file_);
    return *in_factors_;
  }
  // InputError above kMostDenseRows.
  const ExactProblem& dense() const {
    RequireFewRows(file_.problem, kSource);
    return file_.problem;
  }
  const Eigen::MatrixXd& A() {
    if (doubles_.A.rows() != problem().rows()) doubles_.A = dense().A.unaryExpr(&ToDouble);
    return doubles_.A;
  }
  const Eigen::VectorXd& b() const { return doubles_.b; }

  template <class Scalar>
  PythonProblem In() const {
    return PythonProblem(ProblemFile{file_.name, Unrounded(Rounded<Scalar>(dense())), {}, {}, {}});
  }

 private:
  ProblemFile file_;
  std::optional<AnyProblem> in_factors_;
  ContactProblem<double> doubles_;  // A and b alone
};

// Bytes that are no UTF-8, as a file or its name may have, become U+FFFD, as JsonText has it.
py::str Decoded(const std::string& text) {
  PyObject* const decoded = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
  if (decoded == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(decoded);
}

py::object ToPython(const Json& json) {
  if (json.is_null()) return py::none();
  if (json.is_boolean()) return py::bool_(json.get<bool>());
  if (json.is_number_integer()) return py::int_(json.get<std::int64_t>());
  if (json.is_number()) return py::float_(json.get<double>());
  if (json.is_string()) return Decoded(json.get_ref<const std::string&>());
  if (json.is_array()) {
    py::list list;
    for (const Json& value : json) list.append(ToPython(value));
    return list;
  }
  py::dict dict;
  for (const auto& [key, value] : json.items()) dict[Decoded(key)] = ToPython(value);
  return dict;
}

// ---- Problems ----

// Kind, mu, and the direction of sliding of a contact that slides.
using ContactTexts = std::tuple<std::string, std::string, std::vector<std::string>>;

// One contact as a problem file has it.
Json ContactToJson(const ContactTexts& texts, int dimension) {
  const auto& [kind, mu, slip] = texts;
  Json contact = {{"kind", kind}};
  if (kind == "static" || kind == "sliding") contact["mu"] = mu;
  if (!slip.empty()) contact["slip"] = dimension == 2 && slip.size() == 1 ? Json(slip[0]) : Json(slip);
  return contact;
}

Json ProblemDocument(const Json& contacts, int dimension, const Json& A, const Json& b) {
  return {{"format", "stiction-problem"}, {"version", 1}, {"dimension", dimension},
          {"contacts", contacts},         {"A", A},       {"b", b}};
}

// The reader of files judges contacts, each in a document of its own: A and b are not of its making. Of all
// together it tells which one it refuses, before it looks for A.
std::vector<Contact<Rational>> ReadContacts(const std::vector<ContactTexts>& texts, int dimension) {
  std::vector<Contact<Rational>> contacts;
  Json all = Json::array();
  for (const ContactTexts& one : texts) {
    all.push_back(ContactToJson(one, dimension));
    const bool has_friction = std::get<0>(one) == "static" || std::get<0>(one) == "sliding";
    const int rows = has_friction ? dimension : 1;
    const Json document =
        ProblemDocument(Json::array({all.back()}), dimension, {{"size", rows}, {"entries", Json::array()}},
                        std::vector<std::string>(rows, "0"));
    try {
      contacts.push_back(ProblemFromJson(document, kSource, "", false).contacts.at(0));
    } catch (const InputError&) {
      ProblemFromJson(ProblemDocument(all, dimension, {}, {}), kSource, "", false);
      throw;
    }
  }
  return contacts;
}

void RequireShape(const std::string& name, const std::vector<py::ssize_t>& found, int rows) {
  const std::vector<py::ssize_t> expected(found.size(), rows);
  if (found == expected) return;
  throw InputError(kSource, name, fmt::format("{}", fmt::join(found, " x ")),
                   fmt::format("{}, as the contacts ask for", fmt::join(expected, " x ")));
}

// Where a number stands, for what tells of it.
std::string PlaceOf(const std::string& name, int i) { return fmt::format("{}[{}]", name, i); }
std::string PlaceOf(const std::string& name, int i, int j) { return fmt::format("{}[{}][{}]", name, i, j); }

// A double is the rational that it is.
template <class... Index>
Rational Exactly(double x, const char* name, Index... index) {
  if (std::isfinite(x)) return Rational(x);
  throw InputError(kSource, PlaceOf(name, index...), "a number that is not finite", "a finite one");
}
template <class... Index>
Rational Exactly(const std::string& text, const char* name, Index... index) {
  if (const auto number = ParseRational(text)) return *number;
  throw InputError(kSource, PlaceOf(name, index...), text, "a number");
}

using Doubles = py::array_t<double, 0>;  // of any strides: read where they lie

decltype(ExactProblem::A) ReadA(const py::object& given, int rows) {
  decltype(ExactProblem::A) A(rows, rows);
  const auto read = [&](const auto& entry) {
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < rows; ++j) A(i, j) = Exactly(entry(i, j), "A", i, j);
  };
  if (py::isinstance<Doubles>(given)) {
    const auto numbers = given.cast<Doubles>().unchecked<2>();
    RequireShape("A", {numbers.shape(0), numbers.shape(1)}, rows);
    read(numbers);
    return A;
  }
  const auto texts = given.cast<std::vector<std::vector<std::string>>>();
  for (const auto& row : texts) RequireShape("A", {std::ssize(texts), std::ssize(row)}, rows);
  RequireShape("A", {std::ssize(texts)}, rows);
  read([&texts](int i, int j) -> const std::string& { return texts[i][j]; });
  return A;
}

decltype(ExactProblem::b) ReadB(const py::object& given, int rows) {
  decltype(ExactProblem::b) b(rows);
  const auto read = [&](const auto& entry) {
    for (int i = 0; i < rows; ++i) b(i) = Exactly(entry(i), "b", i);
  };
  if (py::isinstance<Doubles>(given)) {
    const auto numbers = given.cast<Doubles>().unchecked<1>();
    RequireShape("b", {numbers.shape(0)}, rows);
    read(numbers);
    return b;
  }
  const auto texts = given.cast<std::vector<std::string>>();
  RequireShape("b", {std::ssize(texts)}, rows);
  read([&texts](int i) -> const std::string& { return texts[i]; });
  return b;
}

// A and b are arrays of doubles, or texts of exact numbers.
PythonProblem FromNumbers(const py::object& A, const py::object& b, const std::vector<ContactTexts>& contacts,
                          int dimension, const std::string& name) {
  ExactProblem problem;
  problem.dimension = dimension;
  problem.contacts = ReadContacts(contacts, dimension);
  const int rows = RowCount(problem.contacts, dimension);
  problem.A = ReadA(A, rows);
  problem.b = ReadB(b, rows);
  return PythonProblem(ProblemFile{name, std::move(problem), {}, {}, {}});
}

// The memory is the problem's: it lives as long as the array does, and is not written to.
template <class Numbers>
py::array View(const Numbers& numbers, const py::object& owner) {
  py::array view = py::cast(&numbers, py::return_value_policy::reference_internal, owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

// ---- Solving ----

// Names of `stiction solve --help`, with _ for -, of budgets and tolerances.
using Numbers = std::map<std::string, double>;

void RequireBetween(const std::string& name, double value, double least, double most) {
  if (!(value >= least && value <= most))
    throw InputError(fmt::format("{}: found {}, expected {} to {}", name, value, least, most));
}

void SetNumbers(auto& options, const Numbers& numbers) {
  ForEachField(options, [&numbers](const NumberRow& row, auto& value) {
    std::string name(row.name);
    std::replace(name.begin(), name.end(), '-', '_');
    const auto given = numbers.find(name);
    if (given == numbers.end()) return;
    RequireBetween(name, given->second, row.min, row.max);
    value = static_cast<std::remove_reference_t<decltype(value)>>(given->second);
  });
}

py::object SolveProblem(PythonProblem& problem, const std::string& method, const std::string& arithmetic,
                        const std::string& policy, const std::string& law, int sides, double residual,
                        double seconds, const Numbers& numbers) {
  Wanted wanted{.method = method, .arithmetic = arithmetic, .policy = policy, .law = law, .dashes = ""};
  RequireBetween("residual", residual, 0, 1);
  RequireBetween("seconds", seconds, 0, 1e9);
  wanted.request.residual = residual;
  wanted.request.sides = sides;
  SetNumbers(wanted.request.limits, numbers);
  SetNumbers(wanted.request.tolerances, numbers);
  const AnyProblem& asked = problem.in_factors();
  Request request = RequestOf(wanted, asked, kSource);
  return ToPython(Interruptible(seconds, [&](const std::atomic<bool>* stop) {
    request.limits.stop = stop;
    return SolutionToJson(SolveAsked(asked, request, kSource), asked.dimension());
  }));
}

// How a method ends on each of several problems: by problem.
struct Ends {
  std::vector<std::string> outcomes, decided_on;              // the rung of a filtered run, otherwise empty
  std::vector<double> seconds;                                // of processor time, of the call alone
  std::vector<double> residuals;                              // of what is judged
  std::map<std::string, std::vector<std::int64_t>> counters;  // 0 where a run has none of this name
};

// The largest error of forces that are called solved, over rationals; NaN of others.
double LargestErrorOf(const ExactProblem& problem, const Request& request, const Solution& solution) {
  if (solution.outcome() != Outcome::kSolved) return std::numeric_limits<double>::quiet_NaN();
  if (const auto* exact = std::get_if<ExactAnswer>(&solution.answer)) return ExactResidual(problem, exact->f);
  const Eigen::VectorXd& f = std::get<InexactAnswer>(solution.answer).f;
  if (!f.allFinite()) return std::numeric_limits<double>::infinity();
  return ExactResidual(problem, f.unaryExpr([](double x) { return Rational(x); }),
                       request.arithmetic == Arithmetic::kFloat ? GateOf<float>() : GateOf<double>());
}

py::tuple SolveProblems(const std::vector<PythonProblem*>& problems, const std::string& method,
                        const std::string& arithmetic, const std::string& policy, const std::string& law,
                        int sides, const Numbers& numbers, bool confirm,
                        const std::vector<PythonProblem*>& judged) {
  Wanted wanted{.method = method, .arithmetic = arithmetic, .policy = policy, .law = law, .dashes = ""};
  wanted.request.sides = sides;
  SetNumbers(wanted.request.limits, numbers);
  wanted.request.confirm = confirm;
  for (const auto* some : {&problems, &judged}) {
    for (PythonProblem* problem : *some) {
      problem->dense();
      problem->in_factors();
    }
  }
  const Ends ends = Interruptible(0, [&](const std::atomic<bool>* stop) {
    Ends all;
    for (PythonProblem* problem : problems) {
      if (*stop) break;
      const AnyProblem& asked = problem->in_factors();
      Request request = RequestOf(wanted, asked, kSource);
      request.limits.stop = stop;
      Stopwatch watch;
      const Solution solution = SolveAsked(asked, request, kSource, &watch);
      all.seconds.push_back(watch.Seconds());
      if (!judged.empty())
        all.residuals.push_back(LargestErrorOf(judged[all.outcomes.size()]->dense(), request, solution));
      all.outcomes.emplace_back(Name(solution.outcome()));
      const auto rung = std::visit([](const auto& answer) { return answer.rung; }, solution.answer);
      all.decided_on.emplace_back(rung ? Name(*rung) : "");
      const Counters counters = std::visit([](const auto& answer) { return answer.counters; }, solution.answer);
      counters.ForEach([&](Counter c, std::int64_t value) {
        auto& column = all.counters[std::string(Name(c))];
        column.resize(problems.size());
        column[all.outcomes.size() - 1] = value;
      });
    }
    return all;
  });
  return py::make_tuple(ends.outcomes, ends.seconds, ends.counters, ends.decided_on, ends.residuals);
}

// Problems of the one generator and number of contacts that a campaign names, from the number `first` on. They
// are those of the search's generators, by seeds of their own: (seed, contacts, number).
std::vector<PythonProblem> DrawProblems(const std::string& campaign_text, std::int64_t count,
                                        std::int64_t first) {
  const Campaign campaign = ParseCampaign(campaign_text, "draw");
  RequireConsistent(campaign);
  const GeneratorId generator = campaign.generators.at(0);
  const int contacts = campaign.contacts.at(0);
  std::vector<PythonProblem> problems;
  for (std::int64_t index = first; index < first + count; ++index) {
    Choices choices(
        ProblemSeed(campaign.seed, static_cast<std::uint64_t>(contacts), static_cast<std::uint64_t>(index)));
    ExactProblem drawn;
    Generate<Rational, Eigen::Dynamic>(generator, contacts, SurroundingsOf(campaign), choices, drawn);
    problems.emplace_back(
        ProblemFile{fmt::format("{}-{}-{}", Row(generator).name, contacts, index), drawn, {}, {}, {}});
  }
  return problems;
}

Wanted WantedPath(const std::string& policy, const std::string& method, const std::string& arithmetic,
                  int sides, const Numbers& numbers) {
  Wanted wanted{.method = method, .arithmetic = arithmetic, .policy = policy, .dashes = ""};
  wanted.request.sides = sides;
  SetNumbers(wanted.request.limits, numbers);
  return wanted;
}

py::object ReplayProblem(PythonProblem& problem, const std::string& policy, const std::string& method,
                         const std::string& arithmetic, int sides, const Numbers& numbers) {
  const Wanted wanted = WantedPath(policy, method, arithmetic, sides, numbers);
  const ExactProblem& dense = problem.dense();
  Request request = PathRequestOf(wanted, problem.problem(), kSource);
  return ToPython(Interruptible(0, [&](const std::atomic<bool>* stop) {
    request.limits.stop = stop;
    const Solution solution = SolveAsked(problem.problem(), request, kSource);
    Json json = ReplayToJson(request, problem.file(), solution,
                             Narrate(method, problem.file(), solution, {.vectors = true}), true);
    const auto proved = OverIntervals(dense, request, solution.outcome());
    if (proved) json["over_intervals"] = EndToJson(*proved);
    return json;
  }));
}

// The page that `replay --html` writes. `command` makes it again.
std::string PageOfReplay(PythonProblem& problem, const std::string& policy, const std::string& method,
                         const std::string& arithmetic, int sides, const Numbers& numbers,
                         const std::string& command) {
  const Wanted wanted = WantedPath(policy, method, arithmetic, sides, numbers);
  const ProblemFile& file = problem.file();
  const ExactProblem& dense = problem.dense();
  Request request = PathRequestOf(wanted, file.problem, kSource);
  return Interruptible(0, [&](const std::atomic<bool>* stop) {
    request.limits.stop = stop;
    const Solution solution = SolveAsked(file.problem, request, kSource);
    const auto proved = OverIntervals(dense, request, solution.outcome());
    const Json data = PageOfRun(wanted, file, kSource, PictureBeside(file, kSource), solution, proved);
    return ViewerPage(file.name + ", step by step", data, {command, STICTION_VERSION, ProblemDigest(dense)});
  });
}

// Each of many, solved or, where `followed`, replayed as ReplayProblem does; without its path.
py::dict SolveManyAsked(PythonProblem& like, const Doubles& A, const Doubles& b, const Doubles& mu,
                        const std::string& method, const std::string& arithmetic, const std::string& policy,
                        const std::string& law, int sides, const Numbers& numbers, bool followed, int threads) {
  Wanted wanted = WantedPath(policy, method, arithmetic, sides, numbers);
  wanted.law = law;
  const ExactProblem& dense = like.dense();
  Request request = followed ? PathRequestOf(wanted, dense, kSource) : RequestOf(wanted, dense, kSource);
  request.trace = false;
  return SolveMany(dense, A, b, mu, request, threads);
}

// What `explain` says of it, as data and as text of so many columns.
py::tuple ExplainProblem(PythonProblem& problem, const std::string& file, int columns, const Numbers& numbers) {
  ExplainOptions options{.file = file};
  SetNumbers(options.limits, numbers);
  const auto [found, text] = Interruptible(0, [&](const std::atomic<bool>* stop) {
    options.limits.stop = stop;
    const FixedTextWidth width(static_cast<std::size_t>(columns));
    Json json = *Explained(problem.file(), options);
    std::string told = ExplainedText(json);
    return std::make_pair(std::move(json), std::move(told));
  });
  return py::make_tuple(ToPython(found), text);
}

// By the name of a policy how the published algorithm ends.
py::object EndsOfProblem(PythonProblem& problem, const std::string& arithmetic, int sides,
                         const Numbers& numbers) {
  Wanted wanted = WantedPath("paper", "baraff", arithmetic, sides, numbers);
  const ExactProblem& dense = problem.dense();
  return ToPython(Interruptible(0, [&](const std::atomic<bool>* stop) {
    wanted.request.limits.stop = stop;
    return Json(OutcomesOf(wanted, dense, kSource));
  }));
}

// ---- Certificates ----

// The answer, its certificate as the text of its file.
py::object CertifyProblem(PythonProblem& problem, const std::string& claim, const std::string& policy,
                          const std::string& law, const Numbers& numbers) {
  Wanted wanted{.policy = policy, .law = law, .dashes = ""};
  SetNumbers(wanted.request.limits, numbers);
  const ExactProblem& dense = problem.dense();
  const ExactFactors* factors = problem.in_factors().factors();
  Json answer = Interruptible(0, [&](const std::atomic<bool>* stop) {
    wanted.request.limits.stop = stop;
    return CertificateOf(claim, wanted, dense, kSource, factors);
  });
  Json& certificate = answer["certificate"];
  if (certificate.is_object()) certificate = JsonText(certificate, 1) + "\n";
  return ToPython(answer);
}

// (accepted, claim, reason).
std::tuple<bool, std::string, std::string> CheckForProblem(PythonProblem& problem, const std::string& text) {
  const ExactProblem& exact = problem.dense();
  const py::gil_scoped_release released;
  const CheckReport report = CheckText(text, "certificate", ProblemDigest(exact));
  return {report.accepted, report.claim, report.reason};
}

std::vector<std::string> Texts(const auto& numbers) {
  std::vector<std::string> texts;
  for (const Rational& x : numbers) texts.push_back(ToString(x));
  return texts;
}

std::vector<std::vector<std::string>> ExactA(PythonProblem& problem) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& row : problem.dense().A.rowwise()) {
    std::vector<std::string>& texts = rows.emplace_back();
    for (int j = 0; j < row.size(); ++j) texts.push_back(ToString(row(j)));
  }
  return rows;
}

// Rows, columns and numbers, and the shape.
template <class Sparse>
py::tuple Triplets(const Sparse& matrix) {
  std::vector<int> rows, columns;
  std::vector<double> values;
  for (int k = 0; k < matrix.outerSize(); ++k) {
    for (typename Sparse::InnerIterator of(matrix, k); of; ++of) {
      rows.push_back(static_cast<int>(of.row()));
      columns.push_back(static_cast<int>(of.col()));
      values.push_back(of.value());
    }
  }
  return py::make_tuple(py::array(py::cast(rows)), py::array(py::cast(columns)), py::array(py::cast(values)),
                        py::make_tuple(matrix.rows(), matrix.cols()));
}

// J, M, w, c at their nearest doubles; None where the problem came without.
py::object FactorsOf(const PythonProblem& problem) {
  const ExactFactors* factors = problem.problem().factors();
  if (factors == nullptr) return py::none();
  const FactoredProblem<double> rounded = InDoubles(*factors);
  return py::make_tuple(Triplets(rounded.A.J()), Triplets(rounded.M), rounded.w, rounded.c);
}

}  // namespace

PYBIND11_MODULE(_stiction, module) {
  module.attr("__version__") = STICTION_VERSION;
  module.doc() = "The library of stiction; use the package stiction, which types it.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      PyErr_SetObject(PyExc_ValueError, Decoded(error.what()).ptr());
    } catch (const OutputError& error) {
      PyErr_SetObject(PyExc_OSError, Decoded(error.what()).ptr());
    }
  });
  py::class_<PythonProblem>(module, "Problem")
      .def_static("from_numbers", &FromNumbers)
      .def_static("parse",
                  [](const std::string& text, const std::string& source) {
                    return PythonProblem(ParseProblem(text, source, kAnyRows));
                  })
      .def_static("read", [](const std::string& file) { return PythonProblem(ReadProblem(file, kAnyRows)); })
      .def("save", [](const PythonProblem& p, const std::string& file) { WriteText(file, Print(p.file())); })
      .def("text", [](const PythonProblem& p) { return Print(p.file()); })
      .def("rounded", [](PythonProblem& p, bool narrow) { return narrow ? p.In<float>() : p.In<double>(); })
      .def("digest", [](PythonProblem& p) { return ProblemDigest(p.dense()); })
      .def_property_readonly("name", [](const PythonProblem& p) { return p.file().name; })
      .def_property_readonly("dimension", [](const PythonProblem& p) { return p.problem().dimension(); })
      .def_property_readonly("A", [](const py::object& p) { return View(p.cast<PythonProblem&>().A(), p); })
      .def_property_readonly("b", [](const py::object& p) { return View(p.cast<PythonProblem&>().b(), p); })
      .def("factors", &FactorsOf)
      .def("exact_A", &ExactA)
      .def("exact_b", [](const PythonProblem& p) { return Texts(p.problem().b()); })
      .def("exact_mu",
           [](const PythonProblem& p) {
             std::vector<std::string> texts;
             for (const auto& contact : p.problem().contacts()) texts.push_back(ToString(contact.mu));
             return texts;
           })
      .def("exact_slips",
           [](const PythonProblem& p) {
             std::vector<std::vector<std::string>> texts;
             for (const auto& contact : p.problem().contacts()) {
               auto& slip = texts.emplace_back();
               if (contact.kind != ContactKind::kSliding) continue;
               for (int k = 0; k + 1 < p.problem().dimension(); ++k) slip.push_back(ToString(contact.slip[k]));
             }
             return texts;
           })
      .def("kinds", [](const PythonProblem& p) {
        std::vector<std::string> kinds;
        for (const auto& contact : p.problem().contacts()) kinds.emplace_back(Name(contact.kind));
        return kinds;
      });
  module.def("solve", &SolveProblem);
  module.def("solve_all", &SolveProblems);
  module.def("draw", &DrawProblems);
  module.def("interval", [](std::int64_t count, std::optional<std::int64_t> of) {
    const Interval interval = of ? ShareInterval(count, *of) : CountInterval(count);
    return std::make_pair(interval.low, interval.high);
  });
  module.def("replay", &ReplayProblem);
  module.def("replay_page", &PageOfReplay);
  module.def("solve_many", &SolveManyAsked);
  module.def("explain", &ExplainProblem);
  module.def("methods", [] { return ToPython(MethodsToJson()); });
  module.def("policies", [] { return ToPython(PoliciesToJson()); });
  module.def("ends", &EndsOfProblem);
  module.def("certify", &CertifyProblem);
  module.def("check", &CheckForProblem);
  AddSearch(module);
  AddSimulate(module);
}

}  // namespace stiction
