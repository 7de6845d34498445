// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/residual/residual_state.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/compression/bit_stream.hpp"

namespace reckon::deadreckon {
namespace {

using pdu::Numbers3;
using pdu::StateNumbers;
using pdu::StateScale;
using Vector = std::array<double, 3>;

// Bits of each number of a field; a field says which by its place here.
constexpr std::array<unsigned, 16> kWidths = {0,  2,  4,  5,  6,  7,  8,  9,
                                              10, 11, 12, 13, 14, 16, 18, 22};
constexpr unsigned kCodeBits = 4, kAlgorithmBits = 4, kCheckBits = 16, kAxisBits = 3, kHighest = 15;
enum Field : std::size_t { kOrientation, kTurnRate, kAcceleration, kVelocity, kLocation, kFields };

constexpr double kTick = 3600.0 / 4294967294.0;  // [s] of a timestamp with its lowest bit

double seconds_between(std::uint32_t from, std::uint32_t to) noexcept {
  return kTick * static_cast<std::int32_t>(to - from);
}

// Narrowest code of at least so many bits.
constexpr auto kCodeOf = [] {
  std::array<std::uint8_t, kWidths.back() + 1> code{};
  for (unsigned bits = 0; bits < code.size(); ++bits)
    while (kWidths[code[bits]] < bits) ++code[bits];
  return code;
}();

// Narrowest code whose numbers reach `distance` either way; above kHighest where none does.
unsigned code_for(double distance) noexcept {
  if (distance <= 0.0) return 0;
  const double wanted = 2.0 * distance + 2.0;  // numbers
  if (!(wanted <= static_cast<double>(1U << kWidths.back()))) return kHighest + 1;
  const auto below = static_cast<std::uint32_t>(wanted);
  const bool is_whole = static_cast<double>(below) == wanted;
  return kCodeOf[static_cast<unsigned>(std::bit_width(is_whole ? below - 1 : below))];
}

double farthest(const Vector& a) noexcept {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

// Body to world by the angles of DIS, as the wire has them.
Vector to_world(const Numbers3& angles, const StateScale& scale, const Vector& v) noexcept {
  const double unit = scale.angle;
  const double cp = std::cos(unit * angles[0]), sp = std::sin(unit * angles[0]);
  const double ct = std::cos(unit * angles[1]), st = std::sin(unit * angles[1]);
  const double cf = std::cos(unit * angles[2]), sf = std::sin(unit * angles[2]);
  const double x = ct * v[0] + st * (sf * v[1] + cf * v[2]);
  const double y = cf * v[1] - sf * v[2];
  return {cp * x - sp * y, sp * x + cp * y, -st * v[0] + ct * (sf * v[1] + cf * v[2])};
}

ResidualReference reference_of(const StateNumbers& numbers, const StateScale& scale) noexcept {
  ResidualReference reference;
  reference.numbers = numbers;
  const double speed = scale.velocity * scale.per_metre;
  const double gain = scale.acceleration * scale.per_metre;
  for (std::size_t i = 0; i < 3; ++i) {
    reference.velocity[i] = speed * numbers.velocity[i];
    reference.acceleration[i] = gain * numbers.acceleration[i];
  }
  if (drm_terms(numbers.algorithm).body_axes) {
    reference.velocity = to_world(numbers.orientation, scale, reference.velocity);
    reference.acceleration = to_world(numbers.orientation, scale, reference.acceleration);
  }
  return reference;
}

// The velocity that the accelerations at both ends lead to [quanta].
Vector predicted_velocity(const StateNumbers& from, const StateNumbers& to,
                          const StateScale& scale) noexcept {
  const double half =
      0.5 * seconds_between(from.timestamp, to.timestamp) * scale.acceleration * scale.per_speed;
  Vector v;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = from.velocity[i] + half * (from.acceleration[i] + to.acceleration[i]);
  }
  return v;
}

// The way since `from` [quanta]: the cubic through both ends' velocities and accelerations.
Vector predicted_way(const ResidualReference& from, const ResidualReference& to) noexcept {
  const double t = seconds_between(from.numbers.timestamp, to.numbers.timestamp);
  Vector way;
  for (std::size_t i = 0; i < 3; ++i) {
    way[i] = t * (0.5 * (from.velocity[i] + to.velocity[i]) +
                  t / 12.0 * (from.acceleration[i] - to.acceleration[i]));
  }
  return way;
}

// A sum of products with odd factors: its high bits differ for any two states but by chance.
std::uint64_t hash_of(const StateNumbers& n, std::uint64_t key) noexcept {
  constexpr std::uint64_t kFactor = 0x9E3779B97F4A7C15ULL;
  std::uint64_t factor = kFactor, sum = key;
  const auto add = [&](std::uint64_t value) {
    sum += (value + 0x632BE59BD9B4E019ULL) * factor;
    factor += 2 * kFactor;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    add(static_cast<std::uint64_t>(n.location[i]));
    add(static_cast<std::uint64_t>(n.velocity[i]) << 32 ^
        static_cast<std::uint32_t>(n.orientation[i]));
    add(static_cast<std::uint64_t>(n.acceleration[i]) << 32 ^
        static_cast<std::uint32_t>(n.angular_velocity[i]));
  }
  add(std::uint64_t{n.timestamp} << 8 | static_cast<std::uint64_t>(n.algorithm));
  sum ^= sum >> 32;
  return sum * kFactor;
}

unsigned check_of(const StateNumbers& numbers, std::uint64_t key) noexcept {
  return static_cast<unsigned>(hash_of(numbers, key) >> (64 - kCheckBits));
}

// Of all that the key holds for the updates after it.
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

void put(pdu::BitWriter& out, const Numbers3& numbers, unsigned code) noexcept {
  for (const std::int32_t n : numbers) out.put(static_cast<std::uint32_t>(n), kWidths[code]);
}

// The number whose lowest bits are the next ones, nearest to `predicted`.
std::int64_t take(pdu::BitReader& in, std::int64_t predicted, unsigned code) noexcept {
  const unsigned width = kWidths[code];
  if (width == 0) return predicted;
  const std::uint32_t off = in.take(width) - static_cast<std::uint32_t>(predicted);
  return predicted + (static_cast<std::int32_t>(off << (32 - width)) >> (32 - width));
}

Numbers3 take(pdu::BitReader& in, const Numbers3& predicted, unsigned code) noexcept {
  Numbers3 numbers;
  for (std::size_t i = 0; i < 3; ++i) {
    numbers[i] = static_cast<std::int32_t>(take(in, predicted[i], code));
  }
  return numbers;
}

std::int64_t nearest(double value) noexcept {
  return static_cast<std::int64_t>(std::clamp(value, -1e15, 1e15) + (value < 0 ? -0.5 : 0.5));
}

Numbers3 nearest(const Vector& v) noexcept {
  const auto bounded = [](double value) {
    return static_cast<std::int32_t>(nearest(std::clamp(value, -1e9, 1e9)));
  };
  return {bounded(v[0]), bounded(v[1]), bounded(v[2])};
}

Numbers3 wrapped(const Numbers3& angles, unsigned turn_bits) noexcept {
  Numbers3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(angles[i]) << (32 - turn_bits)) >>
        (32 - turn_bits);
  }
  return result;
}

