// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/captures/place_shift.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "reckon/tools/captures/number_list.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/listener/origin_at.hpp"

namespace reckon::tools {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;
constexpr double kGreatestHeight = 1e8;  // of a LocalFrame [m]
constexpr std::string_view kForm =
    "write FROM=TO or TO as LATITUDE,LONGITUDE[,HEIGHT] in degrees and metres, for example "
    "48.14,11.58=34.05,-118.24";

}  // namespace

ShiftRequest::ShiftRequest(const std::string& text) {
  const auto words = parts_of(text, '=');
  if (words.size() > 2) throw UsageError(fmt::format("--map-place {}: {}", text, kForm));
  to_ = parse(words.back(), text);
  if (words.size() == 1) return;
  from_ = parse(words.front(), text);
  if (from_->height.has_value() != to_.height.has_value())
    throw UsageError(fmt::format(
        "--map-place {}: give both heights, or none to leave heights as they are", text));
}

ShiftRequest::Geodetic ShiftRequest::parse(std::string_view text, const std::string& whole) {
  std::vector<double> numbers;
  for (const std::string_view word : parts_of(text, ',')) {
    const auto number = number_of<double>(word);
    numbers.push_back(number.value_or(std::nan("")));
  }
  const bool is_place = (numbers.size() == 2 || numbers.size() == 3) &&
                        std::abs(numbers[0]) <= 90 && std::abs(numbers[1]) <= 360;
  const bool has_height = numbers.size() == 3;
  if (!is_place || (has_height && !(std::abs(numbers[2]) <= kGreatestHeight)))
    throw UsageError(fmt::format("--map-place {}: '{}' is not a place; {}", whole, text, kForm));
  Geodetic place{numbers[0] * kRadiansPerDegree, numbers[1] * kRadiansPerDegree, {}};
  if (has_height) place.height = numbers[2];
  return place;
}

std::optional<PlaceShift> ShiftRequest::shift() const {
  if (!from_.has_value()) return std::nullopt;
  return between(*from_);
}

PlaceShift ShiftRequest::shift_from(const Eigen::Vector3d& point) const {
  const peer::OriginConfig from = origin_at(point);
  return between({from.latitude, from.longitude, from.height});
}

PlaceShift ShiftRequest::between(const Geodetic& from) const {
  const double height = from.height.value_or(0);
  return {deadreckon::LocalFrame(from.latitude, from.longitude, height),
          deadreckon::LocalFrame(to_.latitude, to_.longitude, to_.height.value_or(height))};
}

}  // namespace reckon::tools
