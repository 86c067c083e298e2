// SPDX-License-Identifier: Apache-2.0
#include "corpus/record/scene_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "corpus/json.h"
#include "corpus/record/scene_fields.h"

namespace stiction {
namespace {

constexpr std::string_view kSceneFormat = "stiction-scene";
constexpr int kSceneVersion = 1;

// ---- Reading ---------------------------------------------------------------------------------

// The dimension, from `least` to `most`. A file of another format or version has other keys: it is refused by
// these alone.
int ReadHeader(const JsonPlace& place, int least, int most) {
  place.RequireFormat(std::string(kSceneFormat), kSceneVersion);
  const std::string dimension = least == most ? std::to_string(least) : "2 or 3";
  return static_cast<int>(place.Required("dimension", dimension).Integer(least, most, dimension));
}

// read(place) of what may be missing.
template <class Read>
void TryKey(const JsonPlace& place, const char* key, Faults& faults, const Read& read) {
  faults.Try([&] {
    if (const auto given = place.Optional(key)) read(*given);
  });
}

// Calls visit for each element of an array that may be missing.
template <class Visit>
void ForEachOf(const JsonPlace& place, const std::string& key, const Visit& visit) {
  const auto list = place.Optional(key);
  const std::size_t count = list ? list->Size("an array of " + key) : 0;
  for (std::size_t i = 0; i < count; ++i) visit((*list)[i]);
}

// A mass, and an inertia, which shapes tell where all of them could be read.
template <class Kind>
void ReadMass(const JsonPlace& place, bool has_shapes, BodyIn<Kind, Rational>& body, Faults& faults) {
  const auto inertia = place.Optional("inertia");
  if (body.fixed) {
    for (const char* key : {"mass", "inertia", "force", "torque"}) {
      TryKey(place, key, faults,
             [&](const JsonPlace& given) { given.Refuse(std::string("no ") + key + " of a fixed body"); });
    }
    return;
  }
  TryKey(place, "acceleration", faults,
         [](const JsonPlace& given) { given.Refuse("no acceleration of a body that is not fixed"); });
  Faults of_mass(place.source());
  of_mass.Try([&] { body.mass = Positive(place.Required("mass", "the mass, a number > 0")); });
  faults.Take(of_mass);
  faults.Try([&] {
    if (inertia) return ReadInertia(*inertia, body.inertia);
    if (!has_shapes || !of_mass.empty()) return;
    if (body.shapes.empty()) place.Required("inertia", "an inertia, as there are no shapes to compute it from");
    body.inertia = UniformInertia(place, body);
  });
}

template <class Kind>
void ReadMotion(const JsonPlace& place, BodyIn<Kind, Rational>& body, Faults& faults) {
  const auto try_key = [&](const char* key, const auto& read) { TryKey(place, key, faults, read); };
  faults.Try([&] { ReadRotation(place, body.rotation); });
  try_key("position", [&](const JsonPlace& given) { body.position = ReadVector<Kind>(given); });
  try_key("velocity", [&](const JsonPlace& given) { body.velocity = ReadVector<Kind>(given); });
  try_key("spin", [&](const JsonPlace& given) { ReadSpin(given, body.spin); });
  try_key("acceleration", [&](const JsonPlace& given) { body.acceleration = ReadVector<Kind>(given); });
  try_key("force", [&](const JsonPlace& given) { body.force = ReadVector<Kind>(given); });
  try_key("torque", [&](const JsonPlace& given) { ReadSpin(given, body.torque); });
  try_key("level", [&](const JsonPlace& given) {
    body.level = static_cast<int>(given.Integer(-1000, 1000, "a level from -1000 to 1000"));
  });
}

// As far as it can be read: what is wrong goes to `faults`.
template <class Kind>
BodyIn<Kind, Rational> ReadBody(const JsonPlace& place, Faults& faults) {
  place.RequireObject();
  std::vector<std::string> keys = {"name",     "fixed",  "mass",     "inertia", "position",
                                   "rotation", "angle",  "velocity", "spin",    "acceleration",
                                   "force",    "torque", "shapes",   "level"};
  if (Kind::kDimension == 3) keys.insert(keys.begin() + 6, "axis");
  faults.Try([&] { place.AllowKeys(keys); });
  BodyIn<Kind, Rational> body;
  faults.Try([&] { body.name = place.Required("name", "a name").Text("a name"); });
  Faults of_fixed(place.source()), of_shapes(place.source());
  of_fixed.Try([&] {
    if (const auto fixed = place.Optional("fixed")) body.fixed = fixed->Truth();
  });
  of_shapes.Try([&] {
    ForEachOf(place, "shapes",
              [&](const JsonPlace& at) { of_shapes.Try([&] { body.shapes.push_back(ReadShape<Kind>(at)); }); });
  });
  if (of_fixed.empty()) ReadMass(place, of_shapes.empty(), body, faults);
  faults.Take(of_fixed);
  faults.Take(of_shapes);
  ReadMotion(place, body, faults);
  return body;
}

// Reads what refers to bodies by their names. What is wrong anywhere is told at once.
template <class Kind>
class SceneReader {
 public:
  SceneFileIn<Kind> Read(const JsonPlace& place) {
    ReadHeader(place, Kind::kDimension, Kind::kDimension);
    Faults faults(place.source());
    faults.Try([&] {
      place.AllowKeys({"format", "version", "name", "dimension", "note", "gravity", "mu", "gap", "rest", "step",
                       "seconds", "bodies", "joints", "contacts", "pairs"});
    });
    Numbers(place, faults);
    faults.Try([&] { place.Required("bodies", "an array of bodies"); });
    TryEachOf(place, "bodies", faults, [&](const JsonPlace& at) { AddBody(at, faults); });
    TryEachOf(place, "joints", faults,
              [&](const JsonPlace& at) { scene_.joints.push_back(OneJoint(at, faults)); });
    TryEachOf(place, "contacts", faults,
              [&](const JsonPlace& at) { scene_.contacts.push_back(OneContact(at, faults)); });
    TryEachOf(place, "pairs", faults,
              [&](const JsonPlace& at) { scene_.pairs.push_back(OneRule(at, faults)); });
    faults.Throw();
    return std::move(file_);
  }

