// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any octets as a motion table: a track with a finite state at each time, and a hand trace, or an
// error sentence with a place.
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "reckon/peer/tracks/entity_track.hpp"
#include "reckon/peer/tracks/hand_trace_file.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

template <class Read>
void read_or_refuse(const std::string& name, Read read) {
  try {
    read();
  } catch (const peer::CsvError& error) {
    require(std::string_view(error.what()).starts_with(name), "a sentence without the file");
  }
}

void check_curve(const std::string& name) {
  const peer::TrackCurve curve(peer::read_track_samples(name));
  require(std::isfinite(curve.duration()) && curve.duration() >= 0, "it lasts for no time");
  for (const double share : {-1.0, 0.0, 0.3, 1.0, 7.7})
    require(deadreckon::is_finite(curve.at(share * curve.duration())), "it leads nowhere");
}

}  // namespace

void check(std::span<const std::byte> input) {
  static const InputOnDisk file(".csv");
  const std::string& name = file.write(text_of(input));
  read_or_refuse(name, [&] { check_curve(name); });
  read_or_refuse(name, [&] {
    try {
      (void)peer::read_hand_trace(name);
    } catch (const std::invalid_argument&) {  // beyond the abilities of a hand
    }
  });
}

}  // namespace reckon::fuzz
