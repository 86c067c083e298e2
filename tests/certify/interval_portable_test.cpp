// SPDX-License-Identifier: Apache-2.0
// Intervals that round by what rounding leaves, against CGAL's, which switch how the processor rounds.
#include "certify/exact/interval_portable.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "certify/exact/interval.h"

namespace stiction {
namespace {

using Reference = CGAL::Interval_nt<>;

struct Both {
  Reference reference;
  PortableInterval portable;
};

bool AreSame(const Reference& x, const PortableInterval& y) { return x.inf() == y.inf() && x.sup() == y.sup(); }

class Ends {
 public:
  Both Next() {
    const double one = Double(), width = random_() % 3 == 0 ? 0 : std::abs(Double()) * 0x1p-20;
    const double other = one + width;
    return {Reference(one, other), PortableInterval(one, other)};
  }

 private:
  double Double() {
    const auto bits = static_cast<std::int64_t>(random_());
    const bool is_short = random_() % 4 == 0;
    return std::ldexp(is_short ? static_cast<double>(bits % 9) : static_cast<double>(bits),
                      static_cast<int>(random_() % 81) - 40);
  }

  std::mt19937_64 random_{1};
};

// -1: undecided.
template <class Number, class Compare>
int Decided(const Number& x, const Number& y, const Compare& compare) {
  try {
    return compare(x, y) ? 1 : 0;
  } catch (const std::exception&) {
    return -1;
  }
}

TEST_CASE("portable intervals: their ends and their comparisons are those of CGAL") {
  Ends ends;
  const auto less = [](const auto& x, const auto& y) { return x < y; };
  const auto equal = [](const auto& x, const auto& y) { return x == y; };
  bool sums = true, products = true, quotients = true, roots = true, comparisons = true;
  for (int i = 0; i < 200000; ++i) {
    const Both x = ends.Next(), y = ends.Next();
    sums &= AreSame(x.reference + y.reference, x.portable + y.portable);
    sums &= AreSame(x.reference - y.reference, x.portable - y.portable);
    products &= AreSame(x.reference * y.reference, x.portable * y.portable);
    quotients &= AreSame(x.reference / y.reference, x.portable / y.portable);
    if (x.reference.inf() >= 0) roots &= AreSame(sqrt(x.reference), sqrt(x.portable));
    comparisons &= Decided(x.reference, y.reference, less) == Decided(x.portable, y.portable, less);
    comparisons &= Decided(x.reference, y.reference, equal) == Decided(x.portable, y.portable, equal);
    comparisons &= Decided(x.reference, x.reference, equal) == Decided(x.portable, x.portable, equal);
  }
  CHECK(sums);
  CHECK(products);
  CHECK(quotients);
  CHECK(roots);
  CHECK(comparisons);
}

TEST_CASE("portable intervals: near the largest doubles sums hold what CGAL's hold") {
  const double most = std::numeric_limits<double>::max();
  std::mt19937_64 random{1};
  bool held = true;
  for (int i = 0; i < 20000; ++i) {
    const auto near = [&] { return std::ldexp(static_cast<double>(static_cast<std::int64_t>(random())), 960); };
    const double x = i % 5 == 0 ? most : near(), y = i % 7 == 0 ? -most : near();
    const Reference reference = Reference(x) + Reference(y);
    const PortableInterval portable = PortableInterval(x) + PortableInterval(y);
    held &= portable.inf() <= reference.inf() && reference.sup() <= portable.sup();
  }
  CHECK(held);
  const PortableInterval sum = PortableInterval(0x1.fa8372bfe1633p+1022) + PortableInterval(-most);
  const Reference told = Reference(0x1.fa8372bfe1633p+1022) + Reference(-most);
  CHECK((sum.inf() <= told.inf() && told.sup() <= sum.sup()));
}

TEST_CASE("portable intervals: where digits are lost, the ends are farther out and never further in") {
  const double tiny = 0x1.5p-500, least = 5e-324;
  const PortableInterval product = PortableInterval(tiny) * PortableInterval(tiny / 3);
  CHECK(product.inf() < product.sup());
  const Reference reference = Reference(tiny) * Reference(tiny / 3);
  CHECK(product.inf() <= reference.inf());
  CHECK(product.sup() >= reference.sup());
  CHECK((PortableInterval(least) * PortableInterval(0.5)).sup() == least);
  CHECK((PortableInterval(least) * PortableInterval(0.5)).inf() <= 0);
  CHECK(std::isinf((PortableInterval(1e308) + PortableInterval(1e308)).sup()));
  CHECK((PortableInterval(1e308) + PortableInterval(1e308)).inf() == std::numeric_limits<double>::max());
  const PortableInterval all = PortableInterval(1) / PortableInterval(-1, 1);
  CHECK((std::isinf(all.inf()) && std::isinf(all.sup())));
  CHECK_THROWS_AS(all > 0, PortableInterval::Unsure);
}

}  // namespace
}  // namespace stiction
