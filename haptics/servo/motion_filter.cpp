// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/motion_filter.hpp"

#include <cmath>

namespace reckon::haptics {
namespace {

constexpr std::size_t kShortest = 8;  // samples of the shortest window
// Rounding of a determinant, relative to the product of the matrix's diagonal.
constexpr double kRounding = 1e-14;

}  // namespace

[[gnu::always_inline]] inline void MotionFilter::Sums::add(const Row& row) noexcept {
  const double t = row[kTime];
  const Row by_time = t * row;
  zeroth += row;
  first += by_time;
  second += t * by_time;
  squares += row * row;
  fourth += (t * t) * (t * t);
}

[[gnu::always_inline]] inline void MotionFilter::Sums::add(const Sums& other) noexcept {
  zeroth += other.zeroth;
  first += other.first;
  second += other.second;
  squares += other.squares;
  fourth += other.fourth;
}

void MotionFilter::add(const Eigen::Vector3d& position, double time) noexcept {
  if (!position.allFinite() || !std::isfinite(time)) return;
  if (count_ > 0 && !(time > samples_[newest_][kTime])) return;
  take({position.x(), position.y(), position.z(), time});
  whole_ = count_ < 3 ? Parabola{} : fit(count_);
}

Eigen::Vector3d MotionFilter::velocity() const noexcept {
  const double now = samples_[newest_][kTime] - origin_[kTime];
  const auto slope = [now](const Parabola& parabola) -> Eigen::Vector3d {
    return parabola.linear.head<3>() + 2.0 * now * parabola.quadratic.head<3>();
  };
  if (count_ / 2 < kShortest || fits(whole_, count_)) return slope(whole_);
  std::size_t window = count_ / 2;
  Parabola parabola = fit(window);
  while (window / 2 >= kShortest && !fits(parabola, window)) {
    window /= 2;
    parabola = fit(window);
  }
  return slope(parabola);
}

void MotionFilter::take(const Row& sample) noexcept {
  newest_ = count_ == 0 ? 0 : (newest_ + 1) % kWindow;
  samples_[newest_] = sample;
  const bool first = count_ == 0;
  if (count_ < kWindow) ++count_;
  if (first || ++since_ == kShortest) {
    restart_sums();
  } else {
    after_.add(from_origin(0));
  }
}

// The sums only ever grow by one sample, and are restarted before the origin leaves a window.
// Nothing is subtracted, so no rounding error accumulates.
void MotionFilter::restart_sums() noexcept {
  origin_ = samples_[newest_];
  since_ = 0;
  after_ = Sums{};
  Sums sums;
  for (std::size_t age = 0; age < count_; ++age) {
    sums.add(from_origin(age));
    up_to_[age + 1] = sums;
  }
}

// Solves the normal equations by cofactors. Every product in them has the same power of time, so
// that their conditioning does not depend on the unit of time.
MotionFilter::Parabola MotionFilter::fit(std::size_t count) const noexcept {
  Parabola out;
  Sums& s = out.sums;
  s = up_to_[count - since_];
  s.add(after_);
  const double m0 = static_cast<double>(count);
  const double m1 = s.zeroth[kTime];
  const double m2 = s.first[kTime];
  const double m3 = s.second[kTime];
  const double m4 = s.fourth;
  const double a00 = m2 * m4 - m3 * m3;
  const double a01 = m2 * m3 - m1 * m4;
  const double a02 = m1 * m3 - m2 * m2;
  const double a11 = m0 * m4 - m2 * m2;
  const double a12 = m1 * m2 - m0 * m3;
  const double a22 = m0 * m2 - m1 * m1;
  const double determinant = m0 * a00 + m1 * a01 + m2 * a02;
  const double rounding = kRounding * (m0 * m2 * m4);
  if (!(determinant > 10.0 * rounding)) return out;
  const double inverse = 1.0 / determinant;
  out.constant =
      (inverse * a00) * s.zeroth + (inverse * a01) * s.first + (inverse * a02) * s.second;
  out.linear = (inverse * a01) * s.zeroth + (inverse * a11) * s.first + (inverse * a12) * s.second;
  out.quadratic =
      (inverse * a02) * s.zeroth + (inverse * a12) * s.first + (inverse * a22) * s.second;
  out.rounding = inverse * rounding;
  return out;
}

// The largest residual lies between the mean and the sum of the residuals. The samples are examined
// one by one only if these bounds do not decide.
bool MotionFilter::fits(const Parabola& parabola, std::size_t count) const noexcept {
  if (parabola.rounding <= 0) return false;
  const Sums& s = parabola.sums;
  const Row a = parabola.constant * s.zeroth;
  const Row b = parabola.linear * s.first;
  const Row c = parabola.quadratic * s.second;
  const Row together = s.squares - a - b - c;
  const Row unsure = parabola.rounding * (s.squares + a.abs() + b.abs() + c.abs());
  const double limit = tolerance_ * tolerance_;
  if ((together + unsure).head<3>().maxCoeff() <= limit) return true;
  const double most = static_cast<double>(count) * limit;
  if ((together - unsure).head<3>().maxCoeff() > most) return false;
  return each_fits(parabola, count);
}

bool MotionFilter::each_fits(const Parabola& parabola, std::size_t count) const noexcept {
  Row worst = Row::Zero();
  for (std::size_t age = 0; age < count; ++age) {
    const Row row = from_origin(age);
    const double t = row[kTime];
    const Row miss = row - parabola.constant - t * (parabola.linear + t * parabola.quadratic);
    worst = worst.max(miss.abs());
  }
  return worst.head<3>().maxCoeff() <= tolerance_;
}

}  // namespace reckon::haptics
