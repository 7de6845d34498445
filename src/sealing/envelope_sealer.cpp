// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/envelope_sealer.hpp"

#include <cassert>

namespace reckon::peer {

EnvelopeSealer::EnvelopeSealer(const GroupKey& key, std::uint16_t site, std::uint16_t application,
                               RandomSource random) {
  header_.sealer = {draw(random), site, application};
  header_.suite = key.suite;
  prepare_sealing();
  epochs_.resize(key.epochs.size());
  for (std::size_t i = 0; i < epochs_.size(); ++i) {
    header_.epoch = epochs_[i].number = key.epochs[i].number;
    KeyOctets own = derive_key(key.epochs[i].secret, header_);
    epochs_[i].key.set_key(key.suite, own);
    wipe(own);
  }
}

EnvelopeSealer::~EnvelopeSealer() {
  for (Epoch& epoch : epochs_) epoch.key.wipe();
}

std::span<const std::byte> EnvelopeSealer::seal(SealingStream stream, std::size_t epoch,
                                                std::span<const std::byte> plain,
                                                std::span<std::byte> room) noexcept {
  assert(epoch < epochs_.size());
  std::atomic<std::uint64_t>& sealed = streams_[static_cast<std::size_t>(stream)].count;
  const std::uint64_t before = sealed.load(std::memory_order_relaxed);
  const std::size_t size = plain.size() + kEnvelope;
  if (before >= kMostOfStream || size > room.size()) return {};
  EnvelopeHeader header = header_;
  header.epoch = epochs_[epoch].number;
  header.stream = static_cast<std::uint16_t>(stream);
  header.count = before + 1;
  sealed.store(header.count, std::memory_order_relaxed);
  epochs_[epoch].key.seal(header, plain, room.first(size));
  return room.first(size);
}

void EnvelopeSealer::skip_to(SealingStream stream, std::uint64_t count) noexcept {
  assert(count >= this->count(stream));
  streams_[static_cast<std::size_t>(stream)].count.store(count, std::memory_order_relaxed);
}

}  // namespace reckon::peer
