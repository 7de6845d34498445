// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A picture of the world at one instant for the page: plain rows, and their encoding.
// docs/viewer_protocol.md defines the layout byte by byte.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tools/listener/update_cause.hpp"
#include "reckon/tools/viewer/protocol/octet_writer.hpp"

namespace reckon::tools {

inline constexpr std::uint32_t kPictureMagic = 0x33564B52;  ///< "RKV3": the version of the layout
inline constexpr std::size_t kPictureHead = 32, kEntityOctets = 64, kHandOctets = 72,
                             kContactOctets = 40, kToolOctets = 28 + 12 * 8, kBodyOctets = 20;
inline constexpr std::uint16_t kNoNumber = 0xFFFF;  ///< no slot, no cell
/// Limit of rows of one kind in a picture; further ones are left out.
inline constexpr std::size_t kMostPictureRows = 0xFFFE;

/// Bits of PictureRows::flags.
enum PictureFlag : std::uint16_t {
  kPictureLive = 1,
  kPicturePaused = 2,
  kPictureEnd = 4,  ///< the capture has ended
  kPictureGap = 8   ///< there is a gap before this picture
};

/// Bits of HandMark::flags.
enum HandFlag : std::uint16_t {
  kHandInContact = 1,
  kHandSoftened = 2,     ///< springs, dampers or the sum are shown softer than asked
  kHandRateLimited = 4,  ///< the force grows slower than asked
  kHandLetGo = 8,        ///< safety cut the force, or the device dropped it
  kHandPointer = 16,     ///< moved by a page
  kHandPointerFree = 32,
  kHandYours = 64,       ///< moved by this page
  kHandTrueForce = 128,  ///< true_force is known
  kHandTwin = 256,       ///< twin_force is known
  kHandStopped = 512     ///< the software stop holds its force at zero
};

/// An entity; positions are east, north, up of the origin [m].
struct EntityMark {
  std::uint16_t slot = kNoNumber;  ///< in the roster
  std::uint8_t side = 0;           ///< DIS force ID
  UpdateCause cause = UpdateCause::none;
  std::uint16_t cell = kNoNumber;
  std::uint16_t group = 0;  ///< low 16 bits of the address of the last update; 0: none
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< predicted
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< body to east, north, up
  Eigen::Vector3f error = Eigen::Vector3f::Zero();                  ///< shown minus predicted
  double rate = 0;                                                  ///< updates a second
  double jump = 0;                                                  ///< of the last update [m]
  Eigen::Vector3f velocity = Eigen::Vector3f::Zero();               ///< predicted [m/s]
  double updated = 0;  ///< time of the last update, since the start of the source [s]
};

/// A hand of this program.
struct HandMark {
  std::uint16_t index = 0;
  std::uint16_t flags = 0;
  std::uint16_t slot = kNoNumber;  ///< of the hand's entity
  std::uint16_t patch = 0;  ///< below its contact point, see DrawnSolid::first_patch; 0: none
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< of the handle
  Eigen::Vector3f contact_point = Eigen::Vector3f::Zero();
  Eigen::Vector3f force = Eigen::Vector3f::Zero();   ///< [N], on the hand
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit; zero if the scene is not touched
  float true_force = 0;                              ///< [N]
  float energy = 0;                                  ///< [J], at the port
  float loan = 0;                                    ///< [J]
  float twin_force = 0;                              ///< [N], without the gate
};

/// The tool of a hand whose device turns.
struct ToolMark {
  static constexpr std::size_t kMost = 8;

  std::uint16_t hand = 0;   ///< index of the hand
  std::uint16_t count = 0;  ///< probes, <= kMost
  Eigen::Vector3f handle = Eigen::Vector3f::Zero();
  Eigen::Vector3f torque = Eigen::Vector3f::Zero();  ///< [N m], about the handle, on the hand
  std::array<Eigen::Vector3f, kMost> probes{};       ///< positions; the rest is zero
};

/// A body of the scene; bodies are in the order of their numbers.
struct BodyMark {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  bool carried = false;  ///< by what is received of its owner; not sent to the page
};

/// A contact between two entities, as a listener computes it.
struct ContactMark {
  std::uint16_t felt = kNoNumber, feeling = kNoNumber;  ///< slots of the owner of the model, and of
                                                        ///< the pushed entity
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3f force = Eigen::Vector3f::Zero();  ///< [N], on `feeling`
};

struct PictureRows {
  double time = 0;  ///< [s] since the start of the source
  std::uint16_t flags = 0;
  std::uint32_t epoch = 0;  ///< of the roster that defines the slots
  std::vector<EntityMark> entities;
  std::vector<HandMark> hands;
  std::vector<ContactMark> contacts;
  std::vector<ToolMark> tools;
  std::vector<BodyMark> bodies;
};

/// Writes a whole picture to `out`, replacing its content.
void encode_picture(const PictureRows& rows, std::uint32_t number, std::string& out);

/// Parts that whole pictures and differences (picture_difference.hpp) share
/// ------------------------------------------------------------------------------------------------

struct PictureHead {
  std::uint32_t magic = kPictureMagic, number = 0;
  std::uint16_t flags = 0;
};
/// Writes kPictureHead octets.
void write_picture_head(OctetWriter& out, const PictureRows& rows, const PictureHead& head);
/// Octets of hands, contacts, tools and bodies.
[[nodiscard]] std::size_t octets_beside_entities(const PictureRows& rows) noexcept;
/// Writes these. @param own_hand gets kHandYours
void write_beside_entities(OctetWriter& out, const PictureRows& rows,
                           std::optional<std::uint16_t> own_hand);

/// Rounded, limited to 0 .. 65535; NaN becomes 0.
[[nodiscard]] std::uint16_t rounded_u16(double value) noexcept;
/// w x y z, each times 32767; NaN becomes 0.
[[nodiscard]] std::array<std::int16_t, 4> quaternion_parts(
    const Eigen::Quaterniond& orientation) noexcept;
/// The number of a cause for the page.
[[nodiscard]] std::uint8_t cause_number(UpdateCause cause) noexcept;

}  // namespace reckon::tools