// The state that a body says to who has `last`; the check besides. False where it is no body.
bool read(std::span<const std::byte> body, std::uint32_t timestamp, const StateScale& scale,
          const ResidualReference& last, ResidualReference& out, unsigned& check) noexcept {
  pdu::BitReader in(body);
  check = in.take(kCheckBits);
  StateNumbers n;
  n.timestamp = pdu::timestamp_near(in.take(pdu::kTimestampBits), timestamp);
  n.algorithm = static_cast<pdu::DeadReckoningAlgorithm>(in.take(kAlgorithmBits));
  std::array<unsigned, kFields> code;
  for (unsigned& one : code) one = in.take(kCodeBits);
  const StateNumbers& old = last.numbers;
  n.orientation = wrapped(take(in, old.orientation, code[kOrientation]), scale.turn_bits);
  const unsigned turning = in.take(kAxisBits);
  n.angular_velocity = old.angular_velocity;
  for (std::size_t i = 0; i < 3; ++i) {
    if ((turning >> i & 1U) == 0) continue;
    n.angular_velocity[i] =
        static_cast<std::int32_t>(take(in, old.angular_velocity[i], code[kTurnRate]));
  }
  n.acceleration = take(in, old.acceleration, code[kAcceleration]);
  n.velocity = take(in, nearest(predicted_velocity(old, n, scale)), code[kVelocity]);
  out = reference_of(n, scale);
  const Vector way = predicted_way(last, out);
  for (std::size_t i = 0; i < 3; ++i) {
    out.numbers.location[i] = take(in, old.location[i] + nearest(way[i]), code[kLocation]);
  }
  return in.at_end();
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

std::size_t ResidualEncoder::encode(const pdu::EntityState& state,
                                    std::span<std::byte, kMostResidual> out) noexcept {
  if (!has_key_ || !is_ours(state) || !pdu::is_alike(key_, state)) return 0;
  const auto numbers = pdu::numbers_of(state, scale_);
  if (!numbers) return 0;
  const ResidualReference now = reference_of(*numbers, scale_);
  const Widths widths = widths_for(now);
  if (!widths.fit) return 0;

  pdu::BitWriter writer(out);
  const unsigned check = check_of(*numbers, key_hash_);
  writer.put(check, kCheckBits);
  writer.put(numbers->timestamp, pdu::kTimestampBits);
  writer.put(static_cast<unsigned>(numbers->algorithm), kAlgorithmBits);
  for (const unsigned code : widths.code) writer.put(code, kCodeBits);
  put(writer, numbers->orientation, widths.code[kOrientation]);
  writer.put(widths.turning, kAxisBits);
  for (std::size_t i = 0; i < 3; ++i) {
    if ((widths.turning >> i & 1U) == 0) continue;
    writer.put(static_cast<std::uint32_t>(numbers->angular_velocity[i]),
               kWidths[widths.code[kTurnRate]]);
  }
  put(writer, numbers->acceleration, widths.code[kAcceleration]);
  put(writer, numbers->velocity, widths.code[kVelocity]);
  for (const std::int64_t place : numbers->location) {
    writer.put(static_cast<std::uint64_t>(place), kWidths[widths.code[kLocation]]);
  }
  const std::size_t size = writer.finish();

  ResidualReference back;
  unsigned said = 0;
  const bool reads =
      size > 0 && read(out.first(size), numbers->timestamp, scale_, last_, back, said);
  if (!reads || back.numbers != *numbers || said != check) return 0;
  note(now);
  return size;
}

// Half of the window is filled; when it is full it becomes the older half.
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

// Enough for who has any update of the window: exactly so for what is predicted by itself, and
// a quarter more than its ends need for place and velocity.
ResidualEncoder::Widths ResidualEncoder::widths_for(const ResidualReference& now) const noexcept {
  const auto values = turning(now.numbers);
  std::array<std::int64_t, 9> off{};
  for (const Extremes& half : extremes_) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      off[i] = std::max({off[i], std::int64_t{values[i]} - half.least[i],
                         std::int64_t{half.most[i]} - values[i]});
    }
  }
  double velocity = 0.0, way = 0.0;
  for (const ResidualReference* from : {&last_, &first_[0], &first_[1]}) {
    Vector v = predicted_velocity(from->numbers, now.numbers, scale_);
    Vector p = predicted_way(*from, now);
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] -= now.numbers.velocity[i];
      p[i] -= static_cast<double>(now.numbers.location[i] - from->numbers.location[i]);
    }
    velocity = std::max(velocity, farthest(v));
    way = std::max(way, farthest(p));
  }
  const auto most = [&off](std::size_t at) {
    return static_cast<double>(std::max({off[at], off[at + 1], off[at + 2]}));
  };
  Widths widths;
  widths.code[kOrientation] = std::min(code_for(most(0)), 13U);  // a whole turn has 16 bits
  widths.code[kTurnRate] = code_for(most(3));
  for (std::size_t i = 0; i < 3; ++i) widths.turning |= off[3 + i] != 0 ? 1U << i : 0U;
  widths.code[kAcceleration] = code_for(most(6));
  widths.code[kVelocity] = code_for(1.25 * velocity + 1.0);
  widths.code[kLocation] = code_for(1.25 * way + 1.0);
  for (const unsigned code : widths.code) widths.fit = widths.fit && code <= kHighest;
  return widths;
}

// -------------------------------------------------------------------------------------- receiving

void ResidualDecoder::note_plain(const pdu::EntityState& state) noexcept {
  const auto numbers = pdu::numbers_of(state, scale_);
  has_key_ = numbers.has_value();
  if (!has_key_) return;
  key_ = state;
  key_.variable_parameters = {};
  key_hash_ = key_hash_of(key_);
  last_ = reference_of(*numbers, scale_);
}

ResidualVerdict ResidualDecoder::decode(std::span<const std::byte> body, std::uint32_t timestamp,
                                        pdu::EntityState& out) noexcept {
  if (!has_key_) return ResidualVerdict::no_key;
  ResidualReference now;
  unsigned check = 0;
  if (!read(body, timestamp, scale_, last_, now, check)) return ResidualVerdict::malformed;
  if (check != check_of(now.numbers, key_hash_)) return ResidualVerdict::no_key;
  out = key_;
  pdu::set_numbers(now.numbers, scale_, out);
  const bool newer = static_cast<std::int32_t>(now.numbers.timestamp - last_.numbers.timestamp) > 0;
  if (newer) last_ = now;
  return ResidualVerdict::good;
}

}  // namespace reckon::deadreckon
