// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/scatter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <vector>

#include "reckon/bench/plots/html_page.hpp"
#include "reckon/bench/plots/log_axis.hpp"
#include "reckon/bench/studies/accuracy/text.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"

namespace reckon::bench {
namespace {

// Of the picture and of the area inside the axes.
constexpr double kWidth = 760, kHeight = 430;
constexpr double kLeft = 92, kRight = 744, kTop = 12, kBottom = 376;

/// A shape in a square of 12 about the origin, by the place of the model in its list.
constexpr std::array<std::string_view, kPoseModels.size()> kShapes{
    "M-5 0A5 5 0 1 0 5 0A5 5 0 1 0-5 0Z",
    "M-4.5-4.5H4.5V4.5H-4.5Z",
    "M0-6L5.5 4.5H-5.5Z",
    "M0 6L5.5-4.5H-5.5Z",
    "M0-6.5L6 0L0 6.5L-6 0Z",
    "M-6 0L4.5-5.5V5.5Z",
    "M6 0L-4.5-5.5V5.5Z",
    "M-2-6H2V-2H6V2H2V6H-2V2H-6V-2H-2Z",
    "M0-6.5L1.9-2.2 6.2-2 2.9 1 4 5.4 0 3 -4 5.4 -2.9 1 -6.2-2 -1.9-2.2Z",
    "M-6-3.5L-3.5-6 0-2.5 3.5-6 6-3.5 2.5 0 6 3.5 3.5 6 0 2.5 -3.5 6 -6 3.5 -2.5 0Z",
    "M-3-5.5H3L6 0L3 5.5H-3L-6 0Z",
};

std::size_t place_of(const PoseModel& model) {
  const auto found = std::find_if(kPoseModels.begin(), kPoseModels.end(),
                                  [&](const PoseModel& row) { return row.name == model.name; });
  return static_cast<std::size_t>(found - kPoseModels.begin()) % kPoseModels.size();
}

/// Over what `of` gives of the rows.
template <typename Of>
LogAxis axis_of(const AccuracyResult& result, double floor, double begin, double finish, Of&& of) {
  std::vector<double> values;
  for (const AccuracyRow& row : result.rows) values.push_back(of(row));
  return log_axis_over(values, floor, begin, finish, 1);
}

struct Axes {
  LogAxis octets, error;

  explicit Axes(const AccuracyResult& result)
      : octets(axis_of(result, 0.1, kLeft, kRight,
                       [](const AccuracyRow& row) { return row.octets_per_second(); })),
        error(axis_of(result, least_shown(result), kBottom, kTop,
                      [](const AccuracyRow& row) { return row.result.position.p99; })) {}

  [[nodiscard]] double x(const AccuracyRow& row) const {
    return octets.at(row.octets_per_second());
  }
  [[nodiscard]] double y(const AccuracyRow& row) const { return error.at(row.result.position.p99); }

 private:
  // Errors of rounding alone would squeeze all others into a corner.
  static double least_shown(const AccuracyResult& result) {
    double least = std::numeric_limits<double>::infinity();
    for (const AccuracyRow& row : result.rows) least = std::min(least, row.threshold);
    return least / 50;
  }
};

/// The least error for the octets spent, as steps.
void append_front(std::string& out, const AccuracyResult& result, const Axes& axes) {
  std::string path;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : rows_in_order(result, true)) {
    const AccuracyRow& row = result.rows[i];
    if (!(row.result.position.p99 < least)) continue;
    least = row.result.position.p99;
    path += path.empty() ? fmt::format("M{:.1f} {:.1f}", axes.x(row), axes.y(row))
                         : fmt::format("H{:.1f}V{:.1f}", axes.x(row), axes.y(row));
  }
  if (!path.empty()) out += fmt::format("<path class=\"f\" d=\"{}\"/>\n", path);
}

void append_marks(std::string& out, const AccuracyResult& result, const Axes& axes, bool front) {
  std::set<std::string> drawn;
  for (const AccuracyRow& row : result.rows) {
    if (!row.beaten != front) continue;
    const PoseResult& r = row.result;
    // Several curves may come out alike.
    if (!drawn.insert(fmt::format("{} {:.0f} {:.0f}", row.model.name, axes.x(row), axes.y(row)))
             .second)
      continue;
    out += fmt::format(
        "<use href=\"#s{0}\" class=\"m{0}{1}\" x=\"{2:.1f}\" y=\"{3:.1f}\"><title>{4}: "
        "{5} octets/s, p99 {6}, velocity step {7} m/s{8}</title></use>\n",
        place_of(row.model), front ? "" : " d", axes.x(row), axes.y(row), setting_text(row),
        number_text(row.octets_per_second()), length_text(r.position.p99),
        number_text(r.velocity_step.max), front ? "" : ", dominated");
  }
}

}  // namespace

std::string scatter_marks() {
  std::string out = "<svg width=\"0\" height=\"0\" class=\"defs\" aria-hidden=\"true\"><defs>\n";
  for (std::size_t i = 0; i < kShapes.size(); ++i)
    out += fmt::format("<path id=\"s{}\" d=\"{}\"/>\n", i, kShapes[i]);
  return out + "</defs></svg>\n";
}

std::string scatter_svg(const AccuracyResult& result) {
  const Axes axes(result);
  std::string out = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {:g} {:g}\" role=\"img\" aria-label=\"Octets a second "
      "against position error of {}\">\n",
      kWidth, kHeight, html_escaped(result.subject));
  append_log_grid(out, {axes.octets, "octets a second of one entity", number_text},
                  {axes.error, "position error, 99 % below", length_text});
  append_marks(out, result, axes, false);
  append_front(out, result, axes);
  append_marks(out, result, axes, true);
  return out + "</svg>\n";
}

std::string scatter_legend(const AccuracyResult& result) {
  std::string out = "<p class=\"legend\">";
  std::string_view last;
  for (const AccuracyRow& row : result.rows) {
    if (row.model.name == last) continue;
    last = row.model.name;
    out += fmt::format(
        "<span title=\"{2}\"><svg viewBox=\"-8 -8 16 16\" width=\"14\" height=\"14\" "
        "aria-hidden=\"true\"><use href=\"#s{0}\" class=\"m{0}\"/></svg> {1}</span>\n",
        place_of(row.model), html_escaped(last), html_escaped(row.model.meaning));
  }
  return out + "</p>\n";
}

}  // namespace reckon::bench
