// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The page of one peer: its own hands, which pages may take.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"
#include "reckon/tools/verbs/view_controls.hpp"
#include "reckon/tools/viewer/self_view.hpp"

namespace reckon::tools {

/// What the page of a peer says of it.
struct PeerPageOptions {
  std::string source;  ///< the scene, as named
  std::string iface;   ///< on which the peer sends; empty: the scene's, else chosen by rule
};

/// One thread: that which looks at the peer.
class PeerPage {
 public:
  /// @param view of the peer, with its hands  @param pointers those of its hands that follow one;
  /// their devices outlive this. @throws as SelfView
  PeerPage(const ViewFlags& flags, const peer::SceneFile& scene, const PeerPageOptions& options,
           const peer::PeerView& view, std::span<const PointerHand> pointers);

  /// show() shows from now on how the peer receives others, too. @param peer outlives this
  void add_receiver(const peer::Peer& peer) { view_.add_receiver(peer); }
  /// Shows the hands as they are now.
  void show(const peer::PeerView& view);
  void note(const peer::Notice& notice) { view_.note(notice.text.data()); }
  [[nodiscard]] const SelfView& view() const noexcept { return view_; }

 private:
  void mark_pointers(OwnHands& hands) const;
  [[nodiscard]] OwnHands hands_of(const peer::SceneFile& scene, const peer::PeerView& view);

  std::vector<PointerHand> pointers_;
  ViewControls controls_;  // of the page, and so before it
  SelfView view_;
};

}  // namespace reckon::tools
