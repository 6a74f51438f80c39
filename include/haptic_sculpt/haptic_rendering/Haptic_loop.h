// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/haptic_rendering/loop/Interaction_loop.h>
#include <haptic_sculpt/haptic_rendering/check_coupling.h>
#include <haptic_sculpt/surface/broad_phase/face_box.h>

namespace haptic_sculpt {

/// A loop on a device of joints: at each tick joint angles in, torques out.
template <class Sculptor_>
class Haptic_loop : public Interaction_loop<Sculptor_, Joint_side> {
public:
  using Base = Interaction_loop<Sculptor_, Joint_side>; ///< what all loops do
  using Vertex_index = typename Base::Vertex_index;     ///< of the mesh that is sculpted

  /// \param start a pose near the first reading, in the assembly mode of home_pose(), whose limits are asked for
  /// \param limits made for this device, map, tick, delay, damping and fading (passivity_limits)
  /// \throw Unstable_coupling if they do not permit the coupling, the virtual mass or the passivity controller; Error
  /// for parameters that cannot be used, and for limits that were made for others
  Haptic_loop(Sculptor_& sculptor, const Device_parameters<double>& device, const Device_pose<double>& start,
              const Workspace_map& map, const Haptic_parameters& parameters, const Passivity_limits& limits)
      : Haptic_loop(sculptor, device, start, map, parameters, limits, Rounding()) {}
  /// Makes the limits by itself, for the box of the mesh as it is and a tenth beyond. Some tenths of a second.
  Haptic_loop(Sculptor_& sculptor, const Device_parameters<double>& device, const Device_pose<double>& start,
              const Workspace_map& map, const Haptic_parameters& parameters)
      : Haptic_loop(sculptor, device, start, map, parameters, Rounding()) {}

  const Handle_motion& handle() const { return this->interaction().side().handle(); } ///< in the last tick

private:
  using Rounding = internal::Rounding_to_nearest; // lives while the loop is made

  Haptic_loop(Sculptor_& sculptor, const Device_parameters<double>& device, const Device_pose<double>& start,
              const Workspace_map& map, const Haptic_parameters& parameters, const Passivity_limits& limits,
              const Rounding& /*rounding*/)
      : Base(sculptor, Joint_side(device, start, parameters), map, parameters, limits.default_controller()) {
    check_limits(limits, device, map, parameters);
  }
  Haptic_loop(Sculptor_& sculptor, const Device_parameters<double>& device, const Device_pose<double>& start,
              const Workspace_map& map, const Haptic_parameters& parameters, const Rounding& rounding)
      : Haptic_loop(sculptor, device, start, map, parameters, limits_of(sculptor, device, map, parameters), rounding) {
  }

  static Passivity_limits limits_of(const Sculptor_& sculptor,
                                    const Device_parameters<double>& device, const Workspace_map& map,
                                    const Haptic_parameters& parameters) {
    parameters.check();
    const Box_3 box = internal::mesh_box(sculptor.mesh());
    const Eigen::Vector3d lower(box.lower.data()), upper(box.upper.data());
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.1 * (upper - lower).stableNorm());
    return passivity_limits(device, parameters.limits, map, lower - margin, upper + margin, parameters.coupling.damping,
                            parameters.tick, parameters.delay, parameters.virtual_mass.cutoff);
  }
};

} // namespace haptic_sculpt
