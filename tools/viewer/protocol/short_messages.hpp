// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Short text messages of the viewer's server.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "reckon/peer/world/peer_view.hpp"
#include "reckon/tools/datagrams/ownership_text.hpp"
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
/// Owners of the bodies in the order of their numbers. @param rests see PeerView::bodies_rest
[[nodiscard]] inline std::string bodies_message(std::span<const peer::BodyOwnerView> owners,
                                                bool rests) {
  const auto append = [](std::string& text, const peer::BodyOwnerView& body) {
    JsonObject object(text);
    if (body.owner != pdu::SimulationAddress{})
      object.text("owner", fmt::format("{}:{}", body.owner.site, body.owner.application));
    object.value("ours", body.is_ours)
        .text("version", version_text(body.version))
        .value("changes", body.changes)
        .text("cause", cause_text(body.version))
        .end();
  };
  std::string out;
  JsonObject(out)
      .text("type", "bodies")
      .value("rests", rests)
      .array("owners", owners, append)
      .end();
  return out;
}
/// Sent last on a connection.
[[nodiscard]] inline std::string bye_message(std::string_view text) {
  std::string out;
  JsonObject(out).text("type", "bye").text("text", text).end();
  return out;
}

}  // namespace reckon::tools
