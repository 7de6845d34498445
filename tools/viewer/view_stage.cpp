// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/view_stage.hpp"

#include <algorithm>
#include <utility>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/listener/origin_at.hpp"
#include "reckon/tools/viewer/protocol/short_messages.hpp"
#include "reckon/tools/viewer/scenery/received_bodies.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

/// Pictures farther apart than this, divided by the playback speed, have a gap between them.
constexpr nanoseconds kGap = std::chrono::milliseconds(500);
constexpr nanoseconds kSecond = std::chrono::seconds(1);

HistoryOptions history_options(const StageOptions& options) {
  HistoryOptions history = options.history;
  if (options.scene == nullptr) return history;
  history.convergence = options.scene->convergence.settings;
  history.tiers = GroupTiers(options.scene->network, options.scene->aoim);
  return history;
}

/// As it is already, mostly: slots are numbered in the order of the table.
void sort_by_slot(std::vector<EntityMark>& entities) {
  if (!std::ranges::is_sorted(entities, {}, &EntityMark::slot))
    std::ranges::sort(entities, {}, &EntityMark::slot);
}

void need_whole(Watcher& watcher) {
  watcher.needs_picture = true;
  watcher.pictures.need_whole();
}

/// Removes rows older than `span` before the last one.
void forget_old(auto& rows, nanoseconds span) {
  const nanoseconds oldest = rows.back().time - span;
  while (rows.size() > 1 && rows.front().time < oldest) rows.pop_front();
}

}  // namespace

ViewStage::ViewStage(const StageOptions& options)
    : options_(options), history_(history_options(options)) {
  if (options.scene != nullptr) {
    const peer::SceneFile& scene = *options.scene;
    origin_ = scene.origin;
    frame_.emplace(origin_.latitude, origin_.longitude, origin_.height);
    thresholds_.emplace(scene);
    cells_ = std::make_unique<SubscribedCells>(scene.aoim);
    if (DrawnGroups::has_any(scene)) groups_ = std::make_unique<DrawnGroups>(scene);
    solids_ = drawn_solids(scene.scene);
    regions_ = drawn_regions(scene.scene);
    set_touch({});
  }
  options_.scene = nullptr;
}

double ViewStage::seconds(Time time) const noexcept {
  return pdu::to_seconds(time - history_.start());
}

nanoseconds ViewStage::live_end() const noexcept {
  return options_.is_capture ? history_.end() : now_;
}

void ViewStage::find_frame() {
  if (frame_) return;
  if (const auto place = history_.live().first_place()) {
    origin_ = origin_at(*place);
    frame_.emplace(origin_.latitude, origin_.longitude, origin_.height);
  }
}

void ViewStage::take_hands(HandFrame frame) {
  for (HandMark& hand : frame.hands)
    hand.patch = touched_patch(solids_, hand.patch, hand.contact_point.cast<double>());
  hands_.push_back(std::move(frame));
  forget_old(hands_, options_.history.span.value_or(Time{}));
}

void ViewStage::take_reception(const ReceptionSample& sample) {
  receptions_.push_back(sample);
  forget_old(receptions_, options_.history.span.value_or(Time{}));
}

void ViewStage::note(std::string_view level, std::string_view text) {
  notes_.push_back(std::make_shared<const std::string>(note_message(level, text)));
  if (notes_.size() <= kMostNotes) return;
  notes_.pop_front();
  ++first_note_;
}

void ViewStage::pass(Time now) {
  now_ = std::max(now_, now);
  if (!options_.is_capture) {
    history_.begin_at(now_);
    history_.pass(now_);
  }
  find_frame();
  ++tick_;
  if (now_ >= next_roster_) {
    history_.roster().publish();
    next_roster_ = now_ + kRosterEvery;
    ++cells_tick_;
  }
  if (now_ >= next_numbers_) {
    next_numbers_ += kNumbersEvery;
    if (next_numbers_ <= now_) next_numbers_ = now_ + kNumbersEvery;
    ++numbers_tick_;
  }
}

std::unique_ptr<Watcher> ViewStage::admit(bool knows_word) {
  auto watcher = std::make_unique<Watcher>();
  watcher->number = next_watcher_++;
  watcher->may_push = knows_word && options_.controls != nullptr;
  watcher->advanced = now_;
  watcher->notes = first_note_;
  watcher->gaps = gaps_;
  if (options_.is_capture) {
    watcher->state = PlayState::playing;
    watcher->time = history_.begin();
  }
  ++watchers_;
  return watcher;
}

void ViewStage::leave(const Watcher& watcher) {
  --watchers_;
  if (options_.controls != nullptr) options_.controls->give_hand(watcher.number);
}

// Time
// ------------------------------------------------------------------------------------------------

bool ViewStage::is_past(const Watcher& watcher) const noexcept {
  return watcher.state != PlayState::live;
}

nanoseconds ViewStage::shown_time(const Watcher& watcher) const {
  if (!is_past(watcher)) return live_end();
  return std::clamp(watcher.time, history_.begin(), std::max(history_.begin(), live_end()));
}

