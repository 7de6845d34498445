// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A hill climb towards the worst violation of a limit, for tests of behaviour over many parameters.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

namespace reckon::test {

/// The choices of a seed or a climber, all in [0, 1].
template <std::size_t N>
using Choice = std::array<double, N>;

/// @return `low` for 0, `high` for 1
[[nodiscard]] inline double within(double share, double low, double high) {
  return low + share * (high - low);
}

template <std::size_t N>
[[nodiscard]] Choice<N> any_choice(std::mt19937_64& random) {
  Choice<N> choice;
  for (double& x : choice) x = std::uniform_real_distribution<double>(0, 1)(random);
  return choice;
}

template <std::size_t N>
struct Climbed {
  std::uint64_t seed = 1;
  std::size_t tries = 0;
  double badness = -1e300;  ///< of the worst; the limit is 1
  Choice<N> worst{};
};

/// Climbs for RECKON_CLIMB seconds ("600" or "600s") from a seed of the clock; without it, five
/// tries from seed 1, which only show that it runs. After 30 tries without improvement it starts
/// elsewhere.
/// @param badness (const Choice<N>&): the value to maximise
template <std::size_t N, typename Badness>
[[nodiscard]] Climbed<N> climb(Badness&& badness) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kTries = 5;
  constexpr int kPatience = 30;
  const char* const told = std::getenv("RECKON_CLIMB");
  const auto began = Clock::now();
  const double most = told != nullptr ? std::stod(told) : 0.0;
  Climbed<N> climbed;
  if (told != nullptr) climbed.seed = static_cast<std::uint64_t>(began.time_since_epoch().count());
  std::mt19937_64 random(climbed.seed);
  const auto over = [&] {
    const std::chrono::duration<double> took = Clock::now() - began;
    return told != nullptr ? took.count() >= most : climbed.tries >= kTries;
  };
  Choice<N> here{};
  double height = -1e300;
  for (int vain = kPatience; !over(); ++climbed.tries) {
    Choice<N> next = here;
    const bool anew = vain >= kPatience;
    if (anew) {
      next = any_choice<N>(random);
    } else {
      for (std::size_t i = random() % N, k = 0; k < 1 + random() % 3; ++k, i = random() % N)
        next[i] = std::clamp(next[i] + std::normal_distribution<double>(0, 0.15)(random), 0.0, 1.0);
    }
    const double reached = badness(next);
    vain = anew || reached > height ? 0 : vain + 1;
    if (anew || reached >= height) {
      here = next;
      height = reached;
    }
    if (height > climbed.badness) {
      climbed.badness = height;
      climbed.worst = here;
    }
  }
  return climbed;
}

}  // namespace reckon::test
