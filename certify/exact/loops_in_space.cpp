// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/loops_in_space.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "certify/exact/fine_interval.h"
#include "corpus/rounded.h"
#include "solver/published/published_space.ipp"

namespace stiction {
namespace {

using FineRun = PublishedInSpace<FineInterval>;
using StateInSpace = FineRun::Standing;
using Coordinates = std::vector<FineInterval>;
using Steps = std::vector<std::string>;

// The run has ended: there is no loop, or none of these steps.
struct RunEnded {
  std::string how;
};

// ---- Runs, turn by turn ------------------------------------------------------------------------

// What a state remembers beyond its sets: the force of a row, or for row -1 the direction of a contact.
struct Remembered {
  int contact, row;
  bool operator==(const Remembered&) const = default;
};

class Memory {
 public:
  explicit Memory(const ExactProblem& problem) { layout_.Assign(problem.contacts, 3); }

  std::vector<Remembered> Of(const StateInSpace& state) const {
    std::vector<Remembered> found;
    for (int contact = 0; contact < layout_.ContactCount(); ++contact) {
      const int row = layout_.NormalRowOf(contact);
      const auto moves = [&](int at) { return !IsSurelyZero(state.f[at]); };
      if (state.sets[row] == IndexSet::kNone && moves(row)) found.push_back({contact, row});
      if (!layout_.HasFriction(row)) continue;
      if (state.sets[row + 1] == IndexSet::kAtUpper) found.push_back({contact, -1});
      if (state.sets[row + 1] == IndexSet::kNone && (moves(row + 1) || moves(row + 2))) {
        found.push_back({contact, row + 1});
        found.push_back({contact, row + 2});
      }
    }
    return found;
  }

  bool Same(const StateInSpace& x, const StateInSpace& y) const {
    return x.sets == y.sets && x.turned_away == y.turned_away && x.last_driven == y.last_driven &&
           Of(x) == Of(y);
  }

  // Which half of the circle a direction is in, for every coordinate.
  std::vector<int> Charts(const StateInSpace& state) const {
    std::vector<int> charts;
    for (const Remembered& what : Of(state)) {
      const bool forward =
          what.row < 0 && Approximation<FineInterval>::Of(state.recorded[what.contact][0]) >= 0;
      charts.push_back(what.row >= 0 ? 0 : forward ? 1 : -1);
    }
    return charts;
  }

  Coordinates CoordinatesOf(const StateInSpace& state, const std::vector<int>& charts) const {
    const std::vector<Remembered> memory = Of(state);
    Coordinates x;
    for (std::size_t k = 0; k < memory.size(); ++k) {
      if (memory[k].row >= 0) {
        x.push_back(state.f[memory[k].row]);
        continue;
      }
      const auto& d = state.recorded[memory[k].contact];
      const FineInterval chart(charts[k]);
      x.push_back(chart * d[1] / (FineInterval(1) + chart * d[0]));
    }
    return x;
  }

  // The state with other coordinates.
  StateInSpace With(StateInSpace state, const Coordinates& x, const std::vector<int>& charts) const {
    const std::vector<Remembered> memory = Of(state);
    for (FineInterval& force : state.f) force = FineInterval();
    for (std::size_t k = 0; k < memory.size(); ++k) {
      if (memory[k].row >= 0) {
        state.f[memory[k].row] = x[k];
        continue;
      }
      const FineInterval square = x[k] * x[k], chart(charts[k]);
      const FineInterval over = chart / (FineInterval(1) + square);
      state.recorded[memory[k].contact] = {(FineInterval(1) - square) * over, (x[k] + x[k]) * over};
    }
    return state;
  }

  std::string StepText(const Pivot<FineInterval>& step) const {
    return fmt::format("{} {} {}", Variable(step.driven), Variable(step.limiting), SetOf(step, step.limiting));
  }

 private:
  std::string Variable(int row) const {
    return fmt::format("{}{}", layout_.IsNormal(row) ? "N" : "F", layout_.ContactOf(row) + 1);
  }
  std::string SetOf(const Pivot<FineInterval>& step, int row) const {
    if (layout_.IsNormal(row)) return Name(step.sets[row]);
    const int x = layout_.NormalRowOf(layout_.ContactOf(row)) + 1;
    if (step.sets[x] == IndexSet::kAtUpper) return "NCF";
    if (step.sets[x] != IndexSet::kSticking) return "none";
    return step.sets[x + 1] == IndexSet::kSticking ? "CF" : "half";
  }

