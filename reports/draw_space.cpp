// SPDX-License-Identifier: Apache-2.0
#include "reports/draw_space.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>

#include "corpus/json_text.h"
#include "reports/draw_page.h"

namespace stiction {
namespace {

using Point = Vector3<double>;

// ---- The eye ---------------------------------------------------------------------------------

const Point kToward = Point(0.42, -0.78, 0.46).normalized();  // from the scene to the eye
const Point kRight = Point(-kToward[1], kToward[0], 0).normalized();
const Point kUp = CrossProduct<double>(kToward, kRight);
const Point kLight = Point(-0.3, -0.5, 0.8).normalized();

Vector2<double> Seen(const Point& p) { return {kRight.dot(p), kUp.dot(p)}; }

// ---- Pieces from back to front ---------------------------------------------------------------

struct ConvexPiece {
  const ShapeInSpace<double>* shape;
  std::vector<Point> corners, normals;
  Point center;
  Matrix3<double> turn;
  bool fixed = false;
  int level = 0;
  Vector2<double> low, high;  // of the picture
};

ConvexPiece PieceOf(const BodyInSpace<double>& body, const ShapeInSpace<double>& shape) {
  ConvexPiece piece;
  piece.shape = &shape;
  piece.turn = RotationMatrix<double>(body.rotation);
  piece.fixed = body.fixed;
  piece.level = body.level;
  piece.center = body.position + piece.turn * shape.center;
  for (const auto& corner : shape.corners) piece.corners.push_back(body.position + piece.turn * corner);
  for (const auto& normal : shape.normals) piece.normals.push_back(piece.turn * normal);
  const Vector2<double> radius(shape.radius, shape.radius);
  piece.low = Seen(shape.IsBall() ? piece.center : piece.corners[0]) - radius;
  piece.high = piece.low + 2 * radius;
  if (!shape.IsBall()) piece.center.setZero();
  for (const auto& corner : piece.corners) {
    piece.low = piece.low.cwiseMin(Seen(corner));
    piece.high = piece.high.cwiseMax(Seen(corner));
    piece.center += corner / static_cast<double>(piece.corners.size());
  }
  return piece;
}

// 1 if a face of P has Q wholly outside and looks at the eye, so that Q is in front of P; -1 if it looks away;
// 0 if there is none.
int InFront(const ConvexPiece& P, const ConvexPiece& Q) {
  constexpr double kOverlap = 1e-3;  // m
  for (std::size_t f = 0; f < P.normals.size(); ++f) {
    const Point& from = P.corners[P.shape->faces[f][0]];
    double height = Q.shape->IsBall() ? P.normals[f].dot(Q.center - from) - Q.shape->radius
                                      : std::numeric_limits<double>::infinity();
    for (const auto& corner : Q.corners) height = std::min(height, P.normals[f].dot(corner - from));
    const double looks = P.normals[f].dot(kToward);
    if (height > -kOverlap && std::abs(looks) > 1e-9) return looks > 0 ? 1 : -1;
  }
  return 0;
}

// Whether P is to be drawn before Q.
bool IsBehind(const ConvexPiece& P, const ConvexPiece& Q) {
  for (int i = 0; i < 2; ++i) {
    if (P.low[i] > Q.high[i] || Q.low[i] > P.high[i]) return false;
  }
  int front = InFront(P, Q);
  if (front == 0) front = -InFront(Q, P);
  if (front == 0) return P.center.dot(kToward) < Q.center.dot(kToward);
  return front > 0;
}

std::vector<ConvexPiece> FromBackToFront(const SceneInSpace<double>& scene) {
  std::vector<ConvexPiece> left;
  for (const auto& body : scene.bodies) {
    for (const auto& shape : body.shapes) left.push_back(PieceOf(body, shape));
  }
  std::stable_sort(left.begin(), left.end(), [](const ConvexPiece& P, const ConvexPiece& Q) {
    return P.center.dot(kToward) < Q.center.dot(kToward);
  });
  std::vector<ConvexPiece> sorted;
  while (!left.empty()) {
    // The deepest with none behind it; where pieces are behind each other in a circle, the deepest.
    auto next = std::find_if(left.begin(), left.end(), [&left](const ConvexPiece& Q) {
      return std::none_of(left.begin(), left.end(),
                          [&Q](const ConvexPiece& P) { return &P != &Q && IsBehind(P, Q) && !IsBehind(Q, P); });
    });
    if (next == left.end()) next = left.begin();
    sorted.push_back(*next);
    left.erase(next);
  }
  return sorted;
}

// ---- Drawing ---------------------------------------------------------------------------------

std::string Shade(const ConvexPiece& piece, const Point& normal) {
  constexpr std::array<std::array<int, 3>, 4> kColours = {
      {{232, 154, 60}, {154, 111, 176}, {106, 168, 79}, {79, 129, 189}}};
  const int count = static_cast<int>(kColours.size());
  const std::array<int, 3> colour =
      piece.fixed ? std::array<int, 3>{190, 190, 190}
                  : kColours[static_cast<std::size_t>(((piece.level % count) + count) % count)];
  const double light = 0.55 + 0.45 * std::max(0.0, normal.dot(kLight));
  std::string text = "#";
  for (const int part : colour) text += fmt::format("{:02x}", static_cast<int>(light * part));
  return text;
}

std::string Path(const Screen& screen, const std::vector<Point>& points) {
  std::string text;
  for (const auto& p : points) {
    const Vector2<double> at = Seen(p);
    text += fmt::format("{}{:.1f},{:.1f}", text.empty() ? "M" : " ", screen.X(at[0]), screen.Y(at[1]));
  }
  return text;
}

// The line through p along d, `pixels` to both sides in the picture.
std::string LineAlong(const Screen& screen, const Point& p, const Point& d, double pixels, const char* style) {
  const double seen = Seen(d).norm();
  if (seen < 1e-6) return "";
  const Point half = pixels / (screen.scale * seen) * d;
  return fmt::format("<path d=\"{}\" stroke=\"black\" {}/>", Path(screen, {p - half, p + half}), style);
}

// A line from the centre of a to its point; a bar along the axis of a hinge, a broken line along a rail; on the
// point a white circle, of a slider a square.
std::string Drawn(const Screen& screen, const SceneInSpace<double>& scene, const JointInSpace<double>& joint) {
  const BodyInSpace<double>&a = scene.bodies[joint.a], &b = scene.bodies[joint.b];
  const Point p = a.At(joint.at_a), along = RotationMatrix<double>(b.rotation) * joint.direction;
  std::string text = fmt::format("<path d=\"{}\" stroke=\"black\"/>", Path(screen, {a.position, p}));
  if (joint.kind == JointKindInSpace::kHinge)
    text += LineAlong(screen, p, along, 16, "stroke-width=\"3\"");
  else if (joint.kind != JointKindInSpace::kBall)
    text += LineAlong(screen, b.At(joint.at_b), along, 2 * kWidth, "stroke-dasharray=\"6 4\"");
  const Vector2<double> at = Seen(p);
  return text + fmt::format(
                    "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"8\" height=\"8\" rx=\"{}\" fill=\"white\" "
                    "stroke=\"black\"/>",
                    screen.X(at[0]) - 4, screen.Y(at[1]) - 4, joint.kind == JointKindInSpace::kSlider ? 0 : 4);
}

// The visible half of a ball's circle across one of its axes.
std::string Equator(const Screen& screen, const ConvexPiece& ball, int axis) {
  const Point normal = ball.turn.col(axis);
  Point side = CrossProduct<double>(normal, kToward);
  if (side.norm() < 1e-6) return "";
  side.normalize();
  const Point front = CrossProduct<double>(side, normal);
  const double sign = front.dot(kToward) < 0 ? -1 : 1;
  std::vector<Point> points;
  for (int i = 0; i <= 16; ++i) {
    const double angle = std::numbers::pi * i / 16;
    points.push_back(ball.center +
                     ball.shape->radius * (std::cos(angle) * side + sign * std::sin(angle) * front));
  }
  return fmt::format("<path d=\"{}\" fill=\"none\"/>", Path(screen, points));
}

std::string Drawn(const Screen& screen, const ConvexPiece& piece) {
  std::string text;
  if (piece.shape->IsBall()) {
    const Vector2<double> at = Seen(piece.center);
    text = fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.4g}\" fill=\"{}\"/>", screen.X(at[0]),
                       screen.Y(at[1]), screen.scale * piece.shape->radius, Shade(piece, kLight));
    for (int axis = 0; axis < 3; ++axis) text += Equator(screen, piece, axis);
    return text;
  }
  for (std::size_t f = 0; f < piece.normals.size(); ++f) {
    if (piece.normals[f].dot(kToward) <= 0) continue;
    std::vector<Point> loop;
    for (const int i : piece.shape->faces[f]) loop.push_back(piece.corners[i]);
    text += fmt::format("<path d=\"{}z\" fill=\"{}\"/>", Path(screen, loop), Shade(piece, piece.normals[f]));
  }
  return text;
}

