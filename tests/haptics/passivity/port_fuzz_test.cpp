// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An energy port in three dimensions under random updates of hostile peers.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "reckon/haptics/passivity/contact_spring.hpp"
#include "reckon/haptics/passivity/energy_port.hpp"
#include "reckon/tests/haptics/support/plane_surface.hpp"
#include "reckon/tests/haptics/support/port_meter.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/reference_data.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using meters::cap_of;
using meters::kPassive;
using meters::kT;
using meters::Meter;
using test::plane;
using Kind = pdu::ForceModelKind;

// A random walk of a hand against a random history of surfaces of every kind.
class PortFuzz {
 public:
  explicit PortFuzz(unsigned seed)
      : rng_(seed), b_(0.2 + 2 * unit()), count_(1 + seed % 4), port_(b_) {
    for (ContactSpring& spring : springs_) spring.reset(x_);
  }

  void run(int steps) {
    velocity_ = 0.3 * direction();
    for (int i = 0; i < steps; ++i) step();
  }

  Meter meter;
  double peak = 0, purse = 0;
  bool finite = true;

 private:
  double unit() { return std::uniform_real_distribution<double>(0, 1)(rng_); }
  Vector3d direction() { return Vector3d(unit() - 0.5, unit() - 0.5, unit() - 0.5).normalized(); }

  ContactParameters surface() {
    static constexpr Kind kinds[] = {
        Kind::sphere, Kind::sphere, Kind::plane, Kind::field, Kind::spring_damper_region,
        Kind::none};
    ContactParameters theta;
    theta.kind = unit() < 0.9 ? goal_.kind : kinds[static_cast<int>(6 * unit())];
    theta.point = x_ + 0.02 * direction();
    theta.normal = direction();
    theta.reach = 0.04 * unit();
    theta.patch = 0.03 * unit();
    theta.k1 = 3000 * unit();
    theta.k3 = unit() < 0.5 ? 0 : 1e8 * unit();
    theta.static_friction = unit();
    theta.kinetic_friction = theta.static_friction * unit();
    theta.gain = unit() < 0.8 ? 1 : unit();
    theta.slope_limit = cap_of(b_) * unit();
    theta.force_limit = unit() < 0.8 ? 10 : 3 * unit();
    return theta;
  }

  ContactParameters poisoned(ContactParameters theta) {
    const double bad[] = {std::nan(""), std::numeric_limits<double>::infinity(), -300.0, 1e300};
    const double value = bad[static_cast<int>(4 * unit())];
    double* const fields[] = {&theta.k1,        &theta.k3,         &theta.reach,
                              &theta.point.y(), &theta.normal.z(), &theta.static_friction};
    *fields[static_cast<int>(6 * unit())] = value;
    return theta;
  }

  void update(ContactSpring& spring) {
    if (unit() < 0.02) older_ = goal_;
    if (unit() < 0.02) goal_ = surface();
    if (unit() < 0.005) goal_.point += direction();  // jumps 1 m
    if (unit() < 0.005) std::swap(goal_, older_);    // arrives out of order
    goal_.point += 2e-4 * direction();
    spring.move(unit() < 0.02 ? poisoned(goal_) : goal_);
  }

  PortLoad load() {
    PortLoad load;
    Eigen::Matrix3d slopes = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < count_; ++i) {
      load.springs += springs_[i].force();
      load.stored += springs_[i].stored();
      slopes += springs_[i].slope();
    }
    load.springs_slope = slopes.eigenvalues().real().maxCoeff();
    load.extra = unit() < 0.5 ? Vector3d(0, 0, 0) : Vector3d(4 * unit() * direction());
    return load;
  }

  void step() {
    for (std::size_t i = 0; i < count_; ++i) update(springs_[i]);
    if (unit() < 0.01) meter.absorbed += port_.credit(0.03 * unit());
    if (unit() < 0.01) meter.absorbed -= port_.give(0.03 * unit());
    Vector3d force = port_.hold(load(), kT).force;
    if (unit() < 0.01) {
      const double keep = unit();
      port_.attenuate(keep);
      force *= keep;
    }
    finite = finite && force.allFinite();
    peak = std::max(peak, force.norm());
    velocity_ += 0.02 * direction() - 0.5 * x_ * kT * 400;
    if (unit() < 0.01) velocity_ = 0.4 * unit() * direction();
    Vector3d dx = velocity_ * kT;
    // Now and then the motion that takes most energy out of a held force.
    if (unit() < 0.2) dx = force / (2 * b_ / kT);
    meter.move(force, dx, b_);
    x_ += dx;
    port_.settle(dx, kT);
    for (std::size_t i = 0; i < count_; ++i) springs_[i].settle(x_, 0.001);
    meter.check(port_);
    purse = std::min(purse, port_.level());
  }

  std::mt19937 rng_;
  double b_;
  std::size_t count_;
  EnergyPort port_;
  std::array<ContactSpring, 4> springs_;
  ContactParameters goal_, older_;
  Vector3d x_ = Vector3d::Zero(), velocity_ = Vector3d::Zero();
};

TEST(EnergyPort, StaysPassiveUnderRandomHostileUpdates) {
  double least = 0, surplus = 0, peak = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    PortFuzz fuzz(seed);
    fuzz.run(5000);
    ASSERT_TRUE(fuzz.finite) << "seed " << seed;
    ASSERT_GE(fuzz.meter.least, kPassive) << "seed " << seed;
    ASSERT_GE(fuzz.meter.surplus, kPassive) << "seed " << seed;
    ASSERT_GE(fuzz.purse, -1e-12) << "seed " << seed;
    surplus = std::min(surplus, fuzz.meter.surplus);
    least = std::min(least, fuzz.meter.least);
    peak = std::max(peak, fuzz.peak);
  }
  std::printf("200 seeds x 5000 steps: least energy %.2g J, least surplus %.2g J, peak %.1f N\n",
              least, surplus, peak);
}

TEST(EnergyPort, AllocatesNothing) {
  PortFuzz fuzz(3);
  const test::AllocationGuard guard;
  fuzz.run(1000);
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::haptics
