// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/python/records/object_maker.hpp"

#include <utility>

namespace reckon::python {

void ObjectMaker::enter_shape(std::string_view name, std::size_t index, Shape& shape) {
  if (depth_ == kDeepest) throw std::logic_error("records of a PDU are nested too deep");
  PyObject* const object = checked(shape.type()->tp_alloc(shape.type(), 0));
  if (depth_ > 0 && index == pdu::kNoIndex) {
    Py_INCREF(object);
    set(name, WireKind::record, 0, object);
  } else if (depth_ > 0) {
    if (PyList_Append(frames_[depth_ - 1].list, object) != 0) {
      Py_DECREF(object);
      throw pybind11::error_already_set();
    }
  }
  frames_[depth_++] = {object, &shape, &shape.root(), nullptr, 0};
}

void ObjectMaker::leave() {
  Frame& frame = frames_[depth_ - 1];
  PyObject* const token = frame.form->token();
  Py_INCREF(token);
  value_at(frame.object, frame.shape->form_offset()) = token;
  // A record contains numbers, text and other records, but no reference back to itself. Therefore
  // the collector of cycles need not visit it, the same as tuples of numbers. These visits took two
  // thirds of the time of a program that keeps many PDUs.
  PyObject_GC_UnTrack(frame.object);
  --depth_;
  if (depth_ > 0) {
    frames_[depth_ - 1].octets += frame.octets;
    Py_DECREF(frame.object);  // its owner holds it
  } else {
    made_ = frame.object;
  }
}

void ObjectMaker::set(std::string_view name, WireKind kind, std::size_t size, PyObject* value) {
  Frame& frame = frames_[depth_ - 1];
  frame.form = &frame.form->with(name, kind, size);
  PyObject*& slot = value_at(frame.object, frame.form->last_offset());
  Py_XDECREF(slot);
  slot = value;
}

void ObjectMaker::octets(std::string_view name, std::span<const std::byte> octets) {
  set(name, WireKind::octets, 0,
      checked(PyBytes_FromStringAndSize(reinterpret_cast<const char*>(octets.data()),
                                        static_cast<Py_ssize_t>(octets.size()))));
  frames_[depth_ - 1].octets += octets.size();
}

void ObjectMaker::list(std::string_view name) {
  PyObject* const list = checked(PyList_New(0));
  set(name, WireKind::list, 0, list);
  frames_[depth_ - 1].list = list;
}

void ObjectMaker::extent(std::span<const std::byte> whole) {
  Frame& frame = frames_[depth_ - 1];
  const std::size_t hidden = whole.size() > frame.octets ? whole.size() - frame.octets : 0;
  const auto padding = whole.last(hidden);
  PyObject* const kept = checked(PyBytes_FromStringAndSize(
      reinterpret_cast<const char*>(padding.data()), static_cast<Py_ssize_t>(hidden)));
  PyObject*& slot = value_at(frame.object, frame.shape->padding_offset());
  Py_XDECREF(slot);
  slot = kept;
  frame.octets += hidden;
}

PyObject* ObjectMaker::take() noexcept { return std::exchange(made_, nullptr); }

}  // namespace reckon::python
