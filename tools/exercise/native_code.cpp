// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/native_code.hpp"

#include <fmt/format.h>

#include <system_error>

#include "reckon/peer/drivers/driver.hpp"
#include "reckon/tools/terminal/foreign_text.hpp"

namespace reckon::tools {
namespace {

namespace fs = std::filesystem;

std::string clean(const fs::path& name) {
  std::string text;
  append_clean_text(text, name.string());
  return text;
}

}  // namespace

std::vector<std::string> native_code_of(const peer::SceneFile& scene) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < scene.devices.size(); ++i) {
    const peer::Driver* const driver = scene.devices[i].driver;
    if (driver != nullptr && driver->native_code != nullptr)
      lines.push_back(fmt::format("runs native code: {} (driver {} of device {})",
                                  clean(driver->native_code(scene.devices[i])), driver->name,
                                  i + 1));
  }
  return lines;
}

void say_native_code(const peer::SceneFile& scene, const Console& console) {
  for (const std::string& line : native_code_of(scene)) fmt::print(console.err, "{}\n", line);
}

fs::path native_code_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return (program.parent_path() / "../lib/reckon/plugins").lexically_normal();
}

fs::path trusted_plugin(const fs::path& name, const std::vector<std::string>& given) {
  for (const std::string& file : given)
    if (fs::path(file).filename() == name.filename()) return fs::absolute(file);
  std::error_code error;
  const fs::path installed = native_code_folder() / name.filename();
  if (!name.has_parent_path() && fs::is_regular_file(installed, error)) return installed;
  throw UsageError(
      fmt::format("the scene needs native code from {}: add --plugin {} if you trust it, or "
                  "install it in {} and name it without a folder",
                  clean(name), clean(name), native_code_folder().string()));
}

}  // namespace reckon::tools