  RowLayout<Eigen::Dynamic> layout_;
};

// A run over numbers of so many bits, from f = 0 or from a state.
class Walk {
 public:
  Walk(const ContactProblem<FineInterval>& problem, const Memory& memory, const Request& request)
      : memory_(memory), run_(request) {
    run_.Begin(problem, &trace_);
  }
  void StandAt(const StateInSpace& state) { run_.StandAt(state); }
  // From here on a contact turns away where it may: periods are told apart.
  void AssumeTurnings() { run_.AssumeTurnings(); }
  void BeginPeriod() { run_.BeginPeriod(); }
  const std::vector<FineRun::Turning>& turnings() const { return run_.turnings(); }

  StateInSpace state() const { return run_.standing(); }
  std::int64_t drives() const { return run_.verdict().statistics.drives; }
  const Steps& word() const { return word_; }
  // Of every step, which of the changes, forces and recorded directions are known to be zero.
  const std::vector<std::vector<bool>>& zeros() const { return zeros_; }

  void TakeTurn() {
    trace_.clear();
    const bool goes_on = run_.TakeTurn();
    for (const Pivot<FineInterval>& step : trace_) {
      word_.push_back(memory_.StepText(step));
      zeros_.push_back(ZerosOf(step));
    }
    if (run_.verdict().statistics.singular_directions > 0) Unsure<FineInterval>::Refuse();
    if (!goes_on) throw RunEnded{std::string(Name(run_.verdict().outcome))};
  }
  // To the first state of the main loop after so many drives; stops earlier after so many steps.
  void GoTo(std::int64_t drives, std::size_t steps) {
    while (this->drives() < drives && word_.size() <= steps) TakeTurn();
  }

 private:
  static std::vector<bool> ZerosOf(const Pivot<FineInterval>& step) {
    std::vector<bool> zeros;
    for (const auto* numbers : {&step.df, &step.da, &step.f})
      for (const FineInterval& x : *numbers) zeros.push_back(IsSurelyZero(x));
    for (const auto& d : step.recorded)
      for (const FineInterval& x : d) zeros.push_back(IsSurelyZero(x));
    return zeros;
  }

  const Memory& memory_;
  SpaceTrace<FineInterval> trace_;
  FineRun run_;
  Steps word_;
  std::vector<std::vector<bool>> zeros_;
};

Interval SlopeOf(const FineInterval& x, int k) {
  return static_cast<std::size_t>(k) < x.slopes().size() ? x.slopes()[k] : Interval(0);
}

// What the period makes of coordinates.
struct Image {
  Coordinates x;
  std::vector<bool> untouched;
  Steps word;
  std::vector<FineInterval> asides;  // of the contacts that turn away

  // Whether it is told of each turning that it is one.
  bool TellsTurnings() const { return std::ranges::all_of(asides, Unsure<FineInterval>::TellsSign); }
};

// A problem over numbers of so many bits. Its FineBits must live as long.
class FineProblem {
 public:
  FineProblem(const ExactProblem& problem, const Policy& policy, const Limits& limits)
      : memory_(problem),
        request_{.policy = policy, .limits = limits},
        problem_(Converted<FineInterval>(problem, [](const Rational& x) { return FineInterval::Around(x); })) {}

  const Memory& memory() const { return memory_; }
  Walk Begin() const { return {problem_, memory_, request_}; }

  // Over a period of so many drives, from the state with other coordinates. RunEnded where it comes to another
  // state.
  Image ImageOf(const StateInSpace& state, const Coordinates& x, const std::vector<int>& charts,
                std::int64_t period, std::size_t steps) const {
    Walk walk = BeginPeriod(state, x, charts);
    walk.GoTo(period, steps);
    const StateInSpace end = walk.state();
    if (walk.drives() != period || !memory_.Same(end, state)) throw RunEnded{"another state"};
    Image image = {memory_.CoordinatesOf(end, charts), {}, walk.word(), {}};
    for (const auto& turning : walk.turnings()) image.asides.push_back(turning.aside);
    const std::vector<Remembered> memory = memory_.Of(state);
    for (std::size_t k = 0; k < memory.size(); ++k) {
      const bool untouched =
          memory[k].row < 0 ? end.recorded_anew[memory[k].contact] == 0 : Same(image.x[k], x[k]);
      image.untouched.push_back(untouched);
    }
    return image;
  }

