// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/tracks/hand_trace_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "reckon/tests/haptics/support/hand_trace_kink.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer {
namespace {

using Eigen::Vector3d;

std::string write(const test::ScratchFolder& folder, const std::string& text) {
  const std::string path = folder.file("trace.csv");
  std::ofstream(path) << text;
  return path;
}

std::string error_of(const std::string& text) {
  const test::ScratchFolder folder;
  try {
    (void)read_hand_trace(write(folder, text));
  } catch (const CsvError& error) {
    return error.what();
  }
  return "";
}

TEST(HandTraceFile, ReadsColumnsInAnyOrderAndIgnoresOthers) {
  const test::ScratchFolder folder;
  const std::string file =
      write(folder, "pz_m, fx_N ,t_s,py_m,px_m\r\n3,9,10,2,1\r\n6,9,10.5,5,4\r\n");
  const haptics::HandTrace trace = read_hand_trace(file);
  EXPECT_LE((trace.at(0).position - Vector3d(1, 2, 3)).norm(), 1e-15);
  EXPECT_LE((trace.at(0.25).position - Vector3d(2.5, 3.5, 4.5)).norm(), 1e-12);
  EXPECT_LE((trace.at(0.25).velocity - Vector3d(6, 6, 6)).norm(), 1e-12);
}

TEST(HandTraceFile, ErrorsNameFileAndLine) {
  const std::string head = "t_s,px_m,py_m,pz_m\n";
  EXPECT_NE(error_of("t_s,px_m,py_m\n0,0,0\n").find(".csv:1:1: no column pz_m"), std::string::npos);
  EXPECT_NE(error_of(head + "0,0,0,0\n1,0,x,0\n").find(".csv:3:5: py_m 'x' is not"),
            std::string::npos);
  EXPECT_NE(error_of(head + "0,0,0,0\n1,nan,0,0\n").find(".csv:3:3: px_m 'nan'"),
            std::string::npos);
  EXPECT_NE(error_of(head + "0,0,0,0\n0,0,0,0\n").find("does not increase"), std::string::npos);
  EXPECT_NE(error_of(head + "0,0\n").find("2 cells, but the header has 4"), std::string::npos);
  EXPECT_NE(error_of(head).find("no samples"), std::string::npos);
  EXPECT_NE(error_of("").find("empty"), std::string::npos);
  EXPECT_THROW((void)read_hand_trace("/nonexistent/trace.csv"), CsvError);
}

TEST(HandTraceFile, MakesASmoothHandFromRecordedHands) {
  for (const char* name : {"wiping-fender-0.csv", "wiping-rim-0.csv", "wiping-rim-3.csv"}) {
    RECKON_NEED_DATA(std::string("haptic-traces/") + name);
    haptics::HandTraceOptions options;
    options.fit_to = Eigen::AlignedBox3d(Vector3d::Constant(-0.05), Vector3d::Constant(0.05));
    const haptics::HandTrace trace =
        read_hand_trace(test::reference_data() / "haptic-traces" / name, options);
    EXPECT_GT(trace.duration(), 9.0);
    EXPECT_LT(test::kink(trace, trace.duration()), 2e-3) << name;
  }
}

}  // namespace
}  // namespace reckon::peer
