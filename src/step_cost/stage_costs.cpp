// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/step_cost/stage_costs.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "reckon/haptics/contact/static_contact.hpp"

namespace reckon::peer {
namespace {

using Eigen::Vector3d;
using haptics::EffectPlan;
using haptics::PlannedObject;
using haptics::PlannedRegion;

constexpr double kPeriod = 0.001;  // [s]
constexpr double kDamping = 1.0;   // [N s/m], of the device
constexpr double kDepth = 0.001;   // [m]
constexpr int kSteps = 1000, kRuns = 5;
constexpr double kMostRun = 0.02;    // [s], after which a run ends with fewer steps
constexpr double kMostSearch = 0.5;  // [s], of measure_dearest_step()
constexpr int kBatch = 10;           // steps between two looks at the clock
constexpr int kFewSteps = 50;

double thread_seconds() {
  timespec spent{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent);
  return static_cast<double>(spent.tv_sec) + 1e-9 * static_cast<double>(spent.tv_nsec);
}

/// One device on a plan, moved around a place.
class Stroke {
 public:
  Stroke(const EffectPlan& plan, double radius)
      : contact_(plan, 0.75 * 0.95 * 2.0 * kDamping / kPeriod, radius) {}

  [[nodiscard]] bool touches(const Vector3d& device) {
    step(device);
    return contact_.result().in_contact;
  }
  void begin(const Vector3d& device) {
    tool_.reset({device});
    contact_.reset(tool_);
  }
  /// CPU of a step [s], the least of some runs.
  double time_round(const Vector3d& place) {
    double least = std::numeric_limits<double>::infinity();
    for (int run = 0; run < kRuns; ++run) least = std::min(least, time_run(place, kSteps));
    return least;
  }
  /// CPU of a step [s], the mean of one run.
  double time_run(const Vector3d& place, int most_steps) {
    const double begin = thread_seconds();
    double spent = 0.0;
    int steps = 0;
    while (steps < most_steps && spent < kMostRun) {
      for (int i = 0; i < kBatch; ++i) go_round(place, steps++);
      spent = thread_seconds() - begin;
    }
    return spent / steps;
  }

 private:
  void go_round(const Vector3d& place, int i) {
    const double turn = 0.02 * i;
    step(place + 5e-4 * Vector3d(std::cos(turn), std::sin(turn), std::sin(1.3 * turn)));
  }
  void step(const Vector3d& device) {
    const Vector3d dx = device - last_;
    last_ = device;
    tool_.move({device});
    tool_.set_velocity(dx / kPeriod);
    port_.settle(dx, kPeriod);
    contact_.settle(tool_, kPeriod, port_);
    haptics::PortLoad load;
    contact_.load(tool_, kPeriod, load);
    const haptics::PortHold held = port_.hold(load, kPeriod);
    if (held.walls < 1.0) contact_.attenuate(held.walls, port_);
    contact_.shown(held.extra);
  }

  haptics::StaticContact contact_;
  haptics::PointTool tool_;
  haptics::EnergyPort port_{kDamping};
  Vector3d last_ = Vector3d::Zero();
};

/// A place kDepth inside an object, from outside it; none if none is found.
std::optional<Vector3d> place_inside(const PlannedObject& object, double radius) {
  const EffectPlan plan({object}, {});
  const bool bounded = object.bounds.sizes().allFinite() && object.bounds.sizes().norm() < 1e6;
  const Vector3d centre = bounded ? Vector3d(object.bounds.center()) : object.position;
  const double reach = radius + (bounded ? 0.55 * object.bounds.sizes().norm() : 0.05);
  for (int way = 0; way < 27; ++way) {
    const Vector3d from = Vector3d(way % 3 - 1, way / 3 % 3 - 1, 1 - way / 9).stableNormalized();
    if (from.isZero()) continue;
    Stroke stroke(plan, radius);
    stroke.begin(centre + reach * from);
    if (stroke.touches(centre + reach * from)) continue;
    const double stride = std::max(reach / 500, 2e-5);
    for (double left = reach; left > -reach; left -= stride)
      if (stroke.touches(centre + left * from)) return centre + (left - kDepth) * from;
  }
  return std::nullopt;
}

double time_plan(const EffectPlan& plan, const Vector3d& outside, const Vector3d& place,
                 double radius) {
  Stroke stroke(plan, radius);
  stroke.begin(outside);
  return stroke.time_round(place);
}

/// An object's or region's effects, of which only some are declared.
template <class Types, class... Kept>
haptics::EffectDeclarations<Types> only(const haptics::EffectDeclarations<Types>& all) {
  haptics::EffectDeclarations<Types> some;
  haptics::for_each_effect<Types>([&]<class Effect>(std::type_identity<Effect>) {
    constexpr bool kKept = haptics::AlwaysThere<Effect> || (std::is_same_v<Effect, Kept> || ...);
    if constexpr (kKept) {
      if (const auto* values = all.template find<Effect>())
        some.template declare<Effect>() = *values;
    }
  });
  return some;
}

/// Adds the stages of one object, in the same form as EffectPlan::stages().
class Measurement {
 public:
  Measurement(const haptics::Scene& scene, const EffectPlan& plan, double radius)
      : scene_(scene), plan_(plan), radius_(radius) {
    costs_.empty = time_plan(EffectPlan(), Vector3d::Zero(), Vector3d::Zero(), radius_);
  }

