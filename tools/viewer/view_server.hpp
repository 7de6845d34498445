// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The viewer's server: sends files of the page by HTTP, and the stage's messages to each tab by
// WebSocket. A slow tab gets the newest picture when it can take one, never an old one. Without a
// page it serves only metrics.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/tools/viewer/view_stage.hpp"
#include "reckon/tools/viewer/web/access.hpp"
#include "reckon/tools/viewer/web/tls_files.hpp"

namespace reckon::tools {

/// Path of the metrics.
inline constexpr std::string_view kMetricsPath = "/metrics";

/// Metrics that a server serves.
struct ServedMetrics {
  std::string_view content_type;
  std::function<std::string()> text;  ///< present text, some 10 kB; called by poll()
};

/// Options of the server.
struct ViewServerOptions {
  static constexpr std::uint16_t kDefaultPort = 8642;
  std::string address = "127.0.0.1";  ///< of an interface of this host; "0.0.0.0": all interfaces
  /// None: kDefaultPort or the next free one. 0: any free port.
  std::optional<std::uint16_t> port = {};
  std::string word = {};       ///< access word of tabs that change the exercise; see draw_word
  ServedMetrics metrics = {};  ///< for a server without a page
  bool needs_word = false;     ///< to view, too: the exercise has a key
  TlsFiles tls = {};           ///< empty: plain HTTP
};

/// Counters of the server.
struct ViewServerCounts {
  std::uint64_t tabs = 0;      ///< tabs served
  std::uint64_t refused = 0;   ///< requests answered by 403, 400 or 404, and tabs beyond kMostTabs
  std::uint64_t pictures = 0;  ///< sent
  std::uint64_t octets = 0;    ///< of messages sent

  /// Calls visit(name, meaning, value) for each; both texts are literals.
  void for_each(auto&& visit) const {
    visit("tabs", "tabs served", tabs);
    visit("requests_refused", "refused requests, and tabs beyond the maximum", refused);
    visit("pictures_out", "pictures sent to tabs", pictures);
    visit("octets_out", "octets of messages sent to tabs", octets);
  }
};

/// One thread. Socket input never throws, and takes at most some 10 kB per connection, 50 kB with
/// TLS.
class ViewServer {
 public:
  static constexpr std::size_t kMostTabs = 64;
  /// Beyond it the oldest connection that is no tab is closed.
  static constexpr std::size_t kMostConnections = 256;
  /// Limit of connections from one address without a request yet; beyond it the oldest is closed.
  static constexpr std::size_t kMostHeads = 8;
  /// Limit of tabs without the access word from one address; further ones are refused. At
  /// kMostTabs, a new tab with the word closes the oldest tab without it.
  static constexpr std::size_t kMostStrangers = 8;
  /// A connection without a request after this time is closed.
  static constexpr std::chrono::nanoseconds kPatience = std::chrono::seconds(5);
  /// A tab without the word that draws none of its pictures for this long is closed.
  static constexpr std::chrono::nanoseconds kSilence = std::chrono::seconds(10);
  static constexpr std::chrono::nanoseconds kTick = std::chrono::nanoseconds(1'000'000'000 / 30);

  /// Starts to listen. @param stage outlives it. @throws std::runtime_error with the value and the
  /// remedy if it cannot.
  ViewServer(ViewStage& stage, const ViewServerOptions& options);
  /// The same without a page: answers GET kMetricsPath from options.metrics, and nothing else.
  explicit ViewServer(const ViewServerOptions& options);
  /// Sends a last message to the tabs.
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Handles pending events, and waits for some at most `patience`.
  void poll(std::chrono::nanoseconds patience);
  /// Call after ViewStage::pass(): sends every tab as much as it can take. @param now steady time
  void tick(std::chrono::nanoseconds now);

  [[nodiscard]] std::uint16_t port() const noexcept;
  /// Its origin for this host: "http://127.0.0.1:8642"; with TLS by the first name of its
  /// certificate.
  [[nodiscard]] std::string origin() const;
  /// URL for the user: "http://127.0.0.1:8642/#word=1f2e..".
  [[nodiscard]] std::string address() const;
  /// URLs for other hosts; none if only this host can reach it.
  [[nodiscard]] std::vector<std::string> addresses_for_others() const;
  [[nodiscard]] std::size_t tabs() const noexcept;
  [[nodiscard]] const ViewServerCounts& counts() const noexcept;

 private:
  class Connections;
  std::unique_ptr<Connections> connections_;
};

}  // namespace reckon::tools
