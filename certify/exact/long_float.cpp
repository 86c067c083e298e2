// SPDX-License-Identifier: Apache-2.0
#include "certify/exact/long_float.h"

#include <algorithm>
#include <bit>

namespace stiction {

LongFloat::LongFloat(double x) {
  if (x == 0) return;
  if (!std::isfinite(x)) throw UnsureSign();
  int exponent;
  const double fraction = std::frexp(std::abs(x), &exponent);
  mp_limb_t bits = static_cast<mp_limb_t>(std::ldexp(fraction, 64));
  Take(x > 0 ? 1 : -1, &bits, 1, exponent - 64);
  if (sign_ == 0) throw UnsureSign();
}

// The numerator is made so long that the quotient has more bits than are kept; a power of two divides by
// itself.
LongFloat::LongFloat(const Rational& x, bool& is_exact) {
  is_exact = true;
  if (sgn(x) == 0) return;
  const mpz_srcptr denominator = x.get_den_mpz_t();
  thread_local mpz_class quotient, rest;
  const auto bits_of = [](mpz_srcptr n) { return static_cast<long>(mpz_sizeinbase(n, 2)); };
  mpz_abs(quotient.get_mpz_t(), x.get_num_mpz_t());
  long shift = bits_of(denominator) - 1;
  if (static_cast<long>(mpz_scan1(denominator, 0)) != shift) {
    shift = std::max(0L, kBits + 1 + bits_of(denominator) - bits_of(quotient.get_mpz_t()));
    mpz_mul_2exp(quotient.get_mpz_t(), quotient.get_mpz_t(), static_cast<mp_bitcnt_t>(shift));
    mpz_tdiv_qr(quotient.get_mpz_t(), rest.get_mpz_t(), quotient.get_mpz_t(), denominator);
    is_exact = sgn(rest) == 0;
  }
  const long zeros = static_cast<long>(mpz_scan1(quotient.get_mpz_t(), 0));
  is_exact &= bits_of(quotient.get_mpz_t()) - zeros <= kBits;
  const int size = static_cast<int>(mpz_size(quotient.get_mpz_t()));
  Take(sgn(x), mpz_limbs_modify(quotient.get_mpz_t(), size), size, -shift);
  is_exact &= sign_ != 0;
}

// sign * limbs * 2^exponent, the first kBits bits of it; `limbs` may be changed. Requires a last limb that is
// not zero.
void LongFloat::Take(int sign, mp_limb_t* limbs, int size, long exponent) {
  sign_ = sign;
  const int zeros = std::countl_zero(limbs[size - 1]);
  if (zeros > 0) mpn_lshift(limbs, limbs, size, zeros);
  exponent_ = exponent - zeros + 64L * (size - kLimbs);
  for (int k = 0; k < kLimbs; ++k) m_[k] = k + size < kLimbs ? 0 : limbs[k + size - kLimbs];
  StayInReach();
}

void LongFloat::StayInReach() {
  if (exponent_ + kBits > kReach) throw UnsureSign();
  if (exponent_ + kBits <= -kReach) sign_ = 0;
}

double LongFloat::Near() const {
  return sign_ == 0 ? 0
                    : sign_ * std::ldexp(static_cast<double>(m_[kLimbs - 1] >> 11),
                                         static_cast<int>(exponent_) + kBits - 53);
}

Rational LongFloat::Exactly() const {
  if (sign_ == 0) return 0;
  mpz_class m;
  mpz_import(m.get_mpz_t(), kLimbs, -1, sizeof(mp_limb_t), 0, 0, m_.data());
  Rational x(sign_ > 0 ? m : mpz_class(-m));
  if (exponent_ >= 0) {
    mpq_mul_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent_));
  } else {
    mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent_));
  }
  return x;
}

// Of two numbers, |x| >= |y| > 0.
LongFloat LongFloat::SumOfOrdered(const LongFloat& x, const LongFloat& y) {
  const long gap = x.exponent_ - y.exponent_;
  if (gap >= kBits) return x;
  const int limbs = static_cast<int>(gap / 64), bits = static_cast<int>(gap % 64);
  Limbs shifted;
  if (bits > 0) {
    mpn_rshift(shifted.data(), y.m_.data() + limbs, kLimbs - limbs, bits);
  } else {
    std::copy(y.m_.begin() + limbs, y.m_.end(), shifted.begin());
  }
  std::fill(shifted.end() - limbs, shifted.end(), 0);
  LongFloat sum;
  sum.sign_ = x.sign_;
  sum.exponent_ = x.exponent_;
  if (x.sign_ == y.sign_) {
    if (mpn_add_n(sum.m_.data(), x.m_.data(), shifted.data(), kLimbs) != 0) {
      mpn_rshift(sum.m_.data(), sum.m_.data(), kLimbs, 1);
      sum.m_[kLimbs - 1] |= mp_limb_t{1} << 63;
      ++sum.exponent_;
      sum.StayInReach();
    }
    return sum;
  }
  mpn_sub_n(sum.m_.data(), x.m_.data(), shifted.data(), kLimbs);
  int size = kLimbs;
  while (size > 0 && sum.m_[size - 1] == 0) --size;
  if (size == 0) return {};
  if (size == kLimbs && sum.m_[size - 1] >> 63 != 0) return sum;
  Limbs rest = sum.m_;
  sum.Take(x.sign_, rest.data(), size, x.exponent_);
  return sum;
}

LongFloat operator+(const LongFloat& x, const LongFloat& y) {
  if (x.sign_ == 0) return y;
  if (y.sign_ == 0) return x;
  const bool ordered = x.exponent_ != y.exponent_ ? x.exponent_ > y.exponent_
                                                  : mpn_cmp(x.m_.data(), y.m_.data(), LongFloat::kLimbs) >= 0;
  return ordered ? LongFloat::SumOfOrdered(x, y) : LongFloat::SumOfOrdered(y, x);
}

LongFloat operator*(const LongFloat& x, const LongFloat& y) {
  LongFloat product;
  if (x.sign_ == 0 || y.sign_ == 0) return product;
  std::array<mp_limb_t, 2 * LongFloat::kLimbs> limbs;
  mpn_mul_n(limbs.data(), x.m_.data(), y.m_.data(), LongFloat::kLimbs);
  product.Take(x.sign_ * y.sign_, limbs.data(), limbs.size(), x.exponent_ + y.exponent_);
  return product;
}

// The numerator has kBits zeros behind it, so that the quotient has kBits bits or one more.
LongFloat operator/(const LongFloat& x, const LongFloat& y) {
  constexpr int kLimbs = LongFloat::kLimbs;
  LongFloat quotient;
  if (x.sign_ == 0) return quotient;
  std::array<mp_limb_t, 2 * kLimbs> numerator = {};
  std::copy(x.m_.begin(), x.m_.end(), numerator.begin() + kLimbs);
  std::array<mp_limb_t, kLimbs + 1> limbs;
  LongFloat::Limbs rest;
  mpn_tdiv_qr(limbs.data(), rest.data(), 0, numerator.data(), 2 * kLimbs, y.m_.data(), kLimbs);
  const int size = limbs[kLimbs] == 0 ? kLimbs : kLimbs + 1;
  quotient.Take(x.sign_ * y.sign_, limbs.data(), size, x.exponent_ - y.exponent_ - LongFloat::kBits);
  return quotient;
}

}  // namespace stiction
