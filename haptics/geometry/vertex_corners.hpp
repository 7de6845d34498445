// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The corners of triangles at each vertex. Private to the repair of meshes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/haptics/geometry/mesh_repair.hpp"

namespace reckon::haptics {

/// A corner is 3 times its triangle plus its place in it. 12 octets a triangle and 4 a vertex; a
/// counting sort, linear in both.
class VertexCorners {
 public:
  VertexCorners() = default;
  /// @param soup at most kMostTriangles
  explicit VertexCorners(const TriangleSoup& soup)
      : ends_(soup.vertices.size(), 0), corners_(3 * soup.triangles.size()) {
    for (const SoupTriangle& triangle : soup.triangles) {
      for (const std::uint32_t vertex : triangle.corners) ++ends_[vertex];
    }
    std::uint32_t begin = 0;
    for (std::uint32_t& end : ends_) {
      const std::uint32_t count = end;
      end = begin;
      begin += count;
    }
    std::uint32_t corner = 0;
    for (const SoupTriangle& triangle : soup.triangles) {
      for (const std::uint32_t vertex : triangle.corners) corners_[ends_[vertex]++] = corner++;
    }
  }

  /// Ascending.
  [[nodiscard]] std::span<const std::uint32_t> at(std::size_t vertex) const noexcept {
    const std::uint32_t begin = vertex == 0 ? 0 : ends_[vertex - 1];
    return std::span(corners_).subspan(begin, ends_[vertex] - begin);
  }
  /// Visits the vertices in order: visit(vertex, at(vertex)). Their triangles are fetched from
  /// memory some vertices before.
  void visit_all(const TriangleSoup& soup, auto&& visit) const {
    constexpr std::size_t kFetched = 8;
    for (std::uint32_t vertex = 0; vertex < ends_.size(); ++vertex) {
      if (vertex + kFetched < ends_.size()) {
        for (const std::uint32_t corner : at(vertex + kFetched))
          __builtin_prefetch(&soup.triangles[corner / 3]);
      }
      visit(vertex, at(vertex));
    }
  }

 private:
  std::vector<std::uint32_t> ends_;  // of each vertex in corners_
  std::vector<std::uint32_t> corners_;
};

}  // namespace reckon::haptics
