// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Options of `reckon replay`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tools/captures/exercise_map.hpp"
#include "reckon/tools/captures/replay_senders.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/datagrams/selection.hpp"

namespace reckon::tools {

struct ReplayOptions {
  std::string file;
  std::vector<std::string> to;  ///< as typed: a destination, the end of the range, or both
  std::optional<peer::IpEndpoint> destination;
  bool broadcast = false;
  std::string interface;  ///< empty: lo, or the interface of the broadcast address
  double rate = 1.0;
  std::uint64_t loop = 1;
  bool rewrite_time = false;
  bool json = false;
  std::string key;  ///< file; empty: none
  SelectionOptions selection;
  ExerciseMapOptions map;
};

/// @return the exit status, if there is nothing to run  @throws UsageError
[[nodiscard]] std::optional<int> parse_replay(Arguments arguments, const Console& console,
                                              ReplayOptions& options);

/// Whether a capture can be read a second time from its beginning: a pipe cannot.
[[nodiscard]] bool can_be_read_again(const std::string& file);

}  // namespace reckon::tools
