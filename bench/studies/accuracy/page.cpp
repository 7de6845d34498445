// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The page of a study of accuracy, with a picture of each setting's cost against its error.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <vector>

#include "reckon/bench/plots/html_page.hpp"
#include "reckon/bench/plots/log_axis.hpp"
#include "reckon/bench/plots/sortable_page.hpp"
#include "reckon/bench/studies/accuracy/text.hpp"
#include "reckon/bench/studies/contact/contact_report.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

// Sizes of the picture and of the area inside the axes.
constexpr double kWidth = 760, kHeight = 430;
constexpr double kLeft = 92, kRight = 744, kTop = 12, kBottom = 376;

/// Shapes in a square of 12 around the origin, by the index of the model in its list.
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

/// Axis over `of` applied to the rows.
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
  // Rounding errors alone would compress all other errors into a corner.
  static double least_shown(const AccuracyResult& result) {
    double least = std::numeric_limits<double>::infinity();
    for (const AccuracyRow& row : result.rows) least = std::min(least, row.threshold);
    return least / 50;
  }
};

/// The least error for the octets used, as steps.
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
    // Several curves may give the same point.
    if (!drawn.insert(fmt::format("{} {:.0f} {:.0f}", row.model.name, axes.x(row), axes.y(row)))
             .second)
      continue;
    out += fmt::format(
        "<use href=\"#s{0}\" class=\"m{0}{1}\" x=\"{2:.1f}\" y=\"{3:.1f}\"><title>{4}: {5} "
        "octets/s, p99 {6}, velocity step {7} m/s{8}</title></use>\n",
        place_of(row.model), front ? "" : " d", axes.x(row), axes.y(row), setting_text(row),
        number_text(row.octets_per_second()), length_text(r.position.p99),
        number_text(r.velocity_step.max), front ? "" : ", dominated");
  }
}

/// The shapes of the marks; they occur once in a page, before any picture.
std::string scatter_marks() {
  std::string out = "<svg width=\"0\" height=\"0\" class=\"defs\" aria-hidden=\"true\"><defs>\n";
  for (std::size_t i = 0; i < kShapes.size(); ++i)
    out += fmt::format("<path id=\"s{}\" d=\"{}\"/>\n", i, kShapes[i]);
  return out + "</defs></svg>\n";
}

/// Octets/s against p99 of the position error, both logarithmic. Colour and shape identify the
/// model; dominated settings are pale. The line joins the settings with the least error for their
/// octets. Values below the axis are drawn at its end. Classes: defined by the page's style.
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

/// Colours and shapes with the names of the models in the result.
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

/// Colours that most people can distinguish on white and on black; shapes distinguish them too.
constexpr std::string_view kPoseStyle = R"(
:root{--front:#1f2328}@media(prefers-color-scheme:dark){:root{--front:#e6edf3}}
.defs{position:absolute;width:0;height:0}.plot text{font:13px system-ui,sans-serif;fill:var(--soft)}
.g{stroke:var(--line);fill:none}.a{stroke:var(--soft);fill:none}
.f{stroke:var(--front);fill:none;stroke-width:1.5;stroke-linejoin:round}
use{stroke:var(--page);stroke-width:.8}.plot .d{opacity:.28}
.legend span{display:inline-block;margin-right:1rem;white-space:nowrap}
.legend svg{vertical-align:-2px}
.m0{fill:#d55e00}.m1{fill:#8c8c8c}.m2{fill:#56b4e9}.m3{fill:#0072b2}.m4{fill:#009e73}
.m5{fill:#7fb800}.m6{fill:#e69f00}.m7{fill:#b8860b}.m8{fill:#cc79a7}.m9{fill:#8a5cd1}
.m10{fill:#17a2a2}
)";

void append_summary(std::string& out, const AccuracyReport& report) {
  out +=
      "<p>An owner sends the motion of an entity when the error of its peers' prediction exceeds a "
      "threshold; a viewer predicts and smooths. Each setting is a model, a threshold and a "
      "convergence curve.</p>\n<dl>\n";
  const auto row = [&](std::string_view name, const std::string& value) {
    out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, value);
  };
  row("command", fmt::format("<code>{}</code>", html_escaped(report.command)));
  row("conditions", html_escaped(conditions_text(report.grid)));
  row("octets", "172 an update: Entity State of 144, UDP and IPv4 headers of 28");
  row("ns", html_escaped(report.processor) +
                "; one predicted and converged pose, median of interleaved blocks");
  out +=
      "</dl>\n<p class=\"note\">In full colour: the Pareto front of octets, error (99 % below) and "
      "largest velocity step; no setting is better in one of these without being worse in another. "
      "The line joins the smallest errors for the octets; marks off the line are on the front for "
      "smaller velocity steps. Pale: dominated, by the setting in the table. Settings are compared "
      "at three digits. Errors below the axis are drawn on it.</p>\n<nav>";
  for (std::size_t i = 0; i < report.results.size(); ++i)
    out += fmt::format("<a href=\"#r{}\">{}</a>\n", i, html_escaped(report.results[i].subject));
  if (!report.contacts.empty()) out += "<a href=\"#contacts\">hands in contact</a>\n";
  out += "</nav>\n";
}

void append_contacts(std::string& out, const AccuracyReport& report) {
  if (report.contacts.empty()) return;
  out +=
      "<section id=\"contacts\">\n<h2>hands in contact</h2>\n<p>Whole peers in simulated time; all "
      "packets, and the reduction against an Entity State and an Attribute PDU each millisecond of "
      "each hand. Errors: felt force against the spring that the devices can display x the true "
      "overlap at that instant.</p>\n";
  out += contact_page_table(report.contacts) + "</section>\n";
}

void append_result(std::string& out, const AccuracyResult& result, std::size_t number) {
  out += fmt::format("<section id=\"r{}\">\n<h2>{}</h2>\n<p>{}</p>\n", number,
                     html_escaped(result.subject), html_escaped(result.meaning));
  out += fmt::format(
      "<p class=\"note\">{}, {} samples; the true velocity steps by up to {} m/s from sample to "
      "sample. {} of {} settings are on the front.</p>\n",
      tools::counted(result.entities, "track"), result.samples,
      number_text(result.own_velocity_step), result.on_front(), result.rows.size());
  out += scatter_svg(result) + scatter_legend(result) + accuracy_page_table(result);
  out += "</section>\n";
}

}  // namespace

std::string accuracy_page(const AccuracyReport& report) {
  std::string out = scatter_marks();
  append_summary(out, report);
  for (std::size_t i = 0; i < report.results.size(); ++i) append_result(out, report.results[i], i);
  append_contacts(out, report);
  return sortable_page("Poses: accuracy against cost", kPoseStyle, out);
}

}  // namespace reckon::bench
