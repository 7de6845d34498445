// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/protocol/picture_difference.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <tuple>

#include "reckon/tests/tools/support/picture_reader.hpp"

namespace reckon::tools::picture_difference_test {
namespace {

using reading::PictureReader;
using reading::ReadEntity;

constexpr double kTick = 1.0 / 30;

/// Encodes for one page, and reads as the page does.
class Wire {
 public:
  /// @return the whole picture that the page has
  std::string send(const PictureRows& rows, bool whole = false) {
    steady_entities(rows, steady_);
    octets = encoder_.encode(rows, steady_, {7, std::nullopt, whole}, room_);
    return reader.take(octets);
  }
  PictureReader reader;
  std::string octets;

 private:
  PictureDifference encoder_;
  std::vector<SteadyEntity> steady_;
  std::string room_;
};

EntityMark entity(std::uint16_t slot, const Eigen::Vector3d& position,
                  const Eigen::Vector3f& velocity = Eigen::Vector3f::Zero()) {
  EntityMark mark;
  mark.slot = slot;
  mark.position = position;
  mark.velocity = velocity;
  return mark;
}

Eigen::Vector3d shown(const ReadEntity& read, double quantum) {
  Eigen::Vector3d out;
  for (int k = 0; k < 3; ++k) out[k] = read.position[k] + quantum * read.error[k];
  return out;
}

double angle_between(const Eigen::Quaterniond& truth, const std::int16_t (&turn)[4]) {
  const Eigen::Quaterniond read(turn[0], turn[1], turn[2], turn[3]);
  return truth.angularDistance(read.normalized());
}

/// Entities of a random exercise: they stand, drive, turn, fly, jump, converge, join and leave.
class Crowd {
 public:
  Crowd(std::uint32_t seed, std::uint16_t slots, double where) : random_(seed), where_(where) {
    for (std::uint16_t slot = 0; slot < slots; ++slot) marks_[slot] = fresh(slot);
  }
  PictureRows step(double dt) {
    rows_.time += dt;
    for (auto& [slot, mark] : marks_) move(mark, dt);
    if (draw() < 0.2) {
      const auto slot = static_cast<std::uint16_t>(draw() * 3000);
      if (!marks_.try_emplace(slot, fresh(slot)).second) marks_.erase(slot);
    }
    rows_.entities.clear();
    for (const auto& [slot, mark] : marks_) rows_.entities.push_back(mark);
    return rows_;
  }
  void go_to(double time) { rows_.time = time; }

 private:
  double draw() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  Eigen::Vector3d place() { return Eigen::Vector3d(draw() - 0.5, draw() - 0.5, draw() - 0.5); }
  EntityMark fresh(std::uint16_t slot) {
    EntityMark mark = entity(slot, where_ * place());
    if (draw() < 0.7) mark.velocity = (30 * place()).cast<float>();
    mark.orientation = Eigen::Quaterniond(draw() - 0.5, draw(), draw(), draw()).normalized();
    mark.updated = rows_.time;
    return mark;
  }
  void move(EntityMark& mark, double dt) {
    mark.position += dt * mark.velocity.cast<double>();
    mark.error *= 0.8F;
    if (mark.error.norm() < 1e-4F) mark.error.setZero();
    if (mark.slot % 3 == 0) {  // it turns and accelerates
      mark.velocity += (9 * dt * place()).cast<float>();
      mark.orientation =
          mark.orientation * Eigen::Quaterniond(Eigen::AngleAxisd(dt, Eigen::Vector3d::UnitZ()));
    }
    if (draw() > 0.03) return;
    const Eigen::Vector3d way = (draw() < 0.02 ? where_ : 2.0) * place();  // an update
    mark.position += way;
    mark.error = -way.cast<float>();
    mark.jump = way.norm();
    mark.updated = rows_.time;
    mark.rate = 30 * draw();
    mark.cause = UpdateCause::threshold;
    mark.cell = static_cast<std::uint16_t>(9 * draw());
    mark.group = static_cast<std::uint16_t>(65535 * draw());
    mark.side = static_cast<std::uint8_t>(4 * draw());
  }

