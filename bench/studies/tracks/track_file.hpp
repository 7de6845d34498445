// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recorded motion from a file: a CSV table or a capture of DIS traffic, one track for each entity.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reckon/bench/studies/tracks/track.hpp"

namespace reckon::bench {

/// What a file tells about motion.
struct TrackFile {
  std::string name;           ///< of the file, without its folder
  std::vector<Track> tracks;  ///< each with at least one sample
  std::string note;           ///< sentences about what a reader has to know; may be empty
  /// Whether the file itself tells orientations; else they are made up from the velocity, and
  /// their errors mean little.
  bool has_orientation = false;
  bool is_capture = false;
  bool damaged = false;  ///< a capture of which a part could not be read
};

/// Reads a CSV table (read_track_table) or, by its first octets, a capture (read_track_capture).
/// @throws UsageError or peer::CsvError with file, line, column and the remedy. Some 0.4 us a row
/// of a table.
[[nodiscard]] TrackFile read_track_file(const std::filesystem::path& path);

/// A CSV table with a header; columns in any order, unknown ones passed over:
///   t_s (needed), id;
///   x_m y_m [z_m], or px_m py_m [pz_m], or lat_deg lon_deg [height_m];
///   vx_mps vy_mps [vz_mps], or speed_mps heading_rad, or sog_kn cog_deg; an empty cell: not told;
///   psi_rad theta_rad phi_rad, or qw qx qy qz, or heading_rad (anticlockwise from +x).
/// Geodetic positions (WGS84) go through the geocentric frame into the plane that touches the
/// ellipsoid at the first one (x east, y north, z up there). That is a rotation and a shift, so
/// that distances and speeds stay exact however far; far away z is no longer up, and a level course
/// curves downwards. Velocities, headings and orientations of such rows are taken in east, north
/// and up of their own place. What is not told: see TrackBuilder.
[[nodiscard]] TrackFile read_track_table(const std::filesystem::path& path);

/// The Entity States of a capture (pcap, pcapng, also compressed; see open_recording), in a plane
/// near the first one. Time is that of the DIS timestamps where these grow and keep step with the
/// capture, else that of the capture; rates are as sent. This is the motion as it was told: what
/// lies between two updates is not in the file.
[[nodiscard]] TrackFile read_track_capture(const std::filesystem::path& path);

}  // namespace reckon::bench
