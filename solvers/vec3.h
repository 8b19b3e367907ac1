// A vector of three components, over scalars or over SIMD packs.
#pragma once

namespace sluice {

template <class Real>
struct Vec3 {
  Real x{};
  Real y{};
  Real z{};

  friend bool operator==(const Vec3&, const Vec3&) = default;

  [[gnu::always_inline]] constexpr Vec3& operator+=(const Vec3& o) {
    x += o.x;
    y += o.y;
    z += o.z;
    return *this;
  }
};

template <class Real>
[[gnu::always_inline]] constexpr Vec3<Real> operator+(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
[[gnu::always_inline]] constexpr Vec3<Real> operator-(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
[[gnu::always_inline]] constexpr Vec3<Real> operator*(const Real& s, const Vec3<Real>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Real>
[[gnu::always_inline]] constexpr Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

using Vec3d = Vec3<double>;

/// x, y and z by their numbers 0, 1 and 2.
constexpr double component(const Vec3d& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
constexpr double& component(Vec3d& v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

}  // namespace sluice
