// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon figures`: each figure as SVG, CSV and JSON, all of them as one page.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "reckon/bench/plots/html_page.hpp"
#include "reckon/bench/studies/figures/figure_list.hpp"
#include "reckon/bench/studies/frame/fields.hpp"
#include "reckon/bench/studies/frame/study.hpp"
#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/tools/plots/curves.hpp"
#include "reckon/tools/plots/svg_elements.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

constexpr std::string_view kSummary =
    "Recomputes the figures of chapters 3 to 5 of the thesis: each experiment as CSV and SVG, each "
    "drawing as SVG, and one page with printed and computed numbers and the reasons for "
    "differences.\n\nNAME is the number of a figure (default: all). Existing files are replaced.";
constexpr std::string_view kExamples =
    "reckon figures\n"
    "reckon figures 3.5 4.3 --out pictures\n"
    "reckon figures --list\n"
    "reckon figures --json | jq .ours";

/// Letters of a note below the title that fit into the width of the picture.
constexpr std::size_t kNoteColumns = 100;

constexpr std::string_view kFigureStyle = R"(
body{max-width:60rem}section>svg{display:block;width:100%;height:auto;margin:.8rem 0}
table{white-space:normal}
)";

/// A computed or drawn figure.
struct MadeFigure {
  const FigureKind* kind = &figure_kinds().front();
  Figure figure;
};

/// For example "figure_3.5.svg".
std::string figure_file(std::string_view name, std::string_view extension) {
  return fmt::format("figure_{}.{}", name, extension);
}

/// Appends `text`, wrapped to the width of the picture.
void append_note(std::vector<std::string>& notes, std::string_view text) {
  while (text.size() > kNoteColumns) {
    std::size_t end = text.rfind(' ', kNoteColumns);
    if (end == std::string_view::npos || end == 0) end = kNoteColumns;
    notes.emplace_back(text.substr(0, end));
    text.remove_prefix(end + (text[end] == ' ' ? 1 : 0));
  }
  notes.emplace_back(text);
}

/// The values of a panel in the form of the plotter.
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
        out += fmt::format("{},{},{},{}\n", csv_cell(panel.title), csv_cell(curve.name), curve.x[i],
                           curve.y[i]);
  return out;
}

std::string thesis_text(const FigureNumber& number, std::string_view none) {
  return number.thesis ? fmt::format("{:g}", *number.thesis) : std::string(none);
}

Fields number_fields(const FigureNumber& number) {
  return Fields()
      .json("what", number.what)
      .json("ours", number.ours)
      .json("thesis", number.thesis)
      .json("unit", number.unit)
      .page_word("number", html_escaped(number.what))
      .page("ours", number.ours, fmt::format("{:.4g}", number.ours))
      .page("thesis", number.thesis.value_or(0), thesis_text(number, "not printed"))
      .page_word("unit", html_escaped(number.unit));
}

void append_figure(std::string& out, const MadeFigure& made) {
  const auto& [kind, figure] = made;
  out += fmt::format("<section id=\"f{0}\">\n<h2>{0} {1}{2}</h2>\n", kind->name,
                     html_escaped(kind->title), kind->is_drawing ? " (drawing)" : "");
  out += figure_svg(made);
  out += fmt::format("<dl><dt>thesis</dt><dd>{}</dd><dt>{}</dt><dd>{}</dd></dl>\n",
                     html_escaped(figure.thesis), kind->is_drawing ? "Reckon" : "ours",
                     html_escaped(figure.why));
  if (!kind->is_drawing) {
    out += page_table_of(figure.numbers, number_fields);
    out += fmt::format("<p><a href=\"{}\">CSV</a> ", figure_file(kind->name, "csv"));
  } else {
    out += "<p>";
  }
  out += fmt::format("<a href=\"{}\">SVG</a></p>\n</section>\n", figure_file(kind->name, "svg"));
}

/// Text up to the end of the first sentence or clause.
std::string_view first_words(std::string_view text) {
  std::size_t end = text.size();
  for (const char* mark : {": ", ". ", "; "}) end = std::min(end, text.find(mark));
  return text.substr(0, end);
}

/// A figure without its pictures. The first of its numbers represents it.
Fields figure_fields(const MadeFigure& made) {
  const auto& [kind, figure] = made;
  const FigureNumber first = figure.numbers.empty() ? FigureNumber{} : figure.numbers.front();
  const bool has = !figure.numbers.empty();
  const auto known = [&](const Value& value) { return has ? value : Value::raw("null"); };
  const std::string ours = has ? fmt::format("{:.4g} {}", first.ours, first.unit) : "";
  const std::string_view drawing = "drawing";
  return Fields()
      .json("name", kind->name)
      .json("title", kind->title)
      .json("drawing", kind->is_drawing)
      .json("ours", known(first.ours))
      .json("thesis", known(first.thesis))
      .json("unit", known(first.unit))
      .json("what", known(first.what))
      .json("numbers", Value::array(figure.numbers, number_fields))
      .json("said", figure.thesis)
      .json("why", figure.why)
      .word("FIGURE", kind->name)
      .word("TITLE", kind->title)
      .cell("OURS", ours)
      .cell("THESIS", has ? thesis_text(first, "-") : "")
      .word("OF", has ? std::string_view(first.what) : drawing)
      .page_word("figure", fmt::format("<a href=\"#f{0}\">{0}</a>", kind->name))
      .page_word("", html_escaped(kind->title))
      .page("ours", first.ours, html_escaped(ours))
      .page("thesis", first.thesis.value_or(0), has ? thesis_text(first, "not printed") : "")
      .page_word("", html_escaped(has ? first_words(figure.why) : drawing));
}

