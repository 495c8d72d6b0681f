// Three numbers along x, y, z. Every operation is a fixed sequence of + - x / sqrt, so results are the same on every
// platform.
#pragma once

#include <cmath>

namespace bihive {

template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  T operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  T& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }

  friend Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend Vec3 operator*(Vec3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend Vec3 operator*(T s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend Vec3 operator/(Vec3 a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  friend bool operator==(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
  friend bool operator!=(Vec3 a, Vec3 b) { return !(a == b); }
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

template <class T>
T dot(Vec3<T> a, Vec3<T> b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

template <class T>
Vec3<T> cross(Vec3<T> a, Vec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
T length(Vec3<T> a) {
  return std::sqrt(dot(a, a));
}

/// a / |a|; |a| must not be 0. Three products with one reciprocal: relative error of each below 5 x 2^-53.
template <class T>
Vec3<T> normalized(Vec3<T> a) {
  return (1 / length(a)) * a;
}

/// As normalized(), with the same accuracy. Needs neither root nor division if |a| is almost 1. That holds for every
/// direction that was normalized in binary64 and rounded to binary32.
inline Vec3<double> normalized_again(Vec3<double> a) {
  const double beyond = dot(a, a) - 1;
  if (!(std::abs(beyond) < 0x1p-18)) return normalized(a);
  // The series of 1 / sqrt(1 + e); the first term left out, 5/16 e^3, is below 2^-55.
  return (1 - beyond * (0.5 - 0.375 * beyond)) * a;
}

template <class T>
bool is_finite(Vec3<T> a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

inline Vec3d to_double(Vec3f a) {
  return {double(a.x), double(a.y), double(a.z)};
}
inline Vec3f to_float(Vec3d a) {
  return {float(a.x), float(a.y), float(a.z)};
}

}  // namespace bihive
