// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/self_view.hpp"

#include <stdexcept>
#include <utility>

#include "reckon/peer/network/interface_choice.hpp"
#include "reckon/tools/datagrams/source.hpp"

namespace reckon::tools {
namespace {

/// Null for unicast, which no other socket receives.
std::unique_ptr<peer::DatagramSource> heard_source(const peer::SceneFile& scene,
                                                   const std::string& iface) {
  if (!scene.network.peers.empty()) return nullptr;
  try {
    // The interface of the peer; there is one.
    const std::string& asked = iface.empty() ? scene.network.iface : iface;
    return peer::open_groups(
        {.interface = peer::choose_interface(asked, scene.network.group.is_v6).interface.name,
         .groups = groups_of(scene)});
  } catch (const std::runtime_error& error) {
    throw EnvironmentError(error.what());
  }
}

}  // namespace

SelfView::SelfView(const ViewFlags& flags, const peer::SceneFile& scene,
                   const SelfViewOptions& options, OwnHands hands)
    : knows_all_(options.knows_all), hands_(std::move(hands)) {
  ViewingOptions viewing;
  viewing.server = server_options(flags, !scene.network.key.empty());
  viewing.key = scene.network.key.string();
  viewing.hands = hands_.names();
  StageOptions& stage = viewing.stage;
  stage.source = options.source;
  stage.kind = options.kind;
  stage.help = "No entity received yet.";
  stage.scene = &scene;
  stage.history.exercise = scene.network.exercise;
  stage.raw_bit_per_s = options.raw_bit_per_s;
  stage.controls = options.controls;
  auto source = heard_source(scene, options.iface);
  const bool is_unheard = source == nullptr;
  thread_ = std::make_unique<ViewThread>(viewing, std::move(source));
  if (is_unheard)
    thread_->put_note("warning", "the peers of this scene use unicast: only hands are shown");
}

void SelfView::show_hands() {
  thread_->put_hands(hands_.frame(clock_.utc_now() - clock_.now(), knows_all_));
  if (const auto sample = reception_.look(clock_.utc_now())) thread_->put_reception(*sample);
}

}  // namespace reckon::tools
