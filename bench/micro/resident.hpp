// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Memory of this process, for benchmark rows.
#pragma once

#include <unistd.h>

#include <fstream>

namespace reckon::bench {

/// Resident memory of this process [octets], in whole pages.
inline double resident() {
  std::ifstream file("/proc/self/statm");
  double all = 0, pages = 0;
  file >> all >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace reckon::bench
