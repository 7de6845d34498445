// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/leaders/simulated_host.hpp"

#include <algorithm>

#include "reckon/pdu/bundle.hpp"
#include "reckon/tests/fuzz/leaders/times.hpp"

namespace reckon::fuzz::leaders {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double kRadius = 30.0;  // [m]
constexpr nanoseconds kHeartbeat = seconds(30), kLongestWait = milliseconds(100);
constexpr nanoseconds kIntroductionPeriod = milliseconds(10);

aoim::AreaOfInterestConfig config_of(const Plan& plan, std::size_t host) {
  aoim::AreaOfInterestConfig config;
  config.grid.scheme = aoim::CellScheme::square;
  config.grid.cell_size = 100.0;
  config.grid.pool = plan.hand_out ? 20 : 16;  // at least the number of groups handed out
  config.presence.capacity = 64;
  config.tracked = 256;
  config.leader.on = true;
  config.leader.pool = plan.pool;
  config.leader.hand_out = plan.hand_out;
  config.leader.settle = kSettle;
  config.leader.quarantine = kQuarantine;
  config.leader.lease = kLease;
  config.leader.refresh = kRefresh;
  config.leader.empty = kEmpty;
  if (plan.beacons) config.follow = {beacon_of((host + 1) % plan.hosts.size())};
  return config;
}

pdu::Presence presence_of(std::size_t host, std::uint32_t epoch, nanoseconds utc) {
  pdu::Presence own;
  own.simulation = {9, static_cast<std::uint16_t>(host + 1)};
  own.epoch = epoch;
  own.started = static_cast<std::uint32_t>(utc / seconds(1));
  own.scene_hash = 0x1EADE5;
  own.interest_radius = static_cast<float>(kRadius);
  return own;
}

}  // namespace

SimulatedHost::SimulatedHost(const Plan& plan, std::size_t host, std::uint32_t epoch,
                             nanoseconds clock, nanoseconds now)
    : place_(plan.hosts[host].place),
      beacon_(plan.beacons ? beacon_of(host) : 0),
      aoim_(config_of(plan, host), presence_of(host, epoch, now + clock)),
      maps_(plan.pool),
      sent_(plan.hosts[host].entities) {
  set_clock(clock);
  aoim_.introductions().set_owned(sent_.size());
  look_around(now);
  aoim_.start(now);
}

void SimulatedHost::look_around(nanoseconds now) {
  const aoim::Focus focus{place_, 0.0, kRadius};
  const aoim::PlacedBeacon beacon{beacon_, place_};
  if (beacon_ != 0) aoim_.leading()->set_beacons({&beacon, 1}, now);
  aoim_.listen(aoim::kCellTier, {&focus, 1}, now);
}

void SimulatedHost::take(const pdu::EntityState& state, std::uint32_t epoch, bool relayed) {
  const double version = state.location.z;
  Known& known = known_[state.entity_id];
  if (relayed && known.epoch == epoch && known.version >= version) return;
  known = {epoch, version};
}

void SimulatedHost::receive(aoim::GroupIndex group, std::span<const std::byte> datagram,
                            nanoseconds now, const aoim::SourceAddress& from, nanoseconds came) {
  maps_.look(role(), now);
  const aoim::Incoming incoming = aoim_.receive(group, datagram, now, from, came);
  maps_.look(role(), now);
  const std::uint32_t epoch = incoming.trailer.epoch;
  const auto& presence = aoim_.presence();
  if (incoming.verdict == aoim::IncomingVerdict::use) {
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
      if (bundled.header.pdu_type == pdu::PduType::group_map) maps_.hear(came);
      pdu::EntityState state;
      const bool counts = bundled.error == pdu::DecodeError::none &&
                          pdu::decode(bundled.bytes, state) == pdu::DecodeError::none &&
                          presence.epoch_of(state.entity_id.simulation()) == epoch;
      if (counts) take(state, epoch, false);
    }
  }
  deliver_events(aoim_, *this, now);
}

void SimulatedHost::receive(const aoim::RelayedState& relayed,
                            const aoim::SourceAddress&) noexcept {
  pdu::EntityState state;
  if (pdu::decode(relayed.octets, state) == pdu::DecodeError::none)
    take(state, relayed.epoch, true);
}

void SimulatedHost::send_due(nanoseconds now) {
  const aoim::GroupIndex group = aoim_.route(place_);
  for (std::size_t i = 0; i < sent_.size(); ++i) {
    Sent& sent = sent_[i];
    const bool changed =
        sent.version < version_ || now - sent.at >= kHeartbeat || sent.group != group;
    const bool asked =
        aoim_.must_send(aoim::kCellTier, entity(i), place_, {sent.at, sent.group}, now);
    if (!changed && !asked) continue;
    introductions_ += changed ? 0 : 1;
    pdu::EntityState state;
    state.entity_id = entity(i);
    state.location = {place_.x, place_.y, version_};
    static_cast<void>(aoim_.send(aoim::kCellTier, aoim::StatePayload{state}, place_, now));
    sent = {group, now, version_};
  }
}

void SimulatedHost::step(nanoseconds now, aoim::DatagramSink sink) {
  maps_.look(role(), now);
  look_around(now);
  send_due(now);
  aoim_.step(now, sink);
  maps_.look(role(), now);
  deliver_events(aoim_, *this, now);
}

void SimulatedHost::say_goodbye(nanoseconds now, aoim::DatagramSink sink) {
  aoim_.stop();
  aoim_.step(now, sink);
  aoim_.flush(now, sink);
}

nanoseconds SimulatedHost::next(nanoseconds now) const noexcept {
  nanoseconds next = std::min(aoim_.next_step(), now + kLongestWait);
  if (aoim_.introductions().is_pending()) next = std::min(next, now + kIntroductionPeriod);
  return std::max(next, now);
}

}  // namespace reckon::fuzz::leaders
