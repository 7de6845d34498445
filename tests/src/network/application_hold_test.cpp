// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/application_hold.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace reckon::peer {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// A scope of this process alone, so that tests may run in parallel.
ApplicationScope scope() {
  ApplicationScope scope;
  scope.group = *GroupAddress::parse("239.192.7.7:3000");
  scope.site = static_cast<std::uint16_t>(1 + ::getpid() % 60'000);
  return scope;
}

std::string refusal(const ApplicationScope& scope, std::uint16_t wanted) {
  try {
    const ApplicationHold hold(scope, wanted);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(ApplicationHold, TakesTheSmallestFreeNumberAndReportsIt) {
  const ApplicationHold first(scope(), {});
  const ApplicationHold second(scope(), {});
  const ApplicationHold third(scope(), {});
  EXPECT_EQ(first.number(), 1);
  EXPECT_EQ(first.report(), "");
  EXPECT_EQ(second.number(), 2);
  EXPECT_EQ(third.number(), 3);
  EXPECT_THAT(third.report(), AllOf(HasSubstr("this is application 3 of site"),
                                    HasSubstr("process " + std::to_string(::getpid()) + " (")));
}

TEST(ApplicationHold, RefusesATakenNumberAndNamesItsHolder) {
  const ApplicationHold holder(scope(), 7);
  EXPECT_EQ(holder.report(), "");
  EXPECT_THAT(refusal(scope(), 7), AllOf(HasSubstr("application 7 of site"),
                                         HasSubstr("is used on this host by process "),
                                         HasSubstr("choose another application")));
  const ApplicationHold next(scope(), {});
  EXPECT_EQ(next.number(), 1);
}

TEST(ApplicationHold, PassesOverNumbersThatWereNamed) {
  const ApplicationHold named(scope(), 2);
  const ApplicationHold first(scope(), {}), second(scope(), {});
  EXPECT_EQ(first.number(), 1);
  EXPECT_EQ(second.number(), 3);
}

TEST(ApplicationHold, FreesItsNumberAtItsEnd) {
  auto first = std::make_unique<ApplicationHold>(scope(), std::nullopt);
  const ApplicationHold second(scope(), {});
  first.reset();
  const ApplicationHold third(scope(), {});
  EXPECT_EQ(third.number(), 1);
}

TEST(ApplicationHold, IsFreeWhenItsProcessIsKilled) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const ApplicationHold hold(scope(), 5);
    if (::write(ready[1], "x", 1) == 1) ::pause();
    ::_exit(0);
  }
  ApplicationScope of_child = scope();
  of_child.site = static_cast<std::uint16_t>(1 + child % 60'000);
  char octet;
  ASSERT_EQ(::read(ready[0], &octet, 1), 1);
  EXPECT_THAT(refusal(of_child, 5), HasSubstr("process " + std::to_string(child)));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(refusal(of_child, 5), "");
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(ApplicationHold, GivesParallelRequestsDistinctNumbers) {
  constexpr std::size_t kAsking = 16;
  std::vector<std::unique_ptr<ApplicationHold>> holds(kAsking);
  std::vector<std::thread> threads;
  for (auto& hold : holds)
    threads.emplace_back(
        [&hold] { hold = std::make_unique<ApplicationHold>(scope(), std::nullopt); });
  for (std::thread& thread : threads) thread.join();
  std::set<std::uint16_t> numbers;
  for (const auto& hold : holds) numbers.insert(hold->number());
  EXPECT_EQ(numbers.size(), kAsking);
  EXPECT_EQ(*numbers.rbegin(), kAsking) << "a number was left out";
}

TEST(ApplicationHold, KeepsGroupsExercisesAndSitesApart) {
  const ApplicationHold here(scope(), 1);
  for (void (*change)(ApplicationScope&) :
       {+[](ApplicationScope& other) { other.exercise = 2; },
        +[](ApplicationScope& other) { other.group.port = 3001; },
        +[](ApplicationScope& other) { other.site = 65'000; }}) {
    ApplicationScope other = scope();
    change(other);
    EXPECT_EQ(refusal(other, 1), "");
  }
}

TEST(ApplicationHold, RefusesNumbersThatAreNoneOfAnId) {
  EXPECT_THAT(refusal(scope(), 0), HasSubstr("choose 1 to 65534"));
  EXPECT_THAT(refusal(scope(), 65'535), HasSubstr("choose 1 to 65534"));
  EXPECT_EQ(refusal(scope(), 65'534), "");
}

}  // namespace
}  // namespace reckon::peer
