// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/triangle_list.hpp"

#include "reckon/haptics/geometry/mesh_repair.hpp"

namespace reckon::haptics {

TriangleList::TriangleList(TriangleSoup& soup, std::span<const std::uint32_t> order) {
  constexpr std::uint32_t kNew = 0xffffffffu;
  corners_.reserve(order.size());
  vertices_.reserve(soup.vertices.size());
  std::vector<std::uint32_t> numbers(soup.vertices.size(), kNew);
  constexpr std::size_t kFetchedTriangles = 16;  // triangles, for the memory to arrive
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i + kFetchedTriangles < order.size())
      __builtin_prefetch(&soup.triangles[order[i + kFetchedTriangles]]);
    std::array<std::uint32_t, 3>& corners = corners_.emplace_back(soup.triangles[order[i]].corners);
    for (std::uint32_t& corner : corners) {
      std::uint32_t& number = numbers[corner];
      if (number == kNew) {
        number = static_cast<std::uint32_t>(vertices_.size());
        vertices_.push_back(soup.vertices[corner]);
      }
      corner = number;
    }
  }
  soup.triangles = std::vector<SoupTriangle>();
  soup.vertices = std::vector<Eigen::Vector3d>();
  numbers = std::vector<std::uint32_t>();
  normals_.reserve(order.size());
  for (const std::array<std::uint32_t, 3>& t : corners_) {
    const Eigen::Vector3d& a = vertices_[t[0]];
    normals_.push_back((vertices_[t[1]] - a).cross(vertices_[t[2]] - a).normalized());
  }
}

}  // namespace reckon::haptics
