// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/admittance_hand.hpp"

#include <fmt/format.h>

#include "reckon/peer/notation/units.hpp"

namespace reckon::tools {

std::string AdmittanceHand::take_notice() {
  const std::uint64_t heavier = handle_.heavier();
  if (heavier == 0 || heavier < 2 * told_) return {};
  told_ = heavier;
  return fmt::format(
      "an admittance device could not follow its hand, so its mass of {} was doubled for some "
      "seconds, {} so far: raise virtual_mass or damping, or loosen the grip",
      peer::format_quantity(own_mass_, "kg"),
      heavier == 1 ? "once" : fmt::format("{} times", heavier));
}

}  // namespace reckon::tools
