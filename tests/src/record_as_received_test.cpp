// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Compares the force that a peer computes with an evaluation of the received octets that shares no
// code with the project: own parsing, own geodesy, own force law.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <vector>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/peer.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
// Near the earth's surface a double resolves 1 nm, which is 0.5 uN of a 500 N/m contact; so the
// reference uses long double.
using Real = long double;
using Vector = std::array<Real, 3>;

// Independent reader
// -----------------------------------------------------------------------------------

template <typename T>
T big_endian(const std::byte* at) {
  std::array<std::byte, sizeof(T)> swapped;
  for (std::size_t i = 0; i < sizeof(T); ++i) swapped[i] = at[sizeof(T) - 1 - i];
  return std::bit_cast<T>(swapped);
}

struct Received {
  std::uint32_t timestamp = 0;
  Vector location{}, velocity{};
  Real k1 = 0, k3 = 0, radius = 0;
  Vector point{};
  Real psi = 0, theta = 0, phi = 0;
  int algorithm = 0;
  bool complete = false;
};

void read_entity_state(const std::byte* p, Received& out) {
  out.timestamp = big_endian<std::uint32_t>(p + 4);
  for (std::size_t i = 0; i < 3; ++i) {
    out.velocity[i] = big_endian<float>(p + 36 + 4 * i);
    out.location[i] = big_endian<double>(p + 48 + 8 * i);
  }
  out.psi = big_endian<float>(p + 72);
  out.theta = big_endian<float>(p + 76);
  out.phi = big_endian<float>(p + 80);
  out.algorithm = static_cast<int>(p[88]);
}

void read_record(const std::byte* p, Received& out) {
  out.k1 = big_endian<float>(p + 16);
  out.k3 = big_endian<float>(p + 20);
  for (std::size_t i = 0; i < 3; ++i) out.point[i] = big_endian<float>(p + 32 + 4 * i);
  out.radius = big_endian<float>(p + 68);
  out.complete = true;
}

// Walks a bundle by the lengths of its PDUs; true if it contains an Entity State with a record.
bool read_bundle(std::span<const std::byte> datagram, Received& out) {
  bool found = false;
  for (std::size_t at = 0; at + 12 <= datagram.size();) {
    const std::byte* p = datagram.data() + at;
    const auto type = static_cast<int>(p[2]);
    const std::size_t length = big_endian<std::uint16_t>(p + 8);
    if (type == 1) {
      read_entity_state(p, out);
      found = true;
    } else if (type == 72 && big_endian<std::uint32_t>(p + 40) == 0x48415001u) {
      read_record(p + 40, out);
    }
    at += length;
  }
  return found;
}

// Independent mathematics
// ------------------------------------------------------------------------------

struct Scene {
  Vector origin{};
  std::array<Vector, 3> axes{};  // east, north, up in ECEF

  explicit Scene(Real lat, Real lon, Real h) {
    const Real a = 6378137.0L, e2 = (2.0L - 1.0L / 298.257223563L) / 298.257223563L;
    const Real n = a / std::sqrt(1.0 - e2 * std::sin(lat) * std::sin(lat));
    origin = {(n + h) * std::cos(lat) * std::cos(lon), (n + h) * std::cos(lat) * std::sin(lon),
              (n * (1.0 - e2) + h) * std::sin(lat)};
    axes = {{{-std::sin(lon), std::cos(lon), 0.0},
             {-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat)},
             {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)}}};
  }
  [[nodiscard]] Vector local(const Vector& v) const {
    Vector out{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) out[i] += axes[i][j] * v[j];
    }
    return out;
  }
};

// Body to world: columns of the transpose of Rx(phi) Ry(theta) Rz(psi).
Vector body_to_world(const Received& r, const Vector& b) {
  const Real cp = std::cos(r.psi), sp = std::sin(r.psi), ct = std::cos(r.theta),
             st = std::sin(r.theta), cf = std::cos(r.phi), sf = std::sin(r.phi);
  const std::array<Vector, 3> rows{{{ct * cp, ct * sp, -st},
                                    {sf * st * cp - cf * sp, sf * st * sp + cf * cp, sf * ct},
                                    {cf * st * cp + sf * sp, cf * st * sp - sf * cp, cf * ct}}};
  Vector out{};
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) out[j] += rows[i][j] * b[i];
  }
  return out;
}

