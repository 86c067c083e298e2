// SPDX-License-Identifier: Apache-2.0
// HDF5 files, written as JSON says: damaged in what they hold, not in how HDF5 writes it.
//
//   {"/fclib_local/W/m": [2], ...}   path -> what stands there
//
//   null            a group                            "text"    a string
//   [1, 2]          32-bit integers                    [1.5, 2]  doubles; of them "nan", "inf", "-inf"
//   {"type": T, "extent": [e, ...], "values": [...], "chunk": c}
//                   T one of "i8", "u32", "i64", "f32", "f64", "f80"; "extent" instead of one dimension; where
//                   it is not the number of values, nothing is written, and HDF5 reads zeros; "chunk": in
//                   chunks of so many

#include "corpus/formats/fclib.h"

#include <hdf5.h>

#include <cmath>
#include <map>

#include "corpus/json.h"
#include "corpus/record/asymmetry.h"
#include "solver/problem/check.h"
#include "tests/fuzz/same.h"
#include "tests/fuzz/targets.h"

namespace stiction::fuzz {
namespace {

// An identifier that closes itself.
class Hdf5Id {
 public:
  Hdf5Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Hdf5Id(const Hdf5Id&) = delete;
  Hdf5Id& operator=(const Hdf5Id&) = delete;
  ~Hdf5Id() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

double DoubleIn(const Json& value) {
  if (value.is_number()) return value.get<double>();
  if (value == "inf") return INFINITY;
  return value == "-inf" ? -INFINITY : NAN;
}

std::int64_t IntegerIn(const Json& value) { return value.is_number_integer() ? value.get<std::int64_t>() : 0; }

hid_t TypeNamed(const std::string& name) {
  static const std::map<std::string, hid_t> types = {
      {"i8", H5T_STD_I8LE},    {"u32", H5T_STD_U32LE},  {"i32", H5T_STD_I32LE},     {"i64", H5T_STD_I64LE},
      {"f32", H5T_IEEE_F32LE}, {"f64", H5T_IEEE_F64LE}, {"f80", H5T_NATIVE_LDOUBLE}};
  const auto type = types.find(name);
  return type == types.end() ? H5T_STD_I32LE : type->second;
}

struct DataSet {
  std::string type = "i32";
  std::vector<hsize_t> extent;
  Json values = Json::array();
  hsize_t chunk = 0;  // 0: not in chunks
};

bool AllIntegers(const Json& values) {
  for (const Json& value : values) {
    if (!value.is_number_integer()) return false;
  }
  return true;
}

DataSet DataSetOf(const Json& json) {
  DataSet set;
  if (json.is_array()) {
    set.values = json;
    set.type = AllIntegers(json) ? "i32" : "f64";
    set.extent = {json.size()};
    return set;
  }
  if (const auto type = json.find("type"); type != json.end() && type->is_string())
    set.type = type->get<std::string>();
  if (const auto values = json.find("values"); values != json.end() && values->is_array())
    set.values = Json(*values);
  if (const auto chunk = json.find("chunk"); chunk != json.end())
    set.chunk = static_cast<hsize_t>(IntegerIn(*chunk)) & 0xffff;
  set.extent = {set.values.size()};
  const auto extent = json.find("extent");
  if (extent == json.end() || !extent->is_array()) return set;
  set.extent.clear();
  for (const Json& size : *extent) set.extent.push_back(static_cast<hsize_t>(IntegerIn(size)) & 0xffffffff);
  return set;
}

// A file in memory, to which whatever cannot be added is not.
class Hdf5Writer {
 public:
  Hdf5Writer() : links_(H5Pcreate(H5P_LINK_CREATE), H5Pclose), file_(MakeFile(), H5Fclose) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    H5Pset_create_intermediate_group(links_, 1);
    STICTION_CHECK(file_ >= 0, "HDF5 makes no file");
  }

  void Add(const std::string& path, const Json& json) const {
    if (json.is_null()) {
      Hdf5Id(H5Gcreate2(file_, path.c_str(), links_, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    } else if (json.is_string()) {
      AddText(path, json.get_ref<const std::string&>());
    } else if (json.is_array() || json.is_object()) {
      AddSet(path, DataSetOf(json));
    }
  }

  std::string Image() const {
    H5Fflush(file_, H5F_SCOPE_GLOBAL);
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    std::string image(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
    H5Fget_file_image(file_, image.data(), image.size());
    return image;
  }

 private:
  static hid_t MakeFile() {
    const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access, 1 << 16, false);
    return H5Fcreate("fuzz", H5F_ACC_TRUNC, H5P_DEFAULT, access);
  }

  void AddText(const std::string& path, const std::string& text) const {
    const Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
    H5Tset_size(type, text.size() + 1);
    const Hdf5Id set(H5Dcreate2(file_, path.c_str(), type, space, links_, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
    if (set >= 0) H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str());
  }

  void AddSet(const std::string& path, const DataSet& data) const {
    const Hdf5Id space(H5Screate_simple(static_cast<int>(data.extent.size()), data.extent.data(), nullptr),
                       H5Sclose);
    const Hdf5Id layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    const std::vector<hsize_t> chunks(data.extent.size(), data.chunk);
    if (data.chunk > 0) H5Pset_chunk(layout, static_cast<int>(chunks.size()), chunks.data());
    const Hdf5Id set(H5Dcreate2(file_, path.c_str(), TypeNamed(data.type), space, links_, layout, H5P_DEFAULT),
                     H5Dclose);
    hsize_t count = 1;
    for (const hsize_t size : data.extent) count *= size;
    if (set < 0 || count != data.values.size() || count == 0) return;
    if (data.type[0] == 'f') {
      std::vector<double> values;
      for (const Json& value : data.values) values.push_back(DoubleIn(value));
      H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    } else {
      std::vector<std::int64_t> values;
      for (const Json& value : data.values) values.push_back(IntegerIn(value));
      H5Dwrite(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    }
  }

  Hdf5Id links_, file_;
};

bool TakesFclib(std::string image) {
  const auto problem = Unrefused([&image] { return ParseFclib(std::move(image), "input"); });
  if (!problem) return false;
  const bool is_printed = problem->problem.rows() <= kMostRowsPrinted && IsInDoubles(problem->problem);
  if (!is_printed || LargestAsymmetry(problem->problem).difference != 0) return true;
  for (const FclibStorage storage : {FclibStorage::kColumns, FclibStorage::kRows, FclibStorage::kTriplet}) {
    const std::string printed = PrintFclib(problem->problem.entries(), problem->name, storage);
    STICTION_CHECK(IsSame(ParseFclib(printed, "what was written").problem, problem->problem),
                   "a problem that is read back to another");
  }
  return true;
}

}  // namespace

bool FuzzFclib(std::string_view bytes) {
  const auto json = Unrefused([bytes] { return ParseJson(bytes, "input"); });
  if (!json || !json->is_object()) return false;
  const Hdf5Writer writer;
  for (const auto& [path, value] : json->items()) writer.Add(path, value);
  return TakesFclib(writer.Image());
}

bool FuzzHdf5(std::string_view bytes) { return TakesFclib(std::string(bytes)); }

}  // namespace stiction::fuzz
