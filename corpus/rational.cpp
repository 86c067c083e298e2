// SPDX-License-Identifier: Apache-2.0
// Rational: numbers as text, and the nearest double.

#include "corpus/rational.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stiction {
namespace {

using Integer = Fractions<Rational>::Integer;

constexpr long kMaxExponent = 10000;

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// Reads from the left of a text; a part that is not there is left unread, and empty.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : rest_(text) {}

  bool AtEnd() const { return rest_.empty(); }

  bool Skip(std::string_view any_of) {
    if (rest_.empty() || any_of.find(rest_.front()) == any_of.npos) return false;
    last_ = rest_.front();
    rest_.remove_prefix(1);
    return true;
  }
  // The character that Skip passed last.
  char last() const { return last_; }

  std::string_view Digits() {
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), IsDigit);
    const std::string_view digits = rest_.substr(0, end - rest_.begin());
    rest_.remove_prefix(digits.size());
    return digits;
  }

 private:
  std::string_view rest_;
  char last_ = '\0';
};

std::optional<Rational> Ratio(const Integer& numerator, const Integer& denominator) {
  if (denominator == 0) return std::nullopt;
  return Fractions<Rational>::Quotient(numerator, denominator);
}

// The exponent, or nothing beyond the limit. Leading zeros may make it as long as they like.
std::optional<long> Exponent(bool negative, std::string_view digits) {
  long exponent = 0;
  for (const char digit : digits) {
    exponent = 10 * exponent + (digit - '0');
    if (exponent > kMaxExponent) return std::nullopt;
  }
  return negative ? -exponent : exponent;
}

Rational Scaled(const Integer& digits, long exponent) {
  if (exponent >= 0) return Rational(Integer(digits * PowerOfTen(exponent)));
  return Fractions<Rational>::Quotient(digits, PowerOfTen(-exponent));
}

// The binary exponent of x > 0: 2^e <= x < 2^(e + 1).
long FloorLog2(const Integer& numerator, const Integer& denominator) {
  const long e = static_cast<long>(BitLength<Integer>::Of(numerator)) -
                 static_cast<long>(BitLength<Integer>::Of(denominator));
  const bool below = e >= 0 ? numerator < (denominator << e) : (numerator << -e) < denominator;
  return below ? e - 1 : e;
}

#ifdef STICTION_BOOST_RATIONALS
std::optional<double> SoonerToDouble(const Rational&) { return std::nullopt; }
#else
// The same for the usual number, in a tenth of the time: what the library truncates it to, or the next double,
// as the middle between them tells. Empty near the ends of the range, and for the middle itself.
std::optional<double> SoonerToDouble(const Rational& x) {
  const double below = std::abs(x.get_d());
  if (!(below >= 0x1p-900 && below <= 0x1p900)) return std::nullopt;
  int exponent;  // below = digits 2^exponent, digits of 53 bits; the middle is (2 digits + 1) 2^(exponent - 1)
  const auto digits = static_cast<unsigned long>(std::ldexp(std::frexp(below, &exponent), 53));
  exponent -= 54;
  thread_local Integer middle, numerator;
  mpz_mul_ui(middle.get_mpz_t(), x.get_den_mpz_t(), 2 * digits + 1);
  mpz_srcptr compared = x.get_num_mpz_t();
  if (exponent >= 0) {
    middle <<= exponent;
  } else {
    mpz_mul_2exp(numerator.get_mpz_t(), compared, -exponent);
    compared = numerator.get_mpz_t();
  }
  const int order = mpz_cmpabs(compared, middle.get_mpz_t());
  if (order == 0) return std::nullopt;
  const double nearest = order < 0 ? below : std::ldexp(static_cast<double>(digits + 1), exponent + 1);
  return Sign(x) < 0 ? -nearest : nearest;
}
#endif

