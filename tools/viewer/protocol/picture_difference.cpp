// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/protocol/picture_difference.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reckon::tools {
namespace {

/// Farthest shown position, each way [m], so that whole quanta fit into a double.
constexpr double kFarthest = 8589934592.0;
/// Largest velocity, each way [m/s]; a faster entity is corrected in each picture.
constexpr double kFastest = 1e6;
/// Over a longer time [s] entities are not moved on by their velocities.
constexpr double kLongestStep = 10;
/// Ratio of half a quantum that counts as equal: rounding of a correction.
constexpr double kRounding = 1 + 1e-6;

/// Bits of a record's second octet.
enum RecordPart : std::uint8_t { kLeft = 1, kUpdate = 2, kPlace = 4, kRate = 8 };

double limited(double value, double most) {
  return std::isfinite(value) ? std::clamp(value, -most, most) : 0.0;
}

double rounded(double value) { return std::floor(value + 0.5); }

std::array<double, 3> limited(const auto& vector, double most) {
  return {limited(static_cast<double>(vector.x()), most),
          limited(static_cast<double>(vector.y()), most),
          limited(static_cast<double>(vector.z()), most)};
}

std::int64_t whole_milliseconds(double seconds) {
  constexpr double kMost = 1e12;
  return static_cast<std::int64_t>(rounded(limited(1000 * seconds, kMost)));
}

}  // namespace

void steady_entities(const PictureRows& rows, std::vector<SteadyEntity>& out) {
  out.resize(std::min(rows.entities.size(), kMostPictureRows));
  for (std::size_t i = 0; i < out.size(); ++i) {
    const EntityMark& mark = rows.entities[i];
    SteadyEntity& entity = out[i];
    entity.position = limited(mark.position, kFarthest);
    entity.is_right = mark.error.isZero(0);
    entity.shown = limited(mark.position + mark.error.cast<double>(), kFarthest);
    entity.velocity = limited(mark.velocity, kFastest);
    entity.turn = quaternion_parts(mark.orientation);
    entity.updated_ms = whole_milliseconds(mark.updated);
    entity.rate = rounded_u16(100 * mark.rate);
    entity.jump = rounded_u16(1000 * mark.jump);
    entity.cell = mark.cell;
    entity.group = mark.group;
    entity.slot = mark.slot;
    entity.side = mark.side;
    entity.cause = cause_number(mark.cause);
  }
}

/// The record of an entity: finds what differs and brings `known` up to date.
class PictureDifference::Record {
 public:
  Record(const PictureDifference& stream, const SteadyEntity& mark, Known& known)
      : quantum_(stream.quantum_), half_(0.5 * kRounding * quantum_), known_(known) {
    find_motion(mark);
    find_turn(mark);
    find_rest(mark);
  }
  [[nodiscard]] bool is_empty() const { return codes_ == 0 && rest_ == 0; }
  [[nodiscard]] bool has_rest() const { return rest_ != 0; }

  /// Writes what follows the number of the slot.
  void write(OctetWriter& out) const {
    out.u8(codes_);
    if (rest_ != 0) out.u8(rest_);
    for (int k = 0; k < 3; ++k)
      write_triple(out, codes_ >> (2 * k) & 3U, changes_[static_cast<std::size_t>(k)]);
    write_turn(out);
    if ((rest_ & kUpdate) != 0) {
      out.u8(known_.cause);
      out.varint(known_.jump);
      out.zigzag(update_change_);
    }
    if ((rest_ & kPlace) != 0) {
      out.u8(known_.side);
      out.u16(known_.cell);
      out.u16(known_.group);
    }
    if ((rest_ & kRate) != 0) out.varint(known_.rate);
  }

 private:
  using Change = std::array<std::int64_t, 3>;

