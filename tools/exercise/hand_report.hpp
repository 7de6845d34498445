// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What hands were shown less than they asked for, at the end of a run: softer springs, forces held
// back, steps that came late; and whom they touched.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "reckon/peer/world/peer_view.hpp"

namespace reckon::tools {

/// The hands of a run; not null.
using Hands = std::vector<const peer::HandView*>;

/// Adds the hands of a peer, which must outlive the list.
void add_hands(const peer::PeerView& view, Hands& hands);

/// "walls 1425 of 20000 N/m": one for each thing that this device shows softer than the scene asks.
[[nodiscard]] std::vector<std::string> softer_than_asked(const peer::DeviceStiffness& device);

/// Lines of a summary; what did not happen has none, but that no hand was touched is said.
void print_hands(std::FILE* out, const Hands& hands);
/// An array with an object for each hand; docs/json_lines.md has its keys.
[[nodiscard]] std::string hands_json(const Hands& hands);
/// A line for each hand: what it feels of each entity of others at this instant. @param seconds
/// since the start
[[nodiscard]] std::string felt_lines(const peer::PeerView& view, double seconds);

}  // namespace reckon::tools
