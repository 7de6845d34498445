// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/figures/figure_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "reckon/tools/plots/curves.hpp"
#include "reckon/tools/plots/svg_elements.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_end.hpp"

namespace reckon::bench {
namespace {

/// Letters of a note below the title that the width of the picture holds.
constexpr std::size_t kNoteColumns = 100;

constexpr std::string_view kStyle = R"(
:root{color-scheme:light dark;--ink:#1f2328;--soft:#59636e;--line:#d8dee4;--page:#fff;
--band:#f6f8fa}
@media(prefers-color-scheme:dark){:root{--ink:#e6edf3;--soft:#9198a1;--line:#30363d;--page:#0d1117;
--band:#161b22}}
body{margin:0 auto;padding:1.5rem 1rem 4rem;max-width:60rem;font:15px/1.5 system-ui,sans-serif;
color:var(--ink);background:var(--page)}
h1{font-size:1.6rem;margin:0 0 .5rem}h2{font-size:1.25rem;margin:2.5rem 0 .2rem;
border-top:1px solid var(--line);padding-top:1.5rem}
p{margin:.3rem 0}dl{display:grid;grid-template-columns:max-content 1fr;gap:.15rem 1rem;margin:.6rem 0}
dt{color:var(--soft)}dd{margin:0}
a{color:inherit}section>svg{display:block;width:100%;height:auto;margin:.8rem 0}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:13px}
th,td{padding:.2rem .6rem;text-align:right;border-bottom:1px solid var(--line)}
.o th:nth-child(2),.o td:nth-child(2),.o th:nth-child(5),.o td:nth-child(5){text-align:left}
.o td:nth-child(3),.o td:nth-child(4){white-space:nowrap}
th{background:var(--band);font-weight:600}th:first-child,td:first-child{text-align:left}
@media print{section{break-inside:avoid}}
)";

std::string escaped(std::string_view text) {
  std::string out;
  tools::append_svg_escaped(out, text);
  return out;
}

/// In lines that the picture holds.
void append_note(std::vector<std::string>& notes, std::string_view text) {
  while (text.size() > kNoteColumns) {
    std::size_t end = text.rfind(' ', kNoteColumns);
    if (end == std::string_view::npos || end == 0) end = kNoteColumns;
    notes.emplace_back(text.substr(0, end));
    text.remove_prefix(end + (text[end] == ' ' ? 1 : 0));
  }
  notes.emplace_back(text);
}

/// In double quotes where it needs them.
std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char letter : text) out.append(letter == '"' ? 2 : 1, letter);
  return out + "\"";
}

std::string number_json(const std::optional<double>& number) {
  return number ? fmt::format("{}", *number) : "null";
}

/// The values of a panel as the plotter takes them.
struct DrawnCurve {
  std::string name;
  std::vector<float> at, values;
};

std::vector<DrawnCurve> drawn(const FigurePanel& panel) {
  std::vector<DrawnCurve> curves;
  for (const FigureCurve& curve : panel.curves) {
    DrawnCurve& row = curves.emplace_back();
    row.name = curve.name;
    for (const double x : curve.x) row.at.push_back(static_cast<float>(x));
    for (const double y : curve.y) row.values.push_back(static_cast<float>(y));
  }
  return curves;
}

void append_numbers(std::string& out, const Figure& figure) {
  out +=
      "<table>\n<thead><tr><th>number</th><th>ours</th><th>thesis</th><th>unit</th></tr></thead>\n"
      "<tbody>\n";
  for (const FigureNumber& number : figure.numbers)
    fmt::format_to(
        tools::end_of(out), "<tr><td>{}</td><td>{:.4g}</td><td>{}</td><td>{}</td></tr>\n",
        escaped(number.what), number.ours,
        number.thesis ? fmt::format("{:g}", *number.thesis) : "not printed", escaped(number.unit));
  out += "</tbody></table>\n";
}

void append_figure(std::string& out, const MadeFigure& made) {
  const auto& [kind, figure] = made;
  fmt::format_to(tools::end_of(out), "<section id=\"f{0}\">\n<h2>{0} {1}{2}</h2>\n", kind->name,
                 escaped(kind->title), kind->is_drawing ? " (drawing)" : "");
  out += figure_svg(made);
  fmt::format_to(tools::end_of(out), "<dl><dt>thesis</dt><dd>{}</dd><dt>{}</dt><dd>{}</dd></dl>\n",
                 escaped(figure.thesis), kind->is_drawing ? "Reckon" : "ours", escaped(figure.why));
  if (!kind->is_drawing) {
    append_numbers(out, figure);
    fmt::format_to(tools::end_of(out), "<p><a href=\"{}\">CSV</a> ",
                   figure_file(kind->name, "csv"));
  } else {
    out += "<p>";
  }
  fmt::format_to(tools::end_of(out), "<a href=\"{}\">SVG</a></p>\n</section>\n",
                 figure_file(kind->name, "svg"));
}

/// To the end of the first sentence or clause.
std::string_view first_words(std::string_view text) {
  std::size_t end = text.size();
  for (const char* mark : {": ", ". ", "; "}) end = std::min(end, text.find(mark));
  return text.substr(0, end);
}

/// A line for each: number, title, ours, thesis, whether it agrees.
void append_overview(std::string& out, std::span<const MadeFigure> figures) {
  out +=
      "<table class=\"o\">\n<thead><tr><th>figure</th><th></th><th>ours</th><th>thesis</th>"
      "<th></th></tr></thead>\n<tbody>\n";
  for (const MadeFigure& made : figures) {
    const auto& [kind, figure] = made;
    fmt::format_to(tools::end_of(out), "<tr><td><a href=\"#f{0}\">{0}</a></td><td>{1}</td>",
                   kind->name, escaped(kind->title));
    if (kind->is_drawing) {
      out += "<td></td><td></td><td>drawing</td></tr>\n";
      continue;
    }
    const FigureNumber& number = figure.numbers.front();
    fmt::format_to(tools::end_of(out), "<td>{}</td><td>{}</td><td>{}</td></tr>\n",
                   escaped(number_with_unit(number.ours, number.unit)),
                   number.thesis ? fmt::format("{:g}", *number.thesis) : "not printed",
                   escaped(first_words(figure.why)));
  }
  out += "</tbody></table>\n";
}

}  // namespace

