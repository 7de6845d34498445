// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/baselines/sample_link.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "reckon/pdu/random/split_mix.hpp"

namespace reckon::bench {
namespace {

double drawn(std::uint64_t seed, CouplingSide side, std::uint32_t sent, unsigned draw) noexcept {
  const std::uint64_t key = (std::uint64_t{sent} << 8) | (static_cast<std::uint64_t>(side) << 4);
  return pdu::unit_of(pdu::split_mix(pdu::split_mix(seed) ^ pdu::split_mix(key | draw)));
}

void require(bool good, const char* what, double value) {
  if (good) return;
  throw std::invalid_argument("coupling network: " + std::string(what) + ", got " +
                              std::to_string(value));
}

bool is_share(double x) { return x >= 0 && x <= 1; }

}  // namespace

void check(const CouplingNetwork& n) {
  require(n.delay >= 0 && n.delay <= 60, "the delay must be 0 to 60 s", n.delay);
  require(is_share(n.jitter), "jitter is a share of the delay, 0 to 1", n.jitter);
  require(is_share(n.loss), "loss must be 0 to 1", n.loss);
  require(is_share(n.reordering), "reordering must be 0 to 1", n.reordering);
  require(n.reorder_delay >= 0 && n.reorder_delay <= 60, "the reorder delay must be 0 to 60 s",
          n.reorder_delay);
}

std::optional<std::uint32_t> release_of(const CouplingNetwork& network, double period,
                                        std::uint64_t seed, CouplingSide side,
                                        std::uint32_t sent) noexcept {
  if (drawn(seed, side, sent, 0) < network.loss) return std::nullopt;
  double late = network.delay * (1 + network.jitter * (2 * drawn(seed, side, sent, 1) - 1));
  if (drawn(seed, side, sent, 2) < network.reordering) late += network.reorder_delay;
  const double samples = std::max(1.0, std::ceil(late / period - 1e-9));
  return sent + static_cast<std::uint32_t>(samples);
}

SampleQueue::SampleQueue(const CouplingNetwork& network, double period, std::uint64_t seed,
                         CouplingSide side)
    : network_(network), period_(period), seed_(seed), side_(side) {
  check(network);
}

void SampleQueue::put(const CouplingSample& sample) {
  const auto release = release_of(network_, period_, seed_, side_, sample.number);
  if (release) waiting_.push_back({*release, sample});
}

std::span<const CouplingSample> SampleQueue::take(std::uint32_t number) {
  arrived_.clear();
  out_.clear();
  const auto due = [number](const Waiting& w) { return w.release <= number; };
  std::copy_if(waiting_.begin(), waiting_.end(), std::back_inserter(out_), due);
  if (out_.empty()) return arrived_;
  std::erase_if(waiting_, due);
  std::stable_sort(out_.begin(), out_.end(),
                   [](const Waiting& a, const Waiting& b) { return a.release < b.release; });
  for (const Waiting& w : out_) arrived_.push_back(w.sample);
  return arrived_;
}

}  // namespace reckon::bench
