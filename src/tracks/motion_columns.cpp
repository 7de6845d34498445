// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/tracks/motion_columns.hpp"

#include <fmt/format.h>

#include <string_view>

namespace reckon::peer {
namespace {

std::size_t column_of(const CsvReader& csv, std::string_view name) {
  if (const auto place = csv.find(name)) return *place;
  csv.fail(0, fmt::format("no column {}; the header must name t_s, px_m, py_m and pz_m", name));
}

}  // namespace

MotionColumns::MotionColumns(const CsvReader& csv)
    : csv_(csv),
      time_(column_of(csv, "t_s")),
      x_(column_of(csv, "px_m")),
      y_(column_of(csv, "py_m")),
      z_(column_of(csv, "pz_m")) {}

double MotionColumns::time() {
  const double now = csv_.required(time_);
  if (last_ && !(now > *last_)) {
    csv_.fail(time_, fmt::format("t_s does not increase: {} after {}", now, *last_));
  }
  last_ = now;
  return now;
}

Eigen::Vector3d MotionColumns::position() const {
  return {csv_.required(x_), csv_.required(y_), csv_.required(z_)};
}

}  // namespace reckon::peer
