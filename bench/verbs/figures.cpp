// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/figures/figure_text.hpp"
#include "reckon/peer/scene/nearest_word.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

constexpr std::string_view kSummary =
    "Makes the figures of the thesis' chapters 3 to 5 anew: each experiment as CSV and SVG, each "
    "drawing as SVG, all on one page, with the number that the thesis prints beside ours and why "
    "they differ.\n\n"
    "NAME is the number of a figure; without one all are made. Files that are there are replaced.";
constexpr std::string_view kExamples =
    "reckon figures\n"
    "reckon figures 3.5 4.3 --out pictures\n"
    "reckon figures --list\n"
    "reckon figures --json | jq .ours";

constexpr std::string_view kDrawing = "drawing";

struct FigureWords {
  std::vector<std::string> names;
  std::string out = "figures";
  bool list = false;
  bool json = false;
};

std::string_view chapter_of(std::string_view name) { return name.substr(0, name.find('.')); }

/// The nearest of its chapter, or all of those where none is near; nothing for other chapters.
std::string nearest_names(std::string_view typed) {
  std::vector<std::string_view> names;
  for (const FigureKind& kind : figure_kinds())
    if (chapter_of(kind.name) == chapter_of(typed)) names.push_back(kind.name);
  if (names.empty()) return "";
  if (const std::string_view nearest = peer::nearest_word(typed, names); !nearest.empty())
    return fmt::format("did you mean '{}'? ", nearest);
  return fmt::format("of its chapter there are {}. ", fmt::join(names, ", "));
}

const FigureKind& kind_of(const std::string& name) {
  const auto kinds = figure_kinds();
  const auto kind = std::ranges::find(kinds, name, &FigureKind::name);
  if (kind == kinds.end())
    throw tools::UsageError(fmt::format(
        "there is no figure '{}'; {}`reckon figures --list` names all", name, nearest_names(name)));
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

void print_list(const FigureWords& words, const tools::Console& console) {
  tools::TextTable table({{"FIGURE"}, {"TITLE"}, {"WHAT"}});
  std::string lines;
  for (const FigureKind& kind : figure_kinds()) {
    const std::string_view what = kind.is_drawing ? kDrawing : "experiment";
    table.add({std::string(kind.name), std::string(kind.title), std::string(what)});
    tools::JsonObject(lines)
        .text("name", kind.name)
        .text("title", kind.title)
        .value("drawing", kind.is_drawing)
        .end("\n");
  }
  fmt::print(console.out, "{}", words.json ? lines : table.text());
}

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw tools::UsageError(fmt::format("{}: cannot be made ({}); name a folder of yours by --out",
                                        folder, error.message()));
}

void write_file(const std::string& folder, const std::string& name, const std::string& text) {
  const std::string path = (std::filesystem::path(folder) / name).string();
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  if (!file)
    throw tools::UsageError(
        fmt::format("{}: cannot be written; name a folder of yours by --out", path));
  file << text;
  file.close();
  if (!file)
    throw tools::UsageError(fmt::format("{}: could not be written whole; is the disk full?", path));
}

std::string thesis_text(const FigureNumber& number) {
  return number.thesis ? fmt::format("{:g}", *number.thesis) : "-";
}

void print_made(const std::vector<MadeFigure>& figures, const FigureWords& words,
                const tools::Console& console) {
  constexpr auto kRight = tools::TextTable::Align::right;
  tools::TextTable table({{"FIGURE"}, {"TITLE"}, {"OURS", kRight}, {"THESIS", kRight}, {"OF"}});
  std::string lines;
  for (const MadeFigure& made : figures) {
    lines += figure_json(made);
    if (made.kind->is_drawing) {
      table.add({std::string(made.kind->name), std::string(made.kind->title), "", "",
                 std::string(kDrawing)});
      continue;
    }
    const FigureNumber& number = made.figure.numbers.front();
    table.add({std::string(made.kind->name), std::string(made.kind->title),
               number_with_unit(number.ours, number.unit), thesis_text(number), number.what});
  }
  fmt::print(console.out, "{}", words.json ? lines : table.text());
}

int run_figures(tools::Arguments arguments, const tools::Console& console) {
  FigureWords words;
  tools::CommandLine line("figures", kSummary, kExamples);
  line.words("NAME", words.names, false, "numbers of figures, as 3.5");
  std::string all;
  for (const FigureKind& kind : figure_kinds()) all.append(kind.name).append(" ");
  line.offer("NAME", all);
  line.option("--out", words.out, "folder for the files, made where it is not there");
  line.flag("--list", words.list, "say which figures there are and make none");
  line.flag("--json", words.json, "one object a figure");
  if (const auto status = line.parse(arguments, console)) return *status;
  if (words.list) {
    if (!words.names.empty()) throw tools::UsageError("--list takes no NAME: it names all figures");
    if (std::ranges::count(line.given(), "--out") > 0)
      throw tools::UsageError("--list writes no files: leave --out out");
    print_list(words, console);
    return tools::exit_status(tools::ExitCode::good);
  }

  const std::vector<const FigureKind*> kinds = kinds_of(words.names);
  make_folder(words.out);
  std::vector<MadeFigure> figures;
  for (const FigureKind* kind : kinds) {
    if (console.stopped()) break;
    const MadeFigure& made = figures.emplace_back(kind, kind->make());
    if (!kind->is_drawing) write_file(words.out, figure_file(kind->name, "csv"), figure_csv(made));
    write_file(words.out, figure_file(kind->name, "svg"), figure_svg(made));
  }
  write_file(words.out, "index.html", figures_page(figures));
  print_made(figures, words, console);
  fmt::print(console.err, "wrote {} to {}; open {}\n", tools::counted(figures.size(), "figure"),
             words.out, (std::filesystem::path(words.out) / "index.html").string());
  return tools::exit_status(tools::ExitCode::good);
}

}  // namespace

namespace verb {

tools::Verb figures() { return tools::verb_of(tools::verb_row("figures"), run_figures); }

}  // namespace verb

}  // namespace reckon::bench
