// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/peer/drivers/driver.hpp"

namespace reckon::peer {
namespace {

// The link weights that its motors hold up.
haptics::PolhemWeights weights_of(const DeviceConfig& device) {
  return {driver_value<double>(device, "upper_weight"),
          driver_value<double>(device, "fore_weight")};
}

SpentDamping held_up_by(const DeviceConfig& device) {
  return {haptics::polhem_spent_damping(weights_of(device)),
          haptics::polhem_spent_joint_damping(weights_of(device))};
}

std::unique_ptr<haptics::UsbDriver> make_polhem(const DeviceConfig& device) {
  return std::make_unique<haptics::PolhemDriver>(weights_of(device));
}

DriverKey weight(std::string_view key, std::string_view help) {
  return {.key = key, .standard = 0.0, .unit = "N m", .least = 0, .most = 2, .help = help};
}

}  // namespace

const Driver& polhem_driver() {
  static const ForceSide kForce{
      .facts = haptics::polhem_facts,
      .spent = held_up_by,
      .make = make_polhem,
      .product = "Polhem",
      .use = "3 axes, 5 N in a cube of 100 mm: reckon demo --device polhem"};
  static const Driver kDriver{
      .name = "polhem",
      .article = "a Polhem",
      .summary = "a Polhem on USB",
      .keys = {weight("upper_weight",
                      "of a Polhem: torque of the weight of its upper link when level; the motors "
                      "compensate it while forces are active, which uses up damping"),
               weight("fore_weight", "the same for its fore link")},
      .force = &kForce};
  return kDriver;
}

}  // namespace reckon::peer
