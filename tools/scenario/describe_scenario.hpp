// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace scarp {

/// The reference of scenario keys as text of at most 110 columns: for each table its keys with type, unit, range,
/// default and one sentence.
/// @param key empty for everything; else a path ("bodies.volume", "bodies[].volume.depth", "materials.rock.cohesion":
///        any name stands for itself), or the end of one ("cohesion")
/// @throws Error ("describe") with a did-you-mean if no key is called so.
std::string describe_keys(const std::string& key);

/// Everything, as a Markdown page.
std::string describe_markdown();

}  // namespace scarp
