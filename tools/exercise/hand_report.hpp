// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Report at the end of a run: where hands were shown less force than requested (softer springs,
// forces held back, late steps), and which hands touched nothing.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "reckon/peer/world/peer_view.hpp"

namespace reckon::tools {

/// The hands of a run; no null pointers.
using Hands = std::vector<const peer::HandView*>;

/// Adds the hands of a peer, which must outlive the list.
void add_hands(const peer::PeerView& view, Hands& hands);

/// "walls 1425 of 20000 N/m": a sentence for each stiffness that this device shows softer than the
/// scene asks.
[[nodiscard]] std::vector<std::string> softer_than_asked(const peer::DeviceStiffness& device);

/// Prints lines of a summary, only for events that occurred; and a line if no hand touched another.
void print_hands(std::FILE* out, const Hands& hands);
/// A JSON array with an object for each hand; docs/json_lines.md lists its keys.
[[nodiscard]] std::string hands_json(const Hands& hands);
/// A JSON line for each hand: the force from each remote entity at this instant. @param seconds
/// since the start
[[nodiscard]] std::string felt_lines(const peer::PeerView& view, double seconds);

}  // namespace reckon::tools