  // Of the contacts that turn away in a period: whether aF is zero there if all periods are alike. The third
  // period is the first of which all is named in the one before. `box`: all points at once, so that what is the
  // same there is so by the steps that the run takes, not by the numbers of one point; and every period finds
  // the same to be zero, so that names are given at the same places.
  std::vector<bool> TurningsThatEnd(const StateInSpace& state, const Coordinates& box,
                                    const std::vector<int>& charts, std::int64_t period,
                                    std::size_t steps) const {
    Walk walk = BeginPeriod(state, box, charts);
    std::size_t before = 0;
    for (int k = 1; k <= 3; ++k) {
      before = walk.turnings().size();
      if (k > 1) walk.BeginPeriod();
      walk.GoTo(k * period, k * steps);
      if (walk.word().size() != k * steps) throw RunEnded{"another period"};
    }
    const auto second = walk.zeros().begin() + static_cast<std::ptrdiff_t>(steps);
    const auto third = second + static_cast<std::ptrdiff_t>(steps);
    if (!std::equal(second, third, third, walk.zeros().end())) Unsure<FineInterval>::Refuse();
    std::vector<bool> ends;
    for (std::size_t k = before; k < walk.turnings().size(); ++k) ends.push_back(walk.turnings()[k].ends);
    return ends;
  }

 private:
  Walk BeginPeriod(const StateInSpace& state, const Coordinates& x, const std::vector<int>& charts) const {
    Walk walk = Begin();
    walk.AssumeTurnings();
    walk.StandAt(memory_.With(state, x, charts));
    walk.BeginPeriod();
    return walk;
  }

  // The same ends and derivatives.
  static bool Same(const FineInterval& x, const FineInterval& y) {
    bool same = x.ends().low == y.ends().low && x.ends().high == y.ends().high;
    for (int k = 0; k < static_cast<int>(std::max(x.slopes().size(), y.slopes().size())); ++k)
      same &= SlopeOf(x, k).is_same(SlopeOf(y, k));
    return same;
  }

