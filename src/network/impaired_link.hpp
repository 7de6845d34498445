// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Simulates a bad network around a good link: arriving datagrams are lost, delayed, duplicated and
// reordered by the impairment law. It works on the receiving side, so that each peer loses
// different datagrams.
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
  DatagramTap* tap{nullptr};          ///< receives the effect on each datagram; outlives the link
};

/// Delays received datagrams; sends without changes. Threads as for any Link: receive and wait in
/// one.
class ImpairedLink final : public LinkAround {
 public:
  /// Allocates the whole queue. `inner` and `clock` must outlive this. @throws
  /// std::invalid_argument if the law is out of range.
  ImpairedLink(Link& inner, const ImpairedLinkOptions& options, const Clock& clock);
  ~ImpairedLink() override;

  /// Sets the number of a sender from which the law draws; by default senders are numbered in the
  /// order of their first datagrams. Two runs need this for equal decisions, because real senders
  /// have other ports each time.
  void number_sender(const IpEndpoint& sender, std::uint64_t number);

  /// Sets another law from the next receive() on, with the same seed. Datagrams that are already
  /// delayed keep their times. By one thread, any; allocates if the law has outages.
  /// @throws std::invalid_argument with law.problem()
  void change_law(const ImpairmentLaw& law);

  /// In datagrams from receive(), Datagram::received is the time of arrival according to the law.
  SentBatch send_batch(std::span<const OutgoingDatagram> batch) noexcept override;
  std::size_t receive(std::span<Datagram> out) noexcept override;
  bool wait(std::chrono::nanoseconds timeout) noexcept override;
  [[nodiscard]] std::size_t max_payload() const noexcept override;
  [[nodiscard]] LinkStatistics statistics() const noexcept override;
  void settle() noexcept override;

 private:
  struct Emulator;
  std::unique_ptr<Emulator> emulator_;
};

}  // namespace reckon::peer
