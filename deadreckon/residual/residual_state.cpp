// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/residual/residual_state.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/residual/number_bits.hpp"
#include "reckon/pdu/compression/bit_stream.hpp"

namespace reckon::deadreckon {
namespace {

using pdu::Numbers3;
using pdu::StateNumbers;
using pdu::StateScale;
using Vector = std::array<double, 3>;
using namespace residual;

constexpr unsigned kCodeBits = 4, kAlgorithmBits = 4, kCheckBits = 16, kAxisBits = 3;
enum Field : std::size_t { kOrientation, kTurnRate, kAcceleration, kVelocity, kLocation, kFields };

constexpr double kTick = 3600.0 / 4294967294.0;  // [s] of a timestamp's lowest bit

double seconds_between(std::uint32_t from, std::uint32_t to) noexcept {
  return kTick * static_cast<std::int32_t>(to - from);
}

double farthest(const Vector& a) noexcept {
  return largest(std::abs(a[0]), std::abs(a[1]), std::abs(a[2]));
}

// Body to world by the angles of DIS in wire units. Arguments are passed by value, as everywhere
// here: values with an address would stay in memory and wait for loads.
Vector to_world(Numbers3 angles, double unit, Vector v) noexcept {
  const double cp = std::cos(unit * angles[0]), sp = std::sin(unit * angles[0]);
  const double ct = std::cos(unit * angles[1]), st = std::sin(unit * angles[1]);
  const double cf = std::cos(unit * angles[2]), sf = std::sin(unit * angles[2]);
  const double x = ct * v[0] + st * (sf * v[1] + cf * v[2]);
  const double y = cf * v[1] - sf * v[2];
  return {cp * x - sp * y, sp * x + cp * y, -st * v[0] + ct * (sf * v[1] + cf * v[2])};
}

[[gnu::always_inline]] inline ResidualReference reference_of(const StateNumbers& numbers,
                                                             const StateScale& scale) noexcept {
  const bool body_axes = drm_terms(numbers.algorithm).body_axes;
  const double speed = scale.velocity * scale.per_metre;
  const double gain = scale.acceleration * scale.per_metre;
  Vector velocity = each_axis([&](auto i) { return speed * numbers.velocity[i]; });
  Vector acceleration = each_axis([&](auto i) { return gain * numbers.acceleration[i]; });
  if (body_axes) {
    velocity = to_world(numbers.orientation, scale.angle, velocity);
    acceleration = to_world(numbers.orientation, scale.angle, acceleration);
  }
  return {numbers, velocity, acceleration};
}

// Velocity predicted from the accelerations at both ends [quanta].
[[gnu::always_inline]] inline Vector predicted_velocity(const StateNumbers& from,
                                                        const StateNumbers& to,
                                                        const StateScale& scale) noexcept {
  const double half =
      0.5 * seconds_between(from.timestamp, to.timestamp) * scale.acceleration * scale.per_speed;
  return each_axis([&](auto i) {
    const std::int64_t both = std::int64_t{from.acceleration[i]} + to.acceleration[i];
    return from.velocity[i] + half * static_cast<double>(both);
  });
}

// Displacement since `from` [quanta]: the cubic through both ends' velocities and accelerations.
[[gnu::always_inline]] inline Vector predicted_way(const ResidualReference& from,
                                                   const ResidualReference& to) noexcept {
  const double t = seconds_between(from.numbers.timestamp, to.numbers.timestamp);
  return each_axis([&](auto i) {
    return t * (0.5 * (from.velocity[i] + to.velocity[i]) +
                t / 12.0 * (from.acceleration[i] - to.acceleration[i]));
  });
}

// A sum of products with odd factors. Its high bits are equal for two different states only by
// chance.
[[gnu::always_inline]] inline std::uint64_t hash_of(const StateNumbers& n,
                                                    std::uint64_t key) noexcept {
  constexpr std::uint64_t kFactor = 0x9E3779B97F4A7C15ULL;
  std::uint64_t factor = kFactor, sum = key;
  const auto add = [&](std::uint64_t value) {
    sum += (value + 0x632BE59BD9B4E019ULL) * factor;
    factor += 2 * kFactor;
  };
  const auto add_axis = [&](std::size_t i) {
    add(static_cast<std::uint64_t>(n.location[i]));
    add(static_cast<std::uint64_t>(n.velocity[i]) << 32 ^
        static_cast<std::uint32_t>(n.orientation[i]));
    add(static_cast<std::uint64_t>(n.acceleration[i]) << 32 ^
        static_cast<std::uint32_t>(n.angular_velocity[i]));
  };
  add_axis(0);
  add_axis(1);
  add_axis(2);
  add(std::uint64_t{n.timestamp} << 8 | static_cast<std::uint64_t>(n.algorithm));
  sum ^= sum >> 32;
  return sum * kFactor;
}

[[gnu::always_inline]] inline unsigned check_of(const StateNumbers& numbers,
                                                std::uint64_t key) noexcept {
  return static_cast<unsigned>(hash_of(numbers, key) >> (64 - kCheckBits));
}

// Hash of all data of the key state that later updates need.
std::uint64_t key_hash_of(const pdu::EntityState& key) noexcept {
  std::uint64_t hash = key.entity_id.key();
  const auto add = [&hash](std::uint64_t value) {
    hash = (hash ^ value) * 0x9E3779B97F4A7C15ULL;
    hash ^= hash >> 31;
  };
  const auto add_type = [&](const pdu::EntityType& type) {
    add(std::uint64_t{static_cast<std::uint8_t>(type.kind)} << 56 |
        std::uint64_t{static_cast<std::uint8_t>(type.domain)} << 48 |
        std::uint64_t{type.country} << 32 | std::uint64_t{type.category} << 24 |
        std::uint64_t{type.subcategory} << 16 | std::uint64_t{type.specific} << 8 | type.extra);
  };
  add(std::uint64_t{static_cast<std::uint8_t>(key.force_id)} << 32 | key.appearance);
  add_type(key.entity_type);
  add_type(key.alternative_entity_type);
  add(key.capabilities);
  for (const std::uint8_t octet : key.dead_reckoning.other_parameters) add(octet);
  add(static_cast<std::uint64_t>(key.marking.character_set));
  for (const char letter : key.marking.text) add(static_cast<unsigned char>(letter));
  return hash;
}

template <typename Number>
[[gnu::always_inline]] inline std::array<Number, 3> take(pdu::BitReader& in,
                                                         const std::array<Number, 3>& predicted,
                                                         unsigned width) noexcept {
  return restored(in.take_three(width), predicted, width);
}

// Nearest integer, within `most` of 0.
[[gnu::always_inline]] inline std::int64_t nearest(double value, double most) noexcept {
  const double bounded = std::min(std::max(value, -most), most);
  return static_cast<std::int64_t>(bounded + std::copysign(0.5, bounded));
}

[[gnu::always_inline]] inline Numbers3 nearest(const Vector& v) noexcept {
  constexpr double kMost = 1e9;
  return each_axis([&](auto i) { return static_cast<std::int32_t>(nearest(v[i], kMost)); });
}

[[gnu::always_inline]] inline std::array<std::int64_t, 3> place_after(const StateNumbers& from,
                                                                      const Vector& way) noexcept {
  constexpr double kFarthest = 1e15;
  return each_axis([&](auto i) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(from.location[i]) +
                                     static_cast<std::uint64_t>(nearest(way[i], kFarthest)));
  });
}

