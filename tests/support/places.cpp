// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/support/places.hpp"

namespace reckon::test {

std::string source_dir() { return RECKON_SOURCE_DIR; }
std::string default_data_dir() { return RECKON_DATA_DEFAULT; }

}  // namespace reckon::test
