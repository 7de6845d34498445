// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/protocol/picture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace reckon::tools {
namespace {

void write_turn(OctetWriter& out, const Eigen::Quaterniond& orientation) {
  for (const std::int16_t part : quaternion_parts(orientation))
    out.u16(static_cast<std::uint16_t>(part));
}

void write_entity(OctetWriter& out, const EntityMark& entity, double time) {
  out.u16(entity.slot);
  out.u8(entity.side);
  out.u8(cause_number(entity.cause));
  out.u16(entity.cell);
  out.u16(entity.group);
  out.vector(entity.position);
  write_turn(out, entity.orientation);
  out.vector(entity.error);
  out.u16(rounded_u16(100 * entity.rate));
  out.u16(rounded_u16(1000 * entity.jump));
  out.f32(entity.velocity.norm());
  out.f32(static_cast<float>(std::max(0.0, time - entity.updated)));
}

void write_hand(OctetWriter& out, const HandMark& hand) {
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

void write_contact(OctetWriter& out, const ContactMark& contact) {
  out.u16(contact.felt);
  out.u16(contact.feeling);
  out.vector(contact.point);
  out.vector(contact.force);
}

void write_tool(OctetWriter& out, const ToolMark& tool) {
  out.u16(tool.hand);
  out.u16(tool.count);
  out.vector(tool.handle);
  out.vector(tool.torque);
  for (const Eigen::Vector3f& probe : tool.probes) out.vector(probe);
}

void write_body(OctetWriter& out, const BodyMark& body) {
  out.vector(body.position);
  write_turn(out, body.orientation);
}

std::size_t shown(const auto& rows) { return std::min(rows.size(), kMostPictureRows); }

}  // namespace

std::uint16_t rounded_u16(double value) noexcept {
  if (!(value > 0)) return 0;
  return static_cast<std::uint16_t>(std::min(std::round(value), 65535.0));
}

std::array<std::int16_t, 4> quaternion_parts(const Eigen::Quaterniond& orientation) noexcept {
  const auto part = [](double value) {
    const double cut = std::isfinite(value) ? std::clamp(value, -1.0, 1.0) : 0.0;
    return static_cast<std::int16_t>(std::lround(32767 * cut));
  };
  return {part(orientation.w()), part(orientation.x()), part(orientation.y()),
          part(orientation.z())};
}

// The page has fewer causes: a changed force counts as an event, a repetition as a heartbeat.
std::uint8_t cause_number(UpdateCause cause) noexcept {
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

void write_picture_head(OctetWriter& out, const PictureRows& rows, const PictureHead& head) {
  out.u32(head.magic);
  out.u32(head.number);
  out.f64(rows.time);
  out.u16(static_cast<std::uint16_t>(shown(rows.entities)));
  out.u16(static_cast<std::uint16_t>(shown(rows.hands)));
  out.u16(static_cast<std::uint16_t>(shown(rows.contacts)));
  out.u16(head.flags);
  out.u32(rows.epoch);
  out.u16(static_cast<std::uint16_t>(shown(rows.tools)));
  out.u16(static_cast<std::uint16_t>(shown(rows.bodies)));
}

std::size_t octets_beside_entities(const PictureRows& rows) noexcept {
  return kHandOctets * shown(rows.hands) + kContactOctets * shown(rows.contacts) +
         kToolOctets * shown(rows.tools) + kBodyOctets * shown(rows.bodies);
}

void write_beside_entities(OctetWriter& out, const PictureRows& rows,
                           std::optional<std::uint16_t> own_hand) {
  for (std::size_t i = 0; i < shown(rows.hands); ++i) {
    HandMark hand = rows.hands[i];
    if (hand.index == own_hand) hand.flags |= kHandYours;
    write_hand(out, hand);
  }
  for (std::size_t i = 0; i < shown(rows.contacts); ++i) write_contact(out, rows.contacts[i]);
  for (std::size_t i = 0; i < shown(rows.tools); ++i) write_tool(out, rows.tools[i]);
  for (std::size_t i = 0; i < shown(rows.bodies); ++i) write_body(out, rows.bodies[i]);
}

void encode_picture(const PictureRows& rows, std::uint32_t number, std::string& out) {
  out.resize(kPictureHead + kEntityOctets * shown(rows.entities) + octets_beside_entities(rows));
  OctetWriter writer(out.data());
  write_picture_head(writer, rows, {kPictureMagic, number, rows.flags});
  for (std::size_t i = 0; i < shown(rows.entities); ++i)
    write_entity(writer, rows.entities[i], rows.time);
  write_beside_entities(writer, rows, std::nullopt);
}

}  // namespace reckon::tools
