// SPDX-License-Identifier: Apache-2.0
// Fuzz targets: functions that take any bytes. libFuzzer calls them (libfuzzer.cpp), and so do the tests.
//
// Each returns whether the bytes were an input that the program takes; what it refuses with an InputError is
// none. Whatever else is thrown is a fault: that of the program, or a broken property, which is an
// InternalError.
//
// clang-format off
//   problem       a problem file: what is read is written and read back to the same
//   certificate   a certificate: a claim that the checker accepts is true, as the makers of certificates decide it
//   record        a record: what is read is written and read back to the same; small ones hold or do not
//   rational      a number as text: its value, its nearest double, as a JSON number; against GMP and strtod
//   campaign      a campaign file, a list of policies, a policy or a friction coefficient
//   scene         a scene file: read back to the same; its contacts and problems, if it is small
//   siconos       a .dat file, read as both kinds; read back from every storage
//   fclib         JSON that says what an HDF5 file holds (fclib.cpp): such a file, likewise
//   hdf5          an HDF5 file as it is. What is damaged in it is first of all HDF5's affair
//   store         JSON that says what stands in the columns of a store (store.cpp): statistics, report, merge
//   certify       the same problems: every certificate that is made of one is accepted
//   every         a problem, scene or .dat file: every reader, then every method and every writer
//   solve         choices (bytes.h) that make a problem (extreme.h) and choose a method and an arithmetic
// clang-format on

#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "corpus/input_error.h"

namespace stiction::fuzz {

bool FuzzProblem(std::string_view bytes);
bool FuzzCertificate(std::string_view bytes);
bool FuzzRecord(std::string_view bytes);
bool FuzzRational(std::string_view bytes);
bool FuzzCampaign(std::string_view bytes);
bool FuzzScene(std::string_view bytes);
bool FuzzSiconos(std::string_view bytes);
bool FuzzFclib(std::string_view bytes);
bool FuzzHdf5(std::string_view bytes);
bool FuzzStore(std::string_view bytes);
bool FuzzSolve(std::string_view bytes);
bool FuzzCertify(std::string_view bytes);
bool FuzzEvery(std::string_view bytes);

struct Target {
  std::string_view name;
  bool (*run)(std::string_view bytes);
};
std::span<const Target> Targets();

// What read() returns; nothing if it refuses its input.
template <class Read>
auto Unrefused(Read read) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace stiction::fuzz