Vector expected_force(const Received& r, const Scene& scene, const Eigen::Vector3d& probe,
                      Real probe_radius, Real age) {
  Vector centre = r.location;
  const Vector point = body_to_world(r, r.point);
  for (std::size_t i = 0; i < 3; ++i) {
    centre[i] += point[i] + (r.algorithm >= 2 ? age * r.velocity[i] : 0.0L) - scene.origin[i];
  }
  const Vector c = scene.local(centre);
  const Vector d{probe.x() - c[0], probe.y() - c[1], probe.z() - c[2]};
  const Real distance = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  const Real depth = r.radius + probe_radius - distance;
  const Real f = depth > 0 ? r.k1 * depth + r.k3 * depth * depth * depth : 0.0L;
  return {f * d[0] / distance, f * d[1] / distance, f * d[2] / distance};
}

// Test rig
// ---------------------------------------------------------------------------------------------

// Passes a link through and stores the datagrams it delivered.
class TappedLink final : public Link {
 public:
  explicit TappedLink(Link& inner) : inner_(inner) {}
  bool send(const IpEndpoint& to, std::span<const std::byte> b) noexcept override {
    return inner_.send(to, b);
  }
  std::size_t receive(std::span<Datagram> out) noexcept override {
    const std::size_t n = inner_.receive(out);
    for (std::size_t i = 0; i < n; ++i) {
      Received update;
      update = last;
      if (!read_bundle(out[i].bytes, update)) continue;
      // The newest wins. The wrap of the hour is ignored: the runs are shorter.
      if (last.complete && (update.timestamp >> 1) <= (last.timestamp >> 1)) continue;
      last = update;
      ++updates;
    }
    return n;
  }
  std::error_code join(const GroupAddress& g) noexcept override { return inner_.join(g); }
  void leave(const GroupAddress& g) noexcept override { inner_.leave(g); }
  bool wait(nanoseconds t) noexcept override { return inner_.wait(t); }
  void wake() noexcept override { inner_.wake(); }
  [[nodiscard]] IpEndpoint local_endpoint() const noexcept override {
    return inner_.local_endpoint();
  }
  [[nodiscard]] std::size_t max_payload() const noexcept override { return inner_.max_payload(); }
  [[nodiscard]] LinkStatistics statistics() const noexcept override { return inner_.statistics(); }

  Received last;
  int updates = 0;

 private:
  Link& inner_;
};

struct Rig {
  Rig(const ImpairmentLaw& law, haptics::HandScript first, haptics::HandScript second,
      double second_stiffness)
      : network({}, clock), tap(network.link(0)) {
    scene.origin = {0.82, 0.145, 430.0};
    scene.hand.radius = 0.01;
    scene.hand.k1 = 500.0;
    scene.hand.k3 = 1e5;
    scene.hand.damping = 0.0;
    scene.hand.static_friction = scene.hand.kinetic_friction = 0.0;
    scene.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
    scene.hash = 1;
    network.impair(law);
    const auto device = [](haptics::HandScript script, double stiffness) {
      haptics::SimulatedDeviceConfig config;
      config.hand_stiffness = stiffness;
      config.hand_damping = std::min(0.01 * stiffness, 100.0);
      config.start = script(0.0).position;
      return std::make_unique<haptics::SimulatedDevice>(config, std::move(script));
    };
    devices = {device(std::move(first), 300.0), device(std::move(second), second_stiffness)};
    for (std::size_t i = 0; i < 2; ++i) {
      PeerOptions options;
      options.application = static_cast<std::uint16_t>(i + 1);
      options.epoch = static_cast<std::uint32_t>(77 + i);
      Link& link = i == 0 ? static_cast<Link&>(tap) : network.link(1);
      peers[i] = std::make_unique<Peer>(scene, options, link, *devices[i]);
      rings[i] = std::make_unique<haptics::TraceRing>(64);
      peers[i]->trace(rings[i].get());
      peers[i]->start(clock.now());
    }
  }

  // Runs one millisecond; returns the first peer's servo step.
  haptics::ServoSnapshot step() {
    clock.advance(milliseconds(1));
    haptics::ServoSnapshot first, other;
    for (std::size_t i = 0; i < 2; ++i) peers[i]->servo_step(clock.now());
    rings[0]->pop(first);
    rings[1]->pop(other);
    for (auto& peer : peers) {
      peer->read_step(clock.now());
      peer->model_step(clock.now(), clock.utc_now());
      peer->write_step();
    }
    return first;
  }

