// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers without hands in a field whose cells have leaders.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {

// Cells of 100 m; no peer has device 60, so that none has a hand.
inline constexpr std::string_view kField = R"(
[scene]
name = "field"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}
[dead_reckoning]
heartbeat = "60 s"
[aoim]
scheme = "square"
cell = "100 m"
radius = "20 m"
pool = 16
leaders = true
[[operator]]
passive = true
position = "0 0 0 m"
[[device]]
peer = 60
operator = 1
)";

inline const Eigen::Vector3d kMiddle(50.0, 50.0, 0.0);  // centre of a cell

struct Leader {
  std::string scene, cell;
  friend bool operator==(const Leader&, const Leader&) = default;
};

inline std::string name_of(const pdu::SimulationAddress& id) {
  return std::to_string(id.site) + ':' + std::to_string(id.application);
}

// Peers with entities at rest in one cell.
class Field {
 public:
  explicit Field(std::size_t links, std::string_view text = kField)
      : scene_(scene_of(text)), world_(links), alive_(links, false) {
    world_.listen(scene_);
  }

  /// @param east of the centre of cell 0,0 [m]
  void start(std::size_t link, std::size_t entities = 1, bool haptic = false, double east = 0.0) {
    world_.start(link, scene_);
    alive_[link] = true;
    for (std::size_t i = 1; i <= entities; ++i) {
      peer::EntityDescription post;
      post.marking = "POST";
      post.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1, 0, 0, 0};
      post.dead_reckoning.heartbeat = seconds(60);
      if (haptic) {
        post.model.emplace();
        post.model->kind = pdu::ForceModelKind::sphere;
        post.model->k1 = 500.0;
        post.model->radius = 0.05;
        post.model->validity = 60.0;
      }
      world_.peer(link).model().add(static_cast<peer::EntityNumber>(i), post,
                                    truth({east + 0.01 * static_cast<double>(i), 0, 0}));
    }
  }
  void stop(std::size_t link) {
    world_.stop(link);
    alive_[link] = false;
  }
  void kill(std::size_t link) {
    world_.kill(link);
    alive_[link] = false;
  }
  [[nodiscard]] peer::EntityTruth truth(const Eigen::Vector3d& beside) {
    peer::EntityTruth truth;
    truth.time = world_.clock().now();
    truth.position = kMiddle + beside;
    return truth;
  }

  /// The leaders that one peer's snapshot names.
  [[nodiscard]] Leader leader(std::size_t link) {
    const peer::LeadersView& view = world_.view(link).leaders;
    return {name_of(view.scene), view.count == 1 ? name_of(view.rows[0].leader) : "-"};
  }
  /// The leaders that all live peers name, if they agree.
  [[nodiscard]] std::optional<Leader> agreed() {
    std::optional<Leader> all;
    for (std::size_t link = 0; link < alive_.size(); ++link) {
      if (!alive_[link]) continue;
      const Leader one = leader(link);
      if (all && !(*all == one)) return {};
      all = one;
    }
    const bool known = all && all->scene != "0:0" && all->cell != "0:0" && all->cell != "-";
    return known ? all : std::nullopt;
  }
  /// Advances time until all name one leader other than `not_this`; returns how long [ms].
  std::size_t until_agreed(std::size_t limit, const std::string& not_this = "") {
    return world_.run_until(
        [&] {
          const auto all = agreed();
          return all && all->scene != not_this && all->cell != not_this;
        },
        limit);
  }

  peer::SceneFile scene_;
  InProcess world_;

 private:
  std::vector<bool> alive_;
};

}  // namespace reckon::test
