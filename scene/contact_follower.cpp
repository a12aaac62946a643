// SPDX-License-Identifier: MIT
#include "scene/contact_follower.hpp"

#include <algorithm>
#include <span>

#include "geometry/contact/local_surface.hpp"
#include "haptics/tick_record.hpp"

namespace burin::scene {

static_assert(kCarvedObject == geometry::LocalSurface::kUnnumbered);

namespace {

// Calls back for each object of a list that the other list does not have, once.
template <typename Each>
void each_only_in(std::span<const ObjectId> list, std::span<const ObjectId> other, Each each) {
    for (std::size_t i = 0; i < list.size(); ++i) {
        const ObjectId id = list[i];
        if (id == 0 || std::ranges::find(other, id) != other.end()) continue;
        if (std::ranges::find(list.first(i), id) == list.begin() + static_cast<std::ptrdiff_t>(i)) each(id);
    }
}

}  // namespace

TouchedObjects touched_in(const haptics::TickRecord& tick, const TouchedObjects& before) noexcept {
    TouchedObjects now{};
    const std::uint32_t points = tick.in_contact() ? tick.contact.point_count : 0;
    for (std::uint32_t i = 0; i < points; ++i) {
        const haptics::PointRecord& point = tick.contact.points[i];
        const bool is_held = (tick.flags & haptics::kTickHeldOver) != 0 && point.normal_object != Vec3(0.0);
        now[i] = point.object == 0 && is_held ? before[i] : point.object;
    }
    return now;
}

void ContactFollower::follow(const haptics::TickRecord& tick, std::vector<ContactEvent>& events) {
    const TouchedObjects now = touched_in(tick, touched_);
    each_only_in(touched_, now,
                 [&](ObjectId id) { events.push_back({of_, id, ContactEvent::What::end, tick.time_ns}); });
    each_only_in(now, touched_,
                 [&](ObjectId id) { events.push_back({of_, id, ContactEvent::What::begin, tick.time_ns}); });
    touched_ = now;
}

}  // namespace burin::scene
