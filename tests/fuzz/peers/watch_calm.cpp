// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Invariants that hold once all faults have ended and all delayed datagrams have arrived.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/peers/watch.hpp"

namespace reckon::fuzz {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr nanoseconds kSettle = seconds(2);
constexpr nanoseconds kSettleSlept = seconds(3);
constexpr nanoseconds kSettleOld = seconds(5);
constexpr nanoseconds kAwaited = milliseconds(4500);  // for peers that may have been cut off
constexpr nanoseconds kRestartSeen = seconds(1), kJumpSeen = seconds(1);
constexpr double kSurelyInReach = 0.9 * kRadius;  // [m]

}  // namespace

void Watch::look(nanoseconds now) {
  if (now == calm_) settle_ = settling();
  if (now < calm_ + settle_) return;
  check_agreement(now, kSettle);
  if (plan_.probe == Probe::restart && now >= probe_ + kRestartSeen + milliseconds(50)) {
    check_restart(now);
  }
  check_jumped(now);
  const bool told = now >= calm_ + settle_ + kEntityHeartbeat + milliseconds(600);
  const bool moving = now >= probe_ - seconds(3) && now < probe_ + kSettle;
  if (told && (!moving || (plan_.probe == Probe::newcomers && now < probe_))) check_shown(now);
  for (std::size_t i = 0; i < lives_.size(); ++i) {
    if (lives_[i].alive) check_counts(i, now);
  }
}

nanoseconds Watch::settling() const noexcept {
  if (has_old_dispute() || has_legacy() || has_forgery(plan_)) return kSettleOld;
  const bool slept = std::any_of(lives_.begin(), lives_.end(), [](const Life& life) {
    return life.alive && life.slept_long > nanoseconds(0);
  });
  return slept ? kSettleSlept : kSettle;
}

// Two peers that were apart have held one id for long.
bool Watch::has_old_dispute() const noexcept {
  for (const Life& a : lives_) {
    for (const Life& b : lives_) {
      const bool both = &a != &b && a.alive && b.alive && a.peer->id() == b.peer->id();
      if (both && calm_ - std::max(a.id_since, b.id_since) >= kHeld) return true;
    }
  }
  return false;
}

// A peer requests the id of a life that has ended recently on another host: it may have been cut
// off. A peer that has slept waits that much longer.
bool Watch::has_legacy() const noexcept {
  nanoseconds awaited = kAwaited;
  for (const Life& life : lives_) {
    if (life.alive) awaited = std::max(awaited, kAwaited + life.slept_long);
  }
  for (const Life& heir : lives_) {
    for (const Life& dead : lives_) {
      const bool lately = !dead.alive && calm_ - dead.ended < awaited;
      const bool elsewhere = heir.from.octets != dead.from.octets;
      if (heir.alive && lately && elsewhere && heir.peer->id() == dead.ids.back()) return true;
    }
  }
  return false;
}

// Checks lives that are at least `young` old.
void Watch::check_agreement(nanoseconds now, nanoseconds young) {
  const auto counts = [&](const Life& life) { return life.alive && now - life.born >= young; };
  for (std::size_t a = 0; a < lives_.size(); ++a) {
    if (!counts(lives_[a])) continue;
    for (std::size_t b = 0; b < lives_.size(); ++b) {
      if (a == b || !counts(lives_[b])) continue;
      const aoim::PeerId id = lives_[b].peer->id();
      if (id == lives_[a].peer->id()) {
        return report(1, now, a, b, fmt::format("two living peers are {}", name(id)));
      }
      const aoim::Peer* peer = lives_[a].peer->find(lives_[b].epoch);
      if (peer != nullptr && peer->joined && peer->id() == id) continue;
      return report(1, now, a, b,
                    fmt::format("{} {:08x} is not seen by {}", name(id), lives_[b].epoch,
                                name(lives_[a].peer->id())));
    }
  }
}

// All others list the new life of the probed host, and none the old one.
void Watch::check_restart(nanoseconds now) {
  const Life& young = lives_.back();
  if (!young.alive || young.born < probe_ || young.ids.size() > 1) return;
  for (std::size_t i = 0; i + 1 < lives_.size(); ++i) {
    if (!lives_[i].alive) continue;
    const aoim::Peer* peer = lives_[i].peer->find(young.epoch);
    if (peer == nullptr || !peer->joined) {
      report(1, now, i, lives_.size() - 1, "a new life is not seen after 1 s");
    }
  }
}

