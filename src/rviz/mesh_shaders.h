// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shaders that draw chunks (GLSL 1.30: the first with `flat` and texelFetch).
#pragma once

namespace facet_mapping {

// Ogre looks for its own attribute names (vertex, normal, colour, ...) in the text and would bind
// them: no variable may be called so.
constexpr const char* kMeshVertexShader = R"(#version 130
uniform mat4 to_screen;
uniform mat4 to_view;
uniform mat4 to_world;
flat out vec4 facet;    // class slot, confidence, views, chunk: 0..255
flat out vec3 n_view;
flat out vec3 n_world;
out vec3 p_view;
out float height;
void main() {
  facet = floor(gl_Color * 255.0 + 0.5);
  n_view = mat3(to_view) * gl_Normal;
  n_world = mat3(to_world) * gl_Normal;
  p_view = (to_view * gl_Vertex).xyz;
  height = (to_world * gl_Vertex).z;
  gl_Position = to_screen * gl_Vertex;
}
)";

constexpr const char* kMeshFragmentShader = R"(#version 130
uniform sampler2D palette;  // rows: classes, ramp, chunks
uniform float mode;
uniform float alpha;
uniform float lighting;
uniform float darkening;
uniform float min_confidence;
uniform float max_distance;
uniform float cut_height;
uniform float full_views;
uniform vec2 height_range;
uniform vec4 flat_rgb;
flat in vec4 facet;
flat in vec3 n_view;
flat in vec3 n_world;
in vec3 p_view;
in float height;
vec3 ramp(float value) {
  return texelFetch(palette, ivec2(int(clamp(value, 0.0, 1.0) * 255.0 + 0.5), 1), 0).rgb;
}
vec3 pick(vec4 of_class) {
  if (mode < 0.5) return of_class.rgb;
  if (mode < 1.5) return ramp(facet.y / 255.0);
  if (mode < 2.5) return 0.5 + 0.5 * n_world;
  if (mode < 3.5) return ramp((height - height_range.x) / (height_range.y - height_range.x));
  if (mode < 4.5) return ramp(facet.z / full_views);
  if (mode < 5.5) return texelFetch(palette, ivec2(int(facet.w), 2), 0).rgb;
  return flat_rgb.rgb;
}
void main() {
  vec4 of_class = texelFetch(palette, ivec2(int(facet.x), 0), 0);
  if (of_class.a == 0.0 || facet.y < min_confidence || height > cut_height ||
      dot(p_view, p_view) > max_distance * max_distance) {
    discard;
  }
  float facing = abs(dot(normalize(n_view + vec3(0.0, 0.0, 1.0e-6)), normalize(p_view)));
  float light = mix(1.0, 0.4 + 0.6 * facing, lighting);
  gl_FragColor = vec4(pick(of_class) * light * darkening, of_class.a * alpha);
}
)";

}  // namespace facet_mapping
