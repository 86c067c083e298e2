// SPDX-License-Identifier: Apache-2.0
// That there is no solution in space: words of touching and separated contacts, refuted (enumerate.h).

#include <fmt/format.h>

#include "certify/exact/cones.h"
#include "certify/exact/enumerate.h"
#include "certify/exact/farkas.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

// In each word: fN >= 0, f in the friction cones; aN = 0 where contacts touch, f = 0 and aN >= 0 where they do
// not, aN >= 0 behind the prefix. So only normal rows stand in the programs, and y = 0 in the others.
class Refuter {
 public:
  Refuter(const ExactProblem& problem, const Request& request, const EnumerationWatch& watch)
      : problem_(problem),
        request_(request),
        watch_(watch),
        polygons_(FirstPolygons(problem)),
        normals_(NormalRowsOf(problem)) {}

  Enumeration Run() {
    ModeWord prefix;
    Search(prefix, {}, 1.0);
    return std::move(result_);
  }

 private:
  bool Ended() const { return result_.end != EnumerationEnd::kComplete; }
  bool Breaks(const ModeWord& prefix, int contact) const {
    return contact < static_cast<int>(prefix.size()) && prefix[contact] == Mode::kBreak;
  }

  // `near`: forces of the prefix without its last mode, to be tried; or none.
  void Search(ModeWord& prefix, const ExactVector& near, double share) {
    ++result_.prefixes;
    const ExactVector f = IsNear(prefix, near) ? near : Decide(prefix);
    if (Ended()) return;
    if (f.size() < problem_.rows()) return Report(share);
    if (prefix.size() == problem_.contacts.size()) {
      result_.end = EnumerationEnd::kOpen;
      return;
    }
    const auto modes = ModesOf(problem_.contacts[prefix.size()], 3);
    for (const bool nearest : {true, false}) {  // words that stay open are come to first
      for (const Mode mode : modes) {
        prefix.push_back(mode);
        if (IsNear(prefix, f) == nearest) Search(prefix, f, share / static_cast<double>(modes.size()));
        prefix.pop_back();
        if (Ended()) return;
      }
    }
  }

  // Whether forces of the prefix without its last mode are of the prefix, too.
  bool IsNear(const ModeWord& prefix, const ExactVector& f) const {
    if (f.size() < problem_.rows() || prefix.empty()) return false;
    const int contact = static_cast<int>(prefix.size()) - 1, row = normals_[contact];
    if (prefix.back() == Mode::kBreak) return f[row] == 0;
    Rational a = problem_.b[row];
    for (int j = 0; j < problem_.rows(); ++j) a += problem_.A(row, j) * f[j];
    return a == 0;
  }

  // Forces of the prefix, which no vector refutes as far as this can tell; none where one does, and is noted.
  ExactVector Decide(const ModeWord& prefix) {
    constexpr int kRounds = 8;
    for (int round = 1;; ++round) {
      if (result_.programs == request_.limits.programs) {
        result_.end = EnumerationEnd::kLimit;
        return {};
      }
      ++result_.programs;
      const ExactVector f = SolveProgram(prefix);
      const bool refuted = f.size() < problem_.rows();
      if (refuted || round == kRounds || !AddCorners(problem_, EdgesOf::kAroundCone, f, polygons_)) return f;
    }
  }

  // Forces in the cones around the friction cones; none if there are none.
  ExactVector SolveProgram(const ModeWord& prefix) {
    std::vector<ConeEdge> edges = MakeEdges(problem_, polygons_, EdgesOf::kAroundCone);
    std::erase_if(edges, [&](const ConeEdge& edge) { return Breaks(prefix, edge.contact); });
    std::vector<bool> free;
    for (const ConeEdge& edge : edges) free.push_back(edge.free);
    std::vector<RationalRow> rows;
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      const bool closed = problem_.contacts[i].kind == ContactKind::kBilateral ||
                          (i < prefix.size() && prefix[i] == Mode::kTouch);
      RationalRow& row = rows.emplace_back(
          RationalRow{{}, problem_.b[normals_[i]], closed ? Relation::kZero : Relation::kAtLeastZero});
      for (const ConeEdge& edge : edges) row.coefficients.push_back(Along(edge, problem_.A, normals_[i]));
    }
    const auto answer = Solve(free, rows);
    if (const Point* x = std::get_if<Point>(&answer)) return Combined(edges, *x, problem_.rows());
    Note(prefix, std::get<Multipliers>(answer).values);
    return {};
  }

  void Note(const ModeWord& prefix, const std::vector<Rational>& multipliers) {
    ExactVector y = ExactVector::Constant(problem_.rows(), Rational(0));
    mpz_class divisor = 0;
    for (const Rational& x : multipliers) divisor = gcd(divisor, x.get_num());  // integers all
    for (std::size_t i = 0; i < normals_.size(); ++i) y[normals_[i]] = multipliers[i] / divisor;
    const auto gap = FindRefutationGap(problem_, prefix, MakeFarkasVector(problem_, y));
    STICTION_CHECK(!gap, "a Farkas vector of a linear program is wrong: " + gap.value_or(""));
    result_.refuted.push_back({prefix, y});
  }

  void Report(double share) {
    result_.decided += share;
    if (request_.limits.Stopped() || (watch_ && !watch_(result_))) result_.end = EnumerationEnd::kStopped;
  }

  const ExactProblem& problem_;
  const Request& request_;
  const EnumerationWatch& watch_;
  RationalPolygons polygons_;
  std::vector<int> normals_;  // row by contact
  Enumeration result_;
};

}  // namespace

Enumeration RefuteInSpace(const ExactProblem& problem, const Request& request, const EnumerationWatch& watch) {
  if (problem.dimension != 3)
    throw InputError(
        fmt::format("refutations in space: a problem of dimension {}, expected 3", problem.dimension));
  return Refuter(problem, request, watch).Run();
}

}  // namespace stiction
