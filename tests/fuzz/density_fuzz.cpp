// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any octets as a sample of positions: finite ones, at most as many as a quad-tree takes, or an
// error text.
#include <algorithm>
#include <string_view>

#include "reckon/peer/tracks/csv_reader.hpp"
#include "reckon/peer/tracks/density_file.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {

void check(std::span<const std::byte> input) {
  static const InputOnDisk file(".csv");
  const std::string& name = file.write(text_of(input));
  try {
    const auto places = peer::read_density(name, 200.0);
    require(!places.empty() && places.size() <= peer::kMostPlaces, "no number of places");
    require(
        std::ranges::all_of(places, [&](const auto& one) { return one.instant < places.size(); }),
        "an instant that is none");
  } catch (const peer::CsvError& error) {
    require(std::string_view(error.what()).starts_with(name), "a sentence without the file");
  }
}

}  // namespace reckon::fuzz