  /// The code of a change: 0 none, 1 five bits each, 2 ten bits each, 3 varints.
  static unsigned code_of(const Change& change) {
    std::int64_t most = 0;
    for (const std::int64_t part : change) most = std::max(most, part < 0 ? ~part : part);
    if (most == 0 && change == Change{}) return 0;
    return most < 16 ? 1 : most < 512 ? 2 : 3;
  }
  static void write_triple(OctetWriter& out, unsigned code, const Change& change) {
    const auto packed = [&change](unsigned bits) {
      std::uint32_t all = 0;
      for (std::size_t k = 0; k < 3; ++k)
        all |= (static_cast<std::uint32_t>(change[k]) & ((1U << bits) - 1)) << (bits * k);
      return all;
    };
    if (code == 1) out.u16(static_cast<std::uint16_t>(packed(5)));
    if (code == 2) out.u32(packed(10));
    if (code == 3)
      for (const std::int64_t part : change) out.zigzag(part);
  }
  void set(std::size_t which, const Change& change) {
    changes_[which] = change;
    codes_ = static_cast<std::uint8_t>(codes_ | code_of(change) << (2 * which));
  }

  // Position and velocity change together; then the error, so that the shown position is right.
  void find_motion(const SteadyEntity& mark) {
    bool is_off = false, is_off_shown = false;
    for (std::size_t k = 0; k < 3; ++k)
      is_off |= std::abs(mark.position[k] - known_.position[k]) > half_;
    if (is_off) correct(mark);
    for (std::size_t k = 0; k < 3; ++k) {
      const double have = known_.position[k] + quantum_ * known_.error[k];
      is_off_shown |= std::abs(mark.shown[k] - have) > half_;
    }
    const bool ends = mark.is_right && known_.error != Triple{};
    if (is_off_shown || ends) correct_error(mark.shown, ends);
  }
  void correct(const SteadyEntity& mark) {
    Change moved{}, faster{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double quanta = rounded((mark.position[k] - known_.position[k]) / quantum_);
      known_.position[k] += quantum_ * quanta;
      moved[k] = static_cast<std::int64_t>(quanta);
      const double units = rounded(mark.velocity[k] / (kVelocityQuanta * quantum_));
      faster[k] = static_cast<std::int64_t>(units - known_.velocity[k]);
      known_.velocity[k] = units;
    }
    set(0, moved);
    set(1, faster);
  }
  void correct_error(const Triple& shown, bool ends) {
    Change change{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double error = ends ? 0 : rounded((shown[k] - known_.position[k]) / quantum_);
      change[k] = static_cast<std::int64_t>(error - known_.error[k]);
      known_.error[k] = error;
    }
    set(2, change);
  }

  // Of the two quaternions of a turn, the nearer one to the known one.
  void find_turn(const SteadyEntity& mark) {
    if (mark.turn == known_.turn) return;
    std::array<std::int16_t, 4> turn = mark.turn;
    std::int64_t dot = 0;
    for (std::size_t k = 0; k < 4; ++k) dot += std::int64_t{turn[k]} * known_.turn[k];
    if (dot < 0)
      for (std::int16_t& part : turn) part = static_cast<std::int16_t>(-part);
    if (turn == known_.turn) return;
    bool is_small = true;
    for (std::size_t k = 0; k < 4; ++k) {
      const int change = turn[k] - known_.turn[k];
      is_small &= change >= -128 && change < 128;
      turn_change_[k] = static_cast<std::uint8_t>(change);
    }
    known_.turn = turn;
    codes_ = static_cast<std::uint8_t>(codes_ | (is_small ? 1U : 2U) << 6);
  }
  void write_turn(OctetWriter& out) const {
    if (codes_ >> 6 == 1)
      for (const std::uint8_t part : turn_change_) out.u8(part);
    if (codes_ >> 6 == 2)
      for (const std::int16_t part : known_.turn) out.u16(static_cast<std::uint16_t>(part));
  }

