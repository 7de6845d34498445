// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/protocol/picture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace reckon::tools {
namespace {

constexpr std::size_t kNumberAt = 4;

/// Writes little endian into preallocated memory.
class Writer {
 public:
  explicit Writer(char* at) : at_(at) {}

  void u8(std::uint8_t value) { *at_++ = static_cast<char>(value); }
  void u16(std::uint16_t value) { put(value, 2); }
  void u32(std::uint32_t value) { put(value, 4); }
  void f32(float value) { u32(std::bit_cast<std::uint32_t>(value)); }
  void f64(double value) { put(std::bit_cast<std::uint64_t>(value), 8); }
  void vector(const Eigen::Vector3f& value) {
    for (const float part : value) f32(part);
  }
  void vector(const Eigen::Vector3d& value) {
    for (const double part : value) f64(part);
  }

 private:
  void put(std::uint64_t value, int octets) {
    for (int i = 0; i < octets; ++i) *at_++ = static_cast<char>(value >> (8 * i) & 0xFFU);
  }
  char* at_;
};

/// Rounded, limited to 0 .. 65535; NaN becomes 0.
std::uint16_t rounded_u16(double value) {
  if (!(value > 0)) return 0;
  return static_cast<std::uint16_t>(std::min(std::round(value), 65535.0));
}

std::uint16_t quaternion_part(double value) {
  const double cut = std::isfinite(value) ? std::clamp(value, -1.0, 1.0) : 0.0;
  return static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(32767 * cut)));
}

// The page has fewer causes: a changed force counts as an event, a repetition as a heartbeat.
std::uint8_t cause_number(UpdateCause cause) {
  switch (cause) {
    case UpdateCause::none:
      return 0;
    case UpdateCause::first:
      return 1;
    case UpdateCause::threshold:
      return 2;
    case UpdateCause::heartbeat:
    case UpdateCause::repeat:
      return 3;
    case UpdateCause::event:
    case UpdateCause::force:
      return 4;
  }
  return 0;
}

void write_entity(Writer& out, const EntityMark& entity) {
  out.u16(entity.slot);
  out.u8(entity.side);
  out.u8(cause_number(entity.cause));
  out.u16(entity.cell);
  out.u16(entity.group);
  out.vector(entity.position);
  const Eigen::Quaterniond& q = entity.orientation;
  for (const double part : {q.w(), q.x(), q.y(), q.z()}) out.u16(quaternion_part(part));
  out.vector(entity.error);
  out.u16(rounded_u16(100 * entity.rate));
  out.u16(rounded_u16(1000 * entity.jump));
  out.f32(entity.speed);
  out.f32(entity.age);
}

void write_hand(Writer& out, const HandMark& hand) {
  out.u16(hand.index);
  out.u16(hand.flags);
  out.u16(hand.slot);
  out.u16(hand.patch);
  out.vector(hand.position);
  out.vector(hand.contact_point);
  out.vector(hand.force);
  out.vector(hand.normal);
  for (const float value : {hand.true_force, hand.energy, hand.loan, hand.twin_force})
    out.f32(value);
}

void write_contact(Writer& out, const ContactMark& contact) {
  out.u16(contact.felt);
  out.u16(contact.feeling);
  out.vector(contact.point);
  out.vector(contact.force);
}

void write_tool(Writer& out, const ToolMark& tool) {
  out.u16(tool.hand);
  out.u16(tool.count);
  out.vector(tool.handle);
  out.vector(tool.torque);
  for (const Eigen::Vector3f& probe : tool.probes) out.vector(probe);
}

void write_body(Writer& out, const BodyMark& body) {
  out.vector(body.position);
  const Eigen::Quaterniond& q = body.orientation;
  for (const double part : {q.w(), q.x(), q.y(), q.z()}) out.u16(quaternion_part(part));
}

}  // namespace

void encode_picture(const PictureRows& rows, std::string& out) {
  const std::size_t entities = std::min(rows.entities.size(), kMostPictureRows);
  const std::size_t hands = std::min(rows.hands.size(), kMostPictureRows);
  const std::size_t contacts = std::min(rows.contacts.size(), kMostPictureRows);
  const std::size_t tools = std::min(rows.tools.size(), kMostPictureRows);
  const std::size_t bodies = std::min(rows.bodies.size(), kMostPictureRows);
  out.resize(kPictureHead + kEntityOctets * entities + kHandOctets * hands +
             kContactOctets * contacts + kToolOctets * tools + kBodyOctets * bodies);
  Writer writer(out.data());
  writer.u32(kPictureMagic);
  writer.u32(0);
  writer.f64(rows.time);
  writer.u16(static_cast<std::uint16_t>(entities));
  writer.u16(static_cast<std::uint16_t>(hands));
  writer.u16(static_cast<std::uint16_t>(contacts));
  writer.u16(rows.flags);
  writer.u32(rows.epoch);
  writer.u16(static_cast<std::uint16_t>(tools));
  writer.u16(static_cast<std::uint16_t>(bodies));
  for (std::size_t i = 0; i < entities; ++i) write_entity(writer, rows.entities[i]);
  for (std::size_t i = 0; i < hands; ++i) write_hand(writer, rows.hands[i]);
  for (std::size_t i = 0; i < contacts; ++i) write_contact(writer, rows.contacts[i]);
  for (std::size_t i = 0; i < tools; ++i) write_tool(writer, rows.tools[i]);
  for (std::size_t i = 0; i < bodies; ++i) write_body(writer, rows.bodies[i]);
}

void number_picture(std::string& octets, std::uint32_t number) {
  Writer(octets.data() + kNumberAt).u32(number);
}

void mark_own_hand(const PictureRows& rows, std::uint16_t index, std::string& octets) {
  constexpr std::size_t kFlagsAt = 2;
  const std::size_t entities = std::min(rows.entities.size(), kMostPictureRows);
  const std::size_t hands = std::min(rows.hands.size(), kMostPictureRows);
  for (std::size_t i = 0; i < hands; ++i) {
    if (rows.hands[i].index != index) continue;
    const std::size_t at = kPictureHead + kEntityOctets * entities + kHandOctets * i + kFlagsAt;
    Writer(octets.data() + at).u16(rows.hands[i].flags | kHandYours);
  }
}

}  // namespace reckon::tools
