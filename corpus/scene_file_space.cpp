// SPDX-License-Identifier: Apache-2.0
// Scene files of dimension 3.

#include <algorithm>
#include <array>
#include <cmath>

#include "corpus/scene_reading.h"

namespace stiction {
namespace {

using Vector = Vector3<Rational>;

constexpr std::array<std::string_view, 4> kJointNames = {"ball", "hinge", "rail", "slider"};
const std::string kTriple = "three numbers [x, y, z]";

// ---- Reading ---------------------------------------------------------------------------------

Vector ReadVector(const JsonPlace& place) {
  if (place.Size(kTriple) != 3) place.Refuse(kTriple);
  return MakeVector3<Rational>(ExactNumber(place[0]), ExactNumber(place[1]), ExactNumber(place[2]));
}

bool IsZero(const Vector& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

// A direction: made a unit vector unless it is one up to the rounding of doubles.
Vector ReadDirection(const JsonPlace& place) {
  const Vector v = ReadVector(place);
  if (IsZero(v)) place.Refuse("a direction, not zero");
  const Rational excess = abs(v.squaredNorm() - 1);
  return excess < Rational(1, 1000000000000000) ? v : UnitVector3<Rational>(v);
}

ShapeInSpace<Rational> Box(const JsonPlace& place, const Vector& center) {
  const Vector size = ReadVector(place);
  for (int i = 0; i < 3; ++i) {
    if (size[i] <= 0) place[static_cast<std::size_t>(i)].Refuse("a number > 0");
  }
  std::vector<Vector> corners;
  for (int i = 0; i < 8; ++i) {
    Vector corner = center;
    for (int k = 0; k < 3; ++k) corner[k] += ((i >> k & 1) != 0 ? 1 : -1) * size[k] / 2;
    corners.push_back(corner);
  }
  return MakePolyhedron(std::move(corners)).shape;
}

ShapeInSpace<Rational> ReadShape(const JsonPlace& place) {
  place.RequireObject();
  place.AllowKeys({"polyhedron", "box", "ball", "center"});
  const auto corners = place.Optional("polyhedron"), box = place.Optional("box"), ball = place.Optional("ball");
  if (corners.has_value() + box.has_value() + ball.has_value() != 1)
    place.Refuse(R"(one of {"polyhedron": corners}, {"box": [x, y, z]}, {"ball": radius})");
  Vector center = Zero3<Rational>();
  const auto given_center = place.Optional("center");
  if (given_center) center = ReadVector(*given_center);
  if (box) return Box(*box, center);
  if (ball) {
    ShapeInSpace<Rational> shape;
    shape.center = center;
    shape.radius = Positive(*ball);
    return shape;
  }
  if (given_center) given_center->Refuse("no center of a polyhedron");
  std::vector<Vector> points;
  const std::size_t count = corners->Size("an array of corners");
  for (std::size_t i = 0; i < count; ++i) points.push_back(ReadVector((*corners)[i]));
  Polyhedron polyhedron = MakePolyhedron(std::move(points));
  if (!polyhedron.fault.empty()) corners->Refuse(polyhedron.fault, "the corners of a convex polyhedron");
  return std::move(polyhedron.shape);
}

// Principal moments [x, y, z], or a symmetric matrix.
Matrix3<Rational> ReadInertia(const JsonPlace& place) {
  const std::string expected =
      "principal moments [x, y, z], or a symmetric positive definite matrix of three rows";
  if (place.Size(expected) != 3) place.Refuse(expected);
  Matrix3<Rational> I = Matrix3<Rational>::Constant(Rational(0));
  const bool full = place[0].json().is_array();
  for (int i = 0; i < 3; ++i) {
    const JsonPlace row = place[static_cast<std::size_t>(i)];
    if (full) {
      I.row(i) = ReadVector(row).transpose();
    } else {
      I(i, i) = Positive(row);
    }
  }
  const Rational minor = I(0, 0) * I(1, 1) - I(0, 1) * I(1, 0);
  const Vector x = I.row(0), y = I.row(1), z = I.row(2);
  const Rational determinant = x.dot(CrossProduct<Rational>(y, z));
  const bool symmetric = I(0, 1) == I(1, 0) && I(0, 2) == I(2, 0) && I(1, 2) == I(2, 1);
  if (!symmetric || I(0, 0) <= 0 || minor <= 0 || determinant <= 0) place.Refuse(expected);
  return I;
}

// A uniform body of that mass and these shapes.
Matrix3<Rational> UniformInertia(const JsonPlace& place, const BodyInSpace<Rational>& body) {
  if (body.shapes.empty()) place.Required("inertia", "an inertia, as there are no shapes to compute it from");
  const MassPropertiesInSpace properties = MassPropertiesOf(body.shapes);
  const Vector& c = properties.center;
  if (!IsZero(c)) {
    place.Refuse("no inertia, and shapes with the centre [" + ToString(c[0]) + ", " + ToString(c[1]) + ", " +
                     ToString(c[2]) + "]",
                 "shapes about their centre of mass, or an inertia");
  }
  return properties.inertia * Rational(body.mass / properties.volume);
}

void ReadMass(const JsonPlace& place, BodyInSpace<Rational>& body) {
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
  body.inertia = inertia ? ReadInertia(*inertia) : UniformInertia(place, body);
}

Quaternion<Rational> ReadQuaternion(const JsonPlace& place) {
  const std::string expected = "a quaternion [w, x, y, z], not zero";
  if (place.Size(expected) != 4) place.Refuse(expected);
  Quaternion<Rational> q;
  for (std::size_t i = 0; i < 4; ++i) q[static_cast<int>(i)] = ExactNumber(place[i]);
  if (q.squaredNorm() == 0) place.Refuse(expected);
  return q;
}

// "rotation": a quaternion [w, x, y, z]; or "axis" and "angle" in radians.
Quaternion<Rational> ReadRotation(const JsonPlace& place) {
  const auto rotation = place.Optional("rotation"), axis = place.Optional("axis"),
             angle = place.Optional("angle");
  if (rotation && (axis || angle)) rotation->Refuse("a rotation, or an axis and an angle, not both");
  if (rotation) return ReadQuaternion(*rotation);
  if (!axis && !angle) return MakeQuaternion<Rational>(Rational(1), Zero3<Rational>());
  const double half = ToDouble(ExactNumber(place.Required("angle", "an angle about the axis, rad"))) / 2;
  const Vector direction = ReadDirection(place.Required("axis", "an axis [x, y, z] of the angle"));
  return MakeQuaternion<Rational>(Rational(std::cos(half)), Vector(Rational(std::sin(half)) * direction));
}

BodyInSpace<Rational> ReadBody(const JsonPlace& place) {
  place.RequireObject();
  place.AllowKeys({"name", "fixed", "mass", "inertia", "position", "rotation", "axis", "angle", "velocity",
                   "spin", "acceleration", "force", "torque", "shapes", "level"});
  BodyInSpace<Rational> body;
  body.name = place.Required("name", "a name").Text("a name");
  if (const auto fixed = place.Optional("fixed")) body.fixed = ReadFlag(*fixed);
  ForEachOf(place, "shapes", [&body](const JsonPlace& at) { body.shapes.push_back(ReadShape(at)); });
  ReadMass(place, body);
  body.rotation = ReadRotation(place);
  if (const auto position = place.Optional("position")) body.position = ReadVector(*position);
  if (const auto velocity = place.Optional("velocity")) body.velocity = ReadVector(*velocity);
  if (const auto spin = place.Optional("spin")) body.spin = ReadVector(*spin);
  if (const auto acceleration = place.Optional("acceleration")) body.acceleration = ReadVector(*acceleration);
  if (const auto force = place.Optional("force")) body.force = ReadVector(*force);
  if (const auto torque = place.Optional("torque")) body.torque = ReadVector(*torque);
  if (const auto level = place.Optional("level"))
    body.level = static_cast<int>(level->Integer(-1000, 1000, "a level from -1000 to 1000"));
  return body;
}

// "at": one point of the world; or "anchors": a point in the coordinates of each body.
template <class Item>
void ReadAnchors(const SceneInSpace<Rational>& scene, const JsonPlace& place, Item& item) {
  const std::string expected = "the points of both bodies [[x, y, z], [x, y, z]]";
  const auto anchors = place.Optional("anchors");
  if (!anchors) {
    const Vector at = ReadVector(place.Required("at", kTriple));
    item.at_a = scene.bodies[item.a].Local(at);
    item.at_b = scene.bodies[item.b].Local(at);
    return;
  }
  if (place.Optional("at")) anchors->Refuse(R"("at" or "anchors", not both)");
  if (anchors->Size(expected) != 2) anchors->Refuse(expected);
  item.at_a = ReadVector((*anchors)[0]);
  item.at_b = ReadVector((*anchors)[1]);
}

// A direction of the world, or in the coordinates of b.
Vector DirectionSeenFrom(const BodyInSpace<Rational>& b, const JsonPlace& place, const std::string& world,
                         const std::string& local) {
  if (const auto found = place.Optional(local)) {
    if (place.Optional(world)) found->Refuse('"' + world + "\" or \"" + local + "\", not both");
    return ReadDirection(*found);
  }
  const Vector direction = ReadDirection(place.Required(world, "a direction [x, y, z]"));
  return RotationMatrix<Rational>(b.rotation).transpose() * direction;
}

JointInSpace<Rational> ReadJoint(const SceneInSpace<Rational>& scene, const JsonPlace& place) {
  place.RequireObject();
  place.AllowKeys({"kind", "bodies", "at", "anchors", "direction", "axis", "turn"});
  const std::string kinds = "ball, hinge, rail or slider";
  const JsonPlace named = place.Required("kind", kinds);
  const auto kind = std::find(kJointNames.begin(), kJointNames.end(), named.Text(kinds));
  if (kind == kJointNames.end()) named.Refuse(kinds);
  JointInSpace<Rational> joint;
  joint.kind = static_cast<JointKindInSpace>(kind - kJointNames.begin());
  std::tie(joint.a, joint.b) = ReadPair(scene, place);
  ReadAnchors(scene, place, joint);
  const bool ball = joint.kind == JointKindInSpace::kBall, rail = joint.kind == JointKindInSpace::kRail;
  for (const char* key : {"direction", "axis", "turn"}) {
    const auto given = place.Optional(key);
    if (given && (ball || (rail && key == std::string_view("turn"))))
      given->Refuse(std::string("no ") + key + " of a " + named.Text(kinds));
  }
  const BodyInSpace<Rational>&a = scene.bodies[joint.a], &b = scene.bodies[joint.b];
  joint.direction = ball ? Zero3<Rational>() : DirectionSeenFrom(b, place, "direction", "axis");
  const auto turn = place.Optional("turn");
  joint.relative_rotation =
      turn ? ReadQuaternion(*turn) : Product<Rational>(Conjugate<Rational>(b.rotation), a.rotation);
  return joint;
}

GivenContactInSpace<Rational> ReadContact(const SceneInSpace<Rational>& scene, const JsonPlace& place) {
  place.RequireObject();
  place.AllowKeys({"bodies", "at", "anchors", "normal", "axis"});
  GivenContactInSpace<Rational> contact;
  std::tie(contact.a, contact.b) = ReadPair(scene, place);
  ReadAnchors(scene, place, contact);
  contact.normal = DirectionSeenFrom(scene.bodies[contact.b], place, "normal", "axis");
  return contact;
}

// ---- Writing ---------------------------------------------------------------------------------

template <class Numbers>
Json NumbersJson(const Numbers& numbers) {
  Json json = Json::array();
  for (int i = 0; i < numbers.size(); ++i) json.push_back(ToString(numbers[i]));
  return json;
}

Json ShapeJson(const ShapeInSpace<Rational>& shape) {
  if (shape.IsBall()) return {{"ball", ToString(shape.radius)}, {"center", NumbersJson(shape.center)}};
  Json corners = Json::array();
  for (const auto& corner : shape.corners) corners.push_back(NumbersJson(corner));
  return {{"polyhedron", std::move(corners)}};
}

Json BodyJson(const BodyInSpace<Rational>& body) {
  Json json = {{"name", body.name}};
  if (body.fixed) {
    json["fixed"] = true;
    json["acceleration"] = NumbersJson(body.acceleration);
  } else {
    json["mass"] = ToString(body.mass);
    json["inertia"] = Json::array();
    for (int i = 0; i < 3; ++i) json["inertia"].push_back(NumbersJson(Vector(body.inertia.row(i))));
    json["force"] = NumbersJson(body.force);
    json["torque"] = NumbersJson(body.torque);
  }
  json["position"] = NumbersJson(body.position);
  json["rotation"] = NumbersJson(body.rotation);
  json["velocity"] = NumbersJson(body.velocity);
  json["spin"] = NumbersJson(body.spin);
  json["level"] = body.level;
  json["shapes"] = Json::array();
  for (const auto& shape : body.shapes) json["shapes"].push_back(ShapeJson(shape));
  return json;
}

template <class Item>
Json AnchoredJson(const SceneInSpace<Rational>& scene, const Item& item) {
  return {{"bodies", PairJson(scene, item)},
          {"anchors", Json::array({NumbersJson(item.at_a), NumbersJson(item.at_b)})}};
}

Json JointJson(const SceneInSpace<Rational>& scene, const JointInSpace<Rational>& joint) {
  Json json = {{"kind", kJointNames[static_cast<int>(joint.kind)]}};
  json.update(AnchoredJson(scene, joint));
  if (joint.kind != JointKindInSpace::kBall) json["axis"] = NumbersJson(joint.direction);
  if (joint.kind == JointKindInSpace::kHinge || joint.kind == JointKindInSpace::kSlider)
    json["turn"] = NumbersJson(joint.relative_rotation);
  return json;
}

}  // namespace

SceneFileInSpace ParseSceneInSpace(std::string_view text, const std::string& source) {
  const Json json = ParseJson(text, source);
  const JsonPlace place(json, source, "");
  ReadSceneHeader(place, 3, 3);
  SceneFileInSpace file;
  SceneInSpace<Rational>& scene = file.scene;
  ReadSceneNumbers(place, file, scene);
  if (const auto gravity = place.Optional("gravity")) scene.gravity = ReadVector(*gravity);
  place.Required("bodies", "an array of bodies");
  ForEachOf(place, "bodies", [&scene](const JsonPlace& at) { AddBody(scene, at, ReadBody(at)); });
  ForEachOf(place, "joints", [&scene](const JsonPlace& at) { scene.joints.push_back(ReadJoint(scene, at)); });
  ForEachOf(place, "contacts",
            [&scene](const JsonPlace& at) { scene.contacts.push_back(ReadContact(scene, at)); });
  ForEachOf(place, "pairs", [&scene](const JsonPlace& at) { scene.pairs.push_back(ReadRule(scene, at)); });
  return file;
}

Json ToJson(const SceneFileInSpace& file) {
  const SceneInSpace<Rational>& scene = file.scene;
  Json json = SceneJson(file, 3, NumbersJson(scene.gravity));
  for (const auto& body : scene.bodies) json["bodies"].push_back(BodyJson(body));
  for (const auto& joint : scene.joints) json["joints"].push_back(JointJson(scene, joint));
  for (const auto& contact : scene.contacts) {
    Json contact_json = AnchoredJson(scene, contact);
    contact_json["axis"] = NumbersJson(contact.normal);
    json["contacts"].push_back(std::move(contact_json));
  }
  return json;
}

std::string Print(const SceneFileInSpace& file) { return PrintScene(ToJson(file)); }

}  // namespace stiction
