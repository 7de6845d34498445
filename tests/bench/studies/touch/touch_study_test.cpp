// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Errors of touch against the theory of each axis; and the rule of dominance. No times.
#include "reckon/bench/studies/touch/touch_study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace reckon::bench {
namespace {

using Eigen::Vector3d;

TouchResult result_of(std::string_view name, const TouchConditions& conditions) {
  const auto axes = touch_axes();
  return run_touch_axis(*std::ranges::find(axes, name, &TouchAxis::name), conditions, false);
}

TouchResult result_of(std::string_view name) { return result_of(name, {}); }

std::map<std::string, ForceError> errors_of(const TouchResult& result) {
  std::map<std::string, ForceError> errors;
  for (const TouchRow& row : result.rows) errors[row.setting] = row.error;
  return errors;
}

TEST(TouchError, ErrorUsesTheVectorAndItsThresholds) {
  const std::vector<Vector3d> truth{{1, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  const std::vector<Vector3d> felt{{1, 0.09, 0}, {1, 0.11, 0}, {0, 0.04, 0}, {0, 0, 0.06}};
  const ForceError error = touch_error(truth, felt);
  EXPECT_EQ(error.samples, 4U);
  EXPECT_DOUBLE_EQ(error.noticed, 0.5);
  EXPECT_DOUBLE_EQ(error.max, 0.11);
  EXPECT_NEAR(error.rms, std::sqrt((0.0081 + 0.0121 + 0.0016 + 0.0036) / 4), 1e-15);
  EXPECT_NEAR(error.share, std::sqrt((0.0081 + 0.0121 + 0.0016 + 0.0036) / 2), 1e-15);
}

// Two independent computations: coordinates of all masses, and modes of a projected body.
TEST(TouchOrder, ReducedModelsApproachTheWholeOne) {
  const TouchResult result = result_of("order");
  const auto errors = errors_of(result);
  EXPECT_EQ(errors.at("all 200 states").max, 0);
  EXPECT_LT(errors.at("16 modes").max, 1e-7 * result.largest + 5e-6);
  EXPECT_GT(errors.at("2 modes").p99, 100 * errors.at("4 modes").p99);
  EXPECT_GT(errors.at("4 modes").p99, errors.at("8 modes").p99);
  EXPECT_GT(errors.at("8 modes").p99, errors.at("12 modes").p99);
  EXPECT_GT(errors.at("static").noticed, 0.5) << "inertia of the sheet is felt at 12 Hz";
}

// A flat facet has a direction error of half its angle and a depth error of its sagitta.
TEST(TouchPrecision, TrianglesErrByTheirFacetsOnly) {
  constexpr double kRing = 0.05, kTube = 0.02, kDepth = 0.002, kStiffness = 800;
  const auto errors = errors_of(result_of("precision"));
  EXPECT_LT(errors.at("implicit surface").max, 1e-3);
  double coarser = 0;
  for (const int across : {16, 32, 64, 128, 256}) {
    const int around = across * 5 / 2;
    const ForceError& error = errors.at(std::to_string(2 * around * across) + " triangles");
    const double across_half = std::numbers::pi / across, around_half = std::numbers::pi / around;
    const double direction = std::hypot(across_half, around_half * (kRing + kTube) / kTube);
    const double sagitta =
        0.5 * (kTube * across_half * across_half + (kRing + kTube) * around_half * around_half);
    EXPECT_LT(error.max, kStiffness * (kDepth * direction + 1.5 * sagitta)) << across;
    EXPECT_GT(error.max, 0.3 * kStiffness * kDepth * across_half) << across;
    if (across > 32) {
      EXPECT_NEAR(coarser / error.p99, 2, 0.3) << across;
    }
    coarser = error.p99;
  }
}

TEST(TouchPrecision, SearchThatEndsEarlyErrsMore) {
  const auto errors = errors_of(result_of("precision"));
  double last = 0;
  for (const char* search : {"search to 0 mm", "search to 0.01 mm", "search to 0.1 mm",
                             "search to 0.5 mm", "search to 2 mm"}) {
    EXPECT_GT(errors.at(search).rms, last) << search;
    last = errors.at(search).rms;
  }
}

TEST(TouchIntegrator, EachRuleIsOfFirstOrder) {
  const auto errors = errors_of(result_of("integrator"));
  for (const char* rule :
       {"explicit Euler", "semi-implicit Euler", "exact, held wall", "exact with wall"}) {
    const auto rms = [&](const char* rate) {
      return errors.at(std::string(rule) + ", " + rate + " kHz").rms;
    };
    // Half the step, half the error.
    EXPECT_NEAR(rms("2") / rms("4"), 2, 0.2) << rule;
  }
  for (const char* rate : {", 1 kHz", ", 2 kHz", ", 4 kHz"}) {
    const auto rms = [&](const char* rule) { return errors.at(std::string(rule) + rate).rms; };
    EXPECT_LT(rms("exact with wall"), rms("exact, held wall")) << rate;
    EXPECT_LT(rms("exact, held wall"), rms("explicit Euler")) << rate;
    EXPECT_LT(rms("semi-implicit Euler"), rms("explicit Euler")) << rate;
  }
}

TEST(TouchEffects, OmissionCostsItsContribution) {
  const TouchResult result = result_of("effects");
  const auto errors = errors_of(result);
  EXPECT_EQ(errors.at("all effects").max, 0);
  // At most 3.5 mm deep, 800 N/m: the friction cone holds half of that. Texture and relief are then
  // felt at another place, each at most a tenth of the normal force.
  const ForceError& smooth = errors.at("without stick_slip_friction");
  EXPECT_LT(smooth.max, 0.5 * 0.0035 * 800 + 2 * 0.1 * 0.0035 * 800);
  EXPECT_GT(smooth.p99, 0.35 * 0.003 * 800 * 0.9);
  // 4 N s/m at 0.5 mm and 8 Hz; the filter's velocity lags.
  const double damper = 4 * 0.0005 * 2 * std::numbers::pi * 8;
  EXPECT_NEAR(errors.at("without damper").p99, damper, 0.25 * damper);
  // 800 instead of 400 N/m, friction in proportion.
  EXPECT_NEAR(errors.at("without patch").p99, 400 * 0.0035 * std::hypot(1, 0.35), 0.05);
  EXPECT_GT(errors.at("spring alone").rms, errors.at("without patch").rms);
  // 1 N s/m over the surface at 0.126 m/s, 0.5 N s/m everywhere.
  EXPECT_NEAR(errors.at("without surface_drag").p99, 0.126, 0.03);
  EXPECT_NEAR(errors.at("without viscosity").p99, 0.063, 0.03);
  EXPECT_NEAR(errors.at("without dry_friction").p99, 0.1, 0.005);
  EXPECT_NEAR(errors.at("without constant_force").p99, 0.2, 0.01);
  EXPECT_NEAR(errors.at("without oscillation").max, 0.1, 0.005);
  for (const auto& [name, error] : errors) {
    if (name == "all effects") continue;
    EXPECT_GT(error.max, 0.01) << name;
  }
  EXPECT_GT(errors.at("rate at most 30 N/s").rms, errors.at("rate at most 100 N/s").rms);
}

TEST(TouchCell, TooSmallSensingLosesTheForce) {
  const auto errors = errors_of(result_of("cell"));
  const ForceError& all = errors.at("cells 100 m, sensing 2 m");
  EXPECT_LT(all.rms, 0.3);
  EXPECT_NEAR(errors.at("cells 1 m, sensing 100 mm").rms, all.rms, 0.01);
  EXPECT_NEAR(errors.at("cells 50 mm, sensing 100 mm").rms, all.rms, 0.05);
  // No force at any depth.
  const ForceError& deaf = errors.at("cells 20 mm, sensing 20 mm");
  EXPECT_GT(deaf.rms, 1);
  EXPECT_GT(deaf.noticed, 0.9);
}

TEST(TouchQuantisation, IsWithinTheUnitsOfTheWire) {
  const TouchResult result = result_of("quantisation");
  const auto errors = errors_of(result);
  const double speed = 0.003 * 2 * std::numbers::pi * 2, stiffness = 800.1;
  EXPECT_EQ(errors.at("double").max, 0);
  // Half a unit of 3600 s / 2^31, and a small margin for the acceleration.
  const double unit = 3600.0 / 2147483648.0;
  EXPECT_LE(errors.at("times to 1.68 us only").max, 1.01 * stiffness * speed * unit / 2);
  EXPECT_GT(errors.at("times to 1.68 us only").max, 0.5 * stiffness * speed * unit / 2);
  EXPECT_NEAR(errors.at("times to 1 ms").max, stiffness * speed * 0.00037, 1.5e-3);
  EXPECT_LT(errors.at("fields of the wire only").max, 5e-6);
  EXPECT_LT(errors.at("as on the wire").max, 1.1 * stiffness * speed * unit / 2 + 5e-6);
  // A float32 there has steps of half a metre: the hand is displaced.
  EXPECT_GT(errors.at("location float32, geocentric").max, 1);
}

TEST(TouchOwner, EarlierOwnershipLowersTheError) {
  const auto errors = errors_of(result_of("owner", {.seeds = 3, .delay = 0.05}));
  const auto share = [&](const std::string& touch, const std::string& rule) {
    return errors.at(touch + ", 50 ms, " + rule).share;
  };
  for (const char* touch : {"push", "hold", "catch"}) {
    EXPECT_LT(share(touch, "before touch"), 1e-3) << touch;
    EXPECT_GT(share(touch, "first hand"), 5e-3) << touch;
    EXPECT_LT(share(touch, "first hand"), 0.6 * share(touch, "fixed")) << touch;
  }
  EXPECT_GT(share("push", "fixed"), 0.1);
  // One of the two hands is at the other peer, whoever owns the body.
  for (const char* rule : {"first hand", "before touch"})
    EXPECT_NEAR(share("squeeze", rule), share("squeeze", "fixed"), 0.02) << rule;
}

TEST(TouchOwner, LossRaisesTheForceError) {
  const auto error = [](double loss) {
    const auto errors = errors_of(result_of("owner", {.delay = 0.02, .loss = loss}));
    return errors.at("squeeze, 20 ms, fixed").rms;
  };
  EXPECT_GT(error(0.5), 1.3 * error(0));
}

TEST(TouchStudy, IsReproducibleForASeed) {
  for (const char* axis :
       {"order", "precision", "integrator", "effects", "quantisation", "owner"}) {
    const TouchConditions first{.delay = 0.05}, second{.seed = 2, .delay = 0.05};
    const TouchResult one = result_of(axis, first), again = result_of(axis, first),
                      other = result_of(axis, second);
    bool differs = false;
    for (std::size_t i = 0; i < one.rows.size(); ++i) {
      EXPECT_EQ(one.rows[i].error.rms, again.rows[i].error.rms) << axis;
      EXPECT_EQ(one.rows[i].error.max, again.rows[i].error.max) << axis;
      differs = differs || one.rows[i].error.rms != other.rows[i].error.rms;
    }
    EXPECT_TRUE(differs) << axis;
  }
}

TouchSetting made(const char* name, double error, double ns) {
  TouchSetting setting{name, {}, {}};
  setting.error = ForceError{error, error, error, error, 0, 1};
  setting.cost = {ns, ns, ns};
  return setting;
}

TEST(TouchStudy, SlowerAndLessExactRowsAreDominated) {
  const TouchAxis axis{"made", "made", [](const TouchConditions&) {
                         TouchCase of;
                         of.settings = {
                             made("best", 0.1, 100),           made("slower", 0.1, 150),
                             made("worse", 0.2, 100),          made("alike", 0.1, 105),
                             made("quick and rough", 0.3, 50), made("slow and fine", 0.01, 500)};
                         return of;
                       }};
  const TouchResult result = run_touch_axis(axis, {}, true);
  const auto beaten_by = [&](std::size_t row) {
    const auto& beaten = result.rows[row].beaten;
    return beaten ? result.rows[beaten->by].setting + (beaten->equal ? " =" : "") : "";
  };
  EXPECT_EQ(beaten_by(0), "");
  EXPECT_EQ(beaten_by(1), "best");
  EXPECT_EQ(beaten_by(2), "best");
  EXPECT_EQ(beaten_by(3), "best =") << "5 % of time is no difference";
  EXPECT_EQ(beaten_by(4), "");
  EXPECT_EQ(beaten_by(5), "");
}

TEST(TouchStudy, RowsOfOtherDelaysDoNotDominate) {
  const TouchAxis axis{"made", "made", [](const TouchConditions&) {
                         TouchCase of;
                         of.settings = {made("near", 0.1, 100), made("far", 0.2, 100),
                                        made("far, other rule", 0.3, 100)};
                         of.settings[0].delayed = DelayedTouch{"push", "one", 0.01};
                         of.settings[1].delayed = DelayedTouch{"push", "one", 0.05};
                         of.settings[2].delayed = DelayedTouch{"push", "other", 0.05};
                         return of;
                       }};
  const TouchResult result = run_touch_axis(axis, {}, true);
  EXPECT_FALSE(result.rows[0].beaten);
  EXPECT_FALSE(result.rows[1].beaten);
  ASSERT_TRUE(result.rows[2].beaten);
  EXPECT_EQ(result.rows[2].beaten->by, 1U);
}

TEST(TouchStudy, SeedsGiveMedianAndWorst) {
  const TouchAxis axis{"made", "made", [](const TouchConditions& conditions) {
                         TouchCase of;
                         of.settings = {made("one", 0, 1)};
                         of.settings[0].error->share = conditions.seed == 5 ? 0.9 : 0.1;
                         if (conditions.seed == 6) of.settings[0].error->share = 0.2;
                         return of;
                       }};
  const TouchResult result = run_touch_axis(axis, {.seed = 4, .seeds = 3}, false);
  EXPECT_EQ(result.rows[0].error.share, 0.2);
  EXPECT_EQ(result.rows[0].worst, 0.9);
}

}  // namespace
}  // namespace reckon::bench
