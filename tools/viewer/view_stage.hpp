// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Content of the viewer: takes datagrams and hands, keeps the history, and makes the next message
// for each tab that can take one. No sockets; time is passed in.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tools/listener/contact_forces.hpp"
#include "reckon/tools/viewer/history/history.hpp"
#include "reckon/tools/viewer/peers_reception.hpp"
#include "reckon/tools/viewer/protocol/picture.hpp"
#include "reckon/tools/viewer/scenery/drawn_groups.hpp"
#include "reckon/tools/viewer/scenery/shown_thresholds.hpp"
#include "reckon/tools/viewer/scenery/solid_shapes.hpp"
#include "reckon/tools/viewer/scenery/subscribed_cells.hpp"
#include "reckon/tools/viewer/viewer_controls.hpp"
#include "reckon/tools/viewer/watcher.hpp"
#include "reckon/tools/viewer/web/web_socket.hpp"

namespace reckon::tools {

/// Properties of the source.
struct StageOptions {
  std::string source;                      ///< as the user named it
  std::string_view kind = "live";          ///< "demo", "peer", "live" or "capture"
  std::string help;                        ///< a sentence for an empty page
  const peer::SceneFile* scene = nullptr;  ///< null: unknown; read at construction only
  bool is_capture = false;                 ///< all datagrams are taken before the first tab
  HistoryOptions history;
  double raw_bit_per_s = 0;            ///< rate of a stream without dead reckoning; 0: unknown
  ViewerControls* controls = nullptr;  ///< null: pages cannot change anything; outlives the stage
};

/// Constant properties of a hand of the program.
struct TouchHand {
  std::string name;
  double radius = 0;  ///< [m]
  std::string_view device = "simulated";
  double limit = 0;  ///< [N], greatest force
};

/// The hidden twin of a hand, without the gate.
struct TwinMark {
  std::uint16_t hand = 0;    ///< index of the hand
  double energy = 0;         ///< [J], at the twin's port
  std::uint64_t resets = 0;  ///< number of resets
};

/// All hands of the program at one instant. `ids` determines their slots; their patches have the
/// numbers of their own meshes.
struct HandFrame {
  std::chrono::nanoseconds time{};  ///< since 1970-01-01 UTC
  std::vector<HandMark> hands;
  std::vector<ToolMark> tools;   ///< of hands that turn
  std::vector<BodyMark> bodies;  ///< of the scene
  std::vector<pdu::EntityId> ids;
  std::vector<TwinMark> twins;
  std::shared_ptr<const std::string> owners;  ///< of the bodies, see bodies_message(); null: fixed
};

/// One thread. Times are since 1970-01-01 UTC, or the times of the capture.
class ViewStage {
 public:
  /// A message for a tab.
  struct Message {
    WebSocketOpcode opcode = WebSocketOpcode::text;
    std::shared_ptr<const std::string> payload;
  };
  static constexpr std::chrono::nanoseconds kNumbersEvery = std::chrono::milliseconds(250);
  static constexpr std::chrono::nanoseconds kRosterEvery = std::chrono::milliseconds(500);
  /// Beyond this number of haptic entities, contacts are not computed, as the cost grows with the
  /// pairs.
  static constexpr std::size_t kMostHaptic = 512;

  /// Reads the scene's meshes.
  explicit ViewStage(const StageOptions& options);

  /// Takes a datagram of the source. @return false if a capture's history is full
  bool take(const peer::SourceDatagram& datagram) { return history_.take(datagram); }
  void set_touch(const std::vector<TouchHand>& hands);
  void take_hands(HandFrame frame);
  /// Takes reception statistics of the program's peers, with rising times.
  void take_reception(const ReceptionSample& sample);
  /// Adds a line to the log of all tabs; the last kMostNotes are kept.
  void note(std::string_view level, std::string_view text);
  /// The source lost data: the next pictures have a gap before them.
  void note_gap() noexcept { ++gaps_; }
  /// Advances the time to `now` (a capture has its own clock): a new picture may be shown.
  void pass(std::chrono::nanoseconds now);