std::string figures_page(std::span<const MadeFigure> figures) {
  std::string body =
      "<p>Recomputed experiments and redrawn drawings of the thesis. Its pictures are not "
      "available: its results are taken from its text, and no match with a plotted curve is "
      "claimed. K with T and K, no T: its two forms of the spring.</p>\n";
  body += page_table_of(figures, figure_fields);
  for (const MadeFigure& made : figures) append_figure(body, made);
  return html_page("The figures of the thesis", kFigureStyle, body);
}

std::string_view chapter_of(std::string_view name) { return name.substr(0, name.find('.')); }

/// The nearest names of its chapter, or all of the chapter if none is near; empty for other
/// chapters.
std::string nearest_names(std::string_view typed) {
  std::vector<std::string_view> names;
  for (const FigureKind& kind : figure_kinds())
    if (chapter_of(kind.name) == chapter_of(typed)) names.push_back(kind.name);
  if (names.empty()) return "";
  if (const std::string_view nearest = peer::nearest_word(typed, names); !nearest.empty())
    return fmt::format("did you mean '{}'? ", nearest);
  return fmt::format("that chapter has {}. ", fmt::join(names, ", "));
}

const FigureKind& kind_of(const std::string& name) {
  const auto kinds = figure_kinds();
  const auto kind = std::ranges::find(kinds, name, &FigureKind::name);
  if (kind == kinds.end())
    throw tools::UsageError(fmt::format(
        "there is no figure '{}'; {}`reckon figures --list` lists all", name, nearest_names(name)));
  return *kind;
}

/// In the order of the thesis, each once.
std::vector<const FigureKind*> kinds_of(const std::vector<std::string>& names) {
  std::vector<const FigureKind*> asked;
  for (const std::string& name : names) asked.push_back(&kind_of(name));
  std::vector<const FigureKind*> kinds;
  for (const FigureKind& kind : figure_kinds()) {
    if (names.empty() || std::ranges::count(asked, &kind) > 0) kinds.push_back(&kind);
  }
  return kinds;
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw tools::UsageError(fmt::format(
        "{}: cannot be created ({}); choose a writable folder by --out", folder, error.message()));
}

void write_file(const std::string& folder, const std::string& name, const std::string& text) {
  const std::string path = (std::filesystem::path(folder) / name).string();
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  if (!file)
    throw tools::UsageError(
        fmt::format("{}: cannot be written; choose a writable folder by --out", path));
  file << text;
  file.close();
  if (!file)
    throw tools::UsageError(
        fmt::format("{}: could not be written completely; is the disk full?", path));
}

Fields kind_fields(const FigureKind& kind) {
  return Fields()
      .json("name", kind.name)
      .json("title", kind.title)
      .json("drawing", kind.is_drawing)
      .word("FIGURE", kind.name)
      .word("TITLE", kind.title)
      .word("WHAT", kind.is_drawing ? "drawing" : "experiment");
}

class FiguresStudy final : public Study {
 public:
  FiguresStudy() : Study({kSummary, kExamples}) {}

  std::vector<Flag> flags() override {
    std::string all;
    for (const FigureKind& kind : figure_kinds()) all.append(kind.name).append(" ");
    return {{"NAME", &shared_.files, "numbers of figures, such as 3.5", all},
            {"--out", &folder_, "folder for the files, created if it does not exist"},
            {"--list", &is_list_, "list the figures, and compute none"},
            {"--json", &shared_.json, "one JSON object per figure"}};
  }

  StudyOutput run(const StudyCall& call) override {
    if (is_list_) {
      if (!shared_.files.empty())
        throw tools::UsageError("--list takes no NAME: it lists all figures");
      if (std::ranges::count(call.given, "--out") > 0)
        throw tools::UsageError("--list writes no files: remove --out");
      return {lines_of(shared_.json, figure_kinds(), kind_fields)};
    }
    const std::vector<const FigureKind*> kinds = kinds_of(shared_.files);
    make_folder(folder_);
    std::vector<MadeFigure> figures;
    for (const FigureKind* kind : kinds) {
      if (call.console.stopped()) break;
      const MadeFigure& made = figures.emplace_back(kind, kind->make());
      if (!kind->is_drawing) write_file(folder_, figure_file(kind->name, "csv"), figure_csv(made));
      write_file(folder_, figure_file(kind->name, "svg"), figure_svg(made));
    }
    write_file(folder_, "index.html", figures_page(figures));
    StudyOutput output{lines_of(shared_.json, figures, figure_fields)};
    output.note = fmt::format("wrote {} to {}; open {}\n", tools::counted(figures.size(), "figure"),
                              folder_, (std::filesystem::path(folder_) / "index.html").string());
    return output;
  }

 private:
  std::string folder_ = "figures";
  bool is_list_ = false;
};

}  // namespace

std::unique_ptr<Study> figures_study() { return std::make_unique<FiguresStudy>(); }

}  // namespace reckon::bench

namespace reckon::tools::verb {

Verb figures() {
  return reckon::bench::study_verb(verb_row("figures"), reckon::bench::figures_study);
}

}  // namespace reckon::tools::verb
