// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Emitters, IFF systems and radios as text and JSON, for the inspector and for a peer.
#pragma once

#include <chrono>
#include <span>
#include <string>

#include "reckon/peer/emissions/emission.hpp"
#include "reckon/peer/world/peer_view.hpp"

namespace reckon::tools {

/// A table with one line for each system and each beam, in order.
/// @param origin zero of the shown times  @param now to find systems that have ended
[[nodiscard]] std::string emissions_table(std::span<const peer::Emission* const> rows,
                                          std::chrono::nanoseconds origin,
                                          std::chrono::nanoseconds now);

/// All emissions of an entity, in one line: "2 beams of 3 emitters, 9.4 GHz, 1 target; IFF off".
[[nodiscard]] std::string emitted_text(const peer::EmittedView& view);

/// One JSON object; docs/json_lines.md lists its keys. Parameters as above.
void append_emission_json(std::string& out, const peer::Emission& emission,
                          std::chrono::nanoseconds origin, std::chrono::nanoseconds now);

}  // namespace reckon::tools
