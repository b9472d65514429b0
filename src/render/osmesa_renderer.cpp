// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "render/osmesa_renderer.h"

#include <array>
#include <cstdint>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/osmesa_functions.h"
#include "render/osmesa_program.h"
#include "render/render_input.h"

namespace facet_mapping {
namespace {

// OSMesa insists on a colour buffer although nothing draws into it.
constexpr int kDummySize = 16;
constexpr std::size_t kDummyBytes = 16 * 16 * 4;

// Mesa's context and dispatch state is partly global, so one render at a time.
std::mutex& osmesa_mutex() {
  static std::mutex mutex;
  return mutex;
}

std::vector<float> vertices_in_cam(const TriangleMesh& mesh, const View& view) {
  const Eigen::Isometry3d cam_from_world = view.cam_from_world();
  std::vector<float> coordinates;
  coordinates.reserve(3 * mesh.vertices.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Eigen::Vector3f in_cam = (cam_from_world * mesh.vertices[v]).cast<float>();
    if (!in_cam.allFinite()) {
      throw_vertex_not_finite(v);
    }
    coordinates.insert(coordinates.end(), {in_cam.x(), in_cam.y(), in_cam.z()});
  }
  return coordinates;
}

}  // namespace

class OsmesaRenderer::Context {
 public:
  Context();
  ~Context() { OSMesaDestroyContext(context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  FacetImage render(const TriangleMesh& mesh, const View& view);

 private:
  void make_current();
  void check_renderer() const;
  void make_buffers();
  void resize(const cv::Size& size);
  void upload(const TriangleMesh& mesh, const View& view) const;
  void draw(const View& view, std::size_t facets) const;
  FacetImage read_back(const cv::Size& size) const;

  OSMesaContext context_ = nullptr;
  std::array<std::uint8_t, kDummyBytes> dummy_{};
  OsmesaFunctions gl_;
  OsmesaProgram program_;
  std::array<GLuint, 3> renderbuffers_{};  // facet ids, camera z, depth
  cv::Size size_;
};

OsmesaRenderer::Context::Context() {
  const std::array<int, 11> attributes{OSMESA_FORMAT,
                                       OSMESA_RGBA,
                                       OSMESA_PROFILE,
                                       OSMESA_CORE_PROFILE,
                                       OSMESA_CONTEXT_MAJOR_VERSION,
                                       3,
                                       OSMESA_CONTEXT_MINOR_VERSION,
                                       3,
                                       0};
  context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
  if (context_ == nullptr) {
    throw std::runtime_error("render: OSMesa gives no OpenGL 3.3 core context");
  }
  try {
    make_current();
    gl_ = load_osmesa_functions();
    check_renderer();
    program_ = make_osmesa_program(gl_);
    make_buffers();
  } catch (...) {
    OSMesaDestroyContext(context_);
    throw;
  }
}

void OsmesaRenderer::Context::make_current() {
  if (OSMesaMakeCurrent(context_, dummy_.data(), GL_UNSIGNED_BYTE, kDummySize, kDummySize) ==
      GL_FALSE) {
    throw std::runtime_error("render: OSMesa cannot make its context current");
  }
}

void OsmesaRenderer::Context::check_renderer() const {
  const auto* text = reinterpret_cast<const char*>(gl_.get_string(GL_RENDERER));
  const std::string name = text == nullptr ? "" : text;
  // softpipe draws nothing with gl_PrimitiveID and reports no error.
  if (name.empty() || name.find("softpipe") != std::string::npos) {
    throw std::runtime_error("render: OSMesa runs on '" + name +
                             "', which has no gl_PrimitiveID; install the llvmpipe driver and "
                             "leave GALLIUM_DRIVER unset");
  }
}

void OsmesaRenderer::Context::make_buffers() {
  GLuint framebuffer = 0;
  GLuint vertex_array = 0;
  std::array<GLuint, 2> buffers{};
  gl_.gen_framebuffers(1, &framebuffer);
  gl_.bind_framebuffer(GL_FRAMEBUFFER, framebuffer);
  gl_.gen_renderbuffers(static_cast<GLsizei>(renderbuffers_.size()), renderbuffers_.data());
  gl_.gen_vertex_arrays(1, &vertex_array);
  gl_.bind_vertex_array(vertex_array);
  gl_.gen_buffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  gl_.bind_buffer(GL_ARRAY_BUFFER, buffers[0]);
  gl_.bind_buffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
  gl_.vertex_attrib_pointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl_.enable_vertex_attrib_array(0);
  gl_.disable(GL_CULL_FACE);
  gl_.disable(GL_DITHER);
  gl_.enable(GL_DEPTH_TEST);
  gl_.depth_func(GL_GREATER);
  gl_.pixel_store(GL_PACK_ALIGNMENT, 4);
}

void OsmesaRenderer::Context::resize(const cv::Size& size) {
  if (size == size_) {
    return;
  }
  GLint largest = 0;
  gl_.get_integer(GL_MAX_RENDERBUFFER_SIZE, &largest);
  if (size.width > largest || size.height > largest) {
    throw std::invalid_argument("render: OSMesa draws at most " + std::to_string(largest) +
                                " pixels a side; use the software backend");
  }
  constexpr std::array<GLenum, 3> kFormats{GL_R32UI, GL_R32F, GL_DEPTH_COMPONENT32F};
  constexpr std::array<GLenum, 3> kAttachments{
      GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_DEPTH_ATTACHMENT};
  for (std::size_t k = 0; k < renderbuffers_.size(); ++k) {
    gl_.bind_renderbuffer(GL_RENDERBUFFER, renderbuffers_[k]);
    gl_.renderbuffer_storage(GL_RENDERBUFFER, kFormats[k], size.width, size.height);
    gl_.framebuffer_renderbuffer(
        GL_FRAMEBUFFER, kAttachments[k], GL_RENDERBUFFER, renderbuffers_[k]);
  }
  gl_.draw_buffers(2, kAttachments.data());
  if (gl_.check_framebuffer(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    size_ = cv::Size();
    throw std::runtime_error("render: OSMesa cannot make the facet id and depth buffers");
  }
  size_ = size;
}

void OsmesaRenderer::Context::upload(const TriangleMesh& mesh, const View& view) const {
  const std::vector<float> coordinates = vertices_in_cam(mesh, view);
  gl_.buffer_data(GL_ARRAY_BUFFER,
                  static_cast<GLsizeiptr>(coordinates.size() * sizeof(float)),
                  coordinates.data(),
                  GL_STREAM_DRAW);
  gl_.buffer_data(GL_ELEMENT_ARRAY_BUFFER,
                  static_cast<GLsizeiptr>(mesh.triangles.size() * sizeof(Triangle)),
                  mesh.triangles.data(),
                  GL_STREAM_DRAW);
}

void OsmesaRenderer::Context::draw(const View& view, std::size_t facets) const {
  const std::array<GLuint, 4> no_facet{};
  const std::array<float, 4> nothing{};
  gl_.viewport(0, 0, view.camera.width, view.camera.height);
  gl_.clear_uint(GL_COLOR, 0, no_facet.data());
  gl_.clear_float(GL_COLOR, 1, nothing.data());
  gl_.clear_float(GL_DEPTH, 0, nothing.data());
  use_osmesa_program(gl_, program_, view.camera);
  gl_.draw_elements(GL_TRIANGLES, static_cast<GLsizei>(3 * facets), GL_UNSIGNED_INT, nullptr);
}

FacetImage OsmesaRenderer::Context::read_back(const cv::Size& size) const {
  FacetImage image;
  image.facets.create(size, CV_32SC1);
  image.depth.create(size, CV_32FC1);
  gl_.read_buffer(GL_COLOR_ATTACHMENT0);
  gl_.read_pixels(
      0, 0, size.width, size.height, GL_RED_INTEGER, GL_UNSIGNED_INT, image.facets.data);
  gl_.read_buffer(GL_COLOR_ATTACHMENT1);
  gl_.read_pixels(0, 0, size.width, size.height, GL_RED, GL_FLOAT, image.depth.data);
  const GLenum error = gl_.get_error();
  if (error != GL_NO_ERROR) {
    throw std::runtime_error("render: OpenGL error " + std::to_string(error));
  }
  image.facets -= cv::Scalar(1);  // the shader writes index + 1, so that 0 is nothing
  return image;
}

FacetImage OsmesaRenderer::Context::render(const TriangleMesh& mesh, const View& view) {
  make_current();
  resize({view.camera.width, view.camera.height});
  upload(mesh, view);
  draw(view, mesh.triangles.size());
  return read_back(size_);
}

OsmesaRenderer::OsmesaRenderer() {
  const std::lock_guard<std::mutex> lock(osmesa_mutex());
  context_ = std::make_unique<Context>();
}

OsmesaRenderer::~OsmesaRenderer() {
  const std::lock_guard<std::mutex> lock(osmesa_mutex());
  context_.reset();
}

FacetImage OsmesaRenderer::render(const TriangleMesh& mesh, const View& view) {
  check_render_input(mesh, view);
  const std::lock_guard<std::mutex> lock(osmesa_mutex());
  return context_->render(mesh, view);
}

}  // namespace facet_mapping
