// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/python/records/classes.hpp"

#include <array>
#include <unordered_set>
#include <vector>

#include "reckon/pdu/field_variants.hpp"
#include "reckon/pdu/field_walk.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/python/records/object_maker.hpp"
#include "reckon/python/records/shape.hpp"
#include "reckon/python/records/unknown_pdu.hpp"

namespace reckon::python {
namespace py = pybind11;
namespace {

template <typename T>
constexpr std::string_view python_type() {
  switch (kWireKind<T>) {
    case WireKind::text:
      return "str";
    case WireKind::octets:
      return "bytes";
    case WireKind::real:
      return "float";
    default:
      return "int";
  }
}

constexpr std::array<std::byte, 16> kZeros{};

/// The first record of a list in an object. Consumes the reference to the object; new reference.
PyObject* first_of(PyObject* object, const char* list) {
  const py::object all = py::reinterpret_steal<py::object>(object);
  return py::object(all.attr(list)[py::int_(0)]).release().ptr();
}

PyObject* initial_datum() {
  pdu::Comment pdu;
  pdu.variable_datums = {1, std::span(kZeros).first(8)};
  return first_of(make_object(pdu), "variable_datum_records");
}

PyObject* initial_attribute_set() {
  pdu::Attribute pdu;
  pdu.record_sets = {1, std::span(kZeros).first(pdu::kAttributeSetHeaderSize)};
  return first_of(make_object(pdu), "attribute_record_sets");
}

PyObject* initial_attribute_record() {
  // A set of one record of 8 octets.
  std::array<std::byte, pdu::kAttributeSetHeaderSize + 8> octets{};
  octets[7] = std::byte{1};
  octets[13] = std::byte{8};
  pdu::Attribute pdu;
  pdu.record_sets = {1, octets};
  return first_of(first_of(make_object(pdu), "attribute_record_sets"), "attribute_records");
}

/// Least number of octets behind a head that contain all its parts, without values.
template <typename Head>
constexpr std::size_t kEmptyBody = std::is_same_v<Head, pdu::GridAxis>      ? 16
                                   : std::is_same_v<Head, pdu::GridSamples> ? 2
                                                                            : 0;

/// A record at its initial value as an object; new reference.
template <typename Record>
PyObject* make_initial() {
  if constexpr (std::is_same_v<Record, pdu::VariableDatum>) {
    return initial_datum();
  } else if constexpr (std::is_same_v<Record, pdu::AttributeSet>) {
    return initial_attribute_set();
  } else if constexpr (std::is_same_v<Record, pdu::AttributeRecord>) {
    return initial_attribute_record();
  } else {
    const Record record{};
    ObjectMaker maker;
    maker.enter({}, pdu::kNoIndex, record);
    pdu::FieldWalk walk(maker, record);
    fields(walk, record);
    const auto body = std::span(kZeros).first(kEmptyBody<Record>);
    if constexpr (pdu::HasParts<Record, pdu::FieldWalk<ObjectMaker>>) {
      parts(walk, record, body);
    } else if constexpr (requires { record.extent(body); }) {
      maker.octets("body", {});
    }
    maker.leave();
    return maker.take();
  }
}

/// Handler of a walk through examples: declares classes and their fields.
class Declarer {
 public:
  static constexpr bool kExamples = true;
  template <typename Record>
  bool enter(std::string_view name, std::size_t, const Record&) {
    Shape& shape = shape_of<Record>();
    if constexpr (!pdu::Pdu<Record> && !std::is_same_v<Record, UnknownPdu>) {
      if (shape.make_initial == nullptr) shape.make_initial = make_initial<Record>;
    }
    if (!around_.empty()) {
      const bool in_list = name == list_;
      around_.back()->declare(name, in_list ? "list[" + shape.name() + "]" : shape.name());
    }
    lists_.push_back(list_);
    list_ = {};
    around_.push_back(&shape);
    return true;
  }
  void leave() {
    around_.pop_back();
    list_ = lists_.back();
    lists_.pop_back();
  }
  template <typename T>
  void leaf(std::string_view name, const T&, const pdu::FieldMeanings&) {
    around_.back()->declare(name, python_type<T>());
  }
  void octets(std::string_view name, std::span<const std::byte>) {
    around_.back()->declare(name, "bytes");
  }
  void list(std::string_view name) { list_ = name; }

 private:
  std::vector<Shape*> around_;
  std::vector<std::string_view> lists_;
  std::string_view list_;
};

template <typename Pdu>
void declare() {
  Shape& shape = shape_of<Pdu>();
  shape.make_initial = [] { return make_object(Pdu{}); };
  const auto walk_example = [](const Pdu& example) {
    Declarer declarer;
    declarer.enter({}, pdu::kNoIndex, example);
    pdu::FieldWalk walk(declarer, example);
    fields(walk, example);
    declarer.leave();
  };
  if constexpr (pdu::Pdu<Pdu>) {
    shape.rename(pdu::snake_name(Pdu::kPduType));
    pdu::each_variant<Pdu>(walk_example);
  } else {
    walk_example(Pdu{});
  }
}

template <typename... T>
std::unordered_set<const Shape*> declare_all(pdu::TypeList<T...>) {
  (declare<T>(), ...);
  declare<UnknownPdu>();
  return {&shape_of<T>()..., &shape_of<UnknownPdu>()};
}

}  // namespace

void make_classes(py::module_& module, const py::object& base, const py::object& pdu_base) {
  const auto pdus = declare_all(pdu::PduTypes{});
  for (const auto& shape : all_shapes()) {
    shape->make_class(pdus.contains(shape.get()) ? pdu_base : base);
    module.attr(shape->name().c_str()) =
        py::reinterpret_borrow<py::object>(reinterpret_cast<PyObject*>(shape->type()));
  }
}

}  // namespace reckon::python
