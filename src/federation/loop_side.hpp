// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A federate's hands in the model loop: does what the program wishes, gathers what has happened.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/peer/federation/mailbox.hpp"
#include "reckon/peer/loops/model_loop.hpp"

namespace reckon::peer {

/// The loop's side of the two letter boxes; wishes() and news() are the program's side, any of its
/// threads but one at a time.
class LoopSide final : public ModelGuest {
 public:
  /// PDUs that wait for a program that does not read [octets]; further ones are counted.
  static constexpr std::size_t kMostWaiting = std::size_t{8} << 20;

  void begin_pass(ModelLoop& loop) noexcept override;
  void hear(const pdu::PduHeader& header, std::span<const std::byte> octets,
            const InteractionSender& sender) noexcept override;
  void end_pass(ModelLoop& loop) noexcept override;

  [[nodiscard]] LetterBox<Wishes>& wishes() noexcept { return wishes_; }
  [[nodiscard]] LetterBox<News>& news() noexcept { return news_; }
  /// PDUs of this type are gathered from now on. Any thread.
  void listen_for(pdu::PduType type) noexcept {
    wanted_[static_cast<std::uint8_t>(type)].store(true, std::memory_order_relaxed);
  }

 private:
  static void grant(Wishes& wishes, ModelLoop& loop);
  static void say(Wishes& wishes, ModelLoop& loop);

  LetterBox<Wishes> wishes_;
  LetterBox<News> news_;
  std::array<std::atomic<bool>, 256> wanted_{};
  std::uint64_t dropped_ = 0;
};

}  // namespace reckon::peer
