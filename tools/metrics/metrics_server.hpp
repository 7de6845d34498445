// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where a running program answers those who ask for its metrics.
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
  std::uint16_t port = 0;  ///< 0: any that is free
};

/// Declares --metrics.
void add_metrics_flag(CommandLine& line, std::string& typed);
/// What was typed: "127.0.0.1:9464", "[::1]:9464", or a port of the loopback interface alone;
/// nothing where it is empty. @throws UsageError for anything else
[[nodiscard]] std::optional<MetricsAddress> metrics_address(const std::string& typed);

/// Answers GET /metrics in a thread of its own, with the last text that it was given. Whoever asks
/// slowly, or for anything else, costs the program nothing but some octets of this thread. It
/// answers requests only that name one of its own addresses, as ViewServer does.
class MetricsServer {
 public:
  /// How often a new text is worth its making.
  static constexpr std::chrono::nanoseconds kEvery = std::chrono::milliseconds(500);

  /// @throws EnvironmentError with the remedy where it cannot listen there
  explicit MetricsServer(const MetricsAddress& at);
  ~MetricsServer();
  MetricsServer(const MetricsServer&) = delete;
  MetricsServer& operator=(const MetricsServer&) = delete;

  /// Whether kEvery has passed since show(). By the thread that shows.
  [[nodiscard]] bool is_due(std::chrono::nanoseconds now) const noexcept { return now >= due_; }
  /// The text that is answered from now on. By one thread. @param now steady
  void show(std::string text, std::chrono::nanoseconds now);
  /// "metrics: http://127.0.0.1:9464/metrics", and who else may read them where it is not this host
  /// alone.
  [[nodiscard]] std::string sentence() const;

 private:
  [[nodiscard]] std::string text() const;
  void run();

  mutable std::mutex mutex_;  // of text_
  std::string text_;
  std::chrono::nanoseconds due_{0};
  std::unique_ptr<ViewServer> server_;
  std::string sentence_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// The server that was asked for, null where `typed` is empty. @throws as metrics_address() and
/// MetricsServer
[[nodiscard]] std::unique_ptr<MetricsServer> metrics_server(const std::string& typed);

}  // namespace reckon::tools
