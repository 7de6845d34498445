// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/key_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "reckon/tests/src/sealing/sealing_samples.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

const std::string kDigits(64, 'a');

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(parse_group_key(text, "g.key"));
  } catch (const KeyFileError& error) {
    return error.what();
  }
  return "taken";
}

TEST(KeyFile, ReadsItsOwnText) {
  GroupKey key = samples::group_key(3);
  const GroupKey read = parse_group_key(group_key_text(key), "g.key");
  EXPECT_EQ(read.group, key.group);
  EXPECT_EQ(read.suite, key.suite);
  ASSERT_EQ(read.epochs.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read.epochs[i].number, key.epochs[i].number);
    EXPECT_EQ(read.epochs[i].from, key.epochs[i].from);
    EXPECT_EQ(read.epochs[i].secret, key.epochs[i].secret);
  }
}

TEST(KeyFile, FaultsNamePlaceAndRemedyButNoSecret) {
  const std::string head = "group g\nsuite aes-256-gcm\n";
  const std::string good = "epoch 1 secret " + kDigits + "\n";
  const std::pair<std::string, std::string> cases[] = {
      {"", "g.key: has no line 'group NAME'"},
      {"group g\n" + good, "has no line 'suite"},
      {head, "has no line 'epoch"},
      {head + "epoch 1 secret " + kDigits + "a\n", "g.key:3: 'secret' needs 64"},
      {head + "epoch 1 secret " + std::string(64, 'g') + "\n", "g.key:3: 'secret' needs 64"},
      {head + "epoch x secret " + kDigits + "\n", "g.key:3: 'epoch' needs a number"},
      {head + "epoch 70000 secret " + kDigits + "\n", "g.key:3: 'epoch' needs a number"},
      {head + good + good, "g.key:4: numbers of epochs must increase"},
      {head + good + "epoch 2 secret " + kDigits + "\n", "g.key:4: each epoch after the first"},
      {head + "epoch 1 from 2026-13-01T00:00:00Z secret " + kDigits, "g.key:3: 'from' needs"},
      {head + "epoch 1 from tomorrow secret " + kDigits, "g.key:3: 'from' needs"},
      {head + good + "suite aes-256-gcm\n", "g.key:4: a second 'suite'"},
      {"suite rot13\n", "g.key:1: 'suite' needs"},
      {"group a b\n", "g.key:1: the line has extra text"},
      {"group " + std::string(33, 'x'), "g.key:1: 'group' needs"},
      {head + kDigits + "\n", "g.key:3: a line begins with"},
  };
  for (const auto& [text, sentence] : cases) {
    EXPECT_THAT(refusal(text), HasSubstr(sentence)) << text;
    EXPECT_THAT(refusal(text), Not(HasSubstr("aaaa")));
  }
}

TEST(KeyFile, HoldsTheEpochThatHasBegunLast) {
  const GroupKey key = samples::group_key(3);
  EXPECT_EQ(key.epoch_at(0s), 0U);
  EXPECT_EQ(key.epoch_at(1h - 1ns), 0U);
  EXPECT_EQ(key.epoch_at(1h), 1U);
  EXPECT_EQ(key.epoch_at(1000h), 2U);
}

TEST(KeyFile, ReadsUtcAsTheCalendarHasIt) {
  EXPECT_EQ(parse_utc("1970-01-01T00:00:00Z"), 0s);
  EXPECT_EQ(parse_utc("2026-12-01T06:00:00Z"), 1796104800s);   // date -d @1796104800 -u
  EXPECT_EQ(parse_utc("2201-01-01T00:00:00Z"), std::nullopt);  // beyond a clock of nanoseconds
  EXPECT_EQ(utc_text(1796104800s), "2026-12-01T06:00:00Z");
  for (const char* none : {"2026-02-29T00:00:00Z", "2026-12-01T24:00:00Z", "2026-12-01 06:00:00Z",
                           "2026-12-01T06:00:00", "1969-01-01T00:00:00Z", "+026-12-01T06:00:00Z"})
    EXPECT_FALSE(parse_utc(none)) << none;
}

class KeyFileOnDisk : public testing::Test {
 protected:
  std::string path() const { return folder_.file("g.key"); }
  std::string refusal() const {
    try {
      static_cast<void>(load_group_key(path()));
    } catch (const KeyFileError& error) {
      return error.what();
    }
    return "taken";
  }
  test::ScratchFolder folder_;
};

TEST_F(KeyFileOnDisk, IsForItsOwnerAlone) {
  save_group_key(samples::group_key(), path(), false);
  struct stat state {};
  ASSERT_EQ(::stat(path().c_str(), &state), 0);
  EXPECT_EQ(state.st_mode & 07777, 0600U);
  EXPECT_EQ(refusal(), "taken");
  for (const mode_t mode : {0640, 0604, 0620, 0601}) {
    ASSERT_EQ(::chmod(path().c_str(), mode), 0);
    EXPECT_THAT(refusal(), HasSubstr("chmod 600 " + path()));
  }
}

TEST_F(KeyFileOnDisk, IsRefusedWhereItBelongsToAnother) {
  save_group_key(samples::group_key(), path(), false);
  if (::chown(path().c_str(), 12345, 12345) != 0) GTEST_SKIP() << "only root gives files away";
  EXPECT_THAT(refusal(), HasSubstr("another user (uid 12345)"));
  EXPECT_THAT(refusal(), HasSubstr("install -m 600"));
}

TEST_F(KeyFileOnDisk, DisablesCoreDumpsOfTheReadingProcess) {
  save_group_key(samples::group_key(), path(), false);
  ASSERT_EQ(refusal(), "taken");
  EXPECT_EQ(::prctl(PR_GET_DUMPABLE), 0);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_CORE, &limit), 0);
  EXPECT_EQ(limit.rlim_cur, 0U);
}

TEST_F(KeyFileOnDisk, IsNotOverwrittenUnlessAsked) {
  save_group_key(samples::group_key(), path(), false);
  EXPECT_THROW(save_group_key(samples::group_key(2), path(), false), KeyFileError);
  EXPECT_EQ(load_group_key(path()).epochs.size(), 1U);
  save_group_key(samples::group_key(2), path(), true);
  EXPECT_EQ(load_group_key(path()).epochs.size(), 2U);
}

TEST_F(KeyFileOnDisk, NamesFilesThatAreNoKeyFile) {
  EXPECT_THAT(refusal(), HasSubstr("reckon key new"));
  std::filesystem::create_directory(path());
  EXPECT_THAT(refusal(), HasSubstr("is not a file"));
  std::filesystem::remove(path());
  std::ofstream(path()) << std::string(20000, '#');
  ASSERT_EQ(::chmod(path().c_str(), 0600), 0);
  EXPECT_THAT(refusal(), HasSubstr("too long for a key file"));
}

TEST(RandomSource, ThatFailsMakesNoKeyAndNoBoot) {
  const RandomSource failing = [](std::span<std::byte>) noexcept { return false; };
  EXPECT_THROW(static_cast<void>(draw_epoch(1, std::nullopt, failing)), RandomSourceError);
  EXPECT_THROW(EnvelopeSealer(samples::group_key(), 1, 1, {}, failing), RandomSourceError);
}

}  // namespace
}  // namespace reckon::peer
