// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/view_server.hpp"

#include <fmt/format.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/write.hpp>
#include <cstring>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "reckon/tools/viewer/page_files.hpp"
#include "reckon/tools/viewer/protocol/short_messages.hpp"
#include "reckon/tools/viewer/web/http_answer.hpp"
#include "reckon/tools/viewer/web/http_request.hpp"

namespace reckon::tools {
namespace {

using asio::ip::tcp;
using std::chrono::nanoseconds;

constexpr int kPortsTried = 32;
constexpr std::size_t kReadSize = 1024;
/// A file of the page takes no longer.
constexpr nanoseconds kSlowest = std::chrono::minutes(1);

/// As a browser writes it.
std::string address_text(const asio::ip::address& address) {
  return address.is_v6() ? fmt::format("[{}]", address.to_string()) : address.to_string();
}

/// By which a server that listens at `bound` is reached.
std::vector<std::string> own_addresses(const asio::ip::address& bound) {
  std::vector<std::string> own{"localhost"};
  if (!bound.is_unspecified()) {
    own.push_back(address_text(bound));
    return own;
  }
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return own;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr) continue;
    if (one->ifa_addr->sa_family == AF_INET) {
      sockaddr_in address{};
      std::memcpy(&address, one->ifa_addr, sizeof address);
      own.push_back(asio::ip::address_v4(ntohl(address.sin_addr.s_addr)).to_string());
    } else if (one->ifa_addr->sa_family == AF_INET6 && bound.is_v6()) {
      sockaddr_in6 address{};
      std::memcpy(&address, one->ifa_addr, sizeof address);
      asio::ip::address_v6::bytes_type octets{};
      std::memcpy(octets.data(), &address.sin6_addr, octets.size());
      own.push_back(address_text(asio::ip::address_v6(octets)));
    }
  }
  freeifaddrs(all);
  return own;
}

/// What a server hands out, and by which flags it goes elsewhere.
struct Purpose {
  std::string_view what, flags;
};
constexpr Purpose kPage{"the page", "--port or --listen"}, kMetrics{"metrics", "--metrics"};

tcp::acceptor open_acceptor(asio::io_context& io, const ViewServerOptions& options,
                            const Purpose& purpose) {
  std::error_code error;
  const auto address = asio::ip::make_address(options.address, error);
  if (error)
    throw std::runtime_error(fmt::format(
        "'{}' is no address; write that of an interface of this host, or 0.0.0.0 for all",
        options.address));
  const int first = options.port.value_or(ViewServerOptions::kDefaultPort);
  const int tried = options.port ? 1 : kPortsTried;
  for (int i = 0; i < tried; ++i) {
    tcp::acceptor acceptor(io);
    const tcp::endpoint endpoint(address, static_cast<std::uint16_t>(first + i));
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (!error) return acceptor;
    if (error != asio::error::address_in_use) break;
  }
  throw std::runtime_error(fmt::format("cannot serve {} at {}:{}: {}; choose another by {}",
                                       purpose.what, address_text(address), first, error.message(),
                                       purpose.flags));
}

}  // namespace

/// All that is connected. Asio calls its functions within poll() alone.
class ViewServer::Connections {
 public:
  /// @param stage of the page; null: none
  Connections(ViewStage* stage, const ViewServerOptions& options)
      : stage_(stage),
        metrics_(options.metrics),
        acceptor_(open_acceptor(io_, options, stage == nullptr ? kMetrics : kPage)),
        endpoint_(acceptor_.local_endpoint()),
        own_(own_addresses(endpoint_.address())),
        access_(own_, endpoint_.port(), options.word) {
    accept();
  }
  ~Connections();
  Connections(const Connections&) = delete;
  Connections& operator=(const Connections&) = delete;

  void poll(nanoseconds patience) {
    io_.restart();
    if (io_.run_one_for(patience) > 0) io_.poll();
  }
  void tick(nanoseconds now);
  [[nodiscard]] const tcp::endpoint& endpoint() const { return endpoint_; }
  /// By which it is reached, as browsers write them.
  [[nodiscard]] const std::vector<std::string>& own() const { return own_; }
  [[nodiscard]] std::string origin(const std::string& host) const {
    return fmt::format("http://{}:{}", host, endpoint_.port());
  }
  [[nodiscard]] std::string url(const std::string& host) const {
    return fmt::format("{}/#word={}", origin(host), access_.word());
  }
  /// By which this host reaches it.
  [[nodiscard]] std::string own_host() const {
    const asio::ip::address bound = endpoint_.address();
    return bound.is_unspecified() ? "127.0.0.1" : address_text(bound);
  }
  [[nodiscard]] std::size_t tabs() const;
  [[nodiscard]] const ViewServerCounts& counts() const { return counts_; }

 private:
  class Connection;
  using Pointer = std::shared_ptr<Connection>;

  void accept();

