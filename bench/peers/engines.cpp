// SPDX-License-Identifier: Apache-2.0
// Table `engines`: scenes simulated by stiction and by engines, all of boxes on a floor, mu = 1/2, 240 steps a
// second. Each scene is made as a scene file, which stiction simulates; engines are given its bodies.
//
//   frames a second   of processor time, of the steps alone
//   worst frame       the longest step, ms
//   moved             the farthest that a body is at the end from where it stood; of scenes that rest
//   drift             how fast that grows in the second half, m/s
//   overlap           the deepest of any two bodies, at ten times; measured by stiction for all
//   end               stands, or falls: a body moved by more than half of its least edge, or sank into the
//   floor
//                     by as much, or is nowhere. What falls has no rank.
//
// What takes longer than the cap ends there: `frames` says where.

#include "bench/peers/engines.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/output.h"
#include "bench/peers/tables.h"
#include "corpus/json.h"
#include "corpus/record/scene_file.h"
#include "corpus/stopwatch.h"
#include "scene/simulate.h"
#include "search/generators/choices.h"

namespace stiction {
namespace {

constexpr int kFramesASecond = 240;

// ---- Scenes ------------------------------------------------------------------------------------

struct EngineScene {
  std::string name;
  bool rests = true;  // nothing should move
  int seconds = 1;
  Json json;
};

std::string Thousandths(double x) { return fmt::format("{}/1000", std::lround(1000 * x)); }

// A point (x, height) of the plane, in space with y between.
Json Point(int dimension, double x, double y, double height) {
  Json point = {Thousandths(x)};
  if (dimension == 3) point.push_back(Thousandths(y));
  point.push_back(Thousandths(height));
  return point;
}

Json Box(const std::string& name, int mass, Json position, Json edges) {
  return {{"name", name},
          {"mass", mass},
          {"position", std::move(position)},
          {"shapes", Json::array({Json{{"box", std::move(edges)}}})}};
}

EngineScene Empty(const std::string& name, int dimension) {
  Json floor = Box("floor", 1, Point(dimension, 0, 0, -1), dimension == 2 ? Json{200, 2} : Json{200, 200, 2});
  floor.erase("mass");
  floor["fixed"] = true;
  Json json = {{"format", "stiction-scene"},
               {"version", 1},
               {"name", name},
               {"dimension", dimension},
               {"gravity", dimension == 2 ? Json{0, -10} : Json{0, 0, -10}},
               {"mu", "1/2"},
               {"step", fmt::format("1/{}", kFramesASecond)},
               {"bodies", Json::array({std::move(floor)})}};
  return {.name = name, .json = std::move(json)};
}

// The uppermost course is a shorter one, that is, courses are even: the last brick of a longer one tips over.
EngineScene Wall(const std::string& name, int dimension, int courses, int bricks) {
  EngineScene scene = Empty(name, dimension);
  for (int course = 0; course < courses; ++course) {
    for (int k = 0; k < bricks - course % 2; ++k) {
      const Json edges = dimension == 2 ? Json{"31/32", "1/2"} : Json{"31/32", "1/2", "1/2"};
      scene.json["bodies"].push_back(Box(fmt::format("{}-{}", course, k), 1,
                                         Point(dimension, k + course % 2 / 2.0, 0, course / 2.0 + 0.25),
                                         edges));
    }
  }
  return scene;
}

// Ten cubes, every other one of a larger mass.
EngineScene Stack(int dimension, int mass) {
  EngineScene scene =
      Empty(fmt::format("boxes-1-to-{}-{}", mass, dimension == 2 ? "planar" : "space"), dimension);
  for (int k = 0; k < 10; ++k)
    scene.json["bodies"].push_back(Box(fmt::format("{}", k), k % 2 == 0 ? 1 : mass,
                                       Point(dimension, 0, 0, k + 0.5),
                                       dimension == 2 ? Json{1, 1} : Json{1, 1, 1}));
  return scene;
}

EngineScene Pile() {
  EngineScene scene = Empty("pile-50", 3);
  scene.rests = false;
  Choices choices(1);
  for (int k = 0; k < 50; ++k) {
    const auto x = choices.Integer(-1200, 1200), y = choices.Integer(-1200, 1200);
    scene.json["bodies"].push_back(
        Box(fmt::format("{}", k), 1, Point(3, x / 1000.0, y / 1000.0, 0.7 + 0.3 * k), Json{1, "4/5", "3/5"}));
  }
  return scene;
}

EngineScene Dominoes() {
  EngineScene scene = Empty("dominoes-20", 3);
  scene.rests = false;
  for (int k = 0; k < 20; ++k)
    scene.json["bodies"].push_back(
        Box(fmt::format("{}", k), 1, Point(3, 0.5 * k, 0, 0.5), Json{"1/10", "1/2", 1}));
  scene.json["bodies"][1]["spin"] = {0, 2, 0};
  return scene;
}

// On a slope, which is gravity aslant: its tangent is 99 % of mu.
EngineScene InsideTheCone(int dimension) {
  EngineScene scene = Empty(fmt::format("cone-99-percent-{}", dimension == 2 ? "planar" : "space"), dimension);
  scene.seconds = 10;
  scene.json["gravity"] = dimension == 2 ? Json{"495/100", -10} : Json{"297/100", "396/100", -10};
  scene.json["bodies"].push_back(
      Box("block", 1, Point(dimension, 0, 0, 0.5), dimension == 2 ? Json{1, 1} : Json{1, 1, 1}));
  return scene;
}

// With a block, ten times as heavy as a brick, that is thrown at the wall at 20 m/s.
EngineScene Hit(EngineScene wall, const std::string& name, int courses) {
  const int dimension = wall.json["dimension"];
  wall.name = name;
  wall.json["name"] = name;
  wall.rests = false;
  Json block =
      Box("block", 10, Point(dimension, -2, 0, courses / 4.0), dimension == 2 ? Json{1, 1} : Json{1, 1, 1});
  block["velocity"] = dimension == 2 ? Json{20, 0} : Json{20, 0, 0};
  wall.json["bodies"].push_back(std::move(block));
  return wall;
}

std::vector<EngineScene> EngineScenes() {
  std::vector<EngineScene> scenes = {Wall("wall-95", 2, 10, 10),
                                     Wall("wall-46", 2, 4, 12),
                                     Wall("wall-23", 2, 2, 12),
                                     Wall("wall-27-space", 3, 6, 5),
                                     Wall("wall-95-space", 3, 10, 10),
                                     Hit(Wall("", 2, 7, 7), "hit-46", 7),
                                     Hit(Wall("", 2, 10, 10), "hit-95", 10),
                                     Hit(Wall("", 3, 4, 4), "hit-14-space", 4),
                                     Hit(Wall("", 3, 6, 5), "hit-27-space", 6),
                                     Pile(),
                                     Dominoes()};
  for (const int dimension : {2, 3}) {
    for (const int mass : {1, 100, 10000}) scenes.push_back(Stack(dimension, mass));
    scenes.push_back(InsideTheCone(dimension));
  }
  return scenes;
}

// ---- Worlds --------------------------------------------------------------------------------------

Eigen::Vector3d InWorld(const Eigen::Vector2d& v) { return {v.x(), v.y(), 0}; }
Eigen::Vector3d InWorld(const Eigen::Vector3d& v) { return v; }
Eigen::Vector3d SpinInWorld(double spin) { return {0, 0, spin}; }
Eigen::Vector3d SpinInWorld(const Eigen::Vector3d& spin) { return spin; }

Pose PoseOfBody(const RigidBody<double>& body) {
  const double angle = std::atan2(body.rotation.y(), body.rotation.x());
  return {InWorld(body.position), Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()))};
}
Pose PoseOfBody(const BodyInSpace<double>& body) {
  return {body.position, {body.rotation[0], body.rotation[1], body.rotation[2], body.rotation[3]}};
}
void Move(RigidBody<double>& body, const Pose& pose) {
  body.position = pose.position.head<2>();
  body.rotation = (pose.rotation.toRotationMatrix() * Eigen::Vector3d::UnitX()).head<2>();
}
void Move(BodyInSpace<double>& body, const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  body.position = pose.position;
  body.rotation = {q.w(), q.x(), q.y(), q.z()};
}

