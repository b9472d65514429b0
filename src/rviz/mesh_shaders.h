// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shaders that draw chunks (GLSL 1.30: the first with `flat` and texelFetch).
#pragma once

namespace facet_mapping {

// Ogre looks for its own attribute names (vertex, normal, colour, ...) in the text and would bind
// them: no variable may be called so. What belongs to the facet is settled at its last corner, so
// that the rasterizer, which software GL feels most, carries two values and no more.
constexpr const char* kMeshVertexShader = R"(#version 130
uniform sampler2D palette;  // rows: classes, ramp, chunks
uniform mat4 to_screen;
uniform mat4 to_view;
uniform mat4 to_world;
uniform float mode;
uniform float alpha;
uniform float lighting;
uniform float darkening;
uniform float min_confidence;
uniform float min_views;
uniform float full_views;
uniform vec4 flat_rgb;
flat out vec4 rgba;  // alpha 0: not drawn; mode height: the brightness alone
out vec4 place;      // x, y, z seen from the eye, height
vec3 ramp(float value) {
  return texelFetch(palette, ivec2(int(clamp(value, 0.0, 1.0) * 255.0 + 0.5), 1), 0).rgb;
}
// The octahedral normal of vertex_packing.h.
vec3 unpack(float packed_normal) {
  float high = floor(packed_normal / 256.0);
  vec2 e = vec2(packed_normal - 256.0 * high, high + 128.0) / 127.0 - 1.0;
  vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  if (n.z < 0.0) {
    n.xy = (1.0 - abs(e.yx)) * vec2(e.x < 0.0 ? -1.0 : 1.0, e.y < 0.0 ? -1.0 : 1.0);
  }
  return n;
}
vec3 pick(vec4 of_class, vec4 facet, vec3 n) {
  if (mode < 0.5) return of_class.rgb;
  if (mode < 1.5) return ramp(facet.y / 255.0);
  if (mode < 2.5) return 0.5 + 0.5 * normalize(mat3(to_world) * n);
  if (mode < 3.5) return vec3(1.0);
  if (mode < 4.5) return ramp(facet.z / full_views);
  if (mode < 5.5) return texelFetch(palette, ivec2(int(facet.w), 2), 0).rgb;
  return flat_rgb.rgb;
}
void main() {
  vec4 facet = floor(gl_Color * 255.0 + 0.5);  // class slot, confidence, views, chunk
  vec4 of_class = texelFetch(palette, ivec2(int(facet.x), 0), 0);
  vec4 corner = vec4(gl_Vertex.xyz, 1.0);
  vec3 n = unpack(gl_Vertex.w);
  vec3 seen = (to_view * corner).xyz;
  vec3 n_seen = normalize(mat3(to_view) * n);
  float light = mix(1.0, 0.4 + 0.6 * abs(dot(n_seen, normalize(seen))), lighting);
  float shown = facet.y < min_confidence || facet.z < min_views ? 0.0 : of_class.a * alpha;
  rgba = vec4(pick(of_class, facet, n) * light * darkening, shown);
  place = vec4(seen, (to_world * corner).z);
  gl_Position = to_screen * corner;
}
)";

constexpr const char* kMeshFragmentShader = R"(#version 130
uniform sampler2D palette;
uniform float mode;
uniform float max_distance;
uniform float cut_height;
uniform vec2 height_range;
flat in vec4 rgba;
in vec4 place;
void main() {
  if (rgba.a == 0.0 || place.w > cut_height ||
      dot(place.xyz, place.xyz) > max_distance * max_distance) {
    discard;
  }
  vec3 seen = rgba.rgb;
  if (mode > 2.5 && mode < 3.5) {
    float part = (place.w - height_range.x) / (height_range.y - height_range.x);
    seen *= texelFetch(palette, ivec2(int(clamp(part, 0.0, 1.0) * 255.0 + 0.5), 1), 0).rgb;
  }
  gl_FragColor = vec4(seen, rgba.a);
}
)";

// What rviz's tools measure with: the depth as rviz/glsl120/include/pack_depth.frag packs it.
constexpr const char* kMeshDepthShader = R"(#version 130
uniform float max_distance;
uniform float cut_height;
uniform float far_clip;
flat in vec4 rgba;
in vec4 place;
void main() {
  if (rgba.a == 0.0 || place.w > cut_height ||
      dot(place.xyz, place.xyz) > max_distance * max_distance) {
    discard;
  }
  vec3 parts = fract(-place.z / far_clip * vec3(65536.0, 256.0, 1.0));
  parts -= parts.xxy * vec3(0.0, 1.0 / 256.0, 1.0 / 256.0);
  gl_FragColor = vec4(parts.zyx, 1.0);
}
)";

// What rviz selects with: black hides what lies behind and cannot be selected itself.
constexpr const char* kMeshPickShader = R"(#version 130
uniform float max_distance;
uniform float cut_height;
flat in vec4 rgba;
in vec4 place;
void main() {
  if (rgba.a == 0.0 || place.w > cut_height ||
      dot(place.xyz, place.xyz) > max_distance * max_distance) {
    discard;
  }
  gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0);
}
)";

}  // namespace facet_mapping
