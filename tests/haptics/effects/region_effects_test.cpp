// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Effects of regions against their closed forms, in a turned region, and through a servo.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <set>

#include "reckon/haptics/contact/static_contact.hpp"
#include "reckon/tests/haptics/support/servo_bench.hpp"
#include "reckon/tests/support/places.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kServoPeriod = 0.001;

/// A region turned and moved in S, and one device in it with enough energy for every force.
class Place {
 public:
  explicit Place(std::optional<Shape> shape = BoxShape{{0.2, 0.2, 0.2}}) {
    region_.name = "region";
    region_.shape = std::move(shape);
    region_.pose.position = {0.3, -0.2, 1.1};
    region_.pose.orientation = Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()));
  }
  DeclaredRegionEffects& effects() { return region_.effects; }
  void begin(const Vector3d& place) {
    Scene scene;
    scene.regions.push_back(region_);
    plan_ = EffectPlan(scene);
    forces_.emplace(plan_, 1e9);
    forces_->reset(in_scene(place));
  }
  /// The whole force in the region's axes [N], after a move to `place`.
  Vector3d move(const Vector3d& place, const Vector3d& velocity = Vector3d::Zero()) {
    for (int i = 0; i < 200; ++i) {  // gains rise
      port_.borrow(10.0);
      forces_->move(in_scene(place), port_);
      forces_->settle(kServoPeriod, port_);
    }
    return load(velocity);
  }
  /// The same after one step, with gains as risen by then.
  Vector3d step(const Vector3d& place) {
    forces_->move(in_scene(place), port_);
    forces_->settle(kServoPeriod, port_);
    return load(Vector3d::Zero());
  }
  [[nodiscard]] double stored() const { return forces_->stored(); }

 private:
  Vector3d load(const Vector3d& velocity) {
    PortLoad load;
    forces_->load(region_.pose.orientation * velocity, kServoPeriod, load);
    return region_.pose.orientation.conjugate() * (load.walls + load.extra + load.shake);
  }
  [[nodiscard]] Vector3d in_scene(const Vector3d& place) const {
    return region_.pose.orientation * place + region_.pose.position;
  }

  SceneRegion region_;
  EffectPlan plan_;
  EnergyPort port_{1.0};
  std::optional<RegionForces> forces_;
};

TEST(RegionTypes, EveryEffectHasAHeaderAndARow) {
  std::set<std::string> headers, rows, keys;
  for (const auto& file :
       std::filesystem::directory_iterator(reckon::test::source_dir() + "/haptics/regions")) {
    const std::string name = file.path().stem().string();
    if (file.path().extension() == ".hpp" && !name.starts_with("region_")) headers.insert(name);
  }
  for_each_region_effect([&]<class Effect>(std::type_identity<Effect>) {
    EXPECT_TRUE(rows.emplace(Effect::kName).second) << Effect::kName;
    EXPECT_TRUE(keys.emplace(Effect::kKey).second) << Effect::kKey;
    const typename Effect::Parameters defaults{};
    for (const auto& row : Effect::kParameters) {
      EXPECT_EQ(defaults.*row.field, row.default_value) << Effect::kName << "." << row.key;
      EXPECT_TRUE(std::string_view(row.help).ends_with('.')) << row.help;
    }
  });
  EXPECT_EQ(headers, rows);
}

struct HalfAPotential {
  [[nodiscard]] double stiffness() const noexcept { return 1.0; }
  [[nodiscard]] Vector3d force(const RegionPoint&) noexcept { return Vector3d::Zero(); }
};
struct MayThrow {
  [[nodiscard]] Vector3d force(const RegionPoint&) { return Vector3d::Zero(); }
};

TEST(RegionHooks, IncompleteOrThrowingHooksAreRejected) {
  EXPECT_TRUE(HookedRegionEffect<HalfAPotential>) << "by its force";
  EXPECT_FALSE(WholeRegionHooks<HalfAPotential>);
  EXPECT_FALSE(WholeRegionHooks<MayThrow>);
  EXPECT_TRUE(WholeRegionHooks<Viscosity> && WholeRegionHooks<PointSpring>);
}

TEST(RegionEffects, ViscosityOpposesMotionInsideOnly) {
  Place place;
  place.effects().declare<Viscosity>() = {4.0, 10.0};
  place.begin({0, 0, 0});
  const Vector3d velocity(0.3, -0.4, 0);
  EXPECT_LT((place.move({0.05, 0, 0}, velocity) + (4.0 + 5.0) * velocity).norm(), 1e-9);
  EXPECT_EQ(place.move({0.11, 0, 0}, velocity), Vector3d::Zero());
}

