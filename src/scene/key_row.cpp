// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/key_row.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/units.hpp"

namespace reckon::peer {

Written written(double value, std::string_view unit) {
  return {KeyKind::number, format_quantity(value, unit)};
}

Written written(std::chrono::nanoseconds value, std::string_view unit) {
  return written(pdu::to_seconds(value), unit);
}

Written written_whole(double value, const std::string& digits, std::string_view unit) {
  if (!unit.empty()) return written(value, unit);
  return {KeyKind::integer, digits};
}

Written written(bool value, std::string_view) {
  return {KeyKind::boolean, value ? "true" : "false"};
}

Written written(const std::optional<bool>& value, std::string_view) {
  return {KeyKind::boolean, !value ? "" : *value ? "true" : "false"};
}

Written written(const std::string& value, std::string_view) { return {KeyKind::text, value}; }

Written written(const std::vector<std::string>&, std::string_view) { return {KeyKind::texts, ""}; }

Written written(const std::filesystem::path& value, std::string_view) {
  return {KeyKind::text, value.string()};
}

Written written(const Eigen::Vector3d& value, std::string_view) {
  const Eigen::Vector3d v = value + Eigen::Vector3d::Zero();  // -0 is 0
  return {KeyKind::point, fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v.x(), v.y(), v.z())};
}

KeyRow::KeyRow(const KeyRow&) = default;
KeyRow::KeyRow(KeyRow&&) noexcept = default;
KeyRow& KeyRow::operator=(const KeyRow&) = default;
KeyRow& KeyRow::operator=(KeyRow&&) noexcept = default;
KeyRow::~KeyRow() = default;

KeyRow::KeyRow(std::string_view key, std::string_view sentence) {
  key_.key = key;
  key_.sentence = sentence;
}

KeyRow::KeyRow(SceneKey key, std::function<void(TomlReader& table, void* whole)> read)
    : key_(std::move(key)), read_(std::move(read)) {}

void KeyRow::define(const ValueType& type, const Range& range, const void* standard) {
  type_ = &type;
  Written value = type.write(standard, range.unit);
  key_.kind = value.kind;
  key_.unit = range.unit;
  key_.least = range.least;
  key_.most = range.most;
  if (range.has_default) key_.standard = std::move(value.text);
  if (type.words != nullptr) key_.words = type.words();
}

void KeyRow::define(const KeySection& inside, bool many, void* (*append)(void* many)) {
  inside_ = std::make_shared<KeySection>(inside);
  append_ = append;
  key_.kind = many ? KeyKind::tables : KeyKind::table;
}

void KeyRow::fill(const Finder& finder, const void* whole, const void* value, std::size_t size,
                  std::size_t alignment) {
  finder_ = finder;
  const auto offset = static_cast<const std::byte*>(value) - static_cast<const std::byte*>(whole);
  place_ = {static_cast<std::size_t>(offset), size, alignment};
}

KeyRow KeyRow::without_default() const {
  KeyRow row = *this;
  row.key_.standard.clear();
  return row;
}

void KeyRow::read(TomlReader& table, void* whole) const {
  if (read_ != nullptr) return read_(table, whole);
  if (!finder_ || !table.has(key_.key)) return;
  if (inside_ == nullptr) {
    type_->read(table, key_.key, finder_(whole));
  } else if (append_ != nullptr) {
    for (TomlReader& one : table.tables(key_.key)) inside_->read(one, append_(finder_(whole)));
  } else if (auto one = table.table(key_.key)) {
    inside_->read(*one, finder_(whole));
  }
}

std::vector<SceneKey> KeyRow::inside() const {
  return inside_ == nullptr ? std::vector<SceneKey>() : inside_->keys(key_.key);
}

std::vector<MemberPlace> KeyRow::places() const {
  if (!finder_) return {};
  if (inside_ == nullptr || append_ != nullptr) return {place_};
  std::vector<MemberPlace> places = inside_->places();
  for (MemberPlace& member : places) member.offset += place_.offset;
  return places;
}

void KeySection::read(TomlReader& table, void* whole) const {
  for (const KeyRow& row : rows) row.read(table, whole);
  if (check_ != nullptr) call_(check_, table, whole);
}

std::vector<SceneKey> KeySection::keys(const std::string& name) const {
  std::vector<SceneKey> keys;
  const auto add = [&](SceneKey key) {
    key.section = name + (name.empty() || key.section.empty() ? "" : ".") + key.section;
    keys.push_back(std::move(key));
  };
  for (const KeyRow& row : rows) add(row.key());
  if (add_more_ != nullptr) add_more_(keys);
  for (const KeyRow& row : rows) std::ranges::for_each(row.inside(), add);
  return keys;
}

std::vector<MemberPlace> KeySection::places() const {
  std::vector<MemberPlace> places = {{0, 0, alignment_}, {size_, 0, alignment_}};
  for (const KeyRow& row : rows) {
    const std::vector<MemberPlace> own = row.places();
    places.insert(places.end(), own.begin(), own.end());
  }
  return places;
}

}  // namespace reckon::peer
