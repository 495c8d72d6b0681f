// Numbers of about 46 bits as the sum of two binary32 numbers, for the few computations where the CPU's binary64
// decides the colour of a pixel: `upper` is the rounded sum, `lower` the rest.
#include "common"

// Always 0, but unknown to the compiler, which must not simplify (a + b) - a.
uniform highp uint zero_bits;

struct Pair3 {
  vec3 upper;
  vec3 lower;
};

vec3 opaque(vec3 a) {
  return uintBitsToFloat(floatBitsToUint(a) ^ uvec3(zero_bits));
}

// The upper 12 bits. Products of upper parts and of the remaining parts are exact.
vec3 upper_bits(vec3 a) {
  return uintBitsToFloat(floatBitsToUint(a) & uvec3(0xFFFFF000u));
}

Pair3 exact_sum(vec3 a, vec3 b) {
  vec3 sum = opaque(a + b);
  vec3 b_there = opaque(sum - a);
  return Pair3(sum, (a - opaque(sum - b_there)) + (b - b_there));
}

Pair3 exact_product(vec3 a, vec3 b) {
  vec3 product = opaque(a * b);
  vec3 au = upper_bits(a), bu = upper_bits(b);
  vec3 al = a - au, bl = b - bu;
  return Pair3(product, ((au * bu - product) + (au * bl + al * bu)) + al * bl);
}

Pair3 sum_of(Pair3 a, Pair3 b) {
  Pair3 sum = exact_sum(a.upper, b.upper);
  vec3 lower = sum.lower + (a.lower + b.lower);
  vec3 upper = opaque(sum.upper + lower);
  return Pair3(upper, lower - opaque(upper - sum.upper));
}

Pair3 product_of(vec3 a, Pair3 b) {
  Pair3 product = exact_product(a, b.upper);
  return Pair3(product.upper, product.lower + a * b.lower);
}

// a / |a|, rounded once.
vec3 normalized(Pair3 a) {
  Pair3 squares = product_of(a.upper, Pair3(a.upper, 2.0 * a.lower));
  Pair3 squared = sum_of(sum_of(Pair3(squares.upper.xxx, squares.lower.xxx), Pair3(squares.upper.yyy, squares.lower.yyy)),
                         Pair3(squares.upper.zzz, squares.lower.zzz));

  // One Newton step from the nearest 1 / |a| of binary32.
  vec3 over_length = vec3(1.0 / sqrt(squared.upper.x));
  Pair3 over_squared = exact_product(over_length, over_length);
  Pair3 one = exact_product(squared.upper, over_squared.upper);
  vec3 missing =
      (((1.0 - one.upper) - one.lower) - squared.upper * over_squared.lower) - squared.lower * over_squared.upper;
  Pair3 result = exact_product(a.upper, over_length);
  return result.upper + (result.lower + (a.lower + 0.5 * missing * a.upper) * over_length);
}

// The sign of a b + c d, and its approximate size.
float sum_of_products(float a, float b, float c, float d) {
  vec3 factors = upper_bits(vec3(a, c, b));
  vec2 left = factors.xy, right = vec2(factors.z, upper_bits(vec3(d)).x);
  vec2 left_rest = vec2(a, c) - left, right_rest = vec2(b, d) - right;
  vec2 uppers = left * right;
  vec2 middles = left * right_rest + left_rest * right;
  vec2 lowers = left_rest * right_rest;
  return opaque(vec3(uppers.x + uppers.y)).x + ((middles.x + middles.y) + (lowers.x + lowers.y));
}