// The same force at any speed, a hold at rest, and the hysteresis loop between.
TEST(RegionEffects, DryFrictionHoldsAndYields) {
  Place place;
  place.effects().declare<DryFriction>() = {0.6, 300.0};
  place.begin({0, 0, 0});
  EXPECT_NEAR(place.move({0.001, 0, 0}).x(), -0.3, 1e-12);
  EXPECT_NEAR(place.move({0.002, 0, 0}).x(), -0.6, 1e-12);
  EXPECT_NEAR(place.move({0.05, 0, 0}).x(), -0.6, 1e-12);
  EXPECT_NEAR(place.move({0.048, 0, 0}).x(), 0.0, 1e-12);
  EXPECT_NEAR(place.move({0.046, 0, 0}).x(), 0.6, 1e-12);
  EXPECT_NEAR(place.stored(), 0.6 * 0.6 / 600, 1e-12);
}

TEST(RegionEffects, ForcesOfPotentialsAreTheirGradients) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-0.05, 0.05);
  const auto check = [&](auto effect) {
    for (int i = 0; i < 300; ++i) {
      RegionPoint point;
      point.place = {any(random), any(random), any(random)};
      point.beyond = 0.1 * point.place;
      const RegionPotential here = effect.potential(point);
      EXPECT_GE(here.energy, 0.0);
      constexpr double kStep = 1e-6;
      for (int axis = 0; axis < 3; ++axis) {
        RegionPoint up = point, down = point;
        up.place[axis] += kStep;
        down.place[axis] -= kStep;
        const double slope =
            (effect.potential(up).energy - effect.potential(down).energy) / (2 * kStep);
        EXPECT_NEAR(here.force[axis], -slope, 1e-6) << axis;
        const double curved =
            (effect.potential(up).force[axis] - effect.potential(down).force[axis]) / (2 * kStep);
        EXPECT_LE(-curved, here.stiffness * (1 + 1e-6)) << axis;
      }
    }
  };
  check(PointSpring({120.0, 0.0, 3.0}));
  check(Attraction({1.5, 0.06, 0, 0, 0}));
  check(Attraction({1.5, 0.06, 1, 0, 0}));
  // As the border of a ball with a tenth of each position vector outside.
  RegionPoint out;
  out.inside = false;
  out.beyond = {0.002, 0, -0.001};
  const RegionPotential border = BorderSpring({250.0}).potential(out);
  EXPECT_LT((border.force + 250.0 * out.beyond).norm(), 1e-12);
  EXPECT_NEAR(border.energy, 0.5 * 250.0 * 5e-6, 1e-15);
}

TEST(RegionEffects, BorderForceIsTheWayBack) {
  for (const Shape& shape :
       {Shape(SphereShape{0.1}), Shape(BoxShape{{0.2, 0.2, 0.2}}), Shape(PlaneShape{{0, 0, 2}})}) {
    Place place(shape);
    place.effects().declare<BorderSpring>() = {200.0};
    place.begin({0, 0, -0.05});
    const double top = std::holds_alternative<PlaneShape>(shape) ? 0.0 : 0.1;
    EXPECT_EQ(place.move({0, 0, top - 0.02}), Vector3d::Zero());
    EXPECT_LT((place.move({0, 0, top + 0.01}) - Vector3d(0, 0, -2)).norm(), 1e-9);
  }
}

// A lifted load returns its energy; the force is constant on the whole path.
TEST(RegionEffects, ConstantForceStoresTheLiftingWork) {
  Place place(std::nullopt);
  place.effects().declare<ConstantForce>() = {0, 0, -1.5};
  place.begin({0, 0, 0});
  for (const double height : {0.001, 0.004, 0.02, 0.1, 0.03, 0.002, 0.0, -0.05, -0.049}) {
    EXPECT_LT((place.move({0.01, 0, height}) - Vector3d(0, 0, -1.5)).norm(), 1e-9) << height;
  }
  // The energy reference is below the lowest position by the distance over which the force rises.
  const double rise = ConstantForce({0, 0, -1.5}).rise();
  place.move({0, 0, -0.05});
  EXPECT_NEAR(place.stored(), 1.5 * 0.5 * rise, 1e-9);
  place.move({0, 0, 0.05});
  EXPECT_NEAR(place.stored(), 1.5 * (0.1 + 0.5 * rise), 1e-9);
}

