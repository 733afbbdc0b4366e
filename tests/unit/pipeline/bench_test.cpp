// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/pipeline/bench.hpp"

#include <gtest/gtest.h>

namespace scarp {
namespace {

/// Whether a kernel was vectorised at all shows in its speed alone: a compiler that gives up says nothing. The ratio is
/// about 17 with AVX-512, 8 with AVX2 and 5 with SSE.
TEST(Bench, KernelsLeaveTheTextbookBehind) {
  BenchOptions options;
  options.particles = 30'000;
  options.steps = 12;
  options.only = "TL Hencky";
  const BenchReport report = bench(options);
  ASSERT_EQ(report.rows.size(), 1u);
  EXPECT_GT(report.rows[0].ratio, 2.5);
  EXPECT_NE(bench_json(report).find("\"case\": \"TL Hencky\""), std::string::npos);
}

}  // namespace
}  // namespace scarp
