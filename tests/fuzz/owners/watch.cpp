// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/owners/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "reckon/pdu/seconds.hpp"

namespace reckon::fuzz::owners {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// The bar of a hand that nothing opposes, without faults: five round trips, and what loss takes.
constexpr Nanoseconds kMostWait = seconds(2);
// The bar if the owner has not changed lately, and no withdrawal of the hand is on its way.
constexpr Nanoseconds kFreshWait = milliseconds(900), kFresh = milliseconds(500);

}  // namespace

void Watch::find(int invariant, Nanoseconds now, std::string sentence) {
  if (outcome_.finding) return;
  outcome_.finding = Finding{invariant, now, std::move(sentence)};
}

void Watch::look_at(std::size_t object, Nanoseconds now) {
  std::size_t first = owners_.size();
  for (std::size_t i = 0; i < owners_.size(); ++i) {
    if (!owners_[i].runs() || !owners_[i].protocol().owns(object, now)) continue;
    audit_.note_owner(i, object, now);
    const auto& world = owners_[i].protocol().world();
    if (first < owners_.size() && owners_[first].protocol().world() == world) {
      const auto& one = owners_[first].protocol().tenure(object);
      const auto& other = owners_[i].protocol().tenure(object);
      find(1, now,
           fmt::format("object {} has two owners: peer {} ({:x}) and peer {} ({:x})", object, first,
                       one.version, i, other.version));
    }
    if (first == owners_.size()) first = i;
    std::uint64_t& newest = versions_[{world, object}];
    const std::uint64_t version = owners_[i].protocol().tenure(object).version;
    if (version < newest)
      find(2, now,
           fmt::format("object {} falls from version {:x} to {:x} at peer {}", object, newest,
                       version, i));
    if (version > newest) objects_[object].changed_at = now;
    newest = std::max(newest, version);
  }
  ObjectRecord& record = objects_[object];
  record.has_owner = first < owners_.size();
}

void Watch::look(Nanoseconds now) {
  for (std::size_t object = 0; object < plan_.objects; ++object) look_at(object, now);
}

void Watch::look_closely(Nanoseconds now) {
  look(now);
  for (std::size_t object = 0; object < plan_.objects; ++object) {
    ObjectRecord& record = objects_[object];
    if (record.has_owner) {
      const double gap = pdu::to_seconds(now - record.owned_at);
      if (record.was_owned && gap > 0.0101) outcome_.gaps.push_back(gap);
      record.owned_at = now;
      record.was_owned = true;
    } else if (is_calm() && record.was_owned && now - record.owned_at > seconds(1) &&
               plan_.line.loss <= 0.3) {
      find(3, now, fmt::format("object {} has no owner for a second, without faults", object));
    }
  }
  for (auto waiting = waiting_.begin(); waiting != waiting_.end();) {
    const bool is_alone = std::popcount(hands_[waiting->object]) == 1;
    if (!is_alone) waiting->alone = now;
    if (owners_[waiting->peer].protocol().owns(waiting->object, now)) {
      outcome_.waits.push_back(pdu::to_seconds(now - waiting->since));
      waiting = waiting_.erase(waiting);
      continue;
    }
    const bool is_fresh =
        waiting->is_fresh && waiting->since - objects_[waiting->object].changed_at > kFresh;
    if (is_calm() && plan_.island == 1 && plan_.line.loss <= 0.3 &&
        now - waiting->alone > (is_fresh ? kFreshWait : kMostWait))
      find(6, now,
           fmt::format("peer {} waits for object {} that no other hand touches", waiting->peer,
                       waiting->object));
    ++waiting;
  }
}

void Watch::note_touch(const Touch& touch, bool begins, Nanoseconds now) {
  const std::uint32_t bit = 1U << touch.peer;
  hands_[touch.object] = begins ? hands_[touch.object] | bit : hands_[touch.object] & ~bit;
  if (begins) {
    const auto lifted = lifted_.find({touch.peer, touch.object});
    const bool is_fresh = lifted == lifted_.end() || now - lifted->second > kFresh;
    waiting_.push_back({touch.peer, touch.object, now, now, is_fresh});
  } else {
    lifted_[{touch.peer, touch.object}] = now;
    std::erase_if(waiting_, [&](const Waiting& waiting) {
      return waiting.peer == touch.peer && waiting.object == touch.object;
    });
  }
}

void Watch::look_at_end(Nanoseconds now) {
  for (std::size_t object = 0; object < plan_.objects; ++object) {
    std::size_t owners = 0;
    for (const SimulatedOwner& owner : owners_)
      owners += owner.runs() && owner.protocol().owns(object, now);
    if (owners != 1)
      find(4, now, fmt::format("object {} has {} owners at the end", object, owners));
  }
  const SimulatedOwner* first = nullptr;
  for (const SimulatedOwner& owner : owners_) {
    if (!owner.runs()) continue;
    if (first == nullptr) first = &owner;
    const bool is_same = owner.protocol().world() == first->protocol().world() &&
                         owner.protocol().table().hash() == first->protocol().table().hash();
    if (!is_same) find(5, now, fmt::format("peer {} has another table", &owner - owners_.data()));
    if (!owner.protocol().is_voter())
      find(5, now, fmt::format("peer {} does not vote", &owner - owners_.data()));
  }
}

}  // namespace reckon::fuzz::owners
