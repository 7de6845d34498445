// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/notice_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

ReceivedNotice refusal() {
  ReceivedNotice heard;
  heard.by = {1, 2};
  heard.notice.kind = peer::NoticeKind::touch_refused;
  heard.notice.severity = peer::Severity::warning;
  std::string_view("9:1:4 is not felt").copy(heard.notice.text.data(), 17);
  return heard;
}

TEST(NoticeLog, AppendsALineForEachNotice) {
  const test::ScratchFolder folder;
  const test::CapturedStream err;
  const Console console{.out = err.file(), .err = err.file()};
  NoticeLog(folder.file("log"), console).add(refusal());
  NoticeLog log(folder.file("log"), console);
  log.add("the stylus was unplugged");
  std::ifstream file(folder.file("log"));
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  constexpr std::string_view kTime = "20[0-9]+-[0-9]+-[0-9]+T[0-9:]+\\.[0-9][0-9][0-9]Z ";
  EXPECT_THAT(text, ContainsRegex(
                        "^" + std::string(kTime) + "warning touch-refused 1:2 9:1:4 is not felt\n" +
                        std::string(kTime) + "warning device - the stylus was unplugged\n$"));
  EXPECT_EQ(err.text(), "");
}

TEST(NoticeLog, RefusesAFileItCannotOpen) {
  const test::CapturedStream err;
  const Console console{.out = err.file(), .err = err.file()};
  EXPECT_THROW(NoticeLog("/nowhere/log", console), UsageError);
}

TEST(NoticeLog, ReportsAFullDiskOnce) {
  const test::CapturedStream err;
  const Console console{.out = err.file(), .err = err.file()};
  NoticeLog log("/dev/full", console);
  log.add(refusal());
  log.add(refusal());
  EXPECT_EQ(err.text(),
            "--log /dev/full: No space left on device; further notices are not logged\n");
}

}  // namespace
}  // namespace reckon::tools
