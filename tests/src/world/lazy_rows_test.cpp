// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rows that nobody watches: the same traffic through a table that somebody always looks at, and
// through one with rare looks.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/pdu/entity/variable_parameter.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/src/support/incoming_half.hpp"

namespace reckon::peer::lazy_rows_test {
namespace {

using deadreckon::KinematicState;
using deadreckon::Pose;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr std::size_t kEntities = 48;

// Some entities have body axes, parts or a force model.
bool has_body_axes(std::size_t i) { return i % 4 == 0; }
bool has_parts(std::size_t i) { return i % 8 == 1; }
bool is_felt(std::size_t i) { return i % 8 == 2; }
bool is_plain(std::size_t i) { return !has_body_axes(i) && !has_parts(i) && !is_felt(i); }

// A turret at half a radian (SISO UID 58, 59).
std::span<const std::byte> turret() {
  static const auto octets = [] {
    std::array<std::byte, pdu::kVariableParameterSize> part{};
    pdu::ArticulatedPart wire;
    wire.parameter_type = 128 * 32 + 11;
    wire.parameter_value = 0.5F;
    static_cast<void>(pdu::store_record(wire, part));
    return part;
  }();
  return octets;
}

pdu::EntityId id_of(std::size_t i) {
  return {7, static_cast<std::uint16_t>(1 + i % 3), static_cast<std::uint16_t>(1 + i)};
}

test::IncomingHalf half(const std::string& more) {
  return {
      "[aoim]\nradius = \"3 km\"\ncell = \"1 km\"\n[convergence]\nteleport_distance = \"30 m\"\n" +
          more,
      [](const SceneFile& scene) {
        RemoteSettings settings = remote_settings(scene);
        settings.record_changes = true;
        return settings;
      }};
}

// An update on its way.
struct Sent {
  Inbound update;
  std::uint32_t epoch = 0;
  aoim::SourceAddress from;
};

// Random traffic of three hosts: losses, reordering, copies, forged and impossible states, jumps,
// turns, other models, frozen and deactivated entities, parts, force models and stopped clocks.
class Traffic {
 public:
  Traffic(std::uint64_t seed, const test::IncomingHalf& world) : random_(seed), world_(world) {}

  // The states of one pass, in the order of their arrival.
  std::vector<Sent> pass(nanoseconds now) {
    std::vector<Sent> sent;
    for (std::size_t i = 0; i < kEntities; ++i) {
      if (!chance(0.2)) continue;
      move(i, now);
      if (chance(0.05)) continue;  // lost
      sent.push_back(update_of(i, now));
      if (chance(0.03)) sent.push_back(sent.back());
      if (chance(0.02)) sent.back().from.port = 666;
      if (chance(0.01)) sent.back().update.state.linear_velocity.x = 1e30F;
      if (chance(0.01)) sent.back().update.state.orientation.phi = std::nanf("");
      if (sent.size() > 1 && chance(0.05)) std::swap(sent.back(), sent[sent.size() - 2]);
    }
    return sent;
  }

 private:
  bool chance(double share) { return std::bernoulli_distribution(share)(random_); }
  double within(double most) { return std::uniform_real_distribution(-most, most)(random_); }
  Vector3d vector(double most) { return {within(most), within(most), within(most)}; }

