// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads pictures as a page does, by docs/viewer_protocol.md alone: differences in, whole pictures
// out.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "reckon/tools/viewer/protocol/picture.hpp"

namespace reckon::tools::reading {

/// Octets in order. @throws std::out_of_range behind the end
class Octets {
 public:
  explicit Octets(std::string_view all) : all_(all) {}

  template <typename Value>
  Value take() {
    Value value;
    if (at_ + sizeof value > all_.size()) throw std::out_of_range("a picture is cut");
    std::memcpy(&value, all_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const auto octet = take<std::uint8_t>();
      value |= std::uint64_t{octet & 0x7FU} << shift;
      if ((octet & 0x80U) == 0) return value;
    }
  }
  std::int64_t zigzag() {
    const std::uint64_t value = varint();
    return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
  }
  std::string_view take(std::size_t count) {
    if (at_ + count > all_.size()) throw std::out_of_range("a picture is cut");
    at_ += count;
    return all_.substr(at_ - count, count);
  }
  [[nodiscard]] bool is_over() const { return at_ == all_.size(); }

 private:
  std::string_view all_;
  std::size_t at_ = 0;
};

/// An entity as a page has it.
struct ReadEntity {
  double position[3]{}, velocity[3]{}, error[3]{};
  std::int16_t turn[4]{};
  std::int64_t updated_ms = 0;
  std::uint16_t cell = 0, group = 0, rate = 0, jump = 0;
  std::uint8_t side = 0, cause = 0;
};

/// The pictures of one connection.
class PictureReader {
 public:
  /// @return the whole picture (kPictureMagic). @throws std::runtime_error if the layout is broken
  std::string take(std::string_view octets) {
    Octets in(octets);
    std::string head(in.take(kPictureHead));
    const auto at = [&head](std::size_t place) {
      std::uint16_t value;
      std::memcpy(&value, head.data() + place, sizeof value);
      return value;
    };
    if (!head.starts_with("RKV4")) throw std::runtime_error("another version");
    head[3] = '3';
    const auto records = in.take<std::uint16_t>();
    const auto exponent = in.take<std::uint8_t>();
    if (in.take<std::uint8_t>() != 0) throw std::runtime_error("an octet that should be 0");
    begin(head, at(22), exponent);
    const std::uint16_t flags = at(22) & 15U;
    std::memcpy(head.data() + 22, &flags, sizeof flags);
    const std::string_view beside = in.take(kHandOctets * at(18) + kContactOctets * at(20) +
                                            kToolOctets * at(28) + kBodyOctets * at(30));
    std::uint64_t next = 0;
    for (std::uint16_t i = 0; i < records; ++i) take_record(in, next);
    if (!in.is_over() || entities.size() != at(16)) throw std::runtime_error("its counts");
    std::string whole = head;
    for (const auto& [slot, entity] : entities) append(whole, slot, entity);
    return whole.append(beside);
  }

  std::map<std::uint16_t, ReadEntity> entities;  ///< by slot
  double quantum = 0;                            ///< [m]
  bool was_whole = false;                        ///< the last picture
  std::size_t all_records = 0;                   ///< of all pictures

 private:
  void begin(const std::string& head, std::uint16_t flags, std::uint8_t exponent) {
    double time;
    std::memcpy(&time, head.data() + 8, sizeof time);
    was_whole = (flags & 16U) != 0;
    if (was_whole) entities.clear();
    if (!was_whole && quantum == 0) throw std::runtime_error("no whole picture before it");
    quantum = std::ldexp(1.0, -exponent);
    const double step = 0.5 * quantum * (was_whole ? 0.0 : time - time_);
    time_ = time;
    for (auto& [slot, entity] : entities)
      for (int k = 0; k < 3; ++k) entity.position[k] += step * entity.velocity[k];
  }

  static void take_triple(Octets& in, unsigned code, double scale, double (&out)[3]) {
    const auto parts = [&](std::uint32_t all, unsigned bits) {
      for (unsigned k = 0; k < 3; ++k) {
        const auto part = static_cast<int>(all >> (bits * k) & ((1U << bits) - 1));
        out[k] += scale * (part >= 1 << (bits - 1) ? part - (1 << bits) : part);
      }
    };
    if (code == 1) parts(in.take<std::uint16_t>(), 5);
    if (code == 2) parts(in.take<std::uint32_t>(), 10);
    if (code == 3)
      for (double& part : out) part += scale * static_cast<double>(in.zigzag());
  }

  void take_record(Octets& in, std::uint64_t& next) {
    const std::uint64_t number = in.varint();
    const std::uint64_t slot = next + (number >> 1);
    next = slot + 1;
    if (slot >= kNoNumber) throw std::runtime_error("a slot");
    ++all_records;
    const auto codes = in.take<std::uint8_t>();
    const unsigned rest = (number & 1) != 0 ? in.take<std::uint8_t>() : 0U;
    if ((rest & 1U) != 0) return void(entities.erase(static_cast<std::uint16_t>(slot)));
    ReadEntity& entity = entities[static_cast<std::uint16_t>(slot)];
    take_triple(in, codes & 3U, quantum, entity.position);
    take_triple(in, codes >> 2 & 3U, 1, entity.velocity);
    take_triple(in, codes >> 4 & 3U, 1, entity.error);
    for (std::int16_t& part : entity.turn) {
      if (codes >> 6 == 1) part = static_cast<std::int16_t>(part + in.take<std::int8_t>());
      if (codes >> 6 == 2) part = in.take<std::int16_t>();
    }
    if ((rest & 2U) != 0) {
      entity.cause = in.take<std::uint8_t>();
      entity.jump = static_cast<std::uint16_t>(in.varint());
      entity.updated_ms += in.zigzag();
    }
    if ((rest & 4U) != 0) {
      entity.side = in.take<std::uint8_t>();
      entity.cell = in.take<std::uint16_t>();
      entity.group = in.take<std::uint16_t>();
    }
    if ((rest & 8U) != 0) entity.rate = static_cast<std::uint16_t>(in.varint());
  }

  void append(std::string& out, std::uint16_t slot, const ReadEntity& entity) const {
    const auto put = [&out](const auto value) {
      out.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    put(slot);
    put(entity.side);
    put(entity.cause);
    put(entity.cell);
    put(entity.group);
    for (const double part : entity.position) put(part);
    for (const std::int16_t part : entity.turn) put(part);
    for (const double part : entity.error) put(static_cast<float>(quantum * part));
    put(entity.rate);
    put(entity.jump);
    const double* v = entity.velocity;
    put(static_cast<float>(0.5 * quantum * std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])));
    put(static_cast<float>(std::max(0.0, time_ - 1e-3 * static_cast<double>(entity.updated_ms))));
  }

  double time_ = 0;
};

}  // namespace reckon::tools::reading
