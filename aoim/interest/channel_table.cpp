// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/channel_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace reckon::aoim {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

// An Entity State of 144 octets, one with articulations and one with haptic records too.
constexpr std::array<Channel, 4> kDefault{{
    {1.0, Body::full, 1000.0, 1000.0, 232.0, true, 1.0},
    {50.0, Body::full, 30.0, 0.2, 232.0, false, 1.0},
    {200.0, Body::approximate, 10.0, 0.2, 176.0, false, 4.0},
    {kForever, Body::rigid, 1.0, 0.2, 144.0, false, 16.0},
}};

void refuse(std::size_t row, const char* why) {
  throw std::invalid_argument("channel " + std::to_string(row) + ": " + why);
}

void check(const Channel& channel, std::size_t row) {
  if (!(channel.farthest >= 0.0)) refuse(row, "farthest must be 0 or more");
  if (!(channel.octets > 0.0 && channel.octets < kForever)) refuse(row, "octets must be above 0");
  if (!(channel.coarser >= 1.0 && channel.coarser < kForever))
    refuse(row, "coarser must be 1 or more, and finite");
  for (const double rate : {channel.active_hz, channel.passive_hz}) {
    if (!(rate >= 0.0 && rate < kForever)) refuse(row, "a rate must be 0 or more, and finite");
  }
}

void check(const Channel& channel, const Channel& before, std::size_t row) {
  if (!(channel.farthest > before.farthest)) refuse(row, "farthest must grow from row to row");
  if (channel.kept && !before.kept) refuse(row, "kept rows must come first");
  if (!(channel.coarser >= before.coarser)) refuse(row, "coarser must not shrink from row to row");
  const bool less = channel.active_hz * channel.octets <= before.active_hz * before.octets &&
                    channel.passive_hz * channel.octets <= before.passive_hz * before.octets;
  if (!less) refuse(row, "takes more octets a second than the nearer row before it");
}

}  // namespace

std::span<const Channel> default_channels() noexcept { return kDefault; }

ChannelTable::ChannelTable(std::span<const Channel> channels)
    : channels_(channels.begin(), channels.end()) {
  if (channels_.empty()) throw std::invalid_argument("a channel table needs a row");
  for (std::size_t row = 0; row < channels_.size(); ++row) {
    check(channels_[row], row);
    if (row > 0) check(channels_[row], channels_[row - 1], row);
    kept_rows_ += channels_[row].kept;
  }
}

std::size_t ChannelTable::row(double distance, double stretch) const noexcept {
  const double away = std::isnan(distance) ? kForever : distance;
  for (std::size_t row = 0; row < channels_.size(); ++row) {
    const Channel& channel = channels_[row];
    if ((channel.kept ? away : away * stretch) <= channel.farthest) return row;
  }
  return channels_.size();
}

double ChannelTable::rate(const ChannelClient& client, double stretch) const noexcept {
  const std::size_t at = row(client.distance, stretch);
  if (at == channels_.size()) return 0.0;
  const Channel& channel = channels_[at];
  return channel.octets * (client.active ? channel.active_hz : channel.passive_hz);
}

// As the stretch grows, clients pass from row to row, each at its own stretch.
ChannelBudget ChannelTable::fit(std::span<const ChannelClient> clients, double octets_per_second) {
  ChannelBudget budget;
  passages_.clear();
  for (const ChannelClient& client : clients) {
    double rate_now = rate(client);
    budget.octets_per_second += rate_now;
    for (std::size_t at = row(client.distance); at < channels_.size(); ++at) {
      const double stretch = channels_[at].farthest / client.distance;
      if (channels_[at].kept || !(stretch < kForever)) break;
      double above = std::nextafter(stretch, kForever);
      while (client.distance * above <= channels_[at].farthest) {
        above = std::nextafter(above, kForever);
      }
      const double rate_then = rate(client, above);
      passages_.push_back({above, rate_now - rate_then});
      rate_now = rate_then;
    }
  }
  if (budget.octets_per_second <= octets_per_second) return budget;
  std::sort(passages_.begin(), passages_.end(),
            [](const Passage& a, const Passage& b) { return a.stretch < b.stretch; });
  for (const Passage& passage : passages_) {
    // Clients with the same stretch pass together.
    if (budget.octets_per_second <= octets_per_second && passage.stretch > budget.stretch) break;
    budget.stretch = passage.stretch;
    budget.octets_per_second -= passage.saved;
  }
  // Summed again, without the rounding errors of the subtractions.
  budget.octets_per_second = 0.0;
  for (const ChannelClient& client : clients) {
    budget.octets_per_second += rate(client, budget.stretch);
  }
  budget.met = budget.octets_per_second <= octets_per_second;
  return budget;
}

}  // namespace reckon::aoim
