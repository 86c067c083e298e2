// SPDX-License-Identifier: Apache-2.0
// Bodies in space, seen from one direction, without perspective.
//
// Faces that look away are left out; convex pieces are drawn from the back to the front. Of two pieces that a
// face's plane parts, the one on the viewer's side is in front.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "reports/pictures/draw_bodies.h"
#include "scene/simulate.h"

namespace stiction {
namespace {

using Point = Vector3<double>;

// ---- The eye ---------------------------------------------------------------------------------

const Point kToward = Point(0.42, -0.78, 0.46).normalized();  // from the scene to the eye
const Point kRight = Point(-kToward[1], kToward[0], 0).normalized();
const Point kUp = CrossProduct<double>(kToward, kRight);
const Point kLight = Point(-0.3, -0.5, 0.8).normalized();

}  // namespace

Vector2<double> Seen(const Point& p) { return {kRight.dot(p), kUp.dot(p)}; }

namespace {

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
  piece.low = Seen(shape.IsRound() ? piece.center : piece.corners[0]) - radius;
  piece.high = piece.low + 2 * radius;
  if (!shape.IsRound()) piece.center.setZero();
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
    double height = Q.shape->IsRound() ? P.normals[f].dot(Q.center - from) - Q.shape->radius
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
  constexpr std::array<int, 3> kFixed = {190, 190, 190};
  const double light = 0.55 + 0.45 * std::max(0.0, normal.dot(kLight));
  std::string text = "#";
  for (const int part : piece.fixed ? kFixed : ColourOfLevel(kColours, piece.level))
    text += fmt::format("{:02x}", static_cast<int>(light * part));
  return text;
}

std::string Path(const Screen& screen, const std::vector<Point>& points) {
  std::string text;
  for (const auto& p : points) {
    const Vector2<double> at = Seen(p);
    text += (text.empty() ? "M" : " ") + Fixed(screen.X(at)) + "," + Fixed(screen.Y(at));
  }
  return text;
}

// The line through p along d, `pixels` to both sides in the picture.
Html LineAlong(const Screen& screen, const Point& p, const Point& d, double pixels, const Attribute& style) {
  const double seen = Seen(d).norm();
  if (seen < 1e-6) return {};
  const Point half = pixels / (screen.scale * seen) * d;
  return Tag("path", {{"d", Path(screen, {p - half, p + half})}, {"stroke", "black"}, style})("");
}

// A line from the centre of a to its point; a bar along the axis of a hinge, a broken line along a rail; on the
// point a white circle, of a slider a square.
Html Drawn(const Screen& screen, const SceneInSpace<double>& scene, const JointInSpace<double>& joint) {
  using enum JointKindInSpace;
  const BodyInSpace<double>&a = scene.bodies[joint.a], &b = scene.bodies[joint.b];
  const Point p = a.At(joint.at_a), along = RotationMatrix<double>(b.rotation) * joint.direction;
  Html html = Tag("path", {{"d", Path(screen, {a.position, p})}, {"stroke", "black"}})("");
  if (joint.kind == kHinge) html += LineAlong(screen, p, along, 16, {"stroke-width", "3"});
  if (joint.kind == kRail || joint.kind == kSlider)
    html += LineAlong(screen, b.At(joint.at_b), along, 2 * kPageWidth, {"stroke-dasharray", "6 4"});
  const Vector2<double> at = Seen(p);
  return html + Tag("rect", {{"x", Fixed(screen.X(at) - 4)},
                             {"y", Fixed(screen.Y(at) - 4)},
                             {"width", "8"},
                             {"height", "8"},
                             {"rx", joint.kind == kSlider ? "0" : "4"},
                             {"fill", "white"},
                             {"stroke", "black"}})("");
}

// The visible half of a ball's circle across one of its axes.
Html Equator(const Screen& screen, const ConvexPiece& ball, int axis) {
  const Point normal = ball.turn.col(axis);
  Point side = CrossProduct<double>(normal, kToward);
  if (side.norm() < 1e-6) return {};
  side.normalize();
  const Point front = CrossProduct<double>(side, normal);
  const double sign = front.dot(kToward) < 0 ? -1 : 1;
  std::vector<Point> points;
  for (int i = 0; i <= 16; ++i) {
    const double angle = std::numbers::pi * i / 16;
    points.push_back(ball.center +
                     ball.shape->radius * (std::cos(angle) * side + sign * std::sin(angle) * front));
  }
  return Tag("path", {{"d", Path(screen, points)}, {"fill", "none"}})("");
}

Html DrawnBall(const Screen& screen, const ConvexPiece& ball) {
  const Vector2<double> at = Seen(ball.center);
  Html html = Tag("circle", {{"cx", Fixed(screen.X(at))},
                             {"cy", Fixed(screen.Y(at))},
                             {"r", Significant(screen.scale * ball.shape->radius, 4)},
                             {"fill", Shade(ball, kLight)}})("");
  for (int axis = 0; axis < 3; ++axis) html += Equator(screen, ball, axis);
  return html;
}

Html DrawnPolyhedron(const Screen& screen, const ConvexPiece& piece) {
  Html html;
  for (std::size_t f = 0; f < piece.normals.size(); ++f) {
    if (piece.normals[f].dot(kToward) <= 0) continue;
    std::vector<Point> loop;
    for (const int i : piece.shape->faces[f]) loop.push_back(piece.corners[i]);
    html += Tag("path", {{"d", Path(screen, loop) + "z"}, {"fill", Shade(piece, piece.normals[f])}})("");
  }
  return html;
}

}  // namespace

std::vector<Html> BodyPictures(const SceneInSpace<double>&, const Screen&) { return {}; }

std::vector<std::string> Transforms(const SceneInSpace<double>&, const Screen&) { return {}; }

Html Placed(const SceneInSpace<double>& scene, const Screen& screen) {
  Html bodies;
  for (const auto& piece : FromBackToFront(scene)) {
    const Html drawn = piece.shape->IsRound() ? DrawnBall(screen, piece) : DrawnPolyhedron(screen, piece);
    bodies += piece.fixed ? Tag("g", {{"class", "fixed"}})(drawn) : drawn;  // pages darken it in the dark
  }
  Html html = Tag("g", {{"stroke", "black"}, {"stroke-width", "0.7"}, {"stroke-linejoin", "round"}})(bodies);
  for (const auto& joint : scene.joints) html += Drawn(screen, scene, joint);
  return html;
}

}  // namespace stiction
