// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A link around another link. It seals sent datagrams, and opens or refuses received ones. Every
// holder of the group's key takes part, without a handshake for each pair.
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

/// The port of a sealed exercise is the one above the exercise's, so that no plain DIS program
/// receives it.  @throws std::invalid_argument for 65535, which has none above
[[nodiscard]] GroupAddress sealed_group(GroupAddress base);

/// Options of a sealed link.
struct SealedLinkOptions {
  GroupKey key;
  GroupAddress base;  ///< of the links' greetings; the user of this link joins it
  std::uint16_t site{0}, application{0};  ///< first numbers of the program, for people
  ExercisePlaces places{};                ///< datagrams sealed for other places do not open
  RandomSource random{system_random};
  InstanceNumber instance{system_instance};  ///< asked ten times a second
  DatagramTap* tap{nullptr};  ///< receives the fate of envelopes and of their content; outlives it
};

/// Seals and opens, with a boot drawn at random at construction. Datagrams of a new boot are held
/// until it has returned our nonce, because their valid tags may come from a recording. That takes
/// one round trip and 5 to 20 ms. Then its last datagrams are returned, if they were sealed after
/// their group was joined here. Each has its sender's boot (Datagram::boot). Threads as for any
/// Link. The reader sends greetings, and the writer waits meanwhile: the inner link has one sender
/// at a time.
///
/// If the process may be one of two (a fork, a copied machine), it continues with another boot. If
/// its clocks differ by seconds (the machine was suspended), it trusts no sender until the sender
/// has proved again to be live.
class SealedLink final : public LinkAround {
 public:
  /// Allocates all that it needs.  @param inner, clock outlive this.
  /// @throws RandomSourceError; std::invalid_argument if the inner link carries less than kEnvelope
  /// octets
  SealedLink(Link& inner, SealedLinkOptions options, const Clock& clock);
  ~SealedLink() override;

  /// Counts in `counters` from now on, which outlives this. Call it before the first datagram.
  void count_in(Counters& counters);
  /// Lines for the user since the last call. One thread, any.
  [[nodiscard]] std::vector<std::string> take_news();

  /// Also false after 2^40 sent datagrams.
  bool send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept override;
  /// Also sends a greeting if one is due.
  std::size_t receive(std::span<Datagram> out) noexcept override;
  std::error_code join(const GroupAddress& group) noexcept override;
  bool wait(std::chrono::nanoseconds timeout) noexcept override;
  /// kEnvelope less than for the inner link.
  [[nodiscard]] std::size_t max_payload() const noexcept override;

 private:
  struct Session;
  std::unique_ptr<Session> session_;
};

}  // namespace reckon::peer
