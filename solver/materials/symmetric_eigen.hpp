// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "solver/model/math.hpp"

namespace scarp {

/// A = sum of values[k] n_k n_k^T, with n_k = (vectors[k], vectors[3 + k], vectors[6 + k]); in no order.
struct SymmetricEigen {
  Vec3 values;
  Mat3 vectors;
};

/// Eigenvalues and orthonormal eigenvectors of a symmetric 3 x 3 tensor, to a few units in the last place of its
/// largest entry, also where eigenvalues are equal or nearly so (a soil at rest, or at an edge of its yield
/// surface). Our own, because Eigen's direct solver loses half the digits there, and because its iterative one, like
/// cyclic Jacobi rotations, takes two to three times as long.
///
/// The deviator's characteristic cubic has one root that stands well apart from the two others; its eigenvector is
/// a cross product without cancellation. In the plane across it one rotation diagonalises the rest, which no
/// gap between the two enters. Tensors with yz = xz = 0 need that rotation only.
SymmetricEigen symmetric_eigen(const Sym6& A);

}  // namespace scarp
