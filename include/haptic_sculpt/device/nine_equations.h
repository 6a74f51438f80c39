// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/device/Device_pose.h>

namespace haptic_sculpt {

/// The paper's nine equations, literally, as residuals in units of l2^2: what every pose is checked by.
///
/// EQ(1) |P_i - B_i|^2 - l2^2; EQ(2) |P_i - P_j|^2 - 3 r^2; EQ(3) (P_i - B_i).(P_j - P_k), i, j, k distinct.
/// In the di-tetrahedral form r counts as 0.
template <class S>
Eigen::Matrix<S, 9, 1> nine_equation_residual(const Device_parameters<S>& parameters, const Device_matrix<S>& elbows,
                                              const Device_matrix<S>& joints) {
  const S l2 = parameters.secondary_length();
  const S r = parameters.form() == Device_form::general ? parameters.platform_radius() : S(0);
  Eigen::Matrix<S, 9, 1> residual;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Device_vector<S> link = joints.col(i) - elbows.col(i), side = joints.col(j) - joints.col(k);
    residual[i] = link.squaredNorm() - l2 * l2;
    residual[3 + i] = side.squaredNorm() - S(3) * r * r;
    residual[6 + i] = link.dot(side);
  }
  return residual / (l2 * l2);
}

} // namespace haptic_sculpt
