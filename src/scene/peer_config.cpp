// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/peer_config.hpp"

#include <array>

namespace reckon::peer {

deadreckon::ForceModel to_force_model(const HandModel& hand) {
  deadreckon::ForceModel model;
  model.kind = pdu::ForceModelKind::sphere;
  model.radius = hand.radius;
  model.k1 = hand.k1;
  model.k3 = hand.k3;
  model.damping = hand.damping;
  model.static_friction = hand.static_friction;
  model.kinetic_friction = hand.kinetic_friction;
  model.validity = std::chrono::duration<double>(hand.validity).count();
  return model;
}

std::string_view name(OperatorKind kind) {
  switch (kind) {
    case OperatorKind::trace:
      return "trace";
    case OperatorKind::sweep:
      return "sweep";
    case OperatorKind::passive:
      break;
  }
  return "passive";
}

std::string_view name(CellScheme scheme) {
  return scheme == CellScheme::square ? "square" : "hexagonal";
}

std::string_view name(Prediction prediction) {
  return prediction == Prediction::adaptive ? "adaptive" : "as_sent";
}

std::string_view name(deadreckon::AccelerationReading reading) {
  return reading == deadreckon::AccelerationReading::inertial ? "inertial" : "component";
}

std::string_view word_of(const std::optional<pdu::DeadReckoningAlgorithm>& algorithm) {
  // In the order of DRM 1 to 9.
  constexpr std::array<std::string_view, 9> kWords = {"static", "fpw", "rpw", "rvw", "fvw",
                                                      "fpb",    "rpb", "rvb", "fvb"};
  const std::size_t row = algorithm ? static_cast<std::size_t>(*algorithm) - 1 : kWords.size();
  return row < kWords.size() ? kWords[row] : "auto";
}

}  // namespace reckon::peer
