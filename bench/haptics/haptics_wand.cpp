// SPDX-License-Identifier: MIT
// Measures what the second end of a wand costs: a short wand is taken through the tube of assets/worlds along
// assets/strokes/tube.csv, so that its ends touch the wall in turn and together, once with both ends and once with each
// alone. In simulated time and by counts, so that the figures are the same everywhere.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <tuple>
#include <utility>

#include "base/assets.hpp"
#include "base/try.hpp"
#include "bench/haptics/hand_path.hpp"
#include "bench/haptics/haptics.hpp"
#include "bench/haptics/touch_run.hpp"
#include "geometry/vrml/vrml_shapes.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "sculpt/stroke_file.hpp"

namespace burin::bench {
namespace {

std::string tube_file() { return asset_path("worlds/tube.wrl"); }
std::string stroke_through_tube() { return asset_path("strokes/tube.csv"); }
constexpr double kEnd_m = 0.02, kEndBall_m = 0.004;  // as assets/devices/short-wand.toml, and burin world's --radius

Result<geometry::TriangleMesh> tube_wall() {
    const auto file = geometry::read_vrml_file(tube_file());
    if (!file) return std::unexpected(file.error());
    const auto world = geometry::shapes_of(*file);
    if (!world) return std::unexpected(world.error().front());
    for (const geometry::VrmlShape& shape : world->shapes) {
        if (shape.name != "Tube") continue;
        geometry::TriangleMesh mesh = shape.surface->mesh;
        for (Vec3& p : mesh.positions_m) p = Vec3(shape.world_from_shape * glm::dvec4(p, 1.0));
        return mesh;
    }
    return fail(tube_file(), "holds no Tube", "take the file that comes with the program");
}

haptics::Probe ends(bool top, bool bottom) {
    haptics::Probe probe;
    probe.count = 0;
    if (top) probe.points[probe.count++] = {{0.0, kEnd_m, 0.0}, kEndBall_m};
    if (bottom) probe.points[probe.count++] = {{0.0, -kEnd_m, 0.0}, kEndBall_m};
    return probe;
}

// The pose of the handle at a time: between rows positions go straight and turns evenly.
Pose on_stroke(const sculpt::Stroke& stroke, double time_s) {
    const auto after = std::ranges::find_if(stroke, [&](const sculpt::StrokeRow& row) { return row.time_s >= time_s; });
    if (after == stroke.begin()) return {after->position_object_m, after->orientation_object};
    if (after == stroke.end()) return {stroke.back().position_object_m, stroke.back().orientation_object};
    const sculpt::StrokeRow &a = *(after - 1), &b = *after;
    const double t = (time_s - a.time_s) / (b.time_s - a.time_s);
    return {glm::mix(a.position_object_m, b.position_object_m, t),
            glm::normalize(glm::slerp(a.orientation_object, b.orientation_object, t))};
}

class WandRun {
public:
    WandRun(std::shared_ptr<const geometry::TouchSnapshot> wall, const haptics::Probe& probe, WandWork& figures)
        : wall_(std::move(wall)), figures_(figures), loop_(device_, clock_, channels_) {
        channels_.parameters.draft() = session_parameters(probe, true);
        channels_.parameters.draft().action = haptics::ToolAction::touch;
        channels_.parameters.publish();
    }

    void take(const sculpt::Stroke& stroke, std::uint64_t ticks) {
        const double whole_s = stroke.back().time_s - stroke.front().time_s;
        for (std::uint64_t tick = 0; tick < ticks; ++tick) {
            clock_.sleep_until(clock_.now_ns() + loop_.period_ns());
            const double share = static_cast<double>(tick) / static_cast<double>(ticks);
            const Pose pose = on_stroke(stroke, stroke.front().time_s + share * whole_s);
            device_.go_to(pose.position_m, pose.orientation, clock_.now_ns());
            if (tick % TouchRun::kTicksAnUpdate == 0) publish(tick + 1);
            const haptics::TickRecord record = loop_.step();
            for (haptics::TickRecord read; channels_.records.pop(read);) continue;
            for (haptics::TickRecord read; channels_.ticks.pop(read);) continue;
            figures_.cost_us.push_back(1e-3 * haptics::cost_ns(record.contact.work));
            figures_.in_contact += record.in_contact() ? 1 : 0;
        }
    }

private:
    void publish(std::uint64_t sequence) {
        geometry::LocalSurface& draft = channels_.surface.draft();
        draft.sequence = sequence;
        draft.made_ns = clock_.now_ns();
        draft.radius_m = 1e3;
        draft.meshes.assign(1, {wall_, 0, true});
        channels_.surface.publish();
    }

    std::shared_ptr<const geometry::TouchSnapshot> wall_;
    WandWork& figures_;
    SimulatedClock clock_;
    PathDevice device_;
    haptics::HapticChannels channels_{64, 64};
    haptics::HapticLoop loop_;
};

}  // namespace

Result<void> measure_wand(Haptics& all, const Tell& notify) {
    std::error_code ignored;
    if (!std::filesystem::exists(tube_file(), ignored) || !std::filesystem::exists(stroke_through_tube(), ignored)) {
        all.notes.push_back(tube_file() + " is not here: set BURIN_ASSETS to touch it with a wand");
        return {};
    }
    notify("a wand in the tube");
    BURIN_TRY(mesh, tube_wall());
    BURIN_TRY(stroke, sculpt::read_stroke(stroke_through_tube()));
    BURIN_TRY(wall, geometry::TouchMesh::create(mesh));
    for (const auto& [name, top, bottom] :
         {std::tuple{"both", true, true}, std::tuple{"top", true, false}, std::tuple{"bottom", false, true}}) {
        WandWork& work = all.wand.emplace_back();
        work.points = name;
        WandRun(wall.snapshot(), ends(top, bottom), work).take(stroke, all.options.wand_ticks);
    }
    return {};
}

}  // namespace burin::bench
