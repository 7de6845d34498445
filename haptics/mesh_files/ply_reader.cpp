// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// PLY: a header that declares elements with their properties, then the elements as text or binary.
// The reader takes x, y, z of `vertex` and the list `vertex_indices` of `face`.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "reckon/haptics/input_files/load_budget.hpp"
#include "reckon/haptics/mesh_files/mesh_readers.hpp"

namespace reckon::haptics {

namespace {

static_assert(std::endian::native == std::endian::little);

struct Type {
  std::array<std::string_view, 2> names;
  std::size_t octets;
  double (*value)(const char* octets);  // in this machine's byte order
};

template <class T>
double value_of(const char* octets) {
  T value;
  std::memcpy(&value, octets, sizeof value);
  return static_cast<double>(value);
}

constexpr Type kTypes[] = {
    {{"char", "int8"}, 1, value_of<std::int8_t>},
    {{"uchar", "uint8"}, 1, value_of<std::uint8_t>},
    {{"short", "int16"}, 2, value_of<std::int16_t>},
    {{"ushort", "uint16"}, 2, value_of<std::uint16_t>},
    {{"int", "int32"}, 4, value_of<std::int32_t>},
    {{"uint", "uint32"}, 4, value_of<std::uint32_t>},
    {{"float", "float32"}, 4, value_of<float>},
    {{"double", "float64"}, 8, value_of<double>},
};

struct Property {
  std::string_view name;
  const Type* type = nullptr;
  const Type* length = nullptr;  // type of a list's length
};

struct Element {
  std::string_view name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding : std::uint8_t { text, little, big };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
};

const Type* type_of(std::string_view name, std::size_t line) {
  const auto found = std::ranges::find_if(
      kTypes, [&](const Type& type) { return name == type.names[0] || name == type.names[1]; });
  if (found != std::end(kTypes)) return &*found;
  throw MeshFileError(line, "'" + std::string(name) + "' is not a PLY type");
}

Encoding encoding_of(std::string_view name, std::size_t line) {
  if (name == "ascii") return Encoding::text;
  if (name == "binary_little_endian") return Encoding::little;
  if (name == "binary_big_endian") return Encoding::big;
  throw MeshFileError(line, "'" + std::string(name) + "' is not a PLY format");
}

Property read_property(TextCursor& text) {
  Property property;
  std::string_view type = text.word();
  if (type == "list") {
    property.length = type_of(text.word(), text.line());
    type = text.word();
  }
  property.type = type_of(type, text.line());
  property.name = text.word();
  return property;
}

/// Ends with `text` in the line `end_header`.
Header read_header(TextCursor& text) {
  if (!text.next_line() || text.word() != "ply") {
    throw MeshFileError(0, "cannot be read as PLY: it does not begin with 'ply'");
  }
  Header header;
  while (text.next_line()) {
    const std::string_view what = text.word();
    if (what == "end_header") return header;
    if (what == "format") header.encoding = encoding_of(text.word(), text.line());
    if (what == "element") {
      Element& element = header.elements.emplace_back();
      element.name = text.word();
      const long long count = take_integer(text, "an element's count");
      if (count < 0) throw MeshFileError(text.line(), "an element's count is below 0");
      element.count = static_cast<std::size_t>(count);
    }
    if (what != "property") continue;
    if (header.elements.empty()) {
      throw MeshFileError(text.line(), "a property before the first element");
    }
    header.elements.back().properties.push_back(read_property(text));
  }
  throw MeshFileError(text.line(), "ends within its header; export the mesh again");
}

/// A sequence of values, in either encoding.
class Values {
 public:
  Values(TextCursor text, Encoding encoding)
      : text_(text), octets_(text.behind_line()), encoding_(encoding) {}

  [[nodiscard]] bool is_text() const { return encoding_ == Encoding::text; }
  /// Line of the last value; 0 in a binary file.
  [[nodiscard]] std::size_t line() const { return is_text() ? text_.line() : 0; }

  double next(const Type& type) { return is_text() ? next_word() : next_octets(type); }

 private:
  double next_word() {
    const std::string_view word = text_.word_of_any_line();
    if (word.empty()) throw MeshFileError(text_.line(), "is truncated; export the mesh again");
    if (const auto value = to_number(word)) return *value;
    throw MeshFileError(text_.line(), "'" + std::string(word) + "' is not a number");
  }

