// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <haptic_sculpt/collision/Impact_3.h>
#include <haptic_sculpt/sculpting/Drag_result.h>
#include <haptic_sculpt/sculpting/geometry/clearance.h>
#include <haptic_sculpt/sculpting/response/Slide_path.h>

#include <vector>

namespace haptic_sculpt::internal {

/// What a walk that comes from outside of the Sculptor asks of the guard and of the mesh. It names no type of a mesh,
/// for a Response knows none. Of the default responses, no call is virtual.
class Walk_ground {
public:
  using Vertex = std::uint32_t; ///< an index of the mesh
  using Face = std::array<Vertex, 3>;
  static constexpr Vertex none = std::numeric_limits<Vertex>::max();

  /// The face that the moving vertex was stopped at, where on it, and on which side of it that vertex is.
  struct Stop {
    Face face;
    Triangle_location location;
    int side;
  };

  /// One leg, proven free as far as it goes. What stopped the last one is what the drag reports.
  virtual Coordinates leg(const Coordinates& source, const Coordinates& target) = 0;
  /// Of the last leg; nothing where no vertex met a face.
  virtual std::optional<Stop> stop() const = 0;
  virtual bool is_spent() const = 0;

  virtual Vertex moving() const = 0; ///< none for a probe
  virtual Coordinates point(Vertex v) const = 0;
  /// The faces at v, written anew; v is the first corner of each.
  virtual void find_faces(Vertex v, std::vector<Face>& faces) const = 0;

protected:
  ~Walk_ground() = default;
};

/// A walk from outside of the Sculptor, made once for each hand.
class Other_walk {
public:
  virtual ~Other_walk() = default;

  /// What it carries from drag to drag no longer holds.
  virtual void forget() = 0;
  /// Walks from source towards target, no farther from it than that is. Returns why it ends.
  virtual Drag_end move(Walk_ground& ground, const Coordinates& source, const Coordinates& target,
                        const Clearance_rule& clearances) = 0;

  const Coordinates& place() const { return place_; } ///< where the last move ended
  const Slide_path& path() const { return path_; }    ///< the way there

protected:
  Coordinates place_{};
  Slide_path path_;
};

} // namespace haptic_sculpt::internal
