// SPDX-License-Identifier: Apache-2.0
#include "corpus/formats/fclib.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "corpus/formats/condense.h"
#include "corpus/hdf5_library.h"
#include "corpus/printable.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

// HDF5 is loaded when it is first used: with the thirty libraries that it needs it takes longer than all else
// until the program begins. InputError where it is not there.
void* Hdf5Symbol(const char* name) {
  static void* const library = dlopen(STICTION_HDF5, RTLD_NOW | RTLD_LOCAL);
  void* const symbol = library == nullptr ? nullptr : dlsym(library, name);
  if (symbol == nullptr) {
    throw InputError(
        fmt::format("{} cannot be loaded ({}); it reads and writes FCLIB files: install Debian's libhdf5-dev",
                    STICTION_HDF5, dlerror()));
  }
  return symbol;
}

// A function of <hdf5.h>.
#define HDF5(function) reinterpret_cast<decltype(&::function)>(Hdf5Symbol(#function))

// A type or class of HDF5, by the variable that holds it once HDF5 has begun: that of the program, where it
// links HDF5 itself, since a linker may put a copy there which the library takes.
hid_t Hdf5Id(const char* variable) {
  STICTION_CHECK(HDF5(H5open)() >= 0, "HDF5 does not begin");
  const void* const linked = dlsym(RTLD_DEFAULT, variable);
  return *static_cast<const hid_t*>(linked != nullptr ? linked : Hdf5Symbol(variable));
}

// H5F_ACC_RDONLY and H5F_ACC_TRUNC, whose macros call HDF5.
constexpr unsigned kReadOnly = 0, kTruncate = 2;

// An HDF5 identifier that closes itself; HDF5 itself stays silent.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t id() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void Silence() { HDF5(H5Eset_auto2)(H5E_DEFAULT, nullptr, nullptr); }

// HDF5 wants a name, of no file that exists.
constexpr const char* kNoFile = "/dev/null/in-memory";

// A file that is never one: it begins as `text`, if there is any.
Handle InMemory(std::string* text) {
  constexpr std::size_t kGrowth = 1 << 16;  // bytes
  const hid_t access = HDF5(H5Pcreate)(Hdf5Id("H5P_CLS_FILE_ACCESS_ID_g"));
  STICTION_CHECK(access >= 0 && HDF5(H5Pset_fapl_core)(access, kGrowth, false) >= 0 &&
                     (text == nullptr || HDF5(H5Pset_file_image)(access, text->data(), text->size()) >= 0),
                 "HDF5 has no files in memory");
  return {access, HDF5(H5Pclose)};
}

constexpr int kMost = 100'000'000;  // of anything that is counted, in a file that is not nonsense
constexpr hsize_t kMostNames = 20;  // of groups that a message lists

// ---- Reading ---------------------------------------------------------------------------------

struct Matrix {
  struct Entry {
    int i, j;
    double value;
  };
  int rows = 0, columns = 0;
  std::vector<Entry> entries;
};

class FclibReader {
 public:
  FclibReader(std::string text, const std::string& source)
      : source_(source),
        text_(std::move(text)),
        file_(HDF5(H5Fopen)(kNoFile, kReadOnly, InMemory(&text_).id()), HDF5(H5Fclose)) {
    if (!file_.valid()) throw InputError(source, "/", "no HDF5 file that can be read", "one");
  }

  ProblemFile Read() {
    const bool local = GroupOfProblem() == "fclib_local";
    group_ = local ? "/fclib_local" : "/fclib_global";
    problem_.dimension = Integer("spacedim", 2, 3);
    file_of_.origin.Add({{"format", "fclib"}, {"storage", local ? "local" : "global"}});
    local ? Local() : Global();
    return std::move(file_of_);
  }

 private:
  [[noreturn]] void Refuse(const std::string& path, const std::string& found,
                           const std::string& expected) const {
    throw InputError(source_, path, found, expected);
  }
  std::string Path(const std::string& name) const { return group_ + "/" + name; }