template <class Kind>
EngineWorld WorldOf(const SceneIn<Kind, double>& scene) {
  EngineWorld world{Kind::kDimension == 2, scene.mu, 1.0 / kFramesASecond, InWorld(scene.gravity), {}};
  for (const auto& body : scene.bodies) {
    EngineBody box{body.fixed,
                   body.mass,
                   Eigen::Vector3d::Constant(0.5),
                   PoseOfBody(body),
                   InWorld(body.velocity),
                   SpinInWorld(body.spin)};
    for (const auto& corner : body.shapes.front().corners)  // about the origin, along the axes
      box.half.head<Kind::kDimension>() = corner.cwiseAbs();
    world.bodies.push_back(box);
  }
  return world;
}

template <class Kind>
class StictionEngine : public Engine {
 public:
  explicit StictionEngine(const SceneIn<Kind, double>& scene) : simulation_(scene, 1.0 / kFramesASecond) {}
  void Step() override { simulation_.Step(); }
  Pose PoseOf(int body) const override { return PoseOfBody(simulation_.scene().bodies[body]); }

 private:
  SimulationIn<Kind> simulation_;
};

template <class Kind>
std::vector<EngineKind> KindsFor(const SceneIn<Kind, double>& scene) {
  std::vector<EngineKind> kinds = {{"stiction", "this", true, true, [&scene](const EngineWorld&) {
                                      return std::make_unique<StictionEngine<Kind>>(scene);
                                    }}};
  for (const auto& found : {Box2dEngines(), BulletEngines(), OdeEngines(), MujocoEngines()}) {
    for (const EngineKind& kind : found) {
      if (Kind::kDimension == 2 ? kind.plane : kind.space) kinds.push_back(kind);
    }
  }
  return kinds;
}

