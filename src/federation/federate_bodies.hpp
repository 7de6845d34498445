// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The bodies of the scene for a program: which federate owns them, where they are, and orders to
// own ones.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/haptics/bodies/body_exchange.hpp"
#include "reckon/peer/federation/known_body.hpp"

namespace reckon::peer {

class LoopSide;
struct News;
struct SceneFile;

/// Ownership of bodies in HLA's words. A federate with a device or a number in the scene
/// (FederateOptions::scene_peer) may own bodies, all others follow. In an `interop` scene owners
/// are fixed, and no order has an effect.
///
///   peer::FederateBodies& bodies = federate.bodies();
///   const peer::BodyHandle cube = bodies.find("cube");
///   bodies.on_acquired([&](peer::BodyHandle body) {
///     if (!bodies.push(body, {0, 0, 0.05}, bodies.motion_of(body).position)) log("not ours");
///   });
///   bodies.on_release_requested([&](peer::BodyHandle body, const aoim::PeerId&) {
///     bodies.divest(body);
///   });
///   bodies.acquire(cube);
///
/// Thread of the program, which calls the functions of Federate. Requests and orders take effect
/// with the next step(), answers are as of the last step(). Callbacks run inside step(). Functions
/// throw std::logic_error for a handle of no body.
class FederateBodies {
 public:
  /// @param side, scene outlive this  @param may_own whether this federate may own bodies
  FederateBodies(LoopSide& side, const SceneFile& scene, bool may_own);

  /// @throws std::invalid_argument for a name that no body of the scene has
  [[nodiscard]] BodyHandle find(std::string_view name) const;
  /// Its name in the scene.
  [[nodiscard]] const std::string& name_of(BodyHandle body) const;

  // Ownership -------------------------------------------------------------------------------------

  /// Wants a body, and keeps it, until divest(). Its owner gives it away when its program does not
  /// keep it and none of its hands touches it; bodies in contact with it come too. (HLA: attribute ownership
  /// acquisition.) @throws std::logic_error if this federate may own no body
  void acquire(BodyHandle body);
  /// Ends acquire(): the body goes to the federate that asks next. Until then this one owns it.
  /// (HLA: attribute ownership divestiture if wanted, cancel attribute ownership acquisition.)
  void divest(BodyHandle body);
  /// Whether this federate moves the body now. False while it gives the body away, and while no
  /// majority of the voters receives this federate.
  [[nodiscard]] bool owns(BodyHandle body) const { return known(body).is_ours; }
  /// The owner by the knowledge of this peer, which may be itself while owns() is false; 0:0: not
  /// known.
  [[nodiscard]] aoim::PeerId owner_of(BodyHandle body) const { return known(body).owner; }
  /// owns() has become true: granted, adopted from a failed owner, or owned from the start. (HLA:
  /// attribute ownership acquisition notification.)
  void on_acquired(std::function<void(BodyHandle)> callback) { acquired_ = std::move(callback); }
  /// owns() has become false. (HLA 1.3: attribute ownership divestiture notification.)
  void on_lost(std::function<void(BodyHandle)> callback) { lost_ = std::move(callback); }
  /// Another federate asks for a body that this one keeps. Called once for each that becomes the
  /// first in the queue. (HLA: request attribute ownership release.)
  void on_release_requested(std::function<void(BodyHandle, const aoim::PeerId&)> callback) {
    requested_ = std::move(callback);
  }

  // Motion ----------------------------------------------------------------------------------------
  // Orders to own bodies. False: this federate does not own the body, and the order is not sent.
  // Values that are not finite have no effect.

  /// Pose and motion in S, as simulated or shown by this peer.
  [[nodiscard]] const haptics::ObjectMotion& motion_of(BodyHandle body) const {
    return known(body).motion;
  }
  /// Makes a resting body active for a second, for example to drop it onto another one.
  [[nodiscard]] bool wake(BodyHandle body) { return order({haptics::BodyAct::wake, body.number}); }
  /// Adds an impulse [N s] at a point [m], both in S, and wakes it.
  [[nodiscard]] bool push(BodyHandle body, const Eigen::Vector3d& impulse,
                          const Eigen::Vector3d& point) {
    return order({haptics::BodyAct::push, body.number, {}, impulse, point});
  }
  /// Puts it into a pose and motion, and wakes it. Others see it jump.
  [[nodiscard]] bool place(BodyHandle body, const haptics::ObjectMotion& motion) {
    return order({haptics::BodyAct::place, body.number, motion});
  }
  /// A sent order had no effect: the body was given away before, or too many orders waited.
  void on_refused(std::function<void(BodyHandle)> callback) { refused_ = std::move(callback); }

  /// Calls back with what has changed. For Federate::step().
  void call_back(News& news);

 private:
  struct Body {
    std::string name;
    bool has_mass;  // else something else moves it
  };
  [[nodiscard]] const KnownBody& known(BodyHandle body) const;
  [[nodiscard]] bool order(const haptics::BodyOrder& order);
  void report(BodyHandle body, const KnownBody& before, const KnownBody& now) const;

  LoopSide& side_;
  const SceneFile& scene_;
  bool may_own_;
  std::vector<Body> bodies_;      // all moving objects
  std::vector<KnownBody> known_;  // of each
  std::function<void(BodyHandle)> acquired_, lost_, refused_;
  std::function<void(BodyHandle, const aoim::PeerId&)> requested_;
};

}  // namespace reckon::peer