  ManualClock clock{std::chrono::seconds(1), std::chrono::hours(500000) + std::chrono::minutes(5)};
  SceneFile scene;
  SimulatedNetwork network;
  TappedLink tap;
  std::array<std::unique_ptr<haptics::SimulatedDevice>, 2> devices;
  std::array<std::unique_ptr<haptics::TraceRing>, 2> rings;
  std::array<std::unique_ptr<Peer>, 2> peers;
};

Real age_of(std::uint32_t timestamp, nanoseconds utc) {
  const Real hour = static_cast<Real>(utc.count() % 3'600'000'000'000) * 1e-9L;
  return hour - static_cast<Real>(timestamp >> 1) * (3600.0L / 2147483647.0L);
}

Real apart(const Vector& a, const Vector& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

haptics::HandScript approach(double from, double to, double wave) {
  return [=](double t) {
    haptics::HandTarget target;
    const double share = std::min(1.0, t / 1.5);
    target.position = {from + (to - from) * share + wave * std::sin(4.0 * t), 0.0, 0.1};
    return target;
  };
}

ImpairmentLaw rough() {
  ImpairmentLaw law;
  law.delay = milliseconds(200);
  law.jitter = milliseconds(100);
  law.loss = 0.2;
  law.reorder = 0.1;
  law.duplicate = 0.1;
  return law;
}

TEST(RecordAsReceived, ForceBeforeTheGateMatchesAnIndependentEvaluation) {
  Rig rig(rough(), approach(-0.03, -0.004, 0.002), approach(0.03, 0.004, 0.0), 300.0);
  const Scene scene(0.82, 0.145, 430.0);
  Real worst = 0.0;
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const Received known = rig.tap.last;  // the record that had arrived when the servo stepped
    const nanoseconds utc = rig.clock.utc_now() + milliseconds(1);
    const haptics::ServoSnapshot step = rig.step();
    if (!known.complete || step.count == 0) continue;
    const Vector wanted =
        expected_force(known, scene, step.device, 0.01, age_of(known.timestamp, utc));
    const Eigen::Vector3d got = step.contacts[0].ungated_force;
    if (wanted[0] == 0.0L && got.isZero()) continue;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      worst = std::max(worst, std::abs(got[axis] - wanted[static_cast<std::size_t>(axis)]));
    }
    ++compared;
  }
  RecordProperty("worst_newton", std::to_string(static_cast<double>(worst)));
  std::printf("worst difference %.2Le N over %d steps, %d updates\n", worst, compared,
              rig.tap.updates);
  EXPECT_GT(compared, 5000);
  EXPECT_LE(worst, 1e-6);
}

TEST(RecordAsReceived, ForceAfterTheGateMatchesForConstantRecords) {
  // The second hand does not move after one step of 2 mm; the first presses on it.
  const auto rock = [](double t) {
    haptics::HandTarget target;
    target.position = {t < 0.5 ? 0.006 : 0.008, 0.0, 0.1};
    return target;
  };
  Rig rig(rough(), approach(-0.03, -0.006, 0.0), rock, 1e5);
  const Scene scene(0.82, 0.145, 430.0);
  Real worst = 0.0;
  int compared = 0;
  Received known;
  nanoseconds since{0};
  for (int i = 0; i < 60000; ++i) {
    const Received before = rig.tap.last;
    const bool same = apart(before.location, known.location) < 1e-9L &&
                      apart(before.velocity, known.velocity) < 1e-9L &&
                      apart(before.point, known.point) < 1e-9L && before.k1 == known.k1;
    if (!same) since = rig.clock.now();
    known = before;
    const nanoseconds utc = rig.clock.utc_now() + milliseconds(1);
    const haptics::ServoSnapshot step = rig.step();
    if (!known.complete || rig.clock.now() - since < std::chrono::seconds(2) || step.count == 0)
      continue;
    const Vector wanted =
        expected_force(known, scene, step.device, 0.01, age_of(known.timestamp, utc));
    if (wanted[0] == 0.0L) continue;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      worst = std::max(
          worst, std::abs(step.contacts[0].force[axis] - wanted[static_cast<std::size_t>(axis)]));
    }
    ++compared;
  }
  std::printf("worst difference %.2Le N over %d steps\n", worst, compared);
  EXPECT_GT(compared, 5000);
  EXPECT_LE(worst, 1e-6);
}

}  // namespace
}  // namespace reckon::peer
