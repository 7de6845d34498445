// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// HTTP server for the metrics of a running program.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/viewer/view_server.hpp"

namespace reckon::tools {

/// An address and a TCP port of this host.
struct MetricsAddress {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  ///< 0: any free port
};

/// Declares --metrics.
void add_metrics_flag(CommandLine& line, std::string& typed);
/// Parses "127.0.0.1:9464", "[::1]:9464", or a port, which means the loopback interface only; none
/// if `typed` is empty. @throws UsageError for anything else
[[nodiscard]] std::optional<MetricsAddress> metrics_address(const std::string& typed);

/// Answers GET /metrics in its own thread, with the last text that it was given. Slow clients and
/// other requests cost the program only some memory of this thread. Like ViewServer, it answers
/// only requests that name one of its own addresses.
class MetricsServer {
 public:
  /// Interval between new texts.
  static constexpr std::chrono::nanoseconds kEvery = std::chrono::milliseconds(500);

  /// @throws EnvironmentError with the remedy if it cannot listen there
  explicit MetricsServer(const MetricsAddress& at);
  ~MetricsServer();
  MetricsServer(const MetricsServer&) = delete;
  MetricsServer& operator=(const MetricsServer&) = delete;

  /// Whether kEvery has passed since show(). For the thread that calls show().
  [[nodiscard]] bool is_due(std::chrono::nanoseconds now) const noexcept { return now >= due_; }
  /// Sets the text of further answers. By one thread. @param now steady time
  void show(std::string text, std::chrono::nanoseconds now);
  /// "metrics: http://127.0.0.1:9464/metrics", and a warning if other hosts can read it too.
  [[nodiscard]] std::string sentence() const;

 private:
  [[nodiscard]] std::string text() const;
  void run();

  mutable std::mutex mutex_;  // guards text_
  std::string text_;
  std::chrono::nanoseconds due_{0};
  std::unique_ptr<ViewServer> server_;
  std::string sentence_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// The requested server, null if `typed` is empty. @throws as metrics_address() and
/// MetricsServer
[[nodiscard]] std::unique_ptr<MetricsServer> metrics_server(const std::string& typed);

}  // namespace reckon::tools