  // What the file consists of.
  std::vector<std::string> RootNames() const {
    H5G_info_t info;
    if (HDF5(H5Gget_info)(file_.id(), &info) < 0) Refuse("/", "no group that can be read", "one");
    std::vector<std::string> names;
    for (hsize_t k = 0; k < std::min<hsize_t>(info.nlinks, kMostNames); ++k) {
      std::array<char, 200> name = {};
      HDF5(H5Lget_name_by_idx)
      (file_.id(), "/", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size(), H5P_DEFAULT);
      names.emplace_back(name.data());
    }
    return names;
  }

  // The one group that holds a problem, of a kind that is read. `solution` and `guesses` may stand beside it.
  std::string GroupOfProblem() const {
    const char* expected = "one problem, in fclib_local or fclib_global";
    const std::vector<std::string> names = RootNames();
    std::vector<std::string> problems;
    for (const std::string& name : names) {
      if (name.starts_with("fclib_")) problems.push_back(name);
    }
    if (problems.empty()) {
      Refuse("/", names.empty() ? "nothing" : Printable(fmt::format("{}", fmt::join(names, ", "))), expected);
    }
    if (problems.size() > 1) Refuse("/", Printable(fmt::format("{}", fmt::join(problems, ", "))), expected);
    if (problems[0] != "fclib_local" && problems[0] != "fclib_global") {
      Refuse("/" + Printable(problems[0]), KindOfGroup(problems[0]), expected);
    }
    return problems[0];
  }

  // "fclib_global_rolling" -> "a global rolling friction problem".
  static std::string KindOfGroup(const std::string& name) {
    const bool global = name.find("global") != name.npos, rolling = name.find("rolling") != name.npos;
    if (!global && !rolling) return "another kind of problem";
    return fmt::format("a {}{}friction problem", global ? "global " : "", rolling ? "rolling " : "");
  }

  // Links of a path, one after the other: HDF5 asks for that.
  bool Has(const std::string& path) const {
    for (std::size_t at = path.find('/', 1);; at = path.find('/', at + 1)) {
      if (HDF5(H5Lexists)(file_.id(), path.substr(0, at).c_str(), H5P_DEFAULT) <= 0) return false;
      if (at == path.npos) return true;
    }
  }

