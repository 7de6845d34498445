// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Names of a mesh file for its faces, to which the patches of a surface refer.
#pragma once

#include <cstdint>

namespace reckon::haptics {

/// Numbers in SurfaceMesh::names(), from 1; 0: none.
struct FaceNames {
  std::uint32_t material = 0;
  std::uint32_t group = 0;
};

}  // namespace reckon::haptics