  Memory memory_;
  Request request_;
  ContactProblem<FineInterval> problem_;
};

// ---- Boxes -------------------------------------------------------------------------------------

Coordinates Points(const ExactVector& centre) {
  Coordinates points;
  for (const Rational& x : centre) points.push_back(FineInterval::Around(x));
  return points;
}

Coordinates BoxAround(const ExactVector& centre, const ExactVector& radii) {
  Coordinates box;
  for (int k = 0; k < centre.size(); ++k) box.push_back(FineInterval::Side(k, centre[k], radii[k]));
  return box;
}

// Of the further end.
Rational DistanceTo(const FineInterval& x, const Rational& point) {
  return std::max(Rational(abs(x.Low() - point)), Rational(abs(x.High() - point)));
}

// Along the whole of a side.
Rational SteepestOf(const FineInterval& x, int k) { return Rational(SizeOf(SlopeOf(x, k))); }

// A coordinate that may leave the box, and how far from the centre it may come; empty if none does. `middle`:
// the image of the centre, or null, as if that stayed where it is.
std::optional<std::pair<int, Rational>> LeavesBox(const Image* middle, const Image& image,
                                                  const ExactVector& centre, const ExactVector& radii) {
  for (int i = 0; i < centre.size(); ++i) {
    if (image.untouched[i]) continue;
    Rational reach = middle == nullptr ? Rational(0) : DistanceTo(middle->x[i], centre[i]);
    for (int k = 0; k < centre.size(); ++k) reach += SteepestOf(image.x[i], k);
    if (reach > radii[i]) return std::pair(i, reach);
  }
  return std::nullopt;
}

bool IsInBox(const Coordinates& x, const ExactVector& centre, const ExactVector& radii) {
  for (int k = 0; k < centre.size(); ++k) {
    if (DistanceTo(x[k], centre[k]) > radii[k]) return false;
  }
  return true;
}

// Downwards to a multiple of 2^-places.
Rational OfPlaces(const Rational& x, int places) {
  const mpz_class scaled = x.get_num() << places;
  mpz_class floor;
  mpz_fdiv_q(floor.get_mpz_t(), scaled.get_mpz_t(), x.get_den_mpz_t());
  Rational result(floor, mpz_class(1) << places);
  result.canonicalize();
  return result;
}

// Whether every matrix of derivatives in the box is regular, by the coordinates that move.
bool IsInjective(const Image& image, const std::vector<int>& moving) {
  const int size = static_cast<int>(moving.size());
  Elimination<Interval> slopes;
  slopes.Resize(size, size);
  for (int i = 0; i < size; ++i) {
    for (int k = 0; k < size; ++k) slopes(i, k) = SlopeOf(image.x[moving[i]], moving[k]);
  }
  slopes.Run(size, size, size);
  return slopes.rank() == size;
}

std::vector<int> Moving(const Image& image) {
  std::vector<int> moving;
  for (std::size_t i = 0; i < image.x.size(); ++i) {
    if (!image.untouched[i]) moving.push_back(static_cast<int>(i));
  }
  return moving;
}

// Where a state could recur: `image` is what the period makes of the box.
std::optional<Rejected> FaultOfRecurrence(const FineProblem& problem, const StateInSpace& state,
                                          const RunInSpace& loop, const Image& image) {
  const std::vector<int> moving = Moving(image);
  for (const int i : moving) {
    Rational spread = 0;
    for (int k = 0; k < loop.radii.size(); ++k) spread += SteepestOf(image.x[i], k);
    if (spread >= loop.radii[i])
      return Rejected{fmt::format("radii[{}]", i), ToString(loop.radii[i]), "a period that contracts"};
  }
  if (!IsInjective(image, moving)) Unsure<FineInterval>::Refuse();
  const Coordinates first = problem.memory().CoordinatesOf(state, loop.charts);
  const Image then = problem.ImageOf(state, first, loop.charts, loop.period, image.word.size());
  const auto moves = [&](int i) {
    const FineEnds &x = first[i].ends(), &y = then.x[i].ends();
    return x.high < y.low || y.high < x.low;
  };
  if (std::ranges::any_of(moving, moves)) return std::nullopt;
  return Rejected{"start", std::to_string(loop.start), "a state that the period surely moves"};
}

// Where a contact could not turn away in a punctured box, but at its fixed point.
std::optional<Rejected> FaultOfTurnings(const FineProblem& problem, const StateInSpace& state,
                                        const RunInSpace& loop, const Image& image) {
  const std::vector<int> moving = Moving(image);
  if (moving.size() != 1)
    return Rejected{"radii", fmt::format("{} coordinates that move", moving.size()), "1 in a punctured box"};
  const std::vector<bool> ends = problem.TurningsThatEnd(state, BoxAround(loop.centre, loop.radii), loop.charts,
                                                         loop.period, image.word.size());
  if (ends.size() != image.asides.size()) Unsure<FineInterval>::Refuse();
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const FineInterval& aside = image.asides[k];
    if (Unsure<FineInterval>::TellsSign(aside)) continue;
    if (!ends[k] || Sign(SlopeOf(aside, moving[0])) == 0)
      return Rejected{"kind", "punctured", "contacts that turn away but at the fixed point"};
  }
  return FaultOfRecurrence(problem, state, loop, image);
}

// ---- Finding a proof ---------------------------------------------------------------------------

// What was tried: beyond these nothing is sought.
constexpr int kStatesTried = 4;
constexpr int kNewtonSteps = 60;
constexpr int kPlacesOfRadii[] = {10, 16, 22, 28, 34, 40, 48, 56, 64, 76, 90, 110, 140};
constexpr int kMoreBitsOfCentre = 20;
// What a proof states leaves room for a checker whose enclosures are wider: half as many bits more, and a box
// so many sizes smaller than the first that does.
constexpr int kSizesOfMargin = 2;

// Bits and turns of the main loop: intervals of a run lose some four bits at every turn.
struct Effort {
  int bits, turns;
};
constexpr Effort kEfforts[] = {{256, 50}, {768, 160}, {1536, 320}};
constexpr int kBitsForAll = 768;  // more only where there is a box

class LoopSearch {
 public:
  LoopSearch(const ExactProblem& problem, const Policy& policy, const Limits& limits, Effort effort)
      : effort_(effort), bits_(effort.bits), problem_(problem, policy, limits) {}

  std::optional<RunInSpace> Find() {
    Walk walk = problem_.Begin();
    if (auto states = FindStates(walk)) return states;
    word_ = walk.word();
    if (ended_) return std::nullopt;
    ForgetBlurred();
    const auto turns = FindPeriod();
    if (!turns) return std::nullopt;
    for (const Top* top : BestOfPeriod(*turns)) {
      const std::int64_t period = top->drives - (top - *turns)->drives;
      if (auto box = FindBox(*top, period)) return box;
    }
    return std::nullopt;
  }

  // Whether more bits could show more, and whether there is a box, though the run did not come into it.
  bool is_hopeless() const { return ended_ || (unsure_ && !blurred_); }
  bool contracts() const { return contracts_; }

 private:
  // A state of the main loop.
  struct Top {
    StateInSpace state;
    std::int64_t drives;
    std::size_t steps;
    std::size_t remembers;
  };