  ViewStage* stage_;
  ServedMetrics metrics_;
  asio::io_context io_;
  tcp::acceptor acceptor_;
  tcp::endpoint endpoint_;
  std::vector<std::string> own_;
  Access access_;
  std::set<Pointer> all_;
  bool is_accepting_ = false;
  nanoseconds now_{};
  ViewServerCounts counts_;
};

/// One browser's connection: a request, then an answer and the end, or a tab until it goes.
class ViewServer::Connections::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Connections& all, tcp::socket socket)
      : all_(all), socket_(std::move(socket)), since_(all.now_) {}
  ~Connection() { leave(); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  [[nodiscard]] bool is_tab() const { return watcher_ != nullptr; }

  void read() {
    socket_.async_read_some(asio::buffer(room_),
                            [me = shared_from_this()](std::error_code error, std::size_t size) {
                              if (error || !me->socket_.is_open()) return me->close();
                              me->in_.append(me->room_.data(), size);
                              if (me->take_in()) me->read();
                            });
  }
  void tick() {
    if (is_tab()) return send_next();
    if (all_.now_ - since_ > (is_answered_ ? kSlowest : kPatience)) close();
  }
  /// The last words to a tab, as far as they go out at once.
  void say_bye(std::string_view text) {
    if (!is_tab() || is_writing_) return;
    const std::string message = bye_message(text);
    const FrameHead head = frame_head(WebSocketOpcode::text, message.size());
    std::error_code ignored;
    socket_.non_blocking(true, ignored);
    socket_.write_some(std::array{asio::buffer(head.octets.data(), head.size),
                                  asio::buffer(message.data(), message.size())},
                       ignored);
  }
  void close() {
    std::error_code ignored;
    socket_.close(ignored);
    leave();
    all_.all_.erase(shared_from_this());
  }

 private:
  void leave() {
    if (!watcher_) return;
    all_.stage_->leave(*watcher_);
    watcher_.reset();
  }

  // False where there is nothing more to read.
  bool take_in() {
    if (is_answered_) return false;
    return is_tab() ? take_frames() : take_request();
  }

  bool take_frames() {
    std::size_t at = 0;
    const auto octets = std::as_bytes(std::span(in_));
    ClientFrame frame;
    while (true) {
      const FrameVerdict verdict = read_client_frame(octets.subspan(at), frame);
      if (verdict == FrameVerdict::incomplete) break;
      const bool is_good =
          verdict == FrameVerdict::good && all_.stage_->answer(*watcher_, frame.payload());
      if (!is_good) {
        close();
        return false;
      }
      at += frame.length;
    }
    in_.erase(0, at);
    return true;
  }

  bool take_request() {
    HttpRequest request;
    const RequestVerdict verdict = read_request(in_, request);
    if (verdict == RequestVerdict::incomplete) return true;
    if (verdict == RequestVerdict::too_long) {
      ++all_.counts_.refused;
      close();
      return false;
    }
    if (verdict == RequestVerdict::bad) {
      refuse(400, "Bad Request", "no request that this server reads");
      return false;
    }
    answer(request);
    return is_tab();
  }

  void answer(const HttpRequest& request) {
    const Access& access = all_.access_;
    if (!access.is_own_host(request.host))
      return refuse(403, "Forbidden", "this server is not reached by that name");
    if (!request.origin.empty() && !access.is_own_origin(request.origin, request.host))
      return refuse(403, "Forbidden", "pages of other sites get nothing");
    if (request.method != "GET")
      return refuse(404, "Not Found", "there is no such thing to ask for");
    if (all_.stage_ == nullptr) return answer_metrics(request);
    if (request.path == "/stream") return upgrade(request);
    const PageFile* file = find_page_file(request.path);
    if (file == nullptr) return refuse(404, "Not Found", "the page has no such file");
    const bool is_plain = file->gzip.empty();
    end_with(file_answer(file->content_type, is_plain ? "" : "gzip",
                         is_plain ? file->text : file->gzip));
  }

  void answer_metrics(const HttpRequest& request) {
    if (request.path != kMetricsPath) return refuse(404, "Not Found", "here is /metrics alone");
    end_with(file_answer(all_.metrics_.content_type, "", all_.metrics_.text()));
  }

  void upgrade(const HttpRequest& request) {
    if (request.origin.empty() || request.version != "13" || !is_web_socket_key(request.key) ||
        !lists_word(request.upgrade, "websocket") || !lists_word(request.connection, "upgrade"))
      return refuse(400, "Bad Request", "/stream takes a WebSocket of version 13");
    std::string head = upgrade_answer(request.key);
    if (all_.tabs() >= kMostTabs) return turn_away(std::move(head));
    const bool knows_word = all_.access_.is_word(value_in_query(request.query, "word"));
    in_.erase(0, request.length);
    watcher_ = all_.stage_->admit(knows_word);
    ++all_.counts_.tabs;
    send(std::make_shared<const std::string>(std::move(head)), nullptr);
    if (!in_.empty()) (void)take_frames();
  }

  // A sentence that the page can show, then the end.
  void turn_away(std::string head) {
    ++all_.counts_.refused;
    const std::string bye = bye_message(fmt::format(
        "{} tabs look already, which is the most; close one and load this page again", kMostTabs));
    const FrameHead text = frame_head(WebSocketOpcode::text, bye.size());
    const FrameHead end = frame_head(WebSocketOpcode::close, 0);
    const auto append = [&head](const FrameHead& frame) {
      head.append(reinterpret_cast<const char*>(frame.octets.data()), frame.size);
    };
    append(text);
    head.append(bye);
    append(end);
    end_with(std::move(head));
  }

  void refuse(int status, std::string_view reason, std::string_view text) {
    ++all_.counts_.refused;
    end_with(refusal_answer(status, reason, text));
  }

  void end_with(std::string text) {
    is_answered_ = true;
    since_ = all_.now_;
    const auto kept = std::make_shared<const std::string>(std::move(text));
    asio::async_write(socket_, asio::buffer(*kept),
                      [me = shared_from_this(), kept](std::error_code, std::size_t) {
                        std::error_code ignored;
                        me->socket_.shutdown(tcp::socket::shutdown_both, ignored);
                        me->close();
                      });
  }

  void send_next() {
    if (is_writing_ || !is_tab()) return;
    auto message = all_.stage_->next_message(*watcher_);
    if (!message) return;
    if (message->opcode == WebSocketOpcode::binary) ++all_.counts_.pictures;
    head_ = frame_head(message->opcode, message->payload->size());
    send(std::move(message->payload), &head_);
  }

  /// Sends; when all of it is out, what there is next.
  void send(std::shared_ptr<const std::string> payload, const FrameHead* head) {
    is_writing_ = true;
    out_ = std::move(payload);
    all_.counts_.octets += out_->size();
    const std::array<asio::const_buffer, 2> parts{
        head == nullptr ? asio::const_buffer{} : asio::buffer(head->octets.data(), head->size),
        asio::buffer(*out_)};
    asio::async_write(socket_, parts,
                      [me = shared_from_this()](std::error_code error, std::size_t) {
                        me->is_writing_ = false;
                        if (error || !me->socket_.is_open()) return me->close();
                        me->send_next();
                      });
  }

  Connections& all_;
  tcp::socket socket_;
  nanoseconds since_;
  std::string in_;
  std::array<char, kReadSize> room_{};
  std::unique_ptr<Watcher> watcher_;
  bool is_answered_ = false, is_writing_ = false;
  FrameHead head_;
  std::shared_ptr<const std::string> out_;
};