 private:
  using Vector = typename Kind::template Vector<Rational>;

  template <class Visit>
  static void TryEachOf(const JsonPlace& place, const std::string& key, Faults& faults, const Visit& visit) {
    faults.Try([&] { ForEachOf(place, key, [&](const JsonPlace& at) { faults.Try([&] { visit(at); }); }); });
  }

  void Numbers(const JsonPlace& place, Faults& faults) {
    const auto try_key = [&](const char* key, const auto& read) { TryKey(place, key, faults, read); };
    faults.Try([&] { scene_.name = place.Required("name", "a string").Text("a string"); });
    scene_.gap = Rational(1, 1000);
    try_key("note", [&](const JsonPlace& given) { file_.note = given.Text("a string"); });
    try_key("mu", [&](const JsonPlace& given) { scene_.mu = NotNegative(given); });
    try_key("gap", [&](const JsonPlace& given) { scene_.gap = NotNegative(given); });
    try_key("rest", [&](const JsonPlace& given) { scene_.rest = NotNegative(given); });
    try_key("step", [&](const JsonPlace& given) { file_.step = Positive(given); });
    try_key("seconds", [&](const JsonPlace& given) { file_.seconds = Positive(given); });
    try_key("gravity", [&](const JsonPlace& given) { scene_.gravity = ReadVector<Kind>(given); });
  }

  void AddBody(const JsonPlace& place, Faults& faults) {
    BodyIn<Kind, Rational> body = ReadBody<Kind>(place, faults);
    const auto named = place.Optional("name");
    faults.Try([&] {
      for (const auto& other : scene_.bodies) {
        if (named && other.name == body.name) named->Refuse("a name of its own");
      }
    });
    scene_.bodies.push_back(std::move(body));
  }

  int BodyNumber(const JsonPlace& place) const {
    const std::string& name = place.Text("the name of a body");
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      if (scene_.bodies[i].name == name) return static_cast<int>(i);
    }
    place.Refuse("the name of a body of the scene");
  }

  template <class Item>
  void Pair(const JsonPlace& place, Item& item) const {
    const std::string expected = "the names of two bodies";
    const JsonPlace bodies = place.Required("bodies", expected);
    if (bodies.Size(expected) != 2) bodies.Refuse(expected);
    item.a = BodyNumber(bodies[0]);
    item.b = BodyNumber(bodies[1]);
    if (item.a == item.b) bodies.Refuse("two different bodies");
  }

