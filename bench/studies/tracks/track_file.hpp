// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recorded motion from a file: a CSV table or a capture of DIS traffic, one track for each entity.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reckon/bench/studies/tracks/track.hpp"

namespace reckon::bench {

/// The motion in a file.
struct TrackFile {
  std::string name;           ///< of the file, without its folder
  std::vector<Track> tracks;  ///< each with at least one sample
  std::string note;           ///< sentences for the reader of the results; may be empty
  /// Whether the file contains orientations; otherwise they are derived from the velocity, and
  /// their errors mean little.
  bool has_orientation = false;
  bool is_capture = false;
  bool damaged = false;  ///< part of a capture could not be read
};

/// Reads a CSV table (read_track_table) or, judged by its first octets, a capture
/// (read_track_capture).
/// @throws UsageError or peer::CsvError with file, line, column and the remedy. About 0.4 us a row
///     of a table.
[[nodiscard]] TrackFile read_track_file(const std::filesystem::path& path);

/// Reads a CSV table with a header. Columns may be in any order; unknown columns are ignored:
///   t_s (required), id;
///   x_m y_m [z_m], or px_m py_m [pz_m], or lat_deg lon_deg [height_m];
///   vx_mps vy_mps [vz_mps], or speed_mps heading_rad, or sog_kn cog_deg; an empty cell: no value;
///   psi_rad theta_rad phi_rad, or qw qx qy qz, or heading_rad (anticlockwise from +x). Geodetic
/// positions (WGS84) are converted through the geocentric frame into the tangent plane of the
/// ellipsoid at the first one (x east, y north, z up there). That is a rotation and a translation,
/// so that distances and speeds stay exact at any distance. Far away z is no longer up, and a level
/// course curves downwards. Velocities, headings and orientations of such rows are in east, north
/// and up at the position of the row. For missing values see TrackBuilder.
[[nodiscard]] TrackFile read_track_table(const std::filesystem::path& path);

/// Reads the Entity States of a capture (pcap, pcapng, also compressed; see open_recording), in a
/// plane near the first one. Times are the DIS timestamps if these increase and keep pace with the
/// capture, else the capture's times. Rates are as sent. The result is the motion as it was sent:
/// motion between two updates is not in the file.
[[nodiscard]] TrackFile read_track_capture(const std::filesystem::path& path);

}  // namespace reckon::bench
