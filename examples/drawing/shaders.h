// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace haptic_sculpt::drawing {

/// The parts of which the programs for the graphics card are put together. Software runs them, too (llvmpipe), and then
/// every operation on a pixel is felt.
namespace shader_parts {

inline const std::string version = "#version 330 core\n";

/// What is given for each corner. The three corners of a triangle, which share no vertices, are numbered by the
/// barycentric coordinates `barycentric()`.
inline const std::string corner = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 color;
uniform mat4 projection;
uniform mat3 rotation;
vec3 barycentric() {
  vec3 result = vec3(0);
  result[gl_VertexID % 3] = 1;
  return result;
}
)";

/// The colour of a place under two lights that stay beside the eye. \pre n has length 1, in axes of the eye
inline const std::string lights = R"(
vec3 lit(vec3 base, vec3 n) {
  vec3 key = normalize(vec3(-0.45, 0.75, 0.70)), fill = normalize(vec3(0.80, -0.10, 0.55));
  // Light adds up in linear intensities; squares and roots stand for the screen's gamma of 2.2.
  vec3 light = mix(vec3(0.20, 0.19, 0.20), vec3(0.30, 0.32, 0.36), 0.5 + 0.5 * n.y);
  light += vec3(0.74, 0.72, 0.68) * max(dot(n, key), 0) + vec3(0.16, 0.18, 0.22) * max(dot(n, fill), 0);
  float shine = 0.06 * pow(max(dot(n, normalize(key + vec3(0, 0, 1))), 0), 40);
  return sqrt(base * base * light + shine);
}
)";

/// A colour with a face's edges over it.
///
/// The gradient of a barycentric coordinate is 1 / the triangle's height in pixels, so `barycentric / gradient` is the
/// distance to an edge in pixels. Lines fade where triangles are too small for them.
inline const std::string edges = R"(
uniform float edge_opacity;
vec3 with_edges_over(vec3 shaded, vec3 barycentric) {
  vec3 right = dFdx(barycentric), up = dFdy(barycentric);
  vec3 height = inversesqrt(max(right * right + up * up, 1e-24));
  vec3 line = (1 - smoothstep(0.25, 1.15, barycentric * height)) * smoothstep(3, 14, height);
  return mix(shaded, vec3(0.13, 0.17, 0.24), edge_opacity * max(line.x, max(line.y, line.z)));
}
)";

} // namespace shader_parts

/// \name Any mesh and marks: normals and colours may differ from corner to corner, and faces are seen from both sides
///@{
inline const std::string vertex_shader = shader_parts::version + shader_parts::corner + R"(
out vec3 eye_normal, corner_color, place;
void main() {
  gl_Position = projection * vec4(position, 1);
  eye_normal = rotation * normal;
  corner_color = color;
  place = barycentric();
})";
inline const std::string fragment_shader = shader_parts::version + shader_parts::lights + shader_parts::edges + R"(
in vec3 eye_normal, corner_color, place;
uniform bool with_edges;
uniform float opacity;
out vec4 result;
void main() {
  vec3 n = normalize(gl_FrontFacing ? eye_normal : -eye_normal);
  vec3 shaded = lit(gl_FrontFacing || !with_edges ? corner_color : vec3(0.93, 0.60, 0.68), n);
  if (with_edges)
    shaded = with_edges_over(shaded, place);
  result = vec4(shaded, opacity);
})";
///@}

/// \name A mesh that a hand sculpts, seen from outside: lit once a corner instead of once a pixel
///@{
inline const std::string smooth_vertex_shader =
    shader_parts::version + shader_parts::corner + shader_parts::lights + R"(
uniform float outwards, brush_radius;
uniform int brushes;
uniform vec3 brush[8];
noperspective out vec3 shaded;
noperspective out vec2 place;
noperspective out float reach;
void main() {
  gl_Position = projection * vec4(position, 1);
  vec3 n = rotation * normal * outwards;
  float away = 1 - clamp(n.z, 0, 1);
  shaded = lit(color, n) + vec3(0.30, 0.33, 0.38) * (away * away * away);
  place = barycentric().xy;
  reach = 4;
  for (int i = 0; i < brushes; ++i)
    reach = min(reach, distance(position, brush[i]) / brush_radius);
})";
/// Under a brush the tint is as strong as what it does there; a line is where it ends.
inline std::string smooth_fragment_shader(bool with_edges) {
  return shader_parts::version + shader_parts::edges + R"(
noperspective in vec3 shaded;
noperspective in vec2 place;
noperspective in float reach;
uniform vec3 brush_color;
out vec4 result;
void main() {
  float share = max(1 - reach * reach, 0);
  float line = 1 - smoothstep(0.6, 1.6, abs(reach - 1) / max(fwidth(reach), 1e-6));
  result = vec4(mix()" + (with_edges ? "with_edges_over(shaded, vec3(place, 1 - place.x - place.y))" : "shaded") +
         R"(, brush_color, max(0.3 * share * share, line)), 1);
})";
}
///@}

} // namespace haptic_sculpt::drawing
