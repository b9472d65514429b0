// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The OpenGL functions that the OSMesa backend uses, loaded through OSMesaGetProcAddress: linked
// directly they might bind to another OpenGL library, and no extension loader works with OSMesa.
#pragma once

#include <GL/osmesa.h>
// After osmesa.h, which brings gl.h.
#include <GL/glext.h>

namespace facet_mapping {

struct OsmesaFunctions {
  decltype(&::glGetString) get_string = nullptr;
  decltype(&::glGetIntegerv) get_integer = nullptr;
  decltype(&::glGetError) get_error = nullptr;
  decltype(&::glViewport) viewport = nullptr;
  decltype(&::glEnable) enable = nullptr;
  decltype(&::glDisable) disable = nullptr;
  decltype(&::glDepthFunc) depth_func = nullptr;
  decltype(&::glDrawElements) draw_elements = nullptr;
  decltype(&::glReadBuffer) read_buffer = nullptr;
  decltype(&::glReadPixels) read_pixels = nullptr;
  decltype(&::glPixelStorei) pixel_store = nullptr;
  PFNGLCLEARBUFFERFVPROC clear_float = nullptr;
  PFNGLCLEARBUFFERUIVPROC clear_uint = nullptr;
  PFNGLDRAWBUFFERSPROC draw_buffers = nullptr;
  PFNGLCREATESHADERPROC create_shader = nullptr;
  PFNGLSHADERSOURCEPROC shader_source = nullptr;
  PFNGLCOMPILESHADERPROC compile_shader = nullptr;
  PFNGLGETSHADERIVPROC get_shader = nullptr;
  PFNGLGETSHADERINFOLOGPROC get_shader_log = nullptr;
  PFNGLDELETESHADERPROC delete_shader = nullptr;
  PFNGLCREATEPROGRAMPROC create_program = nullptr;
  PFNGLATTACHSHADERPROC attach_shader = nullptr;
  PFNGLLINKPROGRAMPROC link_program = nullptr;
  PFNGLGETPROGRAMIVPROC get_program = nullptr;
  PFNGLGETPROGRAMINFOLOGPROC get_program_log = nullptr;
  PFNGLUSEPROGRAMPROC use_program = nullptr;
  PFNGLGETUNIFORMLOCATIONPROC get_uniform_location = nullptr;
  PFNGLUNIFORM4FPROC uniform4 = nullptr;
  PFNGLUNIFORM1FPROC uniform1 = nullptr;
  PFNGLGENFRAMEBUFFERSPROC gen_framebuffers = nullptr;
  PFNGLBINDFRAMEBUFFERPROC bind_framebuffer = nullptr;
  PFNGLFRAMEBUFFERRENDERBUFFERPROC framebuffer_renderbuffer = nullptr;
  PFNGLCHECKFRAMEBUFFERSTATUSPROC check_framebuffer = nullptr;
  PFNGLGENRENDERBUFFERSPROC gen_renderbuffers = nullptr;
  PFNGLBINDRENDERBUFFERPROC bind_renderbuffer = nullptr;
  PFNGLRENDERBUFFERSTORAGEPROC renderbuffer_storage = nullptr;
  PFNGLGENVERTEXARRAYSPROC gen_vertex_arrays = nullptr;
  PFNGLBINDVERTEXARRAYPROC bind_vertex_array = nullptr;
  PFNGLGENBUFFERSPROC gen_buffers = nullptr;
  PFNGLBINDBUFFERPROC bind_buffer = nullptr;
  PFNGLBUFFERDATAPROC buffer_data = nullptr;
  PFNGLVERTEXATTRIBPOINTERPROC vertex_attrib_pointer = nullptr;
  PFNGLENABLEVERTEXATTRIBARRAYPROC enable_vertex_attrib_array = nullptr;
};

/// Throws std::runtime_error naming the function that OSMesa lacks.
OsmesaFunctions load_osmesa_functions();

}  // namespace facet_mapping
