// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/impairment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "reckon/pdu/random/split_mix.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

// One independent stream of random numbers for each purpose.
enum Purpose : std::uint64_t { kLoss = 1, kBurst, kReorder, kDuplicate, kJitter };

std::uint64_t stream_key(std::uint64_t seed, std::uint64_t sender) noexcept {
  return pdu::split_mix(pdu::split_mix(seed) ^ sender);
}

std::uint64_t draw(std::uint64_t key, std::uint64_t purpose) noexcept {
  return pdu::split_mix(key ^ (purpose << 56));
}

bool is_share(double value) noexcept { return value >= 0.0 && value <= 1.0; }

std::string no_share(const char* name, double value) {
  return fmt::format("{} = {:.6g} is not a share; write 0 to 1, or 0% to 100%", name, value);
}

}  // namespace

bool ImpairmentLaw::is_perfect() const noexcept {
  return delay.count() == 0 && jitter.count() == 0 && loss == 0.0 && burst_loss == 0.0 &&
         reorder == 0.0 && duplicate == 0.0 && outages.empty();
}

std::string ImpairmentLaw::problem() const {
  if (delay.count() < 0 || jitter.count() < 0 || reorder_delay.count() < 0) {
    return "delay, jitter and reorder_delay must not be negative";
  }
  constexpr std::chrono::hours longest{1};
  if (delay > longest || jitter > longest || reorder_delay > longest) {
    return "delay, jitter and reorder_delay must not exceed one hour";
  }
  if (!is_share(loss)) return no_share("loss", loss);
  if (!is_share(reorder)) return no_share("reorder", reorder);
  if (!is_share(duplicate)) {
    return no_share("duplicate", duplicate);
  }
  if (!(burst_loss >= 0.0 && burst_loss < 1.0)) {
    return fmt::format(
        "burst_loss = {:.6g} is not a share; write 0 to below 1, or 0% to below 100%", burst_loss);
  }
  if (!(burst_length >= 1.0 && burst_length <= kMostBurstLength)) {
    return "burst_length = " + std::to_string(burst_length) + " is not from 1 to 10000 datagrams";
  }
  if (burst_loss / burst_length > 1.0 - burst_loss) {
    return "burst_loss = " + std::to_string(burst_loss) +
           " needs bursts longer than burst_length = " + std::to_string(burst_length);
  }
  for (const Outage& outage : outages) {
    if (outage.duration.count() < 0 || outage.period.count() < 0) {
      return "an outage must not have a negative duration or period";
    }
  }
  return {};
}

ImpairmentLaw delayed_by(double delay, double jitter_share, double loss) {
  ImpairmentLaw law;
  law.delay = pdu::from_seconds(delay);
  law.jitter = pdu::from_seconds(jitter_share * delay);
  law.loss = loss;
  return law;
}

double jitter_share(const ImpairmentLaw& law) noexcept {
  if (law.delay.count() == 0) return 0;
  return static_cast<double>(law.jitter.count()) / static_cast<double>(law.delay.count());
}

std::uint64_t direction_seed(std::uint64_t seed, std::uint64_t receiver) noexcept {
  return pdu::split_mix(seed ^ pdu::split_mix(receiver));
}

Impairment::Impairment(const ImpairmentLaw& law, std::uint64_t seed) : law_(law), seed_(seed) {
  if (const std::string problem = law.problem(); !problem.empty()) {
    throw std::invalid_argument("impairment: " + problem);
  }
  if (law.burst_loss > 0.0) {
    // Stationary share of the bad state: enter / (enter + leave).
    leave_ = 1.0 / law.burst_length;
    enter_ = std::min(1.0, leave_ * law.burst_loss / (1.0 - law.burst_loss));
  }
}

Fate Impairment::decide(std::uint64_t sender, std::uint64_t sequence,
                        std::chrono::nanoseconds time) const noexcept {
  const std::uint64_t key = pdu::split_mix(stream_key(seed_, sender) + sequence);
  Fate fate;
  if (in_outage(time)) {
    fate.loss = Fate::Loss::outage;
  } else if (law_.burst_loss > 0.0 && in_burst(sender, sequence)) {
    fate.loss = Fate::Loss::burst;
  } else if (law_.loss > 0.0 && pdu::unit_of(draw(key, kLoss)) < law_.loss) {
    fate.loss = Fate::Loss::random;
  }
  if (fate.loss != Fate::Loss::none) {
    fate.copies = 0;
    return fate;
  }
  fate.copies =
      law_.duplicate > 0.0 && pdu::unit_of(draw(key, kDuplicate)) < law_.duplicate ? 2 : 1;
  for (int copy = 0; copy < fate.copies; ++copy) {
    fate.delay[static_cast<std::size_t>(copy)] = draw_delay(key, copy);
  }
  return fate;
}

// The Gilbert chain without its past: if the draw at n sends both states to the same one, the
// state before n does not matter; else n keeps it (or, if enter + leave > 1, flips it). Looking
// back to the nearest such n gives the state of the stationary chain exactly.
bool Impairment::in_burst(std::uint64_t sender, std::uint64_t sequence) const noexcept {
  const std::uint64_t stream = stream_key(seed_, sender);
  const double low = std::min(enter_, 1.0 - leave_);
  const double high = std::max(enter_, 1.0 - leave_);
  const bool flips = enter_ > 1.0 - leave_;
  bool flipped = false;
  for (std::uint64_t back = 0; back < kLookBack; ++back) {
    // Sequences below 0 wrap: the chain has no beginning.
    const double u = pdu::unit_of(draw(pdu::split_mix(stream + sequence - back), kBurst));
    if (u < low) return !flipped;
    if (u >= high) return flipped;
    if (flips) flipped = !flipped;
  }
  return false;
}

bool Impairment::in_outage(std::chrono::nanoseconds time) const noexcept {
  for (const Outage& outage : law_.outages) {
    std::chrono::nanoseconds since = time - outage.start;
    if (since.count() < 0) continue;
    if (outage.period.count() > 0) since %= outage.period;
    if (since < outage.duration) return true;
  }
  return false;
}

std::chrono::nanoseconds Impairment::draw_delay(std::uint64_t key, int copy) const noexcept {
  std::chrono::nanoseconds delay = law_.delay;
  const auto number = static_cast<std::uint64_t>(copy);
  if (law_.jitter.count() > 0) {
    const auto span = 2.0 * static_cast<double>(law_.jitter.count());
    const double offset = span * pdu::unit_of(draw(key, kJitter + 8 * number));
    delay += std::chrono::nanoseconds{static_cast<std::int64_t>(offset)} - law_.jitter;
  }
  if (law_.reorder > 0.0 && pdu::unit_of(draw(key, kReorder + 8 * number)) < law_.reorder) {
    delay += law_.reorder_delay;
  }
  return std::max(delay, std::chrono::nanoseconds{0});
}

}  // namespace reckon::peer
