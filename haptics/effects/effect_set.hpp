// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The effects of an object, ready to run. Effects that are always present are members; of the
// others only the declared ones exist, so a longer list of effects costs an object nothing.
#pragma once

#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "reckon/haptics/effects/effect_declarations.hpp"
#include "reckon/haptics/effects/effect_guard.hpp"
#include "reckon/haptics/effects/effect_types.hpp"

namespace reckon::haptics {

/// A copy has its own state. Assignment between copies of one set does not allocate.
/// @tparam Types std::tuple of the effects @tparam More types that may be added
template <class Types, class... More>
class EffectSet {
 public:
  /// The effects that are always present, with their defaults.
  EffectSet() : EffectSet(EffectDeclarations<Types>()) {}
  /// @throws std::invalid_argument if an effect refuses its parameters.
  explicit EffectSet(const EffectDeclarations<Types>& declared)
      : always_(Parts<Types>::always(declared)) {
    for_each_effect<Types>([&]<class Effect>(std::type_identity<Effect>) {
      if constexpr (!AlwaysThere<Effect>) {
        if (const auto* parameters = declared.template find<Effect>()) add<Effect>(*parameters);
      }
    });
  }

  /// The effect; null if it is not declared.
  template <class Effect>
  [[nodiscard]] Effect* find() noexcept {
    return find_in<Effect>(*this);
  }
  template <class Effect>
  [[nodiscard]] const Effect* find() const noexcept {
    return find_in<Effect>(*this);
  }
  /// Declares an effect that is not declared yet; allocates.
  template <class Effect>
  void add(const typename Effect::Parameters& parameters) {
    declared_.emplace_back(std::in_place_type<Effect>, parameters);
    note(kHooks<Effect>);
  }
  /// The same for one of `More`.
  void add(auto effect) {
    note(hooks_of(effect));
    declared_.emplace_back(std::move(effect));
  }
  /// Whether a declared effect gives a force.
  [[nodiscard]] bool has_declared_forces() const noexcept { return declared_forces_; }

  /// Calls f(effect) for each effect: first the ones that are always present, then the declared
  /// ones.
  void for_each(auto&& f) { visit(*this, f); }
  void for_each(auto&& f) const { visit(*this, f); }
  /// The same for effects that are always present.
  void for_each_always(auto&& f) {
    std::apply([&](auto&... effects) { (f(effects), ...); }, always_);
  }
  /// The same for effects that store energy.
  void for_each_spring(auto&& f) const {
    const auto one = [&]<class Effect>(const Effect& effect) {
      if constexpr (StoresEnergy<Effect>) f(effect);
    };
    std::apply([&](const auto&... effects) { (one(effects), ...); }, always_);
    if (!declared_springs_) return;
    for (const auto& effect : declared_) std::visit(one, effect);
  }

 private:
  template <class List>
  struct Parts;
  template <class... Effects>
  struct Parts<std::tuple<Effects...>> {
    template <class Effect, bool always>
    using If = std::conditional_t<AlwaysThere<Effect> == always, std::tuple<Effect>, std::tuple<>>;
    template <class List>
    struct Of;
    template <class... Some>
    struct Of<std::tuple<Some...>> {
      using Variant = std::variant<Some..., More...>;
      static std::tuple<Some...> make([[maybe_unused]] const EffectDeclarations<Types>& declared) {
        return std::tuple<Some...>(Some(*declared.template find<Some>())...);
      }
    };
    using Always = decltype(std::tuple_cat(std::declval<If<Effects, true>>()...));
    using Declared =
        typename Of<decltype(std::tuple_cat(std::declval<If<Effects, false>>()...))>::Variant;
    static Always always(const EffectDeclarations<Types>& declared) {
      return Of<Always>::make(declared);
    }
  };
  using Always = typename Parts<Types>::Always;
  using Declared = typename Parts<Types>::Declared;

  void note(const EffectHookSet& hooks) noexcept {
    declared_springs_ |= hooks.stores;
    declared_forces_ |= hooks.gives;
  }
  template <class Effect, class Self>
  static auto* find_in(Self& self) noexcept {
    using Found = std::conditional_t<std::is_const_v<Self>, const Effect, Effect>;
    if constexpr (AlwaysThere<Effect>) {
      return &std::get<Effect>(self.always_);
    } else {
      for (auto& one : self.declared_)
        if (Found* found = std::get_if<Effect>(&one)) return found;
      return static_cast<Found*>(nullptr);
    }
  }
  static void visit(auto& self, auto& f) {
    std::apply([&](auto&... effects) { (f(effects), ...); }, self.always_);
    for (auto& one : self.declared_) std::visit(f, one);
  }

  Always always_;
  std::vector<Declared> declared_;
  bool declared_springs_ = false, declared_forces_ = false;
};

/// Effects of an object.
using PlannedEffects = EffectSet<EffectTypes, GuardedEffect>;

}  // namespace reckon::haptics
