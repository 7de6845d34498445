// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Grouped Entity Description records of an IsGroupOf PDU, one kind for each grouped entity category
// (UID 213). Angles are in units of 25 mrad, rates in 25 mrad/s, speeds in m/s.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"

namespace reckon::pdu {

/// The fields that all kinds begin with. The entity has the site and application of the group.
struct GroupedEntity {
  static constexpr bool kInlined = true;
  std::uint16_t entity_number = 0;
  std::int16_t x_offset = 0;  ///< from the group's reference point [m]
  std::int16_t y_offset = 0;
  std::int16_t z_offset = 0;
  std::uint32_t entity_appearance = 0;
  std::int8_t psi = 0;
  std::int8_t theta = 0;
  std::int8_t phi = 0;
};

/// Basic ground combat vehicle (1).
struct GroupedVehicle {
  static constexpr bool kInlined = true;
  GroupedEntity entity;
  std::int8_t speed = 0;
  std::int8_t turret_azimuth = 0;
  std::int8_t gun_elevation = 0;
  std::int8_t turret_slew_rate = 0;
  std::int8_t gun_elevation_rate = 0;
};
static_assert(kFixedSize<GroupedVehicle> == 20);

/// Basic ground combat soldier (3).
struct GroupedSoldier {
  static constexpr bool kInlined = true;
  GroupedEntity entity;
  std::int8_t speed = 0;
  std::int8_t head_azimuth = 0;
  std::int8_t head_elevation = 0;
  std::int8_t head_scan_rate = 0;
  std::int8_t head_elevation_rate = 0;
};
static_assert(kFixedSize<GroupedSoldier> == 20);

/// Basic fixed wing aircraft (7).
struct GroupedAircraft {
  static constexpr bool kInlined = true;
  GroupedEntity entity;
  std::uint8_t fuel_status = 0;
  std::int8_t movement_horizontal_deviation = 0;
  std::int8_t movement_vertical_deviation = 0;
  std::int16_t movement_speed = 0;
};
static_assert(kFixedSize<GroupedAircraft> == 20);

/// Basic rotor wing aircraft (5).
struct GroupedHelicopter {
  static constexpr bool kInlined = true;
  GroupedAircraft aircraft;
  std::int8_t turret_azimuth = 0;
  std::int8_t gun_elevation = 0;
  std::int8_t turret_scan_rate = 0;
  std::int8_t gun_elevation_rate = 0;
};
static_assert(kFixedSize<GroupedHelicopter> == 24);

/// Ground logistics vehicle (9).
struct GroupedLogistics {
  GroupedEntity entity;
  std::int8_t speed = 0;
};
static_assert(kFixedSize<GroupedLogistics> == 16);

/// Additional fields of the enhanced kinds (2, 4, 6, 8), behind the fields of the basic kinds.
struct GroupedVehicleStores {
  GroupedVehicle basic;
  std::uint8_t fuel_status = 0;
  std::uint8_t ground_maintenance_status = 0;
  std::uint8_t primary_ammunition = 0;
  std::uint8_t secondary_ammunition = 0;
};
static_assert(kFixedSize<GroupedVehicleStores> == 24);

struct GroupedSoldierStores {
  GroupedSoldier basic;
  std::uint8_t water_status = 0;
  std::uint8_t rest_status = 0;
  std::uint8_t primary_ammunition = 0;
  std::uint8_t secondary_ammunition = 0;
};
static_assert(kFixedSize<GroupedSoldierStores> == 24);

struct GroupedHelicopterStores {
  GroupedHelicopter basic;
  std::uint8_t supplemental_fuel_status = 0;
  std::uint8_t air_maintenance_status = 0;
  std::uint8_t primary_ammunition = 0;
  std::uint8_t secondary_ammunition = 0;
};

struct GroupedAircraftStores {
  GroupedAircraft basic;
  std::uint8_t supplemental_fuel_status = 0;
  std::uint8_t air_maintenance_status = 0;
  std::uint8_t primary_ammunition = 0;
  std::uint8_t secondary_ammunition = 0;
};
static_assert(kFixedSize<GroupedHelicopterStores> == 28);
static_assert(kFixedSize<GroupedAircraftStores> == 24);

}  // namespace reckon::pdu
