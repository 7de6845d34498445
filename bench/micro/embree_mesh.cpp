// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/micro/embree_mesh.hpp"

#include <cstddef>
#include <stdexcept>

namespace reckon::bench {

using Eigen::Vector3f;

struct EmbreeMesh::Search {
  const std::vector<Triangle>& triangles;
  Vector3f p;
  Nearest& nearest;
};

EmbreeMesh::EmbreeMesh(const haptics::SurfaceMesh& mesh)
    : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_.get())) {
  for (const haptics::Triangle& t : mesh.triangles()) {
    triangles_.push_back({t.a.cast<float>(), t.b.cast<float>(), t.c.cast<float>()});
  }
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
  const RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               3 * triangles_.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), triangles_.size()));
  if (vertices == nullptr || indices == nullptr) throw std::runtime_error("Embree: no memory");
  std::uint32_t next = 0;
  for (const Triangle& t : triangles_) {
    for (const Vector3f& corner : {t.a, t.b, t.c}) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) *vertices++ = corner[axis];
      *indices++ = next++;
    }
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) {
    throw std::runtime_error("Embree refused the mesh");
  }
}

// Region tests after C. Ericson, Real-Time Collision Detection, 5.1.5.
Vector3f EmbreeMesh::closest_on(const Triangle& t, const Vector3f& p) noexcept {
  const Vector3f ab = t.b - t.a;
  const Vector3f ac = t.c - t.a;
  const Vector3f ap = p - t.a;
  const float d1 = ab.dot(ap);
  const float d2 = ac.dot(ap);
  if (d1 <= 0.0f && d2 <= 0.0f) return t.a;
  const Vector3f bp = p - t.b;
  const float d3 = ab.dot(bp);
  const float d4 = ac.dot(bp);
  if (d3 >= 0.0f && d4 <= d3) return t.b;
  const Vector3f cp = p - t.c;
  const float d5 = ab.dot(cp);
  const float d6 = ac.dot(cp);
  if (d6 >= 0.0f && d5 <= d6) return t.c;
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) return t.a + d1 / (d1 - d3) * ab;
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) return t.a + d2 / (d2 - d6) * ac;
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0.0f && d4 >= d3 && d5 >= d6) {
    return t.b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t.c - t.b);
  }
  const float share = 1.0f / (va + vb + vc);
  return t.a + vb * share * ab + vc * share * ac;
}

bool EmbreeMesh::measure(RTCPointQueryFunctionArguments* arguments) noexcept {
  const auto& search = *static_cast<const Search*>(arguments->userPtr);
  const Vector3f point = closest_on(search.triangles[arguments->primID], search.p);
  const float distance = (point - search.p).norm();
  if (!(distance < search.nearest.distance)) return false;
  search.nearest = {point, distance, arguments->primID};
  arguments->query->radius = distance;
  return true;
}

void EmbreeMesh::search(const Vector3f& p, Nearest& nearest) const noexcept {
  RTCPointQuery query{};
  query.x = p.x();
  query.y = p.y();
  query.z = p.z();
  query.radius = nearest.distance;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  Search search{triangles_, p, nearest};
  rtcPointQuery(scene_.get(), &query, &context, measure, &search);
}

EmbreeMesh::Nearest EmbreeMesh::closest(const Vector3f& p) const noexcept {
  Nearest nearest;
  search(p, nearest);
  return nearest;
}

EmbreeMesh::Nearest EmbreeMesh::closest_from(const Vector3f& p, std::uint32_t hint) const noexcept {
  const Vector3f point = closest_on(triangles_[hint], p);
  Nearest nearest{point, (point - p).norm(), hint};
  search(p, nearest);
  return nearest;
}

}  // namespace reckon::bench
