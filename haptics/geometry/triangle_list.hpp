// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The triangles of a mesh, which share their vertices.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

#include "reckon/haptics/geometry/triangle_query.hpp"

namespace reckon::haptics {

struct TriangleSoup;

/// Made once. 36 octets a triangle and 24 a vertex; a closed mesh has half as many vertices as
/// triangles. Vertices are stored in the order of the triangles, so that neighbours share cache
/// lines.
class TriangleList {
 public:
  /// Reads only.
  class Iterator {
   public:
    using value_type = Triangle;
    using difference_type = std::ptrdiff_t;
    using iterator_concept = std::input_iterator_tag;

    Iterator() = default;
    Iterator(const TriangleList& list, std::size_t index) noexcept : list_(&list), index_(index) {}
    Triangle operator*() const noexcept { return (*list_)[index_]; }
    Iterator& operator++() noexcept {
      ++index_;
      return *this;
    }
    void operator++(int) noexcept { ++index_; }
    bool operator==(const Iterator& other) const noexcept { return index_ == other.index_; }

   private:
    const TriangleList* list_ = nullptr;
    std::size_t index_ = 0;
  };

  TriangleList() = default;
  /// Takes the triangles of `soup` in the order of these indices, and frees its lists.
  TriangleList(TriangleSoup& soup, std::span<const std::uint32_t> order);

  [[nodiscard]] std::size_t size() const noexcept { return corners_.size(); }
  [[nodiscard]] bool empty() const noexcept { return corners_.empty(); }
  [[nodiscard]] Triangle operator[](std::size_t index) const noexcept {
    const TriangleView t = view(index);
    return {t.a, t.b, t.c, t.normal};
  }
  /// The same without a copy.
  [[nodiscard]] TriangleView view(std::size_t index) const noexcept {
    const std::array<std::uint32_t, 3>& t = corners_[index];
    return {vertices_[t[0]], vertices_[t[1]], vertices_[t[2]], normals_[index]};
  }
  [[nodiscard]] Triangle front() const noexcept { return (*this)[0]; }
  [[nodiscard]] Iterator begin() const noexcept { return {*this, 0}; }
  [[nodiscard]] Iterator end() const noexcept { return {*this, size()}; }

 private:
  std::vector<std::array<std::uint32_t, 3>> corners_;
  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Eigen::Vector3d> normals_;
};

}  // namespace reckon::haptics
