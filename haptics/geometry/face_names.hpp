// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a mesh file calls its faces: the place where patches of a surface take hold.
#pragma once

#include <cstdint>

namespace reckon::haptics {

/// Numbers in SurfaceMesh::names(), from 1; 0: none.
struct FaceNames {
  std::uint32_t material = 0;
  std::uint32_t group = 0;
};

}  // namespace reckon::haptics
