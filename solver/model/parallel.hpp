// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace scarp {

/// Calls run(task, begin, end) for parts of [0, count), one for each of up to `threads` threads; the caller's is one of
/// them. Those that wait sleep, so that a busy machine costs nothing. What a part throws reaches the caller.
void run_parts(std::size_t count, int threads, const void* task,
               void (*run)(const void* task, std::size_t begin, std::size_t end));

/// Calls f(i) for i in [0, count) on up to `threads` threads. Each call must write only what belongs to i;
/// then the result has the same bits for any number of threads.
template <class F>
void parallel_for(std::size_t count, int threads, F&& f) {
  if (threads <= 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) f(i);
    return;
  }
  using Task = std::remove_reference_t<F>;
  const auto run = [](const void* task, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) (*static_cast<Task*>(const_cast<void*>(task)))(i);
  };
  run_parts(count, threads, std::addressof(f), run);
}

/// Fixed blocks for reductions: the sum over a block is serial, and blocks are added in order, whatever the
/// number of threads.
inline constexpr std::size_t kReductionBlock = 4096;

}  // namespace scarp
