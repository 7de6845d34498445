// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the demo claims, measured from outside the peers: their recorded servo steps and shown poses
// are compared with each other's truth at the same instant. Only a program that holds all peers can
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
#include "reckon/peer/scene/peer_config.hpp"
#include "reckon/peer/world/device_stiffness.hpp"
#include "reckon/peer/world/peer_view.hpp"

namespace reckon::tools {

/// Compares N hands with one another, and what peers show of other entities with where these are.
/// One thread.
class DemoMeasurement {
 public:
  /// @param hand the force model that all hands of the scene show to others.
  /// @param peers of each hand the peer that has it: hands of one peer do not feel each other.
  DemoMeasurement(std::vector<std::size_t> peers, const peer::HandModel& hand);

  /// One recorded servo step of hand `index`; times rise.
  void add_step(std::size_t index, const haptics::ServoSnapshot& step);
  /// What some peer showed of hand `owner`.
  void add_shown(std::size_t owner, const peer::ShownSample& sample);
  /// What some peer showed of an entity that no hand moves, which was at `position` [m] then.
  void add_shown_entity(const peer::ShownSample& sample, const Eigen::Vector3d& position);
  /// Who is who; IDs may change while a conflict is settled.
  void set_ids(std::span<const pdu::EntityId> ids) { ids_.assign(ids.begin(), ids.end()); }
  /// What the device of hand `index` can show; before the first evaluate(), else it has no limits.
  void set_device(std::size_t index, const peer::DeviceStiffness& device) {
    devices_[index] = device;
  }

  /// Evaluates all that has a truth to compare with by now.
  void evaluate();

  /// [m] shown remote position against the owner's at that instant, of hands and of what moves
  /// along a track or stands. No samples: nothing of others was shown.
  [[nodiscard]] peer::Spread pose_error() const { return pose_error_.spread(); }
  /// [N] rendered force between hands against the owner's full model at the same probe state, while
  /// either is not zero.
  [[nodiscard]] peer::Spread force_error() const { return force_error_.spread(); }
  /// [N] the same against as much of that model as the two devices can show: no stiffer than the
  /// softer of them holds, no stronger than the one that shows it pushes.
  [[nodiscard]] peer::Spread possible_force_error() const { return possible_error_.spread(); }
  /// [N] RMS of the same; 0 where no hands touched.
  [[nodiscard]] double force_error_rms() const;
  /// [J] least of every port's work + damping + received - given, and of the sum of all ports.
  [[nodiscard]] double energy_min() const { return energy_min_; }
  /// Greatest part of it that late steps account for [J], added over the ports.
  [[nodiscard]] double late_cost() const;
  /// Most that was lent to a port to hands that found one another inside [J].
  [[nodiscard]] double loan_most() const { return loan_most_; }
  /// [s] of hand-to-hand contact, on the static scene, and with entities that no hand moves, each
  /// summed over the hands: the lengths of their servo steps in contact.
  [[nodiscard]] double touching_hands() const { return touching_hands_; }
  [[nodiscard]] double touching_scene() const { return touching_scene_; }
  [[nodiscard]] double touching_entities() const { return touching_entities_; }
  [[nodiscard]] double peak_force() const { return peak_force_; }
  [[nodiscard]] std::uint64_t trips() const { return trips_; }

 private:
  struct Truth {
    std::chrono::nanoseconds time{0};
    Eigen::Vector3d device, scp, velocity;
    double energy = 0;  // work + damping of this port alone
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
  // All by hand.
  std::vector<std::size_t> peers_;
  std::vector<pdu::EntityId> ids_;
  std::vector<peer::DeviceStiffness> devices_;
  std::vector<Place> last_;         // step that was compared
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
