// SPDX-License-Identifier: MIT
// Measures ticks of tools that touch with their shape, about 3 mm wide: on detailed meshes, and in a groove that the
// same tool carved. Whole steps of the loop in simulated time, so that the figures are the same everywhere.
#include <algorithm>
#include <functional>
#include <memory>

#include "base/try.hpp"
#include "bench/haptics/carving_hand.hpp"
#include "bench/haptics/hand_path.hpp"
#include "bench/haptics/haptics.hpp"
#include "bench/haptics/touch_run.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "sculpt/carved_scene.hpp"
#include "toolbox/felt_tool.hpp"

namespace burin::bench {
namespace {

constexpr double kShapeGroove_m = 0.0015, kPressedDeeper_m = 0.001;
constexpr double kAboveShape_m = 0.012;

struct ShapeTool {
    std::string name;
    compute::ToolShape shape;
};

std::vector<ShapeTool> shape_tools() {
    return {{"mill", compute::CylinderTool{0.001, 0.006}},
            {"cone", compute::ConeTool{0.0005, 0.002, 0.006}},
            {"bull-nose", compute::BullNoseTool{0.0015, 0.0005, 0.006}},
            {"box", compute::BoxTool{{0.002, 0.0015, 0.0025}}},
            {"mesh", compute::MeshTool{six_sided_bar(0.0015, 0.005)}}};
}

class ShapeRun {
public:
    using Publish = std::function<Result<void>(geometry::LocalSurface& draft, const Vec3& hip_m)>;

    ShapeRun(const ShapeTool& tool, PressedWalk path, ShapeTicks& figures) : path_(std::move(path)), figures_(figures) {
        const toolbox::FeltTool felt = toolbox::felt_tool(tool.shape);
        on_ = session_parameters(felt.probe, true);
        on_.shape = felt.shape;
        on_.tool = felt.surface;
        off_ = on_;
        off_.enabled = false;
    }
    // Takes so many ticks with the hand down.
    Result<void> take(std::uint64_t ticks, const Publish& publish) {
        for (std::uint64_t turn = 0, counted = 0; counted < ticks; ++turn) {
            clock_.sleep_until(clock_.now_ns() + loop_.period_ns());
            path_.step();
            device_.go_to(path_.hip_m(), path_.orientation(), clock_.now_ns());
            haptics::TickParameters& parameters = channels_->parameters.draft();
            parameters = path_.lifted() ? off_ : on_;
            parameters.sequence = turn + 1;
            channels_->parameters.publish();
            if (turn % TouchRun::kTicksAnUpdate == 0) {
                geometry::LocalSurface& draft = channels_->surface.draft();
                BURIN_TRY_DO(publish(draft, path_.hip_m()));
                draft.sequence = turn + 1, draft.made_ns = clock_.now_ns();
                channels_->surface.publish();
            }
            loop_.step();
            haptics::TickRecord record;
            if (!channels_->records.pop(record)) continue;
            for (haptics::TickRecord read; channels_->ticks.pop(read);) continue;
            if (path_.pressed()) count(record), ++counted;
            proxy_m_ = record.deepest().proxy_object_m;
        }
        return {};
    }

private:
    void count(const haptics::TickRecord& record) {
        ++figures_.ticks;
        figures_.in_contact += record.in_contact() ? 1 : 0;
        const bool limited = (record.flags & haptics::kTickWorkLimited) != 0;
        figures_.limited += limited ? 1 : 0;
        // The hand moves by a tenth of a millimetre a tick.
        const double went_m = glm::length(record.deepest().proxy_object_m - proxy_m_);
        const bool frozen = limited && record.in_contact() && went_m < 1e-4 * on_.shape.rounding_m;
        frozen_now_ = frozen ? frozen_now_ + 1 : 0;
        figures_.frozen += frozen ? 1 : 0;
        figures_.frozen_in_a_row = std::max(figures_.frozen_in_a_row, frozen_now_);
        figures_.cost_us.push_back(1e-3 * haptics::cost_ns(record.contact.work));
    }

