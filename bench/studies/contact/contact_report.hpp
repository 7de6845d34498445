// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Results of the study of contacts as tables, JSON Lines and CSV.
#pragma once

#include <span>
#include <string>

#include "reckon/bench/studies/contact/contact_study.hpp"

namespace reckon::bench {

/// For people: a table for each scene, the effects of wide thresholds, and the meaning of the
/// columns.
[[nodiscard]] std::string contact_text(std::span<const ContactRow> rows,
                                       const peer::ImpairmentConfig& network);
/// One object a line.
[[nodiscard]] std::string contact_json(std::span<const ContactRow> rows,
                                       const peer::ImpairmentConfig& network);
/// With a header line. Missing values are empty.
[[nodiscard]] std::string contact_csv(std::span<const ContactRow> rows,
                                      const peer::ImpairmentConfig& network);
/// The table of a page.
[[nodiscard]] std::string contact_page_table(std::span<const ContactRow> rows);

}  // namespace reckon::bench
