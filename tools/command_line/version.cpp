// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/version.hpp"

namespace reckon::tools {

std::string_view program_version() noexcept { return RECKON_VERSION; }

}  // namespace reckon::tools