  void move(std::size_t i, nanoseconds now) {
    KinematicState& state = states_[i];
    state.position += pdu::to_seconds(now - moved_[i]) * state.velocity + vector(0.2);
    moved_[i] = now;
    state.velocity += vector(2);
    state.acceleration = vector(3);
    state.angular_velocity = vector(1);
    state.orientation = state.orientation * deadreckon::exponential(vector(0.3));
    if (state.position.norm() > 4000) state.velocity = -0.02 * state.position;
    if (chance(0.02)) state.position += vector(100);
    if (chance(0.02)) state.velocity = vector(200);
    const int models = has_body_axes(i) ? 9 : 5;
    if (chance(0.02) || moved_[i] == nanoseconds(0)) {
      state.algorithm = static_cast<pdu::DeadReckoningAlgorithm>(
          std::uniform_int_distribution(1, models)(random_));
    }
    if (chance(0.01)) frozen_[i] = !frozen_[i];
    if (chance(0.002)) behind_[i] += milliseconds(1500);
    if (chance(0.002)) hosts_[i] = static_cast<std::uint16_t>(1 + hosts_[i] % 3);
  }
  Sent update_of(std::size_t i, nanoseconds now) {
    Sent sent;
    world_.put_state(sent.update, id_of(i), states_[i], now - behind_[i]);
    pdu::EntityState& pdu = sent.update.state;
    pdu.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::land};
    pdu.appearance = frozen_[i] ? pdu::kAppearanceFrozen : 0U;
    if (chance(0.005)) pdu.appearance |= pdu::kAppearanceDeactivated;
    if (has_parts(i) && chance(0.5)) pdu.variable_parameters = turret();
    sent.update.has_model = is_felt(i) && chance(0.3);
    sent.update.model.k1 = 100;
    sent.epoch = i % 3 == 0 ? 0 : 17;
    sent.from.port = hosts_[i];
    return sent;
  }

