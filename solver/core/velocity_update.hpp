// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace scarp {

/// v_p <- kept v_p + sum_I phi_Ip (v~_I - less v_I + v*_I), the last where there are filtered velocities (xpic.hpp).
/// FLIP keeps all, PIC nothing, a blend the same share of both.
struct VelocityUpdate {
  double kept = 1;
  double less = 1;
};

}  // namespace scarp
