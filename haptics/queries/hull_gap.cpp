// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/hull_gap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kLeastHalf = 1e-150;  // [m]; its square must not underflow
constexpr double kProven = 1e-14;      // of the farthest corner: difference of distance and proof
constexpr double kAccepted = 1e-13;    // the same, if rounding prevents a better proof
constexpr int kMostSteps = 64;

// A corner of the difference of two hulls.
struct Vertex {
  Vector3d w;
  std::uint8_t a, b;
};

// The simplex of the difference nearest to the origin so far: vertices and their weights.
struct Simplex {
  std::array<Vertex, 4> vertex;
  std::array<double, 4> weight{};
  int count = 0;

  [[nodiscard]] Vector3d point() const {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < count; ++i) sum += weight[at(i)] * vertex[at(i)].w;
    return sum;
  }
  [[nodiscard]] bool has(const Vertex& v) const {
    for (int i = 0; i < count; ++i)
      if (vertex[at(i)].a == v.a && vertex[at(i)].b == v.b) return true;
    return false;
  }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
};

Simplex of_one(const Vertex& a) { return {{a}, {1.0}, 1}; }

// The point of a segment nearest to the origin, with the vertices that it needs.
Simplex of_two(const Vertex& a, const Vertex& b) {
  const Vector3d ab = b.w - a.w;
  const double length = ab.squaredNorm();
  const double t = length > 0.0 ? -a.w.dot(ab) / length : 0.0;
  if (t <= 0.0) return of_one(a);
  if (t >= 1.0) return of_one(b);
  return {{a, b}, {1.0 - t, t}, 2};
}

const Simplex& nearer(const Simplex& one, const Simplex& two) {
  return two.point().squaredNorm() < one.point().squaredNorm() ? two : one;
}

Simplex of_three(const Vertex& a, const Vertex& b, const Vertex& c) {
  const Vector3d normal = (b.w - a.w).cross(c.w - a.w);
  const double area = normal.squaredNorm();
  const double u = normal.dot(b.w.cross(c.w));
  const double v = normal.dot(c.w.cross(a.w));
  const double w = normal.dot(a.w.cross(b.w));
  if (area > 0.0 && u > 0.0 && v > 0.0 && w > 0.0) {
    const double sum = u + v + w;
    return {{a, b, c}, {u / sum, v / sum, w / sum}, 3};
  }
  return nearer(nearer(of_two(a, b), of_two(b, c)), of_two(c, a));
}

// Whether the origin is beyond the plane of a, b, c, seen from d; true if they are flat.
bool beyond(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d) {
  const Vector3d normal = (b.w - a.w).cross(c.w - a.w);
  const double origin = -normal.dot(a.w);
  const double other = normal.dot(d.w - a.w);
  return origin * other <= 0.0;
}

Simplex of_four(const Simplex& s) {
  const auto& [a, b, c, d] = s.vertex;
  Simplex best;
  bool outside = false;
  const auto face = [&](const Vertex& p, const Vertex& q, const Vertex& r, const Vertex& other) {
    if (!beyond(p, q, r, other)) return;
    const Simplex one = of_three(p, q, r);
    best = outside ? nearer(best, one) : one;
    outside = true;
  };
  face(a, b, c, d);
  face(a, c, d, b);
  face(a, d, b, c);
  face(b, d, c, a);
  return outside ? best : s;
}

Simplex reduced(const Simplex& s) {
  switch (s.count) {
    case 1:
      return of_one(s.vertex[0]);
    case 2:
      return of_two(s.vertex[0], s.vertex[1]);
    case 3:
      return of_three(s.vertex[0], s.vertex[1], s.vertex[2]);
    default:
      return of_four(s);
  }
}

std::uint8_t farthest(const Hull& hull, const Vector3d& direction) {
  std::uint8_t best = 0;
  double most = direction.dot(hull.corners[0]);
  for (std::uint8_t i = 1; i < hull.count; ++i) {
    const double along = direction.dot(hull.corners[i]);
    if (along <= most) continue;
    most = along;
    best = i;
  }
  return best;
}

Vertex vertex_of(const Hull& a, const Hull& b, std::uint8_t i, std::uint8_t j) {
  return {a.corners[i] - b.corners[j], i, j};
}

Simplex first_simplex(const Hull& a, const Hull& b, const HullStart& start) {
  Simplex s;
  s.count = start.count;
  for (std::size_t i = 0; i < start.count; ++i) {
    if (start.a[i] >= a.count || start.b[i] >= b.count) return of_one(vertex_of(a, b, 0, 0));
    s.vertex[i] = vertex_of(a, b, start.a[i], start.b[i]);
  }
  return s.count == 0 ? of_one(vertex_of(a, b, 0, 0)) : reduced(s);
}

