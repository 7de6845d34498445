// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace reckon::test {

/// A scene of a floor, and one of a floor with friction and a ball.
inline constexpr const char* kPlain = "[[object]]\nname = \"floor\"\nplane = [0, 0, 1]\n";
inline constexpr const char* kFriction =
    "[[object]]\nname = \"floor\"\nplane = [0, 0, 1]\nfriction = { static = 0.6, kinetic = 0.4 }\n"
    "[[object]]\nname = \"ball\"\nsphere = \"40 mm\"\n";

/// A scene file that is removed at the end of its scope.
class TemporaryScene {
 public:
  explicit TemporaryScene(const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              fmt::format("reckon_verb_scene_{}_{}.toml", getpid(), ++count_)) {
    std::ofstream(path_) << text;
  }
  ~TemporaryScene() { std::filesystem::remove(path_); }
  TemporaryScene(const TemporaryScene&) = delete;
  TemporaryScene& operator=(const TemporaryScene&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  inline static int count_ = 0;
  std::filesystem::path path_;
};

}  // namespace reckon::test
