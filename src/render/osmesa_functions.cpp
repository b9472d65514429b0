// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/osmesa_functions.h"

#include <stdexcept>
#include <string>

namespace facet_mapping {
namespace {

template <typename Function>
void load(const char* name, Function* function) {
  *function = reinterpret_cast<Function>(OSMesaGetProcAddress(name));
  if (*function == nullptr) {
    throw std::runtime_error(std::string("render: OSMesa has no ") + name);
  }
}

void load_fixed(OsmesaFunctions* gl) {
  load("glGetString", &gl->get_string);
  load("glGetIntegerv", &gl->get_integer);
  load("glGetError", &gl->get_error);
  load("glViewport", &gl->viewport);
  load("glEnable", &gl->enable);
  load("glDisable", &gl->disable);
  load("glDepthFunc", &gl->depth_func);
  load("glDrawElements", &gl->draw_elements);
  load("glReadBuffer", &gl->read_buffer);
  load("glReadPixels", &gl->read_pixels);
  load("glPixelStorei", &gl->pixel_store);
  load("glClearBufferfv", &gl->clear_float);
  load("glClearBufferuiv", &gl->clear_uint);
  load("glDrawBuffers", &gl->draw_buffers);
}

void load_shaders(OsmesaFunctions* gl) {
  load("glCreateShader", &gl->create_shader);
  load("glShaderSource", &gl->shader_source);
  load("glCompileShader", &gl->compile_shader);
  load("glGetShaderiv", &gl->get_shader);
  load("glGetShaderInfoLog", &gl->get_shader_log);
  load("glDeleteShader", &gl->delete_shader);
  load("glCreateProgram", &gl->create_program);
  load("glAttachShader", &gl->attach_shader);
  load("glLinkProgram", &gl->link_program);
  load("glGetProgramiv", &gl->get_program);
  load("glGetProgramInfoLog", &gl->get_program_log);
  load("glUseProgram", &gl->use_program);
  load("glGetUniformLocation", &gl->get_uniform_location);
  load("glUniform4f", &gl->uniform4);
  load("glUniform1f", &gl->uniform1);
}

void load_buffers(OsmesaFunctions* gl) {
  load("glGenFramebuffers", &gl->gen_framebuffers);
  load("glBindFramebuffer", &gl->bind_framebuffer);
  load("glFramebufferRenderbuffer", &gl->framebuffer_renderbuffer);
  load("glCheckFramebufferStatus", &gl->check_framebuffer);
  load("glGenRenderbuffers", &gl->gen_renderbuffers);
  load("glBindRenderbuffer", &gl->bind_renderbuffer);
  load("glRenderbufferStorage", &gl->renderbuffer_storage);
  load("glGenVertexArrays", &gl->gen_vertex_arrays);
  load("glBindVertexArray", &gl->bind_vertex_array);
  load("glGenBuffers", &gl->gen_buffers);
  load("glBindBuffer", &gl->bind_buffer);
  load("glBufferData", &gl->buffer_data);
  load("glVertexAttribPointer", &gl->vertex_attrib_pointer);
  load("glEnableVertexAttribArray", &gl->enable_vertex_attrib_array);
}

}  // namespace

OsmesaFunctions load_osmesa_functions() {
  OsmesaFunctions gl;
  load_fixed(&gl);
  load_shaders(&gl);
  load_buffers(&gl);
  return gl;
}

}  // namespace facet_mapping
