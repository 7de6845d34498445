// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/demo_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using peer::DeviceConfig, peer::DeviceSource;

std::vector<std::size_t> first_hands(const Exercise& exercise) {
  std::vector<std::size_t> first(1, 0);
  for (std::size_t i = 0; i < exercise.size(); ++i)
    first.push_back(first.back() + exercise.view(i).hand_count);
  return first;
}

/// The owner of each body with the highest version among all peers.
std::vector<peer::BodyOwnerView> newest_owners(const Exercise& exercise) {
  std::vector<peer::BodyOwnerView> newest;
  for (std::size_t i = 0; i < exercise.size(); ++i) {
    const peer::PeerView& view = exercise.view(i);
    newest.resize(std::max(newest.size(), view.body_owner_count));
    for (std::size_t k = 0; k < view.body_owner_count; ++k) {
      const bool is_known = newest[k].owner != pdu::SimulationAddress{};
      if (!is_known || view.body_owners[k].version > newest[k].version)
        newest[k] = view.body_owners[k];
    }
  }
  return newest;
}

SelfViewOptions self_view_options(const DemoPageOptions& options, ViewControls& controls) {
  SelfViewOptions page;
  page.kind = "demo";
  page.source = options.source;
  page.iface = options.iface;
  page.raw_bit_per_s = options.raw_bit_per_s;
  page.knows_all = true;
  page.controls = &controls;
  return page;
}

}  // namespace

void let_pages_move_hands(peer::SceneFile& scene, std::size_t peers) {
  const auto is_pointer = [](const DeviceConfig& one) {
    return one.source == DeviceSource::pointer;
  };
  if (std::any_of(scene.devices.begin(), scene.devices.end(), is_pointer)) return;
  std::vector<DeviceConfig> devices;
  for (std::uint32_t peer = 1; peer <= peers; ++peer)
    std::ranges::copy(peer::devices_of(scene, peer), std::back_inserter(devices));
  for (DeviceConfig& device : devices)
    if (device.driver == nullptr && !(device.admittance.mass > 0) &&
        mapping_of(device).is_plain() && operator_of(scene, device.operator_number).damping > 0)
      device.source = DeviceSource::pointer;
  scene.devices = std::move(devices);
}

DemoPage::DemoPage(const ViewFlags& flags, const peer::SceneFile& scene,
                   const DemoPageOptions& options, Exercise& exercise, HandTwins& twins)
    : twins_(twins),
      controls_(
          scene.impairment.law,
          [&exercise, &twins](const peer::ImpairmentLaw& law) {
            exercise.change_impairment(law);
            twins.change_impairment(law);
          },
          [&exercise] { exercise.peer(0).go_alone(); }),
      first_(first_hands(exercise)),
      pointers_(add_pointers(exercise)),
      view_(flags, scene, self_view_options(options, controls_), hands_of(exercise, scene)) {
  for (std::size_t i = 0; i < exercise.size(); ++i) view_.add_receiver(exercise.peer(i));
}

void DemoPage::show(Exercise& exercise) {
  if (haptics::BodyWorld* bodies = exercise.peer(0).bodies(); bodies != nullptr) {
    (void)bodies->published().update();
    view_.hands().take_bodies(bodies->published().read().bodies);
  }
  view_.hands().take_owners(newest_owners(exercise), exercise.view(0).bodies_rest);
  controls_.set_rests(exercise.view(0).bodies_rest);
  for (std::size_t i = 0; i < exercise.size(); ++i)
    for (std::size_t k = 0; k < exercise.view(i).hand_count; ++k)
      view_.hands().set_id(first_[i] + k, exercise.view(i).hands[k].id);
  mark_pointers(view_.hands());
  show_twins(exercise);
  view_.show_hands();
}

void DemoPage::show_twins(const Exercise& exercise) {
  for (std::size_t i = 0; i < exercise.size(); ++i)
    for (std::size_t k = 0; k < exercise.view(i).hand_count; ++k) {
      const haptics::UngatedTwin* twin = twins_.find(i, k);
      if (twin == nullptr) continue;
      TwinFeeling feeling{std::nullopt, twin->energy(), twin->resets()};
      if (twin->feels()) feeling.force = twin->force().norm();
      view_.hands().set_twin(first_[i] + k, feeling);
    }
  report_lost(exercise.elapsed());
}

void DemoPage::report_lost(std::chrono::nanoseconds now) {
  if (twins_.resets() == told_resets_ || now - told_at_ < kTellEvery) return;
  told_resets_ = twins_.resets();
  told_at_ = now;
  view_.note(fmt::format(
      "without the gate, the hands became unstable: their twins were restarted, {} so far",
      counted(told_resets_, "time")));
}

std::vector<std::size_t> DemoPage::add_pointers(const Exercise& exercise) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < exercise.size(); ++i)
    for (const PointerHand& pointer : exercise.pointers(i)) {
      indices.push_back(first_[i] + pointer.device);
      controls_.add_hand(indices.back(), twins_.followed(i, pointer));
    }
  return indices;
}

void DemoPage::mark_pointers(OwnHands& hands) const {
  for (const std::size_t hand : pointers_) hands.set_pointer(hand, controls_.is_free(hand));
}

OwnHands DemoPage::hands_of(const Exercise& exercise, const peer::SceneFile& scene) const {
  OwnHands hands(scene.hand);
  for (std::size_t i = 0; i < exercise.size(); ++i)
    for (const peer::HandView& hand : exercise.view(i).own_hands()) hands.add(i, hand);
  mark_pointers(hands);
  return hands;
}

}  // namespace reckon::tools
