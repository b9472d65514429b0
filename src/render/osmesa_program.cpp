// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/osmesa_program.h"

#include <array>
#include <stdexcept>
#include <string>

#include "facet_mapping/render/facet_renderer.h"

namespace facet_mapping {
namespace {

// Clip space: x and y so that pixel centres lie at integers and row 0 comes first; z = near and
// w = camera z, so that OpenGL's own clipping (z <= w) cuts at the near depth and nothing is far.
constexpr const char* kVertexShader = R"(#version 330 core
layout(location = 0) in vec3 in_cam;
uniform vec4 scale_and_offset;
uniform float near_depth;
void main() {
  vec2 position = scale_and_offset.xy * in_cam.xy + scale_and_offset.zw * in_cam.z;
  gl_Position = vec4(position, near_depth, in_cam.z);
}
)";

// gl_FragCoord.w is 1 / camera z, linear over the screen; as depth it keeps its full precision.
constexpr const char* kFragmentShader = R"(#version 330 core
layout(location = 0) out uint facet;
layout(location = 1) out float depth;
uniform float near_depth;
void main() {
  facet = uint(gl_PrimitiveID) + 1u;
  depth = 1.0 / gl_FragCoord.w;
  gl_FragDepth = near_depth * gl_FragCoord.w;
}
)";

GLuint compile(const OsmesaFunctions& gl, GLenum kind, const char* source) {
  const GLuint shader = gl.create_shader(kind);
  gl.shader_source(shader, 1, &source, nullptr);
  gl.compile_shader(shader);
  GLint compiled = GL_FALSE;
  gl.get_shader(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE) {
    std::array<char, 1024> log{};
    gl.get_shader_log(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw std::runtime_error(std::string("render: OSMesa compiles no shader: ") + log.data());
  }
  return shader;
}

}  // namespace

OsmesaProgram make_osmesa_program(const OsmesaFunctions& gl) {
  OsmesaProgram program;
  program.id = gl.create_program();
  for (const GLuint shader : {compile(gl, GL_VERTEX_SHADER, kVertexShader),
                              compile(gl, GL_FRAGMENT_SHADER, kFragmentShader)}) {
    gl.attach_shader(program.id, shader);
    gl.delete_shader(shader);
  }
  gl.link_program(program.id);
  GLint linked = GL_FALSE;
  gl.get_program(program.id, GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE) {
    std::array<char, 1024> log{};
    gl.get_program_log(program.id, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw std::runtime_error(std::string("render: OSMesa links no program: ") + log.data());
  }
  program.scale_and_offset = gl.get_uniform_location(program.id, "scale_and_offset");
  program.near_depth = gl.get_uniform_location(program.id, "near_depth");
  return program;
}

void use_osmesa_program(const OsmesaFunctions& gl,
                        const OsmesaProgram& program,
                        const PinholeCamera& camera) {
  gl.use_program(program.id);
  gl.uniform4(program.scale_and_offset,
              static_cast<float>(2.0 * camera.fx / camera.width),
              static_cast<float>(2.0 * camera.fy / camera.height),
              static_cast<float>((2.0 * camera.cx + 1.0) / camera.width - 1.0),
              static_cast<float>((2.0 * camera.cy + 1.0) / camera.height - 1.0));
  gl.uniform1(program.near_depth, static_cast<float>(kNearDepth));
}

}  // namespace facet_mapping
