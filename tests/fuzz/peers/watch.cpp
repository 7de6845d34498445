// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/peers/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "reckon/pdu/seconds.hpp"

namespace reckon::fuzz {
namespace {

using aoim::PresenceEventKind;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr nanoseconds kPatience = milliseconds(6100);
constexpr nanoseconds kDispute = milliseconds(500);
constexpr nanoseconds kQuiet = milliseconds(2400), kStraggler = milliseconds(250);
constexpr nanoseconds kLately = seconds(5);
constexpr nanoseconds kSlack = milliseconds(150);  // between two steps of an idle process
// A peer younger than this, or unheard for this long, is no witness.
constexpr nanoseconds kWitness = seconds(2);
constexpr nanoseconds kLeaveTime = seconds(1);
constexpr std::uint64_t kMostASecond = 12, kMostInCalm = 8;
constexpr std::size_t kMostIds = 7;

}  // namespace

void Watch::report(int invariant, nanoseconds now, std::size_t life, std::size_t other,
                   std::string sentence) {
  if (!finding_) finding_ = LivesFinding{{invariant, now, std::move(sentence)}, life, other};
}

std::size_t Watch::life_of(std::uint32_t epoch) const noexcept {
  for (std::size_t i = 0; i < lives_.size(); ++i) {
    if (lives_[i].epoch == epoch) return i;
  }
  return kNobody;
}

// -------------------------------------------------------------------------------------- events

void Watch::see_event(std::size_t life, const aoim::PresenceEvent& event, const PeerDatagram* cause,
                      nanoseconds now) {
  const bool ends = event.kind == PresenceEventKind::restarted ||
                    event.kind == PresenceEventKind::departed ||
                    event.kind == PresenceEventKind::timed_out;
  if (ends) see_end(life, event, now);
  const bool lists = event.kind == PresenceEventKind::newcomer ||
                     event.kind == PresenceEventKind::restarted ||
                     event.kind == PresenceEventKind::renamed;
  if (lists) listed_.try_emplace({life, event.announced.epoch, event.peer()}, now);
  see_farewell(life, event, now);
  if (event.kind == PresenceEventKind::identity_changed) see_rename(life, event, now);
  const bool forged = cause != nullptr && cause->sender == kNobody;
  if (forged && ends && event.kind != PresenceEventKind::timed_out) {
    const std::uint32_t epoch =
        event.kind == PresenceEventKind::restarted ? event.former_epoch : event.announced.epoch;
    const std::size_t other = life_of(epoch);
    const bool by_its_name = other != kNobody && lives_[other].alive && !lives_[other].frozen &&
                             lives_[other].has_had(event.peer());
    if (by_its_name) {
      report(
          9, now, life, other,
          fmt::format("a forged datagram ended the life {:08x} of {}", epoch, name(event.peer())));
    }
  }
}

// A life ends in the table of another: checks whether that is justified.
void Watch::see_end(std::size_t life, const aoim::PresenceEvent& event, nanoseconds now) {
  const bool restarted = event.kind == PresenceEventKind::restarted;
  const std::uint32_t epoch = restarted ? event.former_epoch : event.announced.epoch;
  const std::size_t other = life_of(epoch);
  const Life::Heard* heard = lives_[life].heard_of(epoch);
  if (other == kNobody || heard == nullptr) return;
  const Life& ended = lives_[other];
  const nanoseconds silence = lives_[life].known_silence(*heard, now);
  const auto tell = [&](std::string_view how) {
    report(3, now, life, other,
           fmt::format("{} {:08x} was taken for {} {:.3f} s after it was heard", name(event.peer()),
                       epoch, how, pdu::to_seconds(silence)));
  };
  if (event.kind == PresenceEventKind::timed_out && silence < kPatience - milliseconds(1)) {
    tell("timed out");
  }
  if (!ended.alive || ended.peer->id() != event.peer()) return;
  if (restarted && silence < kDispute) tell("restarted");
  if (restarted && silence < kQuiet && has_answered(life, epoch, event.announced.epoch, now)) {
    tell("restarted, having answered,");
  }
  const bool gave_up = std::count(ended.ids.begin(), ended.ids.end(), event.peer()) > 1;
  // If two live, the one that was listed first, at another address, takes the ID back.
  const auto since = [&](const Life& one) {
    const auto found = listed_.find({life, one.epoch, event.peer()});
    return found == listed_.end() ? nanoseconds::max() : found->second;
  };
  const bool goes_back = std::any_of(lives_.begin(), lives_.end(), [&](const Life& one) {
    return &one != &ended && one.alive && one.peer->id() == event.peer() &&
           since(one) < since(ended) && one.from.octets != ended.from.octets;
  });
  if (event.kind == PresenceEventKind::departed && !gave_up && !goes_back) tell("departed");
}

// The old life has sent since the new one came. It is checked only if the case is plain: a new life
// that was never renamed and came recently, at a peer that has never slept.
bool Watch::has_answered(std::size_t life, std::uint32_t old_epoch, std::uint32_t young_epoch,
                         nanoseconds now) const noexcept {
  const std::size_t young = life_of(young_epoch);
  if (young == kNobody || lives_[young].ids.size() > 1 || lives_[life].slept > nanoseconds(0)) {
    return false;
  }
  const Life::Heard* old_heard = lives_[life].heard_of(old_epoch);
  const Life::Heard* young_heard = lives_[life].heard_of(young_epoch);
  if (old_heard == nullptr || young_heard == nullptr) return false;
  const nanoseconds came = young_heard->announced;
  return came < now && now - came < kLately && old_heard->usable > came + kStraggler;
}

// Datagrams sent before a leave announcement may arrive after it.
void Watch::see_farewell(std::size_t life, const aoim::PresenceEvent& event, nanoseconds now) {
  const std::size_t other = life_of(event.announced.epoch);
  if (other == kNobody || !lives_[other].left) return;
  if (event.kind == PresenceEventKind::departed) {
    farewells_.push_back({life, other, event.peer(), now});
  }
  if (event.kind != PresenceEventKind::newcomer) return;
  for (const Farewell& said : farewells_) {
    if (said.to != life || said.of != other || said.id != event.peer()) continue;
    if (now - said.at > kLeaveTime) continue;
    report(3, now, life, other,
           fmt::format("{} {:08x} was a newcomer {:.3f} s after its good-bye", name(event.peer()),
                       event.announced.epoch, pdu::to_seconds(now - said.at)));
  }
}

// Most of the others know it under this id, and at no fewer addresses than the rest. The processes
// of one host are one witness; a peer that has just started is none. Two peers alone cannot decide
// who was first.
bool Watch::is_believed(std::size_t life, aoim::PeerId id, nanoseconds now) const noexcept {
  std::size_t others = 0, witnesses = 0;
  std::set<std::uint8_t> with, without;  // the last octet of their addresses
  for (std::size_t i = 0; i < lives_.size(); ++i) {
    if (i == life || !lives_[i].alive) continue;
    ++others;
    const aoim::Peer* known = lives_[i].peer->find(lives_[life].epoch);
    const bool hears = known != nullptr && known->id() == id && known->source == lives_[life].from;
    const Life::Heard* heard = lives_[life].heard_of(lives_[i].epoch);
    const bool tells = heard != nullptr && now - heard->any < kWitness;
    const bool is_witness = hears && tells && !lives_[i].frozen && now - lives_[i].born >= kWitness;
    witnesses += is_witness ? 1 : 0;
    (is_witness ? with : without).insert(lives_[i].from.octets.back());
  }
  return 2 * witnesses > others && with.size() >= without.size();
}

void Watch::see_rename(std::size_t life, const aoim::PresenceEvent& event, nanoseconds now) {
  const Life& renamed = lives_[life];
  if (now > calm_ + settle_ && !is_newcomer(renamed)) {
    report(2, now, life, kNobody,
           fmt::format("{} became {} in the calm", name(event.former), name(event.peer())));
  }
  if (renamed.ids.size() >= kMostIds) {
    report(10, now, life, kNobody, fmt::format("renamed {} times", kMostIds));
  }
  const bool contested = std::any_of(lives_.begin(), lives_.end(), [&](const Life& other) {
    return &other != &renamed && other.has_had(event.former);
  });
  if (!contested && is_believed(life, event.former, now) && now - renamed.id_since > kHeld) {
    report(9, now, life, kNobody,
           fmt::format("{}, held for {:.3f} s and wanted by nobody else, was given up for {}",
                       name(event.former), pdu::to_seconds(now - renamed.id_since),
                       name(event.peer())));
  }
}

// ------------------------------------------------------------------------------------ datagrams

void Watch::see_received(std::size_t life, const PeerDatagram& datagram,
                         const aoim::Incoming& incoming, nanoseconds now) {
  if (datagram.sender == kNobody) return see_forged(life, datagram, incoming, now);
  if (lives_[life].peer->was_misjudged()) {
    report(7, now, life, datagram.sender,
           fmt::format("number {} of {:08x} in group {} got verdict {}", incoming.trailer.sequence,
                       incoming.trailer.epoch, datagram.group.value,
                       static_cast<int>(incoming.verdict)));
  }
  if (incoming.verdict == aoim::IncomingVerdict::use &&
      lives_[life].peer->find(datagram.epoch) == nullptr) {
    report(7, now, life, datagram.sender,
           fmt::format("a datagram of {:08x}, which is not listed, was used", datagram.epoch));
  }
  see_too_old(life, datagram, incoming, now);
}

// Compares with the numbers that the life itself has sent: a stranger may have sent more in its
// name.
void Watch::see_too_old(std::size_t life, const PeerDatagram& datagram,
                        const aoim::Incoming& incoming, nanoseconds now) {
  std::uint32_t& highest = highest_[{life, datagram.sender, datagram.group.value}];
  const std::uint32_t sequence = incoming.trailer.sequence;
  highest = std::max(highest, sequence);
  const bool in_time = sequence + aoim::SequenceTracker::kWindow > highest;
  if (incoming.verdict != aoim::IncomingVerdict::too_old || !in_time) return;
  report(
      7, now, life, datagram.sender,
      fmt::format("number {} of {:08x} was too old, after {}", sequence, datagram.epoch, highest));
}

void Watch::see_counted_stranger(std::size_t life, const PeerDatagram& datagram, nanoseconds now) {
  report(7, now, life, datagram.sender,
         fmt::format("a number of {:08x} was counted, which was not listed", datagram.epoch));
}

void Watch::see_forged(std::size_t life, const PeerDatagram& datagram,
                       const aoim::Incoming& incoming, nanoseconds now) {
  const std::size_t victim = life_of(datagram.epoch);
  if (victim == kNobody || victim == life || !lives_[victim].alive) return;
  const aoim::Peer* known = lives_[life].peer->find(datagram.epoch);
  if (known == nullptr || known->source != lives_[victim].from) return;
  const Life::Heard* heard = lives_[life].heard_of(datagram.epoch);
  const bool fresh = heard != nullptr && lives_[life].silence(*heard, now) < seconds(3);
  if (fresh && incoming.verdict == aoim::IncomingVerdict::use) {
    report(9, now, life, victim,
           fmt::format("a forged datagram of {:08x} was used", datagram.epoch));
  }
}

void Watch::see_step(std::size_t life, nanoseconds now) {
  check_listed(life, now);
  check_bounds(life, now);
  check_pace(life, now);
}

void Watch::check_listed(std::size_t life, nanoseconds now) {
  const Life& own = lives_[life];
  for (const aoim::Peer& peer : own.peer->aoim().presence().peers()) {
    const std::uint32_t epoch = peer.announced.epoch;
    const Life::Heard* heard = own.heard_of(epoch);
    const std::size_t listed = life_of(epoch);
    // A stranger that was received first keeps it alive.
    if (listed != kNobody && peer.source != lives_[listed].from) continue;
    if (heard == nullptr || own.silence(*heard, now) <= kPatience + kSlack) continue;
    report(4, now, life, life_of(epoch),
           fmt::format("{} {:08x} is listed {:.3f} s after it was heard", name(peer.id()), epoch,
                       pdu::to_seconds(own.silence(*heard, now))));
  }
}

void Watch::check_bounds(std::size_t life, nanoseconds now) {
  const auto& aoim = lives_[life].peer->aoim();
  if (aoim.presence().peers().size() > table_size(plan_.hosts.size())) {
    report(5, now, life, kNobody, "more peers are listed than the table has rows");
  }
  if (aoim.sequences().size() > kTracked) {
    report(5, now, life, kNobody, "more senders are tracked than there is room");
  }
  if (aoim.next_step() < now - seconds(1) && aoim.next_step() != nanoseconds::min()) {
    report(5, now, life, kNobody, "the next step is due in the past");
  }
}

void Watch::check_pace(std::size_t life, nanoseconds now) {
  if (life >= paces_.size()) paces_.resize(life + 1);
  Pace& pace = paces_[life];
  const std::uint64_t announced = lives_[life].peer->aoim().presence().counts().announced;
  const std::int64_t second = now / seconds(1);
  if (second != pace.second) {
    pace.second = second;
    pace.at_second = announced;
  }
  if (announced - pace.at_second > kMostASecond) {
    report(10, now, life, kNobody,
           fmt::format("{} announcements in a second", announced - pace.at_second));
  }
  if (now < probe_ - seconds(5)) pace.at_calm = announced;
  const bool quiet = now < probe_ && !is_newcomer(lives_[life]);
  if (quiet && announced - pace.at_calm > kMostInCalm) {
    report(10, now, life, kNobody,
           fmt::format("{} announcements in 5 s of calm", announced - pace.at_calm));
  }
}

}  // namespace reckon::fuzz
