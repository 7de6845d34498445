// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Optional reference data (captures, meshes, traces, oracles) outside the repository.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "reckon/tests/support/places.hpp"

namespace reckon::test {

/// Folder of the reference data: the environment's RECKON_DATA, else ../shared/data beside the
/// checkout.
inline std::filesystem::path reference_data() {
  const char* set = std::getenv("RECKON_DATA");
  return set != nullptr ? set : default_data_dir();
}

}  // namespace reckon::test

/// Skips the test with the name of missing reference data.
#define RECKON_NEED_DATA(relative)                                                             \
  do {                                                                                         \
    if (!std::filesystem::exists(reckon::test::reference_data() / (relative)))                 \
      GTEST_SKIP() << "needs reference data " << (reckon::test::reference_data() / (relative)) \
                   << "; set RECKON_DATA to the folder that holds it";                         \
  } while (false)
