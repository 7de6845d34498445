// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/live_display.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {

using std::chrono::nanoseconds;

LiveDisplay::LiveDisplay(const Console& console, bool wants_table, std::size_t peers,
                         const std::string& log)
    : console_(console),
      log_(log, console),
      screen_(wants_table ? TerminalScreen::open(console.out, console.colour) : nullptr),
      tells_status_(wants_table && screen_ == nullptr && isatty(fileno(console.out)) == 1),
      digest_(peers > 1) {}

LiveDisplay::~LiveDisplay() {
  try {
    close();
  } catch (const std::exception&) {
    // A destructor cannot report errors of the output.
  }
}

void LiveDisplay::add(const ReceivedNotice& heard) {
  log_.add(heard);
  digest_.add(heard, clock_.now());
}

void LiveDisplay::add_of_devices(std::vector<std::string> sentences) {
  for (const std::string& sentence : sentences) log_.add(sentence);
  add(std::move(sentences));
}

void LiveDisplay::put_in_head(std::string sentence) {
  if (screen_ == nullptr)
    fmt::print(console_.err, "{}\n", sentence);
  else
    head_ = std::move(sentence);
}

void LiveDisplay::add(std::vector<std::string> sentences) {
  for (std::string& sentence : sentences) {
    if (screen_ == nullptr) {
      fmt::print(console_.err, "{}\n", sentence);
      continue;
    }
    next_draw_ = nanoseconds(0);
    if (notices_.size() == kMostKept) {
      notices_.erase(notices_.begin());
      ++dropped_;
    }
    notices_.push_back(std::move(sentence));
  }
}

void LiveDisplay::take_keys() {
  while (const auto press = screen_->key()) {
    if (press->key == Key::character && press->letter == 'q') quit_ = true;
    if (press->key == Key::character && press->letter == 's') stop_key_ = true;
    next_draw_ = nanoseconds(0);  // at once, in the size that the terminal has now
  }
}

void LiveDisplay::show(std::span<const TablePeer> peers, const peer::SceneFile& scene,
                       nanoseconds elapsed) {
  const nanoseconds now = clock_.now();
  add(digest_.take(now));
  for (const TablePeer& peer : peers)
    for (const peer::HandView& hand : peer.view->own_hands())
      strongest_ = std::max(strongest_, hand.servo.force.norm());
  const LivePicture picture{peers, scene, pdu::to_seconds(elapsed), notices_, strongest_, head_};
  if (screen_ != nullptr) {
    take_keys();
    if (now < next_draw_) return;
    next_draw_ = now + kDrawEvery;
    screen_->show(live_lines(picture, screen_->size()));
  } else if (tells_status_ && elapsed >= next_status_) {
    next_status_ = elapsed + kStatusEvery;
    fmt::print(console_.err, "{}\n", live_status(picture));
  }
}

void LiveDisplay::close() {
  add(digest_.take_all());
  screen_.reset();
  if (dropped_ > 0) fmt::print(console_.err, "{} before these\n", counted(dropped_, "notice"));
  dropped_ = 0;
  add(std::exchange(notices_, {}));
}

}  // namespace reckon::tools