// numerator / denominator rounded to the nearest integer, to even on ties. Requires numbers >= 0.
Integer RoundedQuotient(const Integer& numerator, const Integer& denominator) {
  Integer quotient = numerator / denominator;
  const Integer twice = 2 * (numerator - quotient * denominator);
  const int half = Sign(Integer(twice - denominator));
  if (half > 0 || (half == 0 && quotient % 2 != 0)) ++quotient;
  return quotient;
}

}  // namespace

std::optional<Rational> ParseRational(std::string_view text) {
  Scanner scanner(text);
  const bool negative = scanner.Skip("-");
  std::string digits(scanner.Digits());
  if (digits.empty()) return std::nullopt;
  const auto signed_integer = [&] { return negative ? Integer(-IntegerOf(digits)) : IntegerOf(digits); };
  if (scanner.Skip("/")) {
    const std::string_view denominator = scanner.Digits();
    if (denominator.empty() || !scanner.AtEnd()) return std::nullopt;
    return Ratio(signed_integer(), IntegerOf(std::string(denominator)));
  }
  std::string_view fraction;
  if (scanner.Skip(".")) {
    fraction = scanner.Digits();
    if (fraction.empty()) return std::nullopt;
    digits += fraction;
  }
  std::optional<long> exponent = 0;
  if (scanner.Skip("eE")) {
    const bool below_zero = scanner.Skip("+-") && scanner.last() == '-';
    const std::string_view exponent_digits = scanner.Digits();
    if (exponent_digits.empty()) return std::nullopt;
    exponent = Exponent(below_zero, exponent_digits);
  }
  if (!exponent.has_value() || !scanner.AtEnd()) return std::nullopt;
  return Scaled(signed_integer(), *exponent - static_cast<long>(fraction.size()));
}

std::string ToString(const Rational& x) { return TextOf(x); }

// Conversions of libraries truncate. Here the last bit that the double has is found first, then x is rounded to
// it once, over integers: right for subnormals too, and in any rounding mode of the processor.
double ToDouble(const Rational& x) {
  if (Sign(x) == 0) return 0;
  if (const auto sooner = SoonerToDouble(x)) return *sooner;
  const Integer numerator = abs(Fractions<Rational>::Numerator(x)),
                denominator = Fractions<Rational>::Denominator(x);
  const long last_bit = std::max(FloorLog2(numerator, denominator) - 52, -1074L);
  const Integer digits = last_bit >= 0 ? RoundedQuotient(numerator, Integer(denominator << last_bit))
                                       : RoundedQuotient(Integer(numerator << -last_bit), denominator);
  const bool overflow = static_cast<long>(BitLength<Integer>::Of(digits)) + last_bit > 1024;
  const double magnitude = overflow ? std::numeric_limits<double>::infinity()
                                    : std::ldexp(DoubleOf(digits), static_cast<int>(last_bit));
  return Sign(x) < 0 ? -magnitude : magnitude;
}

std::int64_t Bits(const Rational& x) {
  using Parts = Fractions<Rational>;
  return std::max(BitLength<Integer>::Of(Parts::Numerator(x)), BitLength<Integer>::Of(Parts::Denominator(x)));
}

Rational SquareRoot<Rational>::Of(const Rational& x) {
  using Parts = Fractions<Rational>;
  if (x == 0) return 0;
  const Integer numerator = Parts::Numerator(x), denominator = Parts::Denominator(x);
  const std::int64_t short_of = BitLength<Integer>::Of(denominator) - BitLength<Integer>::Of(numerator) + 1;
  const auto places = static_cast<unsigned>(110 + std::max<std::int64_t>(0, short_of) / 2);
  const Integer scaled = (numerator << (2 * places)) / denominator;
  return Parts::Quotient(Integer(sqrt(scaled)), Integer(Integer(1) << places));
}

bool IsExactDouble(const Rational& x) {
  const double nearest = ToDouble(x);
  return std::isfinite(nearest) && Rational(nearest) == x;
}

}  // namespace stiction