std::string figure_file(std::string_view name, std::string_view extension) {
  return fmt::format("figure_{}.{}", name, extension);
}

std::string number_with_unit(double number, std::string_view unit) {
  return fmt::format("{:.4g} {}", number, unit);
}

std::string figure_svg(const MadeFigure& made) {
  const Figure& figure = made.figure;
  std::vector<std::string> notes;
  append_note(notes, "Thesis: " + figure.thesis);
  append_note(notes, (made.kind->is_drawing ? "Reckon: " : "Ours: ") + figure.why);
  const std::string title = fmt::format("Fig {}{}: {}", made.kind->name,
                                        made.kind->is_drawing ? ", drawing" : "", made.kind->title);
  if (figure.drawing) return figure.drawing->svg(title, notes);
  std::vector<std::vector<DrawnCurve>> curves;
  curves.reserve(figure.panels.size());
  std::vector<tools::SvgPlot> plots;
  for (const FigurePanel& panel : figure.panels) {
    tools::SvgPlot& plot = plots.emplace_back();
    plot.title = panel.title;
    plot.across = panel.across;
    plot.value = panel.value;
    plot.end = panel.end;
    plot.range = panel.range;
    plot.is_signed = true;
    for (const DrawnCurve& curve : curves.emplace_back(drawn(panel)))
      plot.curves.push_back({curve.name, curve.values, curve.at});
  }
  return tools::svg_panels(title, notes, plots);
}

std::string figure_csv(const MadeFigure& made) {
  const Figure& figure = made.figure;
  const FigurePanel& first = figure.panels.front();
  std::string out =
      fmt::format("panel,curve,{},{}\n", csv_cell(first.across), csv_cell(first.value));
  for (const FigurePanel& panel : figure.panels)
    for (const FigureCurve& curve : panel.curves)
      for (std::size_t i = 0; i < curve.x.size(); ++i)
        fmt::format_to(tools::end_of(out), "{},{},{},{}\n", csv_cell(panel.title),
                       csv_cell(curve.name), curve.x[i], curve.y[i]);
  return out;
}

std::string figure_json(const MadeFigure& made) {
  const std::vector<FigureNumber>& numbers = made.figure.numbers;
  std::string out;
  tools::JsonObject object(out);
  object.text("name", made.kind->name)
      .text("title", made.kind->title)
      .value("drawing", made.kind->is_drawing);
  if (numbers.empty()) {
    for (const char* key : {"ours", "thesis", "unit", "what"}) object.value(key, "null");
  } else {
    object.value("ours", numbers.front().ours)
        .value("thesis", number_json(numbers.front().thesis))
        .text("unit", numbers.front().unit)
        .text("what", numbers.front().what);
  }
  object
      .array("numbers", numbers,
             [](std::string& inner, const FigureNumber& number) {
               tools::JsonObject(inner)
                   .text("what", number.what)
                   .value("ours", number.ours)
                   .value("thesis", number_json(number.thesis))
                   .text("unit", number.unit)
                   .end();
             })
      .text("said", made.figure.thesis)
      .text("why", made.figure.why)
      .end("\n");
  return out;
}

std::string figures_page(std::span<const MadeFigure> figures) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
      "<title>Reckon: the figures of the thesis</title>\n";
  fmt::format_to(tools::end_of(out), "<style>{}</style>\n</head>\n<body>\n", kStyle);
  out +=
      "<h1>The figures of the thesis</h1>\n<p>Its experiments computed anew, its drawings drawn "
      "anew and named as such. Its pictures are not at hand: what it shows is taken from its text, "
      "and no plotted curve is claimed to be met. K with T and K, no T: its two ways to write the "
      "spring.</p>\n";
  append_overview(out, figures);
  for (const MadeFigure& made : figures) append_figure(out, made);
  out += "</body>\n</html>\n";
  return out;
}

}  // namespace reckon::bench
