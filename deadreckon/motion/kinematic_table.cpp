// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/kinematic_table.hpp"

#include <algorithm>
#include <cassert>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/turn_series.hpp"

// One binary for every x86-64: the loop exists three times and the loader picks.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RECKON_FOR_EACH_VECTOR_UNIT [[gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define RECKON_FOR_EACH_VECTOR_UNIT
#endif

// Columns never overlap, which the compiler cannot see.
#if defined(__GNUC__) && !defined(__clang__)
#define RECKON_COLUMNS_ARE_APART _Pragma("GCC ivdep")
#else
#define RECKON_COLUMNS_ARE_APART
#endif

namespace reckon::deadreckon {
namespace {

// Columns of a KinematicTable.
enum In {
  kX,
  kY,
  kZ,
  kQw,
  kQx,
  kQy,
  kQz,
  kVx,
  kVy,
  kVz,
  kAx,
  kAy,
  kAz,
  kWx,
  kWy,
  kWz,
  kTime,
  kBody
};

// Rows at a time: all columns of a chunk stay in the first-level cache.
constexpr std::size_t kChunk = 64;

struct Pointers {
  std::array<const double*, KinematicTable::kColumns> in;
  std::array<double*, PoseTable::kColumns> out;
};

// Rows [begin, end), at most kChunk of them; far[i] is set where |w t| is past the series.
RECKON_FOR_EACH_VECTOR_UNIT
void extrapolate_rows(const Pointers& table, std::size_t begin, std::size_t end, double now,
                      double* __restrict far) {
  const double* const x = table.in[kX] + begin;
  const double* const y = table.in[kY] + begin;
  const double* const z = table.in[kZ] + begin;
  const double* const qw = table.in[kQw] + begin;
  const double* const qx = table.in[kQx] + begin;
  const double* const qy = table.in[kQy] + begin;
  const double* const qz = table.in[kQz] + begin;
  const double* const vx = table.in[kVx] + begin;
  const double* const vy = table.in[kVy] + begin;
  const double* const vz = table.in[kVz] + begin;
  const double* const ax = table.in[kAx] + begin;
  const double* const ay = table.in[kAy] + begin;
  const double* const az = table.in[kAz] + begin;
  const double* const wx = table.in[kWx] + begin;
  const double* const wy = table.in[kWy] + begin;
  const double* const wz = table.in[kWz] + begin;
  const double* const time = table.in[kTime] + begin;
  const double* const body = table.in[kBody] + begin;
  double* const out_x = table.out[0] + begin;
  double* const out_y = table.out[1] + begin;
  double* const out_z = table.out[2] + begin;
  double* const out_qw = table.out[3] + begin;
  double* const out_qx = table.out[4] + begin;
  double* const out_qy = table.out[5] + begin;
  double* const out_qz = table.out[6] + begin;
  double* const out_vx = table.out[7] + begin;
  double* const out_vy = table.out[8] + begin;
  double* const out_vz = table.out[9] + begin;
  double* const out_wx = table.out[10] + begin;
  double* const out_wy = table.out[11] + begin;
  double* const out_wz = table.out[12] + begin;
  const std::size_t rows = end - begin;

  RECKON_COLUMNS_ARE_APART
  for (std::size_t i = 0; i < rows; ++i) {
    double t = now - time[i];
    t = t == t ? t : 0.0;
    t = t < kLongestExtrapolation ? t : kLongestExtrapolation;
    t = t > -kLongestExtrapolation ? t : -kLongestExtrapolation;

    // r = w t, and its part in the way: none where the axes of v and a do not turn.
    const double rx = t * wx[i], ry = t * wy[i], rz = t * wz[i];
    const double square = rx * rx + ry * ry + rz * rz;
    far[i] = square;
    const double b = body[i];
    const double tx = b * rx, ty = b * ry, tz = b * rz;
    const TurnTerms turn = series_terms(square);
    const double f1 = b * (turn.f1 - 1.0) + 1.0;
    const double f2 = b * (turn.f2 - 0.5) + 0.5;

    // Way = t (f1 v + h1 r x v + g1 (r.v) r) + t^2 (f2 a + h2 r x a + g2 (r.a) r).
    const double dot_v = turn.g1 * (tx * vx[i] + ty * vy[i] + tz * vz[i]);
    const double dot_a = turn.g2 * (tx * ax[i] + ty * ay[i] + tz * az[i]);
    const double tt = t * t;
    const double sx = t * (f1 * vx[i] + turn.h1 * (ty * vz[i] - tz * vy[i]) + dot_v * tx) +
                      tt * (f2 * ax[i] + turn.h2 * (ty * az[i] - tz * ay[i]) + dot_a * tx);
    const double sy = t * (f1 * vy[i] + turn.h1 * (tz * vx[i] - tx * vz[i]) + dot_v * ty) +
                      tt * (f2 * ay[i] + turn.h2 * (tz * ax[i] - tx * az[i]) + dot_a * ty);
    const double sz = t * (f1 * vz[i] + turn.h1 * (tx * vy[i] - ty * vx[i]) + dot_v * tz) +
                      tt * (f2 * az[i] + turn.h2 * (tx * ay[i] - ty * ax[i]) + dot_a * tz);

    // The way in reference axes: turned by q where it was in body axes (2 w (u x s) + 2 u x (u x
    // s)).
    const double ux = b * qx[i], uy = b * qy[i], uz = b * qz[i], uw = qw[i];
    const double cx = 2.0 * (uy * sz - uz * sy);
    const double cy = 2.0 * (uz * sx - ux * sz);
    const double cz = 2.0 * (ux * sy - uy * sx);
    out_x[i] = x[i] + (sx + uw * cx + (uy * cz - uz * cy));
    out_y[i] = y[i] + (sy + uw * cy + (uz * cx - ux * cz));
    out_z[i] = z[i] + (sz + uw * cz + (ux * cy - uy * cx));

    // q exp(r / 2).
    const double c = turn.half_cosine, s = turn.half_sine_over_angle;
    const double ex = s * rx, ey = s * ry, ez = s * rz;
    const double nw = qw[i] * c - qx[i] * ex - qy[i] * ey - qz[i] * ez;
    const double nx = qw[i] * ex + qx[i] * c + qy[i] * ez - qz[i] * ey;
    const double ny = qw[i] * ey + qy[i] * c + qz[i] * ex - qx[i] * ez;
    const double nz = qw[i] * ez + qz[i] * c + qx[i] * ey - qy[i] * ex;
    out_qw[i] = nw;
    out_qx[i] = nx;
    out_qy[i] = ny;
    out_qz[i] = nz;

    // Velocity v + a t, turned by the new orientation where it is in body axes.
    const double px = vx[i] + t * ax[i], py = vy[i] + t * ay[i], pz = vz[i] + t * az[i];
    const double mx = b * nx, my = b * ny, mz = b * nz;
    const double dx = 2.0 * (my * pz - mz * py);
    const double dy = 2.0 * (mz * px - mx * pz);
    const double dz = 2.0 * (mx * py - my * px);
    out_vx[i] = px + nw * dx + (my * dz - mz * dy);
    out_vy[i] = py + nw * dy + (mz * dx - mx * dz);
    out_vz[i] = pz + nw * dz + (mx * dy - my * dx);
    out_wx[i] = wx[i];
    out_wy[i] = wy[i];
    out_wz[i] = wz[i];
  }
}

void put(const Pointers& table, std::size_t row, const Pose& pose) {
  const auto& q = pose.orientation;
  const std::array<double, PoseTable::kColumns> values{pose.position.x(),
                                                       pose.position.y(),
                                                       pose.position.z(),
                                                       q.w(),
                                                       q.x(),
                                                       q.y(),
                                                       q.z(),
                                                       pose.velocity.x(),
                                                       pose.velocity.y(),
                                                       pose.velocity.z(),
                                                       pose.angular_velocity.x(),
                                                       pose.angular_velocity.y(),
                                                       pose.angular_velocity.z()};
  for (std::size_t i = 0; i < values.size(); ++i) table.out[i][row] = values[i];
}

}  // namespace

Pose PoseTable::pose(std::size_t row) const noexcept {
  const auto c = [&](std::size_t i) { return columns_.data(i)[row]; };
  return {{c(0), c(1), c(2)}, {c(3), c(4), c(5), c(6)}, {c(7), c(8), c(9)}, {c(10), c(11), c(12)}};
}

void KinematicTable::resize(std::size_t rows) {
  std::array<double, kColumns> fresh{};
  fresh[kQw] = 1.0;
  columns_.resize(rows, fresh);
}

void KinematicTable::set(std::size_t row, const KinematicState& state, double time) noexcept {
  assert(row < size());
  const DrmTerms terms = drm_terms(state.algorithm);
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const Eigen::Vector3d v = terms.velocity ? state.velocity : zero;
  const Eigen::Vector3d a = terms.acceleration ? state.acceleration : zero;
  const Eigen::Vector3d w = terms.rotation ? state.angular_velocity : zero;
  const auto& p = state.position;
  const auto& q = state.orientation;
  const std::array<double, kColumns> values{
      p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z(), v.x(), v.y(),
      v.z(), a.x(), a.y(), a.z(), w.x(), w.y(), w.z(), time,  terms.body_axes ? 1.0 : 0.0};
  for (std::size_t i = 0; i < kColumns; ++i) columns_.data(i)[row] = values[i];
}

KinematicState KinematicTable::state(std::size_t row) const noexcept {
  const auto c = [&](std::size_t i) { return columns_.data(i)[row]; };
  using Algorithm = pdu::DeadReckoningAlgorithm;
  return {c(kBody) != 0 ? Algorithm::rvb : Algorithm::rvw,
          {c(kX), c(kY), c(kZ)},
          {c(kQw), c(kQx), c(kQy), c(kQz)},
          {c(kVx), c(kVy), c(kVz)},
          {c(kAx), c(kAy), c(kAz)},
          {c(kWx), c(kWy), c(kWz)}};
}

void KinematicTable::extrapolate(double now, PoseTable& out) const noexcept {
  assert(out.size() == size());
  Pointers table{};
  for (std::size_t i = 0; i < kColumns; ++i) table.in[i] = columns_.data(i);
  for (std::size_t i = 0; i < PoseTable::kColumns; ++i) table.out[i] = out.data(i);
  std::array<double, kChunk> far;
  for (std::size_t begin = 0; begin < size(); begin += kChunk) {
    const std::size_t end = std::min(begin + kChunk, size());
    extrapolate_rows(table, begin, end, now, far.data());
    for (std::size_t row = begin; row < end; ++row)
      if (!(far[row - begin] < kSeriesAngle * kSeriesAngle))
        put(table, row, deadreckon::extrapolate(state(row), now - columns_.data(kTime)[row]));
  }
}

}  // namespace reckon::deadreckon
