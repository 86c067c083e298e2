// SPDX-License-Identifier: Apache-2.0
// Problems: which variable stands in which row.

#include "solver/problem/problem.h"

#include <catch2/catch.hpp>

#include "solver/problem/row_scale.h"
#include "solver/published/published.h"
#include "tests/support.h"

namespace stiction {
namespace {

using namespace testing;

const std::vector<Contact<double>> kMixed = {{ContactKind::kFrictionless, 0, {}},
                                             {ContactKind::kStatic, 1, {}},
                                             {ContactKind::kBilateral, 0, {}},
                                             {ContactKind::kSliding, 1, {1, 0}}};

TEST_CASE("problem: a contact asks for one row, or for as many as the dimension if it has friction") {
  CHECK(RowCount(kMixed, 2) == 6);
  CHECK(RowCount(kMixed, 3) == 8);
  CHECK(RowCount(std::vector<Contact<double>>{}, 2) == 0);
}

TEST_CASE("row layout: rows follow contacts, the normal before its friction") {
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(kMixed);
  CHECK(layout.ContactCount() == 4);
  const std::vector<int> contact_of = {0, 1, 1, 2, 3, 3}, normals = {0, 1, 3, 4};
  for (int row = 0; row < 6; ++row) {
    CAPTURE(row);
    CHECK(layout.ContactOf(row) == contact_of[row]);
    CHECK(layout.IsNormal(row) == (row != 2 && row != 5));
  }
  for (int contact = 0; contact < 4; ++contact) {
    CAPTURE(contact);
    CHECK(layout.NormalRowOf(contact) == normals[contact]);
    CHECK(layout.HasFriction(normals[contact]) == kMixed[contact].HasFrictionRows());
  }
}

TEST_CASE("row layout: a layout used before forgets the contacts it had") {
  RowLayout<Eigen::Dynamic> layout;
  layout.Assign(kMixed);
  layout.Assign(std::vector<Contact<double>>{{ContactKind::kFrictionless, 0, {}}});
  CHECK(layout.ContactCount() == 1);
  CHECK_FALSE(layout.HasFriction(0));
}

TEST_CASE("row layout: a fixed size is the layout of as many static contacts") {
  RowLayout<Eigen::Dynamic> dynamic;
  dynamic.Assign(ReferenceProblem().contacts);
  CHECK(RowLayout<4>::ContactCount() == dynamic.ContactCount());
  for (int row = 0; row < 4; ++row) {
    CHECK(RowLayout<4>::IsNormal(row) == dynamic.IsNormal(row));
    CHECK(RowLayout<4>::ContactOf(row) == dynamic.ContactOf(row));
    if (dynamic.IsNormal(row)) {
      CHECK(RowLayout<4>::HasFriction(row) == dynamic.HasFriction(row));
      CHECK(RowLayout<4>::NormalRowOf(row / 2) == dynamic.NormalRowOf(row / 2));
    }
  }
}

TEST_CASE("published algorithm: handles planar frictionless and static contacts, and nothing else") {
  ExactProblem problem = ReferenceProblem();
  CHECK(PublishedHandles(problem));
  CHECK(PublishedHandles(NoContacts()));
  CHECK(PublishedHandles(ExponentialFamily(2)));
  problem.dimension = 3;
  CHECK_FALSE(PublishedHandles(problem));
  for (const ContactKind kind : {ContactKind::kBilateral, ContactKind::kSliding}) {
    problem = ReferenceProblem();
    problem.contacts[1].kind = kind;
    CHECK_FALSE(PublishedHandles(problem));
  }
}

TEST_CASE("row scale: b is brought to about 1, too, where no double holds it in the units of A") {
  ContactProblem<double> problem;
  problem.contacts = {{ContactKind::kStatic, 1, {}}};
  const double tiny = std::ldexp(1.0, -184), huge = std::ldexp(1.0, 1000);
  problem.A = Eigen::Vector2d(tiny, tiny).asDiagonal();
  problem.b = Eigen::Vector2d(-huge, 0);
  CHECK(FindScale(problem).a == std::vector<int>{1000, 1000});
  CHECK(FindScale(problem).f == std::vector<int>{1184, 1184});
  CHECK(Scaled(problem, FindScale(problem)).b == Eigen::Vector2d(-1, 0));
  CHECK(Scaled(problem, FindScale(problem)).A == Eigen::Matrix2d::Identity());
  problem.b.setZero();
  CHECK(FindScale(problem).a == std::vector<int>{-92, -92});
  problem.b[1] = std::ldexp(1.0, -1070);  // a subnormal number
  CHECK(FindScale(problem).a == std::vector<int>{-1070, -1070});
  problem.A(0, 1) = huge;  // as no semidefinite A has it
  CHECK(FindScale(problem).f == std::vector<int>{-2070, -2070});
}

}  // namespace
}  // namespace stiction