void keep(const Simplex& s, HullStart& start) {
  // Stores three vertices of a simplex around the origin; the fourth is found again.
  start.count = static_cast<std::uint8_t>(std::min(s.count, 3));
  for (std::size_t i = 0; i < start.count; ++i) {
    start.a[i] = s.vertex[i].a;
    start.b[i] = s.vertex[i].b;
  }
}

HullGap gap_of(const Hull& a, const Hull& b, const Simplex& s, double distance) {
  HullGap gap{distance, Vector3d::Zero(), Vector3d::Zero()};
  for (int i = 0; i < s.count; ++i) {
    const Vertex& v = s.vertex[Simplex::at(i)];
    gap.on_a += s.weight[Simplex::at(i)] * a.corners[v.a];
    gap.on_b += s.weight[Simplex::at(i)] * b.corners[v.b];
  }
  return gap;
}

double farthest_corner(const Hull& hull) {
  double most = 0.0;
  for (std::size_t i = 0; i < hull.count; ++i)
    most = std::max(most, hull.corners[i].cwiseAbs().maxCoeff());
  return most;
}

// --- by features ---

int edges_of(const Hull& hull, std::array<std::array<std::uint8_t, 2>, 12>& edges) {
  int count = 0;
  for (std::uint8_t i = 0; i < hull.count; ++i) {
    for (std::uint8_t j = static_cast<std::uint8_t>(i + 1); j < hull.count; ++j) {
      const int differ = i ^ j;
      if (hull.count == 3 || (differ & (differ - 1)) == 0)
        edges[static_cast<std::size_t>(count++)] = {i, j};
    }
  }
  return count;
}

// Nearest points of two segments (C. Ericson, Real-Time Collision Detection, 5.1.9).
void nearest_of_segments(const Vector3d& p, const Vector3d& p_end, const Vector3d& q,
                         const Vector3d& q_end, Vector3d& on_p, Vector3d& on_q) {
  const Vector3d along_p = p_end - p;
  const Vector3d along_q = q_end - q;
  const Vector3d r = p - q;
  const double a = along_p.squaredNorm();
  const double e = along_q.squaredNorm();
  const double b = along_p.dot(along_q);
  const double c = along_p.dot(r);
  const double f = along_q.dot(r);
  const double denominator = along_p.cross(along_q).squaredNorm();
  double s = denominator > 0.0 ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  double t = e > 0.0 ? std::clamp((b * s + f) / e, 0.0, 1.0) : 0.0;
  s = a > 0.0 ? std::clamp((b * t - c) / a, 0.0, 1.0) : 0.0;
  on_p = p + s * along_p;
  on_q = q + t * along_q;
}

// Whether the segment intersects the hull, away from the hull's edges.
bool pierces(const Vector3d& from, const Vector3d& to, const Hull& hull, Vector3d& at) {
  const Vector3d step = to - from;
  if (hull.count < 3) return false;
  const Vector3d& corner = hull.corners[0];
  if (hull.count < 8) {
    const Vector3d u = hull.corners[1] - corner;
    const Vector3d v = hull.corners[2] - corner;
    const Vector3d normal = u.cross(v);
    const double rate = normal.dot(step);
    const double height = normal.dot(from - corner);
    if (rate == 0.0 || height * (height + rate) > 0.0) return false;
    at = from - height / rate * step;
    const Vector3d in = at - corner;
    const double area = normal.squaredNorm();
    const double x = normal.dot(in.cross(v)) / area;
    const double y = normal.dot(u.cross(in)) / area;
    return x >= 0.0 && y >= 0.0 && (hull.count == 3 ? x + y <= 1.0 : x <= 1.0 && y <= 1.0);
  }
  double first = 0.0;
  double last = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d edge = hull.corners[std::size_t{1} << k] - corner;
    const double length = edge.squaredNorm();
    const double begin = edge.dot(from - corner);
    const double change = edge.dot(step);
    if (change == 0.0) {
      if (begin < 0.0 || begin > length) return false;
      continue;
    }
    const double t0 = -begin / change;
    const double t1 = (length - begin) / change;
    first = std::max(first, std::min(t0, t1));
    last = std::min(last, std::max(t0, t1));
  }
  if (first > last) return false;
  at = from + first * step;
  return true;
}

