// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers with compressed states: the others show what a peer sends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/compression/compact_state.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/integration/federates.hpp"

namespace reckon::test {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using pdu::CompressedForm;
using std::chrono::nanoseconds;

constexpr std::size_t kTrucks = 5;
constexpr double kRadius = 40.0, kSpeed = 12.0;  // [m], [m/s]
// A position rounded to 1 mm on each axis, and a velocity to 1 cm/s for at most a second.
constexpr double kRounding = 0.02;  // [m]
// Greater errors mean a loss: the threshold, plus the effect of 20 ms delay and convergence.
constexpr double kMost = 1.3;  // [m]

peer::SceneFile country(CompressedForm form) {
  peer::SceneFile scene = *peer::dis_exercise(1, 0.82, 0.145);
  scene.network.interop = false;
  scene.network.compression = form;
  scene.aoim.cell = 500.0;
  scene.aoim.radius = 2000.0;
  scene.hash = peer::scene_hash(scene);
  return scene;
}

// Each on a circle of its own.
peer::EntityTruth truth_of(std::size_t truck, nanoseconds now) {
  const double angle = kSpeed / kRadius * pdu::to_seconds(now) + static_cast<double>(truck);
  peer::EntityTruth truth;
  truth.position = {100.0 * static_cast<double>(truck) + kRadius * std::cos(angle),
                    kRadius * std::sin(angle), 0.0};
  truth.velocity = {-kSpeed * std::sin(angle), kSpeed * std::cos(angle), 0.0};
  return truth;
}

// A host at its own address that sends states of another host's trucks, and receives everything.
class Liar {
 public:
  enum class Lie {
    key,          ///< a plain state, 60 m off
    compact_key,  ///< the same as a compact state
    leaning,      ///< the owner's last state that depends on a key, resent under the liar's name
  };

  Liar(peer::Link& link, CompressedForm form) : link_(link), scene_(country(form)) {
    const peer::GroupPool pool = peer::pool_of(scene_);
    static_cast<void>(link_.join(pool.base()));
    for (std::size_t i = 0; i < pool.size(); ++i) static_cast<void>(link_.join(pool.address(i)));
  }
  void hear() {
    std::array<peer::Datagram, 16> batch;
    for (std::size_t n = link_.receive(batch); n > 0; n = link_.receive(batch)) {
      for (std::size_t i = 0; i < n; ++i) {
        for (const pdu::BundledPdu& pdu : pdu::BundleReader(batch[i].bytes)) take(pdu.bytes);
      }
    }
  }
  // Forges states of all trucks.
  void lie(Lie what, nanoseconds utc) {
    if (what == Lie::leaning) return say(leaning_);
    for (const auto& [truck, state] : states_) {
      pdu::EntityState forged = state;
      forged.header.timestamp = pdu::to_dis_timestamp(utc, true);
      forged.location.x += 60.0;
      ASSERT_TRUE(pdu::quantise(forged, {}));
      say(what == Lie::compact_key ? compact(forged) : octets_of(forged));
    }
  }
  [[nodiscard]] std::size_t trucks() const { return states_.size(); }

 private:
  using Octets = std::vector<std::byte>;

  void take(std::span<const std::byte> bytes) {
    pdu::EntityState state;
    pdu::CompressedStates states;
    if (pdu::decode(bytes, state) == pdu::DecodeError::none) {
      state.header.pdu_status = 0;
      state.variable_parameters = {};
      states_[state.entity_id.entity] = state;
    } else if (pdu::decode(bytes, states) == pdu::DecodeError::none) {
      pdu::CompressedStateReader reader(states);
      for (pdu::CompressedState one; reader.next(one);) {
        if (one.form == CompressedForm::compact) continue;
        leaning_.assign(bytes.begin(), bytes.end());
      }
    }
  }
  static Octets octets_of(const pdu::EntityState& state) {
    Octets octets(pdu::wire_size(state));
    EXPECT_EQ(pdu::encode(state, octets), octets.size());
    return octets;
  }
  static Octets compact(const pdu::EntityState& state) {
    std::array<std::byte, pdu::kMostCompact> body;
    std::array<std::byte, pdu::kCompressedHeadSize + pdu::kMostCompressedBody> one;
    const std::size_t size = pdu::encode_compact(state, {}, body);
    pdu::CompressedStates states;
    states.header.exercise_id = state.header.exercise_id;
    states.header.timestamp = state.header.timestamp;
    states.simulation = state.entity_id.simulation();
    states.number_of_states = 1;
    states.states.bytes =
        std::span(one).first(pdu::store_compressed({state.entity_id.entity, CompressedForm::compact,
                                                    std::span<const std::byte>(body).first(size)},
                                                   one));
    Octets octets(pdu::wire_size(states));
    EXPECT_EQ(pdu::encode(states, octets), octets.size());
    return octets;
  }
  void say(const Octets& octets) {
    if (!octets.empty()) {
      EXPECT_TRUE(link_.send(scene_.network.group, octets));
    }
  }

