// SPDX-License-Identifier: Apache-2.0
#include "corpus/scene_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "corpus/scene_reading.h"

namespace stiction {
namespace {

using Vector = Vector2<Rational>;

constexpr std::array<std::string_view, 3> kJointNames = {"pin", "rail", "slider"};
const std::string kPair = "a pair of numbers [x, y]";

// Up to the rounding of doubles.
bool IsUnit(const Vector& v) {
  const Rational excess = abs(Dot<Rational>(v, v) - 1);
  return excess < Rational(1, 1000000000000000);
}

// ---- Reading ---------------------------------------------------------------------------------

Vector ReadVector(const JsonPlace& place) {
  if (place.Size(kPair) != 2) place.Refuse(kPair);
  return MakeVector2<Rational>(ExactNumber(place[0]), ExactNumber(place[1]));
}

// A direction: made a unit vector unless it is one.
Vector ReadDirection(const JsonPlace& place) {
  const Vector v = ReadVector(place);
  if (v[0] == 0 && v[1] == 0) place.Refuse("a direction, not zero");
  return IsUnit(v) ? v : UnitVector<Rational>(v);
}

Vector ReadRotation(const JsonPlace& place) {
  const Vector v = ReadVector(place);
  if (!IsUnit(v)) place.Refuse("[cos, sin], cos^2 + sin^2 = 1 up to the rounding of doubles");
  return v;
}

BodyShape<Rational> ReadBox(const JsonPlace& place, const Vector& center) {
  const Vector size = ReadVector(place);
  for (std::size_t i = 0; i < 2; ++i) {
    if (size[static_cast<int>(i)] <= 0) place[i].Refuse("a number > 0");
  }
  BodyShape<Rational> shape;
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    shape.polygon.push_back(MakeVector2<Rational>(center[0] + x * size[0] / 2, center[1] + y * size[1] / 2));
  return shape;
}

BodyShape<Rational> ReadShape(const JsonPlace& place) {
  const std::string expected = R"(one of {"polygon": corners}, {"box": [width, height]}, {"disc": radius})";
  place.RequireObject();
  place.AllowKeys({"polygon", "box", "disc", "center"});
  const auto polygon = place.Optional("polygon"), box = place.Optional("box"), disc = place.Optional("disc");
  if (polygon.has_value() + box.has_value() + disc.has_value() != 1) place.Refuse(expected);
  BodyShape<Rational> shape;
  const auto center = place.Optional("center");
  if (center) shape.center = ReadVector(*center);
  if (box) return ReadBox(*box, shape.center);
  if (disc) {
    shape.radius = Positive(*disc);
    return shape;
  }
  if (center) center->Refuse("no center of a polygon");
  const std::size_t corners = polygon->Size("an array of corners");
  for (std::size_t i = 0; i < corners; ++i) shape.polygon.push_back(ReadVector((*polygon)[i]));
  const std::string fault = PolygonFault(shape.polygon);
  if (!fault.empty()) polygon->Refuse(fault, "a strictly convex polygon, its corners anticlockwise");
  return shape;
}

// A uniform body of that mass and these shapes.
Rational UniformInertia(const JsonPlace& place, const RigidBody<Rational>& body) {
  const std::string expected = "an inertia > 0, as there are no shapes to compute it from";
  if (body.shapes.empty()) return Positive(place.Required("inertia", expected));
  const MassProperties<Rational> properties = MassPropertiesOf(body.shapes);
  if (properties.center[0] != 0 || properties.center[1] != 0) {
    place.Refuse("no inertia, and shapes with the centre [" + ToString(properties.center[0]) + ", " +
                     ToString(properties.center[1]) + "]",
                 "shapes about their centre of mass, or an inertia");
  }
  return Rational(body.mass * properties.inertia / properties.area);
}

void ReadMass(const JsonPlace& place, RigidBody<Rational>& body) {
  const auto inertia = place.Optional("inertia");
  if (body.fixed) {
    for (const char* key : {"mass", "inertia", "force", "torque"}) {
      if (const auto given = place.Optional(key)) given->Refuse(std::string("no ") + key + " of a fixed body");
    }
    return;
  }
  if (const auto given = place.Optional("acceleration"))
    given->Refuse("no acceleration of a body that is not fixed");
  body.mass = Positive(place.Required("mass", "the mass, a number > 0"));
  body.inertia = inertia ? Positive(*inertia) : UniformInertia(place, body);
}

RigidBody<Rational> ReadBody(const JsonPlace& place) {
  place.RequireObject();
  place.AllowKeys({"name", "fixed", "mass", "inertia", "position", "rotation", "angle", "velocity", "spin",
                   "acceleration", "force", "torque", "shapes", "level"});
  RigidBody<Rational> body;
  body.name = place.Required("name", "a name").Text("a name");
  if (const auto fixed = place.Optional("fixed")) body.fixed = ReadFlag(*fixed);
  if (const auto shapes = place.Optional("shapes")) {
    const std::size_t count = shapes->Size("an array of shapes");
    for (std::size_t i = 0; i < count; ++i) body.shapes.push_back(ReadShape((*shapes)[i]));
  }
  ReadMass(place, body);
  const auto rotation = place.Optional("rotation"), angle = place.Optional("angle");
  if (rotation && angle) angle->Refuse("a rotation or an angle, not both");
  if (rotation) body.rotation = ReadRotation(*rotation);
  if (angle) {
    const double radians = ToDouble(ExactNumber(*angle));
    body.rotation = MakeVector2<Rational>(std::cos(radians), std::sin(radians));
  }
  if (const auto position = place.Optional("position")) body.position = ReadVector(*position);
  if (const auto velocity = place.Optional("velocity")) body.velocity = ReadVector(*velocity);
  if (const auto acceleration = place.Optional("acceleration")) body.acceleration = ReadVector(*acceleration);
  if (const auto force = place.Optional("force")) body.force = ReadVector(*force);
  if (const auto spin = place.Optional("spin")) body.spin = ExactNumber(*spin);
  if (const auto torque = place.Optional("torque")) body.torque = ExactNumber(*torque);
  if (const auto level = place.Optional("level"))
    body.level = static_cast<int>(level->Integer(-1000, 1000, "a level from -1000 to 1000"));
  return body;
}

// Reads what refers to bodies by their names.
class SceneReader {
 public:
  SceneFile Read(const JsonPlace& place);

