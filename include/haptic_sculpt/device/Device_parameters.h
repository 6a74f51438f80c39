// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/Error.h>
#include <haptic_sculpt/device/leg_frame.h>
#include <limits>
#include <string>
#include <vector>

namespace haptic_sculpt {

/// The two mechanisms of the paper (its Fig. 2 and Fig. 3).
enum class Device_form {
  ditetrahedral, ///< the three secondary links meet in one spherical joint: a point with three translations
  general        ///< each secondary link ends in a revolute joint on a platform: a translation and two tilts
};

/// "ditetrahedral" or "general".
inline const char* name_of(Device_form form) { return form == Device_form::general ? "general" : "ditetrahedral"; }

/// What a builder of the device writes down. SI units, radians. The defaults are design D1 of the reference designs.
/// Plain and mutable; `Device_parameters` is what the computations take, and it is checked.
template <class S = double> struct Device_description {
  Device_form form = Device_form::ditetrahedral; ///< which of the two mechanisms
  S base_radius = S(30) / S(1000);       ///< R, shoulders' distance from the axis, m
  S primary_length = S(70) / S(1000);    ///< l1, shoulder to elbow, m
  S secondary_length = S(100) / S(1000); ///< l2, elbow to platform joint, m
  S platform_radius =
      S(20) / S(1000); ///< r, platform joints' distance from its centre, m; unused by the di-tetrahedral form
  S primary_mass = S(4) / S(1000);       ///< m1, each primary link (slender rod), kg
  S secondary_mass = S(4) / S(1000);     ///< m2, each secondary link (slender rod), kg
  S platform_mass = S(20) / S(1000);     ///< M, platform or, di-tetrahedral, whatever sits at the apex, kg
  Device_vector<S> platform_inertia =
      disc_inertia(S(20) / S(1000), S(20) / S(1000)); ///< about the platform's axes, kg m^2
  S rotor_inertia = S(0);                ///< of one motor, reflected to its joint, kg m^2
  S gravity = S(981) / S(100);           ///< along -z, m/s^2
  S torque_limit = S(1) / S(5);          ///< of one joint, N m
  S viscous_friction = S(0);             ///< of one joint, N m s/rad
  S coulomb_friction = S(0);             ///< of one joint, N m; see joint_friction()
  S encoder_step = S(0);                 ///< the least joint angle an encoder tells, rad; 0: it tells every angle
  Device_vector<S> least_angle = Device_vector<S>::Constant(S(-0.5));   ///< joint limits, rad
  Device_vector<S> greatest_angle = Device_vector<S>::Constant(S(2.5)); ///< rad; each above its `least_angle`

  /// A thin disc's moments of inertia about its diameters and its axis: (M r^2/4, M r^2/4, M r^2/2).
  /// (The scan of the paper reads as if all three were M r^2/4.)
  static Device_vector<S> disc_inertia(const S& mass, const S& radius) {
    const S quarter = mass * radius * radius / S(4);
    return Device_vector<S>(quarter, quarter, S(2) * quarter);
  }
};

/// Thrown when a description is not that of a device; `violations()` has one sentence for each thing that is wrong.
class Invalid_device_parameters : public Error {
public:
  /// \param violations one sentence each; `what()` joins them
  explicit Invalid_device_parameters(std::vector<std::string> violations)
      : Error(joined(violations)), violations_(std::move(violations)) {}
  /// One sentence for each thing that is wrong.
  const std::vector<std::string>& violations() const {
    return violations_;
  }

private:
  static std::string joined(const std::vector<std::string>& violations) {
    std::string text = "The device description cannot be used:";
    for (const std::string& violation : violations)
      text += " " + violation + ";";
    text.back() = '.';
    return text;
  }
  std::vector<std::string> violations_;
};

namespace internal {

/// Relative, of the sum of two moments of inertia: a disc's sum is its third moment, so its rounded moments may miss it
/// by a few units in the last place; of a double, where a wider type was given them as such.
template <class S> S rounding_of_moments() {
  const S own(std::numeric_limits<S>::epsilon()), of_double(std::numeric_limits<double>::epsilon());
  return S(16) * (own < of_double ? of_double : own);
}

} // namespace internal

/// Everything that is wrong with a description, one sentence each; empty if it can be used.
///
/// The kinematics forms products of four lengths squared, so eighth powers have to fit in the scalar's range, with
/// room: no length, mass, moment or friction above 1.7e38 for double, 3.2e4 for float, and no length in use below
/// 7e-39, 3.7e-5 for float.
template <class S> std::vector<std::string> violations(const Device_description<S>& d) {
  using internal::is_finite;
  using std::abs;
  using std::sqrt;
  std::vector<std::string> found;
  const S largest = sqrt(sqrt(sqrt(std::numeric_limits<S>::max()))) / S(2);
  const S smallest = sqrt(sqrt(sqrt(std::numeric_limits<S>::min()))) * S(2);
  auto finite = [&](const S& value, const char* name) {
    if (!is_finite(value))
      found.push_back(std::string(name) + " is not a finite number");
    else if (abs(value) > largest)
      found.push_back(std::string(name) + " is too large for this number type");
    else
      return true;
    return false;
  };
  auto length = [&](const S& value, const char* name) {
    if (finite(value, name) && !(value >= smallest))
      found.push_back(std::string(name) + (value > S(0) ? " is too small for this number type" : " must be positive"));
  };
  auto not_negative = [&](const S& value, const char* name) {
    if (finite(value, name) && value < S(0))
      found.push_back(std::string(name) + " must not be negative");
  };
  length(d.base_radius, "base_radius (R)");
  length(d.primary_length, "primary_length (l1)");
  length(d.secondary_length, "secondary_length (l2)");
  if (d.form == Device_form::general)
    length(d.platform_radius, "platform_radius (r)");
  else
    not_negative(d.platform_radius, "platform_radius (r)");
  not_negative(d.primary_mass, "primary_mass (m1)");
  not_negative(d.secondary_mass, "secondary_mass (m2)");
  not_negative(d.platform_mass, "platform_mass (M)");
  not_negative(d.rotor_inertia, "rotor_inertia (Jm)");
  finite(d.gravity, "gravity (g)");
  if (!(d.torque_limit > S(0)))
    found.push_back("torque_limit must be positive");
  not_negative(d.viscous_friction, "viscous_friction (friction)");
  not_negative(d.coulomb_friction, "coulomb_friction (coulomb)");
  not_negative(d.encoder_step, "encoder_step");
  bool inertia_is_sound = true;
  const char* const moments[] = {"platform_inertia (I) about x", "platform_inertia (I) about y",
                                 "platform_inertia (I) about z"};
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t before = found.size();
    not_negative(d.platform_inertia[axis], moments[axis]);
    inertia_is_sound = inertia_is_sound && found.size() == before;
  }
  if (inertia_is_sound)
    for (int axis = 0; axis < 3; ++axis) {
      const S others = d.platform_inertia.sum() - d.platform_inertia[axis];
      if (d.platform_inertia[axis] > others * (S(1) + internal::rounding_of_moments<S>()))
        found.push_back(moments[axis] + std::string(" exceeds the sum of the two others, as it does of no body"));
    }
  for (int leg = 0; leg < 3; ++leg)
    if (!is_finite(d.least_angle[leg]) || !is_finite(d.greatest_angle[leg]) ||
        !(d.least_angle[leg] < d.greatest_angle[leg]))
      found.push_back("the joint limits of leg " + std::to_string(leg) + " are not a finite, non-empty interval");
  return found;
}