  std::mt19937_64 random_;
  const test::IncomingHalf& world_;
  std::array<KinematicState, kEntities> states_{};
  std::array<nanoseconds, kEntities> moved_{}, behind_{};
  std::array<bool, kEntities> frozen_{};
  std::array<std::uint16_t, kEntities> hosts_{};
};

void look_at_all(const RemoteEntities& remote) {
  for (const RemoteEntity& row : remote.rows()) static_cast<void>(*row.state);
}

double gap(const Pose& a, const Pose& b) {
  return (a.position - b.position).norm() + (a.velocity - b.velocity).norm() +
         (a.orientation.coeffs() - b.orientation.coeffs()).norm() +
         (a.angular_velocity - b.angular_velocity).norm();
}

std::map<std::string, std::uint64_t> counts_of(const Counters& counters) {
  std::map<std::string, std::uint64_t> counts;
  counters.for_each([&](const CounterReading& one) { counts[std::string(one.name)] = one.value; });
  counts.erase("snaps");  // counts what somebody could see
  return counts;
}

class LazyRows : public testing::TestWithParam<const char*> {
 protected:
  // All that is no correction of the shown pose is the same, to the bit.
  void expect_same(const RemoteEntity& row, const RemoteEntity& lazy) const {
    ASSERT_EQ(row.id, lazy.id);
    EXPECT_EQ(gap(row.predicted(now_), lazy.predicted(now_)), 0.0);
    EXPECT_EQ(row.state->orientation.coeffs(), lazy.state->orientation.coeffs());
    EXPECT_EQ(row.state_time, lazy.state_time);
    EXPECT_EQ(row.last_heard, lazy.last_heard);
    EXPECT_EQ(row.timestamp, lazy.timestamp);
    EXPECT_EQ(row.version, lazy.version);
    EXPECT_EQ(row.updates, lazy.updates);
    EXPECT_EQ(row.timeout, lazy.timeout);
    EXPECT_EQ(row.jump_m, lazy.jump_m);
    EXPECT_EQ(row.frozen, lazy.frozen);
    EXPECT_EQ(row.parts, lazy.parts);
    EXPECT_EQ(row.epoch, lazy.epoch);
  }
  void expect_same_changes() {
    const auto all = eager_.remote.take_changes(), some = lazy_.remote.take_changes();
    ASSERT_EQ(all.size(), some.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_EQ(all[i].id, some[i].id);
      EXPECT_EQ(all[i].change, some[i].change);
    }
  }
  void take(const Sent& sent) {
    eager_.take(sent.update, now_, sent.epoch, sent.from);
    lazy_.take(sent.update, now_, sent.epoch, sent.from);
    look_at_all(eager_.remote);
  }
  void house_keeping() {
    for (RemoteEntities* remote : {&eager_.remote, &lazy_.remote}) {
      remote->expire(now_);
      remote->look_shown(now_);
      remote->look_outside(now_);
    }
  }
  nanoseconds now_ = seconds(1);
  test::IncomingHalf eager_ = half(GetParam()), lazy_ = half(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Scenes, LazyRows, testing::Values("", "prediction = \"adaptive\"\n"));

TEST_P(LazyRows, EqualWatchedRowsExceptForCorrections) {
  std::mt19937 random(5);
  Traffic traffic(3, eager_);
  const bool is_lazy = std::string_view(GetParam()).empty();
  std::array<nanoseconds, kEntities> watched_until;
  watched_until.fill(nanoseconds::max());
  std::array<std::uint64_t, kEntities> updates{};  // at its last look
  std::size_t looks = 0, corrected = 0;
  for (int pass = 0; pass < 6000; ++pass, now_ += milliseconds(20)) {
    for (const Sent& sent : traffic.pass(now_)) take(sent);
    for (std::size_t i = 0; i < kEntities; ++i) {
      const RemoteEntity* row = lazy_.remote.find(id_of(i));
      const bool is_next = row != nullptr && row->updates != updates[i];
      if (is_next) watched_until[i] = std::min(watched_until[i], now_ + LazyState::kWatched);
    }
    house_keeping();
    ASSERT_EQ(counts_of(eager_.counters), counts_of(lazy_.counters)) << "pass " << pass;
    if (pass % 50 == 0) expect_same_changes();
    const RemoteEntity* lazy = lazy_.remote.find(id_of(random() % kEntities));
    if (random() % 100 != 0 || lazy == nullptr) continue;
    const RemoteEntity* row = eager_.remote.find(lazy->id);
    ASSERT_NE(row, nullptr);
    expect_same(*row, *lazy);
    ++looks;
    corrected += gap(row->shown(now_), lazy->shown(now_)) > 0;
    const std::size_t i = lazy->id.entity - 1U;
    if (is_lazy && is_plain(i) && lazy->last_heard >= watched_until[i]) {
      EXPECT_EQ(gap(lazy->shown(now_), row->predicted(now_)), 0.0) << "nobody saw another pose";
    }
    watched_until[i] = nanoseconds::max();
    updates[i] = lazy->updates;
  }
  EXPECT_EQ(eager_.remote.pose_jumps().count(), lazy_.remote.pose_jumps().count());
  for (const double share : {0.1, 0.5, 0.9, 0.99})
    EXPECT_EQ(eager_.remote.pose_jumps().percentile(share),
              lazy_.remote.pose_jumps().percentile(share));
  EXPECT_EQ(eager_.remote.force_jumps().count(), lazy_.remote.force_jumps().count());
  now_ += seconds(3);  // all corrections have ended
  ASSERT_EQ(eager_.remote.rows().size(), lazy_.remote.rows().size());
  for (std::size_t i = 0; i < eager_.remote.rows().size(); ++i) {
    const RemoteEntity &row = eager_.remote.rows()[i], &lazy = lazy_.remote.rows()[i];
    expect_same(row, lazy);
    EXPECT_EQ(gap(row.shown(now_), lazy.shown(now_)), 0.0);
  }
  EXPECT_GT(looks, 20U);
  EXPECT_GT(lazy_.remote.with_parts(), 0U);
  EXPECT_EQ(corrected > 0, is_lazy) << "a history needs each state";
  for (const char* name : {"disputed_in", "values_refused", "stale_in", "repeats_in", "left",
                           "not_interesting", "sender_leaps", "entered"})
    EXPECT_GT(lazy_.count(name), 0U) << name;
}

}  // namespace
}  // namespace reckon::peer::lazy_rows_test
