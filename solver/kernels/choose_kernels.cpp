// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/kernels/choose_kernels.hpp"

#include <string>

#include "solver/model/error.hpp"

namespace scarp::kernels {
#if defined(__x86_64__)
namespace x86_64_v2 {
Kernels kernels(const char* name);
}
namespace x86_64_v3 {
Kernels kernels(const char* name);
}
namespace x86_64_v4 {
Kernels kernels(const char* name);
}
#else
namespace generic {
Kernels kernels(const char* name);
}
#endif

const std::vector<Kernels>& available_kernels() {
  static const std::vector<Kernels> available = [] {
    std::vector<Kernels> found;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("x86-64-v4")) found.push_back(x86_64_v4::kernels("x86-64-v4"));
    if (__builtin_cpu_supports("x86-64-v3")) found.push_back(x86_64_v3::kernels("x86-64-v3"));
    found.push_back(x86_64_v2::kernels("x86-64-v2"));
#else
    found.push_back(generic::kernels("generic"));
#endif
    return found;
  }();
  return available;
}

const Kernels& best_kernels() { return available_kernels().front(); }

const Kernels& kernels_named(std::string_view name) {
  std::string names;
  for (const Kernels& kernels : available_kernels()) {
    if (kernels.name == name) return kernels;
    names += (names.empty() ? "" : ", ") + std::string(kernels.name);
  }
  throw Error("solve", "instruction set", std::string(name), names);
}

}  // namespace scarp::kernels
