// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A federate's part in the model loop: carries out the program's requests and collects events for
// it.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/peer/federation/mailbox.hpp"
#include "reckon/peer/loops/model_loop.hpp"

namespace reckon::peer {

/// The loop's side of the two mailboxes; wishes() and news() are the program's side, for one of its
/// threads at a time.
class LoopSide final : public ModelGuest {
 public:
  /// Most pending PDUs for a program that does not read [octets]; further ones are counted.
  static constexpr std::size_t kMostWaiting = std::size_t{8} << 20;
  /// Most pending reports of peers that did not get an assured message; further ones are only
  /// counted (`assured_undelivered`).
  static constexpr std::size_t kMostUndelivered = 65'536;

  void begin_pass(ModelLoop& loop) noexcept override;
  void receive(const pdu::PduHeader& header, std::span<const std::byte> octets,
               const InteractionSender& sender) noexcept override;
  void note_undelivered(const Undelivered& undelivered) noexcept override;
  void end_pass(ModelLoop& loop) noexcept override;

  [[nodiscard]] LetterBox<Wishes>& wishes() noexcept { return wishes_; }
  [[nodiscard]] LetterBox<News>& news() noexcept { return news_; }
  /// Collects PDUs of this type from now on. Any thread.
  void listen_for(pdu::PduType type) noexcept {
    wanted_[static_cast<std::uint8_t>(type)].store(true, std::memory_order_relaxed);
  }
  /// Collects the states of the bodies from now on. Any thread.
  void read_bodies() noexcept { reads_bodies_.store(true, std::memory_order_relaxed); }

 private:
  static void grant(Wishes& wishes, ModelLoop& loop);
  static void send(Wishes& wishes, ModelLoop& loop);
  void order_bodies(Wishes& wishes, OwnershipStage& owners);
  void note_records(ModelLoop& loop);
  static void note_bodies(std::vector<KnownBody>& bodies, const OwnershipStage& owners);

  LetterBox<Wishes> wishes_;
  LetterBox<News> news_;
  std::array<std::atomic<bool>, 256> wanted_{};
  std::atomic<bool> reads_bodies_{false};
  std::uint64_t dropped_ = 0;
};

}  // namespace reckon::peer
