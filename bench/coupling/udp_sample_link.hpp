// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two processes of a coupling study in lock-step over UDP: one datagram a sample from each to the
// other, and what the network of the study does to a sample is done where it arrives, by its
// number. So both see, sample for sample, what one process would.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/bench/baselines/sample_link.hpp"
#include "reckon/bench/coupling/sample_datagram.hpp"
#include "reckon/peer/network/descriptor.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::bench {

/// One side. For studies: it waits for the other side, which no loop of a peer may. A datagram that
/// was lost is made good by the next one, which tells the last two samples, and is said again where
/// nothing comes for 20 ms.
class UdpSampleLink final : public SampleLink {
 public:
  /// Binds. @param local address of this host, port 0 takes a free one  @param incoming what the
  /// study's network does on the way to this side  @param patience for the other side, whole
  /// @throws std::system_error
  UdpSampleLink(const peer::IpEndpoint& local, SampleQueue incoming,
                std::chrono::milliseconds patience = std::chrono::seconds(10));

  /// Where it is bound, with its port.
  [[nodiscard]] peer::IpEndpoint local() const;
  /// The other side; datagrams of anybody else are not read. @throws std::system_error
  void connect(const peer::IpEndpoint& remote);

  /// @throws std::runtime_error where the other side's last sample does not come in time
  std::span<const CouplingSample> receive(std::uint32_t number) override;
  void send(std::uint32_t number, const std::optional<CouplingSample>& sample) override;

 private:
  void await(std::uint32_t number);
  void read();
  void say() noexcept;

  peer::Descriptor socket_;
  SampleQueue incoming_;
  std::chrono::milliseconds patience_;
  std::array<SampleRecord, 2> said_{};  // the newest first
  std::uint32_t said_count_ = 0;
  std::uint32_t heard_ = 0;  // samples of the other side, in their order
};

}  // namespace reckon::bench
