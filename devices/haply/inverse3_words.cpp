// SPDX-License-Identifier: MIT
#include "devices/haply/inverse3_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/json.hpp"

namespace burin::devices {
namespace {

Vec3 from_haply(const Vec3& v) { return {v.x, v.z, -v.y}; }
Vec3 to_haply(const Vec3& v) { return {v.x, -v.z, v.y}; }

// Returns a member that is an object or a list; null: there is none.
const Json* member_of(const Json& object, const char* name) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(name);
    return found != object.end() && found->is_structured() ? &*found : nullptr;
}

template <std::size_t N>
std::optional<std::array<double, N>> numbers_of(const Json* object, const std::array<const char*, N>& names) {
    if (object == nullptr) return std::nullopt;
    std::array<double, N> numbers{};
    for (std::size_t i = 0; i < N; ++i) {
        const auto found = object->find(names[i]);
        if (found == object->end() || !found->is_number()) return std::nullopt;
        numbers[i] = found->template get<double>();
        if (!std::isfinite(numbers[i])) return std::nullopt;
    }
    return numbers;
}

bool is_false(const Json& object, const char* name) {
    const auto found = object.find(name);
    return found != object.end() && found->is_boolean() && !found->template get<bool>();
}

std::optional<Inverse3Trouble> trouble_of(const Json& device) {
    const Json* const status = member_of(device, "status");
    if (status == nullptr || !status->is_object()) return std::nullopt;
    if (is_false(*status, "power_supply")) return Inverse3Trouble::without_power;
    if (is_false(*status, "calibrated")) return Inverse3Trouble::uncalibrated;
    if (is_false(*status, "ready")) return Inverse3Trouble::not_ready;
    return Inverse3Trouble::none;
}

Inverse3State device_of(const Json& device) {
    Inverse3State state;
    if (const auto id = device.find("device_id"); id != device.end() && id->is_string())
        state.id = id->get<std::string>();
    const Json* const said = member_of(device, "state");
    if (const auto at = numbers_of<3>(said != nullptr ? member_of(*said, "cursor_position") : nullptr, {"x", "y", "z"}))
        state.position_m = from_haply(Vec3((*at)[0], (*at)[1], (*at)[2]) - kInverse3Middle_m);
    state.trouble = trouble_of(device);
    return state;
}

bool is_pressed(const Json* object, const char* name) {
    if (object == nullptr || !object->is_object()) return false;
    const auto found = object->find(name);
    return found != object->end() && found->is_boolean() && found->template get<bool>();
}

void take_handle(const Json& handle, Inverse3Words& words) {
    const Json* const state = member_of(handle, "state");
    if (state == nullptr) return;
    words.has_handle = true;
    if (const auto turn = numbers_of<4>(member_of(*state, "orientation"), {"w", "x", "y", "z"})) {
        const Vec3 axis = from_haply({(*turn)[1], (*turn)[2], (*turn)[3]});
        const Quat orientation((*turn)[0], axis.x, axis.y, axis.z);
        constexpr double kRounded = 1e-2;
        if (std::abs(glm::length(orientation) - 1.0) < kRounded) words.orientation = glm::normalize(orientation);
    }
    // With a cable it has one button, without one three.
    const Json* const three = member_of(*state, "buttons");
    words.buttons = (is_pressed(state, "button") || is_pressed(three, "a") ? 1u : 0u) |
                    (is_pressed(three, "b") ? 2u : 0u) | (is_pressed(three, "c") ? 4u : 0u);
}

}  // namespace

std::optional<Inverse3Words> read_inverse3(std::string_view text) noexcept {
    const Json all = Json::parse(text, nullptr, false);
    if (!all.is_object()) return std::nullopt;
    const Json* const devices = member_of(all, "inverse3");
    if (devices == nullptr || !devices->is_array()) return std::nullopt;
    Inverse3Words words;
    words.takes_vector = all.contains("session_id");
    for (const Json& device : *devices) {
        if (!device.is_object()) continue;
        if (Inverse3State state = device_of(device); !state.id.empty()) words.devices.push_back(std::move(state));
        const Json* const config = member_of(device, "config");
        words.takes_vector = words.takes_vector || (config != nullptr && config->is_object() &&
                                                    (config->contains("basis") || config->contains("mount")));
    }
    for (const char* const kind : {"wireless_verse_grip", "verse_grip"}) {
        const Json* const handles = member_of(all, kind);
        if (words.has_handle || handles == nullptr || !handles->is_array() || handles->empty()) continue;
        take_handle(handles->front(), words);
    }
    return words;
}

std::vector<std::string_view> inverse3_ids(const Inverse3Words& words) {
    std::vector<std::string_view> ids;
    for (const Inverse3State& device : words.devices) ids.push_back(device.id);
    return ids;
}

const Inverse3State* inverse3_of(const Inverse3Words& words, std::string_view id) noexcept {
    const auto found = std::ranges::find(words.devices, id, &Inverse3State::id);
    return found != words.devices.end() ? &*found : nullptr;
}

std::string inverse3_force(std::string_view id, const Vec3& force_N, bool takes_vector) {
    const Vec3 given = to_haply(force_N);
    Json device;
    device["device_id"] = id;
    device["commands"]["set_cursor_force"][takes_vector ? "vector" : "values"] = {
        {"x", given.x}, {"y", given.y}, {"z", given.z}};
    Json all;
    all["inverse3"] = Json::array({device});
    return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string inverse3_asks_for_all() { return R"({"session":{"force_render_full_state":{}}})"; }

}  // namespace burin::devices
