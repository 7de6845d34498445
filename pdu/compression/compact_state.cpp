// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/compression/compact_state.hpp"

#include <bit>
#include <cstring>

#include "reckon/pdu/compression/bit_stream.hpp"

namespace reckon::pdu {
namespace {

constexpr std::size_t kGroups = 7;  // of 8 octets, for the fields that seldom change
constexpr std::size_t kBare = 144;  // octets of an Entity State without parts
constexpr unsigned kAlgorithmBits = 8, kLocationWidth = 6, kWidth = 5;

using Rest = std::array<std::byte, 8 * kGroups>;

// The fields besides motion lie in these runs of the plain PDU.
struct Run {
  std::size_t at, size;
};
constexpr std::array<Run, 6> kRuns = {{{18, 1}, {20, 16}, {84, 4}, {89, 15}, {128, 12}, {140, 4}}};

Rest rest_of(std::span<const std::byte, kBare> plain) noexcept {
  Rest rest{};
  std::size_t to = 0;
  for (const Run& run : kRuns) {
    std::memcpy(rest.data() + to, plain.data() + run.at, run.size);
    to += run.size;
  }
  return rest;
}

void set_rest(const Rest& rest, std::span<std::byte, kBare> plain) noexcept {
  std::size_t from = 0;
  for (const Run& run : kRuns) {
    std::memcpy(plain.data() + run.at, rest.data() + from, run.size);
    from += run.size;
  }
}

// Which groups hold anything, which of their octets do, and these.
void put_rest(BitWriter& out, const Rest& rest) noexcept {
  std::array<unsigned, kGroups> maps{};
  unsigned groups = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i] == std::byte{0}) continue;
    maps[i / 8] |= 0x80U >> i % 8;
    groups |= 1U << i / 8;
  }
  out.put(groups, kGroups);
  for (std::size_t group = 0; group < kGroups; ++group) {
    if (maps[group] == 0) continue;
    out.put(maps[group], 8);
    for (std::size_t i = 0; i < 8; ++i) {
      if ((maps[group] & 0x80U >> i) != 0) {
        out.put(std::to_integer<unsigned>(rest[8 * group + i]), 8);
      }
    }
  }
}

Rest take_rest(BitReader& in) noexcept {
  Rest rest{};
  const unsigned groups = in.take(kGroups);
  for (std::size_t group = 0; group < kGroups; ++group) {
    if ((groups & 1U << group) == 0) continue;
    const unsigned map = in.take(8);
    for (std::size_t i = 0; i < 8; ++i) {
      if ((map & 0x80U >> i) != 0) rest[8 * group + i] = static_cast<std::byte>(in.take(8));
    }
  }
  return rest;
}

// Bits of two's complement that hold all three.
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
  for (const std::int32_t number : numbers) out.put(static_cast<std::uint32_t>(number), width);
}

Numbers3 take_numbers(BitReader& in) noexcept {
  const unsigned width = in.take(kWidth);
  return {in.take_signed(width), in.take_signed(width), in.take_signed(width)};
}

void put_location(BitWriter& out, const std::array<std::int64_t, 3>& numbers) noexcept {
  const unsigned width = width_of(numbers), high = width > 32 ? width - 32 : 0;
  out.put(width, kLocationWidth);
  for (const std::int64_t number : numbers) {
    out.put(static_cast<std::uint64_t>(number) >> 32, high);
    out.put(static_cast<std::uint64_t>(number), width - high);
  }
}

std::array<std::int64_t, 3> take_location(BitReader& in) noexcept {
  const unsigned width = in.take(kLocationWidth), high = width > 32 ? width - 32 : 0;
  std::array<std::int64_t, 3> numbers{};
  for (std::int64_t& number : numbers) {
    if (high == 0) {
      number = in.take_signed(width);
    } else {
      number = std::int64_t{in.take_signed(high)} * (std::int64_t{1} << 32);
      number |= std::int64_t{in.take(32)};
    }
  }
  return numbers;
}

bool is_ours(const EntityState& state) noexcept {
  const PduHeader& header = state.header;
  return state.variable_parameters.empty() && header.protocol_version == kProtocolVersion &&
         header.pdu_status == 0 && header.padding == 0;
}

}  // namespace

std::size_t encode_compact(const EntityState& state, const StateScale& scale,
                           std::span<std::byte> out) noexcept {
  std::array<std::byte, kBare> plain;
  const auto numbers = numbers_of(state, scale);
  if (!numbers || !is_ours(state) || out.size() < kMostCompact) return 0;
  if (encode(state, plain) != kBare) return 0;

  BitWriter writer(out);
  writer.put(numbers->timestamp, kTimestampBits);
  writer.put(static_cast<unsigned>(numbers->algorithm), kAlgorithmBits);
  put_location(writer, numbers->location);
  put_numbers(writer, numbers->velocity);
  put_numbers(writer, numbers->orientation);
  put_numbers(writer, numbers->acceleration);
  put_numbers(writer, numbers->angular_velocity);
  put_rest(writer, rest_of(plain));
  const std::size_t size = writer.finish();

  EntityState back = state;
  if (!decode_compact(out.first(size), numbers->timestamp, scale, back)) return 0;
  return is_alike(back, state) && numbers_of(back, scale) == numbers ? size : 0;
}

bool decode_compact(std::span<const std::byte> body, std::uint32_t timestamp,
                    const StateScale& scale, EntityState& state) noexcept {
  BitReader reader(body);
  StateNumbers numbers;
  numbers.timestamp = timestamp_near(reader.take(kTimestampBits), timestamp);
  numbers.algorithm = static_cast<DeadReckoningAlgorithm>(reader.take(kAlgorithmBits));
  numbers.location = take_location(reader);
  numbers.velocity = take_numbers(reader);
  numbers.orientation = take_numbers(reader);
  numbers.acceleration = take_numbers(reader);
  numbers.angular_velocity = take_numbers(reader);
  const Rest rest = take_rest(reader);
  if (!reader.at_end()) return false;

  std::array<std::byte, kBare> plain{};
  const std::uint8_t exercise = state.header.exercise_id;
  const EntityId id = state.entity_id;
  EntityState bare;
  if (encode(bare, plain) != kBare) return false;
  set_rest(rest, plain);
  if (decode(plain, state) != DecodeError::none) return false;
  state.header.exercise_id = exercise;
  state.entity_id = id;
  set_numbers(numbers, scale, state);
  return true;
}

}  // namespace reckon::pdu
