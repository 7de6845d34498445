// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/wire_conversion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <vector>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/pdu/codec/codec.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon::wire_conversion_test {
namespace {

using Algorithm = pdu::DeadReckoningAlgorithm;
using Eigen::Vector3d;
using Error = ConversionError;
using test::Random;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

const LocalFrame& monterey() {
  static const LocalFrame frame(0.6388, -2.1276, 20);
  return frame;
}

TEST(EntityConversion, RoundTripsEveryModelOnTheWire) {
  Random random(1);
  for (int code = 0; code <= 9; ++code) {
    const auto algorithm = static_cast<Algorithm>(code);
    for (int i = 0; i < 200; ++i) {
      const KinematicState sent = random.state(algorithm, 1);
      pdu::EntityState pdu;
      ASSERT_EQ(to_wire(sent, monterey(), pdu), Error::none);
      KinematicState got;
      ASSERT_EQ(from_wire(pdu, monterey(), got), Error::none);
      EXPECT_EQ(got.algorithm, algorithm);
      EXPECT_LE((got.position - sent.position).norm(), 5e-9);
      EXPECT_LE((got.velocity - sent.velocity).norm(), 3e-5);
      EXPECT_LE((got.acceleration - sent.acceleration).norm(), 5e-6);
      EXPECT_LE(angle_between(got.orientation, sent.orientation), 5e-7);
      EXPECT_NEAR(got.orientation.norm(), 1, 1e-15);
      const bool turns = drm_terms(algorithm).rotation;
      const Vector3d spin = turns ? sent.angular_velocity : Vector3d(Vector3d::Zero());
      EXPECT_LE((got.angular_velocity - spin).norm(), 2e-7);
    }
  }
}

TEST(EntityConversion, ExtrapolatesAlikeInWorldAndScene) {
  // Extrapolating W states and converting is the same as converting and extrapolating.
  Random random(2);
  for (const Algorithm algorithm :
       {Algorithm::rvw, Algorithm::rvb, Algorithm::fvw, Algorithm::fpb}) {
    pdu::EntityState pdu;
    ASSERT_EQ(to_wire(random.state(algorithm, 1), monterey(), pdu), Error::none);
    KinematicState scene;
    ASSERT_EQ(from_wire(pdu, monterey(), scene), Error::none);
    KinematicState world = scene;
    world.position = {pdu.location.x, pdu.location.y, pdu.location.z};
    world.orientation = monterey().world_from_scene(scene.orientation);
    if (!drm_terms(algorithm).body_axes) {
      world.velocity = monterey().world_from_scene_vector(scene.velocity);
      world.acceleration = monterey().world_from_scene_vector(scene.acceleration);
    }
    const Vector3d a = extrapolate(scene, 3).position;
    const Vector3d b = monterey().scene_from_world(extrapolate(world, 3).position);
    EXPECT_LE((a - b).norm(), 5e-9);
  }
}

TEST(EntityConversion, RoundTripsAVerticalAttitude) {
  // A body whose x axis is the world's -z axis: theta = 90 degrees on the wire.
  KinematicState sent;
  sent.orientation =
      monterey().scene_from_world(quaternion_from_euler({0.7, 1.5707963267948966, -0.2}));
  pdu::EntityState pdu;
  ASSERT_EQ(to_wire(sent, monterey(), pdu), Error::none);
  KinematicState got;
  ASSERT_EQ(from_wire(pdu, monterey(), got), Error::none);
  EXPECT_LE(angle_between(got.orientation, sent.orientation), 3e-7);
}

TEST(EntityConversion, HoldsFrozenAndDeactivatedEntities) {
  for (const std::uint32_t bit : {pdu::kAppearanceFrozen, pdu::kAppearanceDeactivated}) {
    Random random(3);
    pdu::EntityState pdu;
    ASSERT_EQ(to_wire(random.state(Algorithm::rvw, 1), monterey(), pdu), Error::none);
    pdu.appearance = bit;
    KinematicState got;
    ASSERT_EQ(from_wire(pdu, monterey(), got), Error::none);
    EXPECT_EQ(got.algorithm, Algorithm::static_);
  }
}

TEST(EntityConversion, RefusesNonFiniteNumbersAndKeepsTheOutput) {
  Random random(4);
  pdu::EntityState good;
  ASSERT_EQ(to_wire(random.state(Algorithm::rvb, 1), monterey(), good), Error::none);
  const auto refused = [](const pdu::EntityState& pdu) {
    KinematicState out;
    out.position = {1, 2, 3};
    const Error e = from_wire(pdu, monterey(), out);
    EXPECT_EQ(out.position, Vector3d(1, 2, 3));
    return e;
  };
  for (const float bad : {kNan, kInf, -kInf}) {
    for (float pdu::Vector3Float::*axis :
         {&pdu::Vector3Float::x, &pdu::Vector3Float::y, &pdu::Vector3Float::z}) {
      pdu::EntityState v = good, a = good, w = good;
      v.linear_velocity.*axis = bad;
      a.dead_reckoning.linear_acceleration.*axis = bad;
      w.dead_reckoning.angular_velocity.*axis = bad;
      EXPECT_EQ(refused(v), Error::not_finite);
      EXPECT_EQ(refused(a), Error::not_finite);
      EXPECT_EQ(refused(w), Error::not_finite);
    }
    for (double pdu::WorldCoordinates::*axis :
         {&pdu::WorldCoordinates::x, &pdu::WorldCoordinates::y, &pdu::WorldCoordinates::z}) {
      pdu::EntityState p = good;
      p.location.*axis = static_cast<double>(bad);
      EXPECT_EQ(refused(p), Error::not_finite);
    }
    for (float pdu::EulerAngles::*angle :
         {&pdu::EulerAngles::psi, &pdu::EulerAngles::theta, &pdu::EulerAngles::phi}) {
      pdu::EntityState e = good;
      e.orientation.*angle = bad;
      EXPECT_EQ(refused(e), Error::not_finite);
    }
  }
}

TEST(EntityConversion, RefusesAbsurdSizes) {
  pdu::EntityState pdu;
  KinematicState out;
  pdu.location = {1e300, 0, 0};
  EXPECT_EQ(from_wire(pdu, monterey(), out), Error::location_range);
  pdu.location = {6.4e6, 0, 0};
  EXPECT_EQ(from_wire(pdu, monterey(), out), Error::none);
  pdu.linear_velocity.x = 1e7F;
  EXPECT_EQ(from_wire(pdu, monterey(), out), Error::speed_range);
  pdu.linear_velocity.x = 0;
  pdu.dead_reckoning.angular_velocity.z = 1e30F;
  EXPECT_EQ(from_wire(pdu, monterey(), out), Error::speed_range);
  KinematicState broken;
  broken.velocity.x() = kNan;
  EXPECT_EQ(to_wire(broken, monterey(), pdu), Error::not_finite);
}

ForceModel ball() {
  ForceModel m;
  m.kind = pdu::ForceModelKind::sphere;
  m.k1 = 812.5;
  m.k3 = 1e7;
  m.damping = 1.5;
  m.mass = 0.25;
  m.static_friction = 0.5;
  m.kinetic_friction = 0.25;
  m.restitution = 0.75;
  m.radius = 0.0625;
  m.point = {0.5, -0.25, 0.125};
  m.normal = Vector3d(0, 0.6, 0.8);
  m.surface = 77;
  m.validity = 12.0;
  return m;
}

pdu::HapticRecord good_record() {
  pdu::HapticRecord record;
  EXPECT_EQ(to_wire(ball(), record), Error::none);
  return record;
}

TEST(ForceConversion, RoundTripsOnTheWire) {
  const pdu::HapticRecord record = good_record();
  EXPECT_EQ(record.validity_ms, 12000);
  ForceModel got;
  ASSERT_EQ(from_wire(record, got), Error::none);
  const ForceModel sent = ball();
  EXPECT_EQ(got.kind, sent.kind);
  EXPECT_EQ(got.k1, sent.k1);
  EXPECT_EQ(got.k3, sent.k3);
  EXPECT_EQ(got.damping, sent.damping);
  EXPECT_EQ(got.mass, sent.mass);
  EXPECT_EQ(got.static_friction, sent.static_friction);
  EXPECT_EQ(got.kinetic_friction, sent.kinetic_friction);
  EXPECT_EQ(got.restitution, sent.restitution);
  EXPECT_EQ(got.radius, sent.radius);
  EXPECT_EQ(got.point, sent.point);
  EXPECT_LE((got.normal - sent.normal).norm(), 1e-7);
  EXPECT_NEAR(got.normal.norm(), 1, 1e-15);
  EXPECT_EQ(got.surface, 77);
  EXPECT_EQ(got.validity, 12.0);
}

Error error_of(void (*spoil)(pdu::HapticRecord&)) {
  pdu::HapticRecord record = good_record();
  spoil(record);
  ForceModel out;
  out.k1 = 42;
  const Error e = from_wire(record, out);
  EXPECT_EQ(out.k1, e == Error::none ? static_cast<double>(record.k1) : 42);
  return e;
}

TEST(ForceConversion, RefusesEachBrokenFieldWithItsReason) {
  using R = pdu::HapticRecord;
  EXPECT_EQ(error_of([](R& r) { r.k1 = -1; }), Error::negative_stiffness);
  EXPECT_EQ(error_of([](R& r) { r.k3 = -1e-30F; }), Error::negative_stiffness);
  EXPECT_EQ(error_of([](R& r) { r.damping = -0.1F; }), Error::negative_damping);
  EXPECT_EQ(error_of([](R& r) { r.mass = -1; }), Error::negative_mass);
  EXPECT_EQ(error_of([](R& r) { r.k1 = 1e7F; }), Error::stiffness_range);
  EXPECT_EQ(error_of([](R& r) { r.k3 = 1e20F; }), Error::stiffness_range);
  EXPECT_EQ(error_of([](R& r) { r.damping = 1e9F; }), Error::stiffness_range);
  EXPECT_EQ(error_of([](R& r) { r.static_friction = 11; }), Error::friction_range);
  EXPECT_EQ(error_of([](R& r) { r.kinetic_friction = 0.6F; }), Error::friction_range);
  EXPECT_EQ(error_of([](R& r) { r.kinetic_friction = -0.1F; }), Error::friction_range);
  EXPECT_EQ(error_of([](R& r) { r.restitution = 1.5F; }), Error::restitution_range);
  EXPECT_EQ(error_of([](R& r) { r.radius = -0.1F; }), Error::size_range);
  EXPECT_EQ(error_of([](R& r) { r.radius = 1e6F; }), Error::size_range);
  EXPECT_EQ(error_of([](R& r) { r.point.y = 3e38F; }), Error::size_range);
  EXPECT_EQ(error_of([](R& r) { r.normal = {0, 2, 0}; }), Error::normal_not_unit);
  EXPECT_EQ(error_of([](R& r) { r.kind = pdu::ForceModelKind::modal; }), Error::kind_unknown);
  EXPECT_EQ(error_of([](R& r) { r.kind = static_cast<pdu::ForceModelKind>(99); }),
            Error::kind_unknown);
  EXPECT_EQ(error_of([](R& r) { r.order = 2; }), Error::kind_unknown);
}

TEST(ForceConversion, RefusesEveryNumberThatIsNotFinite) {
  using R = pdu::HapticRecord;
  constexpr std::array<float R::*, 8> kNumbers = {
      &R::k1,          &R::k3,     &R::damping,         &R::mass,
      &R::restitution, &R::radius, &R::static_friction, &R::kinetic_friction};
  for (const float bad : {kNan, kInf, -kInf}) {
    for (const auto number : kNumbers) {
      R record = good_record();
      record.*number = bad;
      ForceModel out;
      EXPECT_EQ(from_wire(record, out), Error::not_finite);
    }
    for (const auto member : {&R::point, &R::normal}) {
      R record = good_record();
      (record.*member).y = bad;
      ForceModel out;
      EXPECT_EQ(from_wire(record, out), Error::not_finite);
    }
  }
}

TEST(ForceConversion, NeedsANormalForFlatShapesOnly) {
  pdu::HapticRecord record = good_record();
  record.normal = {0, 0, 0};
  ForceModel out;
  EXPECT_EQ(from_wire(record, out), Error::none);
  EXPECT_NEAR(out.normal.norm(), 1, 1e-15);
  for (const auto kind : {pdu::ForceModelKind::plane, pdu::ForceModelKind::spring_damper_region}) {
    record.kind = kind;
    EXPECT_EQ(from_wire(record, out), Error::normal_not_unit);
  }
}

TEST(ForceConversion, RoundsValidityUpWithinSixteenBits) {
  ForceModel m = ball();
  pdu::HapticRecord record;
  m.validity = 0.0101;
  ASSERT_EQ(to_wire(m, record), Error::none);
  EXPECT_EQ(record.validity_ms, 11);
  m.validity = 1e9;
  ASSERT_EQ(to_wire(m, record), Error::none);
  EXPECT_EQ(record.validity_ms, 65535);
  m.validity = -1;
  ASSERT_EQ(to_wire(m, record), Error::none);
  EXPECT_EQ(record.validity_ms, 0);
}

TEST(ForceConversion, HasASentenceForEveryError) {
  std::set<std::string_view> sentences;
  for (int i = 0; i <= static_cast<int>(Error::size_range); ++i) {
    sentences.insert(sentence(static_cast<Error>(i)));
  }
  EXPECT_EQ(sentences.size(), 13u);
  EXPECT_EQ(sentence(static_cast<Error>(250)), "unknown error");
}

TEST(ForceConversion, AcceptedRandomOctetsGiveAFiniteForce) {
  Random random(5);
  int accepted = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto any = [&] {
      return static_cast<float>(random.real(-1, 1) * std::pow(10.0, random.real(-30, 30)));
    };
    pdu::HapticRecord r = good_record();
    r.kind = static_cast<pdu::ForceModelKind>(i % 6);
    for (float* field : {&r.k1, &r.k3, &r.damping, &r.radius, &r.point.x, &r.point.y}) {
      if (random.real(0, 1) < 0.3) *field = any();
    }
    ForceModel model;
    if (from_wire(r, model) != Error::none) continue;
    ++accepted;
    const Pose entity = random.pose();
    const Vector3d f = evaluate(model, entity, random.vector(2e4), random.vector(1e6), 1);
    ASSERT_TRUE(f.allFinite());
  }
  EXPECT_GT(accepted, 1000);
}

