// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>

#include "solver/model/error.hpp"
#include "tools/cli/verbs.hpp"

namespace {

/// A file that is opened while 0, 1 or 2 is closed gets that number, and progress would be written into it.
void open_standard_streams() {
  for (int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) == -1 && open("/dev/null", O_RDWR) != descriptor) std::abort();
}

}  // namespace

int main(int argc, char** argv) {
  using scarp::ExitCode;
  const auto fail = [](const char* text) {
    std::fprintf(stderr, "scarp: error: %s\n", text);
    return static_cast<int>(ExitCode::wrong_request);
  };
  try {
    open_standard_streams();
    const int code = static_cast<int>(scarp::run_command_line(argc, argv));
    // What was asked for must not get lost in silence, on a full disk for example.
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) return fail("cannot write to standard output");
    return code;
  } catch (const scarp::Error& error) {
    return fail(error.what());
  } catch (const std::bad_alloc&) {
    return fail("out of memory; use larger cells, thin the scan, or a machine with more memory");
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(error.path1().empty() ? error.what()
                                      : (error.path1().string() + ": " + error.code().message()).c_str());
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}