  void add_object(std::size_t index) {
    const PlannedObject& planned = plan_.objects()[index];
    const haptics::DeclaredEffects& declared = scene_.objects[index].effects;
    const auto place =
        index < kMostMeasured ? place_inside(planned, radius_) : std::optional<Vector3d>();
    const auto time = [&](const haptics::DeclaredEffects& effects) {
      PlannedObject copy = planned;
      copy.effects = haptics::PlannedEffects(effects);
      const EffectPlan plan({std::move(copy)}, {});
      return time_plan(plan, *place + 10.0 * (*place - planned.position), *place, radius_);
    };
    const double contact = place ? time(only<haptics::EffectTypes>(declared)) : kUnknown;
    add(place ? contact - costs_.empty : kUnknown);
    const std::size_t patches = planned.patches ? planned.patches->patches.size() - 1 : 0;
    for (std::size_t i = 0; i < patches; ++i) add(kUnknown);
    double sum = contact;
    for (int turn = 0; turn < haptics::kTurns; ++turn) {
      haptics::for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
        if (haptics::kHooks<Effect>.turn() != turn) return;
        if (planned.effects.find<Effect>() == nullptr) return;
        if (!place || haptics::AlwaysThere<Effect> || declared.find<Effect>() == nullptr)
          return add(kUnknown);
        const double cost = time(only<haptics::EffectTypes, Effect>(declared)) - contact;
        add(std::max(cost, 0.0));
        sum += std::max(cost, 0.0);
      });
    }
    if (place && sum > costs_.dearest) {
      costs_.dearest = sum;
      costs_.dearest_object = planned.name;
    }
  }

  void add_region(std::size_t index) {
    const PlannedRegion& planned = plan_.regions()[index];
    const haptics::DeclaredRegionEffects& declared = scene_.regions[index].effects;
    const auto time = [&](const haptics::DeclaredRegionEffects& effects) {
      PlannedRegion copy = planned;
      copy.effects = haptics::PlannedRegionEffects(effects);
      return time_plan(EffectPlan({}, {std::move(copy)}), planned.position, planned.position,
                       radius_);
    };
    const double bare = time({});
    add(std::max(bare - costs_.empty, 0.0));
    regions_ += costs_.stages.back();
    haptics::for_each_region_effect([&]<class Effect>(std::type_identity<Effect>) {
      if (declared.find<Effect>() == nullptr) return;
      add(std::max(time(only<haptics::RegionTypes, Effect>(declared)) - bare, 0.0));
      regions_ += costs_.stages.back();
    });
  }

  [[nodiscard]] StageCosts costs() const {
    StageCosts costs = costs_;
    costs.dearest = std::max(costs.dearest, costs.empty) + regions_;
    return costs;
  }

 private:
  static constexpr double kUnknown = -1.0;
  void add(double seconds) { costs_.stages.push_back(seconds); }

  const haptics::Scene& scene_;
  const EffectPlan& plan_;
  double radius_;
  StageCosts costs_;
  double regions_ = 0.0;
};

}  // namespace

StageCosts measure_stages(const haptics::Scene& scene, const EffectPlan& plan, double radius) {
  Measurement measurement(scene, plan, radius);
  for (std::size_t i = 0; i < plan.objects().size(); ++i) measurement.add_object(i);
  for (std::size_t i = 0; i < plan.regions().size(); ++i) measurement.add_region(i);
  return measurement.costs();
}

DearestStep measure_dearest_step(const haptics::Scene& scene, const EffectPlan& plan, double radius,
                                 double enough) {
  std::vector<PlannedRegion> regions = plan.regions();
  for (std::size_t i = 0; i < regions.size(); ++i)
    regions[i].effects = haptics::PlannedRegionEffects(scene.regions[i].effects);
  DearestStep dearest;
  const double begin = thread_seconds();
  for (std::size_t i = 0; i < plan.objects().size(); ++i) {
    if (thread_seconds() - begin > kMostSearch) break;
    PlannedObject object = plan.objects()[i];
    const bool bounded = std::holds_alternative<haptics::HalfSpace>(object.shape) ||
                         std::holds_alternative<haptics::Ball>(object.shape) ||
                         std::holds_alternative<haptics::Block>(object.shape);
    const auto place = bounded ? std::optional<Vector3d>() : place_inside(object, radius);
    if (!place) continue;
    object.effects = haptics::PlannedEffects(scene.objects[i].effects);
    const std::string name = object.name;
    const Vector3d outside = *place + 10.0 * (*place - object.position);
    const EffectPlan alone({std::move(object)}, regions);
    Stroke stroke(alone, radius);
    stroke.begin(outside);
    double seconds = stroke.time_run(*place, kFewSteps);
    if (seconds >= enough) seconds = stroke.time_round(*place);
    if (seconds > dearest.seconds) dearest = {seconds, name};
  }
  return dearest;
}

}  // namespace reckon::peer
