// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The truck of docs/library.md in simulated time.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <truck.hpp>  // tests/consumer, an external project

#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/tests/support/places.hpp"

namespace reckon::test {
namespace {

using namespace std::chrono_literals;

std::string text_of(const std::string& file) {
  std::ifstream in(reckon::test::source_dir() + "/" + file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Truck, DrivesUntilItIsFiredAt) {
  peer::ManualClock clock(1s, 1h);
  peer::SimulatedNetwork network({}, clock);
  peer::FederateOptions options;
  options.scene = peer::dis_exercise(1, kLatitude, kLongitude);
  options.name = "TRUCK";
  peer::Federate truck(options, network.link(0), clock, 1);
  options.name = "WATCHER";
  options.application = 2;
  peer::Federate watcher(options, network.link(1), clock, 2);
  watcher.subscribe(peer::EntityClass{});
  watcher.publish<pdu::Fire>();
  double speed_before = 0.0, speed_after = -1.0;
  const auto only = [&]() -> double {
    double speed = -1.0;
    watcher.for_each([&](const peer::RemoteObject& object) {
      EXPECT_EQ(object.marking(), "TRUCK1");
      speed = object.shown(watcher.now()).velocity.norm();
      // On its circle of 50 m about the given position, 430 m high.
      const Eigen::Vector3d at = object.shown(watcher.now()).position;
      EXPECT_NEAR(at.head<2>().norm(), 50.0, 1.5);
      EXPECT_NEAR(at.z(), 430.0, 0.1);
    });
    return speed;
  };
  int steps = 0;
  drive(truck, [&] {
    clock.advance(10ms);
    watcher.step();
    if (++steps == 1000) {
      speed_before = only();
      pdu::Fire fire;
      fire.firing_entity_id = {9, 9, 1};
      watcher.send(fire);
    }
    return steps < 3000;
  });
  speed_after = only();
  EXPECT_NEAR(speed_before, 10.0, 1.0);
  EXPECT_NEAR(speed_after, 0.0, 1e-6);
}

TEST(Truck, LibraryPagePrintsItsSource) {
  const std::string page = text_of("docs/library.md");
  for (const char* file : {"tests/consumer/truck.hpp", "tests/consumer/truck.cpp"}) {
    const std::string code = text_of(file);
    const std::string body = code.substr(code.find("#"));
    EXPECT_NE(page.find(body), std::string::npos) << file << " is another than the page prints";
  }
}

}  // namespace
}  // namespace reckon::test
