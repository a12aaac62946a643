// SPDX-License-Identifier: MIT
#include "devices/trackers/tracker_bodies.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "base/text.hpp"

namespace burin::devices {
namespace {

constexpr std::string_view kBodiesUsage =
    "head=NAME/SENSOR, wand0=NAME/SENSOR, buttons0=NAME/FIRST, stick0=NAME/FIRST, likewise 1, and axes=+x+z-y, which "
    "of "
    "its axes are the world's x, y and z";
constexpr std::array<std::string_view, 8> kKeys{"head",     "wand0",  "wand1",  "buttons0",
                                                "buttons1", "stick0", "stick1", "axes"};
constexpr double kQuaternionRounded =
    0.01;  // how far a quaternion's length may be from 1, as of the lines of a UDP tracker

std::optional<TrackedSource> source_named(const std::string& value) {
    TrackedSource source;
    const std::size_t slash = value.rfind('/');
    source.name = value.substr(0, slash);
    if (source.name.empty()) return std::nullopt;
    if (slash == std::string::npos) return source;
    const char* const end = value.data() + value.size();
    const auto [at, error] = std::from_chars(value.data() + slash + 1, end, source.number);
    if (error != std::errc{} || at != end || source.number < 0) return std::nullopt;
    return source;
}

// "+x+z-y": the world's axes in the system's.
std::optional<Quat> axes_named(std::string_view text) {
    if (text.size() != 6) return std::nullopt;
    glm::dmat3 system_from_world(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const char sign = text[static_cast<std::size_t>(2 * axis)],
                   letter = text[static_cast<std::size_t>(2 * axis + 1)];
        if ((sign != '+' && sign != '-') || letter < 'x' || letter > 'z') return std::nullopt;
        system_from_world[axis][letter - 'x'] = sign == '+' ? 1.0 : -1.0;
    }
    if (std::abs(glm::determinant(system_from_world) - 1.0) > 1e-9) return std::nullopt;
    return glm::normalize(glm::quat_cast(glm::transpose(system_from_world)));
}

bool is_pose(const Pose& pose) {
    const Vec3& p = pose.position_m;
    const double length = glm::length(pose.orientation);
    return finite(p) && std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kMostTracked_m &&
           std::abs(length - 1.0) <= kQuaternionRounded;
}

std::optional<TrackedSource>& source_of(TrackerBodies& bodies, std::string_view key) {
    if (key == "head") return bodies.head;
    const std::size_t wand = key.back() == '1' ? 1 : 0;
    if (key.starts_with("wand")) return bodies.wands[wand];
    return key.starts_with("buttons") ? bodies.buttons[wand] : bodies.sticks[wand];
}

}  // namespace

std::string_view tracker_bodies_usage() { return kBodiesUsage; }

Result<TrackerBodies> tracker_bodies(const std::string& where, std::span<const std::string> settings,
                                     const TrackerBodies& usual) {
    TrackerBodies bodies;
    bool names_any = false;
    for (const std::string& setting : settings) {
        const std::size_t equals = setting.find('=');
        const std::string key = setting.substr(0, equals);
        if (equals == std::string::npos || std::ranges::find(kKeys, key) == kKeys.end())
            return fail(
                "tracker " + where, "'" + setting + "' says nothing that is known",
                "the nearest is " + std::string(nearest_name(key, kKeys)) + "=; write " + std::string(kBodiesUsage));
        const std::string value = setting.substr(equals + 1);
        if (key == "axes") {
            const auto axes = axes_named(value);
            if (!axes)
                return fail("tracker " + where, "'" + setting + "' are no axes",
                            "write three different ones with their signs and no mirror image, such as axes=+x+z-y");
            bodies.world_from_system = *axes;
            continue;
        }
        const auto source = source_named(value);
        if (!source)
            return fail("tracker " + where, "'" + setting + "' names nothing",
                        "write " + key + "=NAME/NUMBER, such as " + key + "=Tracker0/0");
        source_of(bodies, key) = *source;
        names_any = true;
    }
    if (!names_any) {
        const Quat axes = bodies.world_from_system;
        bodies = usual;
        bodies.world_from_system = axes;
    }
    return bodies;
}

bool TrackerTranslator::is_known(std::string_view name, std::int32_t number) const {
    const auto is_it = [&](const std::optional<TrackedSource>& source) {
        return source && source->name == name && source->number == number;
    };
    return is_it(bodies_.head) || std::ranges::any_of(bodies_.wands, is_it);
}

void TrackerTranslator::report(Body& body, const Pose& pose_world, bool is_tracked, std::optional<std::uint32_t> wand,
                               Nanoseconds time_ns) {
    if (!is_tracked && !body.is_tracked) return;  // nothing new, and nothing known
    if (is_tracked) body.last_world = pose_world;
    body.is_tracked = is_tracked;
    if (wand)
        to_.push({time_ns, WandInput{*wand, body.last_world, is_tracked}});
    else
        to_.push({time_ns, HeadInput{body.last_world, is_tracked}});
}

void TrackerTranslator::pose(std::string_view name, std::int32_t number, const Pose& pose_system, bool is_tracked,
                             Nanoseconds time_ns) {
    if (!is_known(name, number)) return;
    Pose pose_world;
    if (is_tracked) {
        if (!is_pose(pose_system))
            return refuse("sends a pose of " + std::string(name) + formatted("/%d", number) +
                              " that is none: a place within 1 km in metres, and a quaternion of length 1",
                          time_ns);
        const Quat& axes = bodies_.world_from_system;
        pose_world.position_m = axes * pose_system.position_m;
        pose_world.orientation = glm::normalize(axes * glm::normalize(pose_system.orientation) * glm::conjugate(axes));
    }
    const TrackedSource said{std::string(name), number};
    if (bodies_.head == said) report(head_, pose_world, is_tracked, std::nullopt, time_ns);
    for (std::uint32_t wand = 0; wand < kTrackedWands; ++wand)
        if (bodies_.wands[wand] == said) report(wands_[wand], pose_world, is_tracked, wand, time_ns);
}

void TrackerTranslator::click(std::size_t wand, std::uint32_t button, bool pressed, Nanoseconds time_ns) {
    const std::uint32_t bit = 1u << button;
    if (((pressed_[wand] & bit) != 0) == pressed) return;
    pressed_[wand] ^= bit;
    to_.push({time_ns, WandClick{static_cast<std::uint32_t>(wand), button, pressed}});
}

void TrackerTranslator::button(std::string_view name, std::int32_t number, bool pressed, Nanoseconds time_ns) {
    for (std::size_t wand = 0; wand < kTrackedWands; ++wand) {
        const auto& source = bodies_.buttons[wand];
        if (!source || source->name != name || number < source->number) continue;
        const std::int64_t button = std::int64_t{number} - source->number;
        if (button < kMostTrackedButtons) click(wand, static_cast<std::uint32_t>(button), pressed, time_ns);
    }
}

void TrackerTranslator::channels(std::string_view name, std::span<const double> values, Nanoseconds time_ns) {
    for (std::size_t wand = 0; wand < kTrackedWands; ++wand) {
        const auto& source = bodies_.sticks[wand];
        if (!source || source->name != name) continue;
        const auto first = static_cast<std::size_t>(source->number);
        if (values.size() < 2 || first > values.size() - 2) {
            refuse("has no channels " + formatted("%zu and %zu", first, first + 1) + " of " + std::string(name),
                   time_ns);
            continue;
        }
        Vec2 stick(values[first], values[first + 1]);
        if (!std::isfinite(stick.x) || !std::isfinite(stick.y)) {
            refuse("sends a stick of " + std::string(name) + " that is no number", time_ns);
            continue;
        }
        stick = glm::clamp(stick, Vec2(-1.0), Vec2(1.0));
        if (stick == sticks_[wand]) continue;
        sticks_[wand] = stick;
        to_.push({time_ns, WandStick{static_cast<std::uint32_t>(wand), stick}});
    }
}

void TrackerTranslator::lose_all(Nanoseconds time_ns) {
    report(head_, {}, false, std::nullopt, time_ns);
    for (std::uint32_t wand = 0; wand < kTrackedWands; ++wand) {
        report(wands_[wand], {}, false, wand, time_ns);
        for (std::uint32_t button = 0; button < static_cast<std::uint32_t>(kMostTrackedButtons); ++button)
            click(wand, button, false, time_ns);
        if (std::exchange(sticks_[wand], Vec2(0.0)) != Vec2(0.0)) to_.push({time_ns, WandStick{wand, Vec2(0.0)}});
    }
}

}  // namespace burin::devices