  // The run from f = 0, until it ends, is unsure, or repeats the sets of a state that remembers nothing.
  std::optional<RunInSpace> FindStates(Walk& walk) {
    try {
      while (static_cast<int>(tops_.size()) < effort_.turns) {
        Top top = {walk.state(), walk.drives(), walk.word().size(), 0};
        top.remembers = problem_.memory().Of(top.state).size();
        for (const Top& earlier : tops_) {
          if (top.remembers == 0 && problem_.memory().Same(earlier.state, top.state))
            return RunInSpace{
                bits_of_proof(), earlier.drives, top.drives - earlier.drives, walk.word(), {}, {}, {}};
        }
        tops_.push_back(std::move(top));
        walk.TakeTurn();
      }
    } catch (const UnsureComparison&) {
      unsure_ = true;
    } catch (const RunEnded&) {
      ended_ = true;
    }
    return std::nullopt;
  }

  // Leaves the states that are known to a third of the bits.
  void ForgetBlurred() {
    const mpz_class most = mpz_class(1) << 2 * effort_.bits / 3;
    const auto is_blurred = [&](const Top& top) {
      return std::any_of(top.state.f.begin(), top.state.f.end(),
                         [&](const FineInterval& x) { return x.ends().high - x.ends().low > most; });
    };
    const auto first = std::find_if(tops_.begin(), tops_.end(), is_blurred);
    blurred_ = first != tops_.end();
    tops_.erase(first, tops_.end());
  }

  static double Distance(const StateInSpace& x, const StateInSpace& y) {
    const auto apart = [](const FineInterval& u, const FineInterval& v) {
      return std::abs(Approximation<FineInterval>::Of(u - v));
    };
    double sum = 0;
    for (int row = 0; row < x.f.size(); ++row) sum += apart(x.f[row], y.f[row]);
    for (std::size_t contact = 0; contact < x.recorded.size(); ++contact) {
      if (x.recorded_anew[contact] > 0)
        sum += apart(x.recorded[contact][0], y.recorded[contact][0]) +
               apart(x.recorded[contact][1], y.recorded[contact][1]);
    }
    return sum;
  }

  // In turns of the main loop: the same sets three times, and ever nearer.
  std::optional<int> FindPeriod() const {
    const int last = static_cast<int>(tops_.size()) - 1;
    for (int turns = 1; 2 * turns <= last; ++turns) {
      const StateInSpace &now = tops_[last].state, &before = tops_[last - turns].state,
                         &first = tops_[last - 2 * turns].state;
      if (!problem_.memory().Same(now, before) || !problem_.memory().Same(now, first)) continue;
      const double moved = Distance(now, before);
      if (moved < 1e-7 || moved < 0.9 * Distance(before, first)) return turns;
    }
    return std::nullopt;
  }

  std::vector<const Top*> BestOfPeriod(int turns) const {
    std::vector<const Top*> best;
    for (auto top = tops_.end() - turns; top != tops_.end(); ++top) {
      if (top->remembers > 0) best.push_back(&*top);
    }
    std::ranges::stable_sort(best, {}, &Top::remembers);
    if (best.size() > kStatesTried) best.resize(kStatesTried);
    return best;
  }

  // The fixed point near a state, by Newton's method.
  ExactVector FindCentre(const Top& top, const std::vector<int>& charts, std::int64_t period) const {
    const int size = static_cast<int>(top.remembers);
    const Coordinates near = problem_.memory().CoordinatesOf(top.state, charts);
    ExactVector c(size);
    for (int k = 0; k < size; ++k) c[k] = near[k].Middle();
    for (int step = 0; step < kNewtonSteps; ++step) {
      Coordinates variables;
      for (int k = 0; k < size; ++k) variables.push_back(FineInterval::Variable(k, c[k]));
      const Image image = problem_.ImageOf(top.state, variables, charts, period, kMostSteps);
      Eigen::MatrixXd M = Eigen::MatrixXd::Identity(size, size);
      Eigen::VectorXd rest = Eigen::VectorXd::Zero(size);
      for (int i = 0; i < size; ++i) {
        if (image.untouched[i]) continue;
        rest[i] = ToDouble(Rational(image.x[i].Middle() - c[i]));
        for (std::size_t k = 0; k < image.x[i].slopes().size(); ++k)
          M(i, static_cast<int>(k)) -= Approximation<Interval>::Of(image.x[i].slopes()[k]);
      }
      const Eigen::VectorXd move = M.partialPivLu().solve(rest);
      if (!move.allFinite()) break;
      for (int k = 0; k < size; ++k) c[k] = OfPlaces(c[k] + Rational(move[k]), effort_.bits);
      if (move.cwiseAbs().maxCoeff() < std::ldexp(1, -effort_.bits / 2)) break;
    }
    return c;
  }

