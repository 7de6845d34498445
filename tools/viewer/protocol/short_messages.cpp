// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/protocol/short_messages.hpp"

#include "reckon/tools/terminal/json_text.hpp"

namespace reckon::tools {

std::string note_message(std::string_view level, std::string_view text) {
  std::string out;
  JsonObject(out).text("type", "note").text("level", level).text("text", text).end();
  return out;
}

std::string hand_message(std::optional<std::uint16_t> hand, std::string_view text) {
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

std::string bye_message(std::string_view text) {
  std::string out;
  JsonObject(out).text("type", "bye").text("text", text).end();
  return out;
}

}  // namespace reckon::tools