// Advances a playing tab; if it reaches the present it becomes live, at the end of a capture it
// stops.
void ViewStage::advance(Watcher& watcher) const {
  const Time passed = now_ - std::exchange(watcher.advanced, now_);
  if (watcher.state != PlayState::playing) return;
  const double step = watcher.speed * pdu::to_seconds(passed);
  watcher.time = std::max(watcher.time + pdu::from_seconds(step), history_.begin());
  if (watcher.time < live_end()) return;
  watcher.time = live_end();
  watcher.state = options_.is_capture ? PlayState::end : PlayState::live;
  watcher.knows_state = false;
  watcher.needs_picture = true;
}

void ViewStage::show_at(Watcher& watcher, Time time, PlayState state) const {
  watcher.state = state;
  watcher.time = std::clamp(time, history_.begin(), std::max(history_.begin(), live_end()));
  watcher.advanced = now_;
  watcher.knows_state = false;
  need_whole(watcher);
}

/// The action of each kind of request.
struct ViewStage::Requests {
  ViewStage& stage;
  Watcher& watcher;

  void operator()(const DrawnRequest& request) const {
    // A drawn picture confirms all pictures before it.
    auto& under_way = watcher.under_way;
    const auto drawn = std::find(under_way.begin(), under_way.end(), request.number);
    if (drawn == under_way.end()) return;
    under_way.erase(under_way.begin(), std::next(drawn));
    const std::uint64_t ticks = stage.tick_ - request.number;
    if (ticks >= Watcher::kLate) watcher.credit = Watcher::kLateCredit;
    if (ticks <= Watcher::kInTime) watcher.credit = Watcher::kCredit;
  }
  void operator()(const SeekRequest& request) const {
    constexpr double kFarthest = 1e9;  // [s]
    const double cut = std::clamp(request.time, -kFarthest, kFarthest);
    stage.show_at(watcher, stage.history_.start() + pdu::from_seconds(cut), PlayState::paused);
  }
  void operator()(const SpeedRequest& request) const {
    const Time time = stage.shown_time(watcher);
    if (request.speed == 0) return stage.show_at(watcher, time, PlayState::paused);
    watcher.speed = static_cast<double>(request.speed);
    const bool from_begin = watcher.state == PlayState::end;
    stage.show_at(watcher, from_begin ? stage.history_.begin() : time, PlayState::playing);
  }
  void operator()(const LiveRequest&) const {
    const bool is_over = stage.options_.is_capture;
    watcher.cursor.reset();
    stage.show_at(watcher, stage.live_end(), is_over ? PlayState::end : PlayState::live);
  }
  void operator()(const StepRequest& request) const {
    const Time time = stage.shown_time(watcher);
    if (request.updates == 0)
      return stage.show_at(watcher, time + request.seconds * kSecond, PlayState::paused);
    const auto next = request.updates > 0 ? stage.history_.update_after(time)
                                          : stage.history_.update_before(time);
    stage.show_at(watcher, next.value_or(time), PlayState::paused);
  }
  void operator()(const PointerRequest& request) const {
    if (watcher.hand == request.hand)
      stage.options_.controls->point(watcher.number, request, stage.now_);
  }
  void operator()(const NetworkRequest& request) const {
    stage.note("info", stage.options_.controls->set_network(request));
  }
  void operator()(const TakeHandRequest&) const {
    const auto answer = stage.options_.controls->take_hand(watcher.number);
    watcher.hand = answer.hand;
    watcher.answer = hand_message(answer.hand, answer.text);
  }
  void operator()(const GiveHandRequest&) const {
    stage.options_.controls->give_hand(watcher.number);
    watcher.hand.reset();
    watcher.answer = hand_message(std::nullopt, "the hand is released");
  }
  void operator()(const FollowRequest& request) const { watcher.follow = request.slot; }
  void operator()(const GoAloneRequest&) const {
    stage.note("info", stage.options_.controls->go_alone());
  }
  void operator()(const WholeRequest&) const { need_whole(watcher); }
};

bool ViewStage::answer(Watcher& watcher, std::span<const std::byte> message) {
  const auto request = read_page_request(message);
  if (request) heed(watcher, *request);
  return request.has_value();
}

void ViewStage::heed(Watcher& watcher, const PageRequest& request) {
  if (!changes_exercise(request) || watcher.may_push)
    return std::visit(Requests{*this, watcher}, request);
  watcher.answer = hand_message(
      std::nullopt, options_.controls == nullptr
                        ? "this program has no hand to take"
                        : "this tab can only watch: open the address that the program printed");
}

// Pictures
// ------------------------------------------------------------------------------------------------

const ReceivedWorld& ViewStage::world_for(Watcher& watcher, Time time) {
  if (!is_past(watcher)) return history_.live();
  history_.seek(watcher.cursor, history_.peopled(time));
  return watcher.cursor->world();
}

