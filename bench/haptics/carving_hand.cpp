// SPDX-License-Identifier: MIT
#include "bench/haptics/carving_hand.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "haptics/channels.hpp"
#include "sculpt/load_workpiece.hpp"
#include "toolbox/feel_options.hpp"
#include "toolbox/felt_tool.hpp"
#include "toolbox/tool_mesh.hpp"

namespace burin::bench {

std::shared_ptr<const geometry::TriangleMesh> six_sided_bar(double radius_m, double length_m) {
    auto bar = std::make_shared<geometry::TriangleMesh>();
    for (const double y : {0.0, length_m})
        for (int i = 0; i < 6; ++i) {
            const double angle = i * std::numbers::pi / 3.0;
            bar->positions_m.push_back({radius_m * std::cos(angle), y, radius_m * std::sin(angle)});
        }
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t next = (i + 1) % 6;
        bar->triangles.push_back({i, i + 6, next + 6});
        bar->triangles.push_back({i, next + 6, next});
        if (i == 0 || i == 5) continue;
        bar->triangles.push_back({0, i, i + 1});
        bar->triangles.push_back({6, i + 7, i + 6});
    }
    return bar;
}

namespace {

constexpr std::uint64_t kTicksAnUpdateOfTheSolid = 10;
constexpr Nanoseconds kCarvingTick_ns = 1'000'000;
// The way of a hand until the next update, at most, as in a session: 1 m/s for 12 ms.
constexpr double kGoesFarther_m = 0.012;

compute::Solid block_of(const CarvedBlock& block, WorkerPool& pool) {
    const std::string source = "block:" + std::to_string(block.size_m.x) + "," + std::to_string(block.size_m.y) + "," +
                               std::to_string(block.size_m.z);
    return sculpt::load_workpiece({.source = source, .resolution = block.resolution}, pool)->solid;
}

}  // namespace

std::vector<CarvingTool> carving_tools() {
    return {{"ball", compute::BallTool{0.0015}},
            {"mill", compute::CylinderTool{0.001, 0.006}},
            {"cone", compute::ConeTool{0.0005, 0.002, 0.006}},
            {"bull-nose", compute::BullNoseTool{0.0015, 0.0005, 0.006}},
            {"box", compute::BoxTool{{0.002, 0.0015, 0.0025}}},
            {"bar", compute::MeshTool{six_sided_bar(0.0015, 0.005)}}};
}

CarvingHand::CarvingHand(const compute::ToolShape& tool, const CarvedBlock& block)
    : sculpture_(std::make_unique<sculpt::Sculpture>(compute::make_cpu_engine(block_of(block, pool_), pool_), pool_)),
      channels_(std::make_unique<haptics::HapticChannels>(64, 64)),
      loop_(device_, clock_, *channels_) {
    tool_.shape = tool;
    const toolbox::FeltTool felt = toolbox::felt_tool(tool);
    parameters_.probe = felt.probe;
    parameters_.action = toolbox::action_of(compute::Operation::cut);
    parameters_.materials.fill(toolbox::touch_material({}));
    parameters_.shape = felt.shape;
    parameters_.tool = felt.surface;
    stiffness_N_per_m_ = material().stiffness_N_per_m;
    origin_m_ = Vec3(0.5 * block.size_m.x, block.size_m.y + toolbox::tip_m(tool), 0.5 * block.size_m.z);
    const double reach_m = kGoesFarther_m + 2.0 * sculpture_->surface().lattice().spacing_m;
    scene_ = std::make_unique<sculpt::CarvedScene>(*sculpture_, *channels_, tool_, material().hardness_Ns_per_m3,
                                                   reach_m, std::nullopt);
    scene_->start_at(origin_m_ + Vec3(0.0, 0.01, 0.0));
    static_cast<void>(scene_->update(clock_.now_ns()));
}

const haptics::TickRecord& CarvingHand::go_to(const Vec3& tip_m, bool pressed) {
    tick(origin_m_ + tip_m, pressed);
    return record_;
}

const haptics::TickRecord& CarvingHand::press(double force_N) {
    tick(record_.contact.cut_object_m - Vec3(0.0, force_N / stiffness_N_per_m_, 0.0), true);
    return record_;
}

double CarvingHand::removed_mm3() const {
    return 1e9 * (sculpture_->initial_volume_m3() - sculpture_->surface().volume_m3());
}

void CarvingHand::tick(const Vec3& hand_m, bool pressed) {
    clock_.sleep_until(clock_.now_ns() + kCarvingTick_ns);
    device_.go_to(hand_m, Quat{1.0, 0.0, 0.0, 0.0}, clock_.now_ns(), pressed ? 1u : 0u);
    parameters_.sequence = ++ticks_;
    channels_->parameters.draft() = parameters_;
    channels_->parameters.publish();
    loop_.step();
    static_cast<void>(channels_->records.pop(record_));
    const double rendered = record_.contact.points[0].rendered.stiffness_N_per_m;
    if (rendered > 0.0) stiffness_N_per_m_ = rendered;
    if (ticks_ % kTicksAnUpdateOfTheSolid == 0) static_cast<void>(scene_->update(clock_.now_ns()));
}

PlungedAreas plunged_areas(const geometry::TriangleMesh& mesh, double depth_m) {
    double top_m = HUGE_VAL;
    for (const Vec3& p : mesh.positions_m) top_m = std::min(top_m, p.y);
    top_m += depth_m;
    PlungedAreas areas;
    std::vector<Vec3> below;
    for (const auto& t : mesh.triangles) {
        const std::array<Vec3, 3> corners{mesh.positions_m[t[0]], mesh.positions_m[t[1]], mesh.positions_m[t[2]]};
        below.clear();
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 &a = corners[i], &b = corners[(i + 1) % 3];
            if (a.y <= top_m) below.push_back(a);
            if ((a.y < top_m) != (b.y < top_m) && a.y != b.y)
                below.push_back(a + (b - a) * ((top_m - a.y) / (b.y - a.y)));
        }
        Vec3 area(0.0);
        for (std::size_t i = 2; i < below.size(); ++i)
            area += 0.5 * glm::cross(below[i - 1] - below[0], below[i] - below[0]);
        if (!(area.y < 0.0)) continue;
        areas.section_m2 -= area.y;
        areas.into_m2 += area.y * area.y / glm::length(area);
    }
    return areas;
}

}  // namespace burin::bench
