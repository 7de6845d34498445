// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Closest point of a mesh by Embree, for comparison; built if Embree 3 is installed.
#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::bench {

/// Triangles of a mesh in single precision, in a static Embree scene of high quality.
class EmbreeMesh {
 public:
  struct Nearest {
    Eigen::Vector3f point = Eigen::Vector3f::Zero();
    float distance = std::numeric_limits<float>::infinity();  ///< [m]
    std::uint32_t triangle = 0;  ///< in the order of SurfaceMesh::triangles()
  };

  /// @throws std::runtime_error if Embree cannot create a scene.
  explicit EmbreeMesh(const haptics::SurfaceMesh& mesh);

  /// rtcPointQuery with a callback that measures each triangle that it receives.
  [[nodiscard]] Nearest closest(const Eigen::Vector3f& p) const noexcept;
  /// The same, limited to the distance of a triangle that is probably near.
  [[nodiscard]] Nearest closest_from(const Eigen::Vector3f& p, std::uint32_t hint) const noexcept;

 private:
  struct Triangle {
    Eigen::Vector3f a, b, c;
  };
  struct Search;

  static Eigen::Vector3f closest_on(const Triangle& triangle, const Eigen::Vector3f& p) noexcept;
  static bool measure(RTCPointQueryFunctionArguments* arguments) noexcept;
  void search(const Eigen::Vector3f& p, Nearest& nearest) const noexcept;

  template <class Handle, void (*release)(Handle)>
  struct Release {
    void operator()(Handle handle) const noexcept { release(handle); }
  };
  template <class Handle, void (*release)(Handle)>
  using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release<Handle, release>>;

  Owned<RTCDevice, rtcReleaseDevice> device_;
  Owned<RTCScene, rtcReleaseScene> scene_;
  std::vector<Triangle> triangles_;
};

}  // namespace reckon::bench
