// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/output_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::tools {
namespace {

TEST(OutputFile, ACheckLeavesTheFolderAsItWas) {
  const test::ScratchFolder folder;
  const std::string absent = folder.file("absent.csv"), present = folder.file("present.csv");
  const std::string link = folder.file("link.csv");
  std::ofstream(present) << "kept";
  std::filesystem::create_symlink(folder.file("target.csv"), link);
  for (const std::string& path : {std::string(), absent, present, link}) check_writable(path);
  EXPECT_FALSE(std::filesystem::exists(absent));
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  std::ifstream file(present);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "kept");
}

TEST(OutputFile, ACheckNamesAFolderThatIsNone) {
  try {
    check_writable("/no/such/folder/a.csv");
    FAIL() << "taken";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("/no/such/folder/a.csv: cannot be written"));
  }
}

}  // namespace
}  // namespace reckon::tools
