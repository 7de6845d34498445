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
  std::uint16_t entity_number = 0;
  std::int16_t x_offset = 0;  ///< from the group's reference point [m]
  std::int16_t y_offset = 0;
  std::int16_t z_offset = 0;
  std::uint32_t entity_appearance = 0;
  std::int8_t psi = 0;
  std::int8_t theta = 0;
  std::int8_t phi = 0;
};

template <typename Visitor, Is<GroupedEntity> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  visitor("entity_number", record.entity_number);
  visitor("x_offset", record.x_offset);
  visitor("y_offset", record.y_offset);
  visitor("z_offset", record.z_offset);
  visitor("entity_appearance", record.entity_appearance);
  visitor("psi", record.psi);
  visitor("theta", record.theta);
  visitor("phi", record.phi);
}

/// Basic ground combat vehicle (1).
struct GroupedVehicle {
  GroupedEntity entity;
  std::int8_t speed = 0;
  std::int8_t turret_azimuth = 0;
  std::int8_t gun_elevation = 0;
  std::int8_t turret_slew_rate = 0;
  std::int8_t gun_elevation_rate = 0;
};

template <typename Visitor, Is<GroupedVehicle> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  fields(visitor, record.entity);
  visitor("speed", record.speed);
  visitor("turret_azimuth", record.turret_azimuth);
  visitor("gun_elevation", record.gun_elevation);
  visitor("turret_slew_rate", record.turret_slew_rate);
  visitor("gun_elevation_rate", record.gun_elevation_rate);
}
static_assert(kFixedSize<GroupedVehicle> == 20);

/// Basic ground combat soldier (3).
struct GroupedSoldier {
  GroupedEntity entity;
  std::int8_t speed = 0;
  std::int8_t head_azimuth = 0;
  std::int8_t head_elevation = 0;
  std::int8_t head_scan_rate = 0;
  std::int8_t head_elevation_rate = 0;
};

template <typename Visitor, Is<GroupedSoldier> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  fields(visitor, record.entity);
  visitor("speed", record.speed);
  visitor("head_azimuth", record.head_azimuth);
  visitor("head_elevation", record.head_elevation);
  visitor("head_scan_rate", record.head_scan_rate);
  visitor("head_elevation_rate", record.head_elevation_rate);
}
static_assert(kFixedSize<GroupedSoldier> == 20);

/// Basic fixed wing aircraft (7).
struct GroupedAircraft {
  GroupedEntity entity;
  std::uint8_t fuel_status = 0;
  std::int8_t movement_horizontal_deviation = 0;
  std::int8_t movement_vertical_deviation = 0;
  std::int16_t movement_speed = 0;
};

template <typename Visitor, Is<GroupedAircraft> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  fields(visitor, record.entity);
  visitor("fuel_status", record.fuel_status);
  visitor("movement_horizontal_deviation", record.movement_horizontal_deviation);
  visitor("movement_vertical_deviation", record.movement_vertical_deviation);
  visitor("movement_speed", record.movement_speed);
}
static_assert(kFixedSize<GroupedAircraft> == 20);

/// Basic rotor wing aircraft (5).
struct GroupedHelicopter {
  GroupedAircraft aircraft;
  std::int8_t turret_azimuth = 0;
  std::int8_t gun_elevation = 0;
  std::int8_t turret_scan_rate = 0;
  std::int8_t gun_elevation_rate = 0;
};

template <typename Visitor, Is<GroupedHelicopter> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  fields(visitor, record.aircraft);
  visitor("turret_azimuth", record.turret_azimuth);
  visitor("gun_elevation", record.gun_elevation);
  visitor("turret_scan_rate", record.turret_scan_rate);
  visitor("gun_elevation_rate", record.gun_elevation_rate);
}
static_assert(kFixedSize<GroupedHelicopter> == 24);

/// Ground logistics vehicle (9).
struct GroupedLogistics {
  GroupedEntity entity;
  std::int8_t speed = 0;
};

template <typename Visitor, Is<GroupedLogistics> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  fields(visitor, record.entity);
  visitor("speed", record.speed);
}
static_assert(kFixedSize<GroupedLogistics> == 16);

/// Additional fields of the enhanced kinds (2, 4, 6, 8), behind the fields of the basic kinds.
struct GroupedVehicleStores {
  GroupedVehicle basic;
  std::uint8_t fuel_status = 0;
  std::uint8_t ground_maintenance_status = 0;
  std::uint8_t primary_ammunition = 0;
  std::uint8_t secondary_ammunition = 0;
};

template <typename Visitor, Is<GroupedVehicleStores> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  fields(visitor, record.basic);
  visitor("fuel_status", record.fuel_status);
  visitor("ground_maintenance_status", record.ground_maintenance_status);
  visitor("primary_ammunition", record.primary_ammunition);
  visitor("secondary_ammunition", record.secondary_ammunition);
}
static_assert(kFixedSize<GroupedVehicleStores> == 24);

struct GroupedSoldierStores {
  GroupedSoldier basic;
  std::uint8_t water_status = 0;
  std::uint8_t rest_status = 0;
  std::uint8_t primary_ammunition = 0;
  std::uint8_t secondary_ammunition = 0;
};

template <typename Visitor, Is<GroupedSoldierStores> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  fields(visitor, record.basic);
  visitor("water_status", record.water_status);
  visitor("rest_status", record.rest_status);
  visitor("primary_ammunition", record.primary_ammunition);
  visitor("secondary_ammunition", record.secondary_ammunition);
}
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

template <typename Visitor, IsOneOf<GroupedHelicopterStores, GroupedAircraftStores> Record>
constexpr void fields(Visitor& visitor, Record& record) {
  fields(visitor, record.basic);
  visitor("supplemental_fuel_status", record.supplemental_fuel_status);
  visitor("air_maintenance_status", record.air_maintenance_status);
  visitor("primary_ammunition", record.primary_ammunition);
  visitor("secondary_ammunition", record.secondary_ammunition);
}
static_assert(kFixedSize<GroupedHelicopterStores> == 28);
static_assert(kFixedSize<GroupedAircraftStores> == 24);

}  // namespace reckon::pdu
