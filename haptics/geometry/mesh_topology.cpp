// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Topology of a mesh: which triangles share an edge, which pieces they form, and which of them must
// be turned.
#include <Eigen/Geometry>
#include <algorithm>
#include <compare>
#include <numeric>
#include <span>

#include "reckon/haptics/geometry/mesh_repair.hpp"
#include "reckon/haptics/geometry/vertex_corners.hpp"

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

/// An edge from a vertex, as one side of one triangle.
struct Spoke {
  std::uint32_t end;     // the other vertex
  std::uint32_t side;    // 3 times its triangle plus its place, from this corner to the next
  std::uint32_t corner;  // of the triangle at the vertex, by its place in the vertex's list
  bool outgoing;         // the triangle runs from the vertex to the end
  [[nodiscard]] std::uint32_t triangle() const { return side / 3; }
  auto operator<=>(const Spoke&) const = default;
};

struct Piece {
  std::uint32_t begin = 0, end = 0;  // in Topology::order_
  Eigen::AlignedBox3d box;
  double volume = 0.0;  // signed, with the triangles as turned
  double area = 0.0;    // of all triangles
  double turned_area = 0.0;
  bool closed = true;     // no boundary
  bool two_sided = true;  // its triangles can be turned to agree
  bool as_drawn = true;   // they agreed before turning
};

// Number of the largest pieces whose boxes are searched for an enclosed piece.
constexpr std::size_t kEnclosing = 256;

constexpr std::uint32_t kFetched = 8;  // triangles, for the memory to arrive

constexpr std::uint32_t kNone = 0xffffffffu;  // a boundary edge
constexpr std::uint32_t kMany = kNone - 1;    // an edge of three or more

class Topology {
 public:
  Topology(TriangleSoup& soup, MeshReport& report)
      : soup_(soup), triangles_(soup.triangles), report_(report) {}

  /// Finds the neighbour over each side, whether it runs in the same direction, and the vertices
  /// whose triangles are not connected over edges.
  void join(const VertexCorners& corners) {
    neighbour_.assign(3 * triangles_.size(), kNone);
    same_way_.assign(neighbour_.size(), false);
    corners.visit_all(soup_, [&](std::uint32_t vertex, std::span<const std::uint32_t> around) {
      join_at(vertex, around);
    });
    report_.closed = report_.boundary_edges.count == 0 && report_.non_manifold_edges.count == 0;
  }

  /// Turns triangles and whole pieces. After join().
  void settle() {
    grow_pieces();
    for (const Piece& piece : pieces_) settle_side(piece);
    turn();
    count_volume();
  }

 private:
  [[nodiscard]] const Vector3d& point(std::uint32_t triangle, std::size_t i) const {
    return soup_.vertices[triangles_[triangle].corners[i]];
  }

  /// Joins each edge to a later vertex, and counts the fans of connected triangles.
  void join_at(std::uint32_t vertex, std::span<const std::uint32_t> corners) {
    list_spokes(corners);
    fan_.resize(corners.size());
    std::iota(fan_.begin(), fan_.end(), 0u);
    std::size_t fans = corners.size();
    for (std::size_t i = 0, end = 0; i < spokes_.size(); i = end) {
      end = i + 1;
      while (end < spokes_.size() && spokes_[end].end == spokes_[i].end) {
        fans -= unite(spokes_[end].corner, spokes_[i].corner) ? 1 : 0;
        ++end;
      }
      if (vertex < spokes_[i].end) join_edge(std::span(spokes_).subspan(i, end - i));
    }
    if (fans > 1) note_meeting_point(corners);
  }

