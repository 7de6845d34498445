// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/federation/loop_side.hpp"

#include <algorithm>

#include "reckon/pdu/codec/byte_order.hpp"

namespace reckon::peer {
namespace {

constexpr std::size_t kTimestampOffset = 4;  // in every PDU, IEEE 1278.1 PDU Header

// Sets missing and future times to `now`, so that the program may use another clock than the peer.
EntityTruth dated(const EntityTruth& truth, std::chrono::nanoseconds now) {
  EntityTruth result = truth;
  if (truth.time <= std::chrono::nanoseconds(0) || truth.time > now) result.time = now;
  return result;
}

}  // namespace

void LoopSide::begin_pass(ModelLoop& loop) noexcept {
  Wishes* wishes = wishes_.take();
  if (wishes == nullptr) return;
  grant(*wishes, loop);
  send(*wishes, loop);
  order_bodies(*wishes, loop.ownership());
  for (const Wishes::Record& wish : wishes->records)
    if (!loop.records().write(wish.key, wish.value, loop.pass()))
      news_.letter().refused_records.push_back(wish.key);
  wishes->clear();
  wishes_.give_back();
}

void LoopSide::grant(Wishes& wishes, ModelLoop& loop) {
  const std::chrono::nanoseconds now = loop.pass().now;
  for (const Wishes::Register& wish : wishes.registered) {
    loop.add(wish.number, wish.description);
  }
  for (const Wishes::Move& wish : wishes.moved) loop.move(wish.number, dated(wish.truth, now));
  for (const Wishes::Appearance& wish : wishes.appearances) {
    OwnedEntity* entity = loop.find_own(wish.number);
    if (entity == nullptr) continue;
    entity->set_appearance(wish.appearance);
    loop.look_at(wish.number);
  }
  for (const Wishes::Parts& wish : wishes.parts) {
    OwnedEntity* entity = loop.find_own(wish.number);
    if (entity == nullptr) continue;
    entity->set_parts(wish.parts);
    loop.look_at(wish.number);
  }
  for (const EntityNumber number : wishes.removed) loop.remove(number);
}

void LoopSide::send(Wishes& wishes, ModelLoop& loop) {
  for (const Wishes::Say& wish : wishes.said) {
    const std::span<std::byte> octets = std::span(wishes.octets).subspan(wish.offset, wish.size);
    pdu::store_big_endian(octets.data() + kTimestampOffset, loop.time().stamp(loop.pass().utc));
    if (wish.assured != 0)
      loop.assured().send(octets, wish.assured, wish.ordered ? pdu::kAssuredOrdered : 0,
                          loop.pass());
    else
      static_cast<void>(loop.send(octets, wish.place));
  }
}

// Orders of one step take effect together, as far as one transaction holds them.
void LoopSide::order_bodies(Wishes& wishes, OwnershipStage& owners) {
  for (const Wishes::Own& wish : wishes.owned)
    wish.acquire ? owners.acquire(wish.body) : owners.divest(wish.body);
  std::vector<std::uint32_t>& refused = news_.letter().refused;
  std::erase_if(wishes.orders, [&](const haptics::BodyOrder& order) {
    if (owners.owns(order.body)) return false;
    refused.push_back(order.body);
    return true;
  });
  std::span<const haptics::BodyOrder> orders = wishes.orders;
  while (!orders.empty()) {
    const auto some = orders.first(std::min(orders.size(), haptics::BodyExchange::kMostOrders));
    orders = orders.subspan(some.size());
    if (owners.order(some)) continue;
    for (const haptics::BodyOrder& order : some) refused.push_back(order.body);
  }
}

void LoopSide::note_bodies(std::vector<KnownBody>& bodies, const OwnershipStage& owners) {
  bodies.resize(owners.protocol().table().size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    bodies[i] = {owners.motion_now(i), owners.owner_id_of(i), owners.asker_of(i), owners.owns(i)};
}

void LoopSide::note_records(ModelLoop& loop) {
  RecordStage& stage = loop.records();
  for (const std::string& key : stage.records().take_changes()) {
    const auto record = stage.records().find(key);
    News::Record& news = news_.letter().records.emplace_back();
    news.key = key;
    news.is_removed = !record;
    if (!record) continue;
    news.value.assign(record->value.begin(), record->value.end());
    news.writer = stage.peer_of(record->version.writer);
    news.is_ours = record->version.writer == stage.epoch();
  }
}

void LoopSide::receive(const pdu::PduHeader& header, std::span<const std::byte> octets,
                       const InteractionSender& sender) noexcept {
  if (!wanted_[static_cast<std::uint8_t>(header.pdu_type)].load(std::memory_order_relaxed)) return;
  News& news = news_.letter();
  if (news.octets.size() + octets.size() > kMostWaiting) {
    ++dropped_;
    return;
  }
  news.heard.push_back({header.pdu_type, news.octets.size(), octets.size(), sender});
  news.octets.insert(news.octets.end(), octets.begin(), octets.end());
}

void LoopSide::note_undelivered(const Undelivered& undelivered) noexcept {
  News& news = news_.letter();
  if (news.undelivered.size() < kMostUndelivered) news.undelivered.push_back(undelivered);
}

// While the program reads the last letter, the table collects the newest change of each entity.
void LoopSide::end_pass(ModelLoop& loop) noexcept {
  if (!news_.is_free()) return;
  News& news = news_.letter();
  for (const EntityChange& change : loop.remote().take_changes()) {
    if (change.change == Change::removed) {
      news.removed.push_back({change.id, change.cause});
    } else if (const RemoteEntity* row = loop.remote().find(change.id)) {
      news.states.emplace_back(*row);
    }
  }
  if (reads_bodies_.load(std::memory_order_relaxed)) note_bodies(news.bodies, loop.ownership());
  note_records(loop);
  news.now = loop.pass().now;
  news.utc = loop.pass().utc;
  news.simulation = loop.owned().simulation();
  news.dropped = dropped_;
  news_.send();
}

}  // namespace reckon::peer
