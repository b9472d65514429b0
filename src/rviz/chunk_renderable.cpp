// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "chunk_renderable.h"

#include <cmath>
#include <memory>
#include <utility>

#include "ogre_helpers.h"
#include <OgreCamera.h>
#include <OgreHardwareBufferManager.h>
#include <OgreNode.h>
#include <OgreViewport.h>

namespace facet_mapping {
namespace {

constexpr std::size_t kMaxShortIndex = 65535;
constexpr float kMaxLossPixels = 2.6F;   // by which a coarse level may differ
constexpr float kUnknownScale = 1.0e9F;  // asks for the finest level

}  // namespace

ChunkRenderable::ChunkRenderable(const BuiltChunk& chunk) : packing_(chunk.packing) {
  const ChunkGeometry& geometry = chunk.geometry;
  upload_vertices(chunk.vertices);
  const bool is_short = chunk.vertices.size() <= kMaxShortIndex;
  add_level(geometry.indices, 0.0F, is_short);
  for (const CoarseLevel& level : geometry.levels) {
    add_level(level.indices, level.cell_m, is_short);
  }
  mRenderOp.indexData = levels_.front().indices.get();
  mRenderOp.operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
  mRenderOp.useIndexes = true;
  const Eigen::Vector3d shift = chunk.origin - packing_.center();
  const Eigen::Vector3d low = (geometry.box.min().cast<double>() + shift) / packing_.step_m();
  const Eigen::Vector3d high = (geometry.box.max().cast<double>() + shift) / packing_.step_m();
  const Eigen::Vector3d rounding = Eigen::Vector3d::Ones();
  setBoundingBox({to_ogre(low - rounding), to_ogre(high + rounding)});
  radius_ = static_cast<float>((low.cwiseAbs().cwiseMax(high.cwiseAbs()) + rounding).norm());
}

ChunkRenderable::~ChunkRenderable() {
  delete mRenderOp.vertexData;  // which the render operation does not own
}

void ChunkRenderable::upload_vertices(const std::vector<PackedVertex>& vertices) {
  auto data = std::make_unique<Ogre::VertexData>();
  data->vertexCount = vertices.size();
  Ogre::VertexDeclaration* layout = data->vertexDeclaration;
  layout->addElement(0, 0, Ogre::VET_SHORT4, Ogre::VES_POSITION);  // the fourth: the normal
  layout->addElement(0, offsetof(PackedVertex, facet), Ogre::VET_UBYTE4_NORM, Ogre::VES_DIFFUSE);
  const auto buffer = Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
      sizeof(PackedVertex), data->vertexCount, Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
  buffer->writeData(0, buffer->getSizeInBytes(), vertices.data(), true);
  data->vertexBufferBinding->setBinding(0, buffer);
  mRenderOp.vertexData = data.release();
}

void ChunkRenderable::add_level(const std::vector<std::uint32_t>& indices,
                                float cell_m,
                                bool is_short) {
  Level level;
  level.cell_m = cell_m;
  level.indices = std::make_unique<Ogre::IndexData>();
  level.indices->indexCount = indices.size();
  const auto buffer = Ogre::HardwareBufferManager::getSingleton().createIndexBuffer(
      is_short ? Ogre::HardwareIndexBuffer::IT_16BIT : Ogre::HardwareIndexBuffer::IT_32BIT,
      indices.size(),
      Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
  if (is_short) {
    const std::vector<std::uint16_t> short_indices(indices.begin(), indices.end());
    buffer->writeData(0, buffer->getSizeInBytes(), short_indices.data(), true);
  } else {
    buffer->writeData(0, buffer->getSizeInBytes(), indices.data(), true);
  }
  level.indices->indexBuffer = buffer;
  levels_.push_back(std::move(level));
}

ChunkGeometry ChunkRenderable::read_back() const {
  ChunkGeometry geometry;
  const auto vertices = mRenderOp.vertexData->vertexBufferBinding->getBuffer(0);
  std::vector<PackedVertex> packed(mRenderOp.vertexData->vertexCount);
  vertices->readData(0, vertices->getSizeInBytes(), packed.data());
  geometry.vertices.reserve(packed.size());
  for (const PackedVertex& vertex : packed) {
    geometry.vertices.push_back(packing_.unpack(vertex));
  }
  const Ogre::IndexData& finest = *levels_.front().indices;
  const auto indices = finest.indexBuffer;
  if (indices->getType() == Ogre::HardwareIndexBuffer::IT_16BIT) {
    std::vector<std::uint16_t> short_indices(finest.indexCount);
    indices->readData(0, indices->getSizeInBytes(), short_indices.data());
    geometry.indices.assign(short_indices.begin(), short_indices.end());
  } else {
    geometry.indices.resize(finest.indexCount);
    indices->readData(0, indices->getSizeInBytes(), geometry.indices.data());
  }
  return geometry;
}

float ChunkRenderable::pixels_per_metre(const Ogre::Camera& camera) const {
  const Ogre::Viewport* viewport = camera.getViewport();
  if (viewport == nullptr) {
    return kUnknownScale;
  }
  // Holds for rviz's orthographic views, too, which bring a projection of their own.
  const Ogre::Matrix4& projection = camera.getProjectionMatrix();
  const float at_unit_distance =
      0.5F * std::abs(projection[1][1]) * static_cast<float>(viewport->getActualHeight());
  if (projection[3][3] == 1.0F) {
    return at_unit_distance;
  }
  const Ogre::AxisAlignedBox& box = getWorldBoundingBox(true);
  const float nearest =
      (box.getCenter() - camera.getDerivedPosition()).length() - box.getHalfSize().length();
  return nearest > 0.0F ? at_unit_distance / nearest : kUnknownScale;
}

void ChunkRenderable::_notifyCurrentCamera(Ogre::Camera* camera) {
  SimpleRenderable::_notifyCurrentCamera(camera);
  const float scale = pixels_per_metre(*camera);
  std::size_t level = 0;
  while (level + 1 < levels_.size() && levels_[level + 1].cell_m * scale < kMaxLossPixels) {
    ++level;
  }
  mRenderOp.indexData = levels_[level].indices.get();
}

Ogre::Real ChunkRenderable::getSquaredViewDepth(const Ogre::Camera* camera) const {
  const Ogre::Vector3 center = getParentNode()->_getFullTransform() * getBoundingBox().getCenter();
  return (center - camera->getDerivedPosition()).squaredLength();
}

}  // namespace facet_mapping
