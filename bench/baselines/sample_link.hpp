// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Transport of the samples of a coupling, with the law of impairment. The delay and loss of each
// sample depend only on its number and the seed, so that two processes over sockets get the same
// result as one process.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/bench/baselines/coupling_end.hpp"
#include "reckon/peer/network/impairment.hpp"

namespace reckon::bench {

/// Samples in transit to one side.
class SampleQueue {
 public:
  /// A sample is in transit for at least one period, for any law.
  /// @param period [s] @param side destination @throws std::invalid_argument for an invalid law
  SampleQueue(const peer::ImpairmentLaw& law, double period, std::uint64_t seed, CouplingSide side);

  void put(const CouplingSample& sample);
  /// Samples that arrive at sample `number` or before, in order of arrival; valid until the next
  /// call.
  [[nodiscard]] std::span<const CouplingSample> take(std::uint32_t number);

 private:
  struct Waiting {
    std::uint32_t release;
    CouplingSample sample;
  };

  peer::Impairment impairment_;
  double period_;
  CouplingSide side_;
  std::vector<Waiting> waiting_;
  std::vector<Waiting> out_;
  std::vector<CouplingSample> arrived_;
};

/// The link from one side to the other. The calls for sample k are receive(k), then send(k, ..), in
/// lock-step, so that nothing sent at k is received before k + 1.
class SampleLink {
 public:
  virtual ~SampleLink() = default;

  /// @returns samples that arrived since the last call, valid until the next one
  /// @throws std::runtime_error if the other side does not answer
  virtual std::span<const CouplingSample> receive(std::uint32_t number) = 0;
  /// @param sample no value if none is due
  virtual void send(std::uint32_t number, const std::optional<CouplingSample>& sample) = 0;

 protected:
  SampleLink() = default;
  SampleLink(const SampleLink&) = default;
  SampleLink& operator=(const SampleLink&) = default;
};

/// Both sides in one process: each puts its samples into the other's queue.
class QueueLink final : public SampleLink {
 public:
  QueueLink(SampleQueue& incoming, SampleQueue& outgoing)
      : incoming_(incoming), outgoing_(outgoing) {}

  std::span<const CouplingSample> receive(std::uint32_t number) override {
    return incoming_.take(number);
  }
  void send(std::uint32_t, const std::optional<CouplingSample>& sample) override {
    if (sample) outgoing_.put(*sample);
  }

 private:
  SampleQueue& incoming_;
  SampleQueue& outgoing_;
};

}  // namespace reckon::bench
