// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/baselines/sample_link.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/pdu/seconds.hpp"

namespace reckon::bench {
namespace {

constexpr double kRounding = 1e-9;  // [s], of the law's times

}  // namespace

SampleQueue::SampleQueue(const peer::ImpairmentLaw& law, double period, std::uint64_t seed,
                         CouplingSide side)
    : impairment_(law, seed), period_(period), side_(side) {}

void SampleQueue::put(const CouplingSample& sample) {
  const peer::Fate fate = impairment_.decide(static_cast<std::uint64_t>(side_), sample.number,
                                             pdu::from_seconds(sample.number * period_));
  for (std::size_t copy = 0; copy < fate.copies; ++copy) {
    const double late = pdu::to_seconds(fate.delay[copy]) - kRounding;
    const double samples = std::max(1.0, std::ceil(late / period_));
    waiting_.push_back({sample.number + static_cast<std::uint32_t>(samples), sample});
  }
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
