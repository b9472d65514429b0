// SPDX-FileCopyrightText: facet_mapping contributors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "chunk_renderable.h"

#include <memory>

#include <OgreCamera.h>
#include <OgreHardwareBufferManager.h>
#include <OgreNode.h>

namespace facet_mapping {
namespace {

constexpr std::size_t kMaxShortIndex = 65535;

Ogre::Vector3 to_ogre(const Eigen::Vector3f& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

ChunkRenderable::ChunkRenderable(const ChunkGeometry& geometry) {
  upload_vertices(geometry);
  upload_indices(geometry);
  mRenderOp.operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
  mRenderOp.useIndexes = true;
  setBoundingBox({to_ogre(geometry.box.min()), to_ogre(geometry.box.max())});
  radius_ = geometry.box.min().cwiseAbs().cwiseMax(geometry.box.max().cwiseAbs()).norm();
}

ChunkRenderable::~ChunkRenderable() {
  // Ogre's render operations do not own their data.
  delete mRenderOp.vertexData;
  delete mRenderOp.indexData;
}

void ChunkRenderable::upload_vertices(const ChunkGeometry& geometry) {
  auto data = std::make_unique<Ogre::VertexData>();
  data->vertexCount = geometry.vertices.size();
  Ogre::VertexDeclaration* layout = data->vertexDeclaration;
  layout->addElement(0, offsetof(FacetVertex, position), Ogre::VET_FLOAT3, Ogre::VES_POSITION);
  layout->addElement(0, offsetof(FacetVertex, normal), Ogre::VET_BYTE4_NORM, Ogre::VES_NORMAL);
  layout->addElement(0, offsetof(FacetVertex, facet), Ogre::VET_UBYTE4_NORM, Ogre::VES_DIFFUSE);
  const auto buffer = Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
      sizeof(FacetVertex), data->vertexCount, Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
  buffer->writeData(0, buffer->getSizeInBytes(), geometry.vertices.data(), true);
  data->vertexBufferBinding->setBinding(0, buffer);
  mRenderOp.vertexData = data.release();
}

void ChunkRenderable::upload_indices(const ChunkGeometry& geometry) {
  const bool is_short = geometry.vertices.size() <= kMaxShortIndex;
  auto data = std::make_unique<Ogre::IndexData>();
  data->indexCount = geometry.indices.size();
  data->indexBuffer = Ogre::HardwareBufferManager::getSingleton().createIndexBuffer(
      is_short ? Ogre::HardwareIndexBuffer::IT_16BIT : Ogre::HardwareIndexBuffer::IT_32BIT,
      data->indexCount,
      Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
  const std::size_t bytes = data->indexBuffer->getSizeInBytes();
  if (is_short) {
    const std::vector<std::uint16_t> indices(geometry.indices.begin(), geometry.indices.end());
    data->indexBuffer->writeData(0, bytes, indices.data(), true);
  } else {
    data->indexBuffer->writeData(0, bytes, geometry.indices.data(), true);
  }
  mRenderOp.indexData = data.release();
}

Ogre::Real ChunkRenderable::getSquaredViewDepth(const Ogre::Camera* camera) const {
  const Ogre::Vector3 center = getParentNode()->_getFullTransform() * getBoundingBox().getCenter();
  return (center - camera->getDerivedPosition()).squaredLength();
}

}  // namespace facet_mapping
