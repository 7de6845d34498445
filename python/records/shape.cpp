// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/python/records/shape.hpp"

#include <cxxabi.h>
#include <structmember.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace reckon::python {
namespace py = pybind11;
namespace {

constexpr const char* kFormName = "_form";
constexpr const char* kPaddingName = "_padding";

// Instances of templates, by their names in pdu/.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kAliases{
    {{"BasicEmitterBeam<JammingTechnique>", "EmitterBeam"},
     {"BasicEmitterBeam<JammingModeSequence>", "EmitterBeamOfDis6"},
     {"EmissionSystem<BasicEmitterBeam<JammingTechnique> >", "EmitterSystem"},
     {"EmissionSystem<BasicEmitterBeam<JammingModeSequence> >", "EmitterSystemOfDis6"},
     {"EmissionSystem<AcousticBeam>", "AcousticSystem"},
     {"BasicLinearSegment<float>", "LinearSegment"},
     {"BasicLinearSegment<unsigned short>", "LinearSegmentOfDis6"},
     {"GridValue<float>", "GridValueFloat"},
     {"GridValue<unsigned short>", "GridValueInteger"}}};

/// The name of a C++ record without its namespace.
std::string class_name(const char* type_name) {
  int status = 0;
  char* const demangled = abi::__cxa_demangle(type_name, nullptr, nullptr, &status);
  std::string name = status == 0 ? demangled : type_name;
  std::free(demangled);
  constexpr std::string_view kNamespace = "reckon::pdu::";
  for (auto at = name.find(kNamespace); at != std::string::npos; at = name.find(kNamespace))
    name.erase(at, kNamespace.size());
  for (const auto& [spelled, alias] : kAliases)
    if (name == spelled) return std::string(alias);
  std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
  return name;
}

/// Offset of a slot's value in an object of the class.
Py_ssize_t slot_offset(PyTypeObject* type, const std::string& name) {
  const py::object slot =
      py::reinterpret_borrow<py::object>(reinterpret_cast<PyObject*>(type)).attr(name.c_str());
  if (!PyObject_TypeCheck(slot.ptr(), &PyMemberDescr_Type))
    throw std::logic_error(name + " is not a slot");
  return reinterpret_cast<PyMemberDescrObject*>(slot.ptr())->d_member->offset;
}

}  // namespace

Form::Form(const Shape& shape, const Form* before, const FormStep& last)
    : shape_(shape), token_(PyCapsule_New(this, kFormName, nullptr)) {
  if (token_ == nullptr) throw py::error_already_set();
  if (before == nullptr) return;
  steps_ = before->steps_;
  steps_.push_back(last);
}

Form& Form::with(std::string_view name, WireKind kind, std::size_t size) {
  for (const auto& next : next_) {
    const FormStep& step = next->steps_.back();
    if (step.kind == kind && step.size == size &&
        ((step.name.data() == name.data() && step.name.size() == name.size()) || step.name == name))
      return *next;
  }
  const Py_ssize_t offset = shape_.offset(name);
  if (offset < 0)
    throw std::logic_error(shape_.name() + " has no field " + std::string(name) + " in examples");
  return *next_.emplace_back(
      std::make_unique<Form>(shape_, this, FormStep{name, kind, size, offset}));
}

const Form* Form::of_token(PyObject* token) {
  return static_cast<const Form*>(PyCapsule_GetPointer(token, kFormName));
}

Shape::Shape(const char* type_name) : name_(class_name(type_name)) {}

void Shape::rename(std::string_view snake_name) {
  name_.clear();
  bool begins = true;
  for (const char c : snake_name) {
    if (c != '_') name_ += begins ? static_cast<char>(std::toupper(c)) : c;
    begins = c == '_';
  }
}

void Shape::declare(std::string_view name, std::string_view type) {
  const auto known = std::find_if(fields_.begin(), fields_.end(),
                                  [&](const Field& field) { return field.name == name; });
  if (known == fields_.end()) {
    fields_.push_back({std::string(name), std::string(type)});
  } else if ((" | " + known->type + " | ").find(" | " + std::string(type) + " | ") ==
             std::string::npos) {
    known->type.append(" | ").append(type);
  }
}

void Shape::make_class(const py::object& base) {
  py::list slots;
  for (const Field& field : fields_) slots.append(field.name);
  py::dict members;
  members["__slots__"] = py::tuple(slots);
  members["__module__"] = "reckon";
  const py::object made =
      py::module_::import("builtins").attr("type")(name_, py::make_tuple(base), members);
  type_ = reinterpret_cast<PyTypeObject*>(made.inc_ref().ptr());
  for (const Field& field : fields_) offsets_[field.name] = slot_offset(type_, field.name);
  form_offset_ = slot_offset(type_, kFormName);
  padding_offset_ = slot_offset(type_, kPaddingName);
  root_ = std::make_unique<Form>(*this, nullptr, FormStep{});
}

Py_ssize_t Shape::offset(std::string_view name) const {
  const auto found = offsets_.find(name);
  return found == offsets_.end() ? -1 : found->second;
}

// Both outlive the interpreter, whose objects they name: they are never destroyed.
std::vector<std::unique_ptr<Shape>>& all_shapes() {
  static auto& shapes = *new std::vector<std::unique_ptr<Shape>>;
  return shapes;
}

Shape& new_shape(const char* type_name) {
  return *all_shapes().emplace_back(std::make_unique<Shape>(type_name));
}

Shape* shape_of_class(PyTypeObject* type) {
  static auto& by_class = *new std::unordered_map<PyTypeObject*, Shape*>;
  if (by_class.size() != all_shapes().size())
    for (const auto& shape : all_shapes()) by_class[shape->type()] = shape.get();
  const auto found = by_class.find(type);
  return found == by_class.end() ? nullptr : found->second;
}

}  // namespace reckon::python
