// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesh_view.h"
#include "mark_triangles.h"
#include "shaders.h"
#include <epoxy/gl.h>
#include <limits>

namespace haptic_sculpt::drawing {
namespace {

unsigned compiled(unsigned kind, const char* source) {
  const unsigned shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
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

std::vector<Corner> mesh_corners(const Scene& scene, const Camera& camera) {
  std::vector<Corner> result;
  result.reserve(3 * scene.triangles.size());
  for (const auto& triangle : scene.triangles) {
    const Eigen::Vector3d a = camera.scaled(scene.points[triangle[0]]), b = camera.scaled(scene.points[triangle[1]]),
                          c = camera.scaled(scene.points[triangle[2]]);
    // Stable: the cross product's square must not underflow for tiny triangles.
    const Eigen::Vector3d normal = (b - a).stableNormalized().cross((c - a).stableNormalized()).stableNormalized();
    for (int v : triangle)
      result.push_back({camera.scaled(scene.points[v]).cast<float>(), normal.cast<float>(),
                        scene.point_colors.empty() ? scene.surface_color : scene.point_colors[v]});
  }
  return result;
}

} // namespace

void Mesh_view::Triangles::create() {
  glGenVertexArrays(1, &vertex_array);
  glGenBuffers(1, &buffer);
  glBindVertexArray(vertex_array);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  for (int i = 0; i < 3; ++i) { // position, normal, colour: three floats each
    glEnableVertexAttribArray(i);
    glVertexAttribPointer(i, 3, GL_FLOAT, GL_FALSE, sizeof(Corner),
                          reinterpret_cast<const void*>(i * 3 * sizeof(float)));
  }
}

void Mesh_view::Triangles::set(const std::vector<Corner>& corners) {
  static_assert(sizeof(Corner) == 9 * sizeof(float), "a corner is nine floats without padding");
  if (corners.size() > std::size_t(std::numeric_limits<int>::max()))
    throw Picture_error("There are " + std::to_string(corners.size() / 3) +
                        " triangles, more than OpenGL draws at once (715827882). Draw a part.");
  while (glGetError() != GL_NO_ERROR) { // so that an error found below is this call's own
  }
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(corners.size() * sizeof(Corner)), corners.data(), GL_STATIC_DRAW);
  if (glGetError() != GL_NO_ERROR)
    throw Picture_error("The OpenGL driver has no memory for " + std::to_string(corners.size() / 3) +
                        " triangles. Draw a coarser mesh.");
  size = int(corners.size());
}

void Mesh_view::Triangles::draw() const {
  glBindVertexArray(vertex_array);
  glDrawArrays(GL_TRIANGLES, 0, size);
}

void Mesh_view::Triangles::destroy() {
  glDeleteBuffers(1, &buffer);
  glDeleteVertexArrays(1, &vertex_array);
}

Mesh_view::Mesh_view() {
  const unsigned vertex = compiled(GL_VERTEX_SHADER, vertex_shader);
  const unsigned fragment = compiled(GL_FRAGMENT_SHADER, fragment_shader);
  program_ = glCreateProgram();
  glAttachShader(program_, vertex);
  glAttachShader(program_, fragment);
  glLinkProgram(program_);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  mesh_.create();
  marks_.create();
}

Mesh_view::~Mesh_view() {
  marks_.destroy();
  mesh_.destroy();
  glDeleteProgram(program_);
}

void Mesh_view::set_scene(const Scene& scene, const Camera& camera) {
  mesh_.set(mesh_corners(scene, camera));
  Mark_triangles marks(camera);
  for (const Segment& s : scene.segments)
    marks.add(s);
  for (const Arrow& a : scene.arrows)
    marks.add(a);
  for (const Ball& b : scene.balls)
    marks.add(b);
  marks_.set(marks.corners());
}

int Mesh_view::uniform(const char* name) const {
  return glGetUniformLocation(program_, name);
}

void Mesh_view::draw_mesh(const Camera& camera, const Color& background) const {
  glViewport(0, 0, camera.width(), camera.height());
  glClearColor(background.x(), background.y(), background.z(), 1);
  glDepthMask(GL_TRUE);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_MULTISAMPLE);
  glUseProgram(program_);
  glUniformMatrix4fv(uniform("projection"), 1, GL_FALSE, Eigen::Matrix4f(camera.projection().cast<float>()).data());
  glUniformMatrix3fv(uniform("rotation"), 1, GL_FALSE, Eigen::Matrix3f(camera.rotation().cast<float>()).data());
  glUniform1f(uniform("opacity"), 1);

  glUniform1i(uniform("with_edges"), 1);
  glDisable(GL_BLEND);
  glDepthFunc(GL_LESS);
  // Faces in contact are nearer to each other than depths can be told apart, and what is seen would change from pixel to pixel.
  // One of the two is seen from inside, wherever the surface is closed and faces outwards: it is put behind the other.
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2, 32);
  mesh_.draw();
  glDisable(GL_POLYGON_OFFSET_FILL);
  glCullFace(GL_BACK);
  mesh_.draw();
  glDisable(GL_CULL_FACE);
}

void Mesh_view::draw_marks() const {
  glUniform1i(uniform("with_edges"), 0);
  glEnable(GL_CULL_FACE); // the back of a mark would shine through it twice
  glCullFace(GL_BACK);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GREATER); // what the surface hides
  glUniform1f(uniform("opacity"), 0.3f);
  marks_.draw();
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS); // what it does not
  glUniform1f(uniform("opacity"), 1);
  marks_.draw();
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
}

} // namespace haptic_sculpt::drawing
