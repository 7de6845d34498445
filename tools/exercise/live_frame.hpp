// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The lines of the live table above and below its rows.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tools/exercise/live_table.hpp"
#include "reckon/tools/terminal/screen_line.hpp"

namespace reckon::tools {

/// @param bar_end force that fills a bar [N]
[[nodiscard]] std::string title_of(const LivePicture& picture, double bar_end);
/// Of all peers, each thing once; empty where all is shown as asked.
[[nodiscard]] std::string softer_text(const LivePicture& picture);
/// Of the peer that moves the bodies; empty without bodies.
[[nodiscard]] std::string bodies_text(const LivePicture& picture);
/// What the keys do now.
[[nodiscard]] std::string keys_text(const LivePicture& picture);
/// In as many lines as it takes: an address that is cut leads nowhere.
void append_head(std::string_view head, std::size_t columns, std::vector<ScreenLine>& out);
/// The newest, as many as have room, and at least the begin of the last one.
[[nodiscard]] std::vector<ScreenLine> notice_lines(std::span<const std::string> notices,
                                                   std::size_t columns, std::size_t room);

}  // namespace reckon::tools
