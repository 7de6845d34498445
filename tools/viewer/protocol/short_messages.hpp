// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Short text messages of the viewer's server.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "reckon/tools/terminal/json_text.hpp"

namespace reckon::tools {

/// A line of the log. @param level "info" or "warning"
[[nodiscard]] inline std::string note_message(std::string_view level, std::string_view text) {
  std::string out;
  JsonObject(out).text("type", "note").text("level", level).text("text", text).end();
  return out;
}
/// Assigns a hand to a tab.
[[nodiscard]] inline std::string hand_message(std::optional<std::uint16_t> hand,
                                              std::string_view text) {
  std::string out;
  JsonObject object(out);
  object.text("type", "hand");
  if (hand)
    object.value("index", *hand);
  else
    object.value("index", "null");
  object.text("text", text).end();
  return out;
}
/// Sent last on a connection.
[[nodiscard]] inline std::string bye_message(std::string_view text) {
  std::string out;
  JsonObject(out).text("type", "bye").text("text", text).end();
  return out;
}

}  // namespace reckon::tools