  // "at": one point of the world; or "anchors": a point in the coordinates of each body.
  template <class Item>
  void Anchors(const JsonPlace& place, Item& item) const {
    const std::string expected = fmt::format("the points of both bodies [{0}, {0}]", SceneWords<Kind>::kAxes);
    const auto anchors = place.Optional("anchors");
    if (!anchors) {
      const Vector at = ReadVector<Kind>(place.Required("at", SceneWords<Kind>::kVector));
      item.at_a = scene_.bodies[item.a].Local(at);
      item.at_b = scene_.bodies[item.b].Local(at);
      return;
    }
    if (place.Optional("at")) anchors->Refuse(R"("at" or "anchors", not both)");
    if (anchors->Size(expected) != 2) anchors->Refuse(expected);
    item.at_a = ReadVector<Kind>((*anchors)[0]);
    item.at_b = ReadVector<Kind>((*anchors)[1]);
  }

  // A direction of the world, or in the coordinates of b.
  Vector Direction(const JsonPlace& place, const std::string& world, const std::string& local, int b) const {
    if (const auto found = place.Optional(local)) {
      if (place.Optional(world)) found->Refuse('"' + world + "\" or \"" + local + "\", not both");
      return ReadDirection<Kind>(*found);
    }
    const std::string expected = std::string("a direction ") + SceneWords<Kind>::kAxes;
    return RotateBack(TurnOf(scene_.bodies[b].rotation), ReadDirection<Kind>(place.Required(world, expected)));
  }

  JointIn<Kind, Rational> OneJoint(const JsonPlace& place, Faults& faults) const {
    constexpr const auto& kNames = Kind::kJointNames;
    place.RequireObject();
    faults.Try([&] { place.AllowKeys({"kind", "bodies", "at", "anchors", "direction", "axis", "turn"}); });
    const std::string kinds =
        fmt::format("{} or {}", fmt::join(kNames.begin(), kNames.end() - 1, ", "), kNames.back());
    const JsonPlace named = place.Required("kind", kinds);
    const auto kind = std::find(kNames.begin(), kNames.end(), named.Text(kinds));
    if (kind == kNames.end()) named.Refuse(kinds);
    JointIn<Kind, Rational> joint;
    joint.kind = static_cast<typename Kind::JointKind>(kind - kNames.begin());
    Pair(place, joint);
    Anchors(place, joint);
    for (const char* key : {"direction", "axis", "turn"}) {
      const auto given = place.Optional(key);
      if (given && !(key == std::string_view("turn") ? HasTurn(joint) : HasDirection(joint)))
        given->Refuse(fmt::format("no {} of a {}", key, *kind));
    }
    if (HasDirection(joint)) joint.direction = Direction(place, "direction", "axis", joint.b);
    joint.relative_rotation = SeenFrom(scene_.bodies[joint.b].rotation, scene_.bodies[joint.a].rotation);
    if (const auto turn = place.Optional("turn")) ReadTurn(*turn, joint.relative_rotation);
    return joint;
  }

  GivenContactIn<Kind, Rational> OneContact(const JsonPlace& place, Faults& faults) const {
    place.RequireObject();
    faults.Try([&] { place.AllowKeys({"bodies", "at", "anchors", "normal", "axis"}); });
    GivenContactIn<Kind, Rational> contact;
    Pair(place, contact);
    Anchors(place, contact);
    contact.normal = Direction(place, "normal", "axis", contact.b);
    return contact;
  }

  PairRule<Rational> OneRule(const JsonPlace& place, Faults& faults) const {
    place.RequireObject();
    faults.Try([&] { place.AllowKeys({"bodies", "mu", "collide"}); });
    PairRule<Rational> rule;
    Pair(place, rule);
    if (const auto mu = place.Optional("mu")) rule.mu = NotNegative(*mu);
    if (const auto collide = place.Optional("collide")) rule.collide = collide->Truth();
    return rule;
  }