  void find_rest(const SteadyEntity& mark) {
    if (mark.cause != known_.cause || mark.jump != known_.jump ||
        mark.updated_ms != known_.updated_ms) {
      known_.cause = mark.cause;
      known_.jump = mark.jump;
      update_change_ = mark.updated_ms - std::exchange(known_.updated_ms, mark.updated_ms);
      rest_ |= kUpdate;
    }
    if (mark.side != known_.side || mark.cell != known_.cell || mark.group != known_.group) {
      known_.side = mark.side;
      known_.cell = mark.cell;
      known_.group = mark.group;
      rest_ |= kPlace;
    }
    const int change = std::abs(mark.rate - known_.rate);
    if (change == 0 || (mark.rate != 0 && change * kRateParts <= known_.rate)) return;
    known_.rate = mark.rate;
    rest_ |= kRate;
  }

  double quantum_, half_;
  Known& known_;
  std::array<Change, 3> changes_{};  // position, velocity, error
  std::array<std::uint8_t, 4> turn_change_{};
  std::int64_t update_change_ = 0;
  std::uint8_t codes_ = 0, rest_ = 0;
};

void PictureDifference::begin(double time, std::span<const SteadyEntity> entities, bool whole) {
  if (whole) {
    for (const std::uint16_t slot : shown_) known_[slot] = {};
    shown_.clear();
    exponent_ = entities.size() <= kFineEntities ? kFine : kCoarse;
    quantum_ = std::ldexp(1.0, -exponent_);
    time_ = time;
  }
  step_ = kVelocityQuanta * quantum_ * (time - std::exchange(time_, time));
  if (!entities.empty() && entities.back().slot >= known_.size())
    known_.resize(entities.back().slot + std::size_t{1});
}

void PictureDifference::write_records(std::span<const SteadyEntity> entities, OctetWriter& out) {
  std::uint32_t next = 0;  // slot after the one of the last record
  records_ = 0;
  const auto number = [&](std::uint16_t slot, bool has_rest) {
    out.varint((slot - next) << 1 | (has_rest ? 1U : 0U));
    next = slot + 1U;
    ++records_;
  };
  auto leave_before = [&, old = shown_.begin()](std::uint32_t slot) mutable {
    for (; old != shown_.end() && *old < slot; ++old) {
      known_[*old] = {};
      number(*old, true);
      out.u8(0);
      out.u8(kLeft);
    }
    if (old != shown_.end() && *old == slot) ++old;
  };
  for (const SteadyEntity& mark : entities) {
    leave_before(mark.slot);
    Known& known = known_[mark.slot];
    for (std::size_t k = 0; k < 3; ++k) known.position[k] += step_ * known.velocity[k];
    const Record record(*this, mark, known);
    if (std::exchange(known.is_shown, true) && record.is_empty()) continue;
    number(mark.slot, record.has_rest());
    record.write(out);
  }
  leave_before(kNoNumber);
}

std::string_view PictureDifference::encode(const PictureRows& rows,
                                           std::span<const SteadyEntity> entities,
                                           const Options& options, std::string& room) {
  const bool is_late = std::abs(rows.time - time_) > kLongestStep;
  const bool whole = options.whole || quantum_ == 0 || is_late;
  const std::size_t most = kDifferenceHead + octets_beside_entities(rows) +
                           kLongestRecord * (entities.size() + shown_.size());
  if (room.size() < most) room.resize(most);
  begin(rows.time, entities, whole);
  OctetWriter out(room.data());
  const unsigned flags = rows.flags | (whole ? kDifferenceWhole : 0U);
  write_picture_head(out, rows,
                     {kDifferenceMagic, options.number, static_cast<std::uint16_t>(flags)});
  OctetWriter rest = out;
  out.u32(0);
  write_beside_entities(out, rows, options.own_hand);
  write_records(entities, out);
  rest.u16(records_);
  rest.u8(static_cast<std::uint8_t>(exponent_));
  shown_.resize(entities.size());
  std::ranges::transform(entities, shown_.begin(), &SteadyEntity::slot);
  return {room.data(), static_cast<std::size_t>(out.at() - room.data())};
}

}  // namespace reckon::tools
