// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Combines a source, a stage and a server: `reckon view` runs it directly, demo and peer in a
// separate thread.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/tools/datagrams/sealed_datagrams.hpp"
#include "reckon/tools/viewer/view_server.hpp"
#include "reckon/tools/viewer/view_stage.hpp"

namespace reckon::tools {

/// Content and address of a view.
struct ViewingOptions {
  StageOptions stage;
  ViewServerOptions server;
  std::string key;               ///< key file of a sealed exercise; empty: plain
  std::vector<TouchHand> hands;  ///< of this program
};

/// Reads a source into a stage until it ends, the stage is full, or `is_over` returns true; calls
/// that at least ten times a second. @return messages about problems and omitted datagrams
[[nodiscard]] std::vector<std::string> take_source(peer::DatagramSource& source,
                                                   SealedDatagrams& sealed, ViewStage& stage,
                                                   const std::function<bool()>& is_over);

/// Driven by one thread.
class Viewing {
 public:
  /// Opens the server, then reads a capture to its end.
  /// @param source may be null: then only hands are shown
  /// @throws EnvironmentError if the address cannot be used, UsageError for the key
  Viewing(const ViewingOptions& options, std::unique_ptr<peer::DatagramSource> source);

  /// One round: takes arrived datagrams, serves the tabs, and waits up to 10 ms for more.
  void step();

  [[nodiscard]] ViewStage& stage() noexcept { return stage_; }
  [[nodiscard]] ViewServer& server() noexcept { return *server_; }
  /// The counters of the source.
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

/// The same in a thread of normal scheduling, at slightly lower priority.
class ViewThread {
 public:
  /// @throws as Viewing
  ViewThread(const ViewingOptions& options, std::unique_ptr<peer::DatagramSource> source);
  ~ViewThread();
  ViewThread(const ViewThread&) = delete;
  ViewThread& operator=(const ViewThread&) = delete;

  /// From the thread that reads the peers' views: the present state of the hands.
  void put_hands(HandFrame frame);
  /// From the same thread: reception statistics of the peers.
  void put_reception(const ReceptionSample& sample);
  /// From the same thread: a line for the pages' log.
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
  std::mutex mutex_;  // guards the pending input
  std::vector<HandFrame> frames_;
  std::vector<ReceptionSample> receptions_;
  std::vector<std::pair<std::string, std::string>> notes_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace reckon::tools
