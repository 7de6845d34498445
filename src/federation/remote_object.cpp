// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/federation/remote_object.hpp"

#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

RemoteObject::RemoteObject(const RemoteCopy& copy) noexcept : copy_(&copy), row_(&copy.entity()) {}

const pdu::EntityId& RemoteObject::id() const noexcept { return row_->id; }
const pdu::EntityType& RemoteObject::type() const noexcept { return row_->type; }
std::string_view RemoteObject::marking() const noexcept { return row_->marking.data(); }
pdu::ForceId RemoteObject::force_id() const noexcept { return row_->force_id; }
std::uint32_t RemoteObject::appearance() const noexcept { return row_->appearance; }
std::uint32_t RemoteObject::capabilities() const noexcept { return row_->capabilities; }
bool RemoteObject::is_frozen() const noexcept { return row_->frozen; }
deadreckon::Pose RemoteObject::shown(nanoseconds now) const noexcept { return copy_->shown(now); }
nanoseconds RemoteObject::age(nanoseconds now) const noexcept { return now - row_->last_heard; }
const deadreckon::ForceModel* RemoteObject::force_model() const noexcept {
  return row_->haptic ? &row_->model : nullptr;
}
std::uint64_t RemoteObject::updates() const noexcept { return row_->updates; }

}  // namespace reckon::peer