  peer::Link& link_;
  peer::SceneFile scene_;
  std::map<std::uint16_t, pdu::EntityState> states_;
  Octets leaning_;
};

// The first federate has the trucks, the others watch; one pass each 10 ms.
class Country {
 public:
  explicit Country(double loss) : federates_(4, Federates::delayed(20ms, loss), 7) {}

  void join(CompressedForm form) {
    peer::Federate& federate = federates_.join(country(form));
    if (federates_.size() == 1) drive_in(federate);
  }

  void run(nanoseconds span) {
    const auto drive = [&] {
      for (std::size_t i = 0; i < kTrucks; ++i)
        federates_[0].update_attributes(trucks_[i], truth_of(i, federates_.now()));
    };
    const auto all_look = [&] {
      for (std::size_t i = 1; i < federates_.size(); ++i) look(i);
    };
    federates_.run(span, 10ms, drive, all_look);
  }

  /// The same while a liar forges states of all trucks, each `period`.
  void run_beside(Liar& liar, Liar::Lie lie, nanoseconds span, nanoseconds period) {
    for (const nanoseconds end = federates_.now() + span; federates_.now() < end;) {
      run(period);
      liar.hear();
      liar.lie(lie, federates_[0].utc());
    }
  }
  /// The link of a host without a federate.
  [[nodiscard]] peer::Link& free_link() { return federates_.link(3); }
  [[nodiscard]] peer::Federate& operator[](std::size_t i) { return federates_[i]; }
  /// Errors of the shown trucks of a federate since the last call, sorted [m].
  [[nodiscard]] std::vector<double> take_errors(std::size_t federate) {
    std::vector<double> errors = std::exchange(errors_[federate], {});
    std::sort(errors.begin(), errors.end());
    return errors;
  }
  [[nodiscard]] std::uint64_t count(std::size_t federate, const char* counter) {
    return federates_.count(federate, counter);
  }

  /// Whether a notice of a federate contains these words.
  [[nodiscard]] bool is_told(std::size_t federate, std::string_view words) {
    auto& ring = federates_[federate].peer().notices();
    bool found = false;
    for (const peer::Notice* notice = ring.front(); notice != nullptr; notice = ring.front()) {
      found = found || std::string_view(notice->text.data()).find(words) != std::string_view::npos;
      ring.pop();
    }
    return found;
  }

 private:
  void drive_in(peer::Federate& federate) {
    peer::EntityDescription truck;
    truck.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 7, 1, 0, 0};
    for (std::size_t i = 0; i < kTrucks; ++i) {
      truck.marking = "TRUCK" + std::to_string(i);
      trucks_.push_back(federate.register_object(truck, truth_of(i, federates_.now())));
    }
  }
  void look(std::size_t watcher) {
    federates_[watcher].for_each([&](const peer::RemoteObject& object) {
      const auto truck = static_cast<std::size_t>(object.marking().back() - '0');
      const Vector3d there = truth_of(truck, federates_.now()).position;
      errors_[watcher].push_back((object.shown(federates_.now()).position - there).norm());
    });
  }

  Federates federates_;
  std::vector<peer::ObjectHandle> trucks_;
  std::vector<double> errors_[3];
};

double share_above(const std::vector<double>& sorted, double most) {
  const auto above = sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), most);
  return static_cast<double>(above) / static_cast<double>(sorted.size());
}

class CompressedExercise : public ::testing::TestWithParam<CompressedForm> {
 protected:
  void print(const char* what, const std::vector<double>& errors) const {
    std::printf("form %d, %s: error 50 %% %.3f m, 99 %% %.3f m, most %.3f m, beyond %.3f m %.4f\n",
                static_cast<int>(GetParam()), what, errors[errors.size() / 2],
                errors[errors.size() * 99 / 100], errors.back(), kMost, share_above(errors, kMost));
  }
};

// Errors of the trucks that the second federate shows.
std::vector<double> errors_of(CompressedForm form, Country& country, nanoseconds span) {
  country.join(form);
  country.join(form);
  country.run(3s);
  static_cast<void>(country.take_errors(1));
  country.run(span);
  return country.take_errors(1);
}

