// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The outputs that follow from the fields of a row, for every study.
#include "reckon/bench/studies/frame/fields.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "reckon/tests/tools/support/written_files.hpp"

namespace reckon::bench::fields_test {
namespace {

using nlohmann::json;
using test::cells_of;
using test::lines_of;

struct Row {
  std::string name;
  std::optional<double> error;
  int count = 0;
  bool good = false;
};

Fields fields_of(const Row& row) {
  return Fields("row")
      .value("name", Value::quoted(row.name))
      .value("error", row.error)
      .value("count", row.count)
      .value("good", row.good)
      .value("rounded", Value::decimals(row.error, 1))
      .json("parts", Value::array(std::vector<int>{1, 2},
                                  [](int part) { return Fields().json("part", part); }))
      .csv("parts", row.count)
      .word("NAME", row.name)
      .shown("ERROR", "error [m]", row.error.value_or(0), row.error ? "some" : "-")
      .page_word("by", row.name);
}

const std::vector<Row> kRows{{"a, \"b\"", 0.25, 3, true}, {"c", std::nullopt, 0, false}};

TEST(Fields, CsvHasACellForEachTitle) {
  const auto lines = lines_of(csv_of(kRows, fields_of));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0], "name,error,count,good,rounded,parts");
  EXPECT_EQ(lines[1], "\"a, \"\"b\"\"\",0.25,3,1,0.2,3");
  EXPECT_EQ(lines[2], "\"c\",,0,0,,0");
  EXPECT_EQ(lines_of(csv_of(std::vector<Row>{}, fields_of)).size(), 1U) << "titles without rows";
}

TEST(Fields, JsonIsOneObjectPerLine) {
  const auto lines = lines_of(json_of(kRows, fields_of));
  ASSERT_EQ(lines.size(), 2U);
  const json first = json::parse(lines[0]), second = json::parse(lines[1]);
  EXPECT_EQ(first["kind"], "row");
  EXPECT_EQ(first["name"], "a, \"b\"");
  EXPECT_EQ(first["error"], 0.25);
  EXPECT_EQ(first["good"], true);
  EXPECT_EQ(first["parts"][1]["part"], 2);
  EXPECT_TRUE(second["error"].is_null());
  EXPECT_TRUE(second["rounded"].is_null());
}

TEST(Fields, NonFiniteNumbersAreNullInJson) {
  for (const double number : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    const Fields fields = Fields().value("number", number);
    EXPECT_EQ(fields.object(), "{\"number\":null}");
    EXPECT_EQ(fields.csv_values(), fmt::format("{}", number));
  }
}

TEST(Fields, TableHasTitlesAndRows) {
  const auto lines = lines_of(table_of(kRows, fields_of));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0], "NAME    ERROR");
  EXPECT_EQ(lines[1], "a, \"b\"   some");
}

TEST(Fields, OneTextCanReplaceTheLastCells) {
  Fields fields = fields_of(kRows[0]);
  fields.instead(1, "none").page_instead(0, "none");
  EXPECT_THAT(fields.cells(), testing::ElementsAre("a, \"b\"", "none"));
  EXPECT_EQ(fields.columns().size(), 2U);
  EXPECT_EQ(fields.page_cells(), "<td class=\"w\" colspan=\"2\">none</td>");
}

TEST(Fields, PageTableMarksDominatedRows) {
  const std::string page = page_table_of(kRows, fields_of, [](const Row& row) { return row.good; });
  EXPECT_EQ(test::unbalanced(page), "");
  EXPECT_THAT(page, testing::HasSubstr("<th>error [m]</th><th class=\"w\">by</th>"));
  EXPECT_THAT(page, testing::HasSubstr("<tr class=\"d\"><td data-v=\"0.25\">some</td>"));
  EXPECT_THAT(page, testing::HasSubstr("<tr><td data-v=\"0\">-</td><td class=\"w\">c</td></tr>"));
}

TEST(Fields, CsvCellIsQuotedOnlyWhereNeeded) {
  EXPECT_EQ(csv_cell("plain"), "plain");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("say \"x\""), "\"say \"\"x\"\"\"");
}

}  // namespace
}  // namespace reckon::bench::fields_test
