// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/json_mutation.h"

#include <array>
#include <iterator>
#include <vector>

#include "corpus/json.h"
#include "tests/fuzz/targets.h"

namespace stiction::fuzz {
namespace {

constexpr std::array kNumbers = {
    "0",        "-0",    "1",      "-1",   "1/3",    "2",   "-7/2", "1e10000",
    "1e-10000", "1e300", "1e-300", "1e16", "5e-324", "0.1", "1/0",  "9007199254740993",
    ""};
constexpr std::array<std::int64_t, 9> kIntegers = {0, 1, -1, 2, 3, 100, 1 << 30, INT64_MAX, INT64_MIN};

// A value that may stand anywhere.
Json AnyValue(Choices& choices) {
  switch (choices.Integer(0, 9)) {
    case 0:
      return nullptr;
    case 1:
      return choices.Integer(0, 1) != 0;
    case 2:
      return Json::array();
    case 3:
      return Json::object();
    case 4:
      return 0.5 * static_cast<double>(choices.Integer(-9, 9));
    case 5:
      return 1e300;
    case 6:
    case 7:
      return kIntegers[static_cast<std::size_t>(choices.Integer(0, kIntegers.size() - 1))];
    default:
      return kNumbers[static_cast<std::size_t>(choices.Integer(0, kNumbers.size() - 1))];
  }
}

// Another number near x, or of its size.
Rational NearNumber(const Rational& x, Choices& choices) {
  const Rational y(choices.Integer(-9, 9), choices.Integer(1, 9));
  switch (choices.Integer(0, 3)) {
    case 0:
      return -x;
    case 1:
      return x + y;
    case 2:
      return x * y;
    default:
      return x == 0 ? y : Rational(1 / x);
  }
}

// A value of the same type that is near this one; any value where nothing is near.
Json NearValue(const Json& value, Choices& choices) {
  if (value.is_number_integer() && !value.is_number_unsigned())
    return value.get<std::int64_t>() / 2 + choices.Integer(-2, 2);
  if (value.is_number_unsigned())
    return value.get<std::uint64_t>() / 2 + static_cast<std::uint64_t>(choices.Integer(0, 2));
  if (!value.is_string()) return AnyValue(choices);
  const std::string& text = value.get_ref<const std::string&>();
  if (text.starts_with('{') || text.starts_with('[')) return MutatedJson(text, choices);
  const auto x = ParseRational(text);
  return x ? Json(ToString(NearNumber(*x, choices))) : AnyValue(choices);
}

// Every value of the document but itself, by the container that it stands in.
struct Place {
  Json* container;
  std::size_t index;

  Json& value() const {
    if (container->is_array()) return container->at(index);
    return std::next(container->begin(), static_cast<std::ptrdiff_t>(index)).value();
  }
};

void ListPlaces(Json& json, std::vector<Place>& places) {
  for (std::size_t i = 0; json.is_structured() && i < json.size(); ++i) {
    places.push_back({&json, i});
    ListPlaces(places.back().value(), places);
  }
}

void Erase(const Place& place) {
  place.container->erase(std::next(place.container->begin(), static_cast<std::ptrdiff_t>(place.index)));
}

// Behind it in a list; under another key in an object.
void AddCopy(const Place& place, Choices& choices) {
  const Json copy = place.value();
  if (place.container->is_array()) {
    place.container->push_back(copy);
  } else {
    (*place.container)["key " + std::to_string(choices.Integer(0, 3))] = copy;
  }
}

void ChangeOnePlace(Json& document, Choices& choices) {
  std::vector<Place> places;
  ListPlaces(document, places);
  if (places.empty()) {
    document = AnyValue(choices);
    return;
  }
  const auto any_place = [&] {
    return places[static_cast<std::size_t>(choices.Integer(0, static_cast<std::int64_t>(places.size()) - 1))];
  };
  const Place place = any_place();
  switch (choices.Integer(0, 7)) {
    case 0:
      return Erase(place);
    case 1:
      return AddCopy(place, choices);
    case 2:
      place.value() = Json(any_place().value());
      return;
    case 3:
      place.value() = AnyValue(choices);
      return;
    default:
      place.value() = NearValue(Json(place.value()), choices);
  }
}

}  // namespace

std::string MutatedJson(std::string_view text, Choices& choices) {
  auto document = Unrefused([text] { return ParseJson(text, "input"); });
  if (!document) return std::string(text);
  for (std::int64_t changes = choices.Integer(1, 3); changes > 0; --changes) ChangeOnePlace(*document, choices);
  return document->dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace stiction::fuzz
