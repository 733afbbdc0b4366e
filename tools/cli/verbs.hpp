// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace scarp {

/// What the shell sees; a contract with the user's scripts.
enum class ExitCode { done = 0, wrong_request = 2, simulation_failed = 3, outside_tolerance = 4 };

/// Parses the arguments and does what they ask for. @throws Error for a wrong request.
ExitCode run_command_line(int argc, char** argv);

}  // namespace scarp
