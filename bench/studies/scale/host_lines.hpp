// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Protocol of `bench scale --whole hosts`: a host sends one JSON object per line and receives one
// word a line.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "reckon/bench/studies/scale/whole_runs.hpp"

namespace reckon::bench {

/// Word that a host answers at once with kClockLine, to measure the round trip.
inline constexpr std::string_view kClockWord = "clock";
inline constexpr std::string_view kClockLine = R"({"kind":"clock"})";

/// The word to begin: the host's processes begin `after` from the time that it is read.
[[nodiscard]] std::string begin_word(std::chrono::nanoseconds after);
/// None for other words.
[[nodiscard]] std::optional<std::chrono::nanoseconds> read_begin_word(std::string_view word);

/// Reports that all processes of a host are ready. @param scene hash of their scene
[[nodiscard]] std::string ready_line(std::uint64_t scene);
/// The hash; none for other lines.
[[nodiscard]] std::optional<std::uint64_t> read_ready_line(std::string_view line);

/// Result of a peer's process.
[[nodiscard]] std::string peer_line(std::size_t peer, const PeerProcess& process);
/// False for other or damaged lines.
[[nodiscard]] bool read_peer_line(std::string_view line, std::size_t& peer, PeerProcess& process);

}  // namespace reckon::bench
