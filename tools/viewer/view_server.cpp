// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/view_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "reckon/tools/viewer/page_files.hpp"
#include "reckon/tools/viewer/protocol/short_messages.hpp"
#include "reckon/tools/viewer/web/byte_stream.hpp"
#include "reckon/tools/viewer/web/http_answer.hpp"
#include "reckon/tools/viewer/web/http_request.hpp"
#include "reckon/tools/viewer/web/listening_address.hpp"
#include "reckon/tools/viewer/web/message_deflate.hpp"
#include "reckon/tools/viewer/web/tls_context.hpp"

namespace reckon::tools {
namespace {

using asio::ip::tcp;
using std::chrono::nanoseconds;

constexpr std::size_t kReadSize = 1024;
/// Time limit to send a file of the page.
constexpr nanoseconds kSlowest = std::chrono::minutes(1);
constexpr ServerPurpose kPage{"the page", "--port or --listen"}, kMetrics{"metrics", "--metrics"};

}  // namespace

/// All connections. Asio calls its functions only within poll().
class ViewServer::Connections {
 public:
  /// @param stage of the page; null: none
  Connections(ViewStage* stage, const ViewServerOptions& options)
      : stage_(stage),
        metrics_(options.metrics),
        needs_word_(options.needs_word),
        tls_(open_tls_if_any(options.tls)),
        acceptor_(open_acceptor(io_, options.address, options.port, ViewServerOptions::kDefaultPort,
                                stage == nullptr ? kMetrics : kPage)),
        endpoint_(acceptor_.local_endpoint()),
        names_(server_names(endpoint_.address(),
                            tls_ ? certified_names(*tls_) : std::vector<std::string>())),
        access_(names_.all, endpoint_.port(), options.word, tls_.has_value()) {
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
  /// As browsers write them.
  [[nodiscard]] const ServerNames& names() const { return names_; }
  [[nodiscard]] std::string origin(const std::string& host) const {
    return fmt::format("{}{}:{}", access_.scheme(), host, endpoint_.port());
  }
  [[nodiscard]] std::string url(const std::string& host) const {
    return fmt::format("{}/#word={}", origin(host), access_.word());
  }
  [[nodiscard]] std::size_t tabs() const;
  [[nodiscard]] const ViewServerCounts& counts() const { return counts_; }

 private:
  class Connection;
  using Pointer = std::shared_ptr<Connection>;

  void accept();
  /// Makes room for one more connection of this address.
  void make_room(const std::string& from);
  [[nodiscard]] std::size_t count(auto&& which) const {
    return static_cast<std::size_t>(std::ranges::count_if(all_, which));
  }
  /// Null: none.
  [[nodiscard]] Pointer oldest(auto&& which) const {
    const auto found = std::ranges::find_if(all_, which);
    return found == all_.end() ? nullptr : *found;
  }

  ViewStage* stage_;
  ServedMetrics metrics_;
  bool needs_word_;
  std::optional<asio::ssl::context> tls_;
  asio::io_context io_;
  tcp::acceptor acceptor_;
  tcp::endpoint endpoint_;
  ServerNames names_;
  Access access_;
  std::vector<Pointer> all_;  // the oldest first
  bool is_accepting_ = false;
  nanoseconds now_{};
  ViewServerCounts counts_;
};

/// A browser's connection: one request and its answer, or a tab until it closes.
class ViewServer::Connections::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Connections& all, tcp::socket socket)
      : all_(all), stream_(std::move(socket), all.tls_ ? &*all.tls_ : nullptr), since_(all.now_) {}
  ~Connection() { leave(); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  [[nodiscard]] bool is_tab() const { return watcher_ != nullptr; }
  [[nodiscard]] bool is_head() const { return !is_tab() && !is_answered_; }
  /// A tab without the access word.
  [[nodiscard]] bool is_stranger() const { return is_tab() && !knows_word_; }
  [[nodiscard]] const std::string& from() const { return stream_.from(); }

  void open() {
    stream_.open([me = shared_from_this()](std::error_code error) {
      if (error || !me->stream_.is_open()) return me->close();
      me->read();
    });
  }
  void tick() {
    if (!is_tab()) {
      if (all_.now_ - since_ > (is_answered_ ? kSlowest : kPatience)) close();
      return;
    }
    if (!is_writing_ && watcher_->under_way.empty()) since_ = all_.now_;
    if (is_stranger() && all_.now_ - since_ > kSilence) return close();
    send_next();
  }
  /// Sends the last message of a tab, as far as it can be written without waiting.
  void say_bye(std::string_view text) {
    if (!is_tab() || is_writing_) return;
    const std::string last = last_frames(bye_message(text));
    stream_.write_now({asio::buffer(last), {}});
  }
  void close() {
    const auto me = shared_from_this();
    stream_.close();
    leave();
    std::erase(all_.all_, me);
  }

 private:
  void read() {
    stream_.read(asio::buffer(room_),
                 [me = shared_from_this()](std::error_code error, std::size_t size) {
                   if (error || !me->stream_.is_open()) return me->close();
                   me->in_.append(me->room_.data(), size);
                   if (me->take_in()) me->read();
                 });
  }
  void leave() {
    if (!watcher_) return;
    all_.stage_->leave(*watcher_);
    watcher_.reset();
  }

  // @return false if nothing more can be read
  bool take_in() {
    if (is_answered_) return false;
    return is_tab() ? take_frames() : take_request();
  }

  bool take_frames() {
    std::size_t at = 0;
    const auto octets = std::as_bytes(std::span(in_));
    ClientFrame frame;
    while (true) {
      const FrameVerdict verdict =
          read_client_frame(octets.subspan(at), compression_ != nullptr, frame);
      if (verdict == FrameVerdict::incomplete) break;
      const std::size_t under_way = watcher_->under_way.size();
      const bool is_good = verdict == FrameVerdict::good &&
                           (!frame.is_compressed || compression_->inflate(frame)) &&
                           all_.stage_->answer(*watcher_, frame.payload());
      if (!is_good) {
        close();
        return false;
      }
      if (watcher_->under_way.size() < under_way) since_ = all_.now_;
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
      refuse(400, "Bad Request", "malformed request");
      return false;
    }
    answer(request);
    return is_tab();
  }

  void answer(const HttpRequest& request) {
    const Access& access = all_.access_;
    if (!access.is_own_host(request.host))
      return refuse(403, "Forbidden", "this server has another name");
    if (!request.origin.empty() && !access.is_own_origin(request.origin, request.host))
      return refuse(403, "Forbidden", "cross-origin requests are refused");
    if (request.method != "GET") return refuse(404, "Not Found", "only GET is supported");
    if (all_.stage_ == nullptr) return answer_metrics(request);
    if (request.path == "/stream") return upgrade(request);
    const PageFile* file = find_page_file(request.path);
    if (file == nullptr) return refuse(404, "Not Found", "no such file");
    const bool is_plain = file->gzip.empty();
    end_with(file_answer(file->content_type, is_plain ? "" : "gzip",
                         is_plain ? file->text : file->gzip));
  }

  void answer_metrics(const HttpRequest& request) {
    if (request.path != kMetricsPath) return refuse(404, "Not Found", "only /metrics exists");
    end_with(file_answer(all_.metrics_.content_type, "", all_.metrics_.text()));
  }

  void upgrade(const HttpRequest& request) {
    if (request.origin.empty() || request.version != "13" || !is_web_socket_key(request.key) ||
        !lists_word(request.upgrade, "websocket") || !lists_word(request.connection, "upgrade"))
      return refuse(400, "Bad Request", "/stream needs a WebSocket of version 13");
    const bool knows_word = all_.access_.is_word(value_in_query(request.query, "word"));
    if (const std::string why = refusal_of(knows_word); !why.empty()) {
      ++all_.counts_.refused;
      return end_with(upgrade_answer(request.key, {}).append(last_frames(bye_message(why))));
    }
    const auto terms = agree_on_deflate(request.extensions);
    if (terms) compression_ = std::make_unique<MessageCompression>(*terms);
    std::string head = upgrade_answer(request.key, terms ? terms->answer : std::string());
    in_.erase(0, request.length);
    knows_word_ = knows_word;
    since_ = all_.now_;
    watcher_ = all_.stage_->admit(knows_word);
    ++all_.counts_.tabs;
    send(std::make_shared<const std::string>(std::move(head)), nullptr);
    if (!in_.empty()) (void)take_frames();
  }

  // Why it may not become a tab, as the page shows it; empty: it may.
  [[nodiscard]] std::string refusal_of(bool knows_word) {
    if (!knows_word && all_.needs_word_)
      return "this exercise has a key: open the address that Reckon printed";
    const auto is_here = [this](const Pointer& one) {
      return one->is_stranger() && one->from() == from();
    };
    if (!knows_word && all_.count(is_here) >= kMostStrangers)
      return fmt::format(
          "your address has the maximum of {} tabs without the word; open the address that Reckon "
          "printed",
          kMostStrangers);
    if (all_.tabs() < kMostTabs) return {};
    const Pointer stranger = all_.oldest([](const Pointer& one) { return one->is_stranger(); });
    if (!knows_word || !stranger)
      return fmt::format("the maximum of {} tabs is open; close one and reload this page",
                         kMostTabs);
    stranger->say_bye("a tab with the word replaced this one");
    stranger->close();
    return {};
  }

  void refuse(int status, std::string_view reason, std::string_view text) {
    ++all_.counts_.refused;
    end_with(refusal_answer(status, reason, text));
  }

  void end_with(std::string text) {
    is_answered_ = true;
    since_ = all_.now_;
    const auto kept = std::make_shared<const std::string>(std::move(text));
    stream_.write({asio::buffer(*kept), {}},
                  [me = shared_from_this(), kept](std::error_code error, std::size_t) {
                    if (error) return me->close();
                    me->stream_.end([me] { me->close(); });
                  });
  }

  void send_next() {
    if (is_writing_ || !is_tab()) return;
    auto message = all_.stage_->next_message(*watcher_);
    if (!message) return;
    if (message->opcode == WebSocketOpcode::binary) ++all_.counts_.pictures;
    PackedMessage packed =
        pack_message(message->opcode, std::move(message->payload), compression_.get());
    head_ = packed.head;
    send(std::move(packed.payload), &head_);
  }

  /// Sends a message, and after it the next one.
  void send(std::shared_ptr<const std::string> payload, const FrameHead* head) {
    is_writing_ = true;
    out_ = std::move(payload);
    all_.counts_.octets += out_->size();
    stream_.write(
        {head == nullptr ? asio::const_buffer{} : asio::buffer(head->octets.data(), head->size),
         asio::buffer(*out_)},
        [me = shared_from_this()](std::error_code error, std::size_t) {
          me->is_writing_ = false;
          if (error || !me->stream_.is_open()) return me->close();
          me->send_next();
        });
  }

  Connections& all_;
  ByteStream stream_;
  nanoseconds since_;  // start, time of the answer, or of a tab's oldest picture that is not drawn
  std::string in_;
  std::array<char, kReadSize> room_{};
  std::unique_ptr<Watcher> watcher_;
  std::unique_ptr<MessageCompression> compression_;  // null: not agreed
  bool knows_word_ = false, is_answered_ = false, is_writing_ = false;
  FrameHead head_;
  std::shared_ptr<const std::string> out_;
};

ViewServer::Connections::~Connections() {
  for (const auto& connection : all_) connection->say_bye("the program has ended");
  all_.clear();
}

void ViewServer::Connections::tick(nanoseconds now) {
  now_ = now;
  if (!is_accepting_) accept();
  for (const auto& connection : std::vector(all_)) connection->tick();
}

std::size_t ViewServer::Connections::tabs() const {
  return count([](const Pointer& one) { return one->is_tab(); });
}

void ViewServer::Connections::make_room(const std::string& from) {
  const auto is_head_here = [&](const Pointer& one) {
    return one->is_head() && one->from() == from;
  };
  if (count(is_head_here) >= kMostHeads) oldest(is_head_here)->close();
  if (all_.size() < kMostConnections) return;
  if (const Pointer one = oldest([](const Pointer& other) { return !other->is_tab(); }))
    one->close();
}

void ViewServer::Connections::accept() {
  is_accepting_ = true;
  acceptor_.async_accept([this](std::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    // Without free descriptors, for example, another try would fail at once: the next tick tries
    // again.
    if (error) return void(is_accepting_ = false);
    const auto connection = std::make_shared<Connection>(*this, std::move(socket));
    make_room(connection->from());
    all_.push_back(connection);
    connection->open();
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

std::string ViewServer::origin() const { return connections_->origin(connections_->names().own); }

std::string ViewServer::address() const { return connections_->url(connections_->names().own); }

std::vector<std::string> ViewServer::addresses_for_others() const {
  std::vector<std::string> out;
  for (const std::string& host : connections_->names().all)
    if (host != "localhost" && host != "[::1]" && !host.starts_with("127."))
      out.push_back(connections_->url(host));
  return out;
}

std::size_t ViewServer::tabs() const noexcept { return connections_->tabs(); }

const ViewServerCounts& ViewServer::counts() const noexcept { return connections_->counts(); }

}  // namespace reckon::tools
