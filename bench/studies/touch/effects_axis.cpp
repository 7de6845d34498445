// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Effects of the plan: a servo with all effects, and without each of them.
#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

#include "reckon/bench/studies/touch/touch_study.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kHard = 800, kSoft = 400;  // [N/m]
constexpr std::size_t kSteps = 4000;        // [ms]
constexpr nanoseconds kPeriod{1'000'000};

/// A file that is deleted with its owner.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text) {
    std::string name = (std::filesystem::temp_directory_path() / "reckon-slab-XXXXXX.obj").string();
    const int file = mkstemps(name.data(), 4);
    if (file < 0)
      throw tools::EnvironmentError(name + ": cannot be created; set TMPDIR to a writable folder");
    close(file);
    path_ = name;
    std::ofstream(path_) << text;
  }
  ~TemporaryFile() {
    std::error_code gone;
    std::filesystem::remove(path_, gone);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A slab of 0.2 x 0.1 x 0.02 m with its top at z = 0; the part with x > 0 has the material soft.
std::string slab() {
  std::string text;
  for (const double z : {-0.02, 0.0})
    for (const double y : {-0.05, 0.05})
      for (const double x : {-0.1, 0.0, 0.1}) text += fmt::format("v {} {} {}\n", x, y, z);
  const auto quads = [](int half) {
    const int a = 1 + half, b = 2 + half;  // in the row y < 0, bottom; +3: other row, +6: top
    return fmt::format("f {} {} {} {}\nf {} {} {} {}\nf {} {} {} {}\nf {} {} {} {}\n", a, a + 3,
                       b + 3, b, a + 6, b + 6, b + 9, a + 9, a, b, b + 6, a + 6, a + 3, a + 9,
                       b + 9, b + 3);
  };
  text += "usemtl hard\n" + quads(0) + "f 1 7 10 4\n";
  text += "usemtl soft\n" + quads(1) + "f 3 6 12 9\n";
  return text;
}

constexpr std::string_view kAll = "", kNone = "spring alone";
/// Parts that can be left out, in addition to the effects by their kName.
constexpr std::string_view kDamper = "damper", kPatch = "patch";

/// The slab with all effects but one, in a region with all of its own effects. Only one effect that
/// holds the contact point is present: friction, or `holder` instead.
struct Declared {
  std::string_view without = kAll;
  std::string_view holder = haptics::StickSlipFriction::kName;

  [[nodiscard]] bool has(std::string_view effect) const {
    return without != kNone && without != effect;
  }
};

/// All effects that hold the contact point have similar forces here.
void declare_holder(haptics::DeclaredEffects& effects, const Declared& declared) {
  if (!declared.has(declared.holder)) return;
  if (declared.holder == haptics::PlaceFriction::kName) {
    effects.declare<haptics::PlaceFriction>() = {0.5, 0.35, 0.5, 0.004, 0, 0};
  } else if (declared.holder == haptics::StribeckFriction::kName) {
    effects.declare<haptics::StribeckFriction>() = {0.5, 0.35, 0.02, 0};
  } else if (declared.holder == haptics::Snags::kName) {
    effects.declare<haptics::Snags>() = {3e5, 0.5, 5e-4, 0.1, 1};
  } else {
    effects.declare<haptics::StickSlipFriction>() = {0.5, 0.35};
  }
}

template <class Effect, class Effects>
void declare(Effects& effects, const Declared& declared,
             const typename Effect::Parameters& parameters) {
  if (declared.has(Effect::kName)) effects.template declare<Effect>() = parameters;
}

haptics::EffectPlan plan_of(const std::filesystem::path& file, const Declared& declared) {
  haptics::Scene scene;
  haptics::SceneObject& object = scene.objects.emplace_back();
  object.name = "slab";
  object.shape = haptics::MeshShape{file, 0, false};
  const double damping = declared.has(kDamper) ? 4.0 : 0.0;
  object.effects.of<haptics::SpringDamper>() = {kHard, damping};
  declare_holder(object.effects, declared);
  declare<haptics::Skin>(object.effects, declared, {200, 0.4});
  declare<haptics::Texture>(object.effects, declared, {5e-5, 0.003, 0, 0});
  declare<haptics::Relief>(object.effects, declared, {{}, 0.02, 5e-5, 1});
  declare<haptics::SurfaceDrag>(object.effects, declared, {1.0});
  declare<haptics::TapVibration>(object.effects, declared, {4.0, 100.0, 80.0});
  if (declared.has(kPatch)) {
    haptics::SurfacePatch& patch = object.patches.emplace_back();
    patch.name = "soft";
    patch.surface = {kSoft, damping};
    if (const auto* friction = object.effects.find<haptics::StickSlipFriction>())
      patch.friction = *friction;
  }
  if (declared.without == kNone) return haptics::EffectPlan(scene);
  haptics::SceneRegion& region = scene.regions.emplace_back();
  region.name = "about it";
  region.shape = haptics::BoxShape{{0.07, 0.2, 0.1}};
  declare<haptics::Viscosity>(region.effects, declared, {0.5, 0});
  declare<haptics::DryFriction>(region.effects, declared, {0.1, 300});
  declare<haptics::ConstantForce>(region.effects, declared, {0, 0, -0.2});
  declare<haptics::PointSpring>(region.effects, declared, {5, 0, 5});
  declare<haptics::Attraction>(region.effects, declared, {0.2, 0.02, 0, 0, 0});
  declare<haptics::Oscillation>(region.effects, declared, {0, 0, 0.1, 50});
  declare<haptics::BorderSpring>(region.effects, declared, {20});
  return haptics::EffectPlan(scene);
}

/// Strokes over both materials, 3 mm deep, with a tremor for the dampers.
haptics::DeviceSample reading(double t, std::uint64_t seed) {
  static constexpr double kSlow = kTurn * 0.5, kFast = kTurn * 8;
  const double slow = phase_of(seed, 1), fast = phase_of(seed, 2);
  haptics::DeviceSample sample;
  sample.ok = true;
  sample.has_velocity = true;
  const double in = std::min(1.0, t / 0.2), rate = t < 0.2 ? 5.0 : 0.0;
  sample.position = {0.04 * std::sin(kSlow * t + slow), 0.01,
                     0.001 - in * (0.004 - 0.0005 * std::sin(kFast * t + fast))};
  sample.velocity = {0.04 * kSlow * std::cos(kSlow * t + slow), 0,
                     -rate * (0.004 - 0.0005 * std::sin(kFast * t + fast)) +
                         in * 0.0005 * kFast * std::cos(kFast * t + fast)};
  return sample;
}

/// Returns the same motion repeatedly, and stores the last force.
class PlayedDevice : public haptics::HapticDevice {
 public:
  explicit PlayedDevice(std::shared_ptr<const std::vector<haptics::DeviceSample>> samples)
      : samples_(std::move(samples)) {}
  [[nodiscard]] haptics::DeviceLimits limits() const noexcept override {
    haptics::DeviceLimits limits;
    limits.max_force = 20;
    limits.damping = 5;
    limits.max_speed = 2;
    return limits;
  }
  [[nodiscard]] haptics::DeviceSample read(nanoseconds /*now*/) noexcept override {
    const haptics::DeviceSample& sample = (*samples_)[next_];
    next_ = next_ + 1 == samples_->size() ? 0 : next_ + 1;
    return sample;
  }
  void write(const Vector3d& force, nanoseconds /*now*/) noexcept override { force_ = force; }
  [[nodiscard]] const Vector3d& force() const noexcept { return force_; }

 private:
  std::shared_ptr<const std::vector<haptics::DeviceSample>> samples_;
  std::size_t next_ = 0;
  Vector3d force_ = Vector3d::Zero();
};

/// A servo with its device.
class Bench {
 public:
  Bench(std::shared_ptr<const std::vector<haptics::DeviceSample>> samples,
        std::shared_ptr<const haptics::EffectPlan> plan, double rate_limit)
      : device_(std::move(samples)),
        servo_(device_, std::move(plan), {.max_force_rate = rate_limit}) {}
  const Vector3d& step() {
    servo_.step(now_);
    now_ += kPeriod;
    return device_.force();
  }

 private:
  PlayedDevice device_;
  haptics::ServoLoop servo_;
  nanoseconds now_{0};
};

}  // namespace

