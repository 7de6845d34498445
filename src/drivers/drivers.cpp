// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of drivers.
#include <array>

#include "reckon/peer/drivers/driver.hpp"

namespace reckon::peer {

const Driver& falcon_driver();
const Driver& polhem_driver();
const Driver& serial_driver();
const Driver& evdev_driver();
const Driver& plugin_driver();

std::span<const Driver* const> drivers() {
  static const std::array kAll{&falcon_driver(), &polhem_driver(), &serial_driver(),
                               &evdev_driver(), &plugin_driver()};
  return kAll;
}

}  // namespace reckon::peer
