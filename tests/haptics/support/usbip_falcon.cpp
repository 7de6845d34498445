// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/haptics/support/usbip_falcon.hpp"

#include <linux/usb/ch9.h>

#include <algorithm>
#include <array>

#include "reckon/pdu/seconds.hpp"

namespace reckon::test {

using Eigen::Vector3d;

UsbipFalcon::Model::Model(const FalconModelOptions& options, const Vector3d& hand_at)
    : from_(hand_at), to_(hand_at), falcon(options, [this](double t) { return hand(t); }) {}

Vector3d UsbipFalcon::Model::hand(double t) const {
  const Vector3d way = to_ - from_;
  const double gone = kHandSpeed * std::max(0.0, t - left_);
  return gone < way.norm() ? Vector3d(from_ + gone * way.normalized()) : to_;
}

void UsbipFalcon::Model::go(const Vector3d& place) {
  const double now = pdu::to_seconds(falcon.now());
  from_ = hand(now);
  to_ = place;
  left_ = now;
}

std::vector<std::uint8_t> UsbipFalcon::Model::descriptor(std::uint8_t kind,
                                                         std::uint8_t /*index*/) const {
  const std::vector<std::uint8_t> both = falcon.descriptors();
  const auto cut = both.begin() + both.front();
  if (kind == USB_DT_DEVICE) return {both.begin(), cut};
  if (kind == USB_DT_CONFIG) return {cut, both.end()};
  return {};
}

std::optional<std::vector<std::uint8_t>> UsbipFalcon::Model::control(
    std::span<const std::uint8_t, 8> setup, std::span<const std::uint8_t> /*data*/) {
  const auto word = [&](std::size_t i) {
    return static_cast<std::uint16_t>(setup[i] | setup[i + 1] << 8);
  };
  std::vector<std::uint8_t> answer((setup[0] & USB_DIR_IN) != 0 ? word(6) : 0);
  const int moved = falcon.control(setup[1], word(2), answer);
  if (moved < 0) return std::nullopt;
  answer.resize(std::min(answer.size(), static_cast<std::size_t>(moved)));
  return answer;
}

bool UsbipFalcon::Model::take(std::span<const std::uint8_t> octets) {
  if (!begun_) falcon.begin_out(octets);
  begun_ = !falcon.out_done();
  return !begun_;
}

std::optional<std::vector<std::uint8_t>> UsbipFalcon::Model::give() {
  std::array<std::uint8_t, 64> octets{};
  const std::optional<int> moved = falcon.in_done(octets);
  if (!moved) return std::nullopt;
  return std::vector<std::uint8_t>(octets.begin(), octets.begin() + *moved);
}

void UsbipFalcon::Model::run_until(std::chrono::nanoseconds now) {
  falcon.pass(now - made_ - falcon.now());
}

void UsbipFalcon::Model::lose_power() {
  falcon.forget();
  begun_ = false;
}

}  // namespace reckon::test
