// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A scene of the external project.
#pragma once

namespace theirs {

struct Scene {
  int objects = 5;
};

}  // namespace theirs
