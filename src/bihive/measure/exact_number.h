// Exact sums and products of binary64 numbers, for decisions that rounding cannot make.
//
// A number is a sign and a magnitude: limbs of 32 bits, the lowest of weight 2^(32 exponent). Limbs of 0 at either end
// are dropped, so numbers of few bits, such as those of lattices, stay short. Nothing is ever rounded: the capacity
// holds every number that measure/decisions.h makes of coordinates and radii that are multiples of 2^-160 below 2^41.
// The largest has degree 12 in them: 12 x 201 bits, some bits of sums, and a limb at each end.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "bihive/base/check.h"

namespace bihive::measure {

class ExactNumber {
 public:
  static constexpr int kCapacity = 96;

  ExactNumber() = default;
  /// x must be finite, and a multiple of 2^-960.
  ExactNumber(double x) {  // NOLINT(google-explicit-constructor)
    if (x == 0) return;
    sign_ = x < 0 ? -1 : 1;
    int exponent = 0;
    const double mantissa = std::frexp(std::abs(x), &exponent);  // [1/2, 1)
    // 53 bits as an integer, shifted to a multiple of 32: at most 84 bits.
    auto bits = static_cast<std::uint64_t>(std::ldexp(mantissa, 53));
    exponent -= 53;
    exponent_ = exponent >= 0 ? exponent / 32 : -((31 - exponent) / 32);
    const int shift = exponent - 32 * exponent_;
    const std::uint64_t low = (bits & 0xffffffffu) << shift;
    const std::uint64_t high = ((bits >> 32) << shift) + (low >> 32);
    limbs_[0] = static_cast<std::uint32_t>(low);
    limbs_[1] = static_cast<std::uint32_t>(high);
    limbs_[2] = static_cast<std::uint32_t>(high >> 32);
    size_ = 3;
    trim();
  }
  ExactNumber(const ExactNumber& other) { *this = other; }
  ExactNumber& operator=(const ExactNumber& other) {
    sign_ = other.sign_;
    exponent_ = other.exponent_;
    size_ = other.size_;
    for (int i = 0; i < size_; ++i) limbs_[i] = other.limbs_[i];
    return *this;
  }
  ~ExactNumber() = default;

  /// -1, 0 or 1.
  int sign() const { return sign_; }

  /// The nearest binary64 number up to one unit in the last place; results beyond its range are the caller's concern.
  double to_double() const {
    double sum = 0;
    // Three limbs hold at least 65 bits.
    for (int i = size_ > 3 ? size_ - 3 : 0; i < size_; ++i) sum += std::ldexp(double(limbs_[i]), 32 * (i + exponent_));
    return sign_ * sum;
  }

  friend ExactNumber operator-(const ExactNumber& a) {
    ExactNumber negated = a;
    negated.sign_ = -a.sign_;
    return negated;
  }
  friend ExactNumber operator+(const ExactNumber& a, const ExactNumber& b) { return sum(a, b, b.sign_); }
  friend ExactNumber operator-(const ExactNumber& a, const ExactNumber& b) { return sum(a, b, -b.sign_); }
  friend ExactNumber operator*(const ExactNumber& a, const ExactNumber& b) {
    ExactNumber product;
    if (a.sign_ == 0 || b.sign_ == 0) return product;
    product.sign_ = a.sign_ * b.sign_;
    product.exponent_ = a.exponent_ + b.exponent_;
    product.size_ = a.size_ + b.size_;
    BIHIVE_CHECK(product.size_ <= kCapacity);
    for (int i = 0; i < product.size_; ++i) product.limbs_[i] = 0;
    for (int i = 0; i < a.size_; ++i) {
      std::uint64_t carry = 0;
      for (int j = 0; j < b.size_; ++j) {
        carry += std::uint64_t{a.limbs_[i]} * b.limbs_[j] + product.limbs_[i + j];
        product.limbs_[i + j] = static_cast<std::uint32_t>(carry);
        carry >>= 32;
      }
      product.limbs_[i + b.size_] = static_cast<std::uint32_t>(carry);
    }
    product.trim();
    return product;
  }

 private:
  int sign_ = 0;
  int exponent_ = 0;
  int size_ = 0;
  std::array<std::uint32_t, kCapacity> limbs_;  // those from size_ on are not set

  std::uint32_t limb_at(int weight) const {
    const int i = weight - exponent_;
    return i >= 0 && i < size_ ? limbs_[i] : 0;
  }

  void trim() {
    while (size_ > 0 && limbs_[size_ - 1] == 0) --size_;
    int zeros = 0;
    while (zeros < size_ && limbs_[zeros] == 0) ++zeros;
    if (size_ == 0) {
      sign_ = exponent_ = 0;
    } else if (zeros > 0) {
      for (int i = zeros; i < size_; ++i) limbs_[i - zeros] = limbs_[i];
      size_ -= zeros;
      exponent_ += zeros;
    }
  }

  // The sign of |a| - |b|; neither is 0.
  static int compare_magnitudes(const ExactNumber& a, const ExactNumber& b) {
    const int top_a = a.exponent_ + a.size_, top_b = b.exponent_ + b.size_;
    if (top_a != top_b) return top_a < top_b ? -1 : 1;
    const int bottom = a.exponent_ < b.exponent_ ? a.exponent_ : b.exponent_;
    for (int weight = top_a - 1; weight >= bottom; --weight) {
      const std::uint32_t of_a = a.limb_at(weight), of_b = b.limb_at(weight);
      if (of_a != of_b) return of_a < of_b ? -1 : 1;
    }
    return 0;
  }

  // a plus the magnitude of b with this sign.
  static ExactNumber sum(const ExactNumber& a, const ExactNumber& b, int sign_of_b) {
    if (sign_of_b == 0) return a;
    ExactNumber result;
    if (a.sign_ == 0) {
      result = b;
      result.sign_ = sign_of_b;
      return result;
    }
    const int bottom = a.exponent_ < b.exponent_ ? a.exponent_ : b.exponent_;
    const int top_a = a.exponent_ + a.size_, top_b = b.exponent_ + b.size_;
    const int top = top_a > top_b ? top_a : top_b;
    BIHIVE_CHECK(top - bottom < kCapacity);
    result.exponent_ = bottom;
    if (a.sign_ == sign_of_b) {
      result.sign_ = a.sign_;
      std::uint64_t carry = 0;
      for (int weight = bottom; weight < top; ++weight) {
        carry += std::uint64_t{a.limb_at(weight)} + b.limb_at(weight);
        result.limbs_[weight - bottom] = static_cast<std::uint32_t>(carry);
        carry >>= 32;
      }
      result.limbs_[top - bottom] = static_cast<std::uint32_t>(carry);
      result.size_ = top - bottom + 1;
    } else {
      const int order = compare_magnitudes(a, b);
      if (order == 0) return ExactNumber();
      const ExactNumber& large = order > 0 ? a : b;
      const ExactNumber& small = order > 0 ? b : a;
      result.sign_ = order > 0 ? a.sign_ : sign_of_b;
      std::int64_t borrow = 0;
      for (int weight = bottom; weight < top; ++weight) {
        borrow += std::int64_t{large.limb_at(weight)} - small.limb_at(weight);
        result.limbs_[weight - bottom] = static_cast<std::uint32_t>(borrow);
        borrow >>= 32;  // -1 or 0
      }
      result.size_ = top - bottom;
    }
    result.trim();
    return result;
  }
};

}  // namespace bihive::measure
