// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/viewing.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "reckon/peer/threads/thread_name.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

/// Limit of datagrams taken before tabs are served again.
constexpr int kMostAtOnce = 512;
constexpr nanoseconds kLongestWait = milliseconds(10);
constexpr nanoseconds kPatience = milliseconds(100);  // for a quiet source
/// After a step this late, the process was stopped: the picture has a gap.
constexpr nanoseconds kStoodStill = std::chrono::seconds(1);

std::unique_ptr<ViewServer> open_server(ViewStage& stage, const ViewServerOptions& options) {
  try {
    return std::make_unique<ViewServer>(stage, options);
  } catch (const std::runtime_error& error) {
    throw EnvironmentError(error.what());
  }
}

}  // namespace

std::vector<std::string> take_source(peer::DatagramSource& source, SealedDatagrams& sealed,
                                     ViewStage& stage, const std::function<bool()>& is_over) {
  std::vector<std::string> told;
  peer::SourceDatagram datagram;
  while (!is_over()) {
    const peer::SourceEvent event = source.next(datagram, kPatience);
    if (event == peer::SourceEvent::end) break;
    if (event != peer::SourceEvent::datagram || !sealed.open(datagram)) continue;
    if (!stage.take(datagram)) {
      told.emplace_back("the source is too long to keep: its end is left out");
      break;
    }
  }
  const std::string& problem = source.report().problem;
  if (!problem.empty()) told.push_back(problem);
  if (sealed.unread() > 0)
    told.push_back(fmt::format("{} are sealed and were left out: --key opens them",
                               counted(sealed.unread(), "datagram")));
  return told;
}

Viewing::Viewing(const ViewingOptions& options, std::unique_ptr<peer::DatagramSource> source)
    : sealed_(options.key),
      source_(std::move(source)),
      stage_(options.stage),
      is_capture_(options.stage.is_capture),
      server_(open_server(stage_, options.server)) {
  if (!options.hands.empty()) stage_.set_touch(options.hands);
  if (!is_capture_) return;
  for (const std::string& sentence : take_source(*source_, sealed_, stage_, [] { return false; }))
    stage_.note("warning", sentence);
}

const peer::SourceReport& Viewing::report() const noexcept {
  static const peer::SourceReport kNothing;
  return source_ ? source_->report() : kNothing;
}

void Viewing::take_arrived() {
  if (is_capture_ || !source_) return;
  peer::SourceDatagram datagram;
  for (int i = 0; i < kMostAtOnce; ++i) {
    if (source_->next(datagram, nanoseconds::zero()) != peer::SourceEvent::datagram) return;
    if (sealed_.open(datagram)) (void)stage_.take(datagram);
  }
}

void Viewing::look_for_gaps(nanoseconds now) {
  const bool stood_still = last_step_ > nanoseconds::zero() && now - last_step_ > kStoodStill;
  last_step_ = now;
  const std::uint64_t dropped = report().dropped;
  if (stood_still || dropped > dropped_) stage_.note_gap();
  dropped_ = dropped;
}

void Viewing::step() {
  take_arrived();
  const nanoseconds now = clock_.now();
  if (now >= next_tick_) {
    look_for_gaps(now);
    stage_.pass(clock_.utc_now());
    server_->tick(now);
    next_tick_ = std::max(next_tick_ + ViewServer::kTick, now);
  }
  server_->poll(std::clamp(next_tick_ - clock_.now(), nanoseconds::zero(), kLongestWait));
}

ViewThread::ViewThread(const ViewingOptions& options, std::unique_ptr<peer::DatagramSource> source)
    : viewing_(options, std::move(source)),
      address_(viewing_.server().address()),
      addresses_for_others_(viewing_.server().addresses_for_others()),
      thread_([this] { run(); }) {}

ViewThread::~ViewThread() {
  stop_.store(true, std::memory_order_relaxed);
  thread_.join();
}

void ViewThread::put_hands(HandFrame frame) {
  constexpr std::size_t kMostWaiting = 64;
  const std::scoped_lock lock(mutex_);
  if (frames_.size() < kMostWaiting) frames_.push_back(std::move(frame));
}

void ViewThread::put_reception(const ReceptionSample& sample) {
  constexpr std::size_t kMostWaiting = 16;
  const std::scoped_lock lock(mutex_);
  if (receptions_.size() < kMostWaiting) receptions_.push_back(sample);
}

void ViewThread::put_note(std::string level, std::string text) {
  constexpr std::size_t kMostWaiting = 64;
  const std::scoped_lock lock(mutex_);
  if (notes_.size() < kMostWaiting) notes_.emplace_back(std::move(level), std::move(text));
}

void ViewThread::run() {
  constexpr int kNice = 5;
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
  peer::name_thread(pthread_self(), "rk-view");
  std::vector<HandFrame> frames;
  std::vector<ReceptionSample> receptions;
  std::vector<std::pair<std::string, std::string>> notes;
  while (!stop_.load(std::memory_order_relaxed)) {
    frames.clear();
    receptions.clear();
    notes.clear();
    {
      const std::scoped_lock lock(mutex_);
      frames.swap(frames_);
      receptions.swap(receptions_);
      notes.swap(notes_);
    }
    for (HandFrame& frame : frames) viewing_.stage().take_hands(std::move(frame));
    for (const ReceptionSample& sample : receptions) viewing_.stage().take_reception(sample);
    for (const auto& [level, text] : notes) viewing_.stage().note(level, text);
    viewing_.step();
  }
}

}  // namespace reckon::tools
