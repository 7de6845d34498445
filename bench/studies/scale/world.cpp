// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "reckon/aoim/interest/focus_cover.hpp"
#include "reckon/aoim/presence/join_asks.hpp"
#include "reckon/bench/studies/scale/light_peer.hpp"
#include "reckon/bench/studies/scale/light_rows.hpp"
#include "reckon/bench/studies/scale/light_states.hpp"
#include "reckon/bench/studies/scale/listeners.hpp"
#include "reckon/bench/studies/scale/near_others.hpp"
#include "reckon/bench/studies/scale/noted_updates.hpp"
#include "reckon/bench/studies/scale/thread_cpu.hpp"
#include "reckon/bench/studies/scale/witnesses.hpp"
#include "reckon/pdu/compression/state_numbers.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/peer/world/audiences.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using aoim::GroupIndex;
using std::chrono::nanoseconds;

constexpr double kFociPeriod = 0.1, kGatherPeriod = 1, kAnnouncePeriod = 1;  // [s]
constexpr double kCrossingGap = 0.1;  // [s], of AreaOfInterestConfig

class World {
 public:
  World(const ScaleSetting& setting, const ScaleDesign& design, const ScaleTap& tap)
      : setting_(setting),
        design_(design),
        tap_(tap),
        crowd_(setting.crowd),
        cells_(peer::cells_of(scale_cells(setting))),
        cover_(cells_),
        channels_(design.channels ? scale_channels(setting) : ScaleChannels{}),
        introduction_(introduction_config(setting, channels_.near_rows)),
        ranges_(ranges_of(setting)),
        states_(crowd_, ranges_),
        witnesses_(setting, ranges_, channels_.near()),
        listeners_(setting, channels_.near_rows, witnesses_),
        others_(owners_, scale_channels(setting).rows),
        rows_(channels_, setting.grid.pool, {introduction_, others_, crowd_}) {
    for (std::uint32_t peer = 0; peer < setting.peers; ++peer) add_member(peer);
    others_ = NearOthers(owners_, scale_channels(setting).rows);
    owned_.reserve(crowd_.size());
    for (std::uint32_t e = 0; e < crowd_.size(); ++e) add_entity(e);
  }

  ScaleCounts run(const ScaleProgress& progress) {
    const auto ticks = static_cast<std::size_t>(
        std::llround((setting_.warm_up + setting_.seconds) * setting_.rate));
    const auto warm = static_cast<std::size_t>(std::llround(setting_.warm_up * setting_.rate));
    std::size_t counted = 0;
    for (std::size_t tick = 0; tick < ticks; ++tick) {
      if (tick == warm) begin_counting();
      step(tick);
      counted += tick >= warm;
      if (progress && !progress(static_cast<double>(tick + 1) / static_cast<double>(ticks))) break;
    }
    counts_.seconds = static_cast<double>(counted) / setting_.rate;
    counts_.peers = setting_.peers;
    counts_.entities = crowd_.size();
    counts_.groups = listeners_.groups();
    witnesses_.report(counts_);
    return counts_;
  }

 private:
  static std::vector<OwnedRange> ranges_of(const ScaleSetting& setting) {
    std::vector<OwnedRange> ranges(setting.peers);
    for (std::size_t p = 0; p < setting.peers; ++p) ranges[p] = owned_by(setting, p);
    return ranges;
  }

  void add_member(std::uint32_t peer) {
    members_.emplace_back(setting_, design_, ranges_[peer], cells_, peer, rows_.near_rows());
    for (std::uint32_t e = ranges_[peer].first; e < ranges_[peer].end; ++e) owners_.push_back(peer);
  }

  void add_entity(std::uint32_t e) {
    const pdu::EntityId id = states_.id_of(e);
    LightEntity owned{
        deadreckon::UpdatePolicy(
            setting_.thresholds, deadreckon::jittered_heartbeat(setting_.heartbeat, id),
            setting_.first_heartbeat, deadreckon::kDefaultSendRule, deadreckon::kEventRepeat),
        group_at(e), nanoseconds(0)};
    const deadreckon::HeartbeatGrid grid =
        deadreckon::heartbeat_grid(setting_.heartbeat, id.simulation());
    owned.policy.align_heartbeats(grid.step, grid.phase);
    if (design_.compression)
      owned.compressor = std::make_unique<peer::StateCompressor>(scale_compression(setting_));
    // As if the exercise had lasted long: what stands was told at any time within a heartbeat.
    const double share = static_cast<double>(std::hash<pdu::EntityId>{}(id) % 1009) / 1009;
    const bool is_old = !setting_.fresh && !crowd_.moves(e);
    const double since = is_old ? share * owned.policy.heartbeat() : 0;
    pdu::EntityState pdu;
    deadreckon::KinematicState state;
    const auto reason = is_old ? deadreckon::SendReason::heartbeat : deadreckon::SendReason::first;
    if (states_.encode(e, pdu) && states_.decode(pdu, state)) do
        owned.policy.sent(state, -since, reason);
      while (is_old &&
             owned.policy.silence() < 0.99 * owned.policy.heartbeat() - owned.policy.step());
    owned.told = -since;
    if (rows_.near_rows() > 0)
      rows_.set_tiers(owned, state, -since, reason, setting_.first_heartbeat);
    owned_.push_back(std::move(owned));
  }

