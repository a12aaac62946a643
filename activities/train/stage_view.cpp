// SPDX-License-Identifier: MIT
#include "activities/train/stage_view.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "study/metrics/path.hpp"
#include "study/trial/stage_step.hpp"

namespace burin::activities {
namespace {

constexpr double kStageBall_m = 0.006, kStageRod_m = 0.0022;
const Vec3 kRed{0.80, 0.12, 0.10}, kGreen{0.10, 0.60, 0.18}, kRodGrey{0.25, 0.25, 0.28};
constexpr std::uint32_t kRound = 24;

// A surface of revolution about y: rings at heights with radii, from the bottom to the top; poles are rings of 0.
std::shared_ptr<const picture::DrawnMesh> turned(const std::vector<Vec2>& radius_height_m) {
    geometry::TriangleMesh mesh;
    for (const Vec2& at : radius_height_m) {
        for (std::uint32_t k = 0; k < kRound; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / kRound;
            mesh.positions_m.emplace_back(at.x * std::cos(angle), at.y, -at.x * std::sin(angle));
        }
    }
    for (std::uint32_t row = 1; row < radius_height_m.size(); ++row) {
        const std::uint32_t second = row * kRound, first = second - kRound;
        for (std::uint32_t k = 0; k < kRound; ++k) {
            const std::uint32_t next = (k + 1) % kRound;
            mesh.triangles.push_back({first + k, first + next, second + next});
            mesh.triangles.push_back({first + k, second + next, second + k});
        }
    }
    return picture::drawn_mesh(mesh);
}

// The place after so much way along the spine, to its end, back to its start, and so on.
Vec3 place_on_path(const std::vector<Vec3>& spine_m, double way_m) {
    const double length_m = study::path_length_m(spine_m);
    const double round_m = std::fmod(way_m, 2.0 * length_m);
    double left_m = round_m <= length_m ? round_m : 2.0 * length_m - round_m;
    for (std::size_t i = 1; i < spine_m.size(); ++i) {
        const double piece_m = glm::distance(spine_m[i - 1], spine_m[i]);
        if (left_m <= piece_m) return spine_m[i - 1] + (left_m / piece_m) * (spine_m[i] - spine_m[i - 1]);
        left_m -= piece_m;
    }
    return spine_m.back();
}

// From as far as shows the whole world, and a wand that is held above it.
void stand_back(picture::Picture& scene) {
    constexpr double kFarther = 1.45;
    wall::Screen& screen = scene.screen;
    const Vec3 middle = 0.5 * (screen.lower_right_world + screen.upper_left_world);
    for (Vec3* corner : {&screen.lower_left_world, &screen.lower_right_world, &screen.upper_left_world})
        *corner = middle + kFarther * (*corner - middle);
    Vec3& head = scene.viewer.head_world.position_m;
    head = middle + kFarther * (head - middle);
}

}  // namespace

std::shared_ptr<const picture::DrawnMesh> point_ball() {
    std::vector<Vec2> rings;
    constexpr int kRings = 12;
    for (int i = 0; i <= kRings; ++i) {
        const double angle = std::numbers::pi * (static_cast<double>(i) / kRings - 0.5);
        rings.emplace_back(kStageBall_m * std::cos(angle), kStageBall_m * std::sin(angle));
    }
    return turned(rings);
}

StageView::StageView(const study::FeltWorld& world, const study::Protocol& protocol, const study::Stage& stage,
                     const study::Group& group)
    : world_(world),
      stage_(stage),
      group_(group),
      shows_path_(stage.kind == study::StageKind::led_training && !group.feels_tube),
      lead_m_per_s_(protocol.lead_m_per_s),
      point_offset_m_(protocol.point_offset_m),
      view_(world.part(), world.objects(), kStageBall_m),
      ball_(point_ball()),
      rod_(turned({{0.0, -point_offset_m_},
                   {kStageRod_m, -point_offset_m_},
                   {kStageRod_m, point_offset_m_},
                   {0.0, point_offset_m_}})) {}

picture::Picture StageView::scene(StageMoment moment) {
    if (shows_path_) {
        const Vec3 place = place_on_path(world_.world().spine_m, lead_m_per_s_ * moment.time_s);
        const Vec3 up{0.0, point_offset_m_, 0.0};
        moment = {{place + up, place - up}, {1.0, 0.0, 0.0, 0.0}, false, false, false, moment.time_s};
    }
    for (const ShownObject& one : shown_objects(world_, stage_, group_, moment)) {
        const Pose& pose = world_.part().pose(one.id);
        const std::array update{scene::ObjectUpdate{one.id,
                                                    {pose.position_m, pose.orientation, 1.0},
                                                    one.seen,
                                                    one.colour,
                                                    false,
                                                    pose,
                                                    scene::FixedMotion{},
                                                    one.opacity}};
        view_.take(update);
    }
    picture::Picture scene = view_.close_scene({});
    scene.pedestal.visible = false;
    scene.workpiece_object = {};  // no shadow on the floor: it would tell of a tube that is not seen
    stand_back(scene);
    if (stage_.sees_wand) add_wand(scene, moment);
    return scene;
}

void StageView::add_wand(picture::Picture& scene, const StageMoment& moment) const {
    const Similarity& to_world = view_.world_from_scene();
    const Vec3 middle = 0.5 * (moment.points_m[0] + moment.points_m[1]);
    scene.objects.push_back({rod_, to_world * Similarity{middle, moment.orientation, 1.0}, kRodGrey});
    scene.objects.push_back({ball_, to_world * Similarity{moment.points_m[0], moment.orientation, 1.0}, kRed});
    scene.objects.push_back({ball_, to_world * Similarity{moment.points_m[1], moment.orientation, 1.0}, kGreen});
}

}  // namespace burin::activities
