// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/browser_redirect.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <system_error>

#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::tools {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

/// Sets an environment variable for a scope.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* const before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(BrowserRedirect, KeepsTheWordOutOfArguments) {
  const test::ScratchFolder folder;
  const std::string told = folder.file("told"), fake = folder.file("xdg-open");
  ASSERT_EQ(mkfifo(told.c_str(), 0600), 0);
  std::ofstream(fake) << "#!/bin/sh\necho \"$0 $*\" > " << told << "\n";
  fs::permissions(fake, fs::perms(0700));
  const Variable path("PATH", fs::path(fake).parent_path().string() + ":" + std::getenv("PATH"));
  const Variable run("XDG_RUNTIME_DIR", fs::path(fake).parent_path().string());
  auto redirect = std::make_unique<BrowserRedirect>("http://127.0.0.1:8642/#word=5ec4e7");
  std::string arguments = text_of(told);  // until the program has printed them
  arguments.pop_back();
  EXPECT_THAT(arguments, Not(HasSubstr("5ec4e7")));
  const fs::path file = arguments.substr(arguments.find(' ') + 1);
  EXPECT_THAT(text_of(file), HasSubstr("url=http://127.0.0.1:8642/#word=5ec4e7\""));
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0600));
  EXPECT_EQ(fs::status(file.parent_path()).permissions(), fs::perms(0700));
  redirect.reset();
  EXPECT_FALSE(fs::exists(file.parent_path()));
}

TEST(BrowserRedirect, FolderThatTakesNoFileIsAnError) {
  const Variable none("XDG_RUNTIME_DIR", "/proc");
  EXPECT_THROW(BrowserRedirect("http://127.0.0.1:1/#word=1f2e"), std::system_error);
}

}  // namespace
}  // namespace reckon::tools
