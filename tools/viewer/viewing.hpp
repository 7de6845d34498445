// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A source, a stage and a server put together: what `reckon view` runs by itself, and demo and peer
// in a thread beside them.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/tools/datagrams/sealed_datagrams.hpp"
#include "reckon/tools/viewer/view_server.hpp"
#include "reckon/tools/viewer/view_stage.hpp"

namespace reckon::tools {

/// What to serve, and where.
struct ViewingOptions {
  StageOptions stage;
  ViewServerOptions server;
  std::string key;               ///< key file of a sealed exercise; empty: plain
  std::vector<TouchHand> hands;  ///< of the program itself
};

/// Takes a source into a stage until it ends, its stage is full, or `is_over` says so, which is
/// asked at least ten times a second. @return what there is to tell of it
[[nodiscard]] std::vector<std::string> take_source(peer::DatagramSource& source,
                                                   SealedDatagrams& sealed, ViewStage& stage,
                                                   const std::function<bool()>& is_over);

/// One thread drives it.
class Viewing {
 public:
  /// Opens the server, then reads a capture to its end.
  /// @param source may be null: then only hands are shown
  /// @throws EnvironmentError where the address cannot be used, UsageError for the key
  Viewing(const ViewingOptions& options, std::unique_ptr<peer::DatagramSource> source);

  /// One round: takes what has arrived, serves the tabs, and waits up to 10 ms for more.
  void step();

  [[nodiscard]] ViewStage& stage() noexcept { return stage_; }
  [[nodiscard]] ViewServer& server() noexcept { return *server_; }
  /// What happened to the source, as it says itself.
  [[nodiscard]] const peer::SourceReport& report() const noexcept;

 private:
  void take_arrived();
  void look_for_gaps(std::chrono::nanoseconds now);

  peer::SteadyClock clock_;
  SealedDatagrams sealed_;
  std::unique_ptr<peer::DatagramSource> source_;
  ViewStage stage_;
  bool is_capture_;
  std::unique_ptr<ViewServer> server_;
  std::chrono::nanoseconds next_tick_{0};
  std::chrono::nanoseconds last_step_{0};
  std::uint64_t dropped_ = 0;
};

/// The same in a thread of ordinary priority, a little below that of others.
class ViewThread {
 public:
  /// @throws as Viewing
  ViewThread(const ViewingOptions& options, std::unique_ptr<peer::DatagramSource> source);
  ~ViewThread();
  ViewThread(const ViewThread&) = delete;
  ViewThread& operator=(const ViewThread&) = delete;

  /// From the thread that looks at the peers: where the hands are now.
  void put_hands(HandFrame frame);
  /// The same: how the peers receive each other.
  void put_reception(const ReceptionSample& sample);
  /// The same: a line for the pages' log.
  void put_note(std::string level, std::string text);
  [[nodiscard]] const std::string& address() const noexcept { return address_; }
  [[nodiscard]] const std::vector<std::string>& addresses_for_others() const noexcept {
    return addresses_for_others_;
  }

 private:
  void run();

  Viewing viewing_;
  std::string address_;
  std::vector<std::string> addresses_for_others_;
  std::mutex mutex_;  // of what is handed over
  std::vector<HandFrame> frames_;
  std::vector<ReceptionSample> receptions_;
  std::vector<std::pair<std::string, std::string>> notes_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace reckon::tools
