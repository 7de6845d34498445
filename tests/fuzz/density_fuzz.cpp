// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any octets as a sample of places: finite ones, no more than a quad-tree takes, or a sentence.
#include <algorithm>
#include <string_view>

#include "reckon/peer/scene/density_file.hpp"
#include "reckon/peer/tracks/csv_reader.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using reckon::fuzz::require;
  static const reckon::fuzz::InputOnDisk file(".csv");
  const std::string& name = file.write({reinterpret_cast<const char*>(data), size});
  try {
    const auto places = reckon::peer::read_density(name, 200.0);
    require(!places.empty() && places.size() <= reckon::peer::kMostPlaces, "no number of places");
    require(
        std::ranges::all_of(places, [&](const auto& one) { return one.instant < places.size(); }),
        "an instant that is none");
  } catch (const reckon::peer::CsvError& error) {
    require(std::string_view(error.what()).starts_with(name), "a sentence without the file");
  }
  return 0;
}
