// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sequences of pointer samples for tests, usual and hostile ones: one for each seed.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <ostream>
#include <random>

#include "reckon/haptics/devices/pointer_inbox.hpp"

namespace reckon::haptics {

/// The samples of one seed, whose kind is the seed modulo kKinds: jumps over the whole screen; one
/// sample a second; one a millisecond; pauses of up to 0.9 s; NaN, infinities and huge numbers; ten
/// at one instant; out of order; a button that is released and pressed again; or each time one of
/// these at random.
class PointerPlay {
 public:
  enum class Kind : std::uint8_t {
    jumps,
    once_a_second,
    each_millisecond,
    stalls,
    hostile,
    bursts,
    backwards,
    let_go,
    all
  };
  static constexpr unsigned kKinds = 9;

  explicit PointerPlay(unsigned seed) : random_(seed), kind_(static_cast<Kind>(seed % kKinds)) {
    from_ = point();
    to_ = point();
  }

  /// Calls put(PointerSample) for each sample that is due in this millisecond.
  template <class Put>
  void at(int ms, Put&& put) {
    if (ms < next_) return;
    const Kind kind = kind_ == Kind::all ? static_cast<Kind>(random_() % (kKinds - 1)) : kind_;
    switch (kind) {
      case Kind::jumps:
        put(PointerSample{point(), true});
        return wait(ms, 17);
      case Kind::once_a_second:
        put(PointerSample{point(), true});
        return wait(ms, kind_ == Kind::all ? 200 : 1000);
      case Kind::each_millisecond:
        put(PointerSample{point(), true});
        return wait(ms, 1);
      case Kind::stalls:
        put(PointerSample{point(), true});
        return wait(ms, unit() < 0.1 ? 50 + static_cast<int>(850 * unit()) : 16);
      case Kind::hostile:
        put(PointerSample{hostile_point(), unit() < 0.95});
        return wait(ms, 17);
      case Kind::bursts:
        for (int i = 0; i < 10; ++i) put(PointerSample{point(), true});
        return wait(ms, 1 + static_cast<int>(100 * unit()));
      case Kind::backwards:
        put(PointerSample{overtaken(), true});
        return wait(ms, 16);
      case Kind::let_go:
      case Kind::all:
        put(PointerSample{point(), unit() < 0.7});
        return wait(ms, 17 + static_cast<int>(100 * unit()));
    }
  }

 private:
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  void wait(int ms, int for_ms) { next_ = ms + for_ms; }

  /// A random point [m]: on a screen of 0.6 m, or, one in twenty, up to 50 m away.
  Eigen::Vector3d point() {
    const double half = unit() < 0.05 ? 50.0 : 0.3;
    return half * Eigen::Vector3d(2 * unit() - 1, 2 * unit() - 1, 2 * unit() - 1);
  }

  Eigen::Vector3d hostile_point() {
    using Limits = std::numeric_limits<double>;
    constexpr std::array kHostile{Limits::quiet_NaN(),
                                  Limits::infinity(),
                                  -Limits::infinity(),
                                  1e300,
                                  -1e300,
                                  Limits::max(),
                                  Limits::denorm_min(),
                                  -0.0};
    Eigen::Vector3d p = point();
    if (unit() < 0.5) p(random_() % 3) = kHostile[random_() % kHostile.size()];
    return p;
  }

  /// The next point of a straight stroke of 32; each four come in reverse order.
  Eigen::Vector3d overtaken() {
    const double way = static_cast<double>(sent_ ^ 3U) / 31.0;
    if (++sent_ == 32) {
      sent_ = 0;
      from_ = to_;
      to_ = point();
    }
    return from_ + way * (to_ - from_);
  }

  std::mt19937 random_;
  Kind kind_;
  int next_ = 0;
  unsigned sent_ = 0;
  Eigen::Vector3d from_, to_;
};

}  // namespace reckon::haptics
