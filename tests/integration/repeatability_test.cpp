// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The same seed and the same arrivals give the same bits: every servo step and every datagram.
#include <gtest/gtest.h>

#include <cstring>

#include "reckon/tests/support/in_process.hpp"
#include "reckon/tools/exercise/exercise.hpp"

namespace reckon::test {
namespace {

// FNV-1a over the bits added.
class Hash {
 public:
  void add(const void* octets, std::size_t count) {
    const auto* at = static_cast<const unsigned char*>(octets);
    for (std::size_t i = 0; i < count; ++i) value_ = (value_ ^ at[i]) * 1099511628211ULL;
  }
  void add(double value) { add(&value, sizeof value); }
  void add(std::uint64_t value) { add(&value, sizeof value); }
  void add(const Eigen::Vector3d& v) { add(v.data(), sizeof(double) * 3); }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

void add(Hash& hash, const haptics::ServoSnapshot& step) {
  hash.add(static_cast<std::uint64_t>(step.time.count()));
  for (const auto& vector : {step.device, step.scp, step.velocity, step.acceleration, step.force}) {
    hash.add(vector);
  }
  hash.add(step.port_energy);
  hash.add(step.mesh_ledger);
  for (std::size_t i = 0; i < step.count; ++i) {
    const haptics::ContactAccount& contact = step.contacts[i];
    for (const double value : {contact.given, contact.received, contact.need, contact.ledger}) {
      hash.add(value);
    }
    hash.add(contact.force);
  }
}

peer::ImpairmentLaw bad_network() {
  peer::ImpairmentLaw law;
  law.delay = milliseconds(80);
  law.jitter = milliseconds(40);
  law.loss = 0.1;
  law.reorder = law.duplicate = 0.1;
  return law;
}

std::uint64_t servo_trace(peer::SceneFile scene, std::uint64_t seed) {
  scene.impairment.law = bad_network();
  scene.impairment.seed = seed;
  tools::ExerciseOptions options;
  options.simulated_time = true;
  options.epoch = 7;
  tools::Exercise exercise(scene, options);
  Hash hash;
  exercise.on_step([&](std::size_t peer, std::size_t, const haptics::ServoSnapshot& step) {
    hash.add(static_cast<std::uint64_t>(peer));
    add(hash, step);
  });
  exercise.run(seconds(20));
  for (const std::string_view counter : {"datagrams_out", "octets_out", "updates_in"}) {
    hash.add(exercise.total(counter));
  }
  return hash.value();
}

std::uint64_t wire_trace(const peer::SceneFile& scene, std::uint64_t seed) {
  InProcess world(3, seed);
  world.network().impair(bad_network());
  world.listen(scene);
  for (std::size_t link : {0u, 1u, 2u}) world.start(link, scene);
  world.run(10'000);
  world.stop(1);
  world.run(1000);
  Hash hash;
  for (const Heard& datagram : world.heard()) {
    hash.add(static_cast<std::uint64_t>(datagram.time.count()));
    hash.add(datagram.octets.data(), datagram.octets.size());
  }
  EXPECT_GT(world.heard().size(), 50u);
  return hash.value();
}

TEST(Repeatability, SameSeedGivesIdenticalServoSteps) {
  const std::uint64_t once = servo_trace(scene_of(kTwoHandsOnAWall), 3);
  EXPECT_EQ(servo_trace(scene_of(kTwoHandsOnAWall), 3), once);
  EXPECT_NE(servo_trace(scene_of(kTwoHandsOnAWall), 4), once);
}

TEST(Repeatability, TheShippedSceneRepeatsToTheBit) {
  EXPECT_EQ(servo_trace(shipped_scene(), 3), servo_trace(shipped_scene(), 3));
}

TEST(Repeatability, SameSeedGivesIdenticalDatagrams) {
  const peer::SceneFile scene = scene_of(kTwoHandsOnAWall);
  const std::uint64_t once = wire_trace(scene, 3);
  EXPECT_EQ(wire_trace(scene, 3), once);
  EXPECT_NE(wire_trace(scene, 4), once);
}

}  // namespace
}  // namespace reckon::test
