// SPDX-License-Identifier: Apache-2.0
// Rational: numbers as text, and the nearest double.

#include "corpus/rational.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stiction {
namespace {

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

mpz_class Integer(std::string_view digits) { return mpz_class(std::string(digits), 10); }

mpz_class PowerOfTen(unsigned long exponent) {
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, exponent);
  return power;
}

std::optional<Rational> Ratio(mpz_class numerator, std::string_view denominator) {
  Rational x(std::move(numerator), Integer(denominator));
  if (x.get_den() == 0) return std::nullopt;
  x.canonicalize();
  return x;
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

Rational Scaled(mpz_class digits, long exponent) {
  if (exponent >= 0) return Rational(digits * PowerOfTen(exponent));
  Rational x(std::move(digits), PowerOfTen(-exponent));
  x.canonicalize();
  return x;
}

// The binary exponent of x > 0: 2^e <= x < 2^(e + 1).
long FloorLog2(const mpz_class& numerator, const mpz_class& denominator) {
  const long e = static_cast<long>(mpz_sizeinbase(numerator.get_mpz_t(), 2)) -
                 static_cast<long>(mpz_sizeinbase(denominator.get_mpz_t(), 2));
  const bool below = e >= 0 ? numerator < (denominator << e) : (numerator << -e) < denominator;
  return below ? e - 1 : e;
}

// numerator / denominator rounded to the nearest integer, to even on ties.
mpz_class RoundedQuotient(const mpz_class& numerator, const mpz_class& denominator) {
  mpz_class quotient, remainder;
  mpz_fdiv_qr(quotient.get_mpz_t(), remainder.get_mpz_t(), numerator.get_mpz_t(), denominator.get_mpz_t());
  const int half = cmp(mpz_class(2 * remainder), denominator);
  if (half > 0 || (half == 0 && mpz_odd_p(quotient.get_mpz_t()))) ++quotient;
  return quotient;
}

}  // namespace

std::optional<Rational> ParseRational(std::string_view text) {
  Scanner scanner(text);
  const bool negative = scanner.Skip("-");
  std::string digits(scanner.Digits());
  if (digits.empty()) return std::nullopt;
  const auto signed_integer = [&] { return negative ? mpz_class(-Integer(digits)) : Integer(digits); };
  if (scanner.Skip("/")) {
    const std::string_view denominator = scanner.Digits();
    if (denominator.empty() || !scanner.AtEnd()) return std::nullopt;
    return Ratio(signed_integer(), denominator);
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

std::string ToString(const Rational& x) { return x.get_str(); }

// mpq_get_d truncates. Here the last bit that the double has is found first, then x is rounded to it
// once, over integers: right for subnormals too, and in any rounding mode of the processor.
double ToDouble(const Rational& x) {
  if (sgn(x) == 0) return 0;
  const mpz_class numerator = abs(x.get_num());
  const mpz_class& denominator = x.get_den();
  const long last_bit = std::max(FloorLog2(numerator, denominator) - 52, -1074L);
  const mpz_class digits = last_bit >= 0 ? RoundedQuotient(numerator, denominator << last_bit)
                                         : RoundedQuotient(numerator << -last_bit, denominator);
  const bool overflow = static_cast<long>(mpz_sizeinbase(digits.get_mpz_t(), 2)) + last_bit > 1024;
  const double magnitude = overflow ? std::numeric_limits<double>::infinity()
                                    : std::ldexp(digits.get_d(), static_cast<int>(last_bit));
  return sgn(x) < 0 ? -magnitude : magnitude;
}

std::int64_t Bits(const Rational& x) {
  return static_cast<std::int64_t>(
      std::max(mpz_sizeinbase(x.get_num_mpz_t(), 2), mpz_sizeinbase(x.get_den_mpz_t(), 2)));
}

}  // namespace stiction
