// SPDX-License-Identifier: Apache-2.0
// JSON values: for sources that make or read them. Headers take json_text.h, which names the type alone.

#pragma once

#include <nlohmann/json.hpp>

#include "corpus/json_text.h"
#include "corpus/rational.h"

// Instantiated once, in json_text.cpp.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace stiction {

// A number that is not finite becomes text.
Json NumberToJson(double x);
inline Json InJson(const Rational& x) { return ToString(x); }
inline Json InJson(double x) { return NumberToJson(x); }
inline const Json& InJson(const SharedJson& x) { return x; }
template <class Numbers>
Json ListJson(const Numbers& numbers) {
  Json json = Json::array();
  for (const auto& x : numbers) json.push_back(InJson(x));
  return json;
}
template <class Matrix>
Json RowsJson(const Matrix& A) {
  Json json = Json::array();
  for (int i = 0; i < A.rows(); ++i) json.push_back(ListJson(A.row(i)));
  return json;
}

}  // namespace stiction
