// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesh_view.h"
#include "shaders.h"
#include <epoxy/gl.h>

namespace haptic_sculpt::drawing {
namespace {

unsigned compiled(unsigned kind, const std::string& source) {
  const unsigned shader = glCreateShader(kind);
  const char* const text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  int good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) {
    std::string log(1000, '\0');
    int length = 0;
    glGetShaderInfoLog(shader, int(log.size()), &length, log.data());
    log.resize(length);
    throw Picture_error("The OpenGL driver refuses a shader; use one with OpenGL 3.3 (libgl1-mesa-dri). It says: " +
                        log);
  }
  return shader;
}

unsigned linked(const std::string& vertex_source, const std::string& fragment_source) {
  const unsigned vertex = compiled(GL_VERTEX_SHADER, vertex_source);
  const unsigned fragment = compiled(GL_FRAGMENT_SHADER, fragment_source);
  const unsigned program = glCreateProgram();
  glAttachShader(program, vertex);
  glAttachShader(program, fragment);
  glLinkProgram(program);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  return program;
}

std::vector<Corner> mesh_corners(const Scene& scene, const Camera& camera) {
  std::vector<Corner> result;
  result.reserve(3 * scene.triangles.size());
  for (const auto& triangle : scene.triangles) {
    const std::array<Corner, 3> corners = corners_of(
        camera, {scene.points[triangle[0]], scene.points[triangle[1]], scene.points[triangle[2]]}, scene.surface_color);
    result.insert(result.end(), corners.begin(), corners.end());
    for (int i = 0; i < 3; ++i) {
      Corner& corner = result[result.size() - 3 + i];
      if (!scene.point_colors.empty())
        corner.color = scene.point_colors[triangle[i]];
      if (!scene.point_normals.empty())
        corner.normal = scene.point_normals[triangle[i]].cast<float>();
    }
  }
  return result;
}

/// By how many pixels the viewport is larger than the picture on each side: what leaves the picture there need not be
/// cut off, which software is slow at.
std::array<int, 2> margins(const Camera& camera) {
  std::array<int, 2> largest{};
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, largest.data());
  return {std::min(camera.width(), (largest[0] - camera.width()) / 2),
          std::min(camera.height(), (largest[1] - camera.height()) / 2)};
}

/// That of the camera, for such a viewport.
Eigen::Matrix4f projection_of(const Camera& camera) {
  const auto [beside, above] = margins(camera);
  Eigen::Matrix4d projection = camera.projection();
  projection.row(0) *= double(camera.width()) / (camera.width() + 2 * beside);
  projection.row(1) *= double(camera.height()) / (camera.height() + 2 * above);
  return projection.cast<float>();
}

} // namespace

std::array<Corner, 3> corners_of(const Camera& camera, const std::array<Eigen::Vector3d, 3>& points,
                                 const Color& color) {
  const Eigen::Vector3d a = camera.scaled(points[0]), b = camera.scaled(points[1]), c = camera.scaled(points[2]);
  // Stable: the cross product's square must not underflow for tiny triangles.
  const Eigen::Vector3f normal =
      (b - a).stableNormalized().cross((c - a).stableNormalized()).stableNormalized().cast<float>();
  return {Corner{a.cast<float>(), normal, color}, Corner{b.cast<float>(), normal, color},
          Corner{c.cast<float>(), normal, color}};
}

Mesh_view::Mesh_view() {
  program_ = linked(vertex_shader, fragment_shader);
  smooth_program_ = linked(smooth_vertex_shader, smooth_fragment_shader(false));
  smooth_program_with_edges_ = linked(smooth_vertex_shader, smooth_fragment_shader(true));
  mesh_.create();
  marks_.create();
}

Mesh_view::~Mesh_view() {
  marks_.destroy();
  mesh_.destroy();
  glDeleteProgram(smooth_program_with_edges_);
  glDeleteProgram(smooth_program_);
  glDeleteProgram(program_);
}

