// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/live_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tools/exercise/body_report.hpp"
#include "reckon/tools/exercise/hand_report.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using peer::PeerView;

constexpr double kDegrees = 57.29577951308232;

std::string thresholds_text(const deadreckon::Thresholds& thresholds) {
  const bool is_small = thresholds.position < 0.1;
  return fmt::format("thresholds {:.2g} {}, {:.2g} deg",
                     (is_small ? 1e3 : 1.0) * thresholds.position, is_small ? "mm" : "m",
                     thresholds.angle * kDegrees);
}

// Without hands: of the entities, if all have the same.
std::vector<std::string> title_parts(const LivePicture& picture, double bar_end) {
  const auto& scene = picture.scene;
  std::vector<std::string> parts{fmt::format("{}  {:.1f} s", scene.name, picture.elapsed)};
  const auto has_hands = [](const TablePeer& peer) { return !peer.view->own_hands().empty(); };
  if (std::ranges::any_of(picture.peers, has_hands)) {
    const auto& thresholds = scene.dead_reckoning.thresholds;
    parts.push_back(fmt::format("{}, {:.2g} N", thresholds_text(thresholds), thresholds.force));
    parts.push_back(fmt::format("bars to {:g} N", bar_end));
    return parts;
  }
  std::set<std::string> all;
  for (const peer::EntityConfig& entity : scene.entities)
    all.insert(thresholds_text(entity.dead_reckoning.thresholds));
  if (all.size() == 1) parts.push_back(*all.begin());
  return parts;
}

}  // namespace

std::string title_of(const LivePicture& picture, double bar_end, std::size_t columns) {
  const std::vector<std::string> parts = title_parts(picture, bar_end);
  std::string title = parts.front();
  for (const std::string& part : std::span(parts).subspan(1))
    if (text_width(title) + part.size() + 3 <= columns) title += "   " + part;
  return title;
}

std::string softer_text(const LivePicture& picture) {
  std::set<std::string> all;
  for (const TablePeer& peer : picture.peers) {
    for (const peer::HandView& hand : peer.view->own_hands()) {
      for (std::string& sentence : softer_than_asked(hand.stiffness))
        all.insert(std::move(sentence));
    }
  }
  std::string text;
  for (const std::string& sentence : all) text += (text.empty() ? "" : ", ") + sentence;
  return text.empty() ? text : "softer than asked: " + text;
}

std::string bodies_text(const LivePicture& picture) {
  std::string owners;
  std::size_t bodies = 0, awake = 0;
  std::uint64_t not_woken = 0;
  for (const TablePeer& peer : picture.peers) {
    const PeerView& view = *peer.view;
    if (owners.empty()) owners = owners_text(view, picture.peers.size() == 1);
    bodies += view.bodies;
    awake += view.bodies_awake;
    not_woken += view.bodies_not_woken;
  }
  if (owners.empty() && bodies == 0) return {};
  std::string text = fmt::format("bodies: {} of {} move", awake, bodies);
  if (!owners.empty()) text = "bodies " + owners;
  if (!owners.empty() && bodies > 0) text += fmt::format("; {} of our {} move", awake, bodies);
  if (not_woken > 0)
    text += fmt::format(", in {} steps one stayed at rest, because 64 moved", not_woken);
  return text;
}

std::string keys_text(const LivePicture& picture) {
  bool has_hands = false, stopped = false;
  for (const TablePeer& peer : picture.peers) {
    for (const peer::HandView& hand : peer.view->own_hands()) {
      has_hands = true;
      stopped |= hand.servo.stopped;
    }
  }
  const std::string quit = "[q] quit";
  if (!has_hands) return quit;
  return (stopped ? "[s] restore forces   " : "[s] stop all forces   ") + quit;
}

void append_head(std::string_view head, std::size_t columns, std::vector<ScreenLine>& out) {
  while (!head.empty() && columns > 0) {
    out.push_back({std::string(head.substr(0, columns))});
    head.remove_prefix(std::min(columns, head.size()));
  }
}

std::vector<ScreenLine> notice_lines(std::span<const std::string> notices, std::size_t columns,
                                     std::size_t room) {
  std::vector<ScreenLine> lines;
  for (std::size_t i = notices.size(); i-- > 0;) {
    const std::vector<std::string> wrapped = wrap(notices[i], columns);
    if (!lines.empty() && lines.size() + wrapped.size() > room) break;
    std::size_t at = 0;
    for (const std::string& line : wrapped)
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at++), ScreenLine{line});
  }
  lines.resize(std::min(lines.size(), room));
  return lines;
}

}  // namespace reckon::tools