TouchCase effects_case(const TouchConditions& conditions) {
  auto samples = std::make_shared<std::vector<haptics::DeviceSample>>();
  for (std::size_t i = 0; i < kSteps; ++i)
    samples->push_back(reading(1e-3 * static_cast<double>(i), conditions.seed));
  const TemporaryFile file(slab());
  constexpr double kAny = std::numeric_limits<double>::infinity();
  struct Choice {
    std::string name;
    Declared declared;
    double rate_limit;
  };
  std::vector<Choice> choices{{"all effects", {}, kAny}};
  const auto leave_out = [&](std::string_view effect) {
    choices.push_back({fmt::format("without {}", effect), {effect}, kAny});
  };
  for (const std::string_view effect : {kDamper, kPatch}) leave_out(effect);
  haptics::for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
    const bool holds = haptics::HoldsContactPoint<Effect>;
    if (holds && Effect::kName != Declared{}.holder) {
      choices.push_back(
          {fmt::format("{} as friction", Effect::kName), {kAll, Effect::kName}, kAny});
    } else if (!haptics::AlwaysThere<Effect>) {
      leave_out(Effect::kName);
    }
  });
  haptics::for_each_region_effect(
      [&]<class Effect>(std::type_identity<Effect>) { leave_out(Effect::kName); });
  choices.push_back({std::string(kNone), {kNone}, kAny});
  choices.push_back({"rate at most 100 N/s", {}, 100});
  choices.push_back({"rate at most 30 N/s", {}, 30});
  TouchCase made;
  made.truth = fmt::format(
      "slab of {} and {} N/m, 4 N s/m, friction 0.5 and 0.35, stroked across both at 8 Hz of "
      "tremor: the servo with all effects",
      kHard, kSoft);
  made.remark =
      "The error is the force that is missing without the effect. The rate limit is always active; "
      "its default, the rate of the stiffest surface at 1 m/s, is not reached here. NS: complete "
      "servo steps, with a device that plays back.";
  for (const auto& [name, declared, rate] : choices) {
    const auto plan = std::make_shared<const haptics::EffectPlan>(plan_of(file.path(), declared));
    TouchSetting setting{name, {}, {}};
    Bench once(samples, plan, rate);
    for (std::size_t i = 0; i < kSteps; ++i) setting.forces.push_back(once.step());
    setting.run = [bench = std::make_shared<Bench>(samples, plan, rate)](std::size_t steps) {
      double sum = 0;
      for (std::size_t i = 0; i < steps; ++i) sum += bench->step().z();
      return sum;
    };
    made.settings.push_back(std::move(setting));
  }
  made.force = made.settings.front().forces;
  return made;
}

}  // namespace reckon::bench
