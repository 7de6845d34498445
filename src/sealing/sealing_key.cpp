// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/sealing_key.hpp"

#include <sodium.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>
#include <tuple>

namespace reckon::peer {
namespace {

static_assert(sizeof(crypto_aead_aes256gcm_state) <= 512);
static_assert(crypto_aead_aes256gcm_ABYTES == kEnvelopeTag);
static_assert(crypto_aead_xchacha20poly1305_ietf_ABYTES == kEnvelopeTag);
static_assert(crypto_aead_aes256gcm_KEYBYTES == kKeyOctets);
static_assert(crypto_aead_xchacha20poly1305_ietf_KEYBYTES == kKeyOctets);

constexpr std::size_t kSequence = 16, kStamp = 24, kSalt = 28;  // offsets in the header
constexpr std::size_t kSequenceOctets = 8, kStampOctets = 4, kSaltOctets = 8;
// First octet of the header that enters the key: all but octet 0, up to the sequence.
constexpr std::size_t kKeyBegin = 1;
constexpr std::size_t kKeyEnd = kSequence;

const unsigned char* octets(const std::byte* from) noexcept {
  return reinterpret_cast<const unsigned char*>(from);
}
unsigned char* octets(std::byte* from) noexcept { return reinterpret_cast<unsigned char*>(from); }

/// Stamp and sequence at the end; the salt first, if there is room for it, and zeros in between.
template <std::size_t Octets>
std::array<unsigned char, Octets> nonce_of(const std::byte* header) noexcept {
  std::array<unsigned char, Octets> nonce{};
  std::copy_n(octets(header) + kStamp, kStampOctets, nonce.end() - kSequenceOctets - kStampOctets);
  std::copy_n(octets(header) + kSequence, kSequenceOctets, nonce.end() - kSequenceOctets);
  if constexpr (Octets >= kSaltOctets + kStampOctets + kSequenceOctets)
    std::copy_n(octets(header) + kSalt, kSaltOctets, nonce.begin());
  return nonce;
}

auto gcm_nonce(const std::byte* header) noexcept {
  return nonce_of<crypto_aead_aes256gcm_NPUBBYTES>(header);
}
auto xchacha_nonce(const std::byte* header) noexcept {
  return nonce_of<crypto_aead_xchacha20poly1305_ietf_NPUBBYTES>(header);
}

/// The additional data of the tag: the header up to the sequence, and the destination. The rest of
/// the header is in the nonce or in the key.
using Covered = std::array<std::byte, kSequence + std::tuple_size_v<Destination>>;
Covered covered_of(const std::byte* header, const Destination& to) noexcept {
  Covered all;
  std::ranges::copy(to, std::copy_n(header, kSequence, all.begin()));
  return all;
}

const crypto_aead_aes256gcm_state* gcm_state(const std::byte* state) noexcept {
  return reinterpret_cast<const crypto_aead_aes256gcm_state*>(state);
}

}  // namespace

void prepare_sealing() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot be initialized");
}

bool can_seal(SealingSuite suite) {
  prepare_sealing();
  return suite != SealingSuite::aes_256_gcm || crypto_aead_aes256gcm_is_available() == 1;
}

void wipe(std::span<std::byte> octets) noexcept { sodium_memzero(octets.data(), octets.size()); }

KeyOctets derive_key(const KeyOctets& secret, const EnvelopeHeader& header) noexcept {
  std::array<std::byte, kEnvelopeHeader> named;
  write_envelope(header, named);
  std::size_t end = kKeyEnd;
  if (header.suite == SealingSuite::aes_256_gcm)
    end = static_cast<std::size_t>(
        std::copy_n(named.begin() + kSalt, kSaltOctets, named.begin() + kKeyEnd) - named.begin());
  KeyOctets key;
  crypto_generichash_blake2b(octets(key.data()), key.size(), octets(named.data()) + kKeyBegin,
                             end - kKeyBegin, octets(secret.data()), secret.size());
  return key;
}

void SealingKey::set_key(SealingSuite suite, const KeyOctets& key) noexcept {
  suite_ = suite;
  if (suite == SealingSuite::aes_256_gcm) {
    crypto_aead_aes256gcm_beforenm(reinterpret_cast<crypto_aead_aes256gcm_state*>(state_.data()),
                                   octets(key.data()));
  } else {
    std::ranges::copy(key, state_.begin());
  }
}

void SealingKey::seal(const EnvelopeHeader& header, const Destination& to,
                      std::span<const std::byte> plain, std::span<std::byte> out) const noexcept {
  assert(out.size() == plain.size() + kEnvelope);
  write_envelope(header, out.first<kEnvelopeHeader>());
  const Covered covered = covered_of(out.data(), to);
  std::byte* const sealed = out.data() + kEnvelopeHeader;
  if (suite_ == SealingSuite::aes_256_gcm) {
    crypto_aead_aes256gcm_encrypt_afternm(
        octets(sealed), nullptr, octets(plain.data()), plain.size(), octets(covered.data()),
        covered.size(), nullptr, gcm_nonce(out.data()).data(), gcm_state(state_.data()));
  } else {
    crypto_aead_xchacha20poly1305_ietf_encrypt(
        octets(sealed), nullptr, octets(plain.data()), plain.size(), octets(covered.data()),
        covered.size(), nullptr, xchacha_nonce(out.data()).data(), octets(state_.data()));
  }
}

bool SealingKey::open(std::span<const std::byte> datagram, const Destination& to,
                      std::span<std::byte> out) const noexcept {
  assert(datagram.size() >= kEnvelope && out.size() == datagram.size() - kEnvelope);
  const std::byte* const header = datagram.data();
  const Covered covered = covered_of(header, to);
  const std::span<const std::byte> sealed = datagram.subspan(kEnvelopeHeader);
  if (suite_ == SealingSuite::aes_256_gcm) {
    return crypto_aead_aes256gcm_decrypt_afternm(
               octets(out.data()), nullptr, nullptr, octets(sealed.data()), sealed.size(),
               octets(covered.data()), covered.size(), gcm_nonce(header).data(),
               gcm_state(state_.data())) == 0;
  }
  return crypto_aead_xchacha20poly1305_ietf_decrypt(
             octets(out.data()), nullptr, nullptr, octets(sealed.data()), sealed.size(),
             octets(covered.data()), covered.size(), xchacha_nonce(header).data(),
             octets(state_.data())) == 0;
}

}  // namespace reckon::peer
