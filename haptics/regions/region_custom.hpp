// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Custom effects of regions: classes of a program that meet the concepts of region_hooks.hpp.
// Include this header where such a class is defined; custom_effects<Fog>() then describes it like
// an effect of objects.
//
//   auto scene = load_scene_file("room.toml", custom_effects<Honey, Fog>());
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "reckon/haptics/effects/effect_custom.hpp"
#include "reckon/haptics/regions/region_hooks.hpp"

namespace reckon::haptics {

/// Declares that the effect gives no force outside of the region, so its hooks are not called
/// there. An effect without this keeps each servo awake, wherever its hand is.
template <class Effect>
concept ActsInsideOnly = requires {
  requires Effect::kInsideOnly;
};

/// Hooks of an effect of a region.
struct RegionHookSet {
  bool stores = false;       ///< StoresRegionEnergy
  bool gives = false;        ///< GivesRegionForce
  bool inside_only = false;  ///< ActsInsideOnly
};

/// One copy of a custom effect of a region, with its state and the hooks of region_hooks.hpp. Servo
/// thread. A hook that the effect lacks does nothing.
class CustomRegionState {
 public:
  virtual ~CustomRegionState() = default;
  [[nodiscard]] virtual std::unique_ptr<CustomRegionState> copy() const = 0;
  /// Takes the state of another copy of the same effect; no allocation.
  virtual void assign(const CustomRegionState& other) noexcept = 0;

  [[nodiscard]] virtual RegionPotential potential(const RegionPoint& point) noexcept = 0;
  [[nodiscard]] virtual double stiffness() const noexcept = 0;
  [[nodiscard]] virtual Eigen::Vector3d force(const RegionPoint& point) noexcept = 0;
};

/// A custom effect type of regions. Immutable; any thread.
class CustomRegionEffect : public CustomEffect {
 public:
  [[nodiscard]] std::string_view section() const noexcept override { return "region"; }
  [[nodiscard]] virtual RegionHookSet hooks() const noexcept = 0;
  /// @param values one for each row of parameters(), in order
  /// @throws std::invalid_argument if the effect refuses them
  [[nodiscard]] virtual std::unique_ptr<CustomRegionState> make(
      std::span<const double> values) const = 0;

 protected:
  using CustomEffect::CustomEffect;
};

/// A custom effect declared for a region, with a value for each of its parameters.
struct DeclaredCustomRegionEffect {
  std::shared_ptr<const CustomRegionEffect> effect;
  std::vector<double> values;
};

/// Adapts an effect class to CustomRegionState.
template <class Effect>
class CustomRegionStateOf final : public CustomRegionState {
 public:
  explicit CustomRegionStateOf(const typename Effect::Parameters& values) : effect_(values) {}

  [[nodiscard]] std::unique_ptr<CustomRegionState> copy() const override {
    return std::make_unique<CustomRegionStateOf>(*this);
  }
  void assign(const CustomRegionState& other) noexcept override {
    effect_ = static_cast<const CustomRegionStateOf&>(other).effect_;
  }
  [[nodiscard]] RegionPotential potential(
      [[maybe_unused]] const RegionPoint& point) noexcept override {
    if constexpr (StoresRegionEnergy<Effect>) {
      return effect_.potential(point);
    } else {
      return {};
    }
  }
  [[nodiscard]] double stiffness() const noexcept override {
    if constexpr (StoresRegionEnergy<Effect>) {
      return effect_.stiffness();
    } else {
      return 0.0;
    }
  }
  [[nodiscard]] Eigen::Vector3d force([[maybe_unused]] const RegionPoint& point) noexcept override {
    if constexpr (GivesRegionForce<Effect>) {
      return effect_.force(point);
    } else {
      return Eigen::Vector3d::Zero();
    }
  }

 private:
  Effect effect_;
};

/// Adapts an effect class to CustomRegionEffect.
template <class Effect>
class CustomRegionEffectOf final : public CustomRegionEffect {
 public:
  CustomRegionEffectOf() : CustomRegionEffect(std::type_identity<Effect>{}) {
    static_assert(DescribedEffect<Effect>,
                  "an effect is a CountedEffect of itself with Parameters, kName, kKey, kCost, "
                  "kParameters, parameters() and a constructor from its Parameters, and owns no "
                  "memory (std::vector, std::string) unless copies share it (kSharesMemory): see "
                  "DescribedEffect in effect_hooks.hpp");
    static_assert(WholeRegionHooks<Effect>,
                  "a hook of this effect is incomplete, or its types or noexcept differ from those "
                  "in region_hooks.hpp");
    static_assert(!HookedEffect<Effect>,
                  "an effect is of objects or of regions: make it two classes");
  }

  [[nodiscard]] RegionHookSet hooks() const noexcept override {
    return {StoresRegionEnergy<Effect>, GivesRegionForce<Effect>, ActsInsideOnly<Effect>};
  }
  [[nodiscard]] std::unique_ptr<CustomRegionState> make(
      std::span<const double> values) const override {
    return std::make_unique<CustomRegionStateOf<Effect>>(
        CustomEffect::parameters_of<Effect>(values));
  }
};

template <class Effect>
requires HookedRegionEffect<Effect>
struct CustomDescription<Effect> {
  using Type = CustomRegionEffectOf<Effect>;
};

}  // namespace reckon::haptics
