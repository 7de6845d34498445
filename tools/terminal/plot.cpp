// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/terminal/plot.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "reckon/tools/terminal/plot_axis.hpp"

namespace reckon::tools {
namespace {

constexpr std::size_t kLabel = 9;  // columns of the labels on the left, including the axis
constexpr std::size_t kLeastWidth = 24;
constexpr std::size_t kMostWidth = 400;

bool locale_is_utf8() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const char* value = std::getenv(name);
    if (value == nullptr || *value == '\0') continue;
    const std::string_view text(value);
    return text.find("UTF-8") != text.npos || text.find("utf8") != text.npos;
  }
  return false;
}

std::size_t width_of(std::FILE* out) {
  if (const char* columns = std::getenv("COLUMNS")) {
    const unsigned long width = std::strtoul(columns, nullptr, 10);
    if (width > 0) return std::min<std::size_t>(width, kMostWidth);
  }
  winsize size{};
  const bool known = fileno(out) >= 0 && ioctl(fileno(out), TIOCGWINSZ, &size) == 0;
  return known && size.ws_col > 0 ? std::min<std::size_t>(size.ws_col, kMostWidth) : 80;
}

double sane(float value) { return std::isfinite(value) && value > 0 ? double{value} : 0.0; }

/// Heights in dots of `columns` columns, 0 to `dots`.
std::vector<std::size_t> heights(std::span<const float> values, std::size_t columns, double top,
                                 std::size_t dots) {
  std::vector<std::size_t> out(columns, 0);
  for (std::size_t i = 0; i < columns && !values.empty(); ++i) {
    const std::size_t begin = i * values.size() / columns;
    const std::size_t end = std::max(begin + 1, (i + 1) * values.size() / columns);
    double peak = 0;
    for (std::size_t k = begin; k < end; ++k) peak = std::max(peak, sane(values[k]));
    const double share = std::clamp(peak / top, 0.0, 1.0);
    out[i] = static_cast<std::size_t>(std::ceil(share * static_cast<double>(dots) - 1e-6));
  }
  return out;
}

/// One Braille character: two columns of up to four dots, filled from below.
void append_braille(std::string& out, std::size_t left, std::size_t right) {
  constexpr std::array<unsigned, 5> kLeft{0x00, 0x40, 0x44, 0x46, 0x47};
  constexpr std::array<unsigned, 5> kRight{0x00, 0x80, 0xA0, 0xB0, 0xB8};
  const unsigned code = 0x2800 + (kLeft[left] | kRight[right]);
  out += static_cast<char>(0xE0 | (code >> 12));
  out += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
  out += static_cast<char>(0x80 | (code & 0x3F));
}

/// Dots of a column in the character row `row`, counted from below.
std::size_t dots_in(std::size_t height, std::size_t row, std::size_t a_row) {
  return height <= row * a_row ? 0 : std::min(height - row * a_row, a_row);
}

void append_row(std::string& out, const std::vector<std::size_t>& columns, std::size_t row,
                bool braille) {
  constexpr std::array<char, 4> kAscii{' ', '.', ':', '#'};
  for (std::size_t i = 0; i < columns.size(); i += braille ? 2 : 1) {
    if (braille)
      append_braille(out, dots_in(columns[i], row, 4), dots_in(columns[i + 1], row, 4));
    else
      out += kAscii[dots_in(columns[i], row, 3)];
  }
  while (!braille && !out.empty() && out.back() == ' ') out.pop_back();
  out += '\n';
}

/// The line with ticks and the line with their times.
void append_time_axis(std::string& out, double end, std::size_t width, bool braille) {
  const double step = round_step(end, std::max(2.0, static_cast<double>(width) / 20));
  std::string ticks;
  std::string numbers(kLabel - 1, ' ');
  std::size_t drawn = 0;
  for (int i = 0; end > 0 && i * step <= end * (1 + 1e-9) && i < 200; ++i) {
    const double at = i * step / end * static_cast<double>(width - 1);
    const auto column = static_cast<std::size_t>(std::lround(at));
    for (; drawn < column; ++drawn) ticks += braille ? "\u2500" : "-";
    ticks += braille ? "\u2534" : "+";
    ++drawn;
    const std::string number = fmt::format("{:g}{}", i * step, i == 0 ? " s" : "");
    if (numbers.size() > kLabel - 1 + column && i > 0) continue;
    if (kLabel + column + number.size() > kLabel + width + 2) continue;
    numbers.resize(kLabel + column, ' ');
    numbers += number;
  }
  for (; drawn < width; ++drawn) ticks += braille ? "\u2500" : "-";
  out += fmt::format("{:>{}}{}{}\n{}\n", "0", kLabel - 1, braille ? "\u2514" : "+", ticks, numbers);
}

}  // namespace

PlotCanvas canvas_of(std::FILE* out) {
  const bool terminal = fileno(out) >= 0 && isatty(fileno(out)) == 1;
  return {width_of(out), 6, terminal && locale_is_utf8()};
}

std::string terminal_plot(std::span<const float> values, const PlotLabels& labels,
                          const PlotCanvas& canvas) {
  const std::size_t width = std::max(canvas.width, kLeastWidth) - kLabel - 1;
  const std::size_t rows = std::max<std::size_t>(canvas.height, 1);
  double greatest = 0;
  for (const float value : values) greatest = std::max(greatest, sane(value));
  const double top = round_end(greatest, 4);
  const std::size_t a_row = canvas.braille ? 4 : 3;
  const auto columns = heights(values, canvas.braille ? 2 * width : width, top, rows * a_row);

  std::string out;
  for (std::size_t row = rows; row-- > 0;) {
    const std::string label =
        row + 1 == rows ? fmt::format("{:g} {}", top, labels.unit) : std::string();
    out += fmt::format("{:>{}}", label, kLabel - 1);
    out += canvas.braille ? "\u2502" : "|";
    append_row(out, columns, row, canvas.braille);
  }
  append_time_axis(out, labels.end, width, canvas.braille);
  return out;
}

}  // namespace reckon::tools
