// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/protocol/page_request.hpp"

#include <array>
#include <bit>
#include <cmath>

namespace reckon::tools {
namespace {

/// Reads little endian; the caller has checked the length.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> octets) : octets_(octets) {}

  std::uint8_t u8() { return static_cast<std::uint8_t>(get(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(get(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(get(4)); }
  float f32() { return std::bit_cast<float>(u32()); }
  double f64() { return std::bit_cast<double>(get(8)); }

 private:
  std::uint64_t get(std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
      value |= std::to_integer<std::uint64_t>(octets_[at_ + i]) << (8 * i);
    at_ += count;
    return value;
  }
  std::span<const std::byte> octets_;
  std::size_t at_ = 0;
};

using Read = std::optional<PageRequest> (*)(Reader) noexcept;

bool is_within(float value, float least, float most) { return value >= least && value <= most; }

std::optional<PageRequest> drawn(Reader in) noexcept { return DrawnRequest{in.u32()}; }

std::optional<PageRequest> seek(Reader in) noexcept {
  const double time = in.f64();
  if (!std::isfinite(time)) return std::nullopt;
  return SeekRequest{time};
}

std::optional<PageRequest> speed(Reader in) noexcept {
  const float speed = in.f32();
  if (speed != 0 && !is_within(speed, SpeedRequest::kLeast, SpeedRequest::kMost))
    return std::nullopt;
  return SpeedRequest{speed};
}

std::optional<PageRequest> live(Reader) noexcept { return LiveRequest{}; }

std::optional<PageRequest> step(Reader in) noexcept {
  switch (static_cast<std::int8_t>(in.u8())) {
    case -1:
      return StepRequest{-1, 0};
    case 1:
      return StepRequest{1, 0};
    case -2:
      return StepRequest{0, -1};
    case 2:
      return StepRequest{0, 1};
    default:
      return std::nullopt;
  }
}

std::optional<PageRequest> pointer(Reader in) noexcept {
  PointerRequest request;
  request.hand = in.u16();
  for (float& part : request.position) {
    part = in.f32();
    if (!is_within(part, -PointerRequest::kFarthest, PointerRequest::kFarthest))
      return std::nullopt;
  }
  const std::uint8_t held = in.u8();
  if (held > 2) return std::nullopt;
  request.held = held > 0;
  request.grabs = held == 2;
  return request;
}

std::optional<PageRequest> network(Reader in) noexcept {
  NetworkRequest request;
  request.delay_ms = in.f32();
  request.jitter_ms = in.f32();
  request.loss = in.f32();
  const std::uint8_t outage = in.u8();
  if (!is_within(request.delay_ms, 0, NetworkRequest::kMostDelay) ||
      !is_within(request.jitter_ms, 0, NetworkRequest::kMostJitter) ||
      !is_within(request.loss, 0, 1) || outage > 1)
    return std::nullopt;
  request.outage = outage == 1;
  return request;
}

std::optional<PageRequest> take_hand(Reader) noexcept { return TakeHandRequest{}; }
std::optional<PageRequest> give_hand(Reader) noexcept { return GiveHandRequest{}; }
std::optional<PageRequest> follow(Reader in) noexcept { return FollowRequest{in.u16()}; }
std::optional<PageRequest> go_alone(Reader) noexcept { return GoAloneRequest{}; }
std::optional<PageRequest> whole(Reader) noexcept { return WholeRequest{}; }

/// THE list of requests: the first octet of the message, and its length.
struct Kind {
  std::uint8_t number;
  std::size_t length;
  Read read;
};
constexpr std::array<Kind, 12> kKinds{{{1, 5, drawn},
                                       {2, 9, seek},
                                       {3, 5, speed},
                                       {4, 1, live},
                                       {5, 2, step},
                                       {6, 16, pointer},
                                       {7, 14, network},
                                       {8, 1, take_hand},
                                       {9, 1, give_hand},
                                       {10, 3, follow},
                                       {11, 1, go_alone},
                                       {12, 1, whole}}};

}  // namespace

std::optional<PageRequest> read_page_request(std::span<const std::byte> message) noexcept {
  for (const Kind& kind : kKinds)
    if (message.size() == kind.length && message[0] == std::byte{kind.number})
      return kind.read(Reader(message.subspan(1)));
  return std::nullopt;
}

bool changes_exercise(const PageRequest& request) noexcept {
  return std::holds_alternative<PointerRequest>(request) ||
         std::holds_alternative<NetworkRequest>(request) ||
         std::holds_alternative<TakeHandRequest>(request) ||
         std::holds_alternative<GiveHandRequest>(request) ||
         std::holds_alternative<GoAloneRequest>(request);
}

}  // namespace reckon::tools
