// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A scene file by value, for headers that need not include its contents.
#pragma once

#include <memory>

namespace reckon::peer {

struct SceneFile;

/// Holds a whole SceneFile; a copy copies it. Empty only after a move. Include scene_file.hpp to
/// access it.
class SceneHolder {
 public:
  SceneHolder();  ///< a scene of defaults
  SceneHolder(SceneFile scene);
  SceneHolder(const SceneHolder& other);
  SceneHolder(SceneHolder&& other) noexcept;
  SceneHolder& operator=(SceneHolder other) noexcept;
  ~SceneHolder();

  [[nodiscard]] SceneFile& operator*() noexcept { return *scene_; }
  [[nodiscard]] const SceneFile& operator*() const noexcept { return *scene_; }
  [[nodiscard]] SceneFile* operator->() noexcept { return scene_.get(); }
  [[nodiscard]] const SceneFile* operator->() const noexcept { return scene_.get(); }

 private:
  std::unique_ptr<SceneFile> scene_;
};

}  // namespace reckon::peer
