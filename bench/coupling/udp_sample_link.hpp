// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two processes of a coupling study in lock-step over UDP, with one datagram a sample in each
// direction. The network of the study acts on each sample at arrival, by its number. So both
// processes get, sample for sample, the same result as one process.
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

/// One side. For studies only: it waits for the other side, which no loop of a peer may do. Each
/// datagram contains the last two samples, so that it replaces a lost one. It is sent again if
/// nothing arrives for 20 ms.
class UdpSampleLink final : public SampleLink {
 public:
  /// Binds the socket. @param local address of this host, port 0 takes a free one @param incoming
  /// the study's network towards this side @param patience longest wait for a sample of the other
  /// side
  /// @throws std::system_error
  UdpSampleLink(const peer::IpEndpoint& local, SampleQueue incoming,
                std::chrono::milliseconds patience = std::chrono::seconds(10));

  /// The bound address, with its port.
  [[nodiscard]] peer::IpEndpoint local() const;
  /// Sets the address of the other side; datagrams from other addresses are not read. @throws
  /// std::system_error
  void connect(const peer::IpEndpoint& remote);

  /// @throws std::runtime_error if the last sample of the other side does not arrive in time
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
  std::uint32_t heard_ = 0;  // number of samples received from the other side, in order
};

}  // namespace reckon::bench
