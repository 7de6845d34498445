// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/envelope_sealer.hpp"

#include <cassert>

namespace reckon::peer {

using std::chrono::nanoseconds;

EnvelopeSealer::EnvelopeSealer(const GroupKey& key, std::uint16_t site, std::uint16_t application,
                               const ExercisePlaces& places, RandomSource random)
    : key_(key),
      own_{draw(random), site, application},
      places_(places),
      random_(random),
      stamp_origin_(static_cast<std::uint32_t>(draw(random))) {
  prepare_sealing();
}

EnvelopeSealer::~EnvelopeSealer() {
  for (Stream& stream : streams_) stream.key.wipe();
}

EnvelopeHeader EnvelopeSealer::header_of(std::size_t epoch) const noexcept {
  EnvelopeHeader header;
  header.suite = key_.suite;
  header.epoch = key_.epochs[epoch].number;
  header.sealer = own_;
  return header;
}

bool EnvelopeSealer::begin_anew() noexcept {
  is_good_ = random_(std::as_writable_bytes(std::span(&own_.boot, 1))) &&
             random_(std::as_writable_bytes(std::span(&stamp_origin_, 1)));
  for (Stream& stream : streams_) stream.epoch = kNoEpoch;
  return is_good_;
}

// Draws a salt and derives the key if they are due. False if the random source fails.
bool EnvelopeSealer::make_ready(Stream& stream, std::size_t epoch, nanoseconds now) noexcept {
  if (!is_good_) return false;
  const bool salts_key = key_.suite == SealingSuite::aes_256_gcm;
  const bool is_key_due =
      epoch != stream.epoch || (salts_key && (stream.left == 0 || now >= stream.until));
  if (is_key_due || !salts_key) {
    if (!random_(std::as_writable_bytes(std::span(&stream.salt, 1)))) return false;
  }
  if (!is_key_due) return true;
  EnvelopeHeader header = header_of(epoch);
  header.salt = stream.salt;
  KeyOctets own = derive_key(key_.epochs[epoch].secret, header);
  stream.key.set_key(key_.suite, own);
  wipe(own);
  stream.epoch = epoch;
  stream.left = kMostOfSalt;
  stream.until = now + kLongestSalt;
  return true;
}

std::span<const std::byte> EnvelopeSealer::seal(SealingStream stream, std::size_t epoch,
                                                const IpEndpoint& to, nanoseconds now,
                                                std::span<const std::byte> plain,
                                                std::span<std::byte> room) noexcept {
  assert(epoch < key_.epochs.size());
  Stream& way = streams_[static_cast<std::size_t>(stream)];
  const std::uint64_t before = way.count.load(std::memory_order_relaxed);
  const std::size_t size = plain.size() + kEnvelope;
  if (before >= kMostOfStream || size > room.size() || !make_ready(way, epoch, now)) return {};
  EnvelopeHeader header = header_of(epoch);
  header.stream = static_cast<std::uint16_t>(stream);
  header.count = before + 1;
  header.stamp = stamp_origin_ + static_cast<std::uint32_t>(now / std::chrono::microseconds(1));
  header.salt = way.salt;
  way.count.store(header.count, std::memory_order_relaxed);
  if (way.left > 0) --way.left;
  way.key.seal(header, places_.of(to), plain, room.first(size));
  return room.first(size);
}

void EnvelopeSealer::skip_to(SealingStream stream, std::uint64_t count) noexcept {
  assert(count >= this->count(stream));
  streams_[static_cast<std::size_t>(stream)].count.store(count, std::memory_order_relaxed);
}

}  // namespace reckon::peer