[[gnu::always_inline]] inline Numbers3 wrapped(const Numbers3& angles,
                                               unsigned turn_bits) noexcept {
  const unsigned unused = 32 - turn_bits;
  return each_axis([&](auto i) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(angles[i]) << unused) >> unused;
  });
}

// A body decoded against `last`. `whole`: the octets are exactly one body.
struct Reading {
  ResidualReference now;
  unsigned check;
  bool whole;
};

[[gnu::always_inline]] inline Reading read(std::span<const std::byte> body, std::uint32_t timestamp,
                                           const StateScale& scale,
                                           const ResidualReference& last) noexcept {
  pdu::BitReader in(body);
  const std::uint64_t head = in.take_wide(kCheckBits + pdu::kTimestampBits);
  constexpr std::uint32_t kTimestamp = (std::uint32_t{1} << pdu::kTimestampBits) - 1;
  const std::uint32_t codes = in.take(kAlgorithmBits + kFields * kCodeBits);
  StateNumbers n;
  n.timestamp = pdu::timestamp_near(static_cast<std::uint32_t>(head) & kTimestamp, timestamp);
  n.algorithm = static_cast<pdu::DeadReckoningAlgorithm>(codes >> kFields * kCodeBits);
  const auto width = [codes](Field field) {
    return kWidths[codes >> kCodeBits * (kFields - 1 - field) & kHighest];
  };
  const StateNumbers& old = last.numbers;
  n.orientation = wrapped(take(in, old.orientation, width(kOrientation)), scale.turn_bits);
  const unsigned turning = in.take(kAxisBits);
  n.angular_velocity = each_axis([&](auto i) {
    const unsigned turn_bits = width(kTurnRate) * (turning >> i & 1U);
    return restored(in.take(turn_bits), old.angular_velocity[i], turn_bits);
  });
  n.acceleration = take(in, old.acceleration, width(kAcceleration));
  n.velocity = take(in, nearest(predicted_velocity(old, n, scale)), width(kVelocity));
  ResidualReference now = reference_of(n, scale);
  now.numbers.location = take(in, place_after(old, predicted_way(last, now)), width(kLocation));
  return {now, static_cast<unsigned>(head >> pdu::kTimestampBits), in.at_end()};
}

