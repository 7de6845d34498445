// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/tracks/density_file.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "reckon/peer/tracks/csv_reader.hpp"

namespace reckon::peer {
namespace {

std::size_t column_of(const CsvReader& csv, const std::filesystem::path& file, const char* name,
                      const char* of_a_track) {
  std::optional<std::size_t> column = csv.find(name);
  if (!column) column = csv.find(of_a_track);
  if (column) return *column;
  throw CsvError(
      fmt::format("{}:1:1: a sample of positions needs columns x_m and y_m", file.string()));
}

}  // namespace

std::vector<aoim::Demand> read_density(const std::filesystem::path& file, double reach) {
  CsvReader csv(file);
  const std::size_t x = column_of(csv, file, "x_m", "px_m"),
                    y = column_of(csv, file, "y_m", "py_m");
  const std::optional<std::size_t> t = csv.find("t_s");
  std::map<double, std::uint32_t> instants;
  std::vector<aoim::Demand> places;
  std::vector<std::size_t> at_once;
  while (csv.next()) {
    if (places.size() == kMostPlaces)
      csv.fail(x, fmt::format("more than {} positions; use fewer instants", kMostPlaces));
    const double time = t ? csv.required(*t) : 0.0;
    const auto next = static_cast<std::uint32_t>(instants.size());
    const std::uint32_t instant = instants.try_emplace(time, next).first->second;
    at_once.resize(instants.size());
    if (++at_once[instant] > kMostAtOnce)
      csv.fail(x, fmt::format("more than {} positions at one instant; use fewer", kMostAtOnce));
    places.push_back({{csv.required(x), csv.required(y), 0.0}, reach, instant});
  }
  if (places.empty())
    throw CsvError(fmt::format("{}: no positions after the header", file.string()));
  return places;
}

}  // namespace reckon::peer