  // Boxes of all sizes, from large to small, of sides in proportion to the weights that the derivatives ask
  // for.
  std::optional<RunInSpace> FindBox(const Top& top, std::int64_t period) {
    const std::vector<int> charts = problem_.memory().Charts(top.state);
    ExactVector fixed;
    try {
      fixed = FindCentre(top, charts, period);
    } catch (const UnsureComparison&) {
      return std::nullopt;
    } catch (const RunEnded&) {
      return std::nullopt;
    }
    int smaller = -1;  // sizes that do, after the first
    for (const int places : kPlacesOfRadii) {
      if (2 * places > effort_.bits) break;
      try {
        auto box = FindBoxOfSize(top, charts, period, fixed, places);
        smaller += box.has_value();
        if (box && smaller == kSizesOfMargin) return box;
      } catch (const UnsureComparison&) {  // a smaller one may do
      } catch (const RunEnded&) {
      }
    }
    return std::nullopt;
  }

  std::optional<RunInSpace> FindBoxOfSize(const Top& top, const std::vector<int>& charts, std::int64_t period,
                                          const ExactVector& fixed, int places) {
    const int size = static_cast<int>(fixed.size());
    const ExactVector centre =
        fixed.unaryExpr([&](const Rational& x) { return OfPlaces(x, places + kMoreBitsOfCentre); });
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(size);
    for (int attempt = 0; attempt < 3; ++attempt) {
      ExactVector radii(size);
      for (int k = 0; k < size; ++k)
        radii[k] = OfPlaces(Rational(weights[k]) / (mpz_class(1) << places), places + kMoreBitsOfCentre);
      const Image image = problem_.ImageOf(top.state, BoxAround(centre, radii), charts, period, kMostSteps);
      const auto stays = [&] {
        if (LeavesBox(nullptr, image, centre, radii)) return false;
        const Image middle = problem_.ImageOf(top.state, Points(centre), charts, period, kMostSteps);
        return !LeavesBox(&middle, image, centre, radii);
      };
      if (stays()) {
        contracts_ = true;
        return Entered(top, charts, period, centre, radii, image);
      }
      Eigen::MatrixXd steepest(size, size);
      for (int i = 0; i < size; ++i) {
        for (int k = 0; k < size; ++k)
          steepest(i, k) = image.untouched[i] ? 0 : ToDouble(Rational(SteepestOf(image.x[i], k) / radii[k]));
      }
      weights.setOnes();
      for (int k = 0; k < 100; ++k) weights = Eigen::VectorXd::Ones(size) + steepest * weights;
      if (!(weights.maxCoeff() < 1e6)) return std::nullopt;  // the period does not contract
      weights = (weights / weights.maxCoeff()).cwiseMax(1e-6);
    }
    return std::nullopt;
  }

  // From the first state of the run that is in the box.
  std::optional<RunInSpace> Entered(const Top& like, const std::vector<int>& charts, std::int64_t period,
                                    const ExactVector& centre, const ExactVector& radii,
                                    const Image& image) const {
    for (const Top& top : tops_) {
      if (!problem_.memory().Same(top.state, like.state)) continue;
      if (!IsInBox(problem_.memory().CoordinatesOf(top.state, charts), centre, radii)) continue;
      RunInSpace loop = {bits_of_proof(), top.drives, period, {}, charts, centre, radii};
      loop.punctured = !image.TellsTurnings();
      if (loop.punctured && FaultOfTurnings(problem_, top.state, loop, image)) return std::nullopt;
      loop.word.assign(word_.begin(), word_.begin() + static_cast<std::ptrdiff_t>(top.steps));
      loop.word.insert(loop.word.end(), image.word.begin(), image.word.end());
      return loop;
    }
    return std::nullopt;
  }

  int bits_of_proof() const { return effort_.bits / 2 * 3; }

  static constexpr std::size_t kMostSteps = 10000;  // of a period

