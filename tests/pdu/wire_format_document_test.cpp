// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// docs/wire_format.md shows the byte tables of Reckon's own formats; they must equal the field
// tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/tests/support/places.hpp"

namespace reckon::pdu {
namespace {

struct Row {
  std::size_t offset;
  std::string size;
  std::string type;
  std::string name;

  [[nodiscard]] std::string text() const {
    return "| " + std::to_string(offset) + " | " + size + " | " + type + " | " + name + " |";
  }
};

/// Visitor: the first four columns of a byte table, one row per field; a record of equal numbers,
/// such as a vector, is one row.
class TableRows {
 public:
  template <typename T>
  void operator()(std::string_view name, const T& value) {
    if constexpr (Scalar<T>) {
      row(sizeof(T), type_name<T>(), name);
    } else if constexpr (kIsStdArray<T>) {
      row(value.size(), std::is_same_v<typename T::value_type, char> ? "text" : "octets", name);
    } else if constexpr (std::is_same_v<T, PduHeader>) {
      row(kHeaderSize, "header", name);
    } else {
      TableRows inner;
      inner.offset_ = offset_;
      fields(inner, value);
      take(inner, name);
    }
  }
  template <typename Record, typename Count>
  void count(std::string_view name, std::span<const std::byte>, Records<Record, Count>) {
    row(sizeof(Count), type_name<Count>(), name);
  }
  template <typename Record, typename Count>
  void records(std::string_view name, std::span<const std::byte>, Records<Record, Count>) {
    rows_.push_back(
        {offset_, std::to_string(kFixedSize<Record>) + " n", "records", std::string(name)});
  }
  template <typename View>
  void walked(std::string_view name, const View&) {
    rows_.push_back({offset_, "varies", "records", std::string(name)});
  }

  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

 private:
  void row(std::size_t size, std::string type, std::string_view name) {
    rows_.push_back({offset_, std::to_string(size), std::move(type), std::string(name)});
    offset_ += size;
  }
  void take(const TableRows& inner, std::string_view name) {
    const std::string& type = inner.rows_.front().type;
    const bool equal =
        std::ranges::all_of(inner.rows_, [&](const Row& field) { return field.type == type; });
    if (equal) {
      row(inner.offset_ - offset_, std::to_string(inner.rows_.size()) + " x " + type, name);
      return;
    }
    for (Row field : inner.rows_) {
      field.name = std::string(name) + "." + field.name;
      rows_.push_back(field);
    }
    offset_ = inner.offset_;
  }
  template <typename T>
  static std::string type_name() {
    const std::string bits = std::to_string(8 * sizeof(T));
    if constexpr (std::is_floating_point_v<T>) return "f" + bits;
    return (std::is_signed_v<T> ? "i" : "u") + bits;
  }

  std::vector<Row> rows_;
  std::size_t offset_ = 0;
};

template <typename T>
class WireFormatDocument : public testing::Test {};

/// The types of `More` and the experimental types of the list: all types of this project.
template <typename More, typename List>
struct WithOwn {
  using Types = More;
};
template <typename... More, typename First, typename... Rest>
struct WithOwn<testing::Types<More...>, TypeList<First, Rest...>>
    : WithOwn<std::conditional_t<is_experimental(First::kPduType), testing::Types<More..., First>,
                                 testing::Types<More...>>,
              TypeList<Rest...>> {};

using Documented = WithOwn<
    testing::Types<EntityState, Attribute, HapticRecord, EnergyAccountRecord, OwnershipRecord>,
    PduTypes>::Types;
TYPED_TEST_SUITE(WireFormatDocument, Documented);

TYPED_TEST(WireFormatDocument, ShowsTheRowsOfTheFieldTable) {
  std::ifstream file(std::filesystem::path(reckon::test::source_dir()) / "docs/wire_format.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  TableRows table;
  const TypeParam value;
  fields(table, value);

  std::string wanted;
  for (const Row& row : table.rows()) wanted += row.text() + "\n";
  // The rows must be on consecutive lines; a last column is for readers.
  const std::string first = table.rows().front().text();
  for (std::size_t at = text.find(first); at != std::string::npos; at = text.find(first, at + 1)) {
    std::size_t line = at;
    const bool whole = std::ranges::all_of(table.rows(), [&](const Row& row) {
      const bool here = text.compare(line, row.text().size(), row.text()) == 0;
      line = std::min(text.find('\n', line), text.size() - 1) + 1;
      return here;
    });
    if (whole) return;
  }
  FAIL() << "docs/wire_format.md has no table with these rows:\n" << wanted;
}

}  // namespace
}  // namespace reckon::pdu
