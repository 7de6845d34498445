// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/pdu_map.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <utility>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/pdu_types.hpp"
#include "reckon/tools/captures/placed_fields.hpp"

namespace reckon::tools {
namespace {

using pdu::Vector3Float;
using pdu::WorldCoordinates;

/// THE axes of vectors and angles; a field name has the same meaning in all PDUs.
constexpr auto kAxes = std::to_array<std::pair<std::string_view, VectorAxes>>({
    {"entity_linear_velocity", VectorAxes::model},
    {"entity_linear_acceleration", VectorAxes::model},
    {"velocity", VectorAxes::world},
    {"contact_velocity", VectorAxes::world},
    {"unit_surface_normal", VectorAxes::world},
    {"spot_linear_acceleration", VectorAxes::world},
    {"entity_angular_velocity", VectorAxes::another},
    {"location", VectorAxes::another},
    {"location_in_entity_coordinates", VectorAxes::another},
    {"location_of_impact", VectorAxes::another},
    {"part_location", VectorAxes::another},
    {"dimensions", VectorAxes::another},
    {"relative_antenna_location", VectorAxes::another},
    {"aperture_emitter_location", VectorAxes::another},
    {"designator_spot_with_respect_to_designated_entity", VectorAxes::another},
    {"sigma", VectorAxes::another},
    {"lengths", VectorAxes::another},
    {"point", VectorAxes::another},
    {"normal", VectorAxes::another},
    {"mine_locations", VectorAxes::another},
    {"wire_vertices", VectorAxes::another},
});

constexpr std::uint8_t kBeamInWorldAxes = 1;  // UID 168

Eigen::Vector3d vector_of(const WorldCoordinates& p) { return {p.x, p.y, p.z}; }

bool is_place(const WorldCoordinates& p) {
  const Eigen::Vector3d v = vector_of(p);
  return v.allFinite() && v != Eigen::Vector3d::Zero();
}

/// Visitor of placed fields that writes the new values.
class Writer {
 public:
  Writer(std::span<std::byte> pdu, const IdMap& ids, const PlaceShift* shift, bool body_axes)
      : pdu_(pdu), ids_(ids), shift_(shift), body_axes_(body_axes) {}

  /// All other records and numbers.
  template <typename T>
  void operator()(std::string_view, const T&, std::size_t) {}
  void operator()(std::string_view, const pdu::EntityId& id, std::size_t at) { put(ids_(id), at); }
  void operator()(std::string_view, const pdu::SimulationAddress& address, std::size_t at) {
    put(ids_(address), at);
  }
  void operator()(std::string_view, const pdu::EventId& id, std::size_t at) {
    put(ids_(pdu::SimulationAddress{id.site, id.application}), at);
  }
  void operator()(std::string_view, const pdu::LiveEntityId& id, std::size_t at) {
    const pdu::EntityId to = ids_(pdu::EntityId{id.site, id.application, id.entity});
    if (fits(to.site, to.application))
      put(pdu::LiveEntityId{static_cast<std::uint8_t>(to.site),
                            static_cast<std::uint8_t>(to.application), to.entity},
          at);
  }
  void operator()(std::string_view, const pdu::LiveSimulationAddress& address, std::size_t at) {
    const pdu::SimulationAddress to =
        ids_(pdu::SimulationAddress{address.site, address.application});
    if (fits(to.site, to.application))
      put(pdu::LiveSimulationAddress{static_cast<std::uint8_t>(to.site),
                                     static_cast<std::uint8_t>(to.application)},
          at);
  }

