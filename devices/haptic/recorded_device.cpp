// SPDX-License-Identifier: MIT
#include "devices/haptic/recorded_device.hpp"

#include <algorithm>
#include <utility>

namespace burin::devices {

Result<RecordedChoice> recorded_choice(const std::string& text) {
    constexpr const char* kRemedy =
        "write recorded:FILE.session, recorded:FILE.session:HAND, each with ,loop if wanted";
    RecordedChoice choice;
    choice.file = text;
    if (const std::size_t comma = choice.file.rfind(',');
        comma != std::string::npos && !choice.file.ends_with(".session")) {
        const std::string word = choice.file.substr(comma + 1);
        if (word != "loop")
            return fail("haptic device recorded:" + text, "has an option that is not known: " + word, kRemedy);
        choice.loops = true;
        choice.file.resize(comma);
    }
    const std::size_t colon = choice.file.rfind(':');
    if (colon != std::string::npos && choice.file.find('/', colon) == std::string::npos) {
        choice.hand = choice.file.substr(colon + 1);
        choice.file.resize(colon);
    }
    if (choice.file.empty())
        return fail("haptic device " + std::string(kRecordedDevice), "names no recording", kRemedy);
    return choice;
}

RecordedPlayer::RecordedPlayer(RecordedHand hand, RecordedChoice choice, OpenedDevice like, Clock& clock)
    : hand_(std::move(hand)), choice_(std::move(choice)), like_(std::move(like)), clock_(clock) {
    const DeviceDescription& description = like_.parts.front().device->description();
    name_ = "recording of " + std::string(description.name);
    period_ns_ = nanoseconds(1.0 / description.rate_Hz);
    for (const RecordedHandPart& part : hand_.parts)
        if (!part.samples.empty())
            length_ = std::max(length_, static_cast<std::uint64_t>(part.samples.back().due_ns / period_ns_) + 1);
}

// Counts the turn: each takes the next tick, and passes over those that were missed.
void RecordedPlayer::begin_turn() noexcept {
    now_ns_ = clock_.now_ns();
    if (!begun_) {
        begun_ = true;
        base_ns_ = now_ns_;
        return;
    }
    // A loop that is late for a moment makes up for it; only what it is behind by two periods it has left out.
    ++tick_;
    const Nanoseconds behind_ns = now_ns_ - base_ns_ - static_cast<Nanoseconds>(tick_) * period_ns_;
    if (behind_ns >= kLeftOut * period_ns_) tick_ += static_cast<std::uint64_t>(behind_ns / period_ns_);
    // A first turn that came late would have all later ones count as early.
    base_ns_ = std::min(base_ns_, now_ns_ - static_cast<Nanoseconds>(tick_) * period_ns_);
    if (tick_ < length_) return;
    const auto pause = static_cast<std::uint64_t>((kRest_ns + kGlide_ns) / period_ns_);
    if (!choice_.loops) {
        ended_.store(true, std::memory_order_relaxed);  // a word to the user; nothing else follows from it
    } else if (tick_ >= length_ + pause) {
        tick_ = (tick_ - length_ - pause) % length_;
        base_ns_ = now_ns_ - static_cast<Nanoseconds>(tick_) * period_ns_;
    }
}

DeviceSample RecordedPlayer::at_end(const RecordedHandPart& part) const noexcept {
    DeviceSample sample = part.samples.back().sample;
    sample.time_ns = now_ns_;
    sample.buttons = 0;
    sample.fault = DeviceFault::none;
    return sample;
}

// Between the end and the next beginning: rests, then goes there by a cubic that starts and ends at rest.
DeviceSample RecordedPlayer::gliding(const RecordedHandPart& part, std::uint64_t past_end) const noexcept {
    DeviceSample sample = at_end(part);
    if (!choice_.loops) return sample;
    const Nanoseconds into_ns = static_cast<Nanoseconds>(past_end) * period_ns_ - kRest_ns;
    const double s = std::clamp(seconds(into_ns) / seconds(kGlide_ns), 0.0, 1.0), way = s * s * (3.0 - 2.0 * s);
    const DeviceSample& first = part.samples.front().sample;
    sample.position_device_m = glm::mix(sample.position_device_m, first.position_device_m, way);
    sample.orientation_device = glm::slerp(sample.orientation_device, first.orientation_device, way);
    return sample;
}

DeviceSample RecordedPlayer::read(std::size_t part) noexcept {
    if (part == 0) begin_turn();
    const RecordedHandPart& of = hand_.parts[part];
    if (tick_ >= length_) return gliding(of, tick_ - length_);
    const Nanoseconds due_ns = static_cast<Nanoseconds>(tick_) * period_ns_ + period_ns_ / 2;  // whatever was rounded
    const auto after = std::ranges::upper_bound(of.samples, due_ns, {}, &RecordedSample::due_ns);
    DeviceSample sample = (after == of.samples.begin() ? after : std::prev(after))->sample;
    sample.time_ns += now_ns_;
    return sample;
}

std::vector<std::string> RecordedPlayer::take_messages() {
    if (told_ || !ended_.load(std::memory_order_relaxed)) return {};
    told_ = true;
    return {"the recording " + choice_.file + " has ended: the hand rests where it was last"};
}

OpenedDevice recorded_device(RecordedHand hand, const RecordedChoice& choice, OpenedDevice like, Clock& clock) {
    std::vector<std::string> names;
    for (const RecordedHandPart& part : hand.parts) names.push_back(part.name);
    const auto player = std::make_shared<RecordedPlayer>(std::move(hand), choice, std::move(like), clock);
    OpenedDevice opened;
    for (std::size_t part = 0; part < names.size(); ++part) {
        DeviceDescription description = player->like().parts[part].device->description();
        description.name = player->name().c_str();
        description.felt_by_person = false;
        description.led_by = "a recording";
        opened.parts.push_back({names[part], std::make_unique<PartOf<RecordedPlayer>>(player, part, description)});
    }
    opened.messages = player.get();
    return opened;
}

}  // namespace burin::devices
