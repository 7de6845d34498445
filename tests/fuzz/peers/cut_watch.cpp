// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/peers/cut_watch.hpp"

#include <fmt/format.h>

#include "reckon/pdu/seconds.hpp"

namespace reckon::fuzz {
namespace {

using aoim::PresenceEventKind;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr nanoseconds kTold = milliseconds(3500);
constexpr nanoseconds kAcquainted = milliseconds(2500);  // required mutual reception before the cut

}  // namespace

nanoseconds CutWatch::patience() const noexcept {
  const double longest = (1 + plan_.line.jitter) * pdu::to_seconds(plan_.line.delay);
  return kTold + pdu::from_seconds(3 * longest);
}

// With other losses the arrival time of a list is unknown. A stranger that sends in the name of an
// unheard peer may be believed.
bool CutWatch::concerns(const Fault& fault) const noexcept {
  return fault.kind == FaultKind::one_way && plan_.line.loss == 0 && !has_forgery(plan_) &&
         fault.until - fault.at > patience();
}

void CutWatch::see_event(std::size_t life, const aoim::PresenceEvent& event, nanoseconds now) {
  Told& told = told_[{life, event.announced.epoch}];
  if (event.kind == PresenceEventKind::quiet) told.quiet = now;
  if (event.kind == PresenceEventKind::unheard) told.unheard = now;
}

bool CutWatch::knows(std::size_t life, std::size_t other, nanoseconds now) const noexcept {
  const Life& own = lives_[life];
  if (!own.alive || own.frozen || now - own.id_since < kAcquainted) return false;
  const aoim::Peer* peer = own.peer->find(lives_[other].epoch);
  return peer != nullptr && peer->joined && peer->id() == lives_[other].peer->id() &&
         !peer->quiet && !peer->unheard && now - peer->first_heard >= kAcquainted;
}

// No other cut affects the two, and earlier cuts have healed for long.
bool CutWatch::is_alone(std::size_t fault, std::size_t from, std::size_t to,
                        nanoseconds now) const noexcept {
  for (std::size_t i = 0; i < plan_.faults.size(); ++i) {
    const Fault& other = plan_.faults[i];
    const bool meanwhile = other.at <= now && other.until + kAcquainted >= plan_.faults[fault].at;
    if (i != fault && meanwhile && (cuts(other, from, to) || cuts(other, to, from))) return false;
  }
  return true;
}

void CutWatch::see_begin(std::size_t fault, nanoseconds now) {
  const Fault& cut = plan_.faults[fault];
  if (!concerns(cut)) return;
  for (std::size_t from = 0; from < lives_.size(); ++from) {
    if (lives_[from].host != cut.peer || !lives_[from].alive) continue;
    for (std::size_t to = 0; to < lives_.size(); ++to) {
      const bool deaf = to != from && cuts(cut, cut.peer, lives_[to].host);
      if (!deaf || !knows(from, to, now) || !knows(to, from, now)) continue;
      pairs_.push_back(
          {fault, from, to, slept(from, to), lives_[from].ids.size() + lives_[to].ids.size(), now});
    }
  }
}

void CutWatch::look(std::size_t fault, nanoseconds now, const Report& report) const {
  for (const Pair& pair : pairs_) {
    const Life &unheard = lives_[pair.unheard], &deaf = lives_[pair.deaf];
    const bool disturbed = !unheard.alive || !deaf.alive || unheard.frozen || deaf.frozen ||
                           slept(pair.unheard, pair.deaf) != pair.slept ||
                           unheard.ids.size() + deaf.ids.size() != pair.ids ||
                           !is_alone(pair.fault, unheard.host, deaf.host, now);
    if (pair.fault != fault || disturbed) continue;
    const auto told = [&](std::size_t life, std::size_t other) {
      const auto found = told_.find({life, lives_[other].epoch});
      return found == told_.end() ? Told{} : found->second;
    };
    const double cut_for = pdu::to_seconds(now - pair.begun);
    if (told(pair.deaf, pair.unheard).quiet < pair.begun) {
      report(pair.deaf, pair.unheard,
             fmt::format("{:08x} has not been heard for {:.3f} s, which was not told",
                         unheard.epoch, cut_for));
    }
    if (told(pair.unheard, pair.deaf).unheard < pair.begun) {
      report(pair.unheard, pair.deaf,
             fmt::format("{:08x} has not heard us for {:.3f} s, which was not told", deaf.epoch,
                         cut_for));
    }
  }
}

}  // namespace reckon::fuzz