TEST(RegionEffects, OscillationBeginsAtTheEntry) {
  Place place;
  place.effects().declare<Oscillation>() = {0.0, 0.5, 0.2, 40.0};
  place.begin({0, 0, 0.3});
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < 7; ++i) EXPECT_EQ(place.step({0, 0, 0.3}), Vector3d::Zero());
    for (int i = 1; i < 80; ++i) {
      const double wave = std::sin(2 * std::numbers::pi * 40.0 * 0.001 * i);
      EXPECT_LT((place.step({0, 0, 0.01}) - wave * Vector3d(0, 0.5, 0.2)).norm(), 1e-9) << i;
    }
  }
}

TEST(RegionEffects, RefuseUnsupportedShapes) {
  Scene scene;
  SceneRegion& region = scene.regions.emplace_back();
  region.name = "hall";
  region.effects.declare<BorderSpring>();
  const auto refusal = [&] {
    try {
      static_cast<void>(EffectPlan(scene));
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal().find("region \"hall\": a region without a shape has no border"),
            std::string::npos);
  region.shape = CylinderShape{};
  EXPECT_NE(refusal().find("a plane, a sphere, a box"), std::string::npos);
  region.shape = SphereShape{0.1};
  EXPECT_EQ(refusal(), "");
}

// Through the servo: a hand that rests in a work space of 100 mm and is led out of it.
TEST(RegionEffects, ServoHoldsAHandInItsWorkSpace) {
  Scene scene;
  SceneRegion& region = scene.regions.emplace_back();
  region.name = "work space";
  region.shape = SphereShape{0.1};
  region.effects.declare<BorderSpring>() = {200.0};
  bench::Bench bench(scene, bench::at(0.0), [](double t) {
    HandTarget hand;
    hand.position.z() = std::min(0.12, 0.1 * t);
    return hand;
  });
  bench.run(std::chrono::seconds(4));
  const double out = bench.servo.snapshots().read().device.z() - 0.1;
  EXPECT_GT(out, 0.001);
  EXPECT_NEAR(bench.device.force().z(), -200.0 * out, 0.02 * 200.0 * out);
  EXPECT_EQ(bench.servo.snapshots().read().mesh_force, bench.device.force());
  EXPECT_GE(bench.least, bench::kPassive);
}

// A weight of 1 N that a hand lifts by 100 mm and lowers again.
TEST(RegionEffects, ServoRendersAWeightUpAndDown) {
  Scene scene;
  SceneRegion& region = scene.regions.emplace_back();
  region.name = "weight";
  region.effects.declare<ConstantForce>() = {0, 0, -1.0};
  bench::Bench bench(scene, bench::at(0.0), [](double t) {
    HandTarget hand;
    hand.position.z() = 0.05 - 0.05 * std::cos(std::numbers::pi * t);
    return hand;
  });
  double least = 10, most = 0;
  for (int i = 0; i < 4000; ++i) {
    bench.run(std::chrono::milliseconds(1));
    const double height = bench.servo.snapshots().read().device.z();
    if (i < 500 || height < 0.01) continue;
    least = std::min(least, -bench.device.force().z());
    most = std::max(most, -bench.device.force().z());
  }
  EXPECT_NEAR(least, 1.0, 0.02);
  EXPECT_NEAR(most, 1.0, 0.02);
  EXPECT_GE(bench.least, bench::kPassive);
}

// With encoder steps a hand comes to rest exactly there, where a spring has a slope and no energy.
TEST(RegionEffects, ServoRendersASpringFromItsMiddle) {
  Scene scene;
  SceneRegion& region = scene.regions.emplace_back();
  region.name = "tether";
  region.shape = SphereShape{0.05};
  region.effects.declare<PointSpring>() = {3000.0};
  bench::Bench bench(scene, bench::at(0.0, 20e-6), [](double t) {
    HandTarget hand;
    hand.position.z() = 0.001 * std::clamp(t - 1.0, 0.0, 1.0);
    return hand;
  });
  bench.run(std::chrono::seconds(1));
  ASSERT_EQ(bench.servo.snapshots().read().device.norm(), 0.0);
  bench.run(std::chrono::seconds(2));
  const ServoSnapshot& last = bench.servo.snapshots().read();
  // A third of the device's wall stiffness.
  EXPECT_NEAR(last.force.z(), -bench.servo.static_stiffness_limit() / 3 * last.device.z(), 1e-3);
  EXPECT_LT(last.force.z(), -0.05);
  EXPECT_EQ(last.trips, 0U);
  EXPECT_GE(bench.least, bench::kPassive);
}

}  // namespace
}  // namespace reckon::haptics
