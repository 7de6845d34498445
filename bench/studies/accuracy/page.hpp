// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A study of accuracy as one page that needs no network: pictures, and tables to sort.
#pragma once

#include <string>

#include "reckon/bench/studies/accuracy/text.hpp"

namespace reckon::bench {

/// The whole file. Style and script are within; readable in light and dark, and without the script.
[[nodiscard]] std::string accuracy_page(const AccuracyReport& report);

}  // namespace reckon::bench
