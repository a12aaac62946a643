// SPDX-License-Identifier: MIT
#include "bench/haptics/turned_scene.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "bench/measure/bumpy_sphere.hpp"
#include "geometry/contact/touch_mesh.hpp"
#include "haptics/channels.hpp"
#include "toolbox/feel_options.hpp"
#include "toolbox/felt_tool.hpp"
#include "toolbox/tool_mesh.hpp"

namespace burin::bench {
namespace {

constexpr double kBallRadius_m = 0.03, kTurnedDeep_m = 0.001, kTurnedTick_s = 1e-3;
constexpr int kSquares = 96;  // edges of 0.5 mm: the facets are within a micrometre of the ball
constexpr int kTicksDown = 400, kTicksTurned = 1000, kTicksAfter = 500;  // ticks
constexpr double kPicture_s = 1.0 / 60.0;

// The place of the piece in the world, which is the device's frame. The axis is no axis of any frame, and the tool lies
// neither on it nor square to it.
const Vec3 kMiddle_world(0.012, -0.028, 0.007), kMiddle_object(0.05, 0.02, -0.03);
const Vec3 kAxis = glm::normalize(Vec3(0.4, 0.35, 1.0)), kOut = glm::normalize(Vec3(0.15, 1.0, -0.1));
const Quat kPlaced = glm::angleAxis(0.7, glm::normalize(Vec3(0.3, -1.0, 0.5)));

const std::shared_ptr<const geometry::TouchSnapshot>& touched_ball() {
    static const auto snapshot = [] {
        geometry::TriangleMesh mesh = mesh_of({.radius_m = kBallRadius_m, .bumps = 0.0}, kSquares);
        for (Vec3& p : mesh.positions_m) p += kMiddle_object;
        return geometry::TouchMesh::create(mesh)->snapshot();
    }();
    return snapshot;
}

// A tool that stands on the piece there.
Quat upright(const Vec3& out) {
    const Vec3 up(0.0, 1.0, 0.0);
    return glm::angleAxis(std::acos(glm::dot(up, out)), glm::normalize(glm::cross(up, out)));
}

Similarity object_from_world(double turned_rad) {
    const Quat world_from_object = glm::angleAxis(turned_rad, kAxis) * kPlaced;
    return inverse(Similarity{kMiddle_world - world_from_object * kMiddle_object, world_from_object, 1.0});
}

// By how much the piece has turned that is mapped so.
double turned_rad(const Similarity& object_from_device) {
    const Quat q = glm::conjugate(object_from_device.orientation) * glm::conjugate(kPlaced);
    return 2.0 * std::atan2(glm::dot(Vec3(q.x, q.y, q.z), kAxis), q.w);
}

class TurnedPiece {
public:
    TurnedPiece(const compute::ToolShape& tool, const Turning& turning)
        : turning_(turning),
          channels_(std::make_unique<haptics::HapticChannels>(64, 64)),
          loop_(device_, clock_, *channels_) {
        const toolbox::FeltTool felt = toolbox::felt_tool(tool);
        haptics::TouchMaterial material = toolbox::touch_material({});
        if (!turning.friction) material.static_friction = material.dynamic_friction = 0.0;
        parameters_.materials.fill(material);
        parameters_.action = toolbox::action_of(compute::Operation::cut);
        parameters_.probe = felt.probe;
        parameters_.shape = felt.shape;
        parameters_.tool = felt.surface;
        parameters_.max_surface_age_s = 0.0;
        parameters_.workspace.placed = 1;
        tip_m_ = toolbox::tip_m(tool);
        geometry::LocalSurface& draft = channels_->surface.draft();
        draft.sequence = 1;
        draft.radius_m = 1e3;
        draft.meshes.push_back({touched_ball(), 0});
        draft.origin_object = draft.meshes[0].snapshot->origin_object;
        channels_->surface.publish();
    }

