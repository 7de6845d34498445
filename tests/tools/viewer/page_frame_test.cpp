// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/page_frame.hpp"

#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>

#include "reckon/tools/viewer/page_files.hpp"

namespace reckon::tools {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A page of three modules, one of which is imported twice.
std::string_view small_page(std::string_view name) {
  static const std::map<std::string_view, std::string_view> kFiles{
      {"index.html",
       "<head><link rel=\"stylesheet\" href=\"page.css\"></head>\n"
       "<body><script type=\"module\" src=\"main.js\"></script></body>\n"},
      {"page.css", "body{margin:0}\n"},
      {"main.js", "import { b } from './b.js';\nimport { c } from './c.js';\nb(c);\n"},
      {"b.js", "import { c } from './c.js';\nexport function b() { return c; }"},
      {"c.js", "export const c = 1;\n"}};
  return kFiles.at(name);
}

std::size_t count_of(std::string_view text, std::string_view part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(PageFrame, JoinsEachModuleOnceBeforeItsImporters) {
  EXPECT_EQ(bundle_modules("main.js", small_page),
            "const c = 1;\nfunction b() { return c; }\nb(c);\n");
}

TEST(PageFrame, LetsItsOwnScriptAndStyleAloneRun) {
  const std::string frame = page_frame(small_page);
  // SHA-256 of the two texts, computed by another program.
  EXPECT_THAT(frame,
              HasSubstr("default-src 'none'; "
                        "script-src 'sha256-AYXB7hUV2fe9ZDuwX+4dGpmnmEloLjrCSjqoRAVm/LE='; "
                        "style-src 'sha256-bWBoGApccQxoyO4OKQy5s3s0UEktP5465GCD3rFS+88='; "));
  EXPECT_THAT(frame, HasSubstr("<style>body{margin:0}\n</style>"));
  EXPECT_THAT(frame, HasSubstr("<script type=\"application/json\" id=\"saved\"></script>"
                               "<script type=\"module\">const c = 1;\n"));
}

TEST(PageFrame, OfThePageItselfAsksForNothingElse) {
  const PageFile* frame = find_page_file("/frame.html");
  ASSERT_NE(frame, nullptr);
  EXPECT_TRUE(frame->gzip.empty());
  EXPECT_TRUE(frame->text.starts_with("<!doctype html>"));
  EXPECT_EQ(count_of(frame->text, "</script>"), 2U);
  for (const char* absent : {"src=\"main.js\"", "href=\"page.css\"", "\nimport ", "\nexport "})
    EXPECT_THAT(std::string(frame->text), Not(HasSubstr(absent)));
}

TEST(PageFrame, EmbedsAnyContentSafely) {
  const auto items = nlohmann::json::array({"</script><script>alert(1)</script>", "<!--"});
  const std::string file = filled_frame(page_frame(small_page), items.dump());
  EXPECT_EQ(count_of(file, "</script>"), 2U) << "its own";
  const std::size_t begin = file.find(kFramePlace) + kFramePlace.size();
  EXPECT_EQ(nlohmann::json::parse(file.substr(begin, file.find("</script>") - begin)), items);
}

}  // namespace
}  // namespace reckon::tools
