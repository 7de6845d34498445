// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A link around a link: what goes out is sealed, what comes in is opened or refused. Whoever has
// the group's key is in it, without a handshake for each pair.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/network/datagram_tap.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/sealing/envelope.hpp"
#include "reckon/peer/sealing/instance_number.hpp"
#include "reckon/peer/sealing/key_file.hpp"

namespace reckon::peer {

/// A sealed exercise has a port of its own, so that no program that reads DIS meets it: the one
/// above the exercise's. @throws std::invalid_argument for 65535, which has none above
[[nodiscard]] GroupAddress sealed_group(GroupAddress base);

/// How a link is sealed.
struct SealedLinkOptions {
  GroupKey key;
  GroupAddress base;  ///< where links greet each other; joined by whoever uses this one
  std::uint16_t site{0}, application{0};  ///< what the program is called at first, for people
  ExercisePlaces places{};                ///< what is sealed for another one does not open
  RandomSource random{system_random};
  InstanceNumber instance{system_instance};  ///< asked ten times a second
  DatagramTap* tap{nullptr};  ///< of what becomes of envelopes and what is in them; outlives it
};

/// Seals and opens, under a boot drawn at random at construction. A boot heard for the first time
/// is held back until it has sent our nonce back, for its right tags may be yesterday's: that takes
/// one round trip and 5 to 20 ms, and then its last datagrams are handed up, as far as they were
/// sealed after their group was joined here. Each one is handed up with its sender's boot
/// (Datagram::boot). Threads as any Link. The reader greets, and the writer waits for it meanwhile:
/// the inner link has one sender at a time.
///
/// Where the process finds that it may be one of two (a fork, a copied machine) it goes on under
/// another boot, and where its clocks part by seconds (the machine slept) it trusts nobody until
/// all have proved anew that they are alive.
class SealedLink final : public Link {
 public:
  /// Allocates all that it needs. `inner` and `clock` outlive this. @throws RandomSourceError,
  /// std::invalid_argument where the inner link carries less than kEnvelope octets
  SealedLink(Link& inner, SealedLinkOptions options, const Clock& clock);
  ~SealedLink() override;

  /// Counts there from now on; before the first datagram. `counters` outlives this.
  void count_in(Counters& counters);
  /// Lines for the user since the last call. One thread, any.
  [[nodiscard]] std::vector<std::string> take_news();

  /// False, too, where 2^40 datagrams have been sent.
  bool send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept override;
  /// Greets as well, where it is time.
  std::size_t receive(std::span<Datagram> out) noexcept override;
  std::error_code join(const GroupAddress& group) noexcept override;
  void leave(const GroupAddress& group) noexcept override;
  bool wait(std::chrono::nanoseconds timeout) noexcept override;
  void wake() noexcept override;
  bool take_event(LinkEvent& event) noexcept override;
  void settle() noexcept override;
  [[nodiscard]] IpEndpoint local_endpoint() const noexcept override;
  /// kEnvelope less than the inner one's.
  [[nodiscard]] std::size_t max_payload() const noexcept override;
  [[nodiscard]] LinkStatistics statistics() const noexcept override;

 private:
  struct Session;
  std::unique_ptr<Session> session_;
};

}  // namespace reckon::peer
