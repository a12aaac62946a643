// SPDX-License-Identifier: MIT
// Draws Burin's own frames as a session does: the surface's patches are given to the renderer as carving gives its
// tiles, frames follow one another, and nothing is read back.
#include "base/try.hpp"
#include "bench/frame/frame.hpp"
#include "compute/rays/normal_code.hpp"
#include "gpu/device.hpp"
#include "picture/frame_setup.hpp"
#include "renderer/frame/renderer.hpp"
#include "shaders/shared/srgb.h"

namespace burin::bench {
namespace {

std::uint32_t colour_code(const Vec3& colour) {
    const glm::uvec3 c(glm::round(255.0 * colour));
    return c.x | c.y << 8U | c.z << 16U | 255U << 24U;
}

class RendererSubject final : public FrameSubject {
public:
    RendererSubject(const FrameScene& scene, gpu::Device device, renderer::Renderer renderer, const FrameWay& way)
        : scene_(scene),
          way_(way),
          colour_(colour_code(scene.look.surface)),
          device_(std::move(device)),
          renderer_(std::move(renderer)) {
        drawn_.screen = scene.screen;
        drawn_.show_wall_frame = false;
        drawn_.show_grid = false;
        drawn_.background = scene.look.background;
        for (std::uint32_t i = 0; i < scene.patches.size(); ++i) set(i, scene.patches[i].vertices);
    }

    std::string name() const override { return "Burin"; }
    std::string note() const override { return "lit by lamp, sky and room, in sRGB"; }
    FrameWay way() const override { return way_; }

    Result<void> draw(const FrameStep& step) override {
        for (const PatchChange& change : step.changes) set(change.patch, change.vertices);
        drawn_.viewer = step.viewer;
        BURIN_TRY(commands, gpu::Commands::begin(device_));
        if (const auto recorded = renderer_.record(commands, drawn_); !recorded) {
            return std::unexpected(recorded.error());
        }
        BURIN_TRY(submission, std::move(commands).submit());
        return submission.wait();
    }

    // Does what a session's thread for levels of detail does beside the frames.
    Result<std::uint64_t> settle() override { return renderer_.surface().refine(static_cast<std::size_t>(-1)); }

    Result<StereoImage> picture() override { return renderer_.render(drawn_); }

    FrameCounters counters() const override {
        const renderer::RenderStats& s = renderer_.stats();
        const renderer::PatchCounts& p = s.patch_counts;
        double pixels = 0.0;
        for (const PixelRect& part : s.parts) pixels += static_cast<double>(part.width) * part.height;
        return {{"triangles", static_cast<double>(p.triangles)},
                {"draws", s.draws},
                {"patches", p.drawn},
                {"beside", p.beside},
                {"turned away", p.turned_away},
                {"behind", p.behind},
                {"coarser", p.coarser},
                {"vertex rate", p.vertex_rate},
                {"1000 pixels", 1e-3 * pixels},
                {"KiB brought over", static_cast<double>(s.uploaded_bytes) / 1024.0}};
    }

private:
    void set(std::uint32_t patch, const std::vector<FrameVertex>& vertices) {
        auto tile = std::make_shared<geometry::SurfaceTile>();
        tile->vertices.reserve(vertices.size());
        for (const FrameVertex& v : vertices) {
            const Vec3f& p = v.position_world_m;
            tile->vertices.push_back({p.x, p.y, p.z, compute::normal_code(Vec3(v.normal_world)), colour_});
        }
        tile->indices = scene_.patches[patch].indices;
        renderer_.surface().set_patch(patch, std::move(tile));
    }

    const FrameScene& scene_;
    FrameWay way_;
    std::uint32_t colour_;
    gpu::Device device_;
    renderer::Renderer renderer_;
    picture::Picture drawn_;
};

}  // namespace

Result<OwnSubject> open_own(const FrameScene& scene, const FrameOptions& options, const FrameWay& way) {
    renderer::Savings savings;
    savings.vertex_rate = way.lit_at == LitAt::vertices;
    savings.coarser_levels = way.levels;
    BURIN_TRY(device, gpu::Device::create({.index = options.device}));
    BURIN_TRY(renderer,
              renderer::Renderer::create(device, scene.size, {.samples = options.samples, .savings = savings}));
    std::string name = device.info().line();
    return OwnSubject{std::make_unique<RendererSubject>(scene, std::move(device), std::move(renderer), way),
                      std::move(name)};
}

BurinsLight burins_light(const FrameLook& look) {
    const picture::Picture scene;
    const shared::FrameUniforms frame = picture::frame_uniforms(scene, {});
    const shared::DrawConstants draw = picture::surface_constants(scene);
    return {Vec3(frame.light),
            Vec3(frame.light_colour),
            Vec3(frame.sky_colour),
            Vec3(frame.ground_colour),
            shared::linear_of(look.surface),
            draw.material.x,
            draw.material.y};
}

}  // namespace burin::bench
