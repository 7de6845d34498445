// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The effects that a scene declares for an object: one slot for each effect of the list, with its
// parameters. An effect that is not declared is never constructed, see EffectSet.
#pragma once

#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>

#include "reckon/haptics/effects/effect_types.hpp"

namespace reckon::haptics {

/// One slot per effect, in the order of the list: its parameters if it is kAlways, else a
/// std::optional of them. @tparam Types std::tuple of the effects
template <class Types>
class EffectDeclarations {
 public:
  template <class Effect>
  using Kept = typename Effect::Parameters;
  template <class Effect>
  using Slot = std::conditional_t<AlwaysThere<Effect>, Kept<Effect>, std::optional<Kept<Effect>>>;

  template <class Effect>
  [[nodiscard]] Slot<Effect>& of() noexcept {
    return std::get<index_of<Effect>()>(slots_);
  }
  template <class Effect>
  [[nodiscard]] const Slot<Effect>& of() const noexcept {
    return std::get<index_of<Effect>()>(slots_);
  }

  /// Content of the slot; null if the effect is not declared.
  template <class Effect>
  [[nodiscard]] const Kept<Effect>* find() const noexcept {
    return held(of<Effect>());
  }

  /// Declares the effect, with its defaults if it was not declared. @return the content to fill in.
  template <class Effect>
  Kept<Effect>& declare() {
    if constexpr (!AlwaysThere<Effect>) {
      if (!of<Effect>()) of<Effect>().emplace();
    }
    return *held(of<Effect>());
  }

  /// Calls f(parameters) for each declared effect, in the order of the list.
  template <class F>
  void for_each(F&& f) const {
    std::apply([&](const auto&... slots) { (visit(slots, f), ...); }, slots_);
  }

 private:
  template <class List>
  struct Rooms;
  template <class... Effects>
  struct Rooms<std::tuple<Effects...>> {
    using Slots = std::tuple<Slot<Effects>...>;
    template <class Effect>
    static constexpr bool kListed = (std::is_same_v<Effect, Effects> || ...);
    template <class Effect>
    static consteval std::size_t index() {
      std::size_t at = 0;
      static_cast<void>(((std::is_same_v<Effect, Effects> || (++at, false)) || ...));
      return at;
    }
  };
  using Slots = typename Rooms<Types>::Slots;

  template <class Effect>
  static consteval std::size_t index_of() {
    static_assert(Rooms<Types>::template kListed<Effect>, "this effect has no row in the list");
    return Rooms<Types>::template index<Effect>();
  }

  template <class T>
  static T* held(T& slot) noexcept {
    return &slot;
  }
  template <class T>
  static T* held(std::optional<T>& slot) noexcept {
    return slot ? &*slot : nullptr;
  }
  template <class T>
  static const T* held(const std::optional<T>& slot) noexcept {
    return slot ? &*slot : nullptr;
  }

  template <class S, class F>
  static void visit(S& slot, F& f) {
    if (auto* kept = held(slot)) f(*kept);
  }

  Slots slots_;
};

/// Declarations for an object.
using DeclaredEffects = EffectDeclarations<EffectTypes>;

}  // namespace reckon::haptics
