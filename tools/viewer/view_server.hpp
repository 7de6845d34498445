// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The viewer's server: files of the page by HTTP, and to each tab what the stage has for it, by
// WebSocket. Whoever is slow gets the newest picture when there is room for one, never an old one.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tools/viewer/view_stage.hpp"
#include "reckon/tools/viewer/web/access.hpp"

namespace reckon::tools {

/// Where it listens.
struct ViewServerOptions {
  static constexpr std::uint16_t kDefaultPort = 8642;
  std::string address = "127.0.0.1";  ///< of an interface of this host; "0.0.0.0": of all
  /// None: kDefaultPort or the next that is free. 0: any that is free.
  std::optional<std::uint16_t> port;
  std::string word;  ///< by which tabs may push; see draw_word
};

/// What it has done so far.
struct ViewServerCounts {
  std::uint64_t tabs = 0;      ///< that were served
  std::uint64_t refused = 0;   ///< requests by 403, 400 and 404, and tabs beyond kMostTabs
  std::uint64_t pictures = 0;  ///< sent
  std::uint64_t octets = 0;    ///< of messages sent
};

/// One thread. What comes from a socket neither throws nor takes more than some 10 kB a connection.
class ViewServer {
 public:
  static constexpr std::size_t kMostTabs = 64;
  /// Connections beyond it are closed at once.
  static constexpr std::size_t kMostConnections = 256;
  /// Who has not sent its request by then is closed.
  static constexpr std::chrono::nanoseconds kPatience = std::chrono::seconds(5);
  static constexpr std::chrono::nanoseconds kTick = std::chrono::nanoseconds(1'000'000'000 / 30);

  /// Listens. @param stage outlives it. @throws std::runtime_error with the value and the remedy
  /// where it cannot.
  ViewServer(ViewStage& stage, const ViewServerOptions& options);
  /// Says good-bye.
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Handles what has come, and waits for it at most so long.
  void poll(std::chrono::nanoseconds patience);
  /// After ViewStage::pass(): gives every tab what it has room for. @param now steady
  void tick(std::chrono::nanoseconds now);

  [[nodiscard]] std::uint16_t port() const noexcept;
  /// What a user opens: "http://127.0.0.1:8642/#word=1f2e..".
  [[nodiscard]] std::string address() const;
  /// The same as other hosts reach it; none where only this one does.
  [[nodiscard]] std::vector<std::string> addresses_for_others() const;
  [[nodiscard]] std::size_t tabs() const noexcept;
  [[nodiscard]] const ViewServerCounts& counts() const noexcept;

 private:
  class Connections;
  std::unique_ptr<Connections> connections_;
};

}  // namespace reckon::tools
