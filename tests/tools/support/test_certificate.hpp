// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A self-signed certificate and its key, as files.
#pragma once

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

namespace reckon::test {

/// Writes NAME.crt and NAME.key (mode 0600) with a new key, valid from `begin` to `end` [s from
/// now), for `host`. @return the path without the ending
inline std::string write_certificate(const std::string& path, const std::string& host = "localhost",
                                     long begin = -60, long end = 3600) {
  const std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)> key(EVP_EC_gen("P-256"), EVP_PKEY_free);
  const std::unique_ptr<X509, decltype(&X509_free)> made(X509_new(), X509_free);
  X509_set_version(made.get(), X509_VERSION_3);
  ASN1_INTEGER_set(X509_get_serialNumber(made.get()), 1);
  X509_gmtime_adj(X509_getm_notBefore(made.get()), begin);
  X509_gmtime_adj(X509_getm_notAfter(made.get()), end);
  X509_set_pubkey(made.get(), key.get());
  X509_NAME_add_entry_by_txt(X509_get_subject_name(made.get()), "CN", MBSTRING_ASC,
                             reinterpret_cast<const unsigned char*>("reckon"), -1, -1, 0);
  X509_set_issuer_name(made.get(), X509_get_subject_name(made.get()));
  const std::unique_ptr<X509_EXTENSION, decltype(&X509_EXTENSION_free)> names(
      X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name,
                          ("DNS:" + host + ",DNS:*.example").c_str()),
      X509_EXTENSION_free);
  X509_add_ext(made.get(), names.get(), -1);
  X509_sign(made.get(), key.get(), EVP_sha256());
  using File = std::unique_ptr<std::FILE, decltype(&std::fclose)>;
  const File certificate(std::fopen((path + ".crt").c_str(), "w"), std::fclose);
  const File secret(std::fopen((path + ".key").c_str(), "w"), std::fclose);
  if (!certificate || !secret || PEM_write_X509(certificate.get(), made.get()) != 1 ||
      PEM_write_PrivateKey(secret.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) != 1)
    throw std::runtime_error("no certificate could be written");
  std::filesystem::permissions(path + ".key", std::filesystem::perms(0600));
  return path;
}

}  // namespace reckon::test
