// SPDX-License-Identifier: GPL-3.0-or-later
// What simpler models of the device cost, and how far off they are: links that stay in their planes, and a platform
// that is taken for a point.
#include "device_speed_error/measure_implementation.h"

namespace haptic_sculpt::benchmark {
namespace {

using namespace measure_details;
using Vector = Device_vector<double>;

/// One population, one form.
class Models {
public:
  Models(const Population& population, Device_form form, int repetitions, nlohmann::json& rows)
      : population_(population)
      , design_(named_design<double>(Named_design::D1, form))
      , parameters_(design_)
      , reference_(exact(design_), exact(design_))
      , repetitions_(repetitions)
      , rows_(rows) {
    for (const Vector& theta : population.theta)
      poses_.push_back(*forward_kinematics(parameters_, theta));
  }

  /// The joint torques of a motion, by a model. \param torque `torque(k)` in N m
  template <class Torque>
  void torques(const char* model, int checked, const Torque& torque) {
    Errors errors;
    for (int k = 0; k < checked; ++k) {
      const auto truth = state(k).torque;
      errors.values.push_back(relative_error(torque(k), truth, Exact(truth.norm())));
    }
    row("joint torques", model, errors, [&](int k) { return torque(k)[2]; });
  }

  /// Where the handle is, by a model. \param position `position(k)` in m
  template <class Position>
  void positions(const char* model, int checked, const Position& position) {
    Errors errors;
    for (int k = 0; k < checked; ++k)
      errors.values.push_back(relative_error(position(k), state(k).position, reference_.secondary_length()));
    row("position", model, errors, [&](int k) { return position(k)[2]; });
  }

  const Device_parameters<double>& parameters() const { return parameters_; }
  const Device_pose<double>& pose(int k) const { return poses_[static_cast<std::size_t>(k)]; }

private:
  const Population& population_;
  Device_description<double> design_;
  Device_parameters<double> parameters_;
  Reference reference_;
  int repetitions_;
  nlohmann::json& rows_;
  std::vector<Device_pose<double>> poses_;

  Reference::State state(int k) const {
    const auto i = static_cast<std::size_t>(k);
    return reference_.state(exact(population_.theta[i]), exact(population_.rate[i]),
                            exact(population_.acceleration[i]));
  }

  template <class Value>
  void row(const char* what, const char* model, Errors& errors, const Value& value) {
    const double time = nanoseconds_per_call(static_cast<int>(poses_.size()), repetitions_,
                                             [&](int k) { sink = value(k); });
    const nlohmann::json error = errors.summary();
    std::printf("%-8s %-14s %-24s %-32s %10.1f ns   off by %9.2g median %9.2g max\n", population_.name,
                name_of(design_.form), what, model, time, error["median"].get<double>(), error["max"].get<double>());
    rows_.push_back({{"form", name_of(design_.form)},
                     {"what", what},
                     {"model", model},
                     {"population", population_.name},
                     {"ns", time},
                     {"relative_error", error}});
  }
};

} // namespace

void measure_models(const Population& p, int checked, int repetitions, nlohmann::json& rows) {
  checked = std::min(checked, static_cast<int>(p.theta.size()));
  for (const Device_form form : {Device_form::ditetrahedral, Device_form::general}) {
    Models models(p, form, repetitions, rows);
    const auto& parameters = models.parameters();
    const auto rate = [&](int k) -> const Vector& { return p.rate[static_cast<std::size_t>(k)]; };
    const auto acceleration = [&](int k) -> const Vector& { return p.acceleration[static_cast<std::size_t>(k)]; };
    const auto theta = [&](int k) -> const Vector& { return p.theta[static_cast<std::size_t>(k)]; };
    models.torques("links in space", checked, [&](int k) -> Vector {
      return spatial_inverse_dynamics(parameters, models.pose(k), rate(k), acceleration(k))->torque;
    });
    models.torques("links in their planes", checked, [&](int k) -> Vector {
      return dynamics(parameters, Dynamics_model::planar, models.pose(k), rate(k))->torque(rate(k), acceleration(k));
    });
    if (form == Device_form::ditetrahedral)
      continue;
    // A platform that does not tilt is the di-tetrahedral mechanism with shoulders nearer to the axis by its radius.
    Device_description<double> point = parameters.description();
    point.form = Device_form::ditetrahedral;
    point.base_radius -= point.platform_radius;
    const Device_parameters<double> of_a_point(point);
    models.positions("a platform", checked, [&](int k) -> Vector {
      return general_forward(parameters, theta(k), models.pose(std::max(k - 1, 0)))->position;
    });
    models.positions("a point for the platform", checked,
                     [&](int k) -> Vector { return ditetrahedral_forward(of_a_point, theta(k), 1)->position; });
  }
}

} // namespace haptic_sculpt::benchmark
