// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One row of an effect's parameter table. Scene files, their error messages and `scene explain`
// read these rows, so that a parameter needs no code outside its effect's own header.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace reckon::haptics {

/// A parameter of an effect; its values are members of the struct P.
template <class P>
struct EffectParameter {
  std::string_view key;   ///< in scene files
  std::string_view unit;  ///< SI, "" for a pure number
  double P::*field;
  double minimum;
  double maximum;
  double default_value;
  std::string_view help;  ///< one sentence: its meaning, and the effect of a higher value
};

/// A file of an effect, the member `file` of its parameters.
struct EffectFile {
  std::string_view key;   ///< in scene files
  std::string_view help;  ///< one sentence
};

/// Checks each value against its row.
/// @throws std::invalid_argument naming the key, the value and the allowed range.
template <class P, std::size_t n>
void check_parameters(const std::array<EffectParameter<P>, n>& table, const P& values) {
  for (const EffectParameter<P>& row : table) {
    const double value = values.*row.field;
    if (value >= row.minimum && value <= row.maximum) continue;  // false for NaN
    throw std::invalid_argument(std::string(row.key) + " = " + std::to_string(value) +
                                " is out of range: give " + std::to_string(row.minimum) + " to " +
                                std::to_string(row.maximum) + " " + std::string(row.unit));
  }
}

/// Counts constructions and copies of an effect in this process, so that a test can show that a
/// scene without the effect never constructs it.
template <class Effect>
class CountedEffect {
 public:
  CountedEffect() noexcept { add(); }
  CountedEffect(const CountedEffect&) noexcept { add(); }
  CountedEffect& operator=(const CountedEffect&) noexcept = default;

  [[nodiscard]] static std::uint64_t constructed() noexcept {
    return count_.load(std::memory_order_relaxed);
  }

 private:
  static void add() noexcept { count_.fetch_add(1, std::memory_order_relaxed); }
  inline static std::atomic<std::uint64_t> count_ = 0;
};

}  // namespace reckon::haptics