  double next_octets(const Type& type) {
    if (octets_.size() < type.octets) {
      throw MeshFileError(0, "is truncated; export the mesh again");
    }
    std::array<char, 8> value{};
    std::copy_n(octets_.begin(), type.octets, value.begin());
    if (encoding_ == Encoding::big) std::reverse(value.begin(), value.begin() + type.octets);
    octets_.remove_prefix(type.octets);
    return type.value(value.data());
  }

  TextCursor text_;
  std::string_view octets_;
  Encoding encoding_;
};

long long whole(double value, std::size_t line) {
  if (value >= -1e15 && value <= 1e15) {
    const auto number = static_cast<long long>(value);
    if (static_cast<double>(number) == value) return number;
  }
  throw MeshFileError(line, "a number of corners or an index is not a whole number");
}

/// Number of values in a property; 1 if it is not a list.
long long length_of(const Property& property, Values& values) {
  return property.length == nullptr ? 1 : whole(values.next(*property.length), values.line());
}

void skip(const Property& property, Values& values) {
  for (long long left = length_of(property, values); left > 0; --left) values.next(*property.type);
}

void read_vertex(const Element& element, Values& values, MeshFile& file) {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (const Property& property : element.properties) {
    if (property.length != nullptr) {
      skip(property, values);
      continue;
    }
    const double value = values.next(*property.type);
    const std::size_t axis = std::string_view("xyz").find(property.name);
    if (property.name.size() == 1 && axis < 3) p[static_cast<Eigen::Index>(axis)] = value;
  }
  add_vertex(file, p, values.line());
}

bool is_material(const Property& property) {
  return property.length == nullptr && property.name == "material_index";
}

bool is_corners(const Property& property) {
  return property.length != nullptr &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

void read_face(const Element& element, Values& values, MeshFile& file, FaceNamer& namer) {
  begin_face(file, file.faces.size() + 1);
  for (const Property& property : element.properties) {
    if (is_material(property)) {
      const long long material = whole(values.next(*property.type), values.line());
      file.faces.back().material = namer.number_of(std::to_string(material));
      continue;
    }
    if (!is_corners(property)) {
      skip(property, values);
      continue;
    }
    for (long long left = length_of(property, values); left > 0; --left) {
      add_corner(file, whole(values.next(*property.type), values.line()), values.line());
    }
  }
  if (values.is_text()) file.faces.back().place = static_cast<std::uint32_t>(values.line());
}

/// @throws MeshFileError if an element lacks a property that a point or polygon needs.
void check_element(const Element& element) {
  const auto has = [&](std::string_view name) {
    return std::ranges::any_of(element.properties, [&](const Property& property) {
      return property.name == name && property.length == nullptr;
    });
  };
  if (element.name == "vertex" && !(has("x") && has("y") && has("z"))) {
    throw MeshFileError(0, "cannot be read: its vertices have no x, y and z");
  }
  if (element.name == "face" && std::ranges::none_of(element.properties, is_corners)) {
    throw MeshFileError(0, "cannot be read: its faces have no list vertex_indices");
  }
}

/// Room for an element, whatever its header claims: a face or a vertex takes some octets.
void reserve(const Element& element, std::size_t octets, MeshFile& file) {
  const std::size_t count =
      std::min({element.count, octets / 4, LoadBudget::limit(LoadWork::triangles)});
  if (element.name == "vertex") file.vertices.reserve(count);
  if (element.name != "face") return;
  file.faces.reserve(count);
  file.corners.reserve(3 * count);
}

}  // namespace

void read_ply(std::string_view bytes, MeshFile& file) {
  TextCursor text(bytes);
  const Header header = read_header(text);
  Values values(text, header.encoding);
  FaceNamer namer(file);
  file.place_word = values.is_text() ? "line" : "face";
  for (const Element& element : header.elements) {
    if (element.count == 0 || element.properties.empty()) continue;
    check_element(element);
    reserve(element, bytes.size(), file);
    for (std::size_t i = 0; i < element.count; ++i) {
      if (element.name == "vertex") {
        read_vertex(element, values, file);
      } else if (element.name == "face") {
        read_face(element, values, file, namer);
      } else {
        for (const Property& property : element.properties) skip(property, values);
      }
    }
  }
}

}  // namespace reckon::haptics