ViewServer::Connections::~Connections() {
  for (const auto& connection : std::set(all_)) connection->say_bye("the program has ended");
  all_.clear();
}

void ViewServer::Connections::tick(nanoseconds now) {
  now_ = now;
  if (!is_accepting_) accept();
  for (const auto& connection : std::set(all_)) connection->tick();
}

std::size_t ViewServer::Connections::tabs() const {
  return static_cast<std::size_t>(
      std::count_if(all_.begin(), all_.end(), [](const auto& one) { return one->is_tab(); }));
}

void ViewServer::Connections::accept() {
  is_accepting_ = true;
  acceptor_.async_accept([this](std::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    // With no descriptor left, for example, another try would fail at once: the next tick tries.
    if (error) return void(is_accepting_ = false);
    if (all_.size() < kMostConnections) {
      std::error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      socket.set_option(asio::socket_base::keep_alive(true), ignored);
      const auto connection = std::make_shared<Connection>(*this, std::move(socket));
      all_.insert(connection);
      connection->read();
    }
    accept();
  });
}

ViewServer::ViewServer(ViewStage& stage, const ViewServerOptions& options)
    : connections_(std::make_unique<Connections>(&stage, options)) {}

ViewServer::ViewServer(const ViewServerOptions& options)
    : connections_(std::make_unique<Connections>(nullptr, options)) {}

ViewServer::~ViewServer() = default;

void ViewServer::poll(nanoseconds patience) { connections_->poll(patience); }

void ViewServer::tick(nanoseconds now) { connections_->tick(now); }

std::uint16_t ViewServer::port() const noexcept { return connections_->endpoint().port(); }

std::string ViewServer::origin() const { return connections_->origin(connections_->own_host()); }

std::string ViewServer::address() const { return connections_->url(connections_->own_host()); }

std::vector<std::string> ViewServer::addresses_for_others() const {
  std::vector<std::string> out;
  for (const std::string& host : connections_->own())
    if (host != "localhost" && host != "[::1]" && !host.starts_with("127."))
      out.push_back(connections_->url(host));
  return out;
}

std::size_t ViewServer::tabs() const noexcept { return connections_->tabs(); }

const ViewServerCounts& ViewServer::counts() const noexcept { return connections_->counts(); }

}  // namespace reckon::tools
