// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Custom effects of a program. A class that meets the concepts of effect_hooks.hpp needs no row in
// the list: custom_effects<Honey>() describes it, and load_scene_file() accepts its key.
//
//   auto scene = load_scene_file("table.toml", custom_effects<Honey>());
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/effect_types.hpp"

namespace reckon::haptics {

/// A row of an effect's table of parameters, see EffectParameter.
struct CustomParameter {
  std::string key, unit;
  double minimum, maximum, default_value;
  std::string help;
};

/// One copy of a custom effect, with its state: the hooks of effect_hooks.hpp. Servo thread. A hook
/// that the effect lacks does nothing.
class CustomEffectState {
 public:
  virtual ~CustomEffectState() = default;
  [[nodiscard]] virtual std::unique_ptr<CustomEffectState> copy() const = 0;
  /// Takes the state of another copy of the same effect; no allocation.
  virtual void assign(const CustomEffectState& other) noexcept = 0;

  /// Null if it does not hold the contact point.
  [[nodiscard]] virtual FrictionCone* cone() noexcept = 0;
  virtual void follow(const SlidingPlace& place) noexcept = 0;
  [[nodiscard]] virtual Eigen::Vector3d spring_force(
      const Eigen::Vector3d& scp, const Eigen::Vector3d& device) const noexcept = 0;
  [[nodiscard]] virtual double stored_energy(const Eigen::Vector3d& scp,
                                             const Eigen::Vector3d& device) const noexcept = 0;
  [[nodiscard]] virtual double stiffness() const noexcept = 0;
  [[nodiscard]] virtual Eigen::Vector3d force(const EffectContact& contact) noexcept = 0;
  [[nodiscard]] virtual double damping() const noexcept = 0;
};

/// A custom effect type for scene files. Immutable; any thread.
class CustomEffect {
 public:
  virtual ~CustomEffect() = default;
  CustomEffect(const CustomEffect&) = delete;
  CustomEffect& operator=(const CustomEffect&) = delete;

  /// The tables of a scene file that may declare it: "object" or "region".
  [[nodiscard]] virtual std::string_view section() const noexcept = 0;
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const std::string& key() const noexcept { return key_; }
  [[nodiscard]] const std::string& cost() const noexcept { return cost_; }
  [[nodiscard]] const std::vector<CustomParameter>& parameters() const noexcept {
    return parameters_;
  }

 protected:
  /// From a class with the table of an effect.
  template <class Effect>
  explicit CustomEffect(std::type_identity<Effect>)
      : name_(Effect::kName), key_(Effect::kKey), cost_(Effect::kCost) {
    for (const auto& row : Effect::kParameters)
      parameters_.push_back({std::string(row.key), std::string(row.unit), row.minimum, row.maximum,
                             row.default_value, std::string(row.help)});
  }
  /// @param values one for each row of parameters(), in order
  template <class Effect>
  static typename Effect::Parameters parameters_of(std::span<const double> values) {
    typename Effect::Parameters parameters{};
    for (std::size_t i = 0; i < Effect::kParameters.size(); ++i)
      parameters.*Effect::kParameters[i].field = values[i];
    return parameters;
  }

 private:
  std::string name_, key_, cost_;
  std::vector<CustomParameter> parameters_;
};

/// A custom effect type of objects.
class CustomObjectEffect : public CustomEffect {
 public:
  [[nodiscard]] std::string_view section() const noexcept override { return "object"; }
  [[nodiscard]] virtual EffectHookSet hooks() const noexcept = 0;
  /// @param values one for each row of parameters(), in order
  /// @throws std::invalid_argument if the effect refuses them
  [[nodiscard]] virtual std::unique_ptr<CustomEffectState> make(
      std::span<const double> values) const = 0;

 protected:
  using CustomEffect::CustomEffect;
};

/// The custom effects that a scene file may declare.
using CustomEffects = std::vector<std::shared_ptr<const CustomEffect>>;

/// A custom effect declared for an object, with a value for each of its parameters.
struct DeclaredCustomEffect {
  std::shared_ptr<const CustomObjectEffect> effect;
  std::vector<double> values;
};

/// Adapts an effect class to CustomEffectState.
template <class Effect>
class CustomEffectStateOf final : public CustomEffectState {
 public:
  explicit CustomEffectStateOf(const typename Effect::Parameters& values) : effect_(values) {}

  [[nodiscard]] std::unique_ptr<CustomEffectState> copy() const override {
    return std::make_unique<CustomEffectStateOf>(*this);
  }
  void assign(const CustomEffectState& other) noexcept override {
    effect_ = static_cast<const CustomEffectStateOf&>(other).effect_;
  }
  [[nodiscard]] FrictionCone* cone() noexcept override {
    if constexpr (HoldsContactPoint<Effect>) {
      return &effect_.cone();
    } else {
      return nullptr;
    }
  }
  void follow([[maybe_unused]] const SlidingPlace& place) noexcept override {
    if constexpr (FollowsPlace<Effect>) effect_.follow(place);
  }
  [[nodiscard]] Eigen::Vector3d spring_force(
      [[maybe_unused]] const Eigen::Vector3d& scp,
      [[maybe_unused]] const Eigen::Vector3d& device) const noexcept override {
    if constexpr (StoresEnergy<Effect>) {
      return effect_.spring_force(scp, device);
    } else {
      return Eigen::Vector3d::Zero();
    }
  }
  [[nodiscard]] double stored_energy(
      [[maybe_unused]] const Eigen::Vector3d& scp,
      [[maybe_unused]] const Eigen::Vector3d& device) const noexcept override {
    if constexpr (StoresEnergy<Effect>) {
      return effect_.stored_energy(scp, device);
    } else {
      return 0.0;
    }
  }
  [[nodiscard]] double stiffness() const noexcept override {
    if constexpr (StoresEnergy<Effect>) {
      return effect_.stiffness();
    } else {
      return 0.0;
    }
  }
  [[nodiscard]] Eigen::Vector3d force(
      [[maybe_unused]] const EffectContact& contact) noexcept override {
    if constexpr (GivesForce<Effect>) {
      return effect_.force(contact);
    } else {
      return Eigen::Vector3d::Zero();
    }
  }
  [[nodiscard]] double damping() const noexcept override {
    if constexpr (GivesForce<Effect>) {
      return effect_.damping();
    } else {
      return 0.0;
    }
  }

 private:
  Effect effect_;
};

/// Adapts an effect class to CustomObjectEffect.
template <class Effect>
class CustomEffectOf final : public CustomObjectEffect, private CheckedEffect<Effect> {
 public:
  CustomEffectOf() : CustomObjectEffect(std::type_identity<Effect>{}) {
    static_assert(!AlwaysThere<Effect>, "a custom effect applies where a scene declares it");
  }

  [[nodiscard]] EffectHookSet hooks() const noexcept override { return kHooks<Effect>; }
  [[nodiscard]] std::unique_ptr<CustomEffectState> make(
      std::span<const double> values) const override {
    return std::make_unique<CustomEffectStateOf<Effect>>(parameters_of<Effect>(values));
  }
};

/// Selects the description of a class; for effects of regions see region_custom.hpp.
template <class Effect>
struct CustomDescription {
  using Type = CustomEffectOf<Effect>;
};

/// The effects, ready for load_scene_file().
template <class... Effects>
[[nodiscard]] CustomEffects custom_effects() {
  return {std::make_shared<const typename CustomDescription<Effects>::Type>()...};
}

}  // namespace reckon::haptics