void Mesh_view::set_scene(const Scene& scene, const Camera& camera) {
  mesh_.set(mesh_corners(scene, camera));
  edge_opacity_ = scene.edge_opacity;
  set_marks(scene, camera);
}

void Mesh_view::set_marks(const Scene& scene, const Camera& camera) {
  Mark_triangles marks(camera);
  for (const Segment& s : scene.segments)
    marks.add(s);
  for (const Arrow& a : scene.arrows)
    marks.add(a);
  for (const Ball& b : scene.balls)
    marks.add(b);
  marks_.set(marks.corners());
}

void Mesh_view::use(unsigned program, const Camera& camera) const {
  glUseProgram(program);
  glUniformMatrix4fv(glGetUniformLocation(program, "projection"), 1, GL_FALSE, projection_of(camera).data());
  glUniformMatrix3fv(glGetUniformLocation(program, "rotation"), 1, GL_FALSE,
                     Eigen::Matrix3f(camera.rotation().cast<float>()).data());
  glUniform1f(glGetUniformLocation(program, "edge_opacity"), edge_opacity_);
}

void Mesh_view::clear(const Camera& camera, const Color& background) {
  const auto [beside, above] = margins(camera);
  glViewport(-beside, -above, camera.width() + 2 * beside, camera.height() + 2 * above);
  glClearColor(background.x(), background.y(), background.z(), 1);
  glDepthMask(GL_TRUE);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_MULTISAMPLE);
  glDisable(GL_BLEND);
  glDepthFunc(GL_LESS);
  glEnable(GL_CULL_FACE);
}

void Mesh_view::draw_smooth(const Camera& camera, const Color& background, const Smooth_look& look) const {
  clear(camera, background);
  const unsigned program = look.shows_edges ? smooth_program_with_edges_ : smooth_program_;
  use(program, camera);
  const std::size_t most_brushes = 8; // as the shader has room for
  const auto brushes = int(std::min(look.brushes.size(), most_brushes));
  glUniform1i(glGetUniformLocation(program, "brushes"), brushes);
  if (brushes > 0)
    glUniform3fv(glGetUniformLocation(program, "brush"), brushes, look.brushes[0].data());
  glUniform1f(glGetUniformLocation(program, "brush_radius"), look.brush_radius);
  glUniform3fv(glGetUniformLocation(program, "brush_color"), 1, look.brush_color.data());
  glUniform1f(glGetUniformLocation(program, "outwards"), look.faces_outwards ? 1.f : -1.f);
  glCullFace(look.faces_outwards ? GL_BACK : GL_FRONT);
  mesh_.draw();
  glDisable(GL_CULL_FACE);
  draw_marks(camera);
}

void Mesh_view::draw_mesh(const Camera& camera, const Color& background) const {
  clear(camera, background);
  use(program_, camera);
  glUniform1f(glGetUniformLocation(program_, "opacity"), 1);
  glUniform1i(glGetUniformLocation(program_, "with_edges"), 1);
  // Faces in contact are nearer to each other than depths can be distinguished, and what is seen would change from
  // pixel to pixel. One of the two is seen from inside, wherever the surface is closed and faces outwards: it is put
  // behind the other.
  glCullFace(GL_FRONT);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2, 32);
  mesh_.draw();
  glDisable(GL_POLYGON_OFFSET_FILL);
  glCullFace(GL_BACK);
  mesh_.draw();
  glDisable(GL_CULL_FACE);
}

void Mesh_view::draw_marks(const Camera& camera) const {
  use(program_, camera);
  glUniform1i(glGetUniformLocation(program_, "with_edges"), 0);
  const int opacity = glGetUniformLocation(program_, "opacity");
  glEnable(GL_CULL_FACE); // the back of a mark would shine through it twice
  glCullFace(GL_BACK);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GREATER); // what the surface hides
  glUniform1f(opacity, 0.3f);
  marks_.draw();
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS); // what it does not
  glUniform1f(opacity, 1);
  marks_.draw();
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
}

} // namespace haptic_sculpt::drawing
