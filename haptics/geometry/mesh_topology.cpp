// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Topology of a mesh: which triangles share an edge, which pieces they form, and which of them must
// be turned.
#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <span>

#include "reckon/haptics/geometry/mesh_repair.hpp"

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

/// One side of one triangle.
struct EdgeUse {
  std::uint64_t edge;  // its two vertices, the smaller one in the upper half
  std::uint32_t triangle;
  std::uint32_t side;  // from corner `side` to the next
  auto operator<=>(const EdgeUse&) const = default;
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

constexpr std::uint32_t kNone = 0xffffffffu;  // a boundary edge
constexpr std::uint32_t kMany = kNone - 1;    // an edge of three or more

class Topology {
 public:
  Topology(TriangleSoup& soup, MeshReport& report)
      : soup_(soup), triangles_(soup.triangles), report_(report) {}

  void run() {
    join();
    count_meeting_points();
    grow_pieces();
    for (const Piece& piece : pieces_) settle_side(piece);
    turn();
    count_volume();
  }

 private:
  [[nodiscard]] std::size_t corner(const EdgeUse& use, bool next) const {
    return 3 * std::size_t{use.triangle} + (use.side + (next ? 1 : 0)) % 3;
  }
  [[nodiscard]] bool runs_up(const EdgeUse& use) const {
    return triangles_[use.triangle].corners[use.side] == use.edge >> 32;
  }
  [[nodiscard]] const Vector3d& point(std::uint32_t triangle, std::size_t i) const {
    return soup_.vertices[triangles_[triangle].corners[i]];
  }

  /// Finds the neighbour over each side, whether it runs in the same direction, and the corners
  /// that share a vertex.
  void join() {
    const std::vector<EdgeUse> uses = sorted_uses();
    neighbour_.assign(uses.size(), kNone);
    same_way_.assign(uses.size(), false);
    fan_.resize(uses.size());
    std::iota(fan_.begin(), fan_.end(), 0u);
    for (std::size_t i = 0, end = 0; i < uses.size(); i = end) {
      end = i + 1;
      while (end < uses.size() && uses[end].edge == uses[i].edge) ++end;
      join_edge(std::span(uses).subspan(i, end - i));
    }
    report_.closed = report_.boundary_edges.count == 0 && report_.non_manifold_edges.count == 0;
  }

  [[nodiscard]] std::vector<EdgeUse> sorted_uses() const {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * triangles_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (std::uint32_t side = 0; side < 3; ++side) {
        const std::uint64_t from = triangles_[t].corners[side];
        const std::uint64_t to = triangles_[t].corners[(side + 1) % 3];
        uses.push_back({std::min(from, to) << 32 | std::max(from, to), t, side});
      }
    }
    std::ranges::sort(uses);
    return uses;
  }

  void join_edge(std::span<const EdgeUse> uses) {
    const std::uint32_t place = triangles_[uses[0].triangle].place;
    for (const EdgeUse& use : uses.subspan(1)) {
      const bool crossed = runs_up(use) != runs_up(uses[0]);
      unite(corner(use, crossed), corner(uses[0], false));
      unite(corner(use, !crossed), corner(uses[0], true));
    }
    if (uses.size() == 1) report_.boundary_edges.add(place);
    if (uses.size() > 2) {
      report_.non_manifold_edges.add(place);
      for (const EdgeUse& use : uses) neighbour_[corner(use, false)] = kMany;
    }
    if (uses.size() != 2) return;
    const bool same = runs_up(uses[0]) == runs_up(uses[1]);
    if (same) report_.inconsistent_edges.add(place);
    for (const std::size_t i : {0u, 1u}) {
      neighbour_[corner(uses[i], false)] = uses[1 - i].triangle;
      same_way_[corner(uses[i], false)] = same;
    }
  }

  std::size_t fan_of(std::size_t corner) {
    while (fan_[corner] != corner) {
      fan_[corner] = fan_[fan_[corner]];
      corner = fan_[corner];
    }
    return corner;
  }
  void unite(std::size_t a, std::size_t b) {
    fan_[fan_of(a)] = static_cast<std::uint32_t>(fan_of(b));
  }

  /// Counts vertices whose triangles are not connected over edges.
  void count_meeting_points() {
    std::vector<std::uint32_t> fan(soup_.vertices.size(), kNone);
    for (std::size_t corner = 0; corner < fan_.size(); ++corner) {
      const SoupTriangle& triangle = triangles_[corner / 3];
      std::uint32_t& known = fan[triangle.corners[corner % 3]];
      const auto own = static_cast<std::uint32_t>(fan_of(corner));
      if (known == kMany || known == own) continue;
      if (known != kNone) report_.non_manifold_vertices.add(triangle.place);
      known = known == kNone ? own : kMany;
    }
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

  void measure(Piece& piece) const {
    const Vector3d& origin = point(order_[piece.begin], 0);
    for (std::uint32_t i = piece.begin; i < piece.end; ++i) {
      const std::uint32_t t = order_[i];
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
  std::vector<std::uint32_t> fan_;        // of each corner: another of the same fan, or itself
  std::vector<bool> turned_;              // of each triangle
  std::vector<std::uint32_t> order_;      // triangles, piece by piece
  std::vector<Piece> pieces_;
  std::vector<const Piece*> enclosing_;
  double drawn_volume_ = 0.0;
  bool drawn_known_ = false;
};

}  // namespace

void orient(TriangleSoup& soup, MeshReport& report) {
  if (soup.triangles.empty()) return;
  Topology(soup, report).run();
  const bool plain =
      report.non_manifold_edges.count == 0 && report.non_manifold_vertices.count == 0;
  if (report.boundary_edges.count > 0 && plain && report.one_sided_edges == 0) {
    report.holes = count_holes(soup);
  }
}

}  // namespace reckon::haptics
