// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where things lie on this machine. In one object file, so that all others are the same in every
// clone and a compiler's cache serves them.
#pragma once

#include <string>

namespace reckon::test {

/// The project's root.
[[nodiscard]] std::string source_dir();
/// Reference data, unless the environment names another folder; it need not be there.
[[nodiscard]] std::string default_data_dir();

}  // namespace reckon::test