  Effort effort_;
  FineBits bits_;
  FineProblem problem_;
  std::vector<Top> tops_;
  Steps word_;
  bool ended_ = false, unsure_ = false, blurred_ = false, contracts_ = false;
};

// ---- Checking a proof --------------------------------------------------------------------------

Rejected OtherStep(const Steps& stated, const Steps& taken, std::size_t first) {
  for (std::size_t k = 0; k < taken.size(); ++k) {
    if (first + k >= stated.size())
      return {"word", fmt::format("{} steps", stated.size()), "more: it does not end there"};
    if (stated[first + k] != taken[k]) return {fmt::format("word[{}]", first + k), stated[first + k], taken[k]};
  }
  return {"word", fmt::format("{} steps", stated.size()), fmt::format("{}", first + taken.size())};
}

bool Stands(const Steps& stated, const Steps& taken, std::size_t first) {
  return stated.size() == first + taken.size() &&
         std::equal(taken.begin(), taken.end(), stated.begin() + static_cast<std::ptrdiff_t>(first));
}

std::optional<Rejected> FaultOfStates(const FineProblem& problem, Walk& walk, const RunInSpace& loop) {
  const StateInSpace state = walk.state();
  if (!problem.memory().Of(state).empty())
    return Rejected{"start", std::to_string(loop.start), "a state that remembers nothing but its sets"};
  problem.Begin().StandAt(problem.memory().With(state, {}, {}));  // whose matrix is regular
  walk.GoTo(loop.start + loop.period, loop.word.size());
  if (!Stands(loop.word, walk.word(), 0)) return OtherStep(loop.word, walk.word(), 0);
  if (!problem.memory().Same(walk.state(), state) || walk.drives() != loop.start + loop.period)
    return Rejected{"period", std::to_string(loop.period), "drives to the same sets"};
  return std::nullopt;
}

std::optional<Rejected> FaultOfPlace(const FineProblem& problem, const StateInSpace& state,
                                     const RunInSpace& loop) {
  const std::vector<Remembered> memory = problem.memory().Of(state);
  const auto has = [&](auto count) { return static_cast<std::size_t>(count) == memory.size(); };
  if (!has(loop.charts.size()) || !has(loop.centre.size()) || !has(loop.radii.size()))
    return Rejected{"radii", fmt::format("{} coordinates", loop.radii.size()), std::to_string(memory.size())};
  for (std::size_t k = 0; k < memory.size(); ++k) {
    const int chart = loop.charts[k];
    if (chart < -1 || chart > 1 || (chart == 0) != (memory[k].row >= 0))
      return Rejected{fmt::format("charts[{}]", k), std::to_string(chart),
                      "1 or -1 of a direction, 0 of a force"};
    if (loop.radii[static_cast<int>(k)] <= 0)
      return Rejected{fmt::format("radii[{}]", k), ToString(loop.radii[static_cast<int>(k)]), "a number > 0"};
  }
  if (!IsInBox(problem.memory().CoordinatesOf(state, loop.charts), loop.centre, loop.radii))
    return Rejected{"centre", ToString(loop.centre[0]), "a box in which the state at start is"};
  return std::nullopt;
}

std::optional<Rejected> FaultOfBox(const FineProblem& problem, const Walk& walk, const RunInSpace& loop) {
  const StateInSpace state = walk.state();
  if (auto fault = FaultOfPlace(problem, state, loop)) return fault;
  const std::size_t before = walk.word().size(), steps = loop.word.size() - before;
  const Image middle = problem.ImageOf(state, Points(loop.centre), loop.charts, loop.period, steps);
  const Image image =
      problem.ImageOf(state, BoxAround(loop.centre, loop.radii), loop.charts, loop.period, steps);
  for (const Image& of : {middle, image}) {
    if (!Stands(loop.word, of.word, before)) return OtherStep(loop.word, of.word, before);
  }
  if (const auto leaves = LeavesBox(&middle, image, loop.centre, loop.radii))
    return Rejected{fmt::format("radii[{}]", leaves->first), ToString(loop.radii[leaves->first]),
                    fmt::format("{:.3g}, as far as the period leads", ToDouble(leaves->second))};
  if (loop.punctured) return FaultOfTurnings(problem, state, loop, image);
  if (!image.TellsTurnings()) Unsure<FineInterval>::Refuse();
  return loop.endless ? FaultOfRecurrence(problem, state, loop, image) : std::nullopt;
}

// Fixed places take a number that is large beside 2^bits for one that is hardly known.
std::optional<Rejected> FaultOfNumbers(const ExactProblem& problem, int bits) {
  const Rational most(mpz_class(mpz_class(1) << bits / 4));
  const auto is_large = [&most](const Rational& x) { return abs(x) >= most; };
  bool large = std::any_of(problem.A.data(), problem.A.data() + problem.A.size(), is_large) ||
               std::any_of(problem.b.data(), problem.b.data() + problem.b.size(), is_large);
  for (const Contact<Rational>& contact : problem.contacts) large |= is_large(contact.mu);
  if (!large) return std::nullopt;
  return Rejected{"bits", std::to_string(bits), "more: numbers of A, b and mu are below 2^(bits / 4)"};
}

}  // namespace