std::string Dot(const Screen& screen, const Point& p, const char* fill, int radius) {
  const Vector2<double> at = Seen(p);
  return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\" stroke=\"black\"/>",
                     screen.X(at[0]), screen.Y(at[1]), radius, fill);
}

std::string Picture(const SceneInSpace<double>& scene, const Screen& screen, const MarksInSpace& marks,
                    double newton) {
  std::string text = "<g stroke='black' stroke-width='0.7' stroke-linejoin='round'>";
  for (const auto& piece : FromBackToFront(scene)) text += Drawn(screen, piece);
  text += "</g>";
  for (const auto& joint : scene.joints) text += Drawn(screen, scene, joint);
  for (const auto& point : marks.contacts) text += Dot(screen, point, "#30c030", 3);
  for (const auto& force : marks.forces) {
    if (force.force.norm() == 0 || force.from_joint) continue;
    text += Line(ArrowOf(screen, Seen(force.point), Seen(newton * ShownForce(scene, force))));
  }
  std::replace(text.begin(), text.end(), '"', '\'');
  return text;
}

constexpr const char* kShow = R"js(
const picture = document.getElementById('picture');
function show(k) {
  picture.innerHTML = frames[k][1];
  slider.value = k;
  label.textContent = `t = ${frames[k][0].toFixed(3)} s`;
}
)js";

}  // namespace