  [[nodiscard]] GroupIndex group_at(std::uint32_t e) const {
    return design_.areas ? cells_.group(crowd_.position(e)) : aoim::kBaseGroup;
  }

  void begin_counting() {
    counts_ = {};
    witnesses_.begin_counting();
  }

  [[nodiscard]] bool is_tick_of(std::size_t tick, double period, std::size_t shift = 0) const {
    const auto every =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(period * setting_.rate)));
    return (tick + shift) % every == 0;
  }

  void step(std::size_t tick) {
    time_ = static_cast<double>(tick) / setting_.rate;
    now_ = pdu::from_seconds(time_);
    crowd_.advance(time_);
    listeners_.arrive(time_);
    if (is_tick_of(tick, kFociPeriod)) {
      const double begun = thread_cpu();
      for (std::uint32_t p = 0; p < members_.size(); ++p) set_foci(p);
      counts_.interest_cpu += thread_cpu() - begun;
    }
    if (is_tick_of(tick, kGatherPeriod)) gather();
    if (design_.channels && is_tick_of(tick, kFociPeriod)) {
      const double begun = thread_cpu();
      others_.update(crowd_);
      counts_.interest_cpu += thread_cpu() - begun;
    }
    const double begun = thread_cpu();
    if (setting_.fresh && design_.areas) introduce_all(tick);
    introduction_.expire(now_);
    for (std::uint32_t p = 0; p < members_.size(); ++p) {
      members_[p].announce(setting_, is_tick_of(tick, kAnnouncePeriod, p), now_);
      send(p);
    }
    counts_.send_cpu += thread_cpu() - begun;
    noted_.tell(witnesses_, states_.frame());
    witnesses_.look(time_, crowd_);
  }

  /// Where all begin together: each is heard by the others a tick later, and its joins, which
  /// nobody knew it for at once, with a later announcement.
  void introduce_all(std::size_t tick) {
    constexpr double kJoinsHeard = pdu::to_seconds(aoim::JoinAsks::kSaidAgain);
    if (tick == 1) introduction_.begin(aoim::kBaseGroup, now_);
    if (tick == 0 || !is_first_from(tick, kJoinsHeard)) return;
    for (LightPeer& member : members_) {
      for (std::size_t row = 0; row <= rows_.near_rows(); ++row) {
        const auto& cells = row < rows_.near_rows() ? member.nears[row] : *member.subscription;
        for (const GroupIndex cell : cells.joined())
          introduction_.begin(rows_.group(row, cell), now_);
        member.tell_membership(pdu::MembershipAction::join, cells.joined().size(), now_);
      }
    }
  }
  [[nodiscard]] bool is_first_from(std::size_t tick, double time) const {
    return time_ >= time && static_cast<double>(tick - 1) / setting_.rate < time;
  }

  void gather() {
    double fastest = 0;
    for (std::size_t e = 0; e < crowd_.size(); ++e) fastest = std::max(fastest, crowd_.speed(e));
    witnesses_.gather(time_, crowd_, 2 * fastest * kGatherPeriod + 0.1 * setting_.radius,
                      [&](std::uint32_t e) -> HeardBefore {
                        return {owned_[e].last_group, states_.state_of(e)};
                      });
  }

  void set_foci(std::uint32_t p) {
    LightPeer& member = members_[p];
    balls_.clear();
    for (std::uint32_t e = member.owned.first; e < member.owned.end; ++e)
      balls_.push_back({crowd_.position(e), crowd_.speed(e), setting_.radius});
    const auto foci = cover_.cover(balls_);
    const std::size_t witness = witnesses_.witness_of(p);
    if (witness < witnesses_.size()) witnesses_.set_foci(witness, foci);
    if (!member.subscription) return;
    change(p, rows_.near_rows(), member.subscription->update(foci, now_));
    const aoim::ChannelTable& table = others_.table();
    for (std::size_t row = 0; row < rows_.near_rows(); ++row) {
      near_foci_.clear();
      for (const aoim::Focus& focus : foci)
        near_foci_.push_back(near_focus(table, row, focus, setting_.radius, 1.0));
      change(p, row, member.nears[row].update(near_foci_, now_));
    }
  }

  /// What a peer joins and leaves of the groups of a row.
  void change(std::uint32_t p, std::size_t row, const aoim::SubscriptionChange& cells) {
    const bool at_once = now_ == nanoseconds(0);
    const double from = at_once ? 0 : time_ + setting_.join;
    for (const GroupIndex cell : cells.leave)
      listeners_.leave(p, rows_.group(row, cell), rows_.pool_of(rows_.group(row, cell)));
    for (const GroupIndex cell : cells.join) {
      listeners_.join(p, rows_.group(row, cell), from);
      if (!at_once) introduction_.begin(rows_.group(row, cell), now_);
    }
    counts_.joins += cells.join.size();
    const bool is_near = row < rows_.near_rows();
    if (!at_once && !cells.join.empty())
      members_[p].tell_membership(
          is_near ? pdu::MembershipAction::join_near : pdu::MembershipAction::join,
          cells.join.size(), now_);
  }

  [[nodiscard]] bool must_send(std::uint32_t e, GroupIndex group) const {
    const LightEntity& owned = owned_[e];
    if (group != owned.last_group && now_ - owned.last_whole >= pdu::from_seconds(kCrossingGap))
      return true;
    return introduction_.is_pending() &&
           introduction_.is_due(states_.id_of(e), group, owned.last_whole, now_);
  }

  void send(std::uint32_t p) {
    LightPeer& member = members_[p];
    for (std::uint32_t e = member.owned.first; e < member.owned.end; ++e) consider(member, e);
    const auto sink = [&](GroupIndex group, std::span<const std::byte> datagram) {
      count(p, group, datagram);
    };
    // What falls due before the next tick leaves at its own time.
    left_ = time_;
    const nanoseconds next = pdu::from_seconds(time_ + 1 / setting_.rate);
    while (const auto due = member.aggregator.next_deadline()) {
      if (*due >= next) break;
      left_ = std::max(time_, pdu::to_seconds(*due));
      member.aggregator.flush_due(std::max(now_, *due), sink);
    }
  }

  void consider(LightPeer& member, std::uint32_t e) {
    LightEntity& owned = owned_[e];
    const GroupIndex group = group_at(e);
    nanoseconds deadline = now_;
    if (design_.dead_reckoning) {
      const bool asked = design_.areas && must_send(e, group);
      if (asked) owned.policy.event();
      if (owned.audiences) {
        const LightRows::Due due =
            rows_.consider(owned, {e, states_.id_of(e), group, asked}, time_);
        if (due.reason == deadreckon::SendReason::none) return;
        if (due.is_patient && design_.bundling) deadline += pdu::from_seconds(setting_.hold);
        return send_state(member, e, {group, due.row}, deadline, due.reason);
      }
      const deadreckon::MotionSample truth = crowd_.motion(e);
      const auto reason = owned.policy.decide(
          {truth.position, truth.orientation, truth.velocity, truth.angular_velocity}, time_);
      if (reason == deadreckon::SendReason::none) return;
      if (design_.channels && may_wait(e, reason)) return;
      if (design_.bundling && !asked) deadline += pdu::from_seconds(setting_.hold);
      send_state(member, e, {group, rows_.near_rows()}, deadline, reason);
      return;
    }
    if (design_.bundling) deadline += pdu::from_seconds(setting_.hold);
    send_state(member, e, {group, rows_.near_rows()}, deadline, deadreckon::SendReason::event);
  }

  /// As a peer: where only the receivers' error asks for it, the nearest of them says how often.
  bool may_wait(std::uint32_t e, deadreckon::SendReason reason) {
    LightEntity& owned = owned_[e];
    if (reason != deadreckon::SendReason::position && reason != deadreckon::SendReason::orientation)
      return false;
    if (now_ < owned.held_until) return true;
    const aoim::Channel& channel = others_.channel(e, crowd_);
    const bool rests =
        !(crowd_.speed(e) > 0) && !peer::is_shown_moving(owned.policy, nullptr, 0, time_);
    const double rate = rests ? channel.passive_hz : channel.active_hz;
    const nanoseconds due = owned.last_sent + pdu::from_seconds(1 / rate);
    if (channel.kept || now_ >= due) return false;
    owned.held_until = std::min(due, now_ + pdu::from_seconds(kFociPeriod));
    return true;
  }

  void send_state(LightPeer& member, std::uint32_t e, const LightAddress& to, nanoseconds deadline,
                  deadreckon::SendReason reason) {
    pdu::EntityState pdu;
    deadreckon::KinematicState state;
    pdu.header.timestamp = pdu::to_dis_timestamp(now_, false);
    if (!states_.encode(e, pdu)) return;
    LightEntity& owned = owned_[e];
    if (design_.compression) static_cast<void>(pdu::quantise(pdu, {}));
    const bool decoded = states_.decode(pdu, state);
    LightAddress sent = to;
    bool needs_key = false;
    if (!design_.compression || !add_compressed(member, e, sent, deadline, reason, pdu, needs_key))
      member.aggregator.add(rows_.group(sent.row, sent.cell), pdu, {},
                            {deadline, design_.bundling ? 0U : 1U});
    owned.told = time_;
    if (design_.dead_reckoning && decoded) {
      owned.policy.sent(state, time_, reason);
      if (owned.audiences) owned.audiences->note_sent(sent.row, state, time_, reason, true);
    }
    if (sent.row < rows_.near_rows()) return;
    owned.last_group = sent.cell;
    owned.last_sent = now_;
    if (!needs_key) owned.last_whole = now_;
    owned.held_until = nanoseconds::min();
  }

  /// False where it is to go plain, as a key that does not wait. `leans`: on such a key.
  bool add_compressed(LightPeer& member, std::uint32_t e, LightAddress& to, nanoseconds& deadline,
                      deadreckon::SendReason reason, const pdu::EntityState& pdu, bool& needs_key) {
    const LightStates::Compressed made =
        states_.compress(e, owned_[e], pdu, to, reason, rows_.near_rows(), now_);
    to = made.to;
    needs_key = made.needs_key;
    if (made.is_key) deadline = now_;
    if (made.octets.empty()) return false;
    member.aggregator.add_compressed(rows_.group(to.row, to.cell), pdu.entity_id,
                                     owned_[e].compressor->form(), made.octets, {}, {deadline, 0U});
    return true;
  }

  void count(std::uint32_t p, GroupIndex group, std::span<const std::byte> datagram) {
    std::uint64_t updates = 0;
    for_each_update(datagram, [&](std::size_t number, std::span<const std::byte> octets) {
      ++updates;
      const auto e = static_cast<std::uint32_t>(ranges_[p].first + number - 1);
      if (octets.empty()) octets = states_.told(e);
      if (!witnesses_.is_near(e)) return;
      noted_.add({p, e, group, datagrams_, owned_[e].told, left_, rows_.pool_of(group)}, octets);
    });
    const std::size_t pool = rows_.pool_of(group);
    const bool hears_itself =
        group == aoim::kBaseGroup ||
        (pool == 0 ? members_[p].subscription->is_joined(group)
                   : members_[p].nears[pool - 1].is_joined(rows_.cell_of(group)));
    const std::uint64_t all = listeners_.of(group);
    const std::uint64_t listeners = all - (hears_itself && all > 0);
    ++datagrams_;
    members_[p].said = pdu::from_seconds(left_);
    ++counts_.datagrams;
    counts_.octets += datagram.size() + peer::kUdpIpv4Headers;
    counts_.updates += updates;
    counts_.control += updates == 0;
    counts_.heard_datagrams += listeners;
    counts_.heard_octets += listeners * (datagram.size() + peer::kUdpIpv4Headers);
    counts_.heard_updates += listeners * updates;
    if (tap_) tap_(left_, p, group, datagram);
  }

  ScaleSetting setting_;
  ScaleDesign design_;
  const ScaleTap& tap_;
  Crowd crowd_;
  aoim::CellPartition cells_;
  aoim::FocusCover cover_;  // of all peers, one after the other
  ScaleChannels channels_;
  aoim::Introduction introduction_;  // of all peers: they hear the same memberships
  std::vector<OwnedRange> ranges_;
  LightStates states_;
  Witnesses witnesses_;
  Listeners listeners_;
  std::vector<std::uint32_t> owners_;  // by entity
  std::vector<LightPeer> members_;
  std::vector<LightEntity> owned_;
  NearOthers others_;
  LightRows rows_;
  std::vector<aoim::Focus> balls_, near_foci_;
  NotedUpdates noted_;
  ScaleCounts counts_;
  std::uint64_t datagrams_ = 0;  // of the whole run: their fate hangs on it
  double time_ = 0, left_ = 0;
  nanoseconds now_{};
};

}  // namespace

ScaleCounts run_world(const ScaleSetting& setting, const ScaleDesign& design,
                      const ScaleProgress& progress, const ScaleTap& tap) {
  check_scale_setting(setting);
  return std::make_unique<World>(setting, design, tap)->run(progress);
}

}  // namespace reckon::bench
