// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/impairment_text.hpp"

#include <gmock/gmock.h>

#include <string>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;

std::string error_of(std::string_view text) {
  try {
    static_cast<void>(parse_impairment(text));
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

TEST(ImpairmentText, TakesJitterAsATimeOrDelayShare) {
  EXPECT_EQ(parse_impairment("delay=200ms jitter=100ms").jitter, 100ms);
  EXPECT_EQ(parse_impairment("jitter=5ms").jitter, 5ms);
  EXPECT_EQ(parse_impairment("delay=80ms jitter=40%").jitter, 32ms);
  EXPECT_EQ(parse_impairment("jitter=40%,delay=80ms").jitter, 32ms);
}

TEST(ImpairmentText, ErrorsNameTheSpellingsOfJitter) {
  EXPECT_THAT(error_of("delay=80ms jitter=0.4"),
              AllOf(HasSubstr("--impair jitter: '0.4'"), HasSubstr("5ms"), HasSubstr("40%")));
  EXPECT_THAT(error_of("jitter=40%"), HasSubstr("which is 0; write delay=80ms too"));
  EXPECT_THAT(error_of("jitter"), HasSubstr("--impair jitter: ''"));
}

}  // namespace
}  // namespace reckon::tools
