// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Measures the claims of the demo from outside the peers: recorded servo steps and shown poses are
// compared with the owner's true state at the same instant. Only a program that runs all peers can
// do this.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/counters/error_histogram.hpp"
#include "reckon/peer/settings/hand_config.hpp"
#include "reckon/peer/world/device_stiffness.hpp"
#include "reckon/peer/world/peer_view.hpp"

namespace reckon::tools {

/// Compares N hands with one another, and the shown positions of other entities with their true
/// positions. One thread.
class DemoMeasurement {
 public:
  /// @param hand force model that all hands of the scene show to others.
  /// @param peers the peer of each hand: hands of one peer do not feel each other.
  DemoMeasurement(std::vector<std::size_t> peers, const peer::HandModel& hand);

  /// One recorded servo step of hand `index`; times increase.
  void add_step(std::size_t index, const haptics::ServoSnapshot& step);
  /// A pose of hand `owner` that some peer showed.
  void add_shown(std::size_t owner, const peer::ShownSample& sample);
  /// A pose that some peer showed of an entity without a hand; its true position was `position`
  /// [m].
  void add_shown_entity(const peer::ShownSample& sample, const Eigen::Vector3d& position);
  /// IDs of the hands; they may change while a conflict is resolved.
  void set_ids(std::span<const pdu::EntityId> ids) { ids_.assign(ids.begin(), ids.end()); }
  /// Limits of the device of hand `index`. Call before the first evaluate(); without it there are
  /// none.
  void set_device(std::size_t index, const peer::DeviceStiffness& device) {
    devices_[index] = device;
  }

  /// Evaluates all samples whose true state is known by now.
  void evaluate();

  /// [m] shown remote position against the owner's at that instant, of hands and of entities on a
  /// track or at rest. No samples: no remote entity was shown.
  [[nodiscard]] peer::Spread pose_error() const { return pose_error_.spread(); }
  /// [N] rendered force between hands against the owner's full model at the same probe state, while
  /// either is not zero.
  [[nodiscard]] peer::Spread force_error() const { return force_error_.spread(); }
  /// [N] the same against the part of that model that the two devices can show: limited to the
  /// stiffness of the softer one and to the greatest force of the one that shows it.
  [[nodiscard]] peer::Spread possible_force_error() const { return possible_error_.spread(); }
  /// [N] RMS of the same; 0 if no hands touched.
  [[nodiscard]] double force_error_rms() const;
  /// [J] least of every port's work + damping + received - given, and of the sum of all ports.
  [[nodiscard]] double energy_min() const { return energy_min_; }
  /// Greatest part of energy_min() that late steps account for [J], added over the ports.
  [[nodiscard]] double late_cost() const;
  /// Largest loan to a port because hands began inside one another [J].
  [[nodiscard]] double loan_most() const { return loan_most_; }
  /// [s] of contact with hands, with the static scene, and with entities without a hand, each
  /// summed over the hands: durations of their servo steps in contact.
  [[nodiscard]] double touching_hands() const { return touching_hands_; }
  [[nodiscard]] double touching_scene() const { return touching_scene_; }
  [[nodiscard]] double touching_entities() const { return touching_entities_; }
  [[nodiscard]] double peak_force() const { return peak_force_; }
  [[nodiscard]] std::uint64_t trips() const { return trips_; }

 private:
  struct Truth {
    std::chrono::nanoseconds time{0};
    Eigen::Vector3d device, scp, velocity;
    double energy = 0;  // work + damping of this port
  };
  struct Shown {
    std::size_t owner;
    peer::ShownSample sample;
  };
  [[nodiscard]] std::optional<Truth> truth(std::size_t hand, std::chrono::nanoseconds time) const;
  [[nodiscard]] std::chrono::nanoseconds covered_until() const;
  [[nodiscard]] bool is_far(std::size_t owner, const haptics::ServoSnapshot& step) const;
  [[nodiscard]] double length_of(std::size_t index, const haptics::ServoSnapshot& step);
  void compare_forces(std::size_t observer, const haptics::ServoSnapshot& step);
  [[nodiscard]] bool compare_force(std::size_t observer, std::size_t owner,
                                   const haptics::ServoSnapshot& step);
  [[nodiscard]] double possible(std::size_t observer, std::size_t owner, double depth,
                                double closing) const;
  void add_energy(std::size_t index, const haptics::ServoSnapshot& step);
  [[nodiscard]] std::optional<std::size_t> index_of(const pdu::EntityId& id) const;

  peer::HandModel hand_;
  struct Place {
    std::uint64_t step = 0;
    std::chrono::nanoseconds time{0};
    bool known = false;
  };
  // Indexed by hand.
  std::vector<std::size_t> peers_;
  std::vector<pdu::EntityId> ids_;
  std::vector<peer::DeviceStiffness> devices_;
  std::vector<Place> last_;         // last compared step
  std::vector<double> late_costs_;  // [J]
  std::vector<std::deque<Truth>> history_;
  std::vector<std::deque<haptics::ServoSnapshot>> steps_;
  std::deque<Shown> shown_;
  peer::ErrorHistogram pose_error_, force_error_, possible_error_;
  double force_error_squares_ = 0;  // [N^2], of all samples
  double energy_min_ = 0;
  double loan_most_ = 0;
  double touching_hands_ = 0, touching_scene_ = 0, touching_entities_ = 0, peak_force_ = 0;
  std::uint64_t trips_ = 0;
};

}  // namespace reckon::tools
