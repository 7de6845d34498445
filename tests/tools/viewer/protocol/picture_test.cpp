// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/protocol/picture.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace reckon::tools {
namespace {

/// The oracle: the host's own little endian order.
template <typename Value>
Value at(const std::string& octets, std::size_t place) {
  Value value;
  std::memcpy(&value, octets.data() + place, sizeof value);
  return value;
}

PictureRows rows() {
  PictureRows picture;
  picture.time = 12.5;
  picture.flags = kPictureLive | kPictureGap;
  picture.epoch = 7;
  picture.entities.resize(2);
  EntityMark& entity = picture.entities[1];
  entity.slot = 300;
  entity.side = 2;
  entity.cause = UpdateCause::event;
  entity.cell = 11;
  entity.group = 0x0105;
  entity.position = {1.5, -2.5, 3.5};
  entity.orientation = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  entity.error = {0.25F, 0, -0.25F};
  entity.rate = 12.34;
  entity.jump = 0.0123;
  entity.velocity = {0, 13.5F, 0};
  entity.updated = 11.75;
  picture.hands.resize(1);
  picture.hands[0].index = 3;
  picture.hands[0].flags = kHandInContact;
  picture.hands[0].patch = 6;
  picture.hands[0].twin_force = 4.5F;
  picture.contacts.resize(1);
  picture.contacts[0].feeling = 9;
  picture.contacts[0].point = {6.5, 0, 0};
  picture.contacts[0].force = {0, 0, 2};
  picture.tools.resize(1);
  picture.tools[0].hand = 3;
  picture.tools[0].count = 2;
  picture.tools[0].torque = {0, 0.5F, 0};
  picture.tools[0].probes[1] = {7, 8, 9};
  picture.bodies.resize(1);
  picture.bodies[0].position = {0, 0, 6};
  picture.bodies[0].orientation = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  return picture;
}

TEST(Picture, HasTheLengthOfItsCounts) {
  std::string octets;
  encode_picture(rows(), 0, octets);
  EXPECT_EQ(octets.size(), 32U + 2 * 64 + 72 + 40 + 124 + 20);
  encode_picture({}, 0, octets);
  EXPECT_EQ(octets.size(), 32U);
}

TEST(Picture, HasEachThingAtItsPlace) {
  std::string octets;
  encode_picture(rows(), 99, octets);
  EXPECT_EQ(octets.substr(0, 4), "RKV3");
  EXPECT_EQ(at<std::uint32_t>(octets, 4), 99U);
  EXPECT_EQ(at<double>(octets, 8), 12.5);
  EXPECT_EQ(at<std::uint16_t>(octets, 16), 2);
  EXPECT_EQ(at<std::uint16_t>(octets, 18), 1);
  EXPECT_EQ(at<std::uint16_t>(octets, 20), 1);
  EXPECT_EQ(at<std::uint16_t>(octets, 22), 9);
  EXPECT_EQ(at<std::uint32_t>(octets, 24), 7U);
  const std::size_t entity = 32 + 64;
  EXPECT_EQ(at<std::uint16_t>(octets, entity), 300);
  EXPECT_EQ(octets[entity + 2], 2);
  EXPECT_EQ(octets[entity + 3], 4);
  EXPECT_EQ(at<std::uint16_t>(octets, entity + 4), 11);
  EXPECT_EQ(at<std::uint16_t>(octets, entity + 6), 0x0105);
  EXPECT_EQ(at<double>(octets, entity + 16), -2.5);
  EXPECT_EQ(at<std::int16_t>(octets, entity + 32), 16384);
  EXPECT_EQ(at<std::int16_t>(octets, entity + 34), -16384);
  EXPECT_EQ(at<float>(octets, entity + 48), -0.25F);
  EXPECT_EQ(at<std::uint16_t>(octets, entity + 52), 1234);
  EXPECT_EQ(at<std::uint16_t>(octets, entity + 54), 12);
  EXPECT_EQ(at<float>(octets, entity + 56), 13.5F);
  EXPECT_EQ(at<float>(octets, entity + 60), 0.75F);
  const std::size_t hand = 32 + 2 * 64;
  EXPECT_EQ(at<std::uint16_t>(octets, hand), 3);
  EXPECT_EQ(at<std::uint16_t>(octets, hand + 6), 6);
  EXPECT_EQ(at<float>(octets, hand + 68), 4.5F);
  EXPECT_EQ(at<std::uint16_t>(octets, hand + 72 + 2), 9);
  EXPECT_EQ(at<double>(octets, hand + 72 + 4), 6.5);
  EXPECT_EQ(at<float>(octets, hand + 72 + 36), 2.0F);
  EXPECT_EQ(at<std::uint16_t>(octets, 28), 1) << "tools";
  const std::size_t tool = hand + 72 + 40;
  EXPECT_EQ(at<std::uint16_t>(octets, tool), 3);
  EXPECT_EQ(at<std::uint16_t>(octets, tool + 2), 2);
  EXPECT_EQ(at<float>(octets, tool + 20), 0.5F);
  EXPECT_EQ(at<float>(octets, tool + 28 + 12 + 8), 9.0F);
  EXPECT_EQ(at<std::uint16_t>(octets, 30), 1) << "bodies";
  EXPECT_EQ(at<float>(octets, tool + 124 + 8), 6.0F);
  EXPECT_EQ(at<std::int16_t>(octets, tool + 124 + 14), -16384);
}

TEST(Picture, MarksAHandAsItsReadersOwn) {
  const PictureRows picture = rows();
  std::string octets(octets_beside_entities(picture), '\0');
  const auto flags_for = [&](std::uint16_t hand) {
    OctetWriter writer(octets.data());
    write_beside_entities(writer, picture, hand);
    return at<std::uint16_t>(octets, 2);
  };
  EXPECT_EQ(flags_for(2), kHandInContact);
  EXPECT_EQ(flags_for(3), kHandInContact | kHandYours);
}

TEST(Picture, ResolvesMillimetresSixThousandKilometresAway) {
  PictureRows picture = rows();
  const Eigen::Vector3d away(-4'461'603.0, 2'757'549.5, -2'740'670.75);
  std::string before, after;
  picture.entities[0].position = picture.contacts[0].point = away;
  encode_picture(picture, 0, before);
  picture.entities[0].position.y() += 0.001;
  picture.contacts[0].point = picture.entities[0].position;
  encode_picture(picture, 0, after);
  for (const std::size_t place : {32U + 8 + 8, 32U + 2 * 64 + 72 + 4 + 8})
    EXPECT_NEAR(at<double>(after, place) - at<double>(before, place), 0.001, 1e-8) << place;
}

TEST(Picture, ClampsValuesOutOfRange) {
  PictureRows picture = rows();
  picture.entities.resize(1);
  picture.entities[0].jump = 1e9;
  picture.entities[0].rate = std::numeric_limits<double>::quiet_NaN();
  picture.entities[0].orientation.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
  std::string octets;
  encode_picture(picture, 0, octets);
  EXPECT_EQ(at<std::uint16_t>(octets, 32 + 52), 0);
  EXPECT_EQ(at<std::uint16_t>(octets, 32 + 54), 65535);
  EXPECT_EQ(at<std::int16_t>(octets, 32 + 32), 0);
}

}  // namespace
}  // namespace reckon::tools
