// SPDX-License-Identifier: MIT
#include "activities/train/shown_objects.hpp"

#include <algorithm>
#include <span>

#include "haptics/tick_record.hpp"

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

bool touches_wall(const haptics::TickRecord& record) {
    const std::span points(record.contact.points.data(), record.contact.point_count);
    return std::ranges::any_of(points, [](const haptics::PointRecord& point) {
        return point.active_triangle != haptics::kNoTriangle && point.object == study::kTubeObject;
    });
}

StageMoment moment_of(const study::FeltWorld& world, const study::StageSession& session, bool touches_wall) {
    StageMoment moment;
    moment.points_m = session.touch().points_m(session.sample());
    moment.orientation =
        session.touch().parameters().workspace.object_from_device.orientation * session.sample().orientation_device;
    moment.time_s = session.time_s();
    moment.touches_wall = touches_wall;
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
