// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/live_table.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>

namespace reckon::tools {
namespace {

std::uint64_t count(const peer::Counters& counters, std::string_view name) {
  const peer::Counter* counter = counters.find(name);
  return counter == nullptr ? 0 : counter->value();
}

std::string id_text(const pdu::EntityId& id) {
  return fmt::format("{}:{}:{}", id.site, id.application, id.entity);
}

// Octets from the network, made harmless for a terminal.
std::string printable(const std::array<char, 12>& marking) {
  std::string text(marking.data());
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

void peer_block(std::string& out, const TablePeer& peer, const peer::SceneFile& scene,
                double elapsed) {
  const peer::PeerView& view = *peer.view;
  const haptics::ServoSnapshot& servo = view.servo();
  const auto to = std::back_inserter(out);
  fmt::format_to(
      to,
      "{:<14} hand ({:+6.1f} {:+6.1f} {:+6.1f}) mm  {:<7} force {:5.2f} N  energy {:.1e} J  "
      "sent {:.1f}/s  lost {}{}\n",
      id_text(view.own), 1e3 * servo.scp.x(), 1e3 * servo.scp.y(), 1e3 * servo.scp.z(),
      servo.in_mesh_contact ? "touches" : "free", servo.force.norm(), servo.port_energy,
      elapsed > 0 ? static_cast<double>(count(*peer.counters, "datagrams_out")) / elapsed : 0.0,
      count(*peer.counters, "datagrams_lost"), view.frozen ? "  FROZEN" : "");
  fmt::format_to(to, "  {:<12} {:<11} {:>3} {:>7} {:>9} {:>9} {:>7} {:>9} {:>8} {:>9}\n", "remote",
                 "marking", "drm", "rate", "jump", "threshold", "age", "force", "k1", "ledger");
  for (std::size_t i = 0; i < view.count; ++i) {
    const peer::EntityView& row = view.rows[i];
    fmt::format_to(to, "  {:<12} {:<11} {:>3} {:>4.1f} Hz {:>6.2f} mm {:>6.2f} mm {:>5.1f} s",
                   id_text(row.id), printable(row.marking), static_cast<int>(row.algorithm),
                   row.rate_hz, 1e3 * row.jump_m, 1e3 * scene.dead_reckoning.thresholds.position,
                   row.age);
    if (row.haptic) {
      fmt::format_to(to, " {:>7.2f} N {:>4.0f} N/m {:>6.2f} mJ", row.force_n, row.k1,
                     1e3 * row.ledger_j);
    }
    fmt::format_to(to, "{}\n", row.frozen ? "  frozen" : "");
  }
  if (view.count == 0) fmt::format_to(to, "  nobody heard yet\n");
  if (view.entities > view.count) {
    fmt::format_to(to, "  and {} more\n", view.entities - view.count);
  }
}

}  // namespace

std::string live_table(std::span<const TablePeer> peers, const peer::SceneFile& scene,
                       double elapsed) {
  std::string out;
  const auto& thresholds = scene.dead_reckoning.thresholds;
  fmt::format_to(std::back_inserter(out),
                 "{}  {:.1f} s   thresholds {:.2g} mm, {:.2g} deg, {:.2g} N\n", scene.name, elapsed,
                 1e3 * thresholds.position, thresholds.angle * 57.29577951308232, thresholds.force);
  for (const TablePeer& peer : peers) peer_block(out, peer, scene, elapsed);
  return out;
}

TableScreen::TableScreen(const Console& console)
    : console_(console), active_(isatty(fileno(console.out)) == 1) {}

void TableScreen::show(const std::string& table) {
  if (!active_) return;
  // Back to where the last table began, and clear from there.
  if (lines_ > 0) fmt::print(console_.out, "\033[{}F\033[J", lines_);
  std::fwrite(table.data(), 1, table.size(), console_.out);
  std::fflush(console_.out);
  lines_ = static_cast<int>(std::count(table.begin(), table.end(), '\n'));
}

}  // namespace reckon::tools