std::array<std::int32_t, 9> turning(const StateNumbers& n) noexcept {
  return {n.orientation[0],      n.orientation[1],      n.orientation[2],
          n.angular_velocity[0], n.angular_velocity[1], n.angular_velocity[2],
          n.acceleration[0],     n.acceleration[1],     n.acceleration[2]};
}

bool is_ours(const pdu::EntityState& state) noexcept {
  const pdu::PduHeader& header = state.header;
  return state.variable_parameters.empty() && header.protocol_version == pdu::kProtocolVersion &&
         header.pdu_status == 0 && header.padding == 0 &&
         static_cast<unsigned>(state.dead_reckoning.algorithm) < 1U << kAlgorithmBits;
}

}  // namespace

// ---------------------------------------------------------------------------------------- sending

bool ResidualEncoder::note_key(const pdu::EntityState& state) noexcept {
  const auto numbers = pdu::numbers_of(state, scale_);
  has_key_ = numbers.has_value() && is_ours(state);
  if (!has_key_) return false;
  const bool is_new = key_hash_ == 0 || !pdu::is_alike(key_, state);
  if (is_new) {
    key_ = state;
    key_hash_ = key_hash_of(state);
    noted_ = 0;
    const ResidualReference first = reference_of(*numbers, scale_);
    const auto values = turning(*numbers);
    first_ = {first, first};
    extremes_.fill({values, values});
  }
  note(reference_of(*numbers, scale_));
  return true;
}

[[gnu::flatten]] std::size_t ResidualEncoder::encode(
    const pdu::EntityState& state, std::span<std::byte, kMostResidual> out) noexcept {
  if (!has_key_ || !is_ours(state) || !pdu::is_alike(key_, state)) return 0;
  const auto numbers = pdu::numbers_of(state, scale_);
  if (!numbers) return 0;
  const ResidualReference now = reference_of(*numbers, scale_);
  const Vector velocity = predicted_velocity(last_.numbers, *numbers, scale_);
  const Vector way = predicted_way(last_, now);
  const Widths widths = widths_for(now, velocity, way);
  if (!widths.fit || !restores(widths, *numbers, velocity, way)) return 0;

  pdu::BitWriter writer(out);
  const std::uint32_t low = numbers->timestamp & ((std::uint32_t{1} << pdu::kTimestampBits) - 1);
  writer.put(std::uint64_t{check_of(*numbers, key_hash_)} << pdu::kTimestampBits | low,
             kCheckBits + pdu::kTimestampBits);
  auto codes = static_cast<unsigned>(numbers->algorithm);
  std::array<unsigned, kFields> width;
  for (std::size_t i = 0; i < kFields; ++i) {
    codes = codes << kCodeBits | widths.code[i];
    width[i] = kWidths[widths.code[i]];
  }
  writer.put(codes, kAlgorithmBits + kFields * kCodeBits);
  writer.put_three(bits_of(numbers->orientation), width[kOrientation]);
  writer.put(widths.turning, kAxisBits);
  for (std::size_t i = 0; i < 3; ++i) {
    writer.put(static_cast<std::uint32_t>(numbers->angular_velocity[i]),
               width[kTurnRate] * (widths.turning >> i & 1U));
  }
  writer.put_three(bits_of(numbers->acceleration), width[kAcceleration]);
  writer.put_three(bits_of(numbers->velocity), width[kVelocity]);
  writer.put_three(bits_of(numbers->location), width[kLocation]);
  note(now);
  return writer.finish();
}

// Whether a receiver with the last state restores the same numbers.
bool ResidualEncoder::restores(const Widths& widths, const StateNumbers& now,
                               const std::array<double, 3>& velocity,
                               const std::array<double, 3>& way) const noexcept {
  const StateNumbers& old = last_.numbers;
  const auto differ = [&widths](const auto& numbers, const auto& predicted, Field field) {
    const auto back = restored(bits_of(numbers), predicted, kWidths[widths.code[field]]);
    return (back[0] ^ numbers[0]) | (back[1] ^ numbers[1]) | (back[2] ^ numbers[2]);
  };
  const auto rates = each_axis([&](auto i) {
    const unsigned turn_bits = kWidths[widths.code[kTurnRate]] * (widths.turning >> i & 1U);
    const std::int32_t rate = now.angular_velocity[i];
    return restored(static_cast<std::uint64_t>(rate), old.angular_velocity[i], turn_bits) ^ rate;
  });
  const auto angles = wrapped(
      restored(bits_of(now.orientation), old.orientation, kWidths[widths.code[kOrientation]]),
      scale_.turn_bits);
  const auto turned = each_axis([&](auto i) { return angles[i] ^ now.orientation[i]; });
  const std::int64_t any = rates[0] | rates[1] | rates[2] | turned[0] | turned[1] | turned[2] |
                           differ(now.acceleration, old.acceleration, kAcceleration) |
                           differ(now.velocity, nearest(velocity), kVelocity);
  return (any | differ(now.location, place_after(old, way), kLocation)) == 0;
}

