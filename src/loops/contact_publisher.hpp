// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Publishes the bodies within reach of a hand to its servo: remote ones with their predictors, our
// own with their true states. Part of the model loop.
#pragma once

#include <chrono>
#include <span>

#include "reckon/peer/world/energy_books.hpp"
#include "reckon/peer/world/hand_port.hpp"
#include "reckon/peer/world/near_bodies.hpp"
#include "reckon/peer/world/portless_bodies.hpp"

namespace reckon::peer {

/// Inputs of contacts; all must remain valid until the pass ends.
struct ContactSources {
  const EnergyBooks& books;
  std::span<const HandPort> hands;
  std::span<const PortlessBody> bodies;
  std::chrono::nanoseconds now{0};
  std::uint32_t epoch = 0;  ///< of this process
  bool interop = false;     ///< peers do not announce themselves
};

/// The predictors of a remote entity that can be felt, without energy accounts.
[[nodiscard]] haptics::RemoteHand predictors_of(const RemoteEntity& row) noexcept;

/// Publishes the bodies near a port to its servo.
/// @param frozen whether the hand's simulation is frozen
void publish_contacts(HandPort& port, const pdu::EntityId& hand, const NearBodies& near,
                      bool frozen, const ContactSources& sources) noexcept;

}  // namespace reckon::peer