// It has joined cells of whose entities it has received nothing yet.
void Watch::check_jumped(nanoseconds now) {
  const nanoseconds since = now - plan_.jump_at;
  if (plan_.jumper == kNobody || since < kJumpSeen || since > kJumpSeen + milliseconds(200)) return;
  for (std::size_t i = 0; i < lives_.size(); ++i) {
    const Life& own = lives_[i];
    if (own.host != plan_.jumper || !own.alive) continue;
    for (std::size_t b = 0; b < lives_.size(); ++b) {
      if (b == i || !lives_[b].alive) continue;
      const aoim::PeerId id = lives_[b].peer->id();
      for (const OwnEntity& entity : lives_[b].peer->entities()) {
        const auto in_reach = [&](nanoseconds then) {
          return own.peer->distance_to(entity.at(then), then) <= kSurelyInReach;
        };
        if (entity.speed > 0 || own.peer->joined(entity.at(now)) < plan_.jump_at) continue;
        if (!in_reach(plan_.jump_at) || !in_reach(now)) continue;
        if (!in_reach(now - since / 3) || !in_reach(now - 2 * since / 3)) continue;
        if (own.peer->shows({id.site, id.application, entity.number}, lives_[b].epoch)) continue;
        report(13, now, i, b,
               fmt::format("entity {} of {} {:08x} is not shown {:.3f} s after a jump to it",
                           entity.number, name(id), lives_[b].epoch, pdu::to_seconds(since)));
      }
    }
  }
}

void Watch::check_shown(nanoseconds now) {
  for (std::size_t i = 0; i < lives_.size(); ++i) {
    if (lives_[i].alive) check_shown_by(i, now);
  }
}

void Watch::check_shown_by(std::size_t life, nanoseconds now) {
  const Life& own = lives_[life];
  // Checked for more than a heartbeat: an entity that approaches in a joined cell is known with its
  // next heartbeat.
  const auto in_reach = [&](const OwnEntity& entity) {
    for (int i = 0; i < 15; ++i) {
      const nanoseconds then = now - i * milliseconds(400);
      if (own.peer->distance_to(entity.at(then), then) > kSurelyInReach) return false;
    }
    // Between two of these moments an own entity may have jumped away and come back by its own
    // speed.
    const bool jumped = plan_.jumper != kNobody && plan_.jump_at <= now;
    return !jumped || now - plan_.jump_at > milliseconds(5600) ||
           own.peer->distance_to(entity.at(plan_.jump_at), plan_.jump_at) <= kSurelyInReach;
  };
  for (std::size_t b = 0; b < lives_.size(); ++b) {
    if (b == life || !lives_[b].alive) continue;
    const aoim::PeerId id = lives_[b].peer->id();
    for (const OwnEntity& entity : lives_[b].peer->entities()) {
      if (!in_reach(entity)) continue;
      if (own.peer->shows({id.site, id.application, entity.number}, lives_[b].epoch)) continue;
      report(6, now, life, b,
             fmt::format("entity {} of {} {:08x} is in reach and not shown", entity.number,
                         name(id), lives_[b].epoch));
    }
  }
  for (const ShownEntity& shown : own.peer->shown()) {
    const std::size_t owner = life_of(shown.epoch);
    const aoim::Peer* listed = own.peer->find(shown.epoch);
    if (listed != nullptr && listed->id() == shown.id.simulation()) continue;
    report(6, now, life, owner,
           fmt::format("entity {} of {} {:08x} is shown and no more", shown.id.entity,
                       name(shown.id.simulation()), shown.epoch));
  }
}

void Watch::check_counts(std::size_t life, nanoseconds now) {
  const aoim::SequenceCounts& counts = lives_[life].peer->aoim().sequences().counts();
  if (counts.given_up > 0) return;
  const aoim::SequenceCounts truth = lives_[life].peer->truth().counts();
  const auto differs = [&](std::string_view what, std::uint64_t counted, std::uint64_t right) {
    if (counted == right) return;
    report(7, now, life, kNobody,
           fmt::format("{} {} datagrams counted, {} in truth", counted, what, right));
  };
  differs("received", counts.received, truth.received);
  differs("lost", counts.lost, truth.lost);
  differs("duplicated", counts.duplicated, truth.duplicated);
  differs("reordered", counts.reordered, truth.reordered);
  differs("overaged", counts.too_old, truth.too_old);
  differs("far", counts.leaps, truth.leaps);
}

}  // namespace reckon::fuzz
