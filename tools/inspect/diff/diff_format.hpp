// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common parts of the formats of `inspect diff`: entities and types in both captures.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "reckon/tools/inspect/diff/diff.hpp"
#include "reckon/tools/inspect/output/format.hpp"

namespace reckon::tools {

inline std::string key_text(const std::array<std::uint16_t, 3>& key) {
  return id_text({key[0], key[1], key[2]});
}

/// Properties of one entity in both captures; null if it is in one only.
struct EntityInBoth {
  std::array<std::uint16_t, 3> key{};
  const EntityTraits* a = nullptr;
  const EntityTraits* b = nullptr;

  /// Whether counts, marking, force or dead reckoning differ.
  [[nodiscard]] bool differs() const {
    if (a == nullptr || b == nullptr) return true;
    return a->share.pdus != b->share.pdus || a->share.octets != b->share.octets ||
           a->marking != b->marking || a->force != b->force || a->algorithms != b->algorithms;
  }
};

/// All entities of both, by ID.
inline std::vector<EntityInBoth> entities_of(const CaptureDifference& difference) {
  std::map<std::array<std::uint16_t, 3>, EntityInBoth> all;
  for (const auto& [key, traits] : difference.a().entities) all[key].a = &traits;
  for (const auto& [key, traits] : difference.b().entities) all[key].b = &traits;
  std::vector<EntityInBoth> out;
  out.reserve(all.size());
  for (auto& [key, entity] : all) {
    entity.key = key;
    out.push_back(entity);
  }
  return out;
}

/// Share of one type in both captures.
struct TypeInBoth {
  CaptureShare a;
  CaptureShare b;
};

inline std::map<std::string_view, TypeInBoth> types_of(const CaptureDifference& difference) {
  std::map<std::string_view, TypeInBoth> all;
  for (const auto& [type, share] : difference.a().types) all[type].a = share;
  for (const auto& [type, share] : difference.b().types) all[type].b = share;
  return all;
}

/// The numbers of all DRMs that were sent.
inline std::vector<unsigned> algorithms_of(const EntityTraits& traits) {
  std::vector<unsigned> out;
  for (unsigned bit = 0; bit < 32; ++bit)
    if ((traits.algorithms >> bit & 1U) != 0) out.push_back(bit);
  return out;
}

void append_diff_text(const DiffFindings& findings, std::string& out);
void append_diff_json(const DiffFindings& findings, std::string& out);
void append_diff_csv(const DiffFindings& findings, std::string& out);

}  // namespace reckon::tools