// ---- Measuring -----------------------------------------------------------------------------------

std::vector<Pose> PosesOf(const Engine& engine, std::size_t bodies) {
  std::vector<Pose> poses;
  for (std::size_t k = 0; k < bodies; ++k) poses.push_back(engine.PoseOf(static_cast<int>(k)));
  return poses;
}

// The farthest of any body from where it stood; infinite where one is nowhere.
double MovedBy(const EngineWorld& world, const std::vector<Pose>& poses) {
  double moved = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const double distance = (poses[k].position - world.bodies[k].pose.position).norm();
    if (!std::isfinite(distance)) return std::numeric_limits<double>::infinity();
    moved = std::max(moved, distance);
  }
  return moved;
}

// "ends" where nothing should rest.
std::string EndOf(const EngineScene& scene, const EngineWorld& world, const std::vector<Pose>& poses) {
  constexpr double kMoves = 1e-3;  // m
  const int up = world.planar ? 1 : 2;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const EngineBody& body = world.bodies[k];
    if (body.fixed) continue;
    const double least = body.half.head(up + 1).minCoeff(), height = poses[k].position[up];
    const double moved = (poses[k].position - body.pose.position).norm();
    if (!std::isfinite(moved) || height < 0 || (scene.rests && moved > least)) return "falls";
  }
  if (!scene.rests) return "ends";
  return MovedBy(world, poses) > kMoves ? "moves" : "stands";
}

template <class Kind>
double OverlapOf(SceneIn<Kind, double> scene, const std::vector<Pose>& poses) {
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (!scene.bodies[k].fixed) Move(scene.bodies[k], poses[k]);
  }
  return DriftOf(scene).overlap;
}

// A number, or nothing where it is none.
Json Finite(double x) { return std::isfinite(x) ? Json(x) : Json(); }

