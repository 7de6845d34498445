// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Shapes of another size. Private to the scene reader.
#pragma once

#include "reckon/haptics/geometry/shape.hpp"

namespace reckon::peer {

/// Makes `shape` so many times as large about its origin. False if it cannot be: a mesh whose size
/// only its file knows.
[[nodiscard]] bool scale_shape(haptics::Shape& shape, double scale);

}  // namespace reckon::peer