// Fills the younger half of the window; a full one becomes the older half.
void ResidualEncoder::note(const ResidualReference& sent) noexcept {
  const auto values = turning(sent.numbers);
  if (noted_ == kWindow) {
    first_[1] = first_[0];
    extremes_[1] = extremes_[0];
    noted_ = 0;
  }
  if (noted_ == 0) {
    first_[0] = sent;
    extremes_[0] = {values, values};
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    extremes_[0].least[i] = std::min(extremes_[0].least[i], values[i]);
    extremes_[0].most[i] = std::max(extremes_[0].most[i], values[i]);
  }
  ++noted_;
  last_ = sent;
}

// Widths for a receiver that has any update of the window: exact for the numbers predicted as
// constant, and a quarter more than the window's ends need for location and velocity.
ResidualEncoder::Widths ResidualEncoder::widths_for(
    const ResidualReference& now, const std::array<double, 3>& velocity_from_last,
    const std::array<double, 3>& way_from_last) const noexcept {
  const auto values = turning(now.numbers);
  const auto off = [&](std::size_t i) {
    const std::int32_t least = std::min(extremes_[0].least[i], extremes_[1].least[i]);
    const std::int32_t most = std::max(extremes_[0].most[i], extremes_[1].most[i]);
    return largest(0, values[i] - least, most - values[i]);
  };
  const auto turn = each_axis([&](auto i) { return off(i); });
  const auto rate = each_axis([&](auto i) { return off(3 + i); });
  const auto gain = each_axis([&](auto i) { return off(6 + i); });
  double velocity = 0.0, way = 0.0;
  const auto widen = [&](const ResidualReference& from, const Vector& v, const Vector& p) {
    const StateNumbers &to = now.numbers, &old = from.numbers;
    const double v_off = farthest(each_axis([&](auto i) { return v[i] - to.velocity[i]; }));
    const double p_off = farthest(each_axis(
        [&](auto i) { return p[i] - static_cast<double>(to.location[i] - old.location[i]); }));
    velocity = velocity < v_off ? v_off : velocity;
    way = way < p_off ? p_off : way;
  };
  widen(last_, velocity_from_last, way_from_last);
  for (const ResidualReference& from : first_) {
    widen(from, predicted_velocity(from.numbers, now.numbers, scale_), predicted_way(from, now));
  }
  Widths widths;
  constexpr unsigned kWholeTurn = 13;  // its code: 16 bits
  widths.code[kOrientation] = std::min(code_for(largest(turn[0], turn[1], turn[2])), kWholeTurn);
  widths.code[kTurnRate] = code_for(largest(rate[0], rate[1], rate[2]));
  for (unsigned i = 0; i < 3; ++i) widths.turning |= (rate[i] != 0 ? 1U : 0U) << i;
  widths.code[kAcceleration] = code_for(largest(gain[0], gain[1], gain[2]));
  widths.code[kVelocity] = code_for(1.25 * velocity + 1.0);
  widths.code[kLocation] = code_for(1.25 * way + 1.0);
  for (const unsigned code : widths.code) widths.fit = widths.fit && code <= kHighest;
  return widths;
}

// -------------------------------------------------------------------------------------- receiving

void ResidualDecoder::note_plain(const pdu::EntityState& state) noexcept {
  const auto numbers = pdu::numbers_of(state, scale_);
  const bool knows = has_key_ && state.variable_parameters.empty() && pdu::is_alike(key_, state);
  has_key_ = numbers.has_value();
  if (!has_key_) return;
  if (!knows) key_hash_ = key_hash_of(state);
  key_ = state;
  key_.variable_parameters = {};
  last_ = reference_of(*numbers, scale_);
}

ResidualVerdict ResidualDecoder::decode(std::span<const std::byte> body, std::uint32_t timestamp,
                                        pdu::EntityState& out) noexcept {
  if (!has_key_) return ResidualVerdict::no_key;
  const auto [now, check, whole] = read(body, timestamp, scale_, last_);
  if (!whole) return ResidualVerdict::malformed;
  if (check != check_of(now.numbers, key_hash_)) return ResidualVerdict::no_key;
  out = key_;
  pdu::set_numbers(now.numbers, scale_, out);
  const bool newer = static_cast<std::int32_t>(now.numbers.timestamp - last_.numbers.timestamp) > 0;
  if (newer) last_ = now;
  return ResidualVerdict::good;
}

}  // namespace reckon::deadreckon
