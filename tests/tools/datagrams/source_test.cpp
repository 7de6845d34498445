// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The groups of a source.
#include "reckon/tools/datagrams/source.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <string>

#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/support/tier_rows.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {
namespace {

using ::testing::HasSubstr;

class SourceOfAScene : public testing::Test {
 protected:
  SourceChoice scene(const std::string& text) {
    const std::string file = folder_.file("scene.toml");
    std::ofstream(file) << text;
    SourceChoice choice;
    choice.source = file;
    return choice;
  }
  reckon::test::ScratchFolder folder_;
};

TEST_F(SourceOfAScene, HasTheGroupsOfCellsAndContacts) {
  const SourceChoice plain = scene("[network]\ngroup = \"239.192.9.0\"\n[aoim]\npool = 40\n");
  EXPECT_TRUE(means_groups(plain));
  EXPECT_EQ(groups_of(plain).size(), 1U + 40U);
  EXPECT_EQ(groups_of(plain).front().text(), "239.192.9.0:3000");
  SourceChoice felt = scene("[aoim]\npool = 40\n" + reckon::test::kTouchTier);
  EXPECT_EQ(groups_of(felt).size(), 1U + 2U * 40U);
  felt.pool = 4;
  EXPECT_EQ(groups_of(felt).size(), 1U + 4U) << "the flag goes before the scene";
}

TEST_F(SourceOfAScene, IsOnePortAboveWhereItIsSealed) {
  SourceChoice choice = scene("[aoim]\npool = 4\n");
  choice.sealed = true;
  EXPECT_EQ(groups_of(choice).front().text(), "239.192.1.0:3001");
}

TEST_F(SourceOfAScene, IsOneGroupInPlainDis) {
  EXPECT_EQ(groups_of(scene("[network]\ninterop = true\n")).size(), 1U);
}

TEST_F(SourceOfAScene, WithUnicastPeersIsRefusedWithTheRemedy) {
  const SourceChoice choice = scene("[network]\npeers = [\"10.0.0.2\"]\n");
  try {
    static_cast<void>(groups_of(choice));
    ADD_FAILURE() << "taken";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("inspect iface:NAME"));
  }
  SourceChoice none;
  none.source = folder_.file("none.toml");
  EXPECT_THROW(static_cast<void>(groups_of(none)), UsageError);
}

}  // namespace
}  // namespace reckon::tools
