// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/mesh_repair.hpp"

#include <algorithm>
#include <cstring>
#include <tuple>
#include <unordered_map>

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

struct PositionHash {
  std::size_t operator()(const Vector3d& p) const noexcept {
    std::uint64_t hash = 1469598103934665603ull;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double value = p[i] + 0.0;  // -0 becomes 0
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15ull;
      hash ^= hash >> 29;
    }
    return static_cast<std::size_t>(hash);
  }
};

}  // namespace

void weld(TriangleSoup& soup, MeshReport& report) {
  std::unordered_map<Vector3d, std::uint32_t, PositionHash> first;
  first.reserve(soup.vertices.size());
  std::vector<std::uint32_t> same(soup.vertices.size());
  for (std::uint32_t i = 0; i < soup.vertices.size(); ++i) {
    same[i] = first.emplace(soup.vertices[i], i).first->second;
  }
  for (SoupTriangle& triangle : soup.triangles) {
    for (std::uint32_t& corner : triangle.corners) corner = same[corner];
  }
  report.vertices = first.size();
  report.merged_vertices = soup.vertices.size() - first.size();
}

void drop_collapsed(TriangleSoup& soup, MeshReport& report) {
  std::erase_if(soup.triangles, [&](const SoupTriangle& triangle) {
    const auto& t = triangle.corners;
    const bool collapsed = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
    if (collapsed) report.dropped_degenerate.add(triangle.place);
    return collapsed;
  });
}

void drop_duplicates(TriangleSoup& soup, MeshReport& report) {
  struct Row {
    std::array<std::uint32_t, 3> corners;  // ascending
    std::uint32_t triangle;
  };
  std::vector<Row> rows;
  rows.reserve(soup.triangles.size());
  for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) {
    Row& row = rows.emplace_back(Row{soup.triangles[i].corners, i});
    std::ranges::sort(row.corners);
  }
  std::ranges::sort(rows, {}, [](const Row& row) {
    return std::tuple(row.corners[0], row.corners[1], row.corners[2], row.triangle);
  });
  std::vector<bool> twice(rows.size());
  for (std::size_t i = 1; i < rows.size(); ++i) {
    twice[rows[i].triangle] = rows[i].corners == rows[i - 1].corners;
  }
  std::size_t index = 0;
  std::erase_if(soup.triangles, [&](const SoupTriangle& triangle) {
    const bool drop = twice[index++];
    if (drop) report.dropped_duplicates.add(triangle.place);
    return drop;
  });
}

}  // namespace reckon::haptics
