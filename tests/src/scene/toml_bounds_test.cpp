// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Limits of a text, checked before it is parsed.
#include "reckon/peer/scene/toml_bounds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "reckon/peer/scene/device_descriptor.hpp"
#include "reckon/peer/scene/toml_reader.hpp"
#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer {
namespace {

using test::refusal;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::string repeated(const std::string& text, std::size_t times) {
  std::string out;
  while (times-- > 0) out += text;
  return out;
}

std::string bound_of(const std::string& text) {
  try {
    check_text_bounds(text, "x.toml");
    return {};
  } catch (const SceneFileError& error) {
    return error.what();
  }
}

TEST(TomlBounds, RefuseEveryKindOfDepthWithItsPlace) {
  const std::string parts = repeated("a.", 30'000) + "a";
  EXPECT_THAT(refusal("\n" + parts + " = 1"),
              StartsWith("x.toml:2:512: more than 256 nested tables"));
  EXPECT_THAT(refusal("[" + parts + "]\n"),
              StartsWith("x.toml:1:513: more than 256 nested tables"));
  EXPECT_THAT(refusal("[[" + parts + "]]\n"), HasSubstr("more than 256 nested tables"));
  EXPECT_THAT(refusal("x = " + repeated("[", 300)), HasSubstr("more than 256 nested tables"));
  EXPECT_THAT(refusal("x = {y = 1, " + parts + " = 2}"), HasSubstr("more than 256 nested tables"));
  const std::string tables = repeated("{" + repeated("a.", 30) + "a = ", 10);
  EXPECT_THAT(refusal("x = " + tables), HasSubstr("more than 256 nested tables")) << "they add up";
  const std::string header = "[" + repeated("a.", 200) + "a]\n";
  EXPECT_THAT(refusal(header + repeated("b.", 100) + "b = 1\n"),
              HasSubstr("more than 256 nested tables"));
}

TEST(TomlBounds, RefuseDescriptorsToo) {
  EXPECT_THROW((void)parse_device_descriptor(repeated("a.", 30'000) + "a = 1", "d.toml"),
               SceneFileError);
}

TEST(TomlBounds, AcceptAllThatIsNoDepth) {
  const std::string dots = repeated("a.", 1000);
  EXPECT_THAT(bound_of("\"" + dots + "\" = 1\n'" + dots + "' = 2\n"), IsEmpty()) << "quoted parts";
  EXPECT_THAT(bound_of("x = \"" + dots + "\\\"" + dots + "\" # " + dots + "\n"), IsEmpty());
  EXPECT_THAT(bound_of("x = '''\n" + dots + "''" + dots + "'''''\ny = 1\n"), IsEmpty());
  EXPECT_THAT(bound_of("x = \"\"\"\n" + dots + "\\\"\"\"" + dots + "\"\"\"\n"), IsEmpty());
  EXPECT_THAT(bound_of(repeated("a.b.c = 1.5\n", 1000)), IsEmpty()) << "lines do not add up";
  EXPECT_THAT(bound_of("x = [" + repeated("[1.5, {a.b = 2}],\n", 1000) + "]\n"), IsEmpty());
  EXPECT_THAT(bound_of(repeated("[a.b.c]\nd = {e = 1}\n", 1000)), IsEmpty());
  EXPECT_THAT(bound_of(repeated("a.", 255 - 1) + "a = 1"), IsEmpty()) << "at the bound";
}

TEST(TomlBounds, CountDepthBehindTexts) {
  const std::string deep = repeated("a.", 300) + "a = 1\n";
  for (const char* text :
       {"x = \"\\\\\"\n", "x = '\\'\n", "x = \"\"\"a\"\"\"\"\"\n", "x = ''''''\n", "x = \"\"\n",
        "x = '''\n\\'''\n", "x = [\"\"\"a\"\"\"\", {", "# '''\n", "\"'\".b = '\"'\n"})
    EXPECT_THAT(bound_of(text + deep), HasSubstr("more than 256 nested tables")) << text;
}

TEST(TomlBounds, RefuseTooManyValuesAndOctets) {
  EXPECT_THAT(refusal("x = [" + repeated("1,", kMostTomlValues) + "]"),
              HasSubstr("more than 300000 keys and values"));
  EXPECT_THAT(refusal("#" + std::string(kMostTomlOctets, 'a')), HasSubstr("more than 16 MiB"));
}

TEST(TomlBounds, LimitTablesAndProblems) {
  EXPECT_THAT(refusal(repeated("[[entity]]\n", kMostTables + 1)),
              HasSubstr("100001 tables 'entity'; write 100000 at most"));
  std::string wrong;
  for (std::size_t i = 0; i < 2 * kMostProblems; ++i) wrong += "[[entity]]\npeer = true\n";
  const std::string said = refusal(wrong);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), kMostProblems);
  EXPECT_THAT(said, HasSubstr("fix these first"));
}

}  // namespace
}  // namespace reckon::peer
