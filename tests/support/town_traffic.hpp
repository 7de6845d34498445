// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Vehicles of a town, recorded once a second (vehicles_town_sumo.csv of the optional reference
// data), as the true motion of any number of entities: the same town is repeated elsewhere.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "reckon/peer/tracks/csv_reader.hpp"
#include "reckon/peer/tracks/entity_track.hpp"
#include "reckon/peer/world/tracked_entities.hpp"

namespace reckon::test {

/// Path in the folder of reference data.
inline constexpr const char* kTownTraffic = "trajectories/vehicles_town_sumo.csv";

/// Motions of `count` entities: vehicles present from beginning to end, then the same 5 km farther
/// east, and so on. @throws peer::CsvError
inline std::vector<peer::EntityTrack> town_traffic(const std::filesystem::path& file,
                                                   std::size_t count) {
  peer::CsvReader rows(file);
  const auto column = [&](const char* name) { return rows.find(name).value(); };
  const std::size_t t = column("t_s"), id = column("id"), x = column("x_m"), y = column("y_m");
  const std::size_t heading = column("heading_rad");
  std::map<int, peer::TrackSamples> vehicles;
  double last = 0;
  while (rows.next()) {
    peer::TrackSamples& vehicle = vehicles[static_cast<int>(rows.required(id))];
    last = rows.required(t);
    vehicle.times.push_back(last);
    vehicle.positions.emplace_back(rows.required(x), rows.required(y), 0.0);
    // Axes: forward, right, down to east, north, up.
    vehicle.orientations.push_back(
        Eigen::AngleAxisd(rows.required(heading), Eigen::Vector3d::UnitZ()) *
        Eigen::Quaterniond(0, 1, 0, 0));
  }
  std::vector<std::shared_ptr<const peer::TrackCurve>> curves;
  for (auto& [number, vehicle] : vehicles) {
    if (curves.size() == count) break;
    if (vehicle.times.front() > 0 || vehicle.times.back() < last) continue;
    curves.push_back(std::make_shared<peer::TrackCurve>(std::move(vehicle), true));
  }
  std::vector<peer::EntityTrack> tracks;
  for (std::size_t i = 0; i < count; ++i) {
    const double east = 5000.0 * static_cast<double>(i / curves.size());  // [m]
    tracks.emplace_back(curves[i % curves.size()], Eigen::Vector3d(east, 0, 0));
  }
  return tracks;
}

}  // namespace reckon::test