// The nearest pair so far.
class Nearest {
 public:
  void offer(const Vector3d& on_a, const Vector3d& on_b) {
    const double squared = (on_b - on_a).squaredNorm();
    if (!(squared < least_)) return;
    least_ = squared;
    gap_ = {std::sqrt(squared), on_a, on_b};
  }
  [[nodiscard]] const HullGap& gap() const { return gap_; }

 private:
  double least_ = std::numeric_limits<double>::infinity();
  HullGap gap_;
};

}  // namespace

Hull Hull::of_box(const Vector3d& centre, const Eigen::Matrix3d& axes,
                  const Vector3d& half) noexcept {
  Hull hull;
  hull.corners[0] = centre;
  hull.count = 1;
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (half[k] < kLeastHalf) continue;
    const Vector3d reach = half[k] * axes.col(k);
    for (std::size_t i = 0; i < hull.count; ++i) {
      hull.corners[i + hull.count] = hull.corners[i] + reach;
      hull.corners[i] -= reach;
    }
    hull.count = static_cast<std::uint8_t>(2 * hull.count);
  }
  return hull;
}

Hull Hull::of_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) noexcept {
  Hull hull;
  hull.corners[0] = a;
  hull.corners[1] = b;
  hull.corners[2] = c;
  hull.count = 3;
  return hull;
}

Vector3d Hull::nearest(const Vector3d& p) const noexcept {
  if (count == 3) return closest_on_triangle(corners[0], corners[1], corners[2], p);
  const Vector3d from = p - corners[0];
  Vector3d on = corners[0];
  for (std::size_t bit = 1; bit < count; bit *= 2) {
    const Vector3d edge = corners[bit] - corners[0];
    on += std::clamp(from.dot(edge) / edge.squaredNorm(), 0.0, 1.0) * edge;
  }
  return on;
}

HullGap hull_gap(const Hull& a, const Hull& b, HullStart& start) noexcept {
  if (a.count <= 3 && b.count <= 3) return hull_gap_by_features(a, b);  // as fast for few corners
  const double scale = farthest_corner(a) + farthest_corner(b);
  Simplex s = first_simplex(a, b, start);
  Vector3d v = s.point();
  double distance = v.norm();
  for (int step = 0; step < kMostSteps; ++step) {
    if (s.count == 4 || distance <= kProven * scale) {
      keep(s, start);
      HullGap gap = gap_of(a, b, s, 0.0);
      gap.on_b = gap.on_a;
      return gap;
    }
    const Vertex next = vertex_of(a, b, farthest(a, -v), farthest(b, v));
    const double unproven = distance - v.dot(next.w) / distance;
    bool ends = unproven <= kProven * scale;
    if (!ends && !s.has(next)) {
      s.vertex[Simplex::at(s.count)] = next;
      ++s.count;
      const Simplex smaller = reduced(s);
      const Vector3d nearest = smaller.point();
      const double less = nearest.norm();
      if (smaller.count == 4 || less < distance) {
        s = smaller;
        v = nearest;
        distance = less;
        continue;
      }
      --s.count;
    }
    ends = ends || unproven <= kAccepted * scale;
    if (!ends) break;
    keep(s, start);
    return gap_of(a, b, s, distance);
  }
  start.count = 0;
  return hull_gap_by_features(a, b);
}

HullGap hull_gap_by_features(const Hull& a, const Hull& b) noexcept {
  Nearest nearest;
  for (std::size_t i = 0; i < a.count; ++i) nearest.offer(a.corners[i], b.nearest(a.corners[i]));
  for (std::size_t i = 0; i < b.count; ++i) nearest.offer(a.nearest(b.corners[i]), b.corners[i]);
  std::array<std::array<std::uint8_t, 2>, 12> edges_a, edges_b;
  const int count_a = edges_of(a, edges_a);
  const int count_b = edges_of(b, edges_b);
  Vector3d at, other;
  for (int i = 0; i < count_a; ++i) {
    const Vector3d& from = a.corners[edges_a[Simplex::at(i)][0]];
    const Vector3d& to = a.corners[edges_a[Simplex::at(i)][1]];
    if (pierces(from, to, b, at)) nearest.offer(at, at);
    for (int j = 0; j < count_b; ++j) {
      nearest_of_segments(from, to, b.corners[edges_b[Simplex::at(j)][0]],
                          b.corners[edges_b[Simplex::at(j)][1]], at, other);
      nearest.offer(at, other);
    }
  }
  for (int j = 0; j < count_b; ++j) {
    if (pierces(b.corners[edges_b[Simplex::at(j)][0]], b.corners[edges_b[Simplex::at(j)][1]], a,
                at))
      nearest.offer(at, at);
  }
  return nearest.gap();
}

}  // namespace reckon::haptics