  // The numbers of a data set; `size` of them unless it is negative.
  template <class Number>
  std::vector<Number> Numbers(const std::string& name, hsize_t most, int size = -1) {
    const std::string path = Path(name);
    constexpr bool kInteger = std::is_same_v<Number, int>;
    const std::string expected = kInteger ? "integers" : "floating-point numbers of at most 8 bytes";
    if (!Has(path)) Refuse(path, "nothing", expected);
    const Handle set(HDF5(H5Dopen2)(file_.id(), path.c_str(), H5P_DEFAULT), HDF5(H5Dclose));
    if (!set.valid()) Refuse(path, "no data set", expected);
    const Handle type(HDF5(H5Dget_type)(set.id()), HDF5(H5Tclose)),
        space(HDF5(H5Dget_space)(set.id()), HDF5(H5Sclose));
    if (HDF5(H5Tget_class)(type.id()) != (kInteger ? H5T_INTEGER : H5T_FLOAT) ||
        HDF5(H5Tget_size)(type.id()) > 8) {
      Refuse(path, "another type", expected);
    }
    const hssize_t count = HDF5(H5Sget_simple_extent_npoints)(space.id());
    if (count < 0 || static_cast<hsize_t>(count) > most || (size >= 0 && count != size)) {
      Refuse(path, fmt::format("{} numbers", count),
             size >= 0 ? fmt::format("{}", size) : fmt::format("at most {}", most));
    }
    if (count > 0 && HDF5(H5Dget_storage_size)(set.id()) == 0) {  // HDF5 would make zeros of it, however many
      Refuse(path, fmt::format("{} numbers that were never written", count), expected);
    }
    Spend(path, static_cast<std::size_t>(count) * sizeof(Number));
    std::vector<Number> values(count);
    const hid_t memory = kInteger ? Hdf5Id("H5T_NATIVE_INT_g") : Hdf5Id("H5T_NATIVE_DOUBLE_g");
    if (count > 0 && HDF5(H5Dread)(set.id(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
      Refuse(path, "data that cannot be read", expected);
    }
    return values;
  }

  // What is compressed may be a thousand times as long, and is made exact, at some twenty times more.
  void Spend(const std::string& path, std::size_t bytes) {
    constexpr std::size_t kTimes = 32, kAlways = std::size_t{1} << 24;
    const std::size_t most = kAlways + kTimes * text_.size();
    bytes_ += bytes;
    if (bytes_ <= most) return;
    Refuse(path, fmt::format("{} bytes of numbers up to here, in a file of {}", bytes_, text_.size()),
           fmt::format("at most {}, {} times those of the file and {} beside: write it without compression",
                       most, kTimes, kAlways));
  }

  int Integer(const std::string& name, int least, int most) {
    const int value = Numbers<int>(name, 1, 1).front();
    if (value < least || value > most) {
      Refuse(Path(name), std::to_string(value), fmt::format("an integer from {} to {}", least, most));
    }
    return value;
  }

  ExactProblem::Vector Vector(const std::string& name, int size) {
    const std::vector<double> values = Numbers<double>("vectors/" + name, kMost, size);
    ExactProblem::Vector exact(size);
    for (int i = 0; i < size; ++i) {
      if (!std::isfinite(values[i])) {
        Refuse(fmt::format("{}[{}]", Path("vectors/" + name), i), fmt::format("{}", values[i]), "a number");
      }
      exact[i] = Rational(values[i]);
    }
    return exact;
  }

  Matrix ReadMatrix(const std::string& name) {
    Matrix matrix;
    matrix.rows = Integer(name + "/m", 0, kMost);
    matrix.columns = Integer(name + "/n", 0, kMost);
    const int nz = Integer(name + "/nz", -2, kMost);
    const std::vector<double> x = Numbers<double>(name + "/x", kMost);
    const std::vector<int> p = Numbers<int>(name + "/p", kMost), i = Numbers<int>(name + "/i", kMost);
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (!std::isfinite(x[k])) {
        Refuse(fmt::format("{}/x[{}]", Path(name), k), fmt::format("{}", x[k]), "a number");
      }
    }
    const bool column_wise = nz == -1;
    if (nz >= 0) {
      Triplets(name, nz, p, i, x, matrix);
    } else {
      Compressed(name, column_wise, p, i, x, matrix);
    }
    return matrix;
  }

  static bool Fit(const std::vector<int>& indices, int count, int below) {
    return std::all_of(indices.begin(), indices.begin() + count,
                       [below](int index) { return 0 <= index && index < below; });
  }

  void Triplets(const std::string& name, int nz, const std::vector<int>& p, const std::vector<int>& i,
                const std::vector<double>& x, Matrix& matrix) {
    const auto count = static_cast<std::size_t>(nz);
    if (p.size() < count || i.size() < count || x.size() < count) {
      Refuse(Path(name), fmt::format("p, i, x of {}, {}, {} numbers", p.size(), i.size(), x.size()),
             fmt::format("nz = {} at least", nz));
    }
    const bool rows_in_i = Fit(i, nz, matrix.rows) && Fit(p, nz, matrix.columns);
    const bool rows_in_p = Fit(p, nz, matrix.rows) && Fit(i, nz, matrix.columns);
    if (!rows_in_i && !rows_in_p) {
      Refuse(Path(name), "triplets with indices outside of the matrix",
             fmt::format("rows below {}, columns below {}", matrix.rows, matrix.columns));
    }
    for (int k = 0; k < nz; ++k)
      matrix.entries.push_back({rows_in_i ? i[k] : p[k], rows_in_i ? p[k] : i[k], x[k]});
  }

  void Compressed(const std::string& name, bool column_wise, const std::vector<int>& p,
                  const std::vector<int>& i, const std::vector<double>& x, Matrix& matrix) {
    const int lines = column_wise ? matrix.columns : matrix.rows,
              across = column_wise ? matrix.rows : matrix.columns;
    const auto most = static_cast<int>(std::min(i.size(), x.size()));
    const bool sound = static_cast<int>(p.size()) == lines + 1 && p.front() == 0 &&
                       std::is_sorted(p.begin(), p.end()) && p.back() <= most;
    if (!sound) {
      Refuse(
          Path(name) + "/p", fmt::format("{} numbers, or such as are no pointers", p.size()),
          fmt::format("{} pointers that start at 0, do not decrease, and end at {} at most", lines + 1, most));
    }
    if (!Fit(i, p.back(), across)) {
      Refuse(Path(name) + "/i", "an index outside of the matrix",
             fmt::format("indices from 0 to {}", across - 1));
    }
    for (int line = 0; line < lines; ++line) {
      for (int k = p[line]; k < p[line + 1]; ++k) {
        matrix.entries.push_back({column_wise ? i[k] : line, column_wise ? line : i[k], x[k]});
      }
    }
  }

  void RequireShape(const std::string& name, const Matrix& matrix, int rows, int columns) const {
    if (matrix.rows == rows && matrix.columns == columns) return;
    Refuse(Path(name), fmt::format("{} rows, {} columns", matrix.rows, matrix.columns),
           fmt::format("{} rows, {} columns", rows, columns));
  }

  // A number for each of `count` equations. Read before anything is made of them: a matrix without entries may
  // have any number of rows.
  ExactProblem::Vector Equations(const std::string& name, int count) {
    return count > 0 ? Vector(name, count) : ExactProblem::Vector(0);
  }

  // `rows` rows of static contacts, then one bilateral contact for each of `equations`.
  void MakeContacts(const std::string& name, int rows, int equations) {
    if (rows % problem_.dimension != 0) {
      Refuse(Path(name), fmt::format("{} rows of contacts", rows),
             fmt::format("a multiple of {}", problem_.dimension));
    }
    const ExactProblem::Vector mu = Vector("mu", rows / problem_.dimension);
    for (int i = 0; i < mu.size(); ++i) {
      if (mu[i] < 0) Refuse(fmt::format("{}[{}]", Path("vectors/mu"), i), ToString(mu[i]), "mu >= 0");
      problem_.contacts.push_back({ContactKind::kStatic, mu[i], {}});
    }
    for (int k = 0; k < equations; ++k) problem_.contacts.push_back({ContactKind::kBilateral, Rational(0), {}});
    problem_.b.resize(rows + equations);
  }

  void Local() {
    const Matrix W = ReadMatrix("W");
    const int rows = W.rows;
    RequireShape("W", W, rows, rows);
    Matrix V, R;
    if (Has(Path("V")) || Has(Path("R"))) {
      V = ReadMatrix("V");
      R = ReadMatrix("R");
      RequireShape("R", R, R.rows, R.rows);
      RequireShape("V", V, rows, R.rows);
    }
    const ExactProblem::Vector s = Equations("s", R.rows);
    MakeContacts("W", rows, R.rows);
    problem_.b.head(rows) = Vector("q", rows);
    problem_.b.tail(R.rows) = s;
    SparseMatrix A;
    for (const auto& [i, j, value] : W.entries)
      if (value != 0) A[{i, j}] += Rational(value);
    for (const auto& [i, j, value] : R.entries) A[{rows + i, rows + j}] += Rational(value);
    for (const auto& [i, j, value] : V.entries) {
      A[{i, rows + j}] += Rational(value);
      A[{rows + j, i}] += Rational(value);
    }
    problem_.A = ToEigen(A, problem_.rows(), problem_.rows());
    file_of_.problem = std::move(problem_);
  }

  // M v = [H G] (r, l) + f, (u, 0) = [H G]'v + (w, b).
  void Global() {
    const Matrix M = ReadMatrix("M"), H = ReadMatrix("H");
    RequireShape("M", M, M.rows, M.rows);
    RequireShape("H", H, M.rows, H.columns);
    Matrix G;
    if (Has(Path("G"))) {
      G = ReadMatrix("G");
      RequireShape("G", G, M.rows, G.columns);
    }
    GlobalEquations equations;
    const ExactProblem::Vector b = Equations("b", G.columns);
    MakeContacts("H", H.columns, G.columns);
    equations.w.resize(H.columns + G.columns);
    equations.w.head(H.columns) = Vector("w", H.columns);
    equations.w.tail(G.columns) = b;
    equations.f = Vector("f", M.rows);
    Add(M, 0, equations.M);
    Add(H, 0, equations.B);
    Add(G, H.columns, equations.B);
    const auto made = Condense(equations, problem_.dimension, std::move(problem_.contacts), file_of_);
    if (const int* row = std::get_if<int>(&made))
      Refuse(Path("M"), fmt::format("a zero pivot in row {}", *row), "a positive definite matrix");
    file_of_.problem = std::get<AnyProblem>(made);
  }

  // The entries, so many columns further; those listed more than once add up.
  static void Add(const Matrix& matrix, int columns, SparseMatrix& sum) {
    for (const auto& [i, j, value] : matrix.entries) sum[{i, columns + j}] += Rational(value);
    std::erase_if(sum, [](const auto& entry) { return entry.second == 0; });
  }

  const std::string source_;
  std::string text_;
  Handle file_;
  std::size_t bytes_ = 0;  // of all numbers so far
  std::string group_;
  ExactEntries problem_;
  ProblemFile file_of_;
};

// ---- Writing ---------------------------------------------------------------------------------

class FclibWriter {
 public:
  explicit FclibWriter(FclibStorage storage)
      : storage_(storage),
        file_(HDF5(H5Fcreate)("memory", kTruncate, H5P_DEFAULT, InMemory(nullptr).id()), HDF5(H5Fclose)) {
    Require(file_.valid());
  }

