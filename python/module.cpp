// SPDX-License-Identifier: Apache-2.0
// stiction._stiction: problems, and what solves, replays, certifies and checks them, for the Python package.
//
// Answers are those of the program's --json, as dictionaries and lists; stiction/__init__.py gives them types.
// Whatever computes does so without the interpreter's lock.

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "answers/answer_text.h"
#include "answers/followed.h"
#include "answers/request.h"
#include "certify/certificate.h"
#include "certify/claims.h"
#include "certify/solve.h"
#include "corpus/atomic_file.h"
#include "corpus/digest.h"
#include "corpus/output_error.h"
#include "python/search.h"
#include "python/signals.h"

namespace stiction {
namespace {

namespace py = pybind11;

// A problem, and beside it A and b at their nearest doubles, which arrays of numpy look at.
struct PythonProblem {
  ProblemFile file;
  Eigen::MatrixXd A;
  Eigen::VectorXd b;

  explicit PythonProblem(ProblemFile of) : file(std::move(of)) {
    A = file.problem.A.unaryExpr([](const Rational& x) { return ToDouble(x); });
    b = file.problem.b.unaryExpr([](const Rational& x) { return ToDouble(x); });
  }
};

py::object ToPython(const Json& json) {
  if (json.is_null()) return py::none();
  if (json.is_boolean()) return py::bool_(json.get<bool>());
  if (json.is_number_integer()) return py::int_(json.get<std::int64_t>());
  if (json.is_number()) return py::float_(json.get<double>());
  if (json.is_string()) return py::str(json.get<std::string>());
  if (json.is_array()) {
    py::list list;
    for (const Json& value : json) list.append(ToPython(value));
    return list;
  }
  py::dict dict;
  for (const auto& [key, value] : json.items()) dict[py::str(key)] = ToPython(value);
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
      contacts.push_back(ProblemFromJson(document, "Problem", "", false).contacts.at(0));
    } catch (const InputError&) {
      ProblemFromJson(ProblemDocument(all, dimension, {}, {}), "Problem", "", false);
      throw;
    }
  }
  return contacts;
}

void RequireShape(const std::string& name, py::ssize_t found, py::ssize_t expected) {
  if (found != expected)
    throw InputError("Problem", name, std::to_string(found) + " rows or columns",
                     std::to_string(expected) + ", as the contacts ask for");
}

Rational FiniteRational(double x, const std::string& place) {
  if (!std::isfinite(x)) throw InputError("Problem", place, "a number that is not finite", "a finite one");
  return Rational(x);
}

using Strided = py::array_t<double, 0>;

// Doubles, each of which is a rational; read where they lie.
PythonProblem FromDoubles(const Strided& A, const Strided& b, const std::vector<ContactTexts>& contacts,
                          int dimension, const std::string& name) {
  ExactProblem problem;
  problem.dimension = dimension;
  problem.contacts = ReadContacts(contacts, dimension);
  const int rows = RowCount(problem.contacts, dimension);
  const auto entries = A.unchecked<2>();
  const auto free = b.unchecked<1>();
  RequireShape("A", entries.shape(0), rows);
  RequireShape("A", entries.shape(1), rows);
  RequireShape("b", free.shape(0), rows);
  problem.A.resize(rows, rows);
  problem.b.resize(rows);
  for (int i = 0; i < rows; ++i) {
    problem.b(i) = FiniteRational(free(i), "b[" + std::to_string(i) + "]");
    for (int j = 0; j < rows; ++j)
      problem.A(i, j) =
          FiniteRational(entries(i, j), "A[" + std::to_string(i) + "][" + std::to_string(j) + "]");
  }
  return PythonProblem({name, problem, {}, {}, {}});
}

