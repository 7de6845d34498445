// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon record FILE [SOURCE]`: live datagrams into a capture.
#pragma once

#include "reckon/tools/program.hpp"

namespace reckon::tools {

int run_record(Arguments arguments, const Console& console);

}  // namespace reckon::tools
