// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "sim/render/offscreen.hpp"

#include "core/error.hpp"
#include "sim/world/mujoco_session.hpp"

#include <GL/gl.h>
#include <GL/osmesa.h>

#include <algorithm>
#include <array>
#include <mutex>

namespace mapscore::sim {
namespace {

struct OsmesaDeleter {
  void operator()(osmesa_context* context) const { OSMesaDestroyContext(context); }
};

/// One thread at a time may call OpenGL. All contexts of OSMesa share a screen of llvmpipe, which
/// looks through the scenes of every context, without a lock, whenever one reads or writes pixels
/// (llvmpipe_flush_resource, Mesa 21 and later): a context that draws meanwhile frees what is
/// looked at. Little is lost, since the threads that fill pixels are shared by all contexts, too.
/// MuJoCo looks OpenGL's functions up at the first context, without a lock of its own.
std::mutex& opengl_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

struct Offscreen::Context {
  std::unique_ptr<osmesa_context, OsmesaDeleter> osmesa;
  std::array<unsigned char, 4 * 16 * 16> window{};  ///< OSMesa wants one; drawing goes off screen
  mjrContext mujoco;

  void make_current() {
    if (!OSMesaMakeCurrent(osmesa.get(), window.data(), GL_UNSIGNED_BYTE, 16, 16))
      throw Error("OSMesa: the context cannot be made current; check the Mesa installation");
  }
};

Offscreen::Offscreen(const mjModel& model, bool coarse) : context_(std::make_unique<Context>()) {
  quiet_mujoco();
  constexpr int kDepthBits = 24, kStencilBits = 8, kAccumulationBits = 0;
  const std::scoped_lock lock(opengl_mutex());
  context_->osmesa.reset(
      OSMesaCreateContextExt(OSMESA_RGBA, kDepthBits, kStencilBits, kAccumulationBits, nullptr));
  if (!context_->osmesa) throw Error("OSMesa: no context; install libosmesa6");
  context_->make_current();
  mjr_defaultContext(&context_->mujoco);
  mjModel drawn = model;  // shares what it points to; only read, and only here
  if (coarse) drawn.vis.quality.numquads = 1;
  mjr_makeContext(&drawn, &context_->mujoco, mjFONTSCALE_50);
  mjr_setBuffer(mjFB_OFFSCREEN, &context_->mujoco);
  if (context_->mujoco.currentBuffer != mjFB_OFFSCREEN)
    throw Error("OpenGL: no off-screen buffer; check the Mesa installation");
  context_->mujoco.readDepthMap = mjDEPTH_ZEROFAR;
  context_->mujoco.readPixelFormat = GL_BGR;
}

Offscreen::~Offscreen() {
  const std::scoped_lock lock(opengl_mutex());
  if (OSMesaMakeCurrent(context_->osmesa.get(), context_->window.data(), GL_UNSIGNED_BYTE, 16, 16))
    mjr_freeContext(&context_->mujoco);
  OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);  // before it is destroyed
}

void Offscreen::draw(int width_px, int height_px, mjvScene& scene) {
  const std::scoped_lock lock(opengl_mutex());
  context_->make_current();
  mjrContext& mujoco = context_->mujoco;
  if (width_px > mujoco.offWidth || height_px > mujoco.offHeight) {
    mjr_resizeOffscreen(std::max(width_px, mujoco.offWidth), std::max(height_px, mujoco.offHeight),
                        &mujoco);
    mjr_setBuffer(mjFB_OFFSCREEN, &mujoco);
  }
  width_px_ = width_px;
  height_px_ = height_px;
  mjr_render({0, 0, width_px, height_px}, &scene, &mujoco);
  std::array<float, 16> projection{};  // column-major
  glGetFloatv(GL_PROJECTION_MATRIX, projection.data());
  depth_scale_ = {projection[14], projection[10]};
}

void Offscreen::read(cv::Mat3b& bgr, cv::Mat1f* depth) const {
  bgr.create(height_px_, width_px_);
  if (depth) depth->create(height_px_, width_px_);
  const std::scoped_lock lock(opengl_mutex());
  mjr_readPixels(bgr.data, depth ? depth->ptr<float>() : nullptr, {0, 0, width_px_, height_px_},
                 &context_->mujoco);
}

}  // namespace mapscore::sim
