// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The lines above and below the rows of the live table.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tools/exercise/live_table.hpp"
#include "reckon/tools/terminal/screen_line.hpp"

namespace reckon::tools {

/// The parts that fit into the columns.  @param bar_end [N], force of a full bar
[[nodiscard]] std::string title_of(const LivePicture& picture, double bar_end, std::size_t columns);
/// Sentences of all peers, each once; empty if all is shown as asked.
[[nodiscard]] std::string softer_text(const LivePicture& picture);
/// The owners of the bodies, and how many of the bodies simulated here move; empty without bodies.
[[nodiscard]] std::string bodies_text(const LivePicture& picture);
/// The present functions of the keys.
[[nodiscard]] std::string keys_text(const LivePicture& picture);
/// In as many lines as needed: a truncated address would be useless.
void append_head(std::string_view head, std::size_t columns, std::vector<ScreenLine>& out);
/// The newest notices that fit, but at least the begin of the last one.
[[nodiscard]] std::vector<ScreenLine> notice_lines(std::span<const std::string> notices,
                                                   std::size_t columns, std::size_t room);

}  // namespace reckon::tools