  // The bytes of the file.
  std::string Image() const {
    Require(HDF5(H5Fflush)(file_.id(), H5F_SCOPE_GLOBAL) >= 0);
    const ssize_t size = HDF5(H5Fget_file_image)(file_.id(), nullptr, 0);
    Require(size > 0);
    std::string image(static_cast<std::size_t>(size), '\0');
    Require(HDF5(H5Fget_file_image)(file_.id(), image.data(), image.size()) == size);
    return image;
  }

  void Write(const ExactEntries& problem, const std::string& title) {
    int rows = 0;
    std::vector<double> mu;
    for (const auto& contact : problem.contacts) {
      const bool is_static = contact.kind == ContactKind::kStatic;
      STICTION_CHECK(is_static ? static_cast<int>(mu.size()) * problem.dimension == rows
                               : contact.kind == ContactKind::kBilateral,
                     "contacts that the format does not have");
      if (!is_static) continue;
      mu.push_back(Double(contact.mu));
      rows += problem.dimension;
    }
    const int equations = problem.rows() - rows;
    for (const char* group : {"/fclib_local", "/fclib_local/vectors", "/fclib_local/info"}) Group(group);
    Integers("/fclib_local/spacedim", {problem.dimension});
    WriteMatrix("/fclib_local/W", problem, {0, rows}, {0, rows});
    Doubles("/fclib_local/vectors/q", Part(problem.b, 0, rows));
    Doubles("/fclib_local/vectors/mu", mu);
    Text("/fclib_local/info/title", title);
    if (equations == 0) return;
    WriteMatrix("/fclib_local/V", problem, {0, rows}, {rows, equations});
    WriteMatrix("/fclib_local/R", problem, {rows, equations}, {rows, equations});
    Doubles("/fclib_local/vectors/s", Part(problem.b, rows, equations));
  }

