// SPDX-License-Identifier: MIT
#include "session/live/opened_room.hpp"

#include <numbers>
#include <utility>

#include "base/try.hpp"
#include "devices/haptic/mouse_arm.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"
#include "session/activity/activity.hpp"
#include "session/activity/brought_hand.hpp"
#include "session/hands/session_hands.hpp"
#include "session/held/held_handle.hpp"
#include "session/record/recordings.hpp"

namespace burin::session {
namespace {

// Has a handle reach over a workspace of its own size.
void reach_over(HandRoom& room, const Vec3& workspace_device_m) {
    room.workspace_device_m = workspace_device_m;
    room.reach = Reach::own;
}

// Places the palm of a glove: palm down, fingers away from the viewer and to the left, over a workspace that an arm
// reaches. (The device's own is larger by a hand, for its fingertips.)
void use_glove(HandRoom& room) {
    constexpr Vec3 kReach_m{0.33, 0.3, 0.264};
    constexpr double kToTheLeft_rad = 0.85, kDown_rad = 0.25;
    room.workspace_device_m = kReach_m;
    room.reach = Reach::arm;
    room.rest_device = glm::angleAxis(kToTheLeft_rad, Vec3(0.0, 1.0, 0.0)) *
                       glm::angleAxis(-0.5 * std::numbers::pi - kDown_rad, Vec3(1.0, 0.0, 0.0));
}

// Of a hand that a mouse leads or could lead, and of one that feels.
haptics::FillPlace fill_place_of(const devices::DeviceNature& nature) {
    if (nature.felt_by_person) return haptics::FillPlace::begun;
    const bool led_by_mouse = !nature.leads_itself && !nature.is_worn;
    return led_by_mouse ? haptics::FillPlace::hand : haptics::FillPlace::surface;
}

}  // namespace

Result<OpenedRoom> open_room(const SessionSetup& options) {
    OpenedRoom opened;
    opened.room.mouse = options.hands.mouse.value_or(MouseMode::free);
    opened.room.mouse_chosen = options.hands.mouse.has_value();
    const std::vector<NamedDevice> hands = devices_of(options.hands);
    opened.room.hands.assign(hands.size(), {});
    opened.handles.assign(hands.size(), nullptr);
    for (std::size_t i = 0; i < hands.size(); ++i) {
        HandRoom& room = opened.room.hands[i];
        Result<devices::DeviceNature> nature = devices::nature_of_device(hands[i].device, &session_recordings());
        if (!nature) return std::unexpected(of_hand(hands[i].hand, nature.error()));
        room.is_upright = nature->is_upright;
        if (nature->is_upright) room.rest_device = {1.0, 0.0, 0.0, 0.0};
        if (hands[i].device == devices::kMouseArm) reach_over(room, devices::mouse_arm().workspace_m);
        room.fills = fill_place_of(*nature);
        if (nature->is_worn) use_glove(room);
        if (nature->is_worn && i == 0 && options.activity != nullptr)
            if (const std::optional<LedHand> led = options.activity->led_hand()) {
                opened.room.reach_object = led->reach_scene;
                room.rest_device = led->rest_device;
            }
        const BroughtHand* const brought = i == 0 && options.activity ? options.activity->brought_hand() : nullptr;
        if (brought != nullptr && brought->placed) {
            room.placed = brought->placed;
            room.rest_device = brought->placed->rest_device.orientation;
        }
        if (brought != nullptr && brought->handle) {
            reach_over(room, devices::device_of(*brought->handle).workspace_m);
            opened.handles[i] = std::make_shared<const HeldHandle>(*brought->handle, brought->points);
            continue;
        }
        if (!nature->handle) continue;
        reach_over(room, devices::device_of(*nature->handle).workspace_m);
        if (options.hands.points.empty()) continue;
        BURIN_TRY(points, devices::points_named(*nature->handle, options.hands.points));
        opened.handles[i] = std::make_shared<const HeldHandle>(std::move(*nature->handle), std::move(points));
    }
    return opened;
}

}  // namespace burin::session
