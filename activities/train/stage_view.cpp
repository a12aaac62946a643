// SPDX-License-Identifier: MIT
#include "activities/train/stage_view.hpp"

#include <cmath>
#include <numbers>

#include "study/metrics/path.hpp"
#include "study/trial/stage_step.hpp"

namespace burin::activities {
namespace {

constexpr double kBall_m = 0.006, kRod_m = 0.0022, kHandle_m = 0.159;
constexpr scene::Colour kTubeFree{70, 170, 90}, kTubeTouched{205, 60, 50}, kFunnel{150, 160, 190},
    kCapFree{128, 128, 128}, kCapTouched{60, 180, 80};
const Vec3 kRed{0.80, 0.12, 0.10}, kGreen{0.10, 0.60, 0.18}, kRodGrey{0.25, 0.25, 0.28};
constexpr std::uint32_t kRound = 24;

// A surface of revolution about y: rings at heights with radii, from the bottom to the top; poles are rings of 0.
std::shared_ptr<const renderer::DrawnMesh> turned(const std::vector<Vec2>& radius_height_m) {
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
    return renderer::drawn_mesh(mesh);
}

std::shared_ptr<const renderer::DrawnMesh> ball_mesh() {
    std::vector<Vec2> rings;
    constexpr int kRings = 12;
    for (int i = 0; i <= kRings; ++i) {
        const double angle = std::numbers::pi * (static_cast<double>(i) / kRings - 0.5);
        rings.emplace_back(kBall_m * std::cos(angle), kBall_m * std::sin(angle));
    }
    return turned(rings);
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
void stand_back(renderer::Scene& scene) {
    constexpr double kFarther = 1.45;
    wall::Screen& screen = scene.screen;
    const Vec3 middle = 0.5 * (screen.lower_right_world + screen.upper_left_world);
    for (Vec3* corner : {&screen.lower_left_world, &screen.lower_right_world, &screen.upper_left_world})
        *corner = middle + kFarther * (*corner - middle);
    Vec3& head = scene.viewer.head_world.position_m;
    head = middle + kFarther * (head - middle);
}

bool is_in(const study::CapBox& cap, const StageMoment& moment) {
    return study::inside(cap, moment.points_m[0], moment.points_m[0]) &&
           study::inside(cap, moment.points_m[1], moment.points_m[1]);
}

}  // namespace

StageMoment moment_of(const study::FeltWorld& world, const study::StageSession& session,
                      const haptics::TickRecord& record) {
    StageMoment moment;
    moment.points_m = session.touch().points_m(record.sample);
    moment.orientation = record.sample.orientation_device;
    moment.time_s = session.time_s();
    for (std::uint32_t i = 0; i < record.contact.point_count; ++i) {
        const std::uint32_t triangle = record.contact.points[i].active_triangle;
        moment.touches_wall = moment.touches_wall || (triangle != haptics::kNoTriangle &&
                                                      world.surface().material(triangle) == study::kTubeMaterial);
    }
    moment.start_touched = is_in(study::start_cap(world.world()), moment);
    moment.end_touched = is_in(study::end_cap(world.world()), moment);
    return moment;
}

StageView::StageView(const study::FeltWorld& world, const study::Protocol& protocol, const study::Stage& stage,
                     const study::Group& group)
    : world_(world),
      sees_tube_(stage.sees_world && group.sees_tube && stage.kind != study::StageKind::show_model),
      sees_wand_(stage.sees_wand),
      shows_path_(stage.kind == study::StageKind::led_training && !group.feels_tube),
      lead_m_per_s_(protocol.lead_m_per_s),
      point_offset_m_(protocol.point_offset_m),
      view_(world.part(), world.objects(), kBall_m),
      ball_(ball_mesh()),
      rod_(turned(
          {{0.0, -0.5 * kHandle_m}, {kRod_m, -0.5 * kHandle_m}, {kRod_m, 0.5 * kHandle_m}, {0.0, 0.5 * kHandle_m}})) {}

void StageView::show(scene::ObjectId id, bool seen, scene::Colour colour) {
    const Pose& pose = world_.part().pose(id);
    const std::array update{scene::ObjectUpdate{
        id, {pose.position_m, pose.orientation, 1.0}, seen, colour, pose, scene::FixedMotion{}, 1.0}};
    view_.take(update);
}

renderer::Scene StageView::scene(StageMoment moment) {
    if (shows_path_) {
        const Vec3 place = place_on_path(world_.world().spine_m, lead_m_per_s_ * moment.time_s);
        const Vec3 up{0.0, point_offset_m_, 0.0};
        moment = {{place + up, place - up}, {1.0, 0.0, 0.0, 0.0}, false, false, false, moment.time_s};
    }
    for (const scene::ObjectId id : world_.objects()) {
        switch (id) {
            case study::kTubeObject: show(id, false, kTubeFree); break;
            case study::kSeenTubeObject: show(id, sees_tube_, moment.touches_wall ? kTubeTouched : kTubeFree); break;
            case study::kStartCapObject: show(id, true, moment.start_touched ? kCapTouched : kCapFree); break;
            case study::kEndCapObject: show(id, true, moment.end_touched ? kCapTouched : kCapFree); break;
            default: show(id, true, kFunnel); break;
        }
    }
    renderer::Scene scene = view_.close_scene({});
    scene.pedestal.visible = false;
    stand_back(scene);
    if (sees_wand_) add_wand(scene, moment);
    return scene;
}

void StageView::add_wand(renderer::Scene& scene, const StageMoment& moment) const {
    const Similarity& to_world = view_.world_from_scene();
    const Vec3 middle = 0.5 * (moment.points_m[0] + moment.points_m[1]);
    scene.objects.push_back({rod_, to_world * Similarity{middle, moment.orientation, 1.0}, kRodGrey});
    scene.objects.push_back({ball_, to_world * Similarity{moment.points_m[0], moment.orientation, 1.0}, kRed});
    scene.objects.push_back({ball_, to_world * Similarity{moment.points_m[1], moment.orientation, 1.0}, kGreen});
}

}  // namespace burin::activities
