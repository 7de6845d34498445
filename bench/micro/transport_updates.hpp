// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Path of updates through the library, from the states of an owner to the table of another peer.
#pragma once

#include <array>
#include <bit>
#include <chrono>
#include <optional>
#include <vector>

#include "reckon/bench/micro/transport_ways.hpp"
#include "reckon/bench/timing/cpu_ns.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/loops/network_write_loop.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/overtaken_states.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

inline constexpr std::chrono::nanoseconds kUtc = std::chrono::hours(500'000);

/// Time of updates at each stage [ns].
struct Stages {
  double bundle = 0, send = 0, receive = 0, table = 0;
  [[nodiscard]] double all() const { return out() + in(); }
  [[nodiscard]] double out() const { return bundle + send; }
  [[nodiscard]] double in() const { return receive + table; }
};

/// The library's own parts, from an owner's states to the table of another peer.
class Updates {
 public:
  Updates(const Way& way, const GroupAddress& group, bool offload, std::size_t per_datagram)
      : group_(group),
        per_datagram_(per_datagram),
        scene_(parse_scene_file("[aoim]\nradius = \"100 km\"\ncell = \"10 km\"\n", "bench")),
        frame_(0.8, 0.1, 400),
        pool_(scene_.network.group, scene_.aoim.pool),
        aggregator_(bundling()),
        sender_(options_of(way.sender, offload), clock_),
        aoim_(aoim_config(scene_), presence(scene_, frame_, pool_, {{1, 1}, "me", 5, 0, false})),
        remote_(frame_, aoim_, settings(), counters_),
        states_(kEntities) {
    Cable::instance().enter(way.far);
    receiver_.emplace(options_of(way.receiver, offload), clock_);
    check(!receiver_->join(group), "join");
    Cable::instance().enter(false);
    const std::array<aoim::Focus, 1> here{{{{0, 0, 0}, 0.0, scene_.aoim.radius}}};
    static_cast<void>(aoim_.listen(aoim::kCellTier, here, std::chrono::nanoseconds(0)));
    for (std::uint16_t i = 0; i < kEntities; ++i) {
      deadreckon::KinematicState state;
      state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
      state.position = {10.0 * (i % 32), 10.0 * (i / 32), 0};
      state.velocity = {10, 0, 0};
      states_[i].header.exercise_id = scene_.network.exercise;
      states_[i].entity_id = {7, 1, static_cast<std::uint16_t>(i + 1)};
      states_[i].entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::air};
      check(deadreckon::to_wire(state, frame_, states_[i]) == deadreckon::ConversionError::none,
            "to_wire");
    }
    while (heard_ < kEntities) turn();
    check(remote_.rows().size() == kEntities, "the table lacks entities");
    check(receiver_->statistics().kernel_drops == 0, "the kernel dropped some");
  }

  [[nodiscard]] const UdpMulticast& sender() const { return sender_; }

  /// CPU for each update [ns], over a turn.
  Stages turn() {
    Stages sum;
    for (std::size_t i = 0; i < kRounds; ++i) {
      send_round(sum);
      take(sum);
    }
    return of_each(sum);
  }
  /// The same where each entity is looked at after each round, outside the time measured.
  Stages turn_watched() {
    Stages sum;
    for (std::size_t i = 0; i < kRounds; ++i) {
      send_round(sum);
      take(sum);
      for (const RemoteEntity& row : remote_.rows()) static_cast<void>(*row.state);
    }
    return of_each(sum);
  }
  /// The same with a receiver that is behind by as many datagrams as its ring holds, as if updates
  /// arrived faster than it handles them: it takes the newest of each entity, as the model loop
  /// does.
  Stages turn_behind() {
    Stages sum;
    // At ten million updates a second each entity has one every 100 us.
    for (std::size_t i = 0; i < kRoundsBehind; ++i) send_round(sum, std::chrono::microseconds(100));
    take_newest(sum);
    return of_each(sum, kRoundsBehind);
  }
  /// Share of the states of turn_behind() that were taken; the rest was overtaken.
  [[nodiscard]] double taken_share() const {
    return static_cast<double>(newest_taken_) / static_cast<double>(newest_seen_);
  }

 private:
  [[nodiscard]] std::size_t updates() const { return per_datagram_ * kDatagrams; }

  [[nodiscard]] Stages of_each(Stages sum, std::size_t rounds = kRounds) const {
    for (double* stage : {&sum.bundle, &sum.send, &sum.receive, &sum.table}) {
      *stage /= static_cast<double>(rounds * updates());
    }
    return sum;
  }

  void send_round(Stages& taken, std::chrono::nanoseconds period = std::chrono::milliseconds(200)) {
    const double begin = bench::cpu_ns();
    for (std::size_t i = 0; i < updates(); ++i) add_next(period);
    aggregator_.flush_due(now_, [this](aoim::GroupIndex, std::span<const std::byte> octets) {
      check(ring_.push(group_, {}, octets), "ring");
    });
    const double bundled = bench::cpu_ns();
    check(write_.step() == kDatagrams, "other datagrams than asked for");
    const double sent = bench::cpu_ns();
    taken.bundle += bundled - begin;
    taken.send += sent - bundled;
  }

  aoim::AggregatorConfig bundling() const {
    aoim::AggregatorConfig config;
    config.payload_limit = 1372;
    config.reserved = 0;
    config.exercise_id = scene_.network.exercise;
    return config;
  }
  RemoteSettings settings() const {
    RemoteSettings settings = remote_settings(scene_);
    settings.capacity = kEntities;
    return settings;
  }
  // After each round they are later by a period.
  void add_next(std::chrono::nanoseconds period) {
    if (next_ == kEntities) next_ = 0, now_ += period;
    pdu::EntityState& state = states_[next_++];
    state.header.timestamp = pdu::to_dis_timestamp(kUtc + now_, true);
    static_cast<void>(aggregator_.add(aoim::GroupIndex{1}, state, {},
                                      {now_, static_cast<std::uint32_t>(per_datagram_)}));
  }
  void take(Stages& taken) {
    for (std::size_t left = updates(); left > 0;) {
      const double begin = bench::cpu_ns();
      const std::size_t count = receiver_->receive(batch_);
      const double received = bench::cpu_ns();
      check(count > 0, "a datagram was lost");
      for (std::size_t i = 0; i < count; ++i) {
        const std::span<const Inbound> updates = decoder_.decode(batch_[i].bytes, {1, 1});
        remote_.prefetch(updates);
        for (const Inbound& update : updates) {
          check(remote_.take(update, {now_, kUtc + now_, now_, 0, {}, {}}, servo_), "refused");
          --left;
          ++heard_;
        }
      }
      taken.receive += received - begin;
      taken.table += bench::cpu_ns() - received;
    }
  }

  // Through the ring between the loops, as in a peer.
  void take_newest(Stages& taken) {
    const double begin = bench::cpu_ns();
    for (std::size_t left = kRoundsBehind * kDatagrams; left > 0;) {
      const std::size_t count = receiver_->receive(batch_);
      check(count > 0, "a datagram was lost");
      for (std::size_t i = 0; i < count; ++i) {
        check(inbound_.push(group_, now_, batch_[i].bytes, batch_[i].sender), "inbound ring");
      }
      left -= count;
    }
    const double received = bench::cpu_ns();
    while (const std::size_t count = inbound_.front(queued_)) {
      for (std::size_t i = 0; i < count; ++i) {
        waiting_[i] = {queued_[i].octets, {now_, kUtc + now_, now_, 0, {}, {}}};
      }
      overtaken_.look(std::span(waiting_).first(count));
      for (std::size_t i = 0; i < count; ++i) {
        if (overtaken_.is_whole(i)) {
          decoder_.leave_out(static_cast<std::size_t>(std::popcount(overtaken_.of(i))), false);
          continue;
        }
        const auto updates = decoder_.decode(waiting_[i].octets, {1, 1}, overtaken_.of(i));
        remote_.prefetch(updates);
        for (const Inbound& update : updates) {
          check(remote_.take(update, waiting_[i].arrival, servo_), "refused");
          ++newest_taken_;
        }
      }
      newest_seen_ += count * per_datagram_;
      inbound_.pop();
    }
    taken.receive += received - begin;
    taken.table += bench::cpu_ns() - received;
  }

  SteadyClock clock_;
  GroupAddress group_;
  std::size_t per_datagram_;
  SceneFile scene_;
  deadreckon::LocalFrame frame_;
  GroupPool pool_;
  Counters counters_, out_counters_;
  aoim::Aggregator aggregator_;
  UdpMulticast sender_;
  std::optional<UdpMulticast> receiver_;
  aoim::AreaOfInterestManager aoim_;
  RemoteEntities remote_;
  DatagramDecoder decoder_{scene_.network.exercise, counters_};
  DatagramRing ring_{std::size_t{2} << 20};  // size as in a peer
  NetworkWriteLoop write_{sender_, ring_, out_counters_};
  haptics::ServoSnapshot servo_;
  std::vector<pdu::EntityState> states_;
  std::array<Datagram, 64> batch_;
  DatagramRing inbound_{std::size_t{2} << 20};
  std::vector<QueuedDatagram> queued_{kRoundsBehind * kDatagrams};
  std::vector<ArrivedDatagram> waiting_{kRoundsBehind * kDatagrams};
  OvertakenStates overtaken_{scene_.network.exercise, kRoundsBehind* kDatagrams};
  std::size_t next_ = 0, heard_ = 0, newest_seen_ = 0, newest_taken_ = 0;
  std::chrono::nanoseconds now_ = std::chrono::seconds(1);
};

}  // namespace reckon::peer
