# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Faults to plant: name, file of aoim, text that is there once, text in its stead."""

PLANTS = [
    ("duplicate accepted", "sequence_tracker.cpp",
     "  if ((word & bit) != 0) {", "  if (false && (word & bit) != 0) {"),
    ("late one stays lost", "sequence_tracker.cpp",
     "    --counts_.lost;", "    ;"),
    ("gap counted one too long", "sequence_tracker.cpp",
     "counts_.lost += ahead - 1;", "counts_.lost += ahead;"),
    ("window of the last word only", "sequence_tracker.cpp",
     "track.seen[behind / 64]", "track.seen[0]"),
    ("sender of another group mistaken", "sequence_tracker.cpp",
     "track.group == group; });", "track.group > group; });"),
    ("departed sender not forgotten", "sequence_tracker.cpp",
     "track.epoch == epoch; });", "track.epoch == 0 * epoch; });"),
    ("introduction never due", "introduction.cpp",
     "return concerns && !heard && now >= moment(entity, window);", "return concerns && !heard && now > moment(entity, window) + config_.memory;"),
    ("introduction only to one group", "introduction.cpp",
     "const bool concerns = window.group == kBaseGroup || window.group == group;", "const bool concerns = window.group == group;"),
    ("second newcomer in a round not introduced", "introduction.cpp",
     "  windows_.push_back({group, now, round_});", "  if (windows_.empty()) windows_.push_back({group, now, round_});"),
    ("left group not forgotten", "area_of_interest_manager.cpp",
     "  for (const GroupIndex group : change.leave) sequences_.forget(group);\n  for (const GroupIndex group : change.join) {\n    sequences_.forget(group);",
     "  for (const GroupIndex group : change.join) {"),
    ("joined cells not told", "area_of_interest_manager.cpp",
     "    joined_cells_.insert(joined_cells_.end(), octets.begin(), octets.end());", "    ;"),
    ("cell left too early", "subscription.cpp",
     "if (entry.reach <= 1.0 || stay)", "if (entry.reach <= 0.6)"),
]
