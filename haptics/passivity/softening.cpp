// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/softening.hpp"

#include <algorithm>

namespace reckon::haptics {
namespace {

constexpr double kLasting = 0.1;   // [s], smoothing of the force held back
constexpr double kNoticed = 0.02;  // of the force; a smaller lack is not felt
constexpr double kFall = 3.0;      // [1/s], for each unit of force held back
constexpr double kFastest = 1.0;   // [1/s]
constexpr double kRise = 0.3;      // [1/s]

}  // namespace

void Softening::learn(double held, bool to_spare, bool touching, double dt) noexcept {
  const double back = touching ? 1.0 - held : 0.0;
  lasting_ += std::min(1.0, dt / kLasting) * (back - lasting_);
  const double felt = std::min(lasting_, back);
  if (!touching) {
    share_ += kFastest * dt;
  } else if (felt > kNoticed) {
    share_ -= std::min(kFastest, kFall * felt) * dt;
  } else if (to_spare) {
    share_ += kRise * dt;
  }
  share_ = std::clamp(share_, kLeast, 1.0);
}

}  // namespace reckon::haptics
