// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Records of the external project.
#pragma once

namespace theirs {

struct Record {
  int value = 4;
};

}  // namespace theirs
