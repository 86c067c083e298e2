// SPDX-License-Identifier: Apache-2.0
// What the readers and writers of scenes in the plane and in space have in common.

#ifndef STICTION_CORPUS_SCENE_READING_H_
#define STICTION_CORPUS_SCENE_READING_H_

#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "corpus/exact_number.h"
#include "corpus/scene_file.h"

namespace stiction {

inline constexpr std::string_view kSceneFormat = "stiction-scene";
inline constexpr int kSceneVersion = 1;

inline Rational Positive(const JsonPlace& place) {
  Rational x = ExactNumber(place);
  if (x <= 0) place.Refuse("a number > 0");
  return x;
}

inline Rational NotNegative(const JsonPlace& place) {
  Rational x = ExactNumber(place);
  if (x < 0) place.Refuse("a number >= 0");
  return x;
}

inline bool ReadFlag(const JsonPlace& place) {
  if (!place.json().is_boolean()) place.Refuse("true or false");
  return place.json().get<bool>();
}

// The dimension, from `least` to `most`.
inline int ReadSceneHeader(const JsonPlace& place, int least, int most) {
  const std::string format = '"' + std::string(kSceneFormat) + '"', version = std::to_string(kSceneVersion);
  const JsonPlace found = place.Required("format", format);
  if (found.Text(format) != kSceneFormat) found.Refuse(format);
  place.Required("version", version).Integer(kSceneVersion, kSceneVersion, version);
  place.AllowKeys({"format", "version", "name", "dimension", "note", "gravity", "mu", "gap", "rest", "step",
                   "seconds", "bodies", "joints", "contacts", "pairs"});
  const std::string dimension = least == most ? std::to_string(least) : "2 or 3";
  return static_cast<int>(place.Required("dimension", dimension).Integer(least, most, dimension));
}

template <class File, class SceneType>
void ReadSceneNumbers(const JsonPlace& place, File& file, SceneType& scene) {
  scene.name = place.Required("name", "a string").Text("a string");
  scene.gap = Rational(1, 1000);
  if (const auto note = place.Optional("note")) file.note = note->Text("a string");
  if (const auto mu = place.Optional("mu")) scene.mu = NotNegative(*mu);
  if (const auto gap = place.Optional("gap")) scene.gap = NotNegative(*gap);
  if (const auto rest = place.Optional("rest")) scene.rest = NotNegative(*rest);
  if (const auto step = place.Optional("step")) file.step = Positive(*step);
  if (const auto seconds = place.Optional("seconds")) file.seconds = Positive(*seconds);
}

// Calls visit for each element of an array that may be missing.
template <class Visit>
void ForEachOf(const JsonPlace& place, const std::string& key, const Visit& visit) {
  const auto list = place.Optional(key);
  const std::size_t count = list ? list->Size("an array") : 0;
  for (std::size_t i = 0; i < count; ++i) visit((*list)[i]);
}

template <class SceneType, class Body>
void AddBody(SceneType& scene, const JsonPlace& place, Body body) {
  for (const auto& other : scene.bodies) {
    if (other.name == body.name) place.Required("name", "").Refuse("a name of its own");
  }
  scene.bodies.push_back(std::move(body));
}

template <class SceneType>
int BodyNumber(const SceneType& scene, const JsonPlace& place) {
  const std::string& name = place.Text("the name of a body");
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].name == name) return static_cast<int>(i);
  }
  place.Refuse("the name of a body of the scene");
}

template <class SceneType>
std::pair<int, int> ReadPair(const SceneType& scene, const JsonPlace& place) {
  const std::string expected = "the names of two bodies";
  const JsonPlace bodies = place.Required("bodies", expected);
  if (bodies.Size(expected) != 2) bodies.Refuse(expected);
  const std::pair pair(BodyNumber(scene, bodies[0]), BodyNumber(scene, bodies[1]));
  if (pair.first == pair.second) bodies.Refuse("two different bodies");
  return pair;
}

template <class SceneType>
PairRule<Rational> ReadRule(const SceneType& scene, const JsonPlace& place) {
  place.RequireObject();
  place.AllowKeys({"bodies", "mu", "collide"});
  PairRule<Rational> rule;
  std::tie(rule.a, rule.b) = ReadPair(scene, place);
  if (const auto mu = place.Optional("mu")) rule.mu = NotNegative(*mu);
  if (const auto collide = place.Optional("collide")) rule.collide = ReadFlag(*collide);
  return rule;
}

template <class SceneType, class Item>
Json PairJson(const SceneType& scene, const Item& item) {
  return Json::array({scene.bodies[item.a].name, scene.bodies[item.b].name});
}

// All but bodies, joints and contacts, which are empty.
template <class File>
Json SceneJson(const File& file, int dimension, Json gravity) {
  const auto& scene = file.scene;
  Json json = {
      {"format", kSceneFormat}, {"version", kSceneVersion}, {"name", scene.name}, {"dimension", dimension}};
  if (!file.note.empty()) json["note"] = file.note;
  json["gravity"] = std::move(gravity);
  json["mu"] = ToString(scene.mu);
  json["gap"] = ToString(scene.gap);
  json["rest"] = ToString(scene.rest);
  json["step"] = ToString(file.step);
  json["seconds"] = ToString(file.seconds);
  for (const char* key : {"bodies", "joints", "contacts", "pairs"}) json[key] = Json::array();
  for (const auto& rule : scene.pairs) {
    Json rule_json = {{"bodies", PairJson(scene, rule)}};
    if (rule.mu) rule_json["mu"] = ToString(*rule.mu);
    if (rule.collide) rule_json["collide"] = *rule.collide;
    json["pairs"].push_back(std::move(rule_json));
  }
  return json;
}

inline std::string PrintScene(const Json& json) {
  std::string text = "{";
  for (const auto& [key, value] : json.items()) {
    text += (text == "{" ? "\n  " : ",\n  ") + JsonText(key) + ": ";
    if (!value.is_array() || value.empty() || !value[0].is_object()) {
      text += JsonText(value);
      continue;
    }
    for (std::size_t i = 0; i < value.size(); ++i)
      text += (i == 0 ? "[\n    " : ",\n    ") + JsonText(value[i]);
    text += "\n  ]";
  }
  return text + "\n}\n";
}

}  // namespace stiction

#endif  // STICTION_CORPUS_SCENE_READING_H_
