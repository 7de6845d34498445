// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A bad network around a good link: what arrives is lost, delayed, doubled and reordered by the one
// law before it is handed over. On the receive side, so that each peer loses other datagrams.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/impairment.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

class DatagramTap;

/// How a link is impaired.
struct ImpairedLinkOptions {
  ImpairmentLaw law;
  std::uint64_t seed{1};
  std::uint64_t receiver{0};          ///< own number; peers with other numbers lose others
  std::size_t queue{4096};            ///< datagrams held at most; more are counted as overflow
  std::size_t max_datagram{2048};     ///< longest payload kept [octets]; longer ones are truncated
  std::size_t max_senders{256};       ///< beyond it senders share one sequence
  std::chrono::nanoseconds start{0};  ///< the start of the run, for outages, by `clock`
  DatagramTap* tap{nullptr};          ///< of what it does to which datagram; outlives it
};

/// Delays on the way in; sends straight through. Threads as any Link: receive and wait by one.
class ImpairedLink final : public Link {
 public:
  /// Allocates the whole queue. `inner` and `clock` must outlive this. @throws
  /// std::invalid_argument where the law is out of range.
  ImpairedLink(Link& inner, const ImpairedLinkOptions& options, const Clock& clock);
  ~ImpairedLink() override;

  /// Gives a sender the number that the law draws from; else they count by first appearance.
  /// Needed for equal decisions in two runs, as real senders have other ports each time.
  void number_sender(const IpEndpoint& sender, std::uint64_t number);

  /// Another law from the next receive() on, with the same seed; what is delayed already comes when
  /// it would have come. By one thread, any; allocates where the law has outages.
  /// @throws std::invalid_argument with law.problem()
  void change_law(const ImpairmentLaw& law);

  bool send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept override;
  /// Datagram::received is the time at which the law lets it arrive.
  SentBatch send_batch(std::span<const OutgoingDatagram> batch) noexcept override;
  std::size_t receive(std::span<Datagram> out) noexcept override;
  std::error_code join(const GroupAddress& group) noexcept override;
  void leave(const GroupAddress& group) noexcept override;
  bool wait(std::chrono::nanoseconds timeout) noexcept override;
  void wake() noexcept override;
  [[nodiscard]] IpEndpoint local_endpoint() const noexcept override;
  [[nodiscard]] std::size_t max_payload() const noexcept override;
  [[nodiscard]] LinkStatistics statistics() const noexcept override;
  bool take_event(LinkEvent& event) noexcept override;
  void settle() noexcept override;

 private:
  struct Emulator;
  std::unique_ptr<Emulator> emulator_;
};

}  // namespace reckon::peer
