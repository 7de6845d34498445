// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/web/tls_context.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "reckon/peer/sealing/key_file.hpp"

namespace reckon::tools {
namespace {

/// TLS 1.2 ciphers: forward secret and authenticated.
constexpr const char* kCiphers = "ECDHE+AESGCM:ECDHE+CHACHA20";

[[noreturn]] void fail(const std::string& file, std::string_view sentence) {
  throw std::runtime_error(fmt::format("--tls: {}: {}", file, sentence));
}

/// The last error as OpenSSL describes it.
std::string fault() {
  const char* const reason = ERR_reason_error_string(ERR_peek_last_error());
  ERR_clear_error();
  return reason == nullptr ? "not readable" : reason;
}

std::string day_of(const ASN1_TIME* time) {
  std::tm day{};
  if (ASN1_TIME_to_tm(time, &day) != 1) return "an unknown day";
  return fmt::format("{:04}-{:02}-{:02}", day.tm_year + 1900, day.tm_mon + 1, day.tm_mday);
}

void use_certificate(SSL_CTX* tls, const std::string& file) {
  if (SSL_CTX_use_certificate_chain_file(tls, file.c_str()) != 1)
    fail(file, fmt::format("is not a PEM certificate ({}); give the file with the chain", fault()));
  const X509* const leaf = SSL_CTX_get0_certificate(tls);
  const ASN1_TIME* const begin = X509_get0_notBefore(leaf);
  const ASN1_TIME* const end = X509_get0_notAfter(leaf);
  if (X509_cmp_current_time(end) < 0)
    fail(file, fmt::format("has expired on {}: renew it", day_of(end)));
  if (X509_cmp_current_time(begin) > 0)
    fail(file, fmt::format("is valid from {}: check the clock of this host", day_of(begin)));
}

void use_key(SSL_CTX* tls, const TlsFiles& files) {
  const int number = ::open(files.key.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (number < 0) fail(files.key, fmt::format("cannot be read: {}", std::strerror(errno)));
  const std::unique_ptr<BIO, decltype(&BIO_free)> file(BIO_new_fd(number, BIO_CLOSE), BIO_free);
  try {
    peer::check_owner_alone(files.key, number);
  } catch (const peer::KeyFileError& error) {
    throw std::runtime_error(fmt::format("--tls: {}", error.what()));
  }
  // No pass phrase can be typed.
  const auto no_phrase = [](char*, int, int, void*) { return -1; };
  const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key(
      PEM_read_bio_PrivateKey(file.get(), nullptr, no_phrase, nullptr), EVP_PKEY_free);
  if (!key)
    fail(files.key, fmt::format("is not a PEM private key without a pass phrase ({})", fault()));
  if (X509_check_private_key(SSL_CTX_get0_certificate(tls), key.get()) != 1 ||
      SSL_CTX_use_PrivateKey(tls, key.get()) != 1)
    fail(files.key, fmt::format("is not the key of the certificate {} ({}): give a matching pair",
                                files.certificate, fault()));
}

bool is_host_name(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
  });
}

}  // namespace

asio::ssl::context open_tls(const TlsFiles& files) {
  asio::ssl::context context(asio::ssl::context::tls_server);
  SSL_CTX* const tls = context.native_handle();
  SSL_CTX_set_min_proto_version(tls, TLS1_2_VERSION);
  SSL_CTX_set_cipher_list(tls, kCiphers);
  SSL_CTX_set_options(
      tls, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_mode(tls, SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_session_cache_mode(tls, SSL_SESS_CACHE_OFF);
  use_certificate(tls, files.certificate);
  use_key(tls, files);
  return context;
}

void check_tls(const TlsFiles& files) { static_cast<void>(open_tls(files)); }

std::optional<asio::ssl::context> open_tls_if_any(const TlsFiles& files) {
  if (files.certificate.empty()) return std::nullopt;
  return open_tls(files);
}

std::vector<std::string> certified_names(asio::ssl::context& context) {
  std::vector<std::string> names;
  const X509* const leaf = SSL_CTX_get0_certificate(context.native_handle());
  auto* const all =
      static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(leaf, NID_subject_alt_name, nullptr, nullptr));
  for (int i = 0; i < sk_GENERAL_NAME_num(all); ++i) {
    const GENERAL_NAME* const one = sk_GENERAL_NAME_value(all, i);
    if (one->type != GEN_DNS) continue;
    const std::string name(reinterpret_cast<const char*>(ASN1_STRING_get0_data(one->d.dNSName)),
                           static_cast<std::size_t>(ASN1_STRING_length(one->d.dNSName)));
    if (is_host_name(name)) names.push_back(name);
  }
  GENERAL_NAMES_free(all);
  return names;
}

}  // namespace reckon::tools
