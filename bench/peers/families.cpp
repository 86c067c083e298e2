// SPDX-License-Identifier: Apache-2.0
#include "bench/peers/families.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "bench/structure.h"
#include "corpus/record/scene_file.h"
#include "scene/simulate.h"
#include "search/generators/generators.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

using Problem = ContactProblem<double>;
using Problems = std::vector<Problem>;

// make(choices) returns a problem; `stream` keeps apart what kinds of families draw.
template <class Make>
StructuredFamily Drawn(const std::string& name, const std::string& title, int dimension, bool friction,
                       int problems, int stream, Make make) {
  return {name, title, dimension, friction, problems, [=](int count, std::uint64_t seed) {
            Problems made;
            for (int k = 0; k < count; ++k) {
              Choices choices(ProblemSeed(seed, stream, k));
              made.push_back(make(choices));
            }
            return made;
          }};
}

// ---- Buildings -----------------------------------------------------------------------------------

template <class Make>
StructuredFamily BuildingFamily(const std::string& name, std::string title, const Building& building,
                                Make make) {
  constexpr int kProblems = 100;  // at most
  if (building.dimension == 3) title += " in space";
  if (building.decades > 0) title += fmt::format(", masses 1 to 10^{}", building.decades);
  if (!building.friction) title += ", frictionless";
  const std::string whole =
      fmt::format("{}{}{}{}", building.dimension == 3 ? "space-" : "", name,
                  building.decades > 0 ? "-masses" : "", building.friction ? "" : "-smooth");
  return Drawn(whole, title, building.dimension, building.friction, kProblems, 1, make);
}

StructuredFamily Stack(int boxes, const Building& building) {
  return BuildingFamily(fmt::format("stack-{}", boxes), fmt::format("stack of {} boxes", boxes), building,
                        [=](Choices& choices) { return StackProblem(boxes, building, choices); });
}

StructuredFamily Wall(int courses, int bricks, const Building& building) {
  return BuildingFamily(fmt::format("wall-{}x{}", courses, bricks),
                        fmt::format("wall of {} courses, {} bricks wide", courses, bricks), building,
                        [=](Choices& choices) { return WallProblem(courses, bricks, building, choices); });
}

StructuredFamily Channel(int discs, const Building& building) {
  return BuildingFamily(fmt::format("channel-{}", discs), fmt::format("{} discs in a channel", discs), building,
                        [=](Choices& choices) { return ChannelProblem(discs, building, choices); });
}

// ---- Scenes of the corpus, as a simulation meets them ---------------------------------------------

constexpr int kSceneProblems = 100;  // and frames, at most

bool IsAllOf(const Problem& problem, ContactKind kind) {
  return std::all_of(problem.contacts.begin(), problem.contacts.end(),
                     [kind](const auto& contact) { return contact.kind == kind; });
}

ContactKind KindOf(bool friction) { return friction ? ContactKind::kStatic : ContactKind::kFrictionless; }

// Forces of the first frames, all islands: those of the most rows, until there are `count`. On one thread.
template <class Kind>
Problems FirstProblems(const SceneFileIn<Kind>& file, bool friction, std::size_t count) {
  Problems met;
  std::size_t rows = 1;
  SimulationIn<Kind> simulation(Round(file.scene), ToDouble(file.step), 0, [&](const FrameProblemIn<Kind>& of) {
    const std::size_t size = of.f.size();
    if (of.level != Level::kForces || size < rows) return;
    Problem problem = of.model.Problem(of.island);
    if (!IsAllOf(problem, KindOf(friction))) return;
    if (size > rows) met.clear();
    rows = size;
    met.push_back(std::move(problem));
  });
  tbb::task_arena one_thread(1);
  one_thread.execute([&] {
    for (int frame = 0; frame < kSceneProblems && met.size() < count; ++frame) simulation.Step();
  });
  met.resize(std::min(met.size(), count));
  return met;
}

StructuredFamily SceneFamily(const std::filesystem::path& scenes, const std::string& name, int dimension,
                             bool friction) {
  return {name,
          fmt::format("the first frames of {}.json", name),
          dimension,
          friction,
          kSceneProblems,
          [=](int count, std::uint64_t) {
            const auto file = ReadAnyScene(scenes / (name + ".json"));
            Problems met = std::visit([&](const auto& of) { return FirstProblems(of, friction, count); }, file);
            STICTION_CHECK(!met.empty(), "a scene of the comparison has contacts of one kind");
            return met;
          }};
}

// ---- Without bodies ------------------------------------------------------------------------------

StructuredFamily GeneratedFamily(GeneratorId id, int contacts) {
  const std::string name(Row(id).name);
  return Drawn("generator-" + name, fmt::format("generator {}, {} contacts", name, contacts), 2, true, 200, 2,
               [=](Choices& choices) {
                 Problem problem;
                 Generate(id, contacts, kDefaultPalette, choices, problem);
                 return problem;
               });
}

double DrawUniform(Choices& choices) { return static_cast<double>(choices.Integer(-1000000, 1000000)) * 1e-6; }

// J of two rows a contact and as many columns, uniform in [-1, 1]; the second half of the rows are those of the
// first half and 1e-9 of other ones. A = J J', b = J y.
Problem NearlyDependent(int contacts, Choices& choices) {
  Eigen::MatrixXd J(2 * contacts, 2 * contacts);
  for (double& x : J.reshaped()) x = DrawUniform(choices);
  J.bottomRows(contacts) = J.topRows(contacts) + 1e-9 * J.bottomRows(contacts);
  Eigen::VectorXd y(2 * contacts);
  for (double& x : y) x = DrawUniform(choices);
  Problem problem;
  problem.A = J * J.transpose();
  problem.b = J * y;
  for (int i = 0; i < contacts; ++i)
    problem.contacts.push_back({ContactKind::kStatic, 0.55 + 0.45 * DrawUniform(choices), {}});
  return problem;
}

StructuredFamily NearlyDependentFamily(int contacts) {
  return Drawn("nearly-dependent", fmt::format("{} contacts, half of them the others but for 1e-9", contacts),
               2, true, 200, 3, [=](Choices& choices) { return NearlyDependent(contacts, choices); });
}

}  // namespace

std::vector<StructuredFamily> StructuredFamilies(const std::filesystem::path& scenes) {
  const Building plain, heavy = {2, true, 4}, smooth = {2, false, 4}, space = {3, true, 0},
                        heavy_space = {3, true, 4};
  const Building very_heavy = {2, true, 8};
  const auto scene = [&](const char* name, int dimension, bool friction) {
    return SceneFamily(scenes, name, dimension, friction);
  };
  return {Stack(10, plain),
          Stack(10, heavy),
          Stack(30, heavy),
          Wall(6, 5, plain),
          Wall(6, 5, heavy),
          Channel(20, very_heavy),
          NearlyDependentFamily(8),
          GeneratedFamily(GeneratorId::kScenes, 8),
          GeneratedFamily(GeneratorId::kNearDegenerate, 8),
          scene("stack", 2, true),
          scene("many-stacks", 2, true),
          scene("card-house", 2, true),
          scene("arch-stands", 2, true),
          scene("large/brick-wall", 2, true),
          Stack(10, smooth),
          Stack(30, smooth),
          Wall(6, 5, smooth),
          scene("two-towers", 2, false),
          Stack(5, space),
          Stack(10, heavy_space),
          Wall(4, 3, heavy_space),
          scene("space/stack", 3, true),
          scene("large/brick-wall-in-space", 3, true)};
}

}  // namespace stiction
