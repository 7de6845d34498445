// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/figures/figure_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "reckon/bench/plots/html_page.hpp"
#include "reckon/tools/plots/curves.hpp"
#include "reckon/tools/plots/svg_elements.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_end.hpp"

namespace reckon::bench {
namespace {

/// Letters of a note below the title that the width of the picture holds.
constexpr std::size_t kNoteColumns = 100;

constexpr std::string_view kFigureStyle = R"(
body{max-width:60rem}section>svg{display:block;width:100%;height:auto;margin:.8rem 0}
table{white-space:normal}
.o th:nth-child(2),.o td:nth-child(2),.o th:nth-child(5),.o td:nth-child(5){text-align:left}
.o td:nth-child(3),.o td:nth-child(4){white-space:nowrap}
th:first-child,td:first-child{text-align:left}
)";

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
    fmt::format_to(tools::end_of(out),
                   "<tr><td>{}</td><td>{:.4g}</td><td>{}</td><td>{}</td></tr>\n",
                   html_escaped(number.what), number.ours,
                   number.thesis ? fmt::format("{:g}", *number.thesis) : "not printed",
                   html_escaped(number.unit));
  out += "</tbody></table>\n";
}

void append_figure(std::string& out, const MadeFigure& made) {
  const auto& [kind, figure] = made;
  fmt::format_to(tools::end_of(out), "<section id=\"f{0}\">\n<h2>{0} {1}{2}</h2>\n", kind->name,
                 html_escaped(kind->title), kind->is_drawing ? " (drawing)" : "");
  out += figure_svg(made);
  fmt::format_to(tools::end_of(out), "<dl><dt>thesis</dt><dd>{}</dd><dt>{}</dt><dd>{}</dd></dl>\n",
                 html_escaped(figure.thesis), kind->is_drawing ? "Reckon" : "ours",
                 html_escaped(figure.why));
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
                   kind->name, html_escaped(kind->title));
    if (kind->is_drawing) {
      out += "<td></td><td></td><td>drawing</td></tr>\n";
      continue;
    }
    const FigureNumber& number = figure.numbers.front();
    fmt::format_to(tools::end_of(out), "<td>{}</td><td>{}</td><td>{}</td></tr>\n",
                   html_escaped(number_with_unit(number.ours, number.unit)),
                   number.thesis ? fmt::format("{:g}", *number.thesis) : "not printed",
                   html_escaped(first_words(figure.why)));
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
        .number("thesis", numbers.front().thesis)
        .text("unit", numbers.front().unit)
        .text("what", numbers.front().what);
  }
  object
      .array("numbers", numbers,
             [](std::string& inner, const FigureNumber& number) {
               tools::JsonObject(inner)
                   .text("what", number.what)
                   .value("ours", number.ours)
                   .number("thesis", number.thesis)
                   .text("unit", number.unit)
                   .end();
             })
      .text("said", made.figure.thesis)
      .text("why", made.figure.why)
      .end("\n");
  return out;
}

std::string figures_page(std::span<const MadeFigure> figures) {
  std::string body =
      "<p>Its experiments computed anew, its drawings drawn anew and named as such. Its pictures "
      "are not at hand: what it shows is taken from its text, and no plotted curve is claimed to "
      "be met. K with T and K, no T: its two ways to write the spring.</p>\n";
  append_overview(body, figures);
  for (const MadeFigure& made : figures) append_figure(body, made);
  return html_page("The figures of the thesis", kFigureStyle, body);
}

}  // namespace reckon::bench
