// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/kernels/choose_kernels.hpp"

namespace scarp {

struct BenchOptions {
  std::int64_t particles = 1'000'000;
  int steps = 12;  ///< timed, after one that is not; the fastest counts
  std::vector<int> threads{1};
  std::vector<const kernels::Kernels*> kernels{&kernels::best_kernels()};
  std::string only;  ///< cases whose name holds this text; empty: all
};

/// One case on one instruction set and number of threads: minima over the steps.
struct BenchRow {
  std::string name;
  std::string kernels;
  int threads = 1;
  std::int64_t particles = 0;
  double processor_ns = 0;     ///< per particle-step, all threads together
  double wall_ns = 0;          ///< per particle-step
  double ratio = 0;            ///< textbook's processor time over this one's; 0: none
  std::string reference;       ///< which textbook case
  double share_of_peak = 0;    ///< of the multiply-add peak of the same kernels; 0: flops not counted
  double share_of_stream = 0;  ///< of the memory stream, for the bytes that the case must move; 0: not counted
};

/// What contact adds to a step: minima over the steps, processor ns per particle-step.
struct ContactCost {
  std::string name;
  std::string kernels;
  int threads = 1;
  std::int64_t particles = 0;
  double with_ns = 0, without_ns = 0;
};

struct BenchReport {
  std::vector<BenchRow> rows;
  std::vector<ContactCost> contact;
  std::vector<std::pair<std::string, double>> peak_gflops;  ///< per instruction set, one thread
  double stream_gb_per_s = 0;                               ///< read and written in place, one thread
  double textbook_total_ns = 0, textbook_total_2d_ns = 0, textbook_updated_ns = 0;
};

/// Times the steps of blocks of a million points, say, against the method as a textbook writes it (tests/bench), all in
/// one run: only ratios mean something on a machine that others use too.
BenchReport bench(const BenchOptions& options);

/// The same as JSON.
std::string bench_json(const BenchReport& report);

}  // namespace scarp