TEST_P(CompressedExercise, ShowsAllWithinTheThresholdAndARounding) {
  Country plain_country(0.0), country(0.0);
  const auto plain = errors_of(CompressedForm::none, plain_country, 40s);
  const auto errors = errors_of(GetParam(), country, 40s);
  print("no loss, plain", plain);
  print("no loss", errors);
  EXPECT_EQ(country[1].size(), kTrucks);
  ASSERT_EQ(errors.size(), kTrucks * 4000);
  EXPECT_LE(errors.back(), kMost);
  for (const double share : {0.5, 0.9, 0.99, 0.9999}) {
    const auto at = static_cast<std::size_t>(share * static_cast<double>(errors.size()));
    EXPECT_NEAR(errors[at], plain[at], kRounding) << share;
  }
  EXPECT_GT(country.count(1, "compressed_in"), 50U);
  EXPECT_EQ(country.count(1, "keys_awaited"), 0U);
  EXPECT_EQ(country.count(1, "malformed_in"), 0U);
}

TEST_P(CompressedExercise, LosesLittleMoreThanPlainStatesDo) {
  Country plain_country(0.1), country(0.1);
  const auto plain = errors_of(CompressedForm::none, plain_country, 60s);
  const auto errors = errors_of(GetParam(), country, 60s);
  print("loss 10 %, plain", plain);
  print("loss 10 %", errors);
  EXPECT_EQ(country[1].size(), kTrucks);
  EXPECT_GT(country.count(1, "compressed_in"), 50U);
  EXPECT_EQ(country.count(1, "malformed_in"), 0U);
  EXPECT_LE(share_above(errors, kMost), share_above(plain, kMost) + 0.03);
}

// A compressed update of a newcomer's own does not count as its introduction.
TEST_P(CompressedExercise, IntroducesANewcomerAtAnyMoment) {
  for (int moment = 0; moment < 40; ++moment) {
    Country country(0.0);
    country.join(GetParam());
    country.join(GetParam());
    country.run(5s + moment * 50ms);
    country.join(GetParam());
    country.run(300ms);
    EXPECT_EQ(country[2].size(), kTrucks) << 50 * moment << " ms";
  }
}

TEST_P(CompressedExercise, ShowsTheSameToALateNewcomer) {
  Country country(0.0);
  country.join(GetParam());
  country.join(GetParam());
  country.run(20s);
  country.join(GetParam());
  country.run(2s);
  static_cast<void>(country.take_errors(2));
  country.run(20s);
  const auto errors = country.take_errors(2);
  print("late", errors);
  EXPECT_LE(errors.back(), kMost);
  EXPECT_GT(country.count(2, "compressed_in"), 20U);
}

TEST_P(CompressedExercise, IsAnotherSceneForPeersWithoutCompression) {
  Country country(0.0);
  country.join(GetParam());
  country.join(CompressedForm::none);
  country.run(5s);
  EXPECT_EQ(country[1].size(), 0U) << "it would read some states and miss others";
  EXPECT_EQ(country.count(1, "compressed_in"), 0U);
  EXPECT_EQ(country.count(1, "malformed_in"), 0U);
  EXPECT_TRUE(country.is_told(1, "runs another scene"));
}

// Once and ten times a second: forged plain keys, compact keys, echoes.
TEST_P(CompressedExercise, ForgedStatesNeitherMoveNorHideIt) {
  for (const Liar::Lie lie : {Liar::Lie::key, Liar::Lie::compact_key, Liar::Lie::leaning}) {
    for (const nanoseconds period : {nanoseconds(1s), nanoseconds(100ms)}) {
      Country country(0.0);
      country.join(GetParam());
      country.join(GetParam());
      Liar liar(country.free_link(), GetParam());
      country.run(3s);
      static_cast<void>(country.take_errors(1));
      const nanoseconds span = period == 1s ? 20s : 5s;
      country.run_beside(liar, lie, span, period);
      country.run(12s);  // until after the next keys
      const auto errors = country.take_errors(1);
      print("beside a liar", errors);
      ASSERT_EQ(liar.trucks(), kTrucks);
      const auto looks = static_cast<std::size_t>((span + 12s) / 10ms);
      EXPECT_EQ(errors.size(), kTrucks * looks) << "one was hidden for a while";
      EXPECT_LE(errors.back(), kMost);
      EXPECT_EQ(country.count(1, "keys_awaited"), 0U);
      const bool needs_key = GetParam() != CompressedForm::compact;
      if (lie == Liar::Lie::leaning && !needs_key) continue;  // there are no dependent states
      EXPECT_GE(country.count(1, "disputed_in"), 15U);
      EXPECT_TRUE(country.is_told(1, "refused entities under this number"));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, CompressedExercise,
                         ::testing::Values(CompressedForm::compact, CompressedForm::residual));

}  // namespace
}  // namespace reckon::test
