// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/compression/compact_state.hpp"

#include <algorithm>
#include <bit>

#include "reckon/pdu/compression/bit_stream.hpp"

namespace reckon::pdu {
namespace {

constexpr std::size_t kGroups = 7;    // of 8 octets, for the fields that seldom change
constexpr std::uint16_t kBare = 144;  // octets of an Entity State without parts
constexpr unsigned kAlgorithmBits = 8, kLocationWidth = 6, kWidth = 5;

// The other fields, 8 octets in a number, the first one in its highest bits.
using Rest = std::array<std::uint64_t, kGroups>;

// Content of a body. `whole`: the octets are exactly one body.
struct Content {
  StateNumbers numbers;
  Rest rest;
  bool whole;
};

// The fields besides motion, in the order of the Entity State PDU.
[[gnu::always_inline]] inline void rest_fields(auto& visitor, auto& state) noexcept {
  visitor("force_id", state.force_id);
  visitor("entity_type", state.entity_type);
  visitor("alternate_entity_type", state.alternative_entity_type);
  visitor("entity_appearance", state.appearance);
  visitor("other_parameters", state.dead_reckoning.other_parameters);
  visitor("entity_marking", state.marking);
  visitor("capabilities", state.capabilities);
}

Rest rest_of(const EntityState& state) noexcept {
  std::array<std::byte, 8 * kGroups> octets{};
  Encoder encoder(octets.data());
  rest_fields(encoder, state);
  Rest rest;
  for (std::size_t i = 0; i < kGroups; ++i) {
    rest[i] = load_big_endian<std::uint64_t>(octets.data() + 8 * i);
  }
  return rest;
}

void set_rest(const Rest& rest, EntityState& state) noexcept {
  std::array<std::byte, 8 * kGroups> octets;
  for (std::size_t i = 0; i < kGroups; ++i) store_big_endian(octets.data() + 8 * i, rest[i]);
  Decoder decoder(octets);
  rest_fields(decoder, state);
}

// Writes which groups are not zero, which of their octets are not zero, and these octets.
void put_rest(BitWriter& out, const Rest& rest) noexcept {
  unsigned groups = 0;
  for (std::size_t group = 0; group < kGroups; ++group) {
    groups |= rest[group] != 0 ? 1U << group : 0U;
  }
  out.put(groups, kGroups);
  for (const std::uint64_t octets : rest) {
    if (octets == 0) continue;
    std::uint64_t sent = 0;
    unsigned map = 0, bits = 0;
    for (unsigned at = 64; at > 0; at -= 8) {
      const std::uint64_t octet = octets >> (at - 8) & 0xFF;
      const unsigned is_sent = octet != 0 ? 1 : 0;
      map = map << 1 | is_sent;
      sent = sent << 8 * is_sent | octet;
      bits += 8 * is_sent;
    }
    out.put(map, 8);
    out.put(sent >> 32, bits > 32 ? bits - 32 : 0);
    out.put(sent, std::min(bits, 32U));
  }
}

// Number of ones in 8 bits; std::popcount() calls a function on a generic processor.
unsigned ones_of(unsigned map) noexcept {
  const unsigned pairs = map - (map >> 1 & 0x55U);
  const unsigned fours = (pairs & 0x33U) + (pairs >> 2 & 0x33U);
  return (fours + (fours >> 4)) & 0xFU;
}

Rest take_rest(BitReader& in) noexcept {
  Rest rest{};
  const unsigned groups = in.take(kGroups);
  for (std::size_t group = 0; group < kGroups; ++group) {
    if ((groups & 1U << group) == 0) continue;
    const unsigned map = in.take(8);
    const unsigned bits = 8 * ones_of(map);
    std::uint64_t sent = in.take_wide(bits > 32 ? bits - 32 : 0) << 32;
    sent = bits > 32 ? sent | in.take(32) : in.take(bits);
    for (unsigned i = 0; i < 8; ++i) {
      const unsigned is_sent = map >> i & 1U;
      rest[group] |= (is_sent != 0 ? sent & 0xFF : 0) << 8 * i;
      sent >>= 8 * is_sent;
    }
  }
  return rest;
}

// Width in bits that holds all three numbers in two's complement.
template <typename Number>
unsigned width_of(const std::array<Number, 3>& numbers) noexcept {
  std::uint64_t all = 0;
  for (const std::int64_t number : numbers) {
    all |= static_cast<std::uint64_t>(number < 0 ? ~number : number);
  }
  return all == 0 && numbers == std::array<Number, 3>{}
             ? 0
             : 1 + static_cast<unsigned>(std::bit_width(all));
}

void put_numbers(BitWriter& out, const Numbers3& numbers) noexcept {
  const unsigned width = width_of(numbers);
  out.put(width, kWidth);
  out.put_three({static_cast<std::uint32_t>(numbers[0]), static_cast<std::uint32_t>(numbers[1]),
                 static_cast<std::uint32_t>(numbers[2])},
                width);
}

// Inline, as read() is, so that numbers stay in registers.
[[gnu::always_inline]] inline Numbers3 take_numbers(BitReader& in) noexcept {
  const unsigned width = in.take(kWidth);
  const std::array<std::uint64_t, 3> bits = in.take_three(width);
  const std::uint64_t span = std::uint64_t{1} << width, half = span >> 1;
  const auto number = [&](std::uint64_t of) {
    return static_cast<std::int32_t>(((of & (span - 1)) ^ half) - half);
  };
  return {number(bits[0]), number(bits[1]), number(bits[2])};
}

void put_location(BitWriter& out, const std::array<std::int64_t, 3>& numbers) noexcept {
  const unsigned width = width_of(numbers);
  out.put(width, kLocationWidth);
  for (const std::int64_t number : numbers) out.put(static_cast<std::uint64_t>(number), width);
}

[[gnu::always_inline]] inline std::array<std::int64_t, 3> take_location(BitReader& in) noexcept {
  const unsigned width = in.take(kLocationWidth), high = width > 32 ? width - 32 : 0;
  const auto number = [&] {
    if (high == 0) return std::int64_t{in.take_signed(width)};
    const std::int64_t above = std::int64_t{in.take_signed(high)} * (std::int64_t{1} << 32);
    return above | std::int64_t{in.take(32)};
  };
  const std::int64_t x = number(), y = number();
  return {x, y, number()};
}

bool is_ours(const EntityState& state) noexcept {
  const PduHeader& header = state.header;
  return state.variable_parameters.empty() && header.protocol_version == kProtocolVersion &&
         header.pdu_status == 0 && header.padding == 0;
}

[[gnu::always_inline]] inline Content read(std::span<const std::byte> body,
                                           std::uint32_t timestamp) noexcept {
  BitReader in(body);
  const StateNumbers numbers = {timestamp_near(in.take(kTimestampBits), timestamp),
                                static_cast<DeadReckoningAlgorithm>(in.take(kAlgorithmBits)),
                                take_location(in),
                                take_numbers(in),
                                take_numbers(in),
                                take_numbers(in),
                                take_numbers(in)};
  const Rest rest = take_rest(in);
  return {numbers, rest, in.at_end()};
}

}  // namespace

std::size_t encode_compact(const EntityState& state, const StateScale& scale,
                           std::span<std::byte> out) noexcept {
  const auto numbers = numbers_of(state, scale);
  if (!numbers || !is_ours(state) || out.size() < kMostCompact) return 0;
  const Rest rest = rest_of(state);

  BitWriter writer(out);
  writer.put(numbers->timestamp, kTimestampBits);
  writer.put(static_cast<unsigned>(numbers->algorithm), kAlgorithmBits);
  put_location(writer, numbers->location);
  put_numbers(writer, numbers->velocity);
  put_numbers(writer, numbers->orientation);
  put_numbers(writer, numbers->acceleration);
  put_numbers(writer, numbers->angular_velocity);
  put_rest(writer, rest);
  const std::size_t size = writer.finish();

  const Content back = read(out.first(size), numbers->timestamp);
  return back.whole && back.numbers == *numbers && back.rest == rest ? size : 0;
}

bool decode_compact(std::span<const std::byte> body, std::uint32_t timestamp,
                    const StateScale& scale, EntityState& state) noexcept {
  const Content content = read(body, timestamp);
  if (!content.whole) return false;
  const std::uint8_t exercise = state.header.exercise_id;
  state.header = header_of<EntityState>();
  state.header.exercise_id = exercise;
  state.header.length = kBare;
  state.variable_parameters = {};
  set_rest(content.rest, state);
  set_numbers(content.numbers, scale, state);
  return true;
}

}  // namespace reckon::pdu