void ViewStage::fill(const ReceivedWorld& world, Time time, FilledPicture& picture) {
  PictureRows& rows = picture.rows;
  rows.entities.clear();
  rows.hands.clear();
  rows.tools.clear();
  rows.bodies.clear();
  rows.contacts.clear();
  rows.time = seconds(time);
  rows.epoch = history_.roster().epoch();
  if (frame_) {
    world.add_marks(history_.peopled(time), history_.start(), history_.roster(), *frame_,
                    rows.entities);
    sort_by_slot(rows.entities);
    if (cells_) cells_->place(rows.entities);
    add_contacts(world, time, rows);
  }
  add_hands(time, rows);
  place_received_bodies(solids_, history_.roster(), rows);
  steady_entities(rows, picture.entities);
}

void ViewStage::add_contacts(const ReceivedWorld& world, Time time, PictureRows& rows) {
  const Listener& listener = world.table().listener();
  if (listener.models().empty() || listener.models().size() > kMostHaptic) return;
  for (const ContactForce& force : contacts_.forces_at(listener, time)) {
    if (rows.contacts.size() >= kMostPictureRows) return;
    const std::uint16_t felt = history_.roster().slot_of(force.by);
    const std::uint16_t feeling = history_.roster().slot_of(force.on);
    const auto place = std::ranges::find(rows.entities, feeling, &EntityMark::slot);
    if (felt == kNoNumber || place == rows.entities.end() || !force.force.allFinite()) continue;
    ContactMark& mark = rows.contacts.emplace_back();
    mark.felt = felt;
    mark.feeling = feeling;
    mark.force = frame_->scene_from_world_vector(force.force).cast<float>();
    mark.point = place->position;
  }
}

const HandFrame* ViewStage::hands_at(Time time) const {
  const auto after =
      std::upper_bound(hands_.begin(), hands_.end(), time,
                       [](Time at, const HandFrame& frame) { return at < frame.time; });
  return after == hands_.begin() ? nullptr : &*std::prev(after);
}

void ViewStage::add_hands(Time time, PictureRows& rows) const {
  const HandFrame* frame = hands_at(time);
  if (frame == nullptr) return;
  rows.hands = frame->hands;
  rows.tools = frame->tools;
  rows.bodies = frame->bodies;
  for (std::size_t i = 0; i < rows.hands.size() && i < frame->ids.size(); ++i)
    rows.hands[i].slot = history_.roster().slot_of(frame->ids[i]);
}

FilledPicture& ViewStage::picture_for(Watcher& watcher, Time time) {
  if (is_past(watcher))
    fill(world_for(watcher, time), time, past_);
  else if (std::exchange(live_.tick, tick_) != tick_)
    fill(history_.live(), live_end(), live_);
  return is_past(watcher) ? past_ : live_;
}

std::uint16_t ViewStage::flags_for(const Watcher& watcher, Time time) const {
  unsigned flags = 0;
  if (watcher.state == PlayState::live) flags |= kPictureLive;
  if (watcher.state == PlayState::paused) flags |= kPicturePaused;
  if (watcher.state == PlayState::end) flags |= kPictureEnd;
  // Fast playback takes its last step in state `end`.
  const bool plays = watcher.state == PlayState::playing || watcher.state == PlayState::end;
  const bool is_fast = plays && watcher.speed > 1;
  const Time apart = is_fast ? pdu::from_seconds(watcher.speed * pdu::to_seconds(kGap)) : kGap;
  const bool leaps = watcher.shown && (time < *watcher.shown || time - *watcher.shown > apart);
  if (leaps || watcher.gaps != gaps_) flags |= kPictureGap;
  return static_cast<std::uint16_t>(flags);
}

bool ViewStage::wants_picture(const Watcher& watcher) const {
  if (watcher.under_way.size() >= watcher.credit || watcher.tick == tick_) return false;
  const bool moves = watcher.state == PlayState::live || watcher.state == PlayState::playing;
  return moves || watcher.needs_picture;
}

ViewStage::Text ViewStage::next_picture(Watcher& watcher) {
  const Time time = shown_time(watcher);
  FilledPicture& picture = picture_for(watcher, time);
  picture.rows.flags = flags_for(watcher, time);
  const auto number = static_cast<std::uint32_t>(tick_);
  Text octets = watcher.pictures.encode(picture, number, watcher.hand, now_, room_);
  watcher.under_way.push_back(number);
  watcher.tick = tick_;
  watcher.shown = time;
  watcher.gaps = gaps_;
  watcher.needs_picture = false;
  return octets;
}

std::optional<ViewStage::Message> ViewStage::next_message(Watcher& watcher) {
  advance(watcher);
  if (Text text = next_text(watcher)) return Message{WebSocketOpcode::text, std::move(text)};
  if (!watcher.greeted || !wants_picture(watcher)) return std::nullopt;
  return Message{WebSocketOpcode::binary, next_picture(watcher)};
}

}  // namespace reckon::tools
