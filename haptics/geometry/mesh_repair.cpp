// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/mesh_repair.hpp"

#include <algorithm>
#include <compare>
#include <span>
#include <utility>

#include "reckon/haptics/geometry/vertex_corners.hpp"
#include "reckon/haptics/mesh_files/position_table.hpp"

namespace reckon::haptics {

using Eigen::Vector3d;

void weld(TriangleSoup& soup, MeshReport& report) {
  std::vector<Vector3d> different;
  std::vector<std::uint32_t> numbers;
  numbers.reserve(soup.vertices.size());
  PositionTable table(different, soup.vertices.size());
  constexpr std::size_t kFetchedVertices = 12;  // vertices, for the memory to arrive
  for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
    if (i + kFetchedVertices < soup.vertices.size())
      table.fetch(soup.vertices[i + kFetchedVertices]);
    numbers.push_back(table.number_of(soup.vertices[i]));
  }
  report.vertices = different.size();
  report.merged_vertices += soup.vertices.size() - different.size();
  if (different.size() == soup.vertices.size()) return;
  for (SoupTriangle& triangle : soup.triangles) {
    for (std::uint32_t& corner : triangle.corners) corner = numbers[corner];
  }
  soup.vertices = std::move(different);
}

void drop_collapsed(TriangleSoup& soup, MeshReport& report) {
  std::erase_if(soup.triangles, [&](const SoupTriangle& triangle) {
    const auto& t = triangle.corners;
    const bool collapsed = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
    if (collapsed) report.dropped_degenerate.add(triangle.place);
    return collapsed;
  });
}

namespace {

/// A triangle, by the two greater of its corners.
struct Row {
  std::uint32_t middle, last, triangle;
  auto operator<=>(const Row&) const = default;
};

/// Those of a vertex's triangles of which it is the least corner.
void list_rows(const TriangleSoup& soup, std::span<const std::uint32_t> corners,
               std::uint32_t vertex, std::vector<Row>& rows) {
  rows.clear();
  for (const std::uint32_t corner : corners) {
    const auto& t = soup.triangles[corner / 3].corners;
    const std::uint32_t next = t[(corner + 1) % 3], before = t[(corner + 2) % 3];
    if (vertex > next || vertex > before) continue;
    rows.push_back({std::min(next, before), std::max(next, before), corner / 3});
  }
}

}  // namespace

bool drop_duplicates(TriangleSoup& soup, const VertexCorners& corners, MeshReport& report) {
  std::vector<bool> twice(soup.triangles.size());
  std::vector<Row> rows;
  bool any = false;
  corners.visit_all(soup, [&](std::uint32_t vertex, std::span<const std::uint32_t> around) {
    list_rows(soup, around, vertex, rows);
    std::ranges::sort(rows);
    for (std::size_t i = 1; i < rows.size(); ++i) {
      if (rows[i].middle != rows[i - 1].middle || rows[i].last != rows[i - 1].last) continue;
      any = twice[rows[i].triangle] = true;
    }
  });
  if (!any) return false;
  std::size_t index = 0;
  std::erase_if(soup.triangles, [&](const SoupTriangle& triangle) {
    const bool drop = twice[index++];
    if (drop) report.dropped_duplicates.add(triangle.place);
    return drop;
  });
  return true;
}

}  // namespace reckon::haptics