    // height_m: of the tool's lowest place above the surface.
    const haptics::TickRecord& tick(double height_m, double turned_rad) {
        clock_.sleep_until(clock_.now_ns() + 1'000'000);
        if (const auto picture = static_cast<std::uint64_t>(seconds(clock_.now_ns()) / kPicture_s);
            picture != picture_) {
            picture_ = picture;
            published_rad_ = turned_rad;
            publish();
        }
        const Quat carried = glm::angleAxis(turning_.along ? turned_rad : 0.0, kAxis);
        const Vec3 out = carried * kOut;
        device_.go_to(kMiddle_world + (kBallRadius_m + tip_m_ + height_m) * out, carried * upright(kOut),
                      clock_.now_ns());
        loop_.step();
        static_cast<void>(channels_->records.pop(record_));
        normal_device_ = out;
        return record_;
    }
    [[nodiscard]] const haptics::TickRecord& record() const { return record_; }
    [[nodiscard]] Vec3 normal_device() const { return normal_device_; }
    [[nodiscard]] double published_rad() const { return published_rad_; }
    [[nodiscard]] double felt_rad() const { return turned_rad(record_.motion.object_from_device); }
    [[nodiscard]] double dynamic_friction() const { return parameters_.materials[0].dynamic_friction; }

private:
    void publish() {
        parameters_.workspace.object_from_device = object_from_world(published_rad_);
        if (!turning_.follows) ++parameters_.workspace.placed;
        ++parameters_.sequence;
        channels_->parameters.draft() = parameters_;
        channels_->parameters.publish();
    }

    Turning turning_;
    std::unique_ptr<haptics::HapticChannels> channels_;
    PathDevice device_;
    SimulatedClock clock_;
    haptics::HapticLoop loop_;
    haptics::TickParameters parameters_;
    haptics::TickRecord record_;
    Vec3 normal_device_{0.0, 1.0, 0.0};
    double tip_m_ = 0.0, published_rad_ = 0.0;
    std::uint64_t picture_ = 0;
};

}  // namespace

TurnedUnder turn_under(const compute::ToolShape& tool, const Turning& turning) {
    TurnedPiece piece(tool, turning);
    const double speed_rad_per_s = turning.speed_deg_per_s * std::numbers::pi / 180.0;
    for (int i = 0; i < kTicksDown; ++i) piece.tick(std::max(kTurnedDeep_m - 2e-5 * i, -kTurnedDeep_m), 0.0);
    TurnedUnder figures;
    figures.least_N = HUGE_VAL;
    figures.dynamic_friction = piece.dynamic_friction();
    const int ticks = kTicksTurned + (turning.stops_after_s < 1.0 ? kTicksAfter : 0);
    Vec3 halfway_object(0.0);
    for (int i = 1; i <= ticks; ++i) {
        const double turned = speed_rad_per_s * std::min(kTurnedTick_s * i, turning.stops_after_s);
        const haptics::TickRecord& record = piece.tick(-kTurnedDeep_m, turned);
        ++figures.ticks;
        figures.limited += (record.flags & haptics::kTickWorkLimited) != 0 ? 1 : 0;
        figures.let_go += (record.flags & haptics::kTickLetGo) != 0 ? 1 : 0;
        figures.set_anew += (record.flags & haptics::kTickProxyReset) != 0 ? 1 : 0;
        const Vec3 force = record.gate.given.force_device_N, normal = piece.normal_device();
        const double pressed_N = glm::dot(force, normal);
        const Vec3 beside_N = force - pressed_N * normal;
        const Vec3 way = glm::normalize(glm::cross(kAxis, normal));
        figures.mean_N += pressed_N / ticks;
        figures.least_N = std::min(figures.least_N, pressed_N);
        figures.most_N = std::max(figures.most_N, pressed_N);
        figures.last_beside = glm::length(beside_N) / pressed_N;
        figures.most_beside = std::max(figures.most_beside, figures.last_beside);
        figures.last_along = glm::dot(beside_N, way) / pressed_N;
        figures.most_beyond_rad = std::max(figures.most_beyond_rad, piece.felt_rad() - piece.published_rad());
        figures.late_rad = turned - piece.felt_rad();
        const Vec3 proxy_object = record.contact.points[0].proxy_object_m;
        if (2 * i == ticks) halfway_object = proxy_object;
        if (2 * i >= ticks) figures.moved_m = std::max(figures.moved_m, glm::length(proxy_object - halfway_object));
    }
    return figures;
}

}  // namespace burin::bench
