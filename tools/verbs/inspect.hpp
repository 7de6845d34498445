// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon inspect [SOURCE]`: every PDU of every datagram, live or from a capture.
#pragma once

#include "reckon/tools/program.hpp"

namespace reckon::tools {

int run_inspect(Arguments arguments, const Console& console);

}  // namespace reckon::tools