  std::mt19937 random_;
  double where_;
  std::map<std::uint16_t, EntityMark> marks_;
  PictureRows rows_;
};

/// Expects what the reader has to be `rows`, within the quantum.
void expect_same(const PictureRows& rows, const PictureReader& reader) {
  const double half = 0.500001 * reader.quantum;
  ASSERT_EQ(reader.entities.size(), rows.entities.size());
  for (const EntityMark& mark : rows.entities) {
    const auto found = reader.entities.find(mark.slot);
    ASSERT_NE(found, reader.entities.end()) << mark.slot;
    const ReadEntity& read = found->second;
    const Eigen::Vector3d predicted(read.position[0], read.position[1], read.position[2]);
    EXPECT_LE((mark.position - predicted).cwiseAbs().maxCoeff(), half) << mark.slot;
    EXPECT_LE((mark.position + mark.error.cast<double>() - shown(read, reader.quantum))
                  .cwiseAbs()
                  .maxCoeff(),
              half)
        << mark.slot;
    if (mark.error.isZero(0)) {
      EXPECT_EQ(Eigen::Vector3d(read.error[0], read.error[1], read.error[2]).norm(), 0)
          << "an end of the convergence; " << mark.slot;
    }
    EXPECT_LE(angle_between(mark.orientation, read.turn), 1e-4) << mark.slot;
    EXPECT_EQ(std::tuple(mark.cell, mark.group, mark.side, cause_number(mark.cause)),
              std::tuple(read.cell, read.group, read.side, read.cause));
    EXPECT_EQ(rounded_u16(1000 * mark.jump), read.jump);
    EXPECT_NEAR(1000 * mark.updated, static_cast<double>(read.updated_ms), 0.51);
    EXPECT_NEAR(100 * mark.rate, read.rate, 0.51 + read.rate / 64.0);
    if (testing::Test::HasFailure()) return;
  }
}

// Three axes of half a quantum are 0.85 mm, and 1e-4 rad move no point of a body of 10 m by more.
TEST(PictureDifference, RestoresRandomMotionWithinTheQuantum) {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    const bool is_fine = seed % 2 == 0;
    Crowd crowd(seed, is_fine ? 300 : 1500, seed < 3 ? 2e3 : 1.27e7);
    Wire wire;
    std::mt19937 random(seed);
    for (int i = 0; i < 300; ++i) {
      const PictureRows rows = crowd.step(kTick * static_cast<double>(random() % 4));
      wire.send(rows, random() % 60 == 0);
      ASSERT_LT(wire.reader.quantum, is_fine ? 1e-5 : 1e-3);
      expect_same(rows, wire.reader);
      if (HasFailure()) return;
    }
  }
}

TEST(PictureDifference, StandingEntitiesCostNothing) {
  PictureRows rows;
  for (std::uint16_t slot = 0; slot < 1000; ++slot)
    rows.entities.push_back(entity(slot, {0.1 * slot, 0.2, 0.3}));
  Wire wire;
  wire.send(rows);
  EXPECT_GT(wire.octets.size(), 10'000U);
  for (int i = 0; i < 100; ++i) {
    rows.time += kTick;
    wire.send(rows);
    EXPECT_EQ(wire.octets.size(), kDifferenceHead);
  }
}

TEST(PictureDifference, UniformMotionIsCorrectedOnceASecond) {
  PictureRows rows;
  for (std::uint16_t slot = 0; slot < 1000; ++slot)
    rows.entities.push_back(entity(slot, {7.7 * slot, 0, 0}, {0.0137F * slot, -3.3F, 0.01F}));
  Wire wire;
  wire.send(rows);
  const std::size_t before = wire.reader.all_records;
  for (int i = 0; i < 300; ++i) {
    rows.time += kTick;
    for (EntityMark& mark : rows.entities) mark.position += kTick * mark.velocity.cast<double>();
    wire.send(rows);
    expect_same(rows, wire.reader);
  }
  EXPECT_LT(wire.reader.all_records - before, 1000U * 2 * 10);
}

TEST(PictureDifference, LatePageBeginsWithAWholePicture) {
  Crowd crowd(1, 50, 2e3);
  Wire early;
  for (int i = 0; i < 50; ++i) early.send(crowd.step(kTick));
  Wire late;
  const PictureRows rows = crowd.step(kTick);
  const std::string read = late.send(rows);
  EXPECT_TRUE(late.reader.was_whole);
  expect_same(rows, late.reader);
  early.send(rows);
  EXPECT_FALSE(early.reader.was_whole);
  EXPECT_EQ(read.size(), kPictureHead + kEntityOctets * rows.entities.size());
}

TEST(PictureDifference, PageWithoutABaseRefusesDifferences) {
  Crowd crowd(1, 5, 2e3);
  Wire wire;
  wire.send(crowd.step(kTick));
  PictureReader other;
  wire.send(crowd.step(kTick));
  EXPECT_THROW(other.take(wire.octets), std::runtime_error);
  wire.send(crowd.step(kTick), true);
  EXPECT_NO_THROW(other.take(wire.octets));
}

TEST(PictureDifference, LeapsInTimeKeepThePicture) {
  Crowd crowd(3, 200, 2e3);
  Wire wire;
  for (const double time : {10.0, 500.0, 20.0, -5.0, 1e6}) {
    crowd.go_to(time);
    for (int i = 0; i < 5; ++i) {
      const PictureRows rows = crowd.step(kTick);
      wire.send(rows);
      expect_same(rows, wire.reader);
    }
  }
}

TEST(PictureDifference, BoundsImpossibleValues) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  PictureRows rows;
  rows.entities = {entity(1, {kNone, 1e300, -1e300}, {3e38F, -3e38F, 0}), entity(65534, {1, 2, 3})};
  rows.entities[0].error = {3e38F, std::numeric_limits<float>::infinity(), 0};
  rows.entities[0].orientation.coeffs().setConstant(kNone);
  rows.entities[0].updated = -1e300;
  Wire wire;
  for (int i = 0; i < 3; ++i, rows.time += 1e9) {
    wire.send(rows);
    EXPECT_LT(wire.octets.size(), kDifferenceHead + 2 * PictureDifference::kLongestRecord);
    const ReadEntity& read = wire.reader.entities.at(1);
    EXPECT_EQ(read.position[0], 0);
    EXPECT_NEAR(read.position[1], 8589934592.0, 1);
    EXPECT_NEAR(wire.reader.entities.at(65534).position[2], 3, 1e-5);
  }
}

TEST(PictureDifference, ReaderFindsPlantedFaults) {
  Crowd crowd(5, 40, 2e3);
  Wire wire;
  std::vector<std::string> messages;
  PictureRows rows;
  for (int i = 0; i < 20; ++i) {
    rows = crowd.step(kTick);
    wire.send(rows);
    messages.push_back(wire.octets);
  }
  const auto holds = [&](const std::vector<std::string>& all) {
    PictureReader reader;
    try {
      for (const std::string& one : all) (void)reader.take(one);
    } catch (const std::exception&) {
      return false;
    }
    double most = 0;
    for (const EntityMark& mark : rows.entities) {
      const auto found = reader.entities.find(mark.slot);
      if (found == reader.entities.end()) return false;
      most = std::max(
          most, (mark.position + mark.error.cast<double>() - shown(found->second, reader.quantum))
                    .norm());
    }
    return most < reader.quantum;
  };
  ASSERT_TRUE(holds(messages));
  for (std::size_t lost = 0; lost < messages.size(); ++lost) {
    auto faulty = messages;
    faulty.erase(faulty.begin() + static_cast<std::ptrdiff_t>(lost));
    EXPECT_FALSE(holds(faulty)) << "without message " << lost;
  }
  std::size_t cuts = 0;
  for (std::size_t size = 0; size < messages[0].size(); size += 7, ++cuts)
    EXPECT_FALSE(holds({messages[0].substr(0, size)})) << size;
  EXPECT_GT(cuts, 100U);
}

// Eight entities by whole numbers alone, so that every host makes the same octets.
PictureRows sample_rows(int picture) {
  PictureRows rows;
  rows.time = 100 + 0.03125 * picture;
  rows.flags = kPictureLive;
  rows.epoch = 5;
  for (std::uint16_t i = 0; i < 8; ++i) {
    if (i == 3 && picture >= 4) continue;  // it leaves
    if (i == 6 && picture < 6) continue;   // it joins
    EntityMark mark = entity(static_cast<std::uint16_t>(i * i * 9),
                             {1000.0 * i + 0.125 * picture * i, -4'461'603.0 - 0.3 * picture, 2});
    mark.velocity = {4.0F * i, -9.6F, 0};
    if (i == 2) mark.position.z() += picture * picture * 0.01;  // it accelerates
    if (i == 4 && picture > 2) mark.error = {0.5F / static_cast<float>(picture), -0.25F, 0};
    if (i == 5 && picture > 7) mark.position.x() += 70'000;  // it jumps
    mark.orientation =
        Eigen::Quaterniond(1, i == 1 ? 0.01 * picture : 0, -0.5, i == 7 ? picture : 0);
    mark.orientation.coeffs() /= std::sqrt(mark.orientation.coeffs().squaredNorm());
    mark.updated = 99.5 + (i == 1 ? 0.5 * (picture / 5) : 0);
    mark.rate = 2 + 0.01 * picture;
    mark.jump = 0.012 * i;
    mark.cause = UpdateCause::heartbeat;
    mark.cell = i;
    mark.side = static_cast<std::uint8_t>(i % 4);
    rows.entities.push_back(mark);
  }
  rows.hands.resize(1);
  rows.hands[0].index = 2;
  rows.bodies.resize(2);
  return rows;
}

std::string hex(std::string_view octets) {
  std::string out;
  for (const char octet : octets) out += fmt::format("{:02x}", static_cast<unsigned char>(octet));
  return out;
}

// The page's reader gives the same whole pictures (page_stream.mjs). To make the file anew: delete
// it, run this test once, and look at what has changed.
TEST(PictureDifference, KeepsTheSampleOfThePage) {
  Wire wire;
  std::string made;
  for (int picture = 0; picture < 12; ++picture) {
    const PictureRows rows = sample_rows(picture);
    const std::string whole = wire.send(rows, picture == 10);
    expect_same(rows, wire.reader);
    made += fmt::format("{}\n{}\n", hex(wire.octets), hex(whole));
  }
  const std::string path = RECKON_SOURCE_DIR "/tests/tools/viewer/page/stream_sample.txt";
  if (!std::ifstream(path)) std::ofstream(path) << made;
  std::ostringstream kept;
  kept << std::ifstream(path).rdbuf();
  EXPECT_EQ(kept.str(), made);
}

}  // namespace
}  // namespace reckon::tools::picture_difference_test