PythonProblem FromTexts(const std::vector<std::vector<std::string>>& A, const std::vector<std::string>& b,
                        const std::vector<ContactTexts>& contacts, int dimension, const std::string& name) {
  Json read = Json::array();
  for (const ContactTexts& one : contacts) read.push_back(ContactToJson(one, dimension));
  const Json document = ProblemDocument(read, dimension, A, b);
  return PythonProblem({name, ProblemFromJson(document, "Problem", "", false), {}, {}, {}});
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

void SetSides(SolveOptions& options, int sides) {
  if (sides < 4 || sides % 4 != 0)
    throw InputError(fmt::format("sides: found {}, expected a multiple of 4, at least 4", sides));
  options.sides = sides;
}

py::object SolveProblem(const PythonProblem& problem, const std::string& method, const std::string& arithmetic,
                        const std::string& policy, const std::string& law, int sides, double residual,
                        double seconds, const Numbers& numbers) {
  Wanted wanted{.method = method, .arithmetic = arithmetic, .policy = policy, .law = law, .dashes = ""};
  RequireBetween("residual", residual, 0, 1);
  RequireBetween("seconds", seconds, 0, 1e9);
  wanted.options.residual = residual;
  SetSides(wanted.options, sides);
  SetNumbers(wanted.options.limits, numbers);
  SetNumbers(wanted.options.tolerances, numbers);
  SolveRequest request = RequestOf(wanted, problem.file.problem, "Problem");
  return ToPython(Interruptible(seconds, [&](const std::atomic<bool>* stop) {
    request.options.limits.stop = stop;
    return SolutionToJson(SolveIn(problem.file.problem, request), problem.file.problem.dimension);
  }));
}

py::object ReplayProblem(const PythonProblem& problem, const std::string& policy, const std::string& method,
                         const std::string& arithmetic, int sides, const Numbers& numbers) {
  const MethodFacts* facts = FindMethodFacts(method);
  if (facts == nullptr || !facts->has_path)
    throw InputError("method: found " + method + ", expected one with a path: baraff, complete or lemke");
  const bool exact = Refusal(method, problem.file.problem.dimension, Arithmetic::kExact).empty();
  Wanted wanted{.method = method, .arithmetic = arithmetic, .policy = policy, .dashes = ""};
  if (arithmetic.empty()) wanted.arithmetic = exact ? "exact" : "double";
  SetSides(wanted.options, sides);
  SetNumbers(wanted.options.limits, numbers);
  SolveRequest request = RequestOf(wanted, problem.file.problem, "Problem");
  request.method = method;  // no other runs under its name
  request.trace = KeepTrace::kYes;
  return ToPython(Interruptible(0, [&](const std::atomic<bool>* stop) {
    request.options.limits.stop = stop;
    const Solution solution = SolveIn(problem.file.problem, request);
    return ReplayToJson({method, policy, wanted.options.limits}, problem.file, solution,
                        Narrate(method, problem.file, solution, {.vectors = true}), true);
  }));
}

// ---- Certificates ----

// The text of the certificate; None where nothing that was run shows the claim or its negation.
std::optional<std::string> CertifyProblem(const PythonProblem& problem, const std::string& claim,
                                          const std::string& policy) {
  ClaimOptions options;
  options.policies = policy == "*" ? PlanarGrid() : std::vector<Policy>{ParsePolicy(policy)};
  const Json certificate = Interruptible(0, [&](const std::atomic<bool>* stop) {
    options.limits.stop = stop;
    options.enumeration.progress = [stop](const EnumerationProgress&) { return !*stop; };
    return CertifyClaim(problem.file.problem, "Problem", claim, options);
  });
  if (certificate.is_null()) return std::nullopt;
  return JsonText(certificate, 1) + "\n";
}

// (accepted, claim, reason).
std::tuple<bool, std::string, std::string> CheckText(const PythonProblem& problem, const std::string& text) {
  const py::gil_scoped_release released;
  if (text.size() > kMostBytesOfCertificate)
    throw InputError("certificate", "", std::to_string(text.size()) + " bytes",
                     "at most " + std::to_string(kMostBytesOfCertificate));
  const CheckReport report =
      CheckCertificate(ParseJson(text, "certificate"), "certificate", ProblemDigest(problem.file.problem));
  return {report.accepted, report.claim, report.reason};
}

std::vector<std::string> Texts(const auto& numbers) {
  std::vector<std::string> texts;
  for (const Rational& x : numbers) texts.push_back(ToString(x));
  return texts;
}

std::vector<std::vector<std::string>> ExactA(const PythonProblem& problem) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& row : problem.file.problem.A.rowwise()) {
    std::vector<std::string>& texts = rows.emplace_back();
    for (int j = 0; j < row.size(); ++j) texts.push_back(ToString(row(j)));
  }
  return rows;
}

}  // namespace

PYBIND11_MODULE(_stiction, module) {
  module.doc() = "The library of stiction; use the package stiction, which types it.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    } catch (const OutputError& error) {
      PyErr_SetString(PyExc_OSError, error.what());
    }
  });
  py::class_<PythonProblem>(module, "Problem")
      .def_static("from_doubles", &FromDoubles)
      .def_static("from_texts", &FromTexts)
      .def_static("parse", [](const std::string& text,
                              const std::string& source) { return PythonProblem(ParseProblem(text, source)); })
      .def_static("read", [](const std::string& file) { return PythonProblem(ReadProblem(file)); })
      .def("save", [](const PythonProblem& p, const std::string& file) { WriteText(file, Print(p.file)); })
      .def("digest", [](const PythonProblem& p) { return ProblemDigest(p.file.problem); })
      .def_property_readonly("name", [](const PythonProblem& p) { return p.file.name; })
      .def_property_readonly("dimension", [](const PythonProblem& p) { return p.file.problem.dimension; })
      .def_property_readonly("A", [](const py::object& p) { return View(p.cast<PythonProblem&>().A, p); })
      .def_property_readonly("b", [](const py::object& p) { return View(p.cast<PythonProblem&>().b, p); })
      .def("exact_A", &ExactA)
      .def("exact_b", [](const PythonProblem& p) { return Texts(p.file.problem.b); })
      .def("exact_mu",
           [](const PythonProblem& p) {
             std::vector<std::string> texts;
             for (const auto& contact : p.file.problem.contacts) texts.push_back(ToString(contact.mu));
             return texts;
           })
      .def("exact_slips",
           [](const PythonProblem& p) {
             std::vector<std::vector<std::string>> texts;
             for (const auto& contact : p.file.problem.contacts) {
               auto& slip = texts.emplace_back();
               if (contact.kind != ContactKind::kSliding) continue;
               for (int k = 0; k + 1 < p.file.problem.dimension; ++k) slip.push_back(ToString(contact.slip[k]));
             }
             return texts;
           })
      .def("kinds", [](const PythonProblem& p) {
        std::vector<std::string> kinds;
        for (const auto& contact : p.file.problem.contacts) kinds.emplace_back(Name(contact.kind));
        return kinds;
      });
  module.def("solve", &SolveProblem);
  module.def("replay", &ReplayProblem);
  module.def("certify", &CertifyProblem);
  module.def("check", &CheckText);
  AddSearch(module);
}

}  // namespace stiction
