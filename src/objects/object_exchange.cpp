// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/objects/object_exchange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "reckon/pdu/timestamp.hpp"

namespace reckon::peer {
namespace {

using pdu::AssuredKind;

/// One above the exercise's port is that of its sealed datagrams.
constexpr std::uint16_t kPortsAbove = 2;

void join(Link& link, const GroupAddress& group) {
  if (const std::error_code error = link.join(group))
    throw std::system_error(error, advice(error, group));
}

template <class Head>
std::span<const std::byte> rest_of(std::span<const std::byte> content) {
  return content.subspan(pdu::kFixedSize<Head>);
}

}  // namespace

GroupAddress object_messages_group(const GroupAddress& base) {
  GroupAddress group = base;
  if (group.port > std::numeric_limits<std::uint16_t>::max() - kPortsAbove)
    throw std::invalid_argument(
        fmt::format("port {} has no port {} above it for objects", base.port, kPortsAbove));
  group.port = static_cast<std::uint16_t>(base.port + kPortsAbove);
  return group;
}

GroupAddress object_chunks_group(const GroupAddress& base, std::size_t pool_size) {
  return object_messages_group(GroupPool(base, pool_size + 1).address(pool_size));
}

ObjectExchange::ObjectExchange(Link& link, const Clock& clock, const ObjectExchangeOptions& options)
    : link_(link),
      clock_(clock),
      options_(options),
      server_(options.epoch, options.rate, options.seed),
      timer_(options.seed + 1),
      messages_(object_messages_group(options.base)),
      now_(clock.now()) {
  offered_.reserve(kMostOffers);
  join(link_, messages_);
}

void ObjectExchange::offer(const pdu::ObjectOffer& offer) {
  chunks_ = object_chunks_group(options_.base, offer.pool_size);
  offers_.push_back({offer});
}

bool ObjectExchange::has_chunks_group(std::size_t pool_size) const noexcept {
  try {
    static_cast<void>(object_chunks_group(options_.base, pool_size));
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

void ObjectExchange::ask(std::uint64_t scene_hash) {
  asked_ = scene_hash;
  offered_.clear();
  ask_at_ = clock_.now();
}

FetchHandle ObjectExchange::fetch(std::size_t pool_size, const ObjectHash& object,
                                  std::uint64_t size, ChunkStore& store) {
  chunks_ = object_chunks_group(options_.base, pool_size);
  join(link_, chunks_);
  fetches_.push_back(std::make_unique<ObjectFetch>(object, size, store,
                                                   options_.seed + 2 + fetched_++, clock_.now()));
  return {fetches_.back().get(), {this}};
}

void FetchEnd::operator()(ObjectFetch* fetch) const noexcept { exchange->finish(*fetch); }

// After the last fetch it leaves the group of chunks.
void ObjectExchange::finish(const ObjectFetch& fetch) noexcept {
  std::erase_if(fetches_, [&](const auto& one) { return one.get() == &fetch; });
  if (fetches_.empty()) link_.leave(chunks_);
}

void ObjectExchange::step() {
  now_ = clock_.now();
  std::array<Datagram, kBatch> arrived;
  for (std::size_t turns = 0; turns < kBatch; ++turns) {
    const std::size_t count = link_.receive(arrived);
    for (const Datagram& datagram : std::span(arrived).first(count)) take(datagram);
    if (count < arrived.size()) break;
  }
  send_messages();
  send_requests();
  send_chunks();
}

std::chrono::nanoseconds ObjectExchange::next_step() const noexcept {
  Nanoseconds next = std::min(server_.next_step(now_), ask_at_);
  for (const auto& one : fetches_) next = std::min(next, one->next_step());
  for (const Own& one : offers_) next = std::min(next, one.due);
  return next;
}

// In

void ObjectExchange::take(const Datagram& datagram) {
  pdu::AssuredRecord record;
  const bool is_good = pdu::decode(datagram.bytes, record) == pdu::DecodeError::none &&
                       is_ours(record.header.exercise_id) && record.epoch != 0;
  if (!is_good) {
    ++counts_.refused;
    return;
  }
  if (record.epoch == options_.epoch) return;
  switch (record.kind) {
    case AssuredKind::object_query:
      return take_query(record);
    case AssuredKind::object_offer:
      return take_offer(record, datagram.sender);
    case AssuredKind::object_request:
      return take_request(record);
    case AssuredKind::object_status:
      return take_status(record);
    case AssuredKind::object_chunk:
      return take_chunk(record);
    default:
      ++counts_.refused;
  }
}

void ObjectExchange::take_query(const pdu::AssuredRecord& record) {
  pdu::ObjectQuery query;
  if (!pdu::load_record(record.content.bytes, query)) return;
  for (Own& one : offers_) {
    const bool is_meant = query.scene_hash == 0 || one.offer.scene_hash == query.scene_hash;
    if (!is_meant || one.due != Nanoseconds::max()) continue;
    one.due = now_ + timer_.draw(ObjectServer::kLongestWait);
  }
}

void ObjectExchange::take_offer(const pdu::AssuredRecord& record, const IpEndpoint& from) {
  pdu::ObjectOffer offer;
  if (!pdu::load_record(record.content.bytes, offer)) return;
  for (Own& one : offers_)
    if (one.offer.manifest == offer.manifest) one.due = Nanoseconds::max();
  const bool is_asked =
      ask_at_ != Nanoseconds::max() && (asked_ == 0 || asked_ == offer.scene_hash);
  const auto is_same = [&](const SceneOffer& known) {
    return known.offer.manifest == offer.manifest;
  };
  if (!is_asked || offered_.size() == kMostOffers || std::ranges::any_of(offered_, is_same)) return;
  offered_.push_back({offer, record.simulation, from});
}

void ObjectExchange::take_request(const pdu::AssuredRecord& record) {
  pdu::ObjectRequest request;
  if (!pdu::load_record(record.content.bytes, request)) return;
  ++counts_.requests_in;
  const auto missing = rest_of<pdu::ObjectRequest>(record.content.bytes);
  server_.take_request(request, missing, now_);
  for (const auto& one : fetches_)
    if (one->object() == request.object) one->hear_request(request, missing, now_);
}

void ObjectExchange::take_status(const pdu::AssuredRecord& record) {
  pdu::ObjectStatus status;
  if (!pdu::load_record(record.content.bytes, status)) return;
  server_.take_status(record.epoch, {status.object, record.sequence, status.pending}, now_);
  for (const auto& one : fetches_)
    if (one->key() == status.object)
      one->take_status(record.epoch, record.sequence, status.pending, now_);
}

void ObjectExchange::take_chunk(const pdu::AssuredRecord& record) {
  pdu::ObjectChunk chunk;
  if (!pdu::load_record(record.content.bytes, chunk)) return;
  const auto octets = rest_of<pdu::ObjectChunk>(record.content.bytes);
  for (const auto& one : fetches_)
    if (one->key() == chunk.object)
      one->take_chunk(record.epoch, record.sequence, chunk.index, octets, now_);
}

// Out

std::size_t ObjectExchange::encode(AssuredKind kind, std::uint32_t sequence,
                                   std::span<const std::byte> content, std::span<std::byte> out) {
  pdu::AssuredRecord record;
  record.header.exercise_id = options_.exercise;
  record.header.timestamp = pdu::to_dis_timestamp(clock_.utc_now(), true);
  record.simulation = options_.simulation;
  record.kind = kind;
  record.flags = pdu::kAssuredOnce;
  record.epoch = options_.epoch;
  record.sequence = sequence;
  record.content = pdu::OctetBlock<std::uint16_t>::of(content);
  return pdu::encode(record, out);
}

void ObjectExchange::send(AssuredKind kind, std::uint32_t sequence,
                          std::span<const std::byte> content) {
  const auto out = std::span(octets_[0]);
  const std::size_t size = encode(kind, sequence, content, out);
  counts_.octets_sent += size;
  link_.send(messages_, out.first(size));
}

void ObjectExchange::send_messages() {
  std::array<std::byte, pdu::kFixedSize<pdu::ObjectOffer>> content;
  if (ask_at_ <= now_) {
    ask_at_ = now_ + kAskPeriod;
    send(AssuredKind::object_query, 0,
         std::span(content).first(pdu::store_record(pdu::ObjectQuery{asked_}, content)));
  }
  for (Own& one : offers_) {
    if (one.due > now_) continue;
    one.due = Nanoseconds::max();
    static_cast<void>(pdu::store_record(one.offer, content));
    send(AssuredKind::object_offer, 0, content);
  }
}

void ObjectExchange::send_requests() {
  constexpr std::size_t kHead = pdu::kFixedSize<pdu::ObjectRequest>;
  std::array<std::byte, kHead + kMostMissing> content;
  for (const auto& one : fetches_) {
    pdu::ObjectRequest request;
    const std::size_t missing = one->take_request(now_, request, std::span(content).subspan(kHead));
    if (missing == 0) continue;
    static_cast<void>(pdu::store_record(request, content));
    ++counts_.requests_sent;
    send(AssuredKind::object_request, 0, std::span(content).first(kHead + missing));
  }
}

void ObjectExchange::send_chunks() {
  constexpr std::size_t kHead = pdu::kFixedSize<pdu::ObjectChunk>;
  std::array<std::byte, kHead + pdu::kChunkOctets> content;
  std::array<OutgoingDatagram, kBatch> batch;
  std::size_t count = 0;
  for (DueChunk due; count < kBatch && server_.take_chunk(now_, due);) {
    const std::size_t length = due.source->layout().length(due.index);
    static_cast<void>(
        pdu::store_record(pdu::ObjectChunk{key_of(due.source->hash()), due.index}, content));
    if (!due.source->read_chunk(due.index, std::span(content).subspan(kHead, length))) continue;
    const std::size_t size = encode(AssuredKind::object_chunk, due.serial,
                                    std::span(content).first(kHead + length), octets_[count]);
    batch[count] = {chunks_, std::span(octets_[count]).first(size)};
    counts_.octets_sent += size;
    ++count;
  }
  counts_.chunks_sent += count;
  link_.send_batch(std::span(batch).first(count));
  for (DueStatus due; server_.take_status(now_, due);) {
    std::array<std::byte, 16> status;
    const std::size_t size = pdu::store_record(pdu::ObjectStatus{due.key, due.pending}, status);
    send(AssuredKind::object_status, due.serial, std::span(status).first(size));
  }
}

}  // namespace reckon::peer
