// SPDX-License-Identifier: Apache-2.0
#include "reports/animation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>

#include "corpus/json.h"
#include "reports/animation_template.h"
#include "reports/html/html.h"
#include "reports/html/packed.h"
#include "reports/pictures/draw_bodies.h"
#include "scene/tables.h"

namespace stiction {
namespace {

constexpr std::array kKinds = {"bilateral", "frictionless", "static", "sliding"};

// Numbers as bytes, the least ones first.
class NumberBytes {
 public:
  void AddWord(double x) {
    const auto word =
        static_cast<std::uint16_t>(static_cast<std::int16_t>(std::clamp(std::round(x), -32768.0, 32767.0)));
    Add(word, 2);
  }
  void AddFloat(double x) { Add(std::bit_cast<std::uint32_t>(static_cast<float>(x)), 4); }

  void Append(const NumberBytes& other) { bytes_ += other.bytes_; }
  bool operator==(const NumberBytes&) const = default;

  const std::string& bytes() const { return bytes_; }

 private:
  void Add(std::uint32_t bits, int bytes) {
    for (int k = 0; k < bytes; ++k) bytes_.push_back(static_cast<char>(bits >> 8 * k));
  }
  std::string bytes_;
};

constexpr double kTenths = 10, kTurns = 1e4;  // of a pixel; of a cosine
constexpr double kNoise = 1e-9;               // of the largest force of all frames: what is below is 0

// A list beside the one of the frame before: runs of what stands there, too, at the same places, and of what is
// new: `visit(first, same, end)`, of which [first, same) stands there.
template <class Item, class Visit>
void ForEachRun(const std::vector<Item>& before, const std::vector<Item>& now, const Visit& visit) {
  const auto stands = [&](std::size_t i) { return i < before.size() && before[i] == now[i]; };
  for (std::size_t first = 0; first < now.size();) {
    std::size_t same = first;
    while (same < now.size() && stands(same)) ++same;
    std::size_t end = same;
    while (end < now.size() && !stands(end)) ++end;
    visit(first, same, end);
    first = end;
  }
}

// Markup in parts, an element each.
std::vector<std::string> ElementsOf(const std::string& markup) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at < markup.size();) {
    const std::size_t next = std::min(markup.find('<', at + 1), markup.size());
    parts.push_back(markup.substr(at, next - at));
    at = next;
  }
  return parts;
}

// Of bodies at rest a frame repeats what the one before has.
struct FrameParts {
  std::vector<NumberBytes> forces;
  std::vector<std::string> placed;
};

void AppendForces(NumberBytes& packed, const FrameParts& before, const FrameParts& now) {
  packed.AddWord(static_cast<double>(now.forces.size()));
  ForEachRun(before.forces, now.forces, [&](std::size_t first, std::size_t same, std::size_t end) {
    packed.AddWord(static_cast<double>(same - first));
    packed.AddWord(static_cast<double>(end - same));
    for (std::size_t i = same; i < end; ++i) packed.Append(now.forces[i]);
  });
}

Json PlacedToJson(const FrameParts& before, const FrameParts& now) {
  Json json = Json::array();
  ForEachRun(before.placed, now.placed, [&](std::size_t first, std::size_t same, std::size_t end) {
    if (same > first) json.push_back(same - first);
    for (std::size_t i = same; i < end; ++i) json.push_back(now.placed[i]);
  });
  return json;
}

// What contacts of all frames have in common, each once.
template <class Kind>
class Contacts {
 public:
  int IndexOf(const AppliedForceIn<Kind>& force) {
    Json contact = {{"bodies", {force.bodies[0], force.bodies[1]}},
                    {"kind", kKinds[static_cast<std::size_t>(force.law.kind)]},
                    {"rows", force.rows.size()}};
    if (force.law.HasFrictionRows()) contact["mu"] = force.law.mu;
    const auto [found, is_new] = index_.emplace(JsonText(contact), static_cast<int>(json_.size()));
    if (is_new) json_.push_back(std::move(contact));
    return found->second;
  }
  const Json& json() const { return json_; }

 private:
  std::map<std::string, int> index_;
  Json json_ = Json::array();
};

// A force as draw.h shows it, in tenths of a pixel before it is cut, and by rows, those below `noise` as 0.
// `at` is its place.
template <class Kind>
void AddForce(NumberBytes& packed, const SceneIn<Kind, double>& scene, const Screen& screen,
              const AppliedForceIn<Kind>& force, double newton, double noise, int contact,
              const std::array<double, 2>& at) {
  const double side = ShownSide(scene, force.bodies) == 0 ? 1 : -1;
  Vector2<double> along = kTenths * side * newton * screen.scale * Seen(force.force);
  along *= std::min(1.0, 32000 / std::max(1.0, along.norm()));  // far longer than what is shown
  packed.AddWord(contact);
  for (const double x : at) packed.AddWord(kTenths * x);
  packed.AddWord(along[0]);
  packed.AddWord(-along[1]);
  for (const double f : force.rows) packed.AddFloat(std::abs(f) < noise ? 0 : f);
}

