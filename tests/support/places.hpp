// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Paths on this machine. They are in one object file, so that all others are the same in every
// clone and a compiler cache serves them.
#pragma once

#include <string>

namespace reckon::test {

/// The project's root.
[[nodiscard]] std::string source_dir();
/// Folder of reference data, unless the environment names another one; it need not exist.
[[nodiscard]] std::string default_data_dir();

}  // namespace reckon::test