/// A checked, constant description with what is computed from it once.
template <class S = double> class Device_parameters {
public:
  using Scalar = S; ///< of every length, mass and angle

  /// \throw Invalid_device_parameters listing every violation
  explicit Device_parameters(const Device_description<S>& description) : d_(description) {
    std::vector<std::string> found = violations(description);
    if (!found.empty())
      throw Invalid_device_parameters(std::move(found));
    mirror_ = d_.form == Device_form::general && d_.base_radius == d_.platform_radius &&
              d_.primary_length == d_.secondary_length;
    const S ratio = d_.platform_radius / d_.secondary_length;
    closure_linear_ = S(3) * ratio;
    closure_constant_ = S(3) * ratio * ratio + S(2);
    inverse_secondary_length_ = S(1) / d_.secondary_length;
    inverse_secondary_length_squared_ = inverse_secondary_length_ * inverse_secondary_length_;
  }

  const Device_description<S>& description() const { return d_; }                  ///< As given; it has no violations.
  Device_form form() const { return d_.form; }                                     ///< Which of the two mechanisms.
  const S& base_radius() const { return d_.base_radius; }                          ///< R, m; positive.
  const S& primary_length() const { return d_.primary_length; }                    ///< l1, m; positive.
  const S& secondary_length() const { return d_.secondary_length; }                ///< l2, m; positive.
  const S& platform_radius() const { return d_.platform_radius; } ///< r, m; the di-tetrahedral form does not use it.
  const S& primary_mass() const { return d_.primary_mass; }       ///< m1, of each primary link, kg; not negative.
  const S& secondary_mass() const { return d_.secondary_mass; }   ///< m2, of each secondary link, kg; not negative.
  const S& platform_mass() const { return d_.platform_mass; }                      ///< M, kg; not negative.
  /// About the platform's axes, kg m^2.
  const Device_vector<S>& platform_inertia() const {
    return d_.platform_inertia;
  }
  const S& rotor_inertia() const { return d_.rotor_inertia; } ///< Of one motor, reflected to its joint, kg m^2.
  const S& gravity() const { return d_.gravity; }                                  ///< Along -z, m/s^2; of either sign.
  const S& torque_limit() const { return d_.torque_limit; }                        ///< Of one joint, N m; positive.
  const S& viscous_friction() const { return d_.viscous_friction; } ///< Of one joint, N m s/rad; not negative.
  const S& coulomb_friction() const { return d_.coulomb_friction; }                ///< Of one joint, N m; not negative.
  const S& encoder_step() const { return d_.encoder_step; } ///< Rad; 0 where encoders tell every angle.
  const Device_vector<S>& least_angle() const { return d_.least_angle; }           ///< The lower joint limits, rad.
  const Device_vector<S>& greatest_angle() const { return d_.greatest_angle; }     ///< The upper joint limits, rad.

  /// The mirror case R = r, l1 = l2 of the general form, exactly: base and platform are images in the elbow plane.
  bool is_mirror() const { return mirror_; }
  /// The coefficient a = 3 r/l2 of the three closure equations, see platform_closure.h.
  const S& closure_linear() const { return closure_linear_; }
  const S& closure_constant() const { return closure_constant_; } ///< Their b = 3 r^2/l2^2 + 2.
  const S& inverse_secondary_length() const { return inverse_secondary_length_; }                 ///< 1/l2, 1/m.
  const S& inverse_secondary_length_squared() const { return inverse_secondary_length_squared_; } ///< 1/l2^2, 1/m^2.

private:
  Device_description<S> d_;
  bool mirror_ = false;
  S closure_linear_, closure_constant_, inverse_secondary_length_, inverse_secondary_length_squared_;
};

/// The reference designs. Moving parts under the paper's 50 g, joint torque 0.2 N m.
enum class Named_design {
  D1, ///< R 30, l1 70, l2 100, r 20 mm: the default
  D2, ///< R 30, l1 = l2 = 80, r 15 mm
  D3  ///< R = r = 30, l1 = l2 = 80 mm: the mirror case
};

/// "D1", "D2" or "D3".
inline const char* name_of(Named_design design) {
  constexpr const char* names[] = {"D1", "D2", "D3"};
  return names[static_cast<int>(design)];
}

/// The description of a reference design in the wanted form.
template <class S = double> Device_description<S> named_design(Named_design design, Device_form form) {
  Device_description<S> d;
  d.form = form;
  if (design != Named_design::D1) {
    d.primary_length = d.secondary_length = S(80) / S(1000);
    d.platform_radius = S(design == Named_design::D2 ? 15 : 30) / S(1000);
  }
  d.platform_inertia = Device_description<S>::disc_inertia(d.platform_mass, d.platform_radius);
  return d;
}

} // namespace haptic_sculpt
