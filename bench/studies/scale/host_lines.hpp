// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the two ends of `bench scale --whole hosts` say to each other, a JSON object a line from the
// host, a word a line to it.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "reckon/bench/studies/scale/whole_runs.hpp"

namespace reckon::bench {

/// Asked for at once and answered with kClockLine, which tells how long a line is under way.
inline constexpr std::string_view kClockWord = "clock";
inline constexpr std::string_view kClockLine = R"({"kind":"clock"})";

/// The word with which a host's processes begin so long after they read it.
[[nodiscard]] std::string begin_word(std::chrono::nanoseconds after);
/// Nothing for other words.
[[nodiscard]] std::optional<std::chrono::nanoseconds> read_begin_word(std::string_view word);

/// All processes of a host are there. @param scene hash of what they announce
[[nodiscard]] std::string ready_line(std::uint64_t scene);
/// The hash; nothing for other lines.
[[nodiscard]] std::optional<std::uint64_t> read_ready_line(std::string_view line);

/// How the process of a peer ended.
[[nodiscard]] std::string peer_line(std::size_t peer, const PeerProcess& process);
/// False for other lines, and those that are damaged.
[[nodiscard]] bool read_peer_line(std::string_view line, std::size_t& peer, PeerProcess& process);

}  // namespace reckon::bench