  SceneFileIn<Kind> file_;
  SceneIn<Kind, Rational>& scene_ = file_.scene;
};

// ---- Writing ---------------------------------------------------------------------------------

template <class Kind>
Json BodyJson(const BodyIn<Kind, Rational>& body) {
  Json json = {{"name", body.name}};
  if (body.fixed) {
    json["fixed"] = true;
    json["acceleration"] = ListJson(body.acceleration);
  } else {
    json["mass"] = ToString(body.mass);
    json["inertia"] = InertiaJson(body.inertia);
    json["force"] = ListJson(body.force);
    json["torque"] = SpinJson(body.torque);
  }
  json["position"] = ListJson(body.position);
  json["rotation"] = ListJson(body.rotation);
  json["velocity"] = ListJson(body.velocity);
  json["spin"] = SpinJson(body.spin);
  json["level"] = body.level;
  json["shapes"] = Json::array();
  for (const auto& shape : body.shapes) json["shapes"].push_back(ShapeJson(shape));
  return json;
}

template <class Kind, class Item>
Json PairJson(const SceneIn<Kind, Rational>& scene, const Item& item) {
  return {{"bodies", Json::array({scene.bodies[item.a].name, scene.bodies[item.b].name})}};
}

template <class Kind, class Item>
Json AnchoredJson(const SceneIn<Kind, Rational>& scene, const Item& item) {
  Json json = PairJson(scene, item);
  json["anchors"] = Json::array({ListJson(item.at_a), ListJson(item.at_b)});
  return json;
}

template <class Kind>
Json JointJson(const SceneIn<Kind, Rational>& scene, const JointIn<Kind, Rational>& joint) {
  Json json = {{"kind", Kind::kJointNames[static_cast<std::size_t>(joint.kind)]}};
  json.update(AnchoredJson(scene, joint));
  if (HasDirection(joint)) json["axis"] = ListJson(joint.direction);
  if (HasTurn(joint)) json["turn"] = ListJson(joint.relative_rotation);
  return json;
}

template <class Kind>
Json ContactJson(const SceneIn<Kind, Rational>& scene, const GivenContactIn<Kind, Rational>& contact) {
  Json json = AnchoredJson(scene, contact);
  json["axis"] = ListJson(contact.normal);
  return json;
}

template <class Kind>
Json RuleJson(const SceneIn<Kind, Rational>& scene, const PairRule<Rational>& rule) {
  Json json = PairJson(scene, rule);
  if (rule.mu) json["mu"] = ToString(*rule.mu);
  if (rule.collide) json["collide"] = *rule.collide;
  return json;
}

}  // namespace

template <class Kind>
SceneFileIn<Kind> ParseScene(std::string_view text, const std::string& source) {
  return SceneReader<Kind>().Read(JsonPlace(text, source));
}
template SceneFile ParseScene<Plane>(std::string_view, const std::string&);
template SceneFileInSpace ParseScene<Space>(std::string_view, const std::string&);

SceneFile ReadScene(const std::filesystem::path& file) { return ParseScene(ReadText(file), file.string()); }

template <class Kind>
SharedJson ToJson(const SceneFileIn<Kind>& file) {
  const auto& scene = file.scene;
  Json json = {{"format", kSceneFormat},
               {"version", kSceneVersion},
               {"name", scene.name},
               {"dimension", Kind::kDimension}};
  if (!file.note.empty()) json["note"] = file.note;
  json["gravity"] = ListJson(scene.gravity);
  json["mu"] = ToString(scene.mu);
  json["gap"] = ToString(scene.gap);
  json["rest"] = ToString(scene.rest);
  json["step"] = ToString(file.step);
  json["seconds"] = ToString(file.seconds);
  for (const char* key : {"bodies", "joints", "contacts", "pairs"}) json[key] = Json::array();
  for (const auto& body : scene.bodies) json["bodies"].push_back(BodyJson(body));
  for (const auto& joint : scene.joints) json["joints"].push_back(JointJson(scene, joint));
  for (const auto& contact : scene.contacts) json["contacts"].push_back(ContactJson(scene, contact));
  for (const auto& rule : scene.pairs) json["pairs"].push_back(RuleJson(scene, rule));
  return json;
}
template SharedJson ToJson(const SceneFile&);
template SharedJson ToJson(const SceneFileInSpace&);

// The members of the scene, and of its lists, on a line each.
template <class Kind>
std::string Print(const SceneFileIn<Kind>& file) {
  const SharedJson json = ToJson(file);
  RequireWritable(json);
  std::string text = "{";
  for (const auto& [key, value] : json->items()) {
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
template std::string Print(const SceneFile&);
template std::string Print(const SceneFileInSpace&);

std::variant<SceneFile, SceneFileInSpace> ParseAnyScene(std::string_view text, const std::string& source) {
  const JsonPlace root(text, source);
  if (root.HasFormat("stiction-problem")) {
    const JsonPlace scene = root.Required("scene", "the scene of the problem");
    return ParseAnyScene(JsonText(scene.json()), source + ": scene");
  }
  if (ReadHeader(root, 2, 3) == 3) return ParseScene<Space>(text, source);
  return ParseScene(text, source);
}

std::variant<SceneFile, SceneFileInSpace> ReadAnyScene(const std::filesystem::path& file) {
  return ParseAnyScene(ReadText(file), file.string());
}

}  // namespace stiction
