// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How the samples of a coupling travel: by the law of impairment. What happens to each follows from
// its number and the seed alone, so that two processes over sockets see what one process sees.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/bench/baselines/coupling_end.hpp"
#include "reckon/peer/network/impairment.hpp"

namespace reckon::bench {

/// Samples on their way to one side.
class SampleQueue {
 public:
  /// A sample is on its way for a period at least, whatever the law says.
  /// @param period [s]  @param side to which they go  @throws std::invalid_argument by the law
  SampleQueue(const peer::ImpairmentLaw& law, double period, std::uint64_t seed, CouplingSide side);

  void put(const CouplingSample& sample);
  /// Those that come out at sample `number` or before, in order of arrival; valid until the next
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

/// One side's way to the other. The calls for sample k are receive(k), then send(k, ..): in
/// lock-step, so that nothing sent at k is received before k + 1.
class SampleLink {
 public:
  virtual ~SampleLink() = default;

  /// @returns what arrived since the last call, valid until the next one
  /// @throws std::runtime_error where the other side does not answer
  virtual std::span<const CouplingSample> receive(std::uint32_t number) = 0;
  /// @param sample nothing where none is due
  virtual void send(std::uint32_t number, const std::optional<CouplingSample>& sample) = 0;

 protected:
  SampleLink() = default;
  SampleLink(const SampleLink&) = default;
  SampleLink& operator=(const SampleLink&) = default;
};

/// Both sides in one process: each puts into the other's queue.
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
