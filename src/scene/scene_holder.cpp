// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/scene_holder.hpp"

#include <utility>

#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {

SceneHolder::SceneHolder() : scene_(std::make_unique<SceneFile>()) {}
SceneHolder::SceneHolder(SceneFile scene) : scene_(std::make_unique<SceneFile>(std::move(scene))) {}
SceneHolder::SceneHolder(const SceneHolder& other)
    : scene_(std::make_unique<SceneFile>(*other.scene_)) {}
SceneHolder::SceneHolder(SceneHolder&& other) noexcept = default;
SceneHolder& SceneHolder::operator=(SceneHolder other) noexcept {
  scene_.swap(other.scene_);
  return *this;
}
SceneHolder::~SceneHolder() = default;

}  // namespace reckon::peer