 private:
  struct Range {
    int first, count;
    bool Has(int i) const { return first <= i && i < first + count; }
  };

  static void Require(bool done) { STICTION_CHECK(done, "HDF5 does not write into memory"); }

  static double Double(const Rational& x) {
    const double value = ToDouble(x);
    STICTION_CHECK(Rational(value) == x, "a number of an FCLIB file that is no double");
    return value;
  }

  static std::vector<double> Part(const ExactProblem::Vector& values, int first, int count) {
    std::vector<double> part;
    for (int i = 0; i < count; ++i) part.push_back(Double(values[first + i]));
    return part;
  }

  void Group(const std::string& path) const {
    const Handle group(HDF5(H5Gcreate2)(file_.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       HDF5(H5Gclose));
    Require(group.valid());
  }

  void Set(const std::string& path, hid_t type, hid_t memory, hsize_t size, const void* values) const {
    const Handle space(HDF5(H5Screate_simple)(1, &size, nullptr), HDF5(H5Sclose));
    const Handle set(
        HDF5(H5Dcreate2)(file_.id(), path.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        HDF5(H5Dclose));
    Require(set.valid() &&
            (size == 0 || HDF5(H5Dwrite)(set.id(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0));
  }
  void Integers(const std::string& path, const std::vector<int>& values) const {
    Set(path, Hdf5Id("H5T_STD_I32LE_g"), Hdf5Id("H5T_NATIVE_INT_g"), values.size(), values.data());
  }
  void Doubles(const std::string& path, const std::vector<double>& values) const {
    Set(path, Hdf5Id("H5T_IEEE_F64LE_g"), Hdf5Id("H5T_NATIVE_DOUBLE_g"), values.size(), values.data());
  }
  void Text(const std::string& path, const std::string& text) const {
    const Handle type(HDF5(H5Tcopy)(Hdf5Id("H5T_C_S1_g")), HDF5(H5Tclose)),
        space(HDF5(H5Screate)(H5S_SCALAR), HDF5(H5Sclose));
    Require(HDF5(H5Tset_size)(type.id(), text.size() + 1) >= 0);
    const Handle set(HDF5(H5Dcreate2)(file_.id(), path.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT,
                                      H5P_DEFAULT),
                     HDF5(H5Dclose));
    Require(set.valid() &&
            HDF5(H5Dwrite)(set.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) >= 0);
  }

  // The block `rows` x `columns` of A.
  void WriteMatrix(const std::string& path, const ExactEntries& problem, Range rows, Range columns) const {
    const bool by_columns = storage_ != FclibStorage::kRows;
    std::map<std::pair<int, int>, double> lines;  // by line, place in it
    ForEachEntry(problem.A, [&](int row, int column, const Rational& value) {
      if (!rows.Has(row) || !columns.Has(column)) return;
      const int i = row - rows.first, j = column - columns.first;
      lines[by_columns ? std::pair(j, i) : std::pair(i, j)] = Double(value);
    });
    std::vector<int> p, i, pointers(1 + (by_columns ? columns.count : rows.count));
    std::vector<double> x;
    for (const auto& [at, value] : lines) {
      p.push_back(at.first);
      i.push_back(at.second);
      x.push_back(value);
      ++pointers[at.first + 1];
    }
    for (std::size_t k = 1; k < pointers.size(); ++k) pointers[k] += pointers[k - 1];
    const int entries = static_cast<int>(x.size());
    const bool triplet = storage_ == FclibStorage::kTriplet;
    Group(path);
    Integers(path + "/m", {rows.count});
    Integers(path + "/n", {columns.count});
    Integers(path + "/nzmax", {entries});
    Integers(path + "/nz", {triplet ? entries : by_columns ? -1 : -2});
    Integers(path + "/p", triplet ? p : pointers);
    Integers(path + "/i", i);
    Doubles(path + "/x", x);
  }

  FclibStorage storage_;
  Handle file_;
};

}  // namespace

ProblemFile ParseFclib(std::string text, const std::string& source) {
  if (text.empty()) throw InputError(source, "/", "an empty file", "an HDF5 file");
  Silence();
  return FclibReader(std::move(text), source).Read();
}

std::string PrintFclib(const ExactEntries& problem, const std::string& title, FclibStorage storage) {
  Silence();
  FclibWriter writer(storage);
  writer.Write(problem, title);
  return writer.Image();
}

}  // namespace stiction
