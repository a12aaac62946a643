// SPDX-License-Identifier: MIT
#include "activities/train/shown_objects.hpp"

namespace burin::activities {
namespace {

constexpr scene::Colour kTubeFree{70, 170, 90}, kTubeTouched{205, 60, 50}, kFunnel{150, 160, 190},
    kCapFree{128, 128, 128}, kCapTouched{60, 180, 80};
constexpr double kClear = 0.45;

bool is_in(const study::CapBox& cap, const StageMoment& moment) {
    return study::inside(cap, moment.points_m[0], moment.points_m[0]) &&
           study::inside(cap, moment.points_m[1], moment.points_m[1]);
}

}  // namespace

StageMoment moment_of(const study::FeltWorld& world, const study::StageSession& session,
                      const haptics::TickRecord& record) {
    StageMoment moment;
    moment.points_m = session.touch().points_m(record.sample);
    moment.orientation =
        session.touch().parameters().workspace.object_from_device.orientation * record.sample.orientation_device;
    moment.time_s = session.time_s();
    for (std::uint32_t i = 0; i < record.contact.point_count; ++i) {
        const std::uint32_t triangle = record.contact.points[i].active_triangle;
        moment.touches_wall = moment.touches_wall || (triangle != haptics::kNoTriangle &&
                                                      world.surface().material(triangle) == study::kTubeMaterial);
    }
    // Ticks of a session's loop tell no triangle of this world.
    if (record.contact.point_count == 0) {
        const study::StudyWorld& tube = world.world();
        for (const Vec3& p : moment.points_m)
            moment.touches_wall =
                moment.touches_wall || study::nearest_on(tube.spine_m, p).distance_m >= tube.tube_radius_m;
    }
    moment.start_touched = is_in(study::start_cap(world.world()), moment);
    moment.end_touched = is_in(study::end_cap(world.world()), moment);
    return moment;
}

bool sees_tube(const study::Stage& stage, const study::Group& group) {
    return stage.sees_world && group.sees_tube && !stage.world.empty() && stage.kind != study::StageKind::show_model;
}

bool feels_tube(const study::Stage& stage, const study::Group& group) {
    return stage.feels_world && group.feels_tube && !stage.world.empty();
}

std::vector<ShownObject> shown_objects(const study::FeltWorld& world, const study::Stage& stage,
                                       const study::Group& group, const StageMoment& moment) {
    std::vector<ShownObject> shown;
    for (const scene::ObjectId id : world.objects()) {
        switch (id) {
            case study::kTubeObject: shown.push_back({id, false, kTubeFree}); break;
            case study::kSeenTubeObject:
                shown.push_back({id, sees_tube(stage, group), moment.touches_wall ? kTubeTouched : kTubeFree, kClear});
                break;
            case study::kStartCapObject:
                shown.push_back({id, true, moment.start_touched ? kCapTouched : kCapFree});
                break;
            case study::kEndCapObject: shown.push_back({id, true, moment.end_touched ? kCapTouched : kCapFree}); break;
            default: shown.push_back({id, true, kFunnel, kClear}); break;
        }
    }
    return shown;
}

}  // namespace burin::activities
