// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The viewer's server: files of the page by HTTP, and to each tab what the stage has for it, by
// WebSocket. Whoever is slow gets the newest picture when there is room for one, never an old one.
// Without a page it answers for metrics alone.
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

/// Where metrics are asked for.
inline constexpr std::string_view kMetricsPath = "/metrics";

/// The metrics of a program as a server hands them out.
struct ServedMetrics {
  std::string_view content_type;
  std::function<std::string()> text;  ///< as it is now, some 10 kB; called by poll()
};

/// Where it listens.
struct ViewServerOptions {
  static constexpr std::uint16_t kDefaultPort = 8642;
  std::string address = "127.0.0.1";  ///< of an interface of this host; "0.0.0.0": of all
  /// None: kDefaultPort or the next that is free. 0: any that is free.
  std::optional<std::uint16_t> port = {};
  std::string word = {};       ///< by which tabs may push; see draw_word
  ServedMetrics metrics = {};  ///< of a server without a page
  bool needs_word = false;     ///< to look, too: the exercise has a key
  TlsFiles tls = {};           ///< without: plain HTTP
};

/// What it has done so far.
struct ViewServerCounts {
  std::uint64_t tabs = 0;      ///< that were served
  std::uint64_t refused = 0;   ///< requests by 403, 400 and 404, and tabs beyond kMostTabs
  std::uint64_t pictures = 0;  ///< sent
  std::uint64_t octets = 0;    ///< of messages sent

  /// Calls visit(name, meaning, value) for each; both texts are literals.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    visit("tabs", "tabs that were served", tabs);
    visit("requests_refused", "requests that were refused, and tabs for which there was no room",
          refused);
    visit("pictures_out", "pictures sent to tabs", pictures);
    visit("octets_out", "octets of messages sent to tabs", octets);
  }
};

/// One thread. What comes from a socket neither throws nor takes more than some 10 kB a connection,
/// 50 kB with TLS.
class ViewServer {
 public:
  static constexpr std::size_t kMostTabs = 64;
  /// Beyond it the oldest connection that is no tab makes room for the next.
  static constexpr std::size_t kMostConnections = 256;
  /// Connections of one address without a request yet; the oldest makes room for the next.
  static constexpr std::size_t kMostHeads = 8;
  /// Tabs of one address without the word. One with the word makes the oldest without end where
  /// there are kMostTabs.
  static constexpr std::size_t kMostStrangers = 8;
  /// Who has not sent its request by then is closed.
  static constexpr std::chrono::nanoseconds kPatience = std::chrono::seconds(5);
  /// A tab without the word that draws nothing of what it was sent for so long is closed.
  static constexpr std::chrono::nanoseconds kSilence = std::chrono::seconds(10);
  static constexpr std::chrono::nanoseconds kTick = std::chrono::nanoseconds(1'000'000'000 / 30);

  /// Listens. @param stage outlives it. @throws std::runtime_error with the value and the remedy
  /// where it cannot.
  ViewServer(ViewStage& stage, const ViewServerOptions& options);
  /// The same without a page: GET kMetricsPath is answered by options.metrics, nothing else is.
  explicit ViewServer(const ViewServerOptions& options);
  /// Says good-bye.
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Handles what has come, and waits for it at most so long.
  void poll(std::chrono::nanoseconds patience);
  /// After ViewStage::pass(): gives every tab what it has room for. @param now steady
  void tick(std::chrono::nanoseconds now);

  [[nodiscard]] std::uint16_t port() const noexcept;
  /// Where it is reached from this host: "http://127.0.0.1:8642"; with TLS by the first name of its
  /// certificate.
  [[nodiscard]] std::string origin() const;
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
