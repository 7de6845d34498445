// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Tracks from CSV tables and captures: every format, missing columns, and hostile files.
#include "reckon/bench/studies/tracks/track_file.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "reckon/bench/studies/tracks/track_builder.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/tools/support/capture_verbs.hpp"

namespace reckon::bench::track_file_test {
namespace {

using deadreckon::MotionSample;
using Eigen::Vector3d;
using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180;

class TrackFileTest : public testing::Test {
 protected:
  TrackFile read(const std::string& text) { return read_track_file(write(text)); }
  std::string error_of(const std::string& text) {
    const std::string path = write(text);
    try {
      (void)read_track_file(path);
    } catch (const std::runtime_error& error) {
      return std::string(error.what()).substr(error.what() == path ? 0 : path.size());
    }
    return "nothing was wrong";
  }
  std::string write(const std::string& text) {
    const std::string path = folder_.file("tracks.csv");
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  test::ScratchFolder folder_;
};

using TrackTable = TrackFileTest;
using TrackCapture = TrackFileTest;

TEST_F(TrackTable, ReadsColumnsInAnyOrderAndIgnoresOthers) {
  const TrackFile file = read("y_m,colour,t_s,id,x_m\n2,red,0,a,1\n4,blue,1,a,3\n");
  ASSERT_EQ(file.tracks.size(), 1U);
  EXPECT_EQ(file.tracks[0].name, "a");
  ASSERT_EQ(file.tracks[0].samples.size(), 2U);
  EXPECT_EQ(file.tracks[0].samples[1].position, Vector3d(3, 4, 0));
  EXPECT_FALSE(file.has_orientation);
  EXPECT_EQ(file.note, "");
}

TEST_F(TrackTable, MakesRatesFromEarlierSamplesOnly) {
  // x = t^2 sampled each second: each velocity is the mean of the second before.
  const TrackFile file = read("t_s,x_m,y_m\n0,0,0\n1,1,0\n2,4,0\n3,9,0\n");
  const auto& samples = file.tracks[0].samples;
  EXPECT_EQ(samples[0].velocity, Vector3d::Zero());
  EXPECT_EQ(samples[2].velocity, Vector3d(3, 0, 0));
  EXPECT_EQ(samples[3].velocity, Vector3d(5, 0, 0));
  EXPECT_EQ(samples[3].acceleration, Vector3d(2, 0, 0));
  // Samples before the end must not change with the future.
  const TrackFile other = read("t_s,x_m,y_m\n0,0,0\n1,1,0\n2,4,0\n3,-50,7\n");
  EXPECT_EQ(other.tracks[0].samples[2].velocity, samples[2].velocity);
  EXPECT_EQ(other.tracks[0].samples[2].acceleration, samples[2].acceleration);
}

TEST_F(TrackTable, TakesGivenVelocitiesAndFillsEmptyCells) {
  const TrackFile file = read("t_s,x_m,y_m,vx_mps,vy_mps\n0,0,0,5,6\n1,10,0,,\n2,20,0,7,8\n");
  const auto& samples = file.tracks[0].samples;
  EXPECT_EQ(samples[0].velocity, Vector3d(5, 6, 0));
  EXPECT_EQ(samples[1].velocity, Vector3d(10, 0, 0));
  EXPECT_EQ(samples[2].velocity, Vector3d(7, 8, 0));
}

TEST_F(TrackTable, TurnsHeadingAndSpeedIntoVelocityAndOrientation) {
  const TrackFile file = read("t_s,x_m,y_m,heading_rad,speed_mps\n0,0,0,1.0,10\n2,0,0,1.5,10\n");
  const MotionSample& second = file.tracks[0].samples[1];
  EXPECT_TRUE(file.has_orientation);
  EXPECT_NEAR(second.velocity.x(), 10 * std::cos(1.5), 1e-12);
  EXPECT_NEAR(second.velocity.y(), 10 * std::sin(1.5), 1e-12);
  EXPECT_NEAR((second.orientation * Vector3d::UnitX()).y(), std::sin(1.5), 1e-12);
  EXPECT_NEAR(second.angular_velocity.z(), 0.25, 1e-12);
}

TEST_F(TrackTable, LooksAlongTheVelocityWithoutAnOrientation) {
  const TrackFile file = read("t_s,x_m,y_m,z_m\n0,0,0,0\n1,0,3,4\n2,0,3,4\n");
  const auto& samples = file.tracks[0].samples;
  const Vector3d forward = samples[1].orientation * Vector3d::UnitX();
  EXPECT_NEAR((forward - Vector3d(0, 0.6, 0.8)).norm(), 0, 1e-12);
  // At rest the orientation stays.
  EXPECT_TRUE(samples[2].orientation.isApprox(samples[1].orientation));
}

TEST_F(TrackTable, ReadsEulerAnglesAndQuaternionsAlike) {
  // Each moves in another direction than its orientation.
  const TrackFile euler =
      read("t_s,px_m,py_m,pz_m,psi_rad,theta_rad,phi_rad\n0,1,2,3,0,0,0\n1,1,2,9,0.3,0.2,0.1\n");
  const auto q = deadreckon::quaternion_from_euler({0.3, 0.2, 0.1});
  EXPECT_NEAR(euler.tracks[0].samples[1].orientation.angularDistance(q), 0, 1e-12);
  const TrackFile quaternion =
      read("t_s,px_m,py_m,pz_m,qx,qy,qz,qw\n0,1,2,3,0,0,0,1\n1,1,2,9,0.6,0,0,0.8\n");
  EXPECT_NEAR(quaternion.tracks[0].samples[1].orientation.w(), 0.8, 1e-12);
  EXPECT_NEAR(quaternion.tracks[0].samples[1].angular_velocity.x(), 2 * std::acos(0.8), 1e-12);
  EXPECT_THAT(error_of("t_s,x_m,y_m,qw,qx,qy,qz\n0,0,0,2,0,0,0\n"), HasSubstr("length 2"));
}

TEST_F(TrackTable, PutsGeodeticPositionsIntoOneCartesianFrame) {
  // A degree of latitude at the equator is 110,574 m along the meridian; the chord differs by 1 m.
  const TrackFile file = read("t_s,lat_deg,lon_deg,sog_kn,cog_deg\n0,0,0,10,0\n100,1,0,10,0\n");
  const auto& samples = file.tracks[0].samples;
  EXPECT_NEAR(samples[1].position.norm(), 110574.3, 2.0);
  EXPECT_NEAR(samples[0].velocity.y(), 10 * 1852.0 / 3600, 1e-9);
  // North at the second place is not north at the first, but the speed is equal.
  EXPECT_NEAR(samples[1].velocity.norm(), samples[0].velocity.norm(), 1e-9);
  EXPECT_LT(samples[1].velocity.z(), -0.05);
}

TEST_F(TrackTable, KeepsDistancesFarFromTheFirstPosition) {
  const TrackFile file = read("t_s,id,lat_deg,lon_deg\n0,a,50,0\n0,b,-45,120\n60,b,-45,120.001\n");
  const auto& samples = file.tracks[1].samples;
  const Vector3d here = deadreckon::geocentric_position(-45 * kDegree, 120 * kDegree, 0);
  const Vector3d there = deadreckon::geocentric_position(-45 * kDegree, 120.001 * kDegree, 0);
  EXPECT_NEAR((samples[1].position - samples[0].position).norm(), (there - here).norm(), 1e-6);
}

TEST_F(TrackTable, SortsTimesAndKeepsTheLastDuplicate) {
  const TrackFile file = read("t_s,x_m,y_m\n2,20,0\n1,10,0\n1,11,0\n0,0,0\n");
  const auto& samples = file.tracks[0].samples;
  ASSERT_EQ(samples.size(), 3U);
  EXPECT_EQ(samples[0].time, 0);
  EXPECT_EQ(samples[1].position.x(), 11);
  EXPECT_EQ(samples[2].position.x(), 20);
  EXPECT_THAT(file.note, HasSubstr("1 row dropped"));
  EXPECT_THAT(file.note, HasSubstr("2 rows after a later one"));
}

TEST_F(TrackTable, AcceptsQuotesLineEndsAndByteOrderMark) {
  const TrackFile file = read(
      "\xEF\xBB\xBF\"t_s\", \"id\" ,X_M,y_m\r\n0,\"a, \"\"b\"\"\nc\",\"1.5\",2\r\n\r\n1,\"a, "
      "\"\"b\"\"\nc\",+2.5,2\r\n");
  ASSERT_EQ(file.tracks.size(), 1U);
  EXPECT_EQ(file.tracks[0].name, "a, \"b\"\nc");
  EXPECT_EQ(file.tracks[0].samples[1].position.x(), 2.5);
  EXPECT_EQ(read("t_s,x_m,y_m\r0,1,2\r1,2,3").tracks[0].samples.size(), 2U);
}

TEST_F(TrackTable, NamesFileLineAndColumnOfAnError) {
  EXPECT_THAT(error_of("0,1,2\n1,2,3\n"), HasSubstr("has no column t_s"));
  EXPECT_THAT(error_of("t_s,x,y\n0,0,0\n"), HasSubstr("x_m,y_m[,z_m]"));
  EXPECT_THAT(error_of("t_s,x_m,y_m\n0,1,2\n1,2\n"), HasSubstr(":3:"));
  EXPECT_THAT(error_of("t_s,x_m,y_m\n0,1,2\n1,2\n"), HasSubstr("2 cells, but the header has 3"));
  EXPECT_THAT(error_of("t_s,x_m,y_m\n0,1,2,3\n"), HasSubstr("4 cells"));
  EXPECT_THAT(error_of("t_s,x_m,y_m\n0,nan,2\n"), HasSubstr(":2:3: x_m 'nan' is not a finite"));
  EXPECT_THAT(error_of("t_s,x_m,y_m\n0,1,1e400\n"), HasSubstr(":2:5: y_m '1e400'"));
  EXPECT_THAT(error_of("t_s,x_m,y_m\n0,1,\n"), HasSubstr("y_m is empty"));
  EXPECT_THAT(error_of("t_s,x_m,y_m\n0,\"1\n2,3\n"), HasSubstr("is not closed"));
  EXPECT_THAT(error_of("t_s,lat_deg,lon_deg\n0,91,0\n"), HasSubstr("outside of +-90"));
  EXPECT_THAT(error_of("t_s,x_m,y_m\n0,2e9,0\n"), HasSubstr("beyond 1e9 m"));
  EXPECT_THAT(error_of("t_s,x_m,y_m\n"), HasSubstr("no rows"));
  EXPECT_THAT(error_of(""), HasSubstr("is empty"));
  EXPECT_THAT(error_of(std::string(3'000'000, 'x')), HasSubstr("not a CSV table"));
  EXPECT_THAT(error_of(std::string(10'000, ',')), HasSubstr("columns"));
  EXPECT_THROW((void)read_track_file("/nowhere/a.csv"), std::runtime_error);
  EXPECT_THROW((void)read_track_file(folder_.file("")), std::runtime_error);
}

TEST_F(TrackTable, StaysFiniteForSamplesWithoutTimeBetween) {
  const TrackFile file = read("t_s,x_m,y_m\n0,-1e9,0\n1e-300,1e9,0\n2e-300,-1e9,0\n");
  for (const MotionSample& sample : file.tracks[0].samples)
    EXPECT_TRUE(deadreckon::is_finite(sample));
}

TEST_F(TrackTable, ReadsTheTrajectoriesOfTheReferenceData) {
  RECKON_NEED_DATA("trajectories");
  const auto folder = test::reference_data() / "trajectories";
  const auto count = [](const TrackFile& file) {
    std::size_t samples = 0;
    for (const Track& track : file.tracks) samples += track.samples.size();
    return samples;
  };
  const TrackFile cars = read_track_file(folder / "vehicles_town_sumo.csv");
  EXPECT_EQ(cars.tracks.size(), 2347U);
  EXPECT_EQ(count(cars), 182156U);
  EXPECT_TRUE(cars.has_orientation);
  const TrackFile people = read_track_file(folder / "pedestrians_ucy_students03.csv");
  EXPECT_EQ(people.tracks.size(), 428U);
  EXPECT_EQ(count(people), 21846U);
  const TrackFile ships = read_track_file(folder / "vessels_ais_us_2022-01-03.csv");
  EXPECT_EQ(ships.tracks.size(), 10616U);
  EXPECT_LE(count(ships), 99647U);
  EXPECT_THAT(ships.note, HasSubstr("dropped"));
}

TEST_F(TrackTable, ReadsTheTracesOfHandsAndTools) {
  EXPECT_GT(read_track_file(reckon::test::source_dir() + "/scenes/hand_trace.csv")
                .tracks[0]
                .samples.size(),
            100U);
  RECKON_NEED_DATA("haptic-traces");
  const TrackFile file =
      read_track_file(test::reference_data() / "haptic-traces" / "wiping-rim-0.csv");
  EXPECT_TRUE(file.has_orientation);
  EXPECT_NEAR(file.tracks[0].samples[0].orientation.w(), 0.03808, 1e-4);
}

// Captures
// ------------------------------------------------------------------------------------------------

struct SentState {
  std::uint16_t entity;
  double stamp;    // [s] of the sender's clock
  double arrival;  // [s]
  double x;        // geocentric [m]
};

std::string capture_of(const test::ScratchFolder& folder, const std::vector<SentState>& states,
                       const std::string& name = "made.pcapng") {
  const std::string path = folder.file(name);
  peer::CaptureWriter writer({.path = path, .compress = name.ends_with(".zst")});
  for (const SentState& sent : states) {
    pdu::EntityState pdu;
    pdu.entity_id = {1, 2, sent.entity};
    pdu.location = {sent.x, 0, 0};
    pdu.linear_velocity = {3, 0, 0};
    pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::rvw;
    pdu.dead_reckoning.linear_acceleration = {0.5F, 0, 0};
    pdu.header.timestamp =
        pdu::to_dis_timestamp(std::chrono::nanoseconds(std::llround(sent.stamp * 1e9)), false);
    tools::captures::Octets bytes;
    tools::captures::append(bytes, pdu);
    peer::SourceDatagram datagram;
    datagram.time = std::chrono::seconds(1'700'000'000) +
                    std::chrono::nanoseconds(std::llround(sent.arrival * 1e9));
    datagram.source = peer::IpEndpoint::v4(0x0a000001, 4000);
    datagram.group = peer::IpEndpoint::v4(0xefc04f00U, 3000);
    datagram.bytes = bytes;
    writer.write(datagram);
  }
  writer.finish(states.size(), 0);
  return path;
}

TEST_F(TrackCapture, HasATrackPerEntityWithSentRates) {
  const double x = 6378137;
  const TrackFile file = read_track_file(
      capture_of(folder_, {{7, 0, 0.01, x}, {8, 0, 0.02, x + 5}, {7, 1, 1.03, x + 3}}));
  ASSERT_EQ(file.tracks.size(), 2U);
  EXPECT_EQ(file.tracks[0].name, "1:2:7");
  ASSERT_EQ(file.tracks[0].samples.size(), 2U);
  const auto& samples = file.tracks[0].samples;
  // Geocentric x is up at this place; by the sender's clock it takes one second, by the network
  // 1.02 s.
  EXPECT_NEAR(samples[1].time - samples[0].time, 1, 2e-6);
  EXPECT_NEAR((samples[1].position - samples[0].position - Vector3d(0, 0, 3)).norm(), 0, 1e-6);
  EXPECT_NEAR((samples[1].velocity - Vector3d(0, 0, 3)).norm(), 0, 1e-6);
  EXPECT_NEAR(samples[1].acceleration.z(), 0.5, 1e-6);
  EXPECT_TRUE(file.is_capture);
  EXPECT_THAT(file.note, HasSubstr("contains only sent updates"));
  EXPECT_FALSE(file.damaged);
}

TEST_F(TrackCapture, TakesArrivalTimesIfTimestampsStandStill) {
  const TrackFile file = read_track_file(
      capture_of(folder_, {{7, 0, 0, 6.4e6}, {7, 0, 1, 6.4e6 + 1}, {7, 0, 2.5, 6.4e6 + 2}}));
  ASSERT_EQ(file.tracks[0].samples.size(), 3U);
  EXPECT_NEAR(file.tracks[0].samples[2].time - file.tracks[0].samples[0].time, 2.5, 1e-9);
  EXPECT_THAT(file.note, HasSubstr("do not advance with the capture"));
}

TEST_F(TrackCapture, ContinuesAcrossTheHour) {
  const TrackFile file = read_track_file(capture_of(
      folder_, {{7, 3599, 0, 6.4e6}, {7, 3600.5, 1.6, 6.4e6 + 1}, {7, 3602, 3.1, 6.4e6 + 2}}));
  EXPECT_NEAR(file.tracks[0].samples[2].time - file.tracks[0].samples[0].time, 3, 1e-5);
}

TEST_F(TrackCapture, ReadsCompressedFilesAndReportsDamage) {
  const std::vector<SentState> states{{7, 0, 0, 6.4e6}, {7, 1, 1, 6.4e6 + 1}, {7, 2, 2, 6.4e6 + 2}};
  EXPECT_EQ(read_track_file(capture_of(folder_, states, "made.pcapng.zst")).tracks.size(), 1U);
  const std::string path = capture_of(folder_, states);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 60);
  const TrackFile cut = read_track_file(path);
  EXPECT_TRUE(cut.damaged);
  EXPECT_LT(cut.tracks[0].samples.size(), 3U);
  EXPECT_THAT(cut.note, HasSubstr("damaged"));
}

TEST_F(TrackCapture, RefusesCapturesWithoutEntities) {
  const std::string path = capture_of(folder_, {});
  try {
    (void)read_track_file(path);
    FAIL() << "an empty capture was taken";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no Entity State"));
  }
}

TEST_F(TrackCapture, ReadsTheRecordedSessions) {
  RECKON_NEED_DATA("dis-captures/real-sessions");
  const TrackFile file =
      read_track_file(test::reference_data() / "dis-captures/real-sessions/gaz69-straight.pcap");
  ASSERT_FALSE(file.tracks.empty());
  for (const Track& track : file.tracks)
    for (std::size_t i = 1; i < track.samples.size(); ++i)
      ASSERT_GT(track.samples[i].time, track.samples[i - 1].time);
}

}  // namespace
}  // namespace reckon::bench::track_file_test
