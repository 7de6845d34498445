// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A clock of the external project.
#pragma once

namespace theirs {

inline constexpr int kTicks = 3;

}  // namespace theirs
