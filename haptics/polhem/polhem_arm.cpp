// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/polhem/polhem_arm.hpp"

namespace reckon::haptics {

const PolhemArm& polhem_1() noexcept {
  // Capstans of 10 mm drive drums of 180, 100 and 100 mm.
  static const PolhemArm kArm{.base = 0.058,
                              .upper = 0.174,
                              .fore = 0.133,
                              .ratios = {18.0, 10.0, 10.0},
                              .counts_per_turn = 2000.0,
                              .torque_constants = {0.0538, 0.0538, 0.0538},
                              .encoder_signs = {-1.0, -1.0, -1.0},
                              .motor_signs = {-1.0, -1.0, -1.0},
                              .most_current = 2.999,
                              .home_counts = {0, 0, -5000, 0, 0, 0},
                              .gimbal_counts_per_turn = 1024.0,
                              .gimbal_signs = {-1.0, 1.0, -1.0},
                              .middle = {0.14, 0.0, 0.1}};
  return kArm;
}

}  // namespace reckon::haptics
