// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/light_peer.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "reckon/aoim/interest/near_rows.hpp"
#include "reckon/aoim/presence/presence.hpp"
#include "reckon/pdu/reckon/cell_membership.hpp"
#include "reckon/pdu/reckon/peers_heard.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"
#include "reckon/pdu/reckon/time_exchange.hpp"
#include "reckon/peer/clocks/peer_clock.hpp"
#include "reckon/peer/scene/scene_cells.hpp"

namespace reckon::bench {
namespace {

aoim::AggregatorConfig aggregator_config(const ScaleSetting& setting, const ScaleDesign& design,
                                         std::uint32_t peer, std::size_t near_rows) {
  aoim::AggregatorConfig config;
  config.pool = design.areas ? setting.grid.pool * (1 + near_rows) : 1;
  config.sender = {1, static_cast<std::uint16_t>(peer + 1)};
  config.epoch = peer + 1;
  return config;
}

/// Of lists it is their times that count here: what they hold is the same for all.
const aoim::PresenceConfig& list_times() {
  static const aoim::PresenceConfig config = [] {
    aoim::PresenceConfig times;
    times.capacity = 1;
    return times;
  }();
  return config;
}
const aoim::PeerTable& nobody() {
  static const aoim::PeerTable table(1);
  return table;
}

}  // namespace

aoim::IntroductionConfig introduction_config(const ScaleSetting& setting, std::size_t near_rows) {
  aoim::IntroductionConfig config;
  config.pool = setting.grid.pool * (1 + near_rows);
  return config;
}

LightPeer::LightPeer(const ScaleSetting& setting, const ScaleDesign& design,
                     const OwnedRange& range, const aoim::CellPartition& cells, std::uint32_t peer,
                     std::size_t near_rows)
    : owned(range),
      aggregator(aggregator_config(setting, design, peer, near_rows)),
      simulation_{1, static_cast<std::uint16_t>(peer + 1)},
      lists_(list_times(), nobody()),
      quorum_(design.bundling ? 0U : 1U) {
  aoim::SubscriptionConfig config;
  if (cells.scheme() == aoim::CellScheme::quad_tree) config.leave_factor = peer::kTreeLeave;
  if (design.areas) subscription.emplace(cells, config);
  nears.assign(near_rows, aoim::Subscription(cells, aoim::near_subscription(config)));
}

void LightPeer::announce(const ScaleSetting& setting, bool is_due, std::chrono::nanoseconds now) {
  if (is_due) {
    add_presence(setting, now);
    if (!announced_) lists_.send_now(now);
    announced_ = now;
  }
  if (announced_ && lists_.take(now, said, announced_, *announced_ + list_times().heartbeat))
    add_list(setting, now);
}

void LightPeer::add_presence(const ScaleSetting& setting, std::chrono::nanoseconds now) {
  pdu::Presence presence;
  presence.simulation = simulation_;
  presence.epoch = simulation_.application;
  presence.scene_hash = setting.scene_hash;
  presence.interest_radius = static_cast<float>(setting.radius);
  presence.cell_scheme = setting.grid.scheme;
  presence.cell_size = static_cast<float>(setting.grid.cell_size);
  presence.pool_size = static_cast<std::uint16_t>(setting.grid.pool);
  add_control(presence, now);
  using Clocks = peer::PeerClocks;
  constexpr std::size_t kRounds = 32;  // in which all are told
  const std::size_t others = setting.peers - 1;
  const std::size_t echoed = std::min(
      others, std::clamp((others + kRounds - 1) / kRounds, Clocks::kEchoes, Clocks::kMostEchoes));
  const std::vector<std::byte> echoes(echoed * pdu::kFixedSize<pdu::TimeEcho>);
  pdu::TimeExchange exchange;
  exchange.simulation = simulation_;
  exchange.epoch = simulation_.application;
  exchange.echoes = echoes;
  if (echoed > 0) add_control(exchange, now);
}

void LightPeer::add_list(const ScaleSetting& setting, std::chrono::nanoseconds now) {
  const aoim::PresenceConfig lists;
  const std::size_t others = std::min(setting.peers - 1, lists.capacity);
  const std::vector<std::byte> epochs((others > lists.most_listed ? lists.part : others) *
                                      pdu::kFixedSize<pdu::PeerEpoch>);
  pdu::PeersHeard heard;
  heard.simulation = simulation_;
  heard.epoch = simulation_.application;
  heard.epochs = epochs;
  add_control(heard, now);
}

void LightPeer::tell_membership(pdu::MembershipAction action, std::size_t cells,
                                std::chrono::nanoseconds now) {
  const std::vector<std::byte> octets(cells * pdu::kFixedSize<pdu::CellIndex>);
  pdu::CellMembership membership;
  membership.simulation = simulation_;
  membership.epoch = simulation_.application;
  membership.action = action;
  membership.cells = octets;
  add_control(membership, now);
}

template <typename Pdu>
void LightPeer::add_control(const Pdu& pdu, std::chrono::nanoseconds now) {
  std::array<std::byte, 2048> octets;
  const std::size_t size = pdu::encode(pdu, octets);
  aggregator.add(aoim::kBaseGroup, std::span(octets).first(size), {now, quorum_});
}

}  // namespace reckon::bench