    PressedWalk path_;
    ShapeTicks& figures_;
    PathDevice device_;
    std::unique_ptr<haptics::HapticChannels> channels_ = std::make_unique<haptics::HapticChannels>(64, 64);
    SimulatedClock clock_;
    haptics::HapticLoop loop_{device_, clock_, *channels_};
    haptics::TickParameters on_, off_;
    Vec3 proxy_m_{0.0};
    std::uint64_t frozen_now_ = 0;
};

ShapeTicks& shape_ticks(Haptics& all, const std::string& scene, const ShapeTool& tool, std::size_t triangles) {
    ShapeTicks& figures = all.shapes.emplace_back();
    figures.scene = scene, figures.tool = tool.name, figures.triangles = triangles;
    return figures;
}

Result<void> touch_mesh_with(Haptics& all, const TouchedScene& scene, const ShapeTool& tool) {
    ShapeTicks& figures = shape_ticks(all, scene.name, tool, scene.snapshot->triangles());
    ShapeRun run(tool, PressedWalk(scene.walk, {.above_m = kAboveShape_m}), figures);
    return run.take(all.options.shape_ticks, [&](geometry::LocalSurface& draft, const Vec3&) -> Result<void> {
        fill(draft, scene, 0, 0);
        return {};
    });
}

// A groove along the way that the hand goes, by the tool as it is turned there.
Result<void> carve_with(const Haptics& all, sculpt::Sculpture& sculpture, const ShapeTool& tool, PressedWalk path) {
    toolbox::Tool cuts;
    cuts.shape = tool.shape;
    const double tolerance_m = 0.05 * sculpture.surface().lattice().spacing_m;
    std::vector<Pose> poses;
    for (std::uint64_t pressed = 0;;) {
        path.step();
        if (path.lifted() && poses.size() > 1) {
            const auto sweeps = toolbox::sweeps_along(poses, cuts, tolerance_m);
            BURIN_TRY_DO(sculpture.update(sweeps));
            poses.clear();
            if (pressed >= all.options.shape_ticks) return {};
        }
        if (path.pressed()) ++pressed;
        if (!path.lifted()) poses.push_back({path.hip_m(), path.orientation()});
    }
}

Result<void> touch_groove_with(Haptics& all, int resolution, const ShapeTool& tool) {
    const BumpySphere ball{.bumps = 0.0};
    BURIN_TRY(solid, compute::make_ball(ball.radius_m, resolution, geometry::Material{}));
    WorkerPool pool(1);
    sculpt::Sculpture sculpture(compute::make_cpu_engine(std::move(solid), pool), pool);
    const auto way = [&](double depth_m) {
        return PressedWalk::create(mesh_of(ball, 40), {.depth_m = depth_m, .above_m = kAboveShape_m});
    };
    const Result<PressedWalk> carved = way(kShapeGroove_m), pressed = way(kShapeGroove_m + kPressedDeeper_m);
    if (!carved) return std::unexpected(carved.error());
    if (!pressed) return std::unexpected(pressed.error());
    BURIN_TRY_DO(carve_with(all, sculpture, tool, *carved));
    ShapeTicks& figures =
        shape_ticks(all, "groove_" + std::to_string(resolution), tool, sculpture.surface().triangles());
    ShapeRun run(tool, *pressed, figures);
    const double reach_m = 0.02 + 2.0 * sculpture.surface().lattice().spacing_m;
    return run.take(all.options.shape_ticks, [&](geometry::LocalSurface& draft, const Vec3& hip_m) -> Result<void> {
        sculpture.local_surface(hip_m, reach_m, draft);
        return {};
    });
}

}  // namespace

Result<void> measure_shapes(Haptics& all, const Tell& notify) {
    const auto on_meshes = on_rough_scenes(all, notify, "shapes", [&](const TouchedScene& scene) -> Result<void> {
        for (const ShapeTool& tool : shape_tools()) BURIN_TRY_DO(touch_mesh_with(all, scene, tool));
        return {};
    });
    if (!on_meshes) return on_meshes;
    for (const int resolution : all.options.solid_resolutions)
        for (const ShapeTool& tool : shape_tools()) {
            notify("shapes in a groove, " + std::to_string(resolution) + " cells, " + tool.name);
            BURIN_TRY_DO(touch_groove_with(all, resolution, tool));
        }
    return {};
}

}  // namespace burin::bench
