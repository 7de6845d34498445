# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Faults to plant in the leaders of cells: name, file of aoim, text that is there once, text in its stead."""

PLANTS = [
    ("neither of two leaders gives way", "leader/cell_leadership.cpp",
     "    if (older) return follow(cell, claimed, now);\n", ""),
    ("newcomer does not listen", "leader/cell_leadership.cpp",
     ": cell.since + config_.listen;", ": cell.since + config_.listen / 100;"),
    ("dead leader waited for", "leader/cell_leadership.cpp",
     "  const nanoseconds silent = led ? cell.leader.heard + patience()", "  const nanoseconds silent = led ? cell.leader.heard + 3 * patience()"),
    ("first leader though there is a map", "leader/leader_role.cpp",
     "heard_mapped_ |= (role.flags & pdu::kRoleMapped) != 0;", ";"),
    ("snapshot without the leader's own", "area_of_interest_manager.cpp",
     "  if (leader_) note_state(group, state);\n", ""),
    ("strangers may lead", "area_of_interest_leaders.cpp",
     "  if (presence_.standing(sender, &from) != Standing::member) return;\n  const auto decodes", "  const auto decodes"),
    ("impostors may lead", "area_of_interest_manager.cpp",
     "  if (leader_ && incoming.verdict == IncomingVerdict::use) {\n    take_from_leaders(group, datagram, trailer->epoch, from, now);",
     "  if (leader_ && trailer) {\n    take_from_leaders(group, datagram, trailer->epoch, {}, now);"),
    ("owners tell newcomers too", "area_of_interest_manager.cpp",
     "        introduce_ = introduce_ || !leader_;  // it asks the leaders of its cells\n", "        introduce_ = true;\n"),
    ("leader speaks seldom", "leader/cell_leadership.cpp",
     "(leads ? config_.heartbeat : config_.member_beat)", "(leads ? 6 * config_.heartbeat : config_.member_beat)"),
    ("snapshot never begins", "leader/snapshot_server.cpp",
     "    snapshot.asked = true;\n", ""),
    ("one group for two cells", "leader/group_pool.cpp",
     "    if (slot.used || (!slot.fresh", "    if ((!slot.fresh"),
    ("map said once", "leader/leader_role.cpp",
     "  next_map_ = now + config_.refresh;", "  next_map_ = now + 1000 * config_.refresh;"),
    ("states told as the leader's own", "leader/snapshot_server.cpp",
     "const pdu::SnapshotState state{entry->epoch,", "const pdu::SnapshotState state{snapshot.serial,"),
]
