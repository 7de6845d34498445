// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/python/federates/session.hpp"

#include <stdexcept>
#include <utility>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/entity_type_text.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::python {
namespace py = pybind11;
namespace {

Eigen::Vector3d vector_of(const Triple& v) { return {v[0], v[1], v[2]}; }
Triple triple_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

peer::EntityTruth truth_of(const Motion& motion) {
  peer::EntityTruth truth;
  truth.position = vector_of(motion.position);
  truth.velocity = vector_of(motion.velocity);
  truth.acceleration = vector_of(motion.acceleration);
  truth.angular_velocity = vector_of(motion.angular_velocity);
  const Quadruple& q = motion.orientation;
  truth.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  const double norm = truth.orientation.norm();
  if (!(norm > 0.99 && norm < 1.01))
    throw std::invalid_argument("orientation has a length of " + std::to_string(norm) +
                                ": write a unit quaternion w, x, y, z");
  truth.orientation.normalize();
  return truth;
}

peer::FederateOptions options_of(const JoinOptions& options) {
  peer::FederateOptions made;
  made.name = options.name;
  made.interface = options.interface;
  made.site = options.site;
  made.application = options.application;
  if (options.scene.empty()) {
    made.scene = peer::dis_exercise(options.exercise, options.latitude, options.longitude);
  } else {
    made.scene = peer::load_scene_file(options.scene, options.effects);
  }
  return made;
}

}  // namespace

Session::Session(const JoinOptions& options) {
  const py::gil_scoped_release others_run;
  federate_ = std::make_unique<peer::Federate>(options_of(options));
  federate_->subscribe(peer::EntityClass{});
}

Session::~Session() { federate_.reset(); }

peer::Federate& Session::federate() {
  if (federate_ == nullptr)
    throw std::runtime_error("the federate has left the exercise: join again with a new Federate");
  if (std::this_thread::get_id() != thread_)
    throw std::runtime_error(
        "a federate may be used only by the thread that created it: call it there");
  return *federate_;
}

void Session::resign() {
  if (federate_ == nullptr) return;
  if (in_tick_) throw std::runtime_error("resign() within a callback: call it after tick()");
  federate().resign();
  federate_.reset();
  callbacks_.clear();
}

std::uint16_t Session::own(const std::string& marking, const std::string& type, unsigned force_id,
                           const Motion& motion) {
  const pdu::EntityType parsed = peer::entity_type(type);
  if (force_id > 0xFF) throw std::invalid_argument("force_id must be 0 to 255");
  peer::EntityDescription description;
  description.marking = marking;
  description.type = parsed;
  description.force_id = static_cast<pdu::ForceId>(force_id);
  federate().publish(peer::EntityClass{parsed});
  return federate().register_object(description, truth_of(motion)).number;
}

void Session::move(std::uint16_t entity, const Motion& motion) {
  federate().update_attributes({entity}, truth_of(motion));
}

void Session::set_appearance(std::uint16_t entity, std::uint32_t appearance) {
  federate().update_appearance({entity}, appearance);
}

void Session::remove(std::uint16_t entity) { federate().delete_object({entity}); }

std::array<std::uint16_t, 3> Session::id_of(std::uint16_t entity) {
  const pdu::EntityId id = federate().id_of({entity});
  return {id.site, id.application, id.entity};
}

void Session::call(const py::function& callback, auto&& arguments) {
  const py::gil_scoped_acquire python;
  try {
    callback(*arguments());
  } catch (...) {
    if (!first_fault_) first_fault_ = std::current_exception();
  }
}

void Session::on_discover(py::function callback) {
  callbacks_.push_back(callback);
  federate().on_discover([this, of = callback.ptr()](const peer::RemoteObject& object) {
    call(py::reinterpret_borrow<py::function>(of), [&] { return py::make_tuple(seen(object)); });
  });
}

void Session::on_update(py::function callback) {
  callbacks_.push_back(callback);
  federate().on_reflect([this, of = callback.ptr()](const peer::RemoteObject& object) {
    call(py::reinterpret_borrow<py::function>(of), [&] { return py::make_tuple(seen(object)); });
  });
}

void Session::on_remove(py::function callback) {
  callbacks_.push_back(callback);
  federate().on_remove(
      [this, of = callback.ptr()](const peer::RemoteObject& object, peer::Removal cause) {
        call(py::reinterpret_borrow<py::function>(of),
             [&] { return py::make_tuple(seen(object), std::string(name(cause))); });
      });
}

void Session::tick() {
  peer::Federate& federate_now = federate();
  if (in_tick_) throw std::runtime_error("tick() within a callback: return from it first");
  in_tick_ = true;
  try {
    const py::gil_scoped_release others_run;
    federate_now.step();
  } catch (...) {
    if (!first_fault_) first_fault_ = std::current_exception();
  }
  in_tick_ = false;
  if (first_fault_) std::rethrow_exception(std::exchange(first_fault_, nullptr));
}

Seen Session::seen(const peer::RemoteObject& object) {
  Seen made;
  const auto now = federate().now();
  const deadreckon::Pose pose = object.shown(now);
  const pdu::EntityId& id = object.id();
  made.id = {id.site, id.application, id.entity};
  made.type = peer::entity_type_numbers(object.type());
  made.marking = object.marking();
  made.force_id = static_cast<unsigned>(object.force_id());
  made.appearance = object.appearance();
  made.position = triple_of(pose.position);
  made.velocity = triple_of(pose.velocity);
  const Eigen::Quaterniond& q = pose.orientation;
  made.orientation = {q.w(), q.x(), q.y(), q.z()};
  made.age = pdu::to_seconds(object.age(now));
  return made;
}

std::vector<Seen> Session::entities() {
  std::vector<Seen> all;
  federate().for_each([&](const peer::RemoteObject& object) { all.push_back(seen(object)); });
  return all;
}

std::optional<Seen> Session::find(const std::array<std::uint16_t, 3>& id) {
  const auto object = federate().find({id[0], id[1], id[2]});
  if (!object) return std::nullopt;
  return seen(*object);
}

double Session::utc() { return pdu::to_seconds(federate().utc()); }

Triple Session::position(double latitude, double longitude, double height) {
  return triple_of(federate().place(latitude, longitude, height).position);
}

Triple Session::world(const Triple& position) {
  return triple_of(federate().frame().world_from_scene(vector_of(position)));
}

}  // namespace reckon::python