std::optional<Rejected> FindLoopFault(const ExactProblem& problem, const Policy& policy,
                                      const RunInSpace& loop) {
  if (loop.endless && !loop.IsBox()) return Rejected{"kind", "states", "box"};
  if (auto fault = FaultOfNumbers(problem, loop.bits)) return fault;
  const FineBits bits(loop.bits);
  const FineProblem fine(problem, policy, {});
  Walk walk = fine.Begin();
  try {
    walk.GoTo(loop.start, loop.word.size());
    const Steps& word = walk.word();
    if (word.size() > loop.word.size() || !std::equal(word.begin(), word.end(), loop.word.begin()))
      return OtherStep(loop.word, word, 0);
    if (walk.drives() != loop.start)
      return Rejected{"start", std::to_string(loop.start), "as many drives as end in a state of the main loop"};
    return loop.IsBox() ? FaultOfBox(fine, walk, loop) : FaultOfStates(fine, walk, loop);
  } catch (const UnsureComparison&) {
    return Rejected{"bits", std::to_string(loop.bits), "a run of which every sign is told"};
  } catch (const RunEnded& end) {
    return Rejected{"word", end.how, "a run that does not end"};
  }
}

std::optional<RunInSpace> ProveLoopInSpace(const ExactProblem& problem, const Policy& policy,
                                           const Limits& limits) {
  for (const Effort effort : kEfforts) {
    std::optional<RunInSpace> loop;
    bool hopeless = false, contracts = false;
    {
      LoopSearch search(problem, policy, limits, effort);
      loop = search.Find();
      hopeless = search.is_hopeless();
      contracts = search.contracts();
    }
    if (loop && !FindLoopFault(problem, policy, *loop)) return loop;
    if (hopeless || limits.Stopped() || (effort.bits >= kBitsForAll && !contracts)) break;
  }
  return std::nullopt;
}

std::optional<RunInSpace> ProveEndlessInSpace(const ExactProblem& problem, const Policy& policy,
                                              const Limits& limits) {
  std::optional<RunInSpace> loop = ProveLoopInSpace(problem, policy, limits);
  if (!loop || !loop->IsBox()) return std::nullopt;
  loop->endless = true;
  if (FindLoopFault(problem, policy, *loop)) return std::nullopt;
  return loop;
}

std::optional<Rejected> FindRayFault(const ExactProblem& problem, const Policy& policy, const RunInSpace& ray) {
  if (auto fault = FaultOfNumbers(problem, ray.bits)) return fault;
  const FineBits bits(ray.bits);
  const FineProblem fine(problem, policy, {});
  Walk walk = fine.Begin();
  std::string end = "a run that goes on";
  try {
    while (walk.word().size() <= ray.word.size()) walk.TakeTurn();
  } catch (const UnsureComparison&) {
    return Rejected{"bits", std::to_string(ray.bits), "a run of which every sign is told"};
  } catch (const RunEnded& ended) {
    end = ended.how;
  }
  if (!Stands(ray.word, walk.word(), 0)) return OtherStep(ray.word, walk.word(), 0);
  if (end != Name(Outcome::kRay)) return Rejected{"word", end, "a run that ends in a step without a limit"};
  return std::nullopt;
}

std::optional<RunInSpace> ProveRayInSpace(const ExactProblem& problem, const Policy& policy,
                                          const Limits& limits) {
  for (const Effort effort : std::span(kEfforts).first(2)) {
    std::optional<RunInSpace> ray;
    try {
      const FineBits bits(effort.bits);
      const FineProblem fine(problem, policy, limits);
      Walk walk = fine.Begin();
      try {
        for (int turn = 0; turn < effort.turns; ++turn) walk.TakeTurn();
      } catch (const RunEnded& end) {
        if (end.how != Name(Outcome::kRay)) return std::nullopt;
        ray = {.bits = effort.bits / 2 * 3, .word = walk.word()};
      }
    } catch (const UnsureComparison&) {
      continue;
    }
    if (ray && !FindRayFault(problem, policy, *ray)) return ray;
  }
  return std::nullopt;
}

}  // namespace stiction