  void list_spokes(std::span<const std::uint32_t> corners) {
    spokes_.clear();
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t triangle = corners[i] / 3, place = corners[i] % 3;
      const std::uint32_t next = (place + 1) % 3, before = (place + 2) % 3;
      const auto& t = triangles_[triangle].corners;
      spokes_.push_back({t[next], corners[i], i, true});
      spokes_.push_back({t[before], 3 * triangle + before, i, false});
    }
    std::ranges::sort(spokes_);
  }

  void join_edge(std::span<const Spoke> uses) {
    const std::uint32_t place = triangles_[uses[0].triangle()].place;
    if (uses.size() == 1) report_.boundary_edges.add(place);
    if (uses.size() > 2) {
      report_.non_manifold_edges.add(place);
      for (const Spoke& use : uses) neighbour_[use.side] = kMany;
    }
    if (uses.size() != 2) return;
    const bool same = uses[0].outgoing == uses[1].outgoing;
    if (same) report_.inconsistent_edges.add(place);
    for (const std::size_t i : {0u, 1u}) {
      neighbour_[uses[i].side] = uses[1 - i].triangle();
      same_way_[uses[i].side] = same;
    }
  }

  std::uint32_t fan_of(std::uint32_t corner) {
    while (fan_[corner] != corner) {
      fan_[corner] = fan_[fan_[corner]];
      corner = fan_[corner];
    }
    return corner;
  }
  /// @return false if they were united before
  bool unite(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t fan = fan_of(a), other = fan_of(b);
    fan_[fan] = other;
    return fan != other;
  }

  /// Reports the first triangle that is not connected with the first of all.
  void note_meeting_point(std::span<const std::uint32_t> corners) {
    std::uint32_t i = 1;
    while (fan_of(i) == fan_of(0)) ++i;
    report_.non_manifold_vertices.add(triangles_[corners[i] / 3].place);
  }

  void grow_pieces() {
    turned_.assign(triangles_.size(), false);
    std::vector<bool> seen(triangles_.size());
    order_.reserve(triangles_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (!seen[t]) pieces_.push_back(grow(t, seen));
    }
    report_.pieces = pieces_.size();
  }

  Piece grow(std::uint32_t seed, std::vector<bool>& seen) {
    Piece piece;
    piece.begin = static_cast<std::uint32_t>(order_.size());
    order_.push_back(seed);
    seen[seed] = true;
    for (std::size_t i = piece.begin; i < order_.size(); ++i) {
      const std::uint32_t t = order_[i];
      if (i + kFetched < order_.size()) __builtin_prefetch(&neighbour_[3 * order_[i + kFetched]]);
      for (std::size_t side = 3 * std::size_t{t}; side < 3 * std::size_t{t} + 3; ++side) {
        const std::uint32_t other = neighbour_[side];
        piece.closed = piece.closed && other != kNone;
        if (other == kNone || other == kMany) continue;
        piece.as_drawn = piece.as_drawn && !same_way_[side];
        const bool turned = turned_[t] != same_way_[side];
        if (!seen[other]) {
          turned_[other] = turned;
          seen[other] = true;
          order_.push_back(other);
        } else if (turned_[other] != turned && t < other) {
          piece.two_sided = false;
          ++report_.one_sided_edges;
        }
      }
    }
    piece.end = static_cast<std::uint32_t>(order_.size());
    measure(piece);
    return piece;
  }

  /// Fetches later triangles of a piece from memory, and then their vertices.
  void fetch(std::uint32_t i, std::uint32_t end) const {
    if (i + 2 * kFetched >= end) return;
    __builtin_prefetch(&triangles_[order_[i + 2 * kFetched]]);
    for (const std::uint32_t corner : triangles_[order_[i + kFetched]].corners)
      __builtin_prefetch(&soup_.vertices[corner]);
  }

  void measure(Piece& piece) const {
    const Vector3d& origin = point(order_[piece.begin], 0);
    for (std::uint32_t i = piece.begin; i < piece.end; ++i) {
      const std::uint32_t t = order_[i];
      fetch(i, piece.end);
      for (std::size_t k = 0; k < 3; ++k) piece.box.extend(point(t, k));
      const Vector3d a = point(t, 0) - origin, b = point(t, 1) - origin, c = point(t, 2) - origin;
      const double area = 0.5 * (b - a).cross(c - a).norm();
      piece.area += area;
      piece.turned_area += turned_[t] ? area : 0.0;
      piece.volume += (turned_[t] ? -1.0 : 1.0) * a.dot(b.cross(c)) / 6.0;
    }
  }

  /// Turns the whole piece if it faces the wrong side.
  void settle_side(const Piece& piece) {
    bool over = 2.0 * piece.turned_area > piece.area;
    if (piece.closed && piece.two_sided) over = faces_inwards(piece);
    if (!piece.two_sided) over = false;
    const bool whole = piece.as_drawn && over;
    if (whole && piece.closed) ++report_.inward_pieces;
    for (std::uint32_t i = piece.begin; i < piece.end; ++i) {
      const std::uint32_t t = order_[i];
      if (over) turned_[t] = !turned_[t];
      if (turned_[t] && !whole) report_.turned.add(triangles_[t].place);
    }
  }

  /// Whether it must be turned to face outwards. A piece inside another one is a cavity if it was
  /// drawn in the opposite direction to most of the surface.
  [[nodiscard]] bool faces_inwards(const Piece& piece) {
    const bool inverse = drawn_volume() < 0.0;
    const bool odd_one = (piece.volume < 0.0) != inverse;
    if (piece.as_drawn && odd_one && is_within_another(piece)) return inverse;
    return piece.volume < 0.0;
  }

  /// Volume of all closed pieces that were drawn consistently.
  double drawn_volume() {
    if (!drawn_known_) {
      for (const Piece& piece : pieces_) {
        if (piece.closed && piece.as_drawn) drawn_volume_ += piece.volume;
      }
      drawn_known_ = true;
    }
    return drawn_volume_;
  }

  [[nodiscard]] bool is_within_another(const Piece& piece) {
    if (enclosing_.empty()) {
      for (const Piece& other : pieces_) {
        if (other.closed) enclosing_.push_back(&other);
      }
      const auto larger = [](const Piece* a, const Piece* b) {
        return a->box.volume() > b->box.volume();
      };
      const std::size_t count = std::min(kEnclosing, enclosing_.size());
      std::ranges::partial_sort(enclosing_, enclosing_.begin() + static_cast<std::ptrdiff_t>(count),
                                larger);
      enclosing_.resize(count);
    }
    return std::ranges::any_of(enclosing_, [&](const Piece* other) {
      return other != &piece && other->box.contains(piece.box) &&
             other->box.volume() > piece.box.volume();
    });
  }

  void turn() {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (turned_[t]) std::swap(triangles_[t].corners[1], triangles_[t].corners[2]);
    }
  }

  void count_volume() {
    if (!report_.closed) return;
    const Vector3d& origin = point(order_[0], 0);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      report_.volume +=
          (point(t, 0) - origin).dot((point(t, 1) - origin).cross(point(t, 2) - origin)) / 6.0;
    }
  }

  TriangleSoup& soup_;
  std::vector<SoupTriangle>& triangles_;
  MeshReport& report_;
  std::vector<std::uint32_t> neighbour_;  // of each side, kNone or kMany
  std::vector<bool> same_way_;            // of each side: its neighbour has the same direction
  std::vector<Spoke> spokes_;             // of one vertex, by their ends
  std::vector<std::uint32_t> fan_;        // of each of its corners: another of the fan, or itself
  std::vector<bool> turned_;              // of each triangle
  std::vector<std::uint32_t> order_;      // triangles, piece by piece
  std::vector<Piece> pieces_;
  std::vector<const Piece*> enclosing_;
  double drawn_volume_ = 0.0;
  bool drawn_known_ = false;
};

}  // namespace

void orient(TriangleSoup& soup, VertexCorners corners, MeshReport& report) {
  if (soup.triangles.empty()) return;
  Topology topology(soup, report);
  topology.join(corners);
  corners = VertexCorners();
  topology.settle();
  const bool plain =
      report.non_manifold_edges.count == 0 && report.non_manifold_vertices.count == 0;
  if (report.boundary_edges.count > 0 && plain && report.one_sided_edges == 0) {
    report.holes = count_holes(soup);
  }
}

}  // namespace reckon::haptics
