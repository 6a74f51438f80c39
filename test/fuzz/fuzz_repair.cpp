// SPDX-License-Identifier: GPL-3.0-or-later

/// \file
/// Whatever soup of faces repair() is given: it ends, with a valid surface, or with a report of what is left and the
/// soup as it was. The bytes of the input are choices.

#include <fuzz/Choices.h>
#include <fuzz/Fuzz_target.h>
#include <fuzz/require.h>
#include <fuzz/tiny_scenes.h>

#include <haptic_sculpt/surface/repair.h>

namespace {

using namespace haptic_sculpt;
using fuzz::require;

std::size_t untouched = 0, repaired = 0, left = 0, refused = 0;

Face_soup soup_of(const meshes::Triangle_list& list, double unit) {
  Face_soup soup;
  for (const auto& p : list.points)
    soup.points.emplace_back(p.x() * unit, p.y() * unit, p.z() * unit);
  for (const auto& f : list.faces) {
    soup.corners.insert(soup.corners.end(), f.begin(), f.end());
    soup.close_face();
  }
  return soup;
}

/// A face of 4 to 7 corners of its own, at small whole numbers: many are on a line, or sides cross.
void add_polygon(Face_soup& soup, double unit, fuzz::Choices& choices) {
  for (std::size_t corners = 4 + choices.below(4); corners > 0; --corners) {
    const auto whole = [&] { return (static_cast<double>(choices.below(13)) - 6) * unit; };
    const double x = whole(), y = whole(), z = whole();
    soup.corners.push_back(static_cast<Face_soup::Index>(soup.points.size()));
    soup.points.emplace_back(x, y, z);
  }
  soup.close_face();
}

/// The corners of the faces, to be changed.
std::vector<std::vector<Face_soup::Index>> faces_of(const Face_soup& soup) {
  std::vector<std::vector<Face_soup::Index>> faces;
  for (Face_soup::Index f = 0; f < soup.number_of_faces(); ++f)
    faces.emplace_back(soup.begin(f), soup.begin(f) + soup.number_of_corners(f));
  return faces;
}

void damage(Face_soup& soup, double unit, fuzz::Choices& choices) {
  auto faces = faces_of(soup);
  for (std::size_t n = choices.below(8); n > 0 && !faces.empty(); --n) {
    const std::size_t f = choices.below(faces.size()), p = choices.below(soup.points.size());
    auto& face = faces[f];
    switch (choices.below(10)) {
    case 0: // a hole
      faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(f));
      break;
    case 1: // turned
      std::reverse(face.begin(), face.end());
      break;
    case 2: // doubled
      faces.push_back(std::vector<Face_soup::Index>(face));
      break;
    case 3: // another corner
      if (!face.empty())
        face[choices.below(face.size())] = p;
      break;
    case 4: // more or fewer corners
      if (choices.flag())
        face.push_back(p);
      else if (!face.empty())
        face.pop_back();
      break;
    case 5: // a corner of its own: a gap
      if (!face.empty()) {
        const std::size_t k = choices.below(face.size());
        const auto q = soup.points[face[k]];
        const double by = unit * std::ldexp(1.0, -static_cast<int>(choices.below(60)));
        face[k] = soup.points.size();
        soup.points.emplace_back(q.x() + (choices.flag() ? by : 0), q.y(), q.z() + (choices.flag() ? by : 0));
      }
      break;
    case 6: // a corner that is nowhere
      if (!face.empty() && choices.below(8) == 0)
        face[0] = soup.points.size() + choices.below(3);
      break;
    default: { // a point elsewhere
      const double x = choices.number() * unit, y = choices.number() * unit, z = choices.number() * unit;
      soup.points[p] = choices.flag() ? Face_soup::Point_3(x, y, z) : soup.points[choices.below(soup.points.size())];
    }
    }
  }
  soup.corners.clear();
  soup.first_corner.assign(1, 0);
  for (const auto& face : faces) {
    soup.corners.insert(soup.corners.end(), face.begin(), face.end());
    soup.close_face();
  }
}

bool same(const Face_soup& a, const Face_soup& b) {
  return a.corners == b.corners && a.first_corner == b.first_corner && a.points.size() == b.points.size() &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(), [](const auto& p, const auto& q) {
           const double x[3] = {p.x(), p.y(), p.z()}, y[3] = {q.x(), q.y(), q.z()};
           return std::memcmp(x, y, sizeof x) == 0;
         });
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Choices choices(data, size);
  auto list = fuzz::tiny_list(choices);
  const double unit = fuzz::unit_length(choices);
  if (choices.below(3) == 0) { // overlapping solids
    auto other = fuzz::tiny_list(choices);
    list += other.scale_and_move(1, 0.25 * static_cast<double>(choices.below(8)), 0.125, 0.0625);
  }
  Face_soup soup = soup_of(list, unit);
  damage(soup, unit, choices);
  if (choices.below(4) == 0)
    add_polygon(soup, unit, choices);
  Repair_parameters parameters;
  if (choices.below(4) == 0)
    parameters.gap(std::abs(choices.number()) * unit);
  if (choices.below(4) == 0)
    parameters.largest_hole(choices.below(8));
  const Face_soup before = soup;
  try {
    const Repair_report report = repair(soup, parameters);
    if (report.is_repaired()) {
      require(validate_soup(soup).is_valid(), "what was repaired is valid");
      require(!report.steps.empty() || same(soup, before), "without a step the soup is as it was");
      ++(report.steps.empty() ? untouched : repaired);
    } else {
      require(same(soup, before), "where faults are left the soup is as it was");
      require(!report.left.is_valid() || report.has_vanished, "the report says what is left");
      ++left;
    }
  } catch (const Error& error) {
    require(same(soup, before), "a refused soup is as it was");
    require(error.what()[0] != '\0', "a refusal says why");
    ++refused;
  }
  return 0;
}

std::string fuzz_input(std::mt19937_64& random) {
  return haptic_sculpt::fuzz::random_bytes(random, 120);
}

std::string fuzz_summary() {
  return std::to_string(untouched) + " soups without a fault, " + std::to_string(repaired) + " repaired, " +
         std::to_string(left) + " with faults left, " + std::to_string(refused) + " refused";
}