// x and y in tenths of a pixel, cosine and sine in ten thousandths, of each body in the plane.
Json PosesOf(const Scene<double>& scene, const Screen& screen) {
  Json poses = Json::array();
  for (const auto& body : scene.bodies) {
    for (const double x : {kTenths * screen.X(body.position), kTenths * screen.Y(body.position),
                           kTurns * body.rotation[0], kTurns * body.rotation[1]})
      poses.push_back(std::llround(x));
  }
  return poses;
}
Json PosesOf(const SceneInSpace<double>&, const Screen&) { return Json::array(); }

template <class Kind>
double LargestForce(const std::vector<FrameIn<Kind>>& frames) {
  double largest = 0;
  for (const auto& frame : frames) {
    for (const auto& force : frame.marks.forces) {
      for (const double f : force.rows) largest = std::max(largest, force.from_joint ? 0 : std::abs(f));
    }
  }
  return largest;
}

// The frames of a run one after another: as JSON, and the bytes of their forces.
template <class Kind>
class FramesWriter {
 public:
  FramesWriter(const Screen& screen, double newton, double noise)
      : screen_(screen), newton_(newton), noise_(noise) {}

  Json Next(const SceneIn<Kind, double>& moved, const FrameIn<Kind>& frame) {
    FrameParts now = {{}, ElementsOf(Placed(moved, screen_).markup())};
    std::set<std::array<double, 2>> places;
    for (const auto& force : frame.marks.forces) {
      if (force.from_joint) continue;
      const auto place = places.insert(PlaceOf(force.point)).first;
      AddForce(now.forces.emplace_back(), moved, screen_, force, newton_, noise_, contacts_.IndexOf(force),
               *place);
    }
    Json points = Json::array();  // that bear no force
    for (const auto& contact : frame.marks.contacts) {
      if (!places.contains(PlaceOf(contact))) points.push_back(PlaceOf(contact));
    }
    AppendForces(forces_, before_, now);
    Json json = {{"time", frame.time},
                 {"poses", PosesOf(moved, screen_)},
                 {"placed", PlacedToJson(before_, now)},
                 {"points", std::move(points)},
                 {"problems", frame.problems},
                 {"remark", frame.remark},
                 {"energy", ListJson(frame.energy)},
                 {"drift", ListJson(frame.drift)}};
    before_ = std::move(now);
    return json;
  }

  const Json& contacts() const { return contacts_.json(); }
  const std::string& forces() const { return forces_.bytes(); }

 private:
  template <class Point>
  std::array<double, 2> PlaceOf(const Point& point) const {
    const Vector2<double> at = Seen(point);
    return InPicture(screen_.X(at), screen_.Y(at));
  }

  const Screen& screen_;
  double newton_, noise_;
  Contacts<Kind> contacts_;
  NumberBytes forces_;
  FrameParts before_;
};

}  // namespace

template <class Kind>
std::string AnimationPage(const SceneIn<Kind, double>& scene, const View& view,
                          const std::vector<FrameIn<Kind>>& frames, double newton, double rate,
                          const std::vector<BodyMotion>& motions) {
  const Screen screen(view);
  Json names = Json::array(), bodies = Json::array(), shown = Json::array();
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i) names.push_back(NameOfBody(scene, i));
  for (const Html& picture : BodyPictures(scene, screen)) bodies.push_back(picture.markup());
  SceneIn<Kind, double> moved = scene;
  FramesWriter<Kind> writer(screen, newton, kNoise * LargestForce(frames));
  for (const auto& frame : frames) {
    SetPoses(moved, frame);
    shown.push_back(writer.Next(moved, frame));
  }
  Json ends = Json::array();
  for (const BodyMotion& motion : motions)
    ends.push_back({{"body", motion.body}, {"speed", motion.speed}, {"word", motion.word}});
  const Json data = {{"name", scene.name},
                     {"dimension", Kind::kDimension},
                     {"rate", rate},
                     {"size", {screen.width, screen.height}},
                     {"scale", screen.scale},
                     {"names", names},
                     {"bodies", bodies},
                     {"contacts", writer.contacts()},
                     {"motions", std::move(ends)},
                     {"frames", Packed(JsonText(shown))},
                     {"forces", Packed(writer.forces())}};
  const std::string page(std::begin(kAnimationTemplate), std::end(kAnimationTemplate));
  return FilledTemplate(page, {{"title", Text(scene.name)}, {"data", ScriptData(JsonText(data))}});
}

template std::string AnimationPage(const SceneIn<Plane, double>&, const View&,
                                   const std::vector<FrameIn<Plane>>&, double, double,
                                   const std::vector<BodyMotion>&);
template std::string AnimationPage(const SceneIn<Space, double>&, const View&,
                                   const std::vector<FrameIn<Space>>&, double, double,
                                   const std::vector<BodyMotion>&);

}  // namespace stiction
