// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/objects/object_fetch.hpp"

#include <algorithm>
#include <cstring>

#include "reckon/peer/objects/missing_chunks.hpp"

namespace reckon::peer {

ObjectFetch::ObjectFetch(const ObjectHash& object, std::uint64_t size, ChunkStore& store,
                         std::uint64_t seed, Nanoseconds now)
    : object_(object),
      key_(key_of(object)),
      layout_(size),
      store_(store),
      timer_(seed),
      received_(layout_.chunks()),
      kept_(layout_.chunks()),
      checked_(layout_.blocks()),
      list_(layout_.blocks()),
      heard_(now - kServerGone),
      asked_(now),
      ask_at_(now + timer_.draw(kLongestWait)) {
  block_.reserve(kBlockOctets);
  if (layout_.chunks() == 0) check_list();
}

void ObjectFetch::take_kept(const ChunkMap& kept) {
  if (kept.chunks() != received_.chunks()) return;
  for (std::uint32_t i = kept.next(layout_.list_chunks(), true); i < kept.chunks();
       i = kept.next(i + 1, true)) {
    received_.add(i);
    kept_.add(i);
  }
}

void ObjectFetch::hear_server(std::uint32_t epoch, std::uint32_t serial, Nanoseconds now) noexcept {
  const bool is_newer = static_cast<std::int32_t>(serial - seen_) > 0;
  if (epoch != server_ || is_newer) seen_ = serial;
  server_ = epoch;
  heard_ = now;
  silence_ = kSilence;
}

void ObjectFetch::take_chunk(std::uint32_t epoch, std::uint32_t serial, std::uint32_t index,
                             std::span<const std::byte> octets, Nanoseconds now) {
  if (state_ != FetchState::running) return;
  if (index >= layout_.chunks() || octets.size() != layout_.length(index)) {
    ++counts_.refused;
    return;
  }
  hear_server(epoch, serial, now);
  ask_at_ = std::max(now, std::min(ask_at_, asked_ + kPeriod));
  if (received_.has(index)) {
    ++counts_.doubled;
    return;
  }
  if (layout_.is_of_list(index)) {
    store_list(index, octets);
  } else if (!store_.write(layout_.offset(index), octets)) {
    return end(FetchState::unwritable);
  }
  ++counts_.received;
  received_.add(index);
  if (layout_.is_of_list(index)) return check_list();
  if (has_list_) check_block(layout_.block_of(index));
}

void ObjectFetch::store_list(std::uint32_t index, std::span<const std::byte> octets) noexcept {
  const auto list = std::as_writable_bytes(std::span(list_));
  std::memcpy(list.data() + layout_.offset(index), octets.data(), octets.size());
}

void ObjectFetch::check_list() {
  if (has_list_ || !is_whole(0, layout_.list_chunks())) return;
  if (hash_of_object(layout_.size(), list_) != object_) return forget(0, layout_.list_chunks());
  has_list_ = true;
  if (layout_.blocks() == 0) return end(FetchState::complete);
  for (std::uint32_t i = 0; i < layout_.blocks() && state_ == FetchState::running; ++i)
    check_block(i);
}

void ObjectFetch::check_block(std::uint32_t block) {
  const std::uint32_t first = layout_.first_of(block);
  const std::uint32_t last = std::min<std::uint32_t>(first + pdu::kChunksOfBlock, layout_.chunks());
  if (checked_.has(block) || !is_whole(first, last)) return;
  block_.resize(layout_.block_length(block));
  if (!store_.read(std::uint64_t{block} * kBlockOctets, block_)) return end(FetchState::unwritable);
  if (hash_of_block(block_) != list_[block]) return forget(first, last);
  checked_.add(block);
  if (checked_.count() == layout_.blocks()) end(FetchState::complete);
}

// Octets of an earlier run may be wrong without a forger, for example after a power failure.
void ObjectFetch::forget(std::uint32_t first, std::uint32_t end_of_part) noexcept {
  const bool is_kept = kept_.next(first, true) < end_of_part;
  for (std::uint32_t i = first; i < end_of_part; ++i) {
    received_.remove(i);
    kept_.remove(i);
  }
  if (!is_kept && ++counts_.forged >= kMostForged) end(FetchState::forged);
}

void ObjectFetch::end(FetchState state) noexcept {
  state_ = state;
  ask_at_ = Nanoseconds::max();
}

void ObjectFetch::take_status(std::uint32_t epoch, std::uint32_t serial, std::uint32_t pending,
                              Nanoseconds now) {
  if (state_ != FetchState::running) return;
  hear_server(epoch, serial, now);
  const Nanoseconds wait =
      pending > 0 ? asked_ + kPeriod - now : Nanoseconds(timer_.draw(kLongestWait));
  ask_at_ = std::min(ask_at_, now + std::max(wait, Nanoseconds::zero()));
}

void ObjectFetch::hear_request(const pdu::ObjectRequest& request,
                               std::span<const std::byte> missing, Nanoseconds now) {
  if (state_ != FetchState::running || request.size != layout_.size()) return;
  std::uint32_t next = received_.next(0, false);
  for_each_missing(request, missing, layout_.chunks(),
                   [&](std::uint32_t first, std::uint32_t count) {
                     if (next >= first && next < first + count)
                       next = received_.next(first + count, false);
                   });
  if (next < layout_.chunks()) return;
  asked_ = now;
  ask_at_ = now + kPeriod;
}

std::size_t ObjectFetch::take_request(Nanoseconds now, pdu::ObjectRequest& request,
                                      std::span<std::byte> room) {
  if (now < ask_at_) return 0;
  const bool is_silent = now - heard_ >= kSilence;
  asked_ = now;
  if (is_silent) {
    ask_at_ = now + silence_;
    silence_ = std::min<Nanoseconds>(2 * silence_, kLongestSilence);
  } else {
    ask_at_ = heard_ + kSilence + timer_.draw(kLongestWait);
  }
  request = {};
  request.object = object_;
  request.size = layout_.size();
  request.server = now - heard_ < kServerGone ? server_ : 0;
  request.seen = seen_;
  request.flags = server_ != 0 ? pdu::kSeenKnown : 0;
  std::uint32_t next = 0;
  std::size_t octets = store_missing(received_, begin_, request, room, next);
  if (octets == 0) octets = store_missing(received_, 0, request, room, next);
  begin_ = next < layout_.chunks() ? next : 0;
  ++counts_.requests;
  store_.keep(received_);
  return octets;
}

}  // namespace reckon::peer
