// The terms of the MPS operators, one function a term. i is the particle, j its neighbour, r = r_ij = r_j - r_i as in
// the paper. What is the same for all neighbours (dim / n0, 2 dim / (lambda0 n0)) is left to a sum's end. Real is
// double, or a pack of single precision. Lengths are in one unit throughout: metres in the reference, quanta of the
// coordinates in the fast path, whose sums take metres a quantum as a factor at their end. Units are given for metres.
#pragma once

#include "solvers/lanes.h"
#include "solvers/vec3.h"

namespace sluice::mps {

/// omega_ij = r_e / |r_ij| - 1 within the effective radius, zero beyond it   [1]   Eq. (16)
/// (the paper's second line is misprinted: as it stands the weight would vanish everywhere).
template <class Real>
[[gnu::always_inline]] inline Real weight(const Real& distance, const Real& effective_radius) {
  return larger(effective_radius / distance - 1, Real{});
}

/// (phi_j - phi_i) omega_ij, of the Laplacian, over 2 dim / (lambda0 n0)   [phi]   Eq. (19)
template <class Real>
[[gnu::always_inline]] inline Real laplacian_term(const Real& phi_i, const Real& phi_j, const Real& omega) {
  return (phi_j - phi_i) * omega;
}

/// (P_j - P_ref) / |r_ij|^2 r_ij omega_ij, of the gradient, over dim / n0   [Pa/m]   Eq. (18), and with the least
/// pressure of the neighbourhood as reference Eq. (24)
template <class Real>
[[gnu::always_inline]] inline Vec3<Real> gradient_term(const Real& reference, const Real& phi_j, const Vec3<Real>& r,
                                                       const Real& distance2, const Real& omega) {
  return ((phi_j - reference) * omega / distance2) * r;
}

/// A symmetric 3 x 3 matrix.
template <class Real>
struct Symmetric3 {
  Real xx{}, yy{}, zz{}, xy{}, xz{}, yz{};

  [[gnu::always_inline]] Symmetric3& operator+=(const Symmetric3& o) {
    xx += o.xx;
    yy += o.yy;
    zz += o.zz;
    xy += o.xy;
    xz += o.xz;
    yz += o.yz;
    return *this;
  }
};

/// r/|r| (x) r/|r| omega, of the correction matrix of the gradient   [1]   Eq. (24)
template <class Real>
[[gnu::always_inline]] inline Symmetric3<Real> correction_term(const Vec3<Real>& r, const Real& distance2,
                                                               const Real& omega) {
  const Real s = omega / distance2;
  return {s * r.x * r.x, s * r.y * r.y, s * r.z * r.z, s * r.x * r.y, s * r.x * r.z, s * r.y * r.z};
}

/// kappa of the source term, Eq. (23), for a particle whose number density exceeds n0 by the share `crowding`   [1]
/// kappa_r alone answers over 1 / sqrt(kappa_r) = 10 steps: an impact presses particles to twice n0 meanwhile. So the
/// share beyond a tolerated one is added, as the error-compensating source of Khayyer and Gotoh (2011, J. Comput. Phys.
/// 230:3093) takes the deviation of the number density itself for its coefficient. Ordinary flow stays below and keeps
/// the paper's source.
template <class Real>
[[gnu::always_inline]] inline Real relaxation(const Real& crowding, const Real& kappa_r, const Real& tolerated) {
  return kappa_r + larger(crowding - tolerated, Real{});
}

/// Change of the velocity of i in a collision with j   [m/s]
/// Two bodies of mass m_i and m_j that approach along r exchange momentum with restitution e:
/// du_i = (1 + e) m_j / (m_i + m_j) (u_ij . r) r / |r|^2; the share m_j / (m_i + m_j) is one half between fluid
/// particles and one where j cannot give way (Lee, Park, Kim and Hwang 2011, Comput. Methods Appl. Mech. Eng.
/// 200:1113).
template <class Real>
[[gnu::always_inline]] inline Vec3<Real> collision_term(const Vec3<Real>& velocity_ij, const Vec3<Real>& r,
                                                        const Real& restitution, const Real& share) {
  const Real approach = smaller(dot(velocity_ij, r), Real{});
  return ((1 + restitution) * share * approach / dot(r, r)) * r;
}

/// Solves M x = v where M is invertible enough; false, and x untouched, where det M is below `least` times the
/// determinant of the full lattice, whose matrix is full_diagonal (n0 / 3) times the unit matrix.
template <class Real>
inline bool solve(const Symmetric3<Real>& M, const Vec3<Real>& v, Real full_diagonal, Real least, Vec3<Real>& x) {
  const Real cxx = M.yy * M.zz - M.yz * M.yz;
  const Real cxy = M.xz * M.yz - M.xy * M.zz;
  const Real cxz = M.xy * M.yz - M.xz * M.yy;
  const Real cyy = M.xx * M.zz - M.xz * M.xz;
  const Real cyz = M.xy * M.xz - M.xx * M.yz;
  const Real czz = M.xx * M.yy - M.xy * M.xy;
  const Real det = M.xx * cxx + M.xy * cxy + M.xz * cxz;
  if (!(det > least * full_diagonal * full_diagonal * full_diagonal)) return false;
  x = {(cxx * v.x + cxy * v.y + cxz * v.z) / det, (cxy * v.x + cyy * v.y + cyz * v.z) / det,
       (cxz * v.x + cyz * v.y + czz * v.z) / det};
  return true;
}

}  // namespace sluice::mps
