// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Presence objects on a multicast segment with loss, delay and cuts, on its own clock.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/tests/aoim/support/samples.hpp"

namespace reckon::aoim::test {

using Kind = PresenceEventKind;

/// The source address of host `host`.
inline SourceAddress source(std::uint8_t host, std::uint16_t port = 4000) {
  SourceAddress from;
  from.octets = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 10, 77, 0, host};
  from.port = port;
  return from;
}

inline pdu::Presence established(pdu::Presence presence) {
  presence.flags |= pdu::kPresenceEstablished;
  return presence;
}

inline pdu::Presence leaving(pdu::Presence presence) {
  presence.flags |= pdu::kPresenceLeaving;
  return presence;
}

/// Kinds of the pending events.
inline std::vector<Kind> kinds(Presence& presence) {
  std::vector<Kind> all;
  for (const PresenceEvent& event : presence.take_events()) all.push_back(event.kind);
  return all;
}

/// Peers on a multicast segment: each datagram reaches everyone, the sender too, after 1 to 5 ms.
/// All can prove their identity.
class Segment {
 public:
  Segment(std::uint64_t seed, double loss, const PresenceConfig& config = {})
      : config_(config), random_(seed), loss_(loss) {
    config_.one_way = scrambled;
    config_.keyed_hash = scrambled_with;
  }

  Presence& add(const pdu::Presence& own) {
    config_.secret[0] = static_cast<std::uint8_t>(own.epoch);
    config_.secret[1] = static_cast<std::uint8_t>(own.epoch >> 8);
    sources_.push_back(source_of(peers_.size()));
    peers_.push_back(std::make_unique<Presence>(config_, own));
    state_.push_back(State::runs);
    peers_.back()->note_own_source(sources_.back(), now_);
    peers_.back()->start(now_);
    return *peers_.back();
  }
  void kill(std::size_t index) { state_[index] = State::dead; }
  /// Suspends a peer; datagrams to it wait.
  void pause(std::size_t index) { state_[index] = State::stands; }
  void go_on(std::size_t index) { state_[index] = State::runs; }
  /// No datagram of `from` reaches `to` while the function returns true.
  void cut(std::function<bool(std::size_t from, std::size_t to)> is_cut) {
    is_cut_ = std::move(is_cut);
  }

  /// From now on it sends from this address.
  void move(std::size_t index, const SourceAddress& to) { sources_[index] = to; }
  /// Sends an announcement of a non-peer from this address to all peers that peer `beside` reaches.
  void inject(const pdu::Presence& said, const SourceAddress& from, std::size_t beside) {
    for (std::size_t to = 0; to < peers_.size(); ++to) {
      if (is_cut_ && is_cut_(beside, to)) continue;
      flights_.push_back({now_ + milliseconds(1), kNobody, to, from, said});
    }
  }
  /// Called with the announcements of peers when they are sent, and with the events of peers.
  std::function<void(std::size_t from, const pdu::Presence&)> on_said = [](auto, const auto&) {};
  std::function<void(std::size_t to, const PresenceEvent&)> on_event = [](auto, const auto&) {};

  void run(nanoseconds length) {
    for (const nanoseconds end = now_ + length; now_ < end; now_ += milliseconds(1)) step();
  }
  /// Events of peer i of this kind.
  std::size_t count(std::size_t i, Kind kind) const {
    const auto found = events_.find({i, kind});
    return found == events_.end() ? 0 : found->second;
  }
  std::size_t count(Kind kind) const {
    std::size_t sum = 0;
    for (const auto& [key, count] : events_) sum += key.second == kind ? count : 0;
    return sum;
  }
  /// Whether all live peers have distinct ids and each knows all others by theirs.
  bool agree() const {
    std::set<PeerId> ids;
    std::vector<std::size_t> alive;
    for (std::size_t i = 0; i < peers_.size(); ++i) {
      if (state_[i] == State::dead) continue;
      alive.push_back(i);
      ids.insert(peers_[i]->id());
    }
    if (ids.size() != alive.size()) return false;
    return std::all_of(alive.begin(), alive.end(), [&](std::size_t i) {
      return std::all_of(alive.begin(), alive.end(), [&](std::size_t other) {
        return i == other || peers_[i]->epoch_of(peers_[other]->id()) == peers_[other]->own().epoch;
      });
    });
  }
  Presence& operator[](std::size_t i) { return *peers_[i]; }
  std::size_t size() const { return peers_.size(); }
  nanoseconds now() const { return now_; }
  static SourceAddress source_of(std::size_t i) {
    return source(static_cast<std::uint8_t>(1 + i % 250), static_cast<std::uint16_t>(4000 + i));
  }

 private:
  enum class State { runs, stands, dead };
  struct List {
    pdu::PeersHeard list;
    Octets epochs;
  };
  struct Flight {
    nanoseconds arrives;
    std::size_t from, to;
    SourceAddress source;
    std::variant<pdu::Presence, List> said;
  };

  void step() {
    std::deque<Flight> arrived, rest;
    for (Flight& flight : flights_) {
      const bool waits = flight.arrives > now_ || state_[flight.to] == State::stands;
      (waits ? rest : arrived).push_back(std::move(flight));
    }
    flights_ = std::move(rest);
    for (Flight& flight : arrived) {
      if (state_[flight.to] != State::dead) deliver(flight);
    }
    for (std::size_t i = 0; i < peers_.size(); ++i) {
      if (state_[i] == State::runs) speak(i);
    }
  }
  void deliver(Flight& flight) {
    Presence& to = *peers_[flight.to];
    if (auto* said = std::get_if<pdu::Presence>(&flight.said)) {
      to.receive(*said, now_, flight.source);
    } else {
      auto& heard = std::get<List>(flight.said);
      heard.list.epochs = heard.epochs;
      to.receive(heard.list, now_, flight.source);
      if (to.standing(heard.list.epoch, &flight.source) == Standing::member)
        to.note_alive(heard.list.epoch, now_);
    }
  }
  void speak(std::size_t i) {
    for (const pdu::Presence& announced : peers_[i]->step(now_)) {
      send(i, announced);
      on_said(i, announced);
    }
    if (const auto heard = peers_[i]->take_list(now_)) {
      List said;
      said.list.epoch = peers_[i]->own().epoch;
      said.list.continues = heard->continues;
      for (const std::uint32_t epoch : heard->epochs) {
        said.epochs = said.epochs + record_octets(pdu::PeerEpoch{epoch});
      }
      send(i, said);
    }
    for (const PresenceEvent& event : peers_[i]->take_events()) {
      ++events_[{i, event.kind}];
      on_event(i, event);
    }
  }
  template <typename Said>
  void send(std::size_t from, const Said& said) {
    for (std::size_t to = 0; to < peers_.size(); ++to) {
      if (std::uniform_real_distribution<double>(0, 1)(random_) < loss_) continue;
      if (is_cut_ && is_cut_(from, to)) continue;
      const auto delay = milliseconds(1 + random_() % 5);
      flights_.push_back({now_ + delay, from, to, sources_[from], said});
    }
  }

  static constexpr std::size_t kNobody = ~std::size_t{0};

  PresenceConfig config_;
  std::vector<SourceAddress> sources_;
  std::mt19937_64 random_;
  double loss_;
  nanoseconds now_ = seconds(50);
  std::vector<std::unique_ptr<Presence>> peers_;
  std::vector<State> state_;
  std::deque<Flight> flights_;
  std::function<bool(std::size_t, std::size_t)> is_cut_;
  std::map<std::pair<std::size_t, Kind>, std::size_t> events_;
};

}  // namespace reckon::aoim::test