void ViewInSpace::Include(const SceneInSpace<double>& scene) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (!(right > left)) left = bottom = kInfinite, right = top = -kInfinite;
  for (const bool fixed : {false, true}) {
    if (fixed && right > left) break;  // a ground may be large
    for (const auto& body : scene.bodies) {
      const bool driven = !body.spin.isZero(0) || !body.velocity.isZero(0) || !body.acceleration.isZero(0);
      if ((body.fixed && !driven) != fixed) continue;
      const auto include = [this](const Vector2<double>& low, const Vector2<double>& high) {
        left = std::min(left, low[0]), right = std::max(right, high[0]);
        bottom = std::min(bottom, low[1]), top = std::max(top, high[1]);
      };
      const Vector2<double> at = Seen(body.position), small(0.01, 0.01);
      include(at - small, at + small);
      for (const auto& shape : body.shapes) {
        const ConvexPiece piece = PieceOf(body, shape);
        include(piece.low, piece.high);
      }
    }
  }
  for (const auto& joint : scene.joints) {
    const Vector2<double> at = Seen(scene.bodies[joint.b].At(joint.at_b));
    left = std::min(left, at[0]), right = std::max(right, at[0]);
    bottom = std::min(bottom, at[1]), top = std::max(top, at[1]);
  }
}

MarksInSpace MarksOf(const SimulationInSpace& simulation) {
  MarksInSpace marks;
  for (const auto& contact : simulation.contacts()) marks.contacts.push_back(contact.point);
  marks.forces = simulation.forces();
  return marks;
}

RecordedFrameInSpace RecordFrame(const SceneInSpace<double>& scene, double time, MarksInSpace marks) {
  RecordedFrameInSpace frame;
  frame.time = time;
  for (const auto& body : scene.bodies) frame.bodies.push_back({body.position, body.rotation});
  frame.marks = std::move(marks);
  return frame;
}

void SetPoses(SceneInSpace<double>& scene, const RecordedFrameInSpace& frame) {
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    scene.bodies[i].position = frame.bodies[i].position;
    scene.bodies[i].rotation = frame.bodies[i].rotation;
  }
}

std::string DrawSvg(const SceneInSpace<double>& scene, const ViewInSpace& view, const MarksInSpace& marks,
                    double newton) {
  const Screen screen(view);
  return Head(screen) + Picture(scene, screen, marks, newton) + "\n</svg>\n";
}

std::string DrawAnimation(const SceneInSpace<double>& scene, const ViewInSpace& view,
                          const std::vector<RecordedFrameInSpace>& frames, double newton, double rate) {
  const Screen screen(view);
  SceneInSpace<double> moved = scene;
  std::string data;
  for (const auto& frame : frames) {
    SetPoses(moved, frame);
    const Json picture = Picture(moved, screen, frame.marks, newton);
    data += fmt::format("[{:.9g},{}],\n", frame.time, JsonText(picture));
  }
  return PageHead(scene.name) + Head(screen) + "<g id=\"picture\"></g>\n</svg>\n" + PageTail(data, rate, kShow);
}

}  // namespace stiction
