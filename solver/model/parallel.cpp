// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/model/parallel.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <mutex>

namespace scarp {
namespace {

constexpr int kMostThreads = 1024;

tbb::task_arena& team_of(int threads) {
  // As many threads as asked for, be there processors for them or not: otherwise a test on few processors could not see
  // that results do not depend on their number.
  static const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, kMostThreads);
  static std::mutex mutex;
  static std::map<int, tbb::task_arena> teams;
  const std::lock_guard lock(mutex);
  return teams.try_emplace(threads, threads).first->second;
}

}  // namespace

void run_parts(std::size_t count, int threads, const void* task,
               void (*run)(const void* task, std::size_t begin, std::size_t end)) {
  threads = std::min(threads, kMostThreads);
  const auto parts = static_cast<std::size_t>(threads);
  const auto part = [&](std::size_t i) { run(task, count * i / parts, count * (i + 1) / parts); };
  team_of(threads).execute([&] { tbb::parallel_for(std::size_t{0}, parts, part, tbb::static_partitioner{}); });
}

}  // namespace scarp
