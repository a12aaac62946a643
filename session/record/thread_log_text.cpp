// SPDX-License-Identifier: MIT
// Formats ticks and updates as text: letters followed by numbers, each a difference from the previous tick or update,
// left out where it is zero. ';' ends one.
#include <array>
#include <bit>
#include <charconv>
#include <cmath>

#include "session/input/input_event.hpp"
#include "session/record/thread_log.hpp"

namespace burin::session {
namespace {

constexpr double kMostSteps = 1e9;
// Between updates, as a part of the format: whatever the scene's period is, files stay readable.
constexpr Nanoseconds kBetweenUpdates_ns = 10'000'000;
constexpr std::int64_t kMostHandsInALine = 16, kMostParts = 16;
// Largest change of a sequence, a tick's number or a position in steps.
constexpr std::int64_t kMostChange = 1'000'000'000;
constexpr std::array<char, 3> kSteps = {'x', 'y', 'z'}, kMetres = {'X', 'Y', 'Z'};

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

bool same(const Quat& a, const Quat& b) { return same(a.w, b.w) && same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }

template <typename T>
void add(std::string& text, T number) {
    std::array<char, 32> digits;
    text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
}

template <typename T>
void add(std::string& text, char letter, T number) {
    text += letter;
    add(text, number);
}

// Reads one tick or update, letter by letter. After the first error nothing more is read.
class Fields {
public:
    explicit Fields(std::string_view field) : rest_(field) {}
    [[nodiscard]] bool ok() const { return ok_; }
    [[nodiscard]] bool at_end() const { return rest_.empty(); }
    [[nodiscard]] bool has_digit() const { return !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9'; }
    bool takes(char letter) {
        if (!ok_ || rest_.empty() || rest_.front() != letter) return false;
        rest_.remove_prefix(1);
        return true;
    }
    template <typename T>
    T number() {
        T value{};
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        ok_ = ok_ && error == std::errc{};
        if (ok_) rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return ok_ ? value : T{};
    }
    std::int64_t change(std::int64_t least, std::int64_t most) {
        const auto value = number<std::int64_t>();
        ok_ = ok_ && value >= least && value <= most;
        return ok_ ? value : 0;
    }
    void require(bool condition) { ok_ = ok_ && condition; }

private:
    std::string_view rest_;
    bool ok_ = true;
};

// Takes the text up to the next ';', and the ';' itself.
std::optional<std::string_view> take_field(std::string_view& text) {
    const std::size_t end = text.find(';');
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view field = text.substr(0, end);
    text.remove_prefix(end + 1);
    return field;
}

bool in_session(Nanoseconds time_ns, Nanoseconds start_ns) {
    return time_ns >= start_ns && time_ns - start_ns <= kLongestSession_ns;
}

}  // namespace

// ---- Ticks

TickText::TickText(const ThreadClock& clock) : clock_(clock) { last_.time_ns = last_.sample.time_ns = clock.start_ns; }

bool TickText::is_steps(double position_m) const {
    if (!(clock_.resolution_m > 0.0) || !(std::abs(position_m) < kMostSteps * clock_.resolution_m)) return false;
    return same(static_cast<double>(std::llround(position_m / clock_.resolution_m)) * clock_.resolution_m, position_m);
}

std::int64_t TickText::steps(double position_m) const {
    return is_steps(position_m) ? std::llround(position_m / clock_.resolution_m) : 0;
}

void TickText::write(std::string& text, const TickSeen& tick) {
    const devices::DeviceSample &now = tick.sample, &before = last_.sample;
    add(text, tick.time_ns - last_.time_ns - clock_.period_ns);
    if (const Nanoseconds more_ns = now.time_ns - before.time_ns - clock_.period_ns; more_ns != 0)
        add(text, 'd', more_ns);
    for (int axis = 0; axis < 3; ++axis) {
        const double is_m = now.position_device_m[axis], was_m = before.position_device_m[axis];
        if (same(is_m, was_m)) continue;
        const auto i = static_cast<std::size_t>(axis);
        if (is_steps(is_m)) {
            add(text, kSteps[i], steps(is_m) - steps(was_m));
        } else {
            add(text, kMetres[i], is_m);
        }
    }
    if (const Quat& q = now.orientation_device; !same(q, before.orientation_device)) {
        add(text, 'q', q.w);
        for (const double number : {q.x, q.y, q.z}) add(text, ',', number);
    }
    if (now.buttons != before.buttons) add(text, 'b', now.buttons);
    if (now.fault != before.fault) add(text, 'f', static_cast<unsigned>(now.fault));
    if (tick.surface_sequence != last_.surface_sequence) add(text, 's', tick.surface_sequence - last_.surface_sequence);
    if (tick.parameter_sequence != last_.parameter_sequence)
        add(text, 'p', tick.parameter_sequence - last_.parameter_sequence);
    if (tick.late) text += 'l';
    text += ';';
    last_ = tick;
}

std::optional<TickSeen> TickText::read(std::string_view& text) {
    const auto field = take_field(text);
    if (!field) return std::nullopt;
    Fields fields(*field);
    TickSeen tick = last_;
    tick.time_ns += clock_.period_ns + fields.change(-kLongestSession_ns, kLongestSession_ns);
    tick.sample.time_ns += clock_.period_ns;
    if (fields.takes('d')) tick.sample.time_ns += fields.change(-kLongestSession_ns, kLongestSession_ns);
    for (int axis = 0; axis < 3; ++axis) {
        double& position_m = tick.sample.position_device_m[axis];
        const auto i = static_cast<std::size_t>(axis);
        if (fields.takes(kSteps[i])) {
            const std::int64_t count = steps(position_m) + fields.change(-kMostChange, kMostChange);
            position_m = static_cast<double>(count) * clock_.resolution_m;
            fields.require(std::abs(static_cast<double>(count)) <= kMostSteps);
        } else if (fields.takes(kMetres[i])) {
            position_m = fields.number<double>();
        }
    }
    if (fields.takes('q')) {
        std::array<double, 4> q{};
        for (std::size_t i = 0; i < 4; ++i) {
            if (i > 0) fields.require(fields.takes(','));
            q[i] = fields.number<double>();
        }
        tick.sample.orientation_device = Quat(q[0], q[1], q[2], q[3]);
    }
    if (fields.takes('b')) tick.sample.buttons = fields.number<std::uint32_t>();
    if (fields.takes('f')) {
        const auto last = static_cast<std::int64_t>(devices::kLastDeviceFault);
        tick.sample.fault = static_cast<devices::DeviceFault>(fields.change(0, last));
    }
    if (fields.takes('s')) tick.surface_sequence += static_cast<std::uint64_t>(fields.change(1, kMostChange));
    if (fields.takes('p')) tick.parameter_sequence += static_cast<std::uint64_t>(fields.change(1, kMostChange));
    tick.late = fields.takes('l');
    fields.require(fields.at_end() && in_session(tick.time_ns, clock_.start_ns) && tick.time_ns >= last_.time_ns &&
                   std::abs(tick.sample.time_ns - clock_.start_ns) <= kLongestSession_ns);
    if (!fields.ok()) return std::nullopt;
    last_ = tick;
    return tick;
}

// ---- Updates

void UpdateText::write(std::string& text, const scene::SceneUpdate& update) {
    add(text, update.time_ns - last_.time_ns - kBetweenUpdates_ns);
    for (std::size_t hand = 0; hand < update.last_ticks.size(); ++hand) {
        const std::uint64_t before = hand < last_.last_ticks.size() ? last_.last_ticks[hand] : 0;
        if (update.last_ticks[hand] == before) continue;
        if (hand > 0) add(text, 'h', hand);
        add(text, 't', update.last_ticks[hand] - before);
    }
    if (update.orders > 0) add(text, 'o', update.orders);
    for (std::size_t part = 0; part < update.parts.size(); ++part) {
        if (!update.parts[part].background_ended) continue;
        text += 'e';
        if (part > 0) add(text, part);
    }
    for (std::size_t part = 0; part < update.parts.size(); ++part) {
        if (update.parts[part].behind == 0) continue;
        add(text, 'd', update.parts[part].behind);
        if (part > 0) add(text, 'p', part);
    }
    text += ';';
    last_ = update;
}

std::optional<scene::SceneUpdate> UpdateText::read(std::string_view& text) {
    const auto field = take_field(text);
    if (!field) return std::nullopt;
    Fields fields(*field);
    scene::SceneUpdate update{last_.time_ns, 0, last_.last_ticks, {}};
    update.time_ns += kBetweenUpdates_ns + fields.change(-kLongestSession_ns, kLongestSession_ns);
    for (std::size_t hand = 0; fields.ok();) {
        const bool names_hand = fields.takes('h');
        if (names_hand) hand = static_cast<std::size_t>(fields.change(1, kMostHandsInALine - 1));
        if (!fields.takes('t')) {
            fields.require(!names_hand);
            break;
        }
        if (hand >= update.last_ticks.size()) update.last_ticks.resize(hand + 1);
        update.last_ticks[hand] += static_cast<std::uint64_t>(fields.change(1, kMostChange));
    }
    if (fields.takes('o')) update.orders = static_cast<std::size_t>(fields.change(1, kMostChange));
    while (fields.takes('e')) {
        const auto part = fields.has_digit() ? static_cast<std::size_t>(fields.change(1, kMostParts - 1)) : 0;
        if (part >= update.parts.size()) update.parts.resize(part + 1);
        update.parts[part].background_ended = true;
    }
    while (fields.takes('d')) {
        const auto behind = static_cast<std::size_t>(fields.change(1, kMostChange));
        const auto part = fields.takes('p') ? static_cast<std::size_t>(fields.change(1, kMostParts - 1)) : 0;
        if (part >= update.parts.size()) update.parts.resize(part + 1);
        update.parts[part].behind = behind;
    }
    fields.require(fields.at_end() && in_session(update.time_ns, start_ns_) && update.time_ns >= last_.time_ns);
    if (!fields.ok()) return std::nullopt;
    last_ = update;
    return update;
}

}  // namespace burin::session
