// SPDX-License-Identifier: MIT
#include "session/input/input_event.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace burin::session {
namespace {

bool sane(double x) { return std::abs(x) <= kMostInputNumber; }  // false for NaN
bool sane(const Vec2& v) { return sane(v.x) && sane(v.y); }
bool sane(const Pose& pose) {
    const Vec3& p = pose.position_m;
    const Quat& q = pose.orientation;
    const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return sane(p.x) && sane(p.y) && sane(p.z) && std::abs(length - 1.0) <= 1e-6;
}

// Returns how many bytes the character at the front takes; 0 if it is not valid UTF-8 (RFC 3629, section 4).
std::size_t character_bytes(std::string_view s) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(s[i]); };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t count = first >= 0xc2 && first <= 0xdf   ? 2
                              : first >= 0xe0 && first <= 0xef ? 3
                              : first >= 0xf0 && first <= 0xf4 ? 4
                                                               : 0;
    if (count == 0 || s.size() < count) return 0;
    for (std::size_t i = 1; i < count; ++i)
        if ((byte(i) & 0xc0u) != 0x80) return 0;
    const unsigned second = byte(1);  // no overlong forms, no surrogates, nothing above U+10FFFF
    if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) || (first == 0xf0 && second < 0x90) ||
        (first == 0xf4 && second > 0x8f))
        return 0;
    return count;
}

bool is_utf8(std::string_view s) {
    while (!s.empty()) {
        const std::size_t count = character_bytes(s);
        if (count == 0) return false;
        s.remove_prefix(count);
    }
    return true;
}

bool sane(const std::string& text) { return text.size() <= kMostTextBytes && is_utf8(text); }

struct Sensible {
    bool operator()(const KeyInput& in) const {
        return static_cast<std::size_t>(in.key) < kKeyCount && in.motion <= KeyMotion::repeat;
    }
    bool operator()(const MouseMove& in) const { return sane(in.position_px); }
    bool operator()(const MouseClick& in) const { return in.button <= MouseButton::forward; }
    bool operator()(const Scroll& in) const { return sane(in.steps); }
    bool operator()(const TextInput& in) const { return !in.utf8.empty() && sane(in.utf8); }
    bool operator()(const WindowResize& in) const {
        return in.width_px <= kMostWindow_px && in.height_px <= kMostWindow_px;
    }
    bool operator()(const WindowFocus&) const { return true; }
    bool operator()(const WindowClose&) const { return true; }
    bool operator()(const HeadInput& in) const { return sane(in.pose_world); }
    bool operator()(const WandInput& in) const { return in.wand < kMostWands && sane(in.pose_world); }
    bool operator()(const WandClick& in) const { return in.wand < kMostWands && in.button < kMostWandButtons; }
    bool operator()(const WandStick& in) const {
        return in.wand < kMostWands && std::abs(in.position.x) <= 1.0 && std::abs(in.position.y) <= 1.0;
    }
    bool operator()(const CommandInput& in) const {
        return !in.name.empty() && sane(in.name) && in.arguments.size() <= kMostCommandArguments &&
               std::ranges::all_of(in.arguments, [](const std::string& a) { return sane(a); });
    }
    bool operator()(const FrameStart& in) const { return in.display_ns >= 0 && in.display_ns <= kLongestSession_ns; }
};

}  // namespace

bool is_sensible(const Input& input) { return std::visit(Sensible{}, input); }

}  // namespace burin::session
