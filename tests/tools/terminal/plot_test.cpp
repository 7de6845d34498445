// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Plots in a terminal and as a picture, which stay valid for any values.
#include "reckon/tools/terminal/plot.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "reckon/tools/plots/curves.hpp"
#include "reckon/tools/terminal/plot_axis.hpp"

namespace reckon::tools::plot_test {
namespace {

using ::testing::HasSubstr;

TEST(TerminalPlot, DrawsColumnsUpToTheValue) {
  const std::vector<float> values{0, 1, 2, 4, 4, 2, 1, 0};
  const std::string plot = terminal_plot(values, {"N", 8}, {34, 4, false});
  const std::string expected =
      "     4 N|         ######\n"
      "        |         ######\n"
      "        |      ############\n"
      "        |   ##################\n";
  EXPECT_EQ(plot.substr(0, expected.size()), expected);
  EXPECT_THAT(plot, HasSubstr("       0+"));
  EXPECT_THAT(plot, HasSubstr("0 s"));
}

TEST(TerminalPlot, HasFourDotsInEachBrailleCharacter) {
  const std::vector<float> values{0, 1, 2, 3, 4};
  const std::string plot = terminal_plot(values, {"N", 5}, {24, 1, true});
  const std::string line = plot.substr(0, plot.find('\n'));
  EXPECT_THAT(line, ::testing::EndsWith("\u28FF"));  // all eight dots
  EXPECT_THAT(line, HasSubstr("\u2502\u2800"));      // none
  EXPECT_THAT(line, HasSubstr("\u28E4"));            // two of four in both columns
}

TEST(TerminalPlot, StaysValidForAnyValuesAndWidths) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<std::vector<float>> cases{
      {}, {0}, {nan, nan}, {infinity, 1}, {-infinity, -1}, {1e30F, 1e-30F}, {1e-40F}};
  for (const auto& values : cases) {
    for (const std::size_t width : {0UL, 1UL, 24UL, 79UL, 400UL}) {
      for (const double end : {0.0, 1e-9, 1e9, -1.0, std::nan("")}) {
        for (const bool braille : {false, true}) {
          const std::string plot = terminal_plot(values, {"N", end}, {width, 3, braille});
          EXPECT_EQ(std::count(plot.begin(), plot.end(), '\n'), 5);
          EXPECT_THAT(plot, Not(HasSubstr("nan")));
        }
      }
    }
  }
}

TEST(SvgPlotText, EscapesNamesAndLimitsItsCurves) {
  SvgPlot plot;
  plot.title = "a < b & \"c\" \xFF";
  plot.end = 2;
  const std::vector<float> values{0, std::numeric_limits<float>::quiet_NaN(), 3};
  for (int i = 0; i < 9; ++i) plot.curves.push_back({"curve <" + std::to_string(i) + ">", values});
  const std::string svg = svg_text(plot);
  EXPECT_THAT(svg, HasSubstr("a &lt; b &amp; &quot;c&quot; ?"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  std::size_t curves = 0;
  for (std::size_t at = svg.find("<polyline"); at != std::string::npos;
       at = svg.find("<polyline", at + 1))
    ++curves;
  EXPECT_EQ(curves, SvgPlot::kMostCurves);
}

/// The points of the first curve.
std::string first_curve(const std::string& svg) {
  const std::size_t begin = svg.find("points=\"", svg.find("<polyline")) + 8;
  return svg.substr(begin, svg.find('"', begin) - begin);
}

TEST(SvgPlotText, DrawsBelowZeroWhereSigned) {
  SvgPlot plot;
  plot.end = 2;
  const std::vector<float> values{-1, 1, -1};
  plot.curves.push_back({"swing", values});
  EXPECT_EQ(first_curve(svg_text(plot)), "64.0,290.0 402.0,66.0 740.0,290.0 ") << "below 0 is 0";
  plot.is_signed = true;
  EXPECT_THAT(svg_text(plot), HasSubstr(">-1</text>"));
  EXPECT_EQ(first_curve(svg_text(plot)), "64.0,290.0 402.0,66.0 740.0,290.0 ") << "-1 to 1";
  plot.range = {-2, 2};
  EXPECT_EQ(first_curve(svg_text(plot)), "64.0,234.0 402.0,122.0 740.0,234.0 ");
}

TEST(SvgPlotText, DrawsCurvesAtTheirPlacesBothWays) {
  SvgPlot plot;
  plot.end = 4;
  const std::vector<float> values{0, 2, 2, 0};
  const std::vector<float> at{0, 4, 2, 0};
  plot.curves.push_back({"there and back", values, at});
  EXPECT_EQ(first_curve(svg_text(plot)), "64.0,290.0 740.0,66.0 402.0,66.0 64.0,290.0 ");
}

TEST(SvgPlotText, LeavesOutPointsOnAStraightLineAlone) {
  SvgPlot plot;
  plot.end = 1;
  std::vector<float> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(static_cast<float>(std::min(i, 500)));
  plot.curves.push_back({"ramp", values});
  EXPECT_EQ(first_curve(svg_text(plot)), "64.0,290.0 402.0,66.0 740.0,66.0 ");
}

TEST(SvgPlotText, StacksPanelsWithoutOverlap) {
  const std::vector<float> values{0, 1};
  SvgPlot plot;
  plot.title = "panel";
  plot.end = 1;
  plot.curves.push_back({"curve", values});
  const std::vector<SvgPlot> plots{plot, plot};
  const std::vector<std::string> notes{"a note"};
  const std::string svg = svg_panels("both", notes, plots);
  const auto ends = [&](std::size_t from) {
    const std::size_t at = svg.find("<svg x=", from);
    const std::size_t y = svg.find(" y=\"", at) + 4;
    return std::pair{std::stod(svg.substr(y)), at};
  };
  const auto [first, at] = ends(0);
  const auto [second, rest] = ends(at + 1);
  EXPECT_GT(second, first + 224 + 62) << "below the legend of the first";
  EXPECT_GT(std::stod(svg.substr(svg.find("height=\"") + 8)), second + 224 + 62);
}

TEST(PlotAxis, HasRoundSteps) {
  EXPECT_DOUBLE_EQ(round_step(10, 4), 2);
  EXPECT_DOUBLE_EQ(round_step(1.25, 4), 0.2);
  EXPECT_DOUBLE_EQ(round_end(1.25, 4), 1.4);
  EXPECT_DOUBLE_EQ(round_end(2.5, 4), 2.5);
  EXPECT_DOUBLE_EQ(round_end(0, 4), 1);
  EXPECT_DOUBLE_EQ(round_step(std::nan(""), 4), 1);
}

}  // namespace
}  // namespace reckon::tools::plot_test
