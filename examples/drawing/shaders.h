// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef HAPTIC_SCULPT_DRAWING_SHADERS_H
#define HAPTIC_SCULPT_DRAWING_SHADERS_H

namespace haptic_sculpt::drawing {

/// Places a corner, and numbers the three corners of its triangle, which share no vertices, by barycentric coordinates.
inline const char* const vertex_shader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 color;
uniform mat4 projection;
uniform mat3 rotation;
out vec3 eye_normal, corner_color, barycentric;
void main() {
  gl_Position = projection * vec4(position, 1);
  eye_normal = rotation * normal;
  corner_color = color;
  barycentric = vec3(0);
  barycentric[gl_VertexID % 3] = 1;
})";

/// Lights a face or mark, and draws a face's edges over it.
///
/// The gradient of a barycentric coordinate is 1 / the triangle's height in pixels, so `barycentric / gradient` is the
/// distance to an edge in pixels.
inline const char* const fragment_shader = R"(#version 330 core
in vec3 eye_normal, corner_color, barycentric;
uniform bool with_edges;
uniform float opacity, edge_opacity;
out vec4 result;
void main() {
  vec3 n = normalize(gl_FrontFacing ? eye_normal : -eye_normal);
  vec3 base = gl_FrontFacing || !with_edges ? corner_color : vec3(0.93, 0.60, 0.68);
  vec3 key = normalize(vec3(-0.45, 0.75, 0.70)), fill = normalize(vec3(0.80, -0.10, 0.55));
  // Light adds up in linear intensities; squares and roots stand for the screen's gamma of 2.2.
  vec3 light = mix(vec3(0.20, 0.19, 0.20), vec3(0.30, 0.32, 0.36), 0.5 + 0.5 * n.y);
  light += vec3(0.74, 0.72, 0.68) * max(dot(n, key), 0) + vec3(0.16, 0.18, 0.22) * max(dot(n, fill), 0);
  float shine = 0.06 * pow(max(dot(n, normalize(key + vec3(0, 0, 1))), 0), 40);
  vec3 shaded = sqrt(base * base * light + shine);
  if (with_edges) {
    vec3 gradient = max(sqrt(dFdx(barycentric) * dFdx(barycentric) + dFdy(barycentric) * dFdy(barycentric)), 1e-12);
    vec3 line = (1 - smoothstep(0.25, 1.15, barycentric / gradient)) * smoothstep(3, 14, 1 / gradient);
    shaded = mix(shaded, vec3(0.13, 0.17, 0.24), edge_opacity * max(line.x, max(line.y, line.z)));
  }
  result = vec4(shaded, opacity);
})";

} // namespace haptic_sculpt::drawing

#endif
