// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <exception>
#include <new>

#include "solver/model/error.hpp"
#include "tools/cli/verbs.hpp"

int main(int argc, char** argv) {
  using scarp::ExitCode;
  const auto fail = [](const char* text) {
    std::fprintf(stderr, "scarp: error: %s\n", text);
    return static_cast<int>(ExitCode::wrong_request);
  };
  try {
    return static_cast<int>(scarp::run_command_line(argc, argv));
  } catch (const scarp::Error& error) {
    return fail(error.what());
  } catch (const std::bad_alloc&) {
    return fail("out of memory; use larger cells, thin the scan, or a machine with more memory");
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}