template <class Kind>
Json MeasureEngine(const EngineKind& kind, const EngineScene& scene, const SceneIn<Kind, double>& file,
                   const EngineWorld& world, int frames, double cap) {
  Json row = {{"engine", kind.name}, {"version", kind.version}};
  std::vector<double> moved = {0};
  std::vector<Pose> poses;
  double seconds = 0, worst = 0, overlap = 0;
  const auto engine = kind.make(world);
  for (int frame = 1; frame <= frames && seconds < cap; ++frame) {
    const Stopwatch watch;
    engine->Step();
    const double step = watch.Seconds();
    seconds += step;
    worst = std::max(worst, step);
    poses = PosesOf(*engine, world.bodies.size());
    moved.push_back(MovedBy(world, poses));
    if (!std::isfinite(moved.back())) break;
    if (frame % std::max(1, frames / 10) == 0) overlap = std::max(overlap, OverlapOf(file, poses));
  }
  if (!poses.empty() && std::isfinite(moved.back())) overlap = std::max(overlap, OverlapOf(file, poses));
  const std::size_t done = moved.size() - 1, half = done / 2;
  row["frames a second"] = static_cast<double>(done) / seconds;
  row["worst frame"] = 1000 * worst;
  row["frames"] = done;
  row["moved"] = scene.rests ? Finite(moved.back()) : Json();
  row["drift"] = scene.rests && done > half
                     ? Finite((moved[done] - moved[half]) * kFramesASecond / static_cast<double>(done - half))
                     : Json();
  row["overlap"] = overlap;
  row["end"] = EndOf(scene, world, poses);
  return row;
}

// From 1, by speed, of those that do not fall.
void Rank(Json& rows) {
  std::vector<double> rates;
  for (const Json& row : rows) {
    if (row["end"] != "falls") rates.push_back(row["frames a second"]);
  }
  std::sort(rates.rbegin(), rates.rend());
  for (Json& row : rows) {
    const auto at = std::find(rates.begin(), rates.end(), row["frames a second"].get<double>());
    row["rank"] = row["end"] == "falls" ? Json() : Json(at - rates.begin() + 1);
  }
}

template <class Kind>
Json MeasureEngineScene(const EngineScene& scene, const SceneFileIn<Kind>& given, const PeersOptions& o) {
  const SceneIn<Kind, double> file = Round(given.scene);
  const EngineWorld world = WorldOf(file);
  Json rows = Json::array();
  const auto kinds = KindsFor(file);
  const int frames = std::min(o.frames, scene.seconds * kFramesASecond);
  for (const EngineKind& kind : kinds)
    rows.push_back(MeasureEngine(kind, scene, file, world, frames, o.engine_cap));
  Rank(rows);
  return {{"scene", scene.name},
          {"dimension", Kind::kDimension},
          {"bodies", world.bodies.size() - 1},
          {"rows", rows}};
}

void PrintScene(const Json& scene) {
  BenchTable table{"engines", fmt::format("{}, {} boxes: frames a second of processor time; m, m/s",
                                          scene["scene"].get<std::string>(), scene["bodies"].get<int>())};
  for (const Json& row : scene["rows"]) {
    Json shown = {{"engine", row["engine"]}, {"version", row["version"]}};
    for (const char* key :
         {"rank", "frames a second", "worst frame", "frames", "moved", "drift", "overlap", "end"})
      shown[key] = row[key].is_null() ? Json("-") : row[key];
    table.rows.push_back(shown);
  }
  Print(table);
}

}  // namespace

std::vector<std::string> EngineSceneNames() {
  std::vector<std::string> names;
  for (const EngineScene& scene : EngineScenes()) names.push_back(scene.name);
  return names;
}

Json MeasureEngines(const PeersOptions& o) {
  std::vector<EngineScene> scenes = EngineScenes();
  std::erase_if(scenes, [&o](const EngineScene& scene) {
    return !o.families.empty() &&
           std::find(o.families.begin(), o.families.end(), scene.name) == o.families.end();
  });
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  progress::Begin("engines", static_cast<std::int64_t>(scenes.size()));
  Json measured = Json::array();
  for (const EngineScene& scene : scenes) {
    const auto file = ParseAnyScene(JsonText(scene.json), scene.name);
    measured.push_back(std::visit([&](const auto& of) { return MeasureEngineScene(scene, of, o); }, file));
    progress::Done();
    if (!o.json) PrintScene(measured.back());
  }
  return {{"name", "engines"}, {"frames_a_second", kFramesASecond}, {"scenes", measured}};
}

}  // namespace stiction
