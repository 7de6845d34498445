// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/touch/model_handle.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "reckon/pdu/seconds.hpp"

namespace reckon::fuzz {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kTick = std::chrono::microseconds(50);
// An older meter value is not compared.
constexpr nanoseconds kKnownAgo = std::chrono::milliseconds(50);

}  // namespace

void ModelHandle::begin_books() {
  first_ = work_now();
  first_work_ = port_work_now();
}

void ModelHandle::begin_at(nanoseconds now) {
  begin_ = now;
  next_fault_ = now + pdu::from_seconds(scenario_[Shared::fault_at]);
  is_begun_ = true;
}

Eigen::Vector3d ModelHandle::wanted(double t) const {
  return way_(is_begun_ ? t - pdu::to_seconds(begin_) : 0.0);
}

void ModelHandle::run(nanoseconds until, const std::function<void(nanoseconds)>& beside) {
  beside_ = beside;
  pass(until - now());
  beside_ = {};
}

void ModelHandle::tick(nanoseconds now) {
  if (!is_begun_) return;
  books_.push_back(work());
  play_faults(now);
  if (beside_) beside_(now);
}

double ModelHandle::work_known() const {
  const nanoseconds since = known_until();
  if (now() - since > kKnownAgo) return std::numeric_limits<double>::infinity();
  const auto count = static_cast<std::size_t>(std::max(nanoseconds(0), now() - since) / kTick) + 2;
  const auto first = books_.end() - static_cast<std::ptrdiff_t>(std::min(count, books_.size()));
  return first == books_.end() ? 0.0 : *std::max_element(first, books_.end());
}

void ModelHandle::play_faults(nanoseconds now) {
  const auto fault = static_cast<Fault>(scenario_[Shared::fault]);
  if (fault == Fault::none) return;
  if (is_hurt_ && now >= mends_) {
    is_hurt_ = false;
    mend(fault);
  }
  if (now < next_fault_ || is_hurt_) return;
  const double every = scenario_[Shared::fault_every];
  next_fault_ = every > 0 ? now + pdu::from_seconds(every) : nanoseconds::max();
  if (pdu::to_seconds(now - begin_) >= scenario_[Shared::calm_after]) return;
  const nanoseconds lasts = pdu::from_seconds(scenario_[Shared::fault_for]);
  if (fault == Fault::silence) {
    silence_ = lasts;
    return;
  }
  is_hurt_ = true;
  mends_ = now + lasts;
  befall(fault, lasts);
}

nanoseconds ModelHandle::silence() { return std::exchange(silence_, nanoseconds(0)); }

std::unique_ptr<ModelHandle> model_handle(const Scenario& scenario, nanoseconds period,
                                          ModelHandle::Way way) {
  switch (scenario.model()) {
    case Model::board:
      return board_handle(scenario, period, std::move(way));
    case Model::event:
      return event_handle(scenario, std::move(way));
    default:
      return usb_handle(scenario, period, std::move(way));
  }
}

}  // namespace reckon::fuzz