  /// Adds a tab. @param knows_word it may change the exercise
  [[nodiscard]] std::unique_ptr<Watcher> admit(bool knows_word);
  /// Removes a tab.
  void leave(const Watcher& watcher);
  /// Handles a message of a tab. @return false if it is no request: close the connection
  [[nodiscard]] bool answer(Watcher& watcher, std::span<const std::byte> message);
  /// Handles a decoded request.
  void heed(Watcher& watcher, const PageRequest& request);
  /// The next message for a tab, by importance; none if it is up to date.
  [[nodiscard]] std::optional<Message> next_message(Watcher& watcher);

  /// The last time of pass().
  [[nodiscard]] std::chrono::nanoseconds now() const noexcept { return now_; }
  [[nodiscard]] std::size_t watchers() const noexcept { return watchers_; }
  [[nodiscard]] const History& history() const noexcept { return history_; }

 private:
  using Time = std::chrono::nanoseconds;
  using Text = std::shared_ptr<const std::string>;
  static constexpr std::size_t kMostNotes = 64;
  struct Requests;  // the action of each kind of request

  [[nodiscard]] double seconds(Time time) const noexcept;
  [[nodiscard]] Time live_end() const noexcept;
  void find_frame();
  void advance(Watcher& watcher) const;
  void show_at(Watcher& watcher, Time time, PlayState state) const;
  [[nodiscard]] Time shown_time(const Watcher& watcher) const;
  [[nodiscard]] bool is_past(const Watcher& watcher) const noexcept;
  [[nodiscard]] const ReceivedWorld& world_for(Watcher& watcher, Time time);

  [[nodiscard]] Text next_text(Watcher& watcher);
  [[nodiscard]] Text next_regular_text(Watcher& watcher);
  [[nodiscard]] Text next_scenery(Watcher& watcher);
  [[nodiscard]] std::string hello(const Watcher& watcher) const;
  [[nodiscard]] std::string origin_message() const;
  [[nodiscard]] std::string play_message(const Watcher& watcher) const;
  [[nodiscard]] std::string numbers_message(const Watcher& watcher) const;
  [[nodiscard]] const ReceptionSample* reception_at(Time time) const;
  void append_origin(std::string& out) const;

  [[nodiscard]] bool wants_picture(const Watcher& watcher) const;
  [[nodiscard]] Text next_picture(Watcher& watcher);
  [[nodiscard]] std::uint16_t flags_for(const Watcher& watcher, Time time) const;
  void fill(const ReceivedWorld& world, Time time, FilledPicture& picture);
  void add_contacts(const ReceivedWorld& world, Time time, PictureRows& rows);
  [[nodiscard]] const HandFrame* hands_at(Time time) const;
  void add_hands(Time time, PictureRows& rows) const;
  [[nodiscard]] FilledPicture& picture_for(Watcher& watcher, Time time);

  StageOptions options_;
  History history_;
  std::optional<deadreckon::LocalFrame> frame_;
  peer::OriginConfig origin_;
  std::optional<ShownThresholds> thresholds_;
  std::unique_ptr<SubscribedCells> cells_;  // null without a scene
  std::unique_ptr<DrawnGroups> groups_;     // null if the scene has none
  Text touch_;
  std::vector<DrawnSolid> solids_, regions_;
  std::deque<HandFrame> hands_;
  std::deque<ReceptionSample> receptions_;
  ContactForces contacts_;
  Time now_{};
  Time next_roster_{}, next_numbers_{};
  std::uint64_t tick_ = 0, numbers_tick_ = 0, cells_tick_ = 0;
  FilledPicture live_, past_;
  std::string room_;  // for a picture that is being encoded
  std::deque<Text> notes_;
  std::uint64_t first_note_ = 0;
  std::uint64_t gaps_ = 0;
  std::uint64_t next_watcher_ = 1;
  std::size_t watchers_ = 0;
};

}  // namespace reckon::tools