  void operator()(std::string_view, const WorldCoordinates& p, std::size_t at) {
    if (shift_ == nullptr || !is_place(p)) return;
    const Eigen::Vector3d moved = shift_->point(vector_of(p));
    put(WorldCoordinates{moved.x(), moved.y(), moved.z()}, at);
  }
  void operator()(std::string_view name, const Vector3Float& v, std::size_t at) {
    const VectorAxes axes = axes_of(name).value_or(VectorAxes::another);
    const bool turns = axes == VectorAxes::world || (axes == VectorAxes::model && !body_axes_);
    const Eigen::Vector3d vector(v.x, v.y, v.z);
    if (shift_ == nullptr || !turns || !vector.allFinite()) return;
    const Eigen::Vector3f turned = shift_->vector(vector).cast<float>();
    put(Vector3Float{turned.x(), turned.y(), turned.z()}, at);
  }
  void operator()(std::string_view name, const pdu::EulerAngles& angles, std::size_t at) {
    const bool turns = name != "beam_direction" || beam_in_world_axes_;
    const Eigen::Vector3d all(angles.psi, angles.theta, angles.phi);
    if (shift_ == nullptr || !turns || is_grid_ || !all.allFinite()) return;
    const deadreckon::Euler turned = deadreckon::euler_from_quaternion(shift_->orientation(
        deadreckon::quaternion_from_euler({angles.psi, angles.theta, angles.phi})));
    put(pdu::EulerAngles{static_cast<float>(turned.psi), static_cast<float>(turned.theta),
                         static_cast<float>(turned.phi)},
        at);
  }
  void operator()(std::string_view, const pdu::BeamAntennaPattern& beam, std::size_t) {
    beam_in_world_axes_ = beam.reference_system == kBeamInWorldAxes;
  }
  void operator()(std::string_view, const pdu::CollisionIntermediateResult& k, std::size_t at) {
    if (shift_ == nullptr) return;
    Eigen::Matrix3d matrix;
    matrix << k.xx, k.xy, k.xz, k.xy, k.yy, k.yz, k.xz, k.yz, k.zz;
    if (!matrix.allFinite()) return;
    const Eigen::Matrix3d turn = shift_->rotation();
    const Eigen::Matrix3f turned = (turn * matrix * turn.transpose()).cast<float>();
    put(pdu::CollisionIntermediateResult{turned(0, 0), turned(0, 1), turned(0, 2), turned(1, 1),
                                         turned(1, 2), turned(2, 2)},
        at);
  }
  void operator()(std::string_view, const pdu::RelativeWorldCoordinates&, std::size_t) {
    done_.kept_place = true;
  }

  void octets(std::string_view name, std::span<const std::byte> view) {
    const bool is_padding = name.find("padding") != std::string_view::npos;
    done_.has_octets = done_.has_octets || (!view.empty() && !is_padding);
  }
  /// A grid has its own coordinates.
  void set_grid() { is_grid_ = done_.kept_place = true; }
  void set_kept_place() { done_.kept_place = true; }
  [[nodiscard]] const MappedPdu& done() const { return done_; }

 private:
  void put(const auto& record, std::size_t at) {
    (void)pdu::store_record(record, pdu_.subspan(at));
  }
  bool fits(std::uint16_t site, std::uint16_t application) {
    const bool good = site <= 0xFF && application <= 0xFF;
    done_.kept_id = done_.kept_id || !good;
    return good;
  }

  std::span<std::byte> pdu_;
  const IdMap& ids_;
  const PlaceShift* shift_;
  bool body_axes_;
  bool beam_in_world_axes_ = false;
  bool is_grid_ = false;
  MappedPdu done_;
};

/// Visitor of placed fields that finds the first place.
struct PlaceFinder {
  template <typename T>
  void operator()(std::string_view, const T&, std::size_t) {}
  void operator()(std::string_view, const WorldCoordinates& p, std::size_t) {
    if (!found.has_value() && is_place(p)) found = vector_of(p);
  }
  void octets(std::string_view, std::span<const std::byte>) {}

  std::optional<Eigen::Vector3d> found;
};

}  // namespace

std::optional<VectorAxes> axes_of(std::string_view field) {
  const auto* row =
      std::ranges::find(kAxes, field, &std::pair<std::string_view, VectorAxes>::first);
  if (row == kAxes.end()) return std::nullopt;
  return row->second;
}

MappedPdu map_pdu(std::span<std::byte> octets, const pdu::PduHeader& header, const IdMap& ids,
                  const PlaceShift* shift, bool body_axes) {
  MappedPdu done;
  done.error = pdu::visit(octets, header, [&]<typename Pdu>(const Pdu& pdu) {
    if constexpr (std::same_as<Pdu, pdu::EntityState>)
      body_axes = deadreckon::drm_terms(pdu.dead_reckoning.algorithm).body_axes;
    Writer writer(octets, ids, shift, body_axes);
    if constexpr (std::same_as<Pdu, pdu::GriddedData>) writer.set_grid();
    if constexpr (std::same_as<Pdu, pdu::CompressedStates> ||
                  std::same_as<Pdu, pdu::CellSnapshot> || std::same_as<Pdu, pdu::AssuredRecord>)
      writer.set_kept_place();
    PlacedFields placed(octets, writer);
    fields(placed, pdu);
    done = writer.done();
  });
  return done;
}

std::optional<Eigen::Vector3d> first_place(std::span<const std::byte> octets,
                                           const pdu::PduHeader& header) {
  PlaceFinder finder;
  (void)pdu::visit(octets, header, [&](const auto& pdu) {
    PlacedFields placed(octets, finder);
    fields(placed, pdu);
  });
  return finder.found;
}

}  // namespace reckon::tools