// Entity States of a recorded session, each the first PDU of an Ethernet, IP, UDP packet in a pcap.
std::vector<pdu::EntityState> entity_states(const std::vector<std::byte>& file) {
  std::vector<pdu::EntityState> found;
  const auto octet = [&](std::size_t i) { return std::to_integer<std::size_t>(file[i]); };
  constexpr std::size_t kFileHeader = 24, kPacketHeader = 16, kNetworkHeaders = 42;
  for (std::size_t at = kFileHeader; at + kPacketHeader <= file.size();) {
    const std::size_t length = octet(at + 8) | octet(at + 9) << 8 | octet(at + 10) << 16;
    const std::size_t payload = at + kPacketHeader + kNetworkHeaders;
    at += kPacketHeader + length;
    if (at > file.size() || payload >= at) break;
    pdu::EntityState state;
    const std::span<const std::byte> bytes(file.data() + payload, at - payload);
    if (octet(payload + 2) == 1 && pdu::decode(bytes, state) == pdu::DecodeError::none) {
      found.push_back(state);
    }
  }
  return found;
}

TEST(EntityConversion, TakesEveryEntityStateOfTheRecordedSessions) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  std::size_t total = 0;
  for (const auto& entry : std::filesystem::directory_iterator(reckon::test::reference_data() /
                                                               "dis-captures/real-sessions")) {
    if (entry.path().extension() != ".pcap") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    std::vector<char> chars((std::istreambuf_iterator<char>(in)), {});
    std::vector<std::byte> file(chars.size());
    std::memcpy(file.data(), chars.data(), chars.size());
    for (const pdu::EntityState& received : entity_states(file)) {
      KinematicState state;
      ASSERT_EQ(from_wire(received, monterey(), state), Error::none);
      pdu::EntityState again;
      ASSERT_EQ(to_wire(state, monterey(), again), Error::none);
      EXPECT_NEAR(again.location.x, received.location.x, 1e-8);
      EXPECT_NEAR(again.linear_velocity.y, received.linear_velocity.y, 1e-5);
      EXPECT_NEAR(
          std::remainder(again.orientation.psi - received.orientation.psi, 6.283185307179586), 0,
          1e-6);
      ++total;
    }
  }
  EXPECT_EQ(total, 2132u);
}

}  // namespace
}  // namespace reckon::deadreckon::wire_conversion_test
