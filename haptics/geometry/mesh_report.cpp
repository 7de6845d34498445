// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/mesh_report.hpp"

#include <array>
#include <cstdio>

namespace reckon::haptics {

namespace {

// A hand moves within about a metre, and within half of that on the largest desk-top devices.
constexpr double kLargest = 10.0;
// A tenth of the smallest probe radius of a hand.
constexpr double kSmallest = 1e-3;

std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return std::to_string(count).append(" ").append(count == 1 ? one : many);
}

std::string number_text(double value, const char* unit) {
  std::array<char, 48> text;
  std::snprintf(text.data(), text.size(), "%.4g %s", value, unit);
  return text.data();
}

std::string extent_text(const Eigen::Vector3d& extent) {
  const double largest = extent.maxCoeff();
  const bool small = largest < 1.0;
  std::array<char, 96> text;
  const Eigen::Vector3d shown = small ? Eigen::Vector3d(1e3 * extent) : extent;
  std::snprintf(text.data(), text.size(), "%.4g x %.4g x %.4g %s", shown.x(), shown.y(), shown.z(),
                small ? "mm" : "m");
  return text.data();
}

/// " (first: line 17)"
std::string place_text(const MeshReport& report, const MeshFinding& finding) {
  if (finding.first == 0) return {};
  return std::string(" (first: ")
      .append(report.place_word)
      .append(" ")
      .append(std::to_string(finding.first))
      .append(")");
}

void note_size(const MeshReport& report, std::vector<std::string>& notes) {
  const double size = report.extent.norm();
  if (size > kLargest) {
    notes.push_back(
        "is " + length_text(size) +
        " large, and a hand reaches about 1 m: if its unit is the millimetre, write scale_to = \"" +
        length_text(1e-3 * size) + "\"");
  }
  if (size < kSmallest) {
    notes.push_back(
        "is only " + length_text(size) +
        " large, too small to feel: write the intended diagonal as scale_to, such as \"200 mm\"");
  }
}

void note_octets(const MeshReport& report, std::vector<std::string>& notes) {
  if (report.octets_behind == 0) return;
  notes.push_back(counted(report.octets_behind, "octet", "octets") + " after the " +
                  counted(report.faces, "face", "faces") +
                  " of the file's count were not read; export it again if faces are missing");
}

void note_drops(const MeshReport& report, std::vector<std::string>& notes) {
  if (const MeshFinding& found = report.dropped_degenerate; found.count > 0) {
    notes.push_back(
        counted(found.count, "triangle without area was", "triangles without area were") +
        " dropped" + place_text(report, found) + "; neighbours cover the gap");
  }
  if (const MeshFinding& found = report.dropped_duplicates; found.count > 0) {
    notes.push_back(counted(found.count, "triangle was", "triangles were") +
                    " dropped, because another has the same corners" + place_text(report, found));
  }
}

void note_sides(const MeshReport& report, std::vector<std::string>& notes) {
  if (const MeshFinding& found = report.turned; found.count > 0) {
    notes.push_back(counted(found.count, "triangle", "triangles") +
                    " had the opposite orientation of the neighbours and " +
                    (found.count == 1 ? "was" : "were") + " turned" + place_text(report, found));
  }
  if (report.inward_pieces > 0) {
    notes.push_back(std::to_string(report.inward_pieces) + " of " +
                    counted(report.pieces, "piece", "pieces") + " faced inwards; turned outwards");
  }
  if (report.one_sided_edges > 0) {
    notes.push_back("has no consistent outside, like a Moebius strip: triangles disagree at " +
                    counted(report.one_sided_edges, "edge", "edges") + "; both sides are felt");
  }
}

void note_openings(const MeshReport& report, std::vector<std::string>& notes) {
  if (const MeshFinding& found = report.boundary_edges; found.count > 0) {
    std::string text =
        "is open: " + counted(found.count, "edge", "edges") + " of one triangle only";
    if (report.holes > 0) text += ", round " + counted(report.holes, "hole", "holes");
    notes.push_back(text + place_text(report, found) +
                    "; both sides are felt, and it has no inside; close it to make it solid");
  }
  if (const MeshFinding& found = report.non_manifold_edges; found.count > 0) {
    notes.push_back("has " + counted(found.count, "edge", "edges") + " of three or more triangles" +
                    place_text(report, found) +
                    "; all are felt from both sides, and it has no inside; separate the pieces "
                    "that meet there to make it solid");
  }
  if (const MeshFinding& found = report.non_manifold_vertices; found.count > 0) {
    notes.push_back("has " + counted(found.count, "corner", "corners") +
                    " where surfaces meet in one point only" + place_text(report, found) +
                    "; they are felt as drawn");
  }
}

}  // namespace

std::string length_text(double metres) {
  if (metres >= 1e4) return number_text(1e-3 * metres, "km");
  if (metres >= 1.0) return number_text(metres, "m");
  return metres >= 1e-3 ? number_text(1e3 * metres, "mm") : number_text(1e6 * metres, "um");
}

std::string mesh_summary(const MeshReport& report) {
  std::string text = extent_text(report.extent) + ", " +
                     counted(report.triangles, "triangle", "triangles") + ", " +
                     (report.closed ? "closed" : "open, both sides felt");
  if (report.pieces > 1) text += ", " + std::to_string(report.pieces) + " pieces";
  std::string mended;
  if (report.polygons.count > 0) {
    mended += ", " + counted(report.polygons.count, "polygon", "polygons") + " cut";
  }
  if (report.merged_vertices > 0) {
    mended += ", " + counted(report.merged_vertices, "vertex", "vertices") + " merged";
  }
  if (!mended.empty()) text += "; " + mended.substr(2);
  return text;
}

std::vector<std::string> mesh_notes(const MeshReport& report) {
  std::vector<std::string> notes;
  note_size(report, notes);
  note_octets(report, notes);
  note_drops(report, notes);
  note_sides(report, notes);
  note_openings(report, notes);
  return notes;
}

}  // namespace reckon::haptics
