// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Native code that a scene requests: reported first, and loaded only if the user names it.
#include "reckon/tools/exercise/native_code.hpp"

#include <dlfcn.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

namespace fs = std::filesystem;
using test::run_reckon;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class NativeCode : public ::testing::Test {
 protected:
  NativeCode() {
    fs::create_directory(folder_.file("elsewhere"));
    for (const std::string& place : {driver_, folder_.file("mine.so")})
      fs::copy_file(fs::path(RECKON_TEST_DRIVERS) / "dummy_device.so", place);
  }
  /// A scene whose device requests this file.
  [[nodiscard]] std::string scene_of(const std::string& plugin) const {
    const std::string scene = folder_.file("scene.toml");
    std::ofstream(scene) << "[[operator]]\npassive = true\n[[device]]\ndriver = \"plugin\"\n"
                         << "plugin = \"" << plugin << "\"\n";
    return scene;
  }
  [[nodiscard]] static bool is_loaded(const std::string& file) {
    void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_NOLOAD);
    if (library != nullptr) dlclose(library);
    return library != nullptr;
  }
  [[nodiscard]] static auto demo(const std::string& scene, std::vector<std::string> more = {}) {
    std::vector<std::string> words{"demo", scene, "--peers", "1", "--for", "50ms", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run_reckon(words);
  }

  const test::ScratchFolder folder_;
  const std::string driver_ = folder_.file("elsewhere/honey.so");
};

TEST_F(NativeCode, IsReportedFirstAndNotLoadedByReaders) {
  const std::string scene = scene_of("elsewhere/honey.so");
  const std::string says = "runs native code: elsewhere/honey.so (driver plugin of device 1)\n";
  const auto check = run_reckon({"scene", "check", scene});
  EXPECT_EQ(check.status, 0) << check.out;
  EXPECT_THAT(check.out, StartsWith(scene + ": " + says));
  const auto explain = run_reckon({"scene", "explain", scene});
  EXPECT_EQ(explain.status, 0) << explain.err;
  EXPECT_THAT(explain.out, StartsWith(says));
  for (const char* verb : {"check", "explain"}) {
    const auto json = run_reckon({"scene", verb, "--json", scene}).lines().front();
    EXPECT_THAT(nlohmann::json::parse(json)["native_code"],
                ElementsAre(says.substr(0, says.size() - 1)))
        << verb;
  }
  EXPECT_FALSE(is_loaded(driver_));
}

TEST_F(NativeCode, ScenePathsAreRefusedWithTheRemedy) {
  for (const std::string& plugin : {std::string("elsewhere/honey.so"), driver_,
                                    std::string("honey.so"), std::string("../../x/honey.so")}) {
    for (const auto& result :
         {demo(scene_of(plugin)), run_reckon({scene_of(plugin), "--for", "50ms"}),
          run_reckon(
              {"peer", scene_of(plugin), "--iface", "lo", "--for", "50ms", "--operator", "1"})}) {
      EXPECT_EQ(result.status, 2) << result.err;
      EXPECT_THAT(result.err, AllOf(HasSubstr("runs native code: " + plugin + " (driver"),
                                    HasSubstr("needs native code from " + plugin +
                                              ": add --plugin " + plugin + " if you trust it")));
    }
  }
  EXPECT_FALSE(is_loaded(driver_));
}

TEST_F(NativeCode, IsLoadedFromTheFileTheUserNames) {
  for (const char* plugin : {"honey.so", "/nowhere/honey.so"}) {
    const auto result = demo(scene_of(plugin), {"--plugin", driver_});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("loaded from " + driver_));
  }
  const auto other = demo(scene_of("honey.so"), {"--plugin", folder_.file("mine.so")});
  EXPECT_EQ(other.status, 2) << "matched by its name";
  const auto none = demo(scene_of("honey.so"), {"--plugin", folder_.file("none.so")});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("--plugin: file"));
}

TEST_F(NativeCode, IsLoadedFromTheInstalledFolderByName) {
  fs::create_directories(native_code_folder());
  const fs::path installed = native_code_folder() / "native_code_test.so";
  fs::copy_file(driver_, installed, fs::copy_options::overwrite_existing);
  EXPECT_EQ(trusted_plugin("native_code_test.so", {}), installed);
  const auto plain = demo(scene_of("native_code_test.so"));
  EXPECT_EQ(plain.status, 0) << plain.err;
  EXPECT_THAT(plain.err, HasSubstr("loaded from " + installed.string()));
  EXPECT_EQ(demo(scene_of("../plugins/native_code_test.so")).status, 2);
  fs::remove(installed);
}

TEST_F(NativeCode, SimulatedTimeNeedsNone) {
  const auto result = demo(scene_of("honey.so"), {"--simulated-time"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, Not(HasSubstr("native code")));
}

TEST_F(NativeCode, NamesMoveNoCursor) {
  const auto result = run_reckon({"scene", "check", scene_of("\\u001b[2Jx.so")});
  EXPECT_THAT(result.out, AllOf(HasSubstr("native code: .[2Jx.so"), Not(HasSubstr("\x1b"))));
}

}  // namespace
}  // namespace reckon::tools
