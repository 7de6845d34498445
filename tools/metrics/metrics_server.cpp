// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/metrics/metrics_server.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <charconv>
#include <stdexcept>
#include <utility>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/threads/thread_name.hpp"
#include "reckon/tools/metrics/open_metrics.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

std::optional<std::uint16_t> port_of(std::string_view text) {
  std::uint16_t port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return port;
}

}  // namespace

void add_metrics_flag(CommandLine& line, std::string& typed) {
  line.option("--metrics", typed,
              "serve GET /metrics in OpenMetrics, for example for Prometheus, at this address "
              "(127.0.0.1:9464) or loopback port");
}

std::optional<MetricsAddress> metrics_address(const std::string& typed) {
  if (typed.empty()) return std::nullopt;
  MetricsAddress at;
  if (const auto port = port_of(typed)) {
    at.port = *port;
    return at;
  }
  const auto endpoint = peer::IpEndpoint::parse(typed);
  // IpEndpoint::parse() also accepts an address without a port.
  const std::size_t colon = typed.rfind(':');
  if (!endpoint || colon == std::string::npos ||
      !port_of(std::string_view(typed).substr(colon + 1)) ||
      (endpoint->is_v6 && typed.front() != '['))
    throw UsageError(
        fmt::format("--metrics: '{}' is not an address with a port; write 127.0.0.1:9464, "
                    "[::1]:9464, 0.0.0.0:9464 for all interfaces, or a port alone",
                    typed));
  at.address = endpoint->address_text();
  at.port = endpoint->port;
  return at;
}

MetricsServer::MetricsServer(const MetricsAddress& at) : text_(OpenMetrics().end()) {
  ViewServerOptions options;
  options.address = at.address;
  options.port = at.port;
  options.metrics = {kOpenMetricsType, [this] { return text(); }};
  try {
    server_ = std::make_unique<ViewServer>(options);
  } catch (const std::runtime_error& error) {
    throw EnvironmentError(error.what());
  }
  sentence_ = fmt::format("metrics: {}{}", server_->origin(), kMetricsPath);
  if (!server_->addresses_for_others().empty()) sentence_ += "; other hosts can read them too";
  thread_ = std::thread([this] { run(); });
}

MetricsServer::~MetricsServer() {
  stop_.store(true, std::memory_order_relaxed);
  thread_.join();
}

void MetricsServer::show(std::string text, nanoseconds now) {
  due_ = now + kEvery;
  const std::scoped_lock lock(mutex_);
  text_.swap(text);
}

std::string MetricsServer::sentence() const { return sentence_; }

std::string MetricsServer::text() const {
  const std::scoped_lock lock(mutex_);
  return text_;
}

void MetricsServer::run() {
  constexpr int kNice = 5;
  constexpr nanoseconds kPatience = std::chrono::milliseconds(100);
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
  peer::name_thread(pthread_self(), "rk-metrics");
  const peer::SteadyClock clock;
  while (!stop_.load(std::memory_order_relaxed)) {
    server_->tick(clock.now());
    server_->poll(kPatience);
  }
}

std::unique_ptr<MetricsServer> metrics_server(const std::string& typed) {
  const auto at = metrics_address(typed);
  return at ? std::make_unique<MetricsServer>(*at) : nullptr;
}

}  // namespace reckon::tools