 private:
  void Bodies(const JsonPlace& place);
  Joint<Rational> OneJoint(const JsonPlace& place) const;
  GivenContact<Rational> OneContact(const JsonPlace& place) const;
  template <class Item>
  void Anchors(const JsonPlace& place, Item& item) const;
  Vector Direction(const JsonPlace& place, const std::string& world, const std::string& local, int b) const;

  Scene<Rational> scene_;
};

SceneFile SceneReader::Read(const JsonPlace& place) {
  ReadSceneHeader(place, 2, 2);
  SceneFile file;
  ReadSceneNumbers(place, file, scene_);
  if (const auto gravity = place.Optional("gravity")) scene_.gravity = ReadVector(*gravity);
  Bodies(place.Required("bodies", "an array of bodies"));
  ForEachOf(place, "joints", [this](const JsonPlace& at) { scene_.joints.push_back(OneJoint(at)); });
  ForEachOf(place, "contacts", [this](const JsonPlace& at) { scene_.contacts.push_back(OneContact(at)); });
  ForEachOf(place, "pairs", [this](const JsonPlace& at) { scene_.pairs.push_back(ReadRule(scene_, at)); });
  file.scene = std::move(scene_);
  return file;
}

void SceneReader::Bodies(const JsonPlace& place) {
  const std::size_t count = place.Size("an array of bodies");
  for (std::size_t i = 0; i < count; ++i) AddBody(scene_, place[i], ReadBody(place[i]));
}

// "at": one point of the world; or "anchors": a point in the coordinates of each body.
template <class Item>
void SceneReader::Anchors(const JsonPlace& place, Item& item) const {
  const std::string expected = "the points of both bodies [[x, y], [x, y]]";
  const auto anchors = place.Optional("anchors");
  if (anchors) {
    if (place.Optional("at")) anchors->Refuse(R"("at" or "anchors", not both)");
    if (anchors->Size(expected) != 2) anchors->Refuse(expected);
    item.at_a = ReadVector((*anchors)[0]);
    item.at_b = ReadVector((*anchors)[1]);
    return;
  }
  const Vector at = ReadVector(place.Required("at", kPair));
  item.at_a = scene_.bodies[item.a].Local(at);
  item.at_b = scene_.bodies[item.b].Local(at);
}

// A direction of the world, or in the coordinates of b.
Vector SceneReader::Direction(const JsonPlace& place, const std::string& world, const std::string& local,
                              int b) const {
  if (const auto found = place.Optional(local)) {
    if (place.Optional(world)) found->Refuse('"' + world + "\" or \"" + local + "\", not both");
    return ReadDirection(*found);
  }
  return RotateBack<Rational>(scene_.bodies[b].rotation,
                              ReadDirection(place.Required(world, "a direction [x, y]")));
}

Joint<Rational> SceneReader::OneJoint(const JsonPlace& place) const {
  place.RequireObject();
  place.AllowKeys({"kind", "bodies", "at", "anchors", "direction", "axis", "turn"});
  const std::string kinds = "pin, rail or slider";
  const JsonPlace named = place.Required("kind", kinds);
  const auto kind = std::find(kJointNames.begin(), kJointNames.end(), named.Text(kinds));
  if (kind == kJointNames.end()) named.Refuse(kinds);
  Joint<Rational> joint;
  joint.kind = static_cast<JointKind>(kind - kJointNames.begin());
  std::tie(joint.a, joint.b) = ReadPair(scene_, place);
  Anchors(place, joint);
  joint.direction = joint.relative_rotation = MakeVector2<Rational>(Rational(1), Rational(0));
  if (joint.kind == JointKind::kPin) {
    for (const char* key : {"direction", "axis", "turn"}) {
      if (const auto given = place.Optional(key)) given->Refuse(std::string("no ") + key + " of a pin");
    }
    return joint;
  }
  joint.direction = Direction(place, "direction", "axis", joint.b);
  joint.relative_rotation =
      RotateBack<Rational>(scene_.bodies[joint.b].rotation, scene_.bodies[joint.a].rotation);
  const auto turn = place.Optional("turn");
  if (turn && joint.kind != JointKind::kSlider) turn->Refuse("no turn of a rail");
  if (turn) joint.relative_rotation = ReadRotation(*turn);
  return joint;
}

GivenContact<Rational> SceneReader::OneContact(const JsonPlace& place) const {
  place.RequireObject();
  place.AllowKeys({"bodies", "at", "anchors", "normal", "axis"});
  GivenContact<Rational> contact;
  std::tie(contact.a, contact.b) = ReadPair(scene_, place);
  Anchors(place, contact);
  contact.normal = Direction(place, "normal", "axis", contact.b);
  return contact;
}

// ---- Writing ---------------------------------------------------------------------------------

Json VectorJson(const Vector& v) { return Json::array({ToString(v[0]), ToString(v[1])}); }

Json ShapeJson(const BodyShape<Rational>& shape) {
  if (shape.IsDisc()) return {{"disc", ToString(shape.radius)}, {"center", VectorJson(shape.center)}};
  Json corners = Json::array();
  for (const auto& corner : shape.polygon) corners.push_back(VectorJson(corner));
  return {{"polygon", std::move(corners)}};
}

Json BodyJson(const RigidBody<Rational>& body) {
  Json json = {{"name", body.name}};
  if (body.fixed) {
    json["fixed"] = true;
    json["acceleration"] = VectorJson(body.acceleration);
  } else {
    json["mass"] = ToString(body.mass);
    json["inertia"] = ToString(body.inertia);
    json["force"] = VectorJson(body.force);
    json["torque"] = ToString(body.torque);
  }
  json["position"] = VectorJson(body.position);
  json["rotation"] = VectorJson(body.rotation);
  json["velocity"] = VectorJson(body.velocity);
  json["spin"] = ToString(body.spin);
  json["level"] = body.level;
  json["shapes"] = Json::array();
  for (const auto& shape : body.shapes) json["shapes"].push_back(ShapeJson(shape));
  return json;
}

template <class Item>
Json AnchorsJson(const Item& item) {
  return Json::array({VectorJson(item.at_a), VectorJson(item.at_b)});
}

Json JointJson(const Scene<Rational>& scene, const Joint<Rational>& joint) {
  Json json = {{"kind", kJointNames[static_cast<int>(joint.kind)]},
               {"bodies", PairJson(scene, joint)},
               {"anchors", AnchorsJson(joint)}};
  if (joint.kind != JointKind::kPin) json["axis"] = VectorJson(joint.direction);
  if (joint.kind == JointKind::kSlider) json["turn"] = VectorJson(joint.relative_rotation);
  return json;
}

}  // namespace

SceneFile ParseScene(std::string_view text, const std::string& source) {
  const Json json = ParseJson(text, source);
  return SceneReader().Read(JsonPlace(json, source, ""));
}

SceneFile ReadScene(const std::filesystem::path& file) { return ParseScene(ReadText(file), file.string()); }

Json ToJson(const SceneFile& file) {
  const Scene<Rational>& scene = file.scene;
  Json json = SceneJson(file, 2, VectorJson(scene.gravity));
  for (const auto& body : scene.bodies) json["bodies"].push_back(BodyJson(body));
  for (const auto& joint : scene.joints) json["joints"].push_back(JointJson(scene, joint));
  for (const auto& contact : scene.contacts) {
    json["contacts"].push_back({{"bodies", PairJson(scene, contact)},
                                {"anchors", AnchorsJson(contact)},
                                {"axis", VectorJson(contact.normal)}});
  }
  return json;
}

std::string Print(const SceneFile& file) { return PrintScene(ToJson(file)); }

std::variant<SceneFile, SceneFileInSpace> ReadAnyScene(const std::filesystem::path& file) {
  std::string text = ReadText(file), source = file.string();
  Json json = ParseJson(text, source);
  if (json.is_object() && json.value("format", Json()) == "stiction-problem") {
    const Json scene = JsonPlace(json, source, "").Required("scene", "the scene of the problem").json();
    json = scene;
    text = JsonText(json);
    source += ": scene";
  }
  if (ReadSceneHeader(JsonPlace(json, source, ""), 2, 3) == 3) return ParseSceneInSpace(text, source);
  return ParseScene(text, source);
}

}  // namespace stiction
