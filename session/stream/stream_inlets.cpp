// SPDX-License-Identifier: MIT
#include "session/stream/stream_inlets.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "session/stream/stream_text.hpp"

namespace burin::session {
namespace {

std::string or_empty(const char* text) { return text != nullptr ? text : ""; }

}  // namespace

StreamInlets::StreamInlets(StreamInlets&& other) noexcept
    : api_(std::move(other.api_)),
      own_source_(std::move(other.own_source_)),
      resolver_(std::exchange(other.resolver_, nullptr)),
      heard_(std::exchange(other.heard_, {})),
      messages_(std::move(other.messages_)) {}

StreamInlets::~StreamInlets() {
    for (const Heard& heard : heard_)
        if (heard.inlet != nullptr) api_.destroy_inlet(heard.inlet);
    if (resolver_ != nullptr) api_.destroy_resolver(resolver_);
}

Result<StreamInlets> StreamInlets::open(const devices::LslApi& api, const std::string& predicate,
                                        std::string own_source) {
    constexpr double kForgetAfter_s = 5.0;
    StreamInlets inlets(api, std::move(own_source));
    inlets.resolver_ = api.create_resolver(predicate.c_str(), kForgetAfter_s);
    if (inlets.resolver_ == nullptr)
        return fail("--lsl-markers", "streams are not looked for by " + predicate + ": " + api.why(),
                    "write a predicate as XPath 1.0 has them, or a stream's name");
    return inlets;
}

void StreamInlets::look() {
    std::array<devices::LslInfo, 2 * kMostMarkerStreams> found{};
    const std::int32_t count = api_.resolved(resolver_, found.data(), static_cast<std::uint32_t>(found.size()));
    for (std::size_t i = 0; count > 0 && i < std::min(static_cast<std::size_t>(count), found.size()); ++i) {
        if (found[i] == nullptr) continue;
        consider(found[i]);
        api_.destroy_info(found[i]);
    }
}

void StreamInlets::consider(devices::LslInfo info) {
    if (or_empty(api_.source_id_of(info)).starts_with(own_source_)) return;
    Heard heard{or_empty(api_.uid_of(info)), streamable(or_empty(api_.name_of(info)), 200), api_.channels_of(info)};
    if (std::ranges::find(heard_, heard.uid, &Heard::uid) != heard_.end()) return;
    const auto open = std::ranges::count_if(heard_, [](const Heard& one) { return one.inlet != nullptr; });
    if (heard.channels < 1 || heard.channels > kMostMarkerChannels) {
        messages_.push_back("markers of " + heard.name + " are not heard: each has " + std::to_string(heard.channels) +
                            " values, and 32 are the most");
    } else if (static_cast<std::size_t>(open) >= kMostMarkerStreams) {
        messages_.push_back("markers of " + heard.name + " are not heard: 16 streams are the most");
    } else {
        constexpr std::int32_t kMostBuffered = 360, kAsTheyCome = 0, kRecovers = 1;
        heard.inlet = api_.create_inlet(info, kMostBuffered, kAsTheyCome, kRecovers);
        messages_.push_back(heard.inlet != nullptr ? "markers of " + heard.name + " are heard"
                                                   : "markers of " + heard.name + " are not heard: " + api_.why());
        if (heard.inlet != nullptr) correct(heard, 2.0);
    }
    heard_.push_back(std::move(heard));
}

// The first estimate takes some milliseconds, later ones none.
void StreamInlets::correct(Heard& heard, double timeout_s) {
    std::int32_t error = devices::kLslNoError;
    const double correction_s = api_.time_correction(heard.inlet, timeout_s, &error);
    if (error != devices::kLslNoError) return;
    heard.correction_s = correction_s;
    heard.is_corrected = true;
}

std::vector<HeardMarker> StreamInlets::pull(double timeout_s) {
    std::vector<HeardMarker> heard;
    for (Heard& one : heard_)
        if (one.inlet != nullptr) pull_from(one, timeout_s / static_cast<double>(heard_.size()), heard);
    return heard;
}

void StreamInlets::pull_from(Heard& heard, double timeout_s, std::vector<HeardMarker>& to) {
    constexpr std::size_t kMostAtOnce = 1024;
    for (std::size_t i = 0; i < kMostAtOnce; ++i) {
        std::array<char*, static_cast<std::size_t>(kMostMarkerChannels)> texts{};
        std::int32_t error = devices::kLslNoError;
        const double stamp_s = api_.pull_text(heard.inlet, texts.data(), heard.channels, timeout_s, &error);
        timeout_s = 0.0;
        std::string text;
        for (std::int32_t channel = 0; channel < heard.channels; ++channel) {
            char* const one = texts[static_cast<std::size_t>(channel)];
            if (one == nullptr) continue;
            text += (channel > 0 ? " " : "") + streamable(one);
            api_.destroy_string(one);
        }
        if (error != devices::kLslNoError) {
            messages_.push_back("markers of " + heard.name + " are not heard any more: " +
                                (error == devices::kLslLost ? "the stream is gone" : api_.why()));
            api_.destroy_inlet(std::exchange(heard.inlet, nullptr));
            return;
        }
        if (stamp_s == 0.0) return;
        correct(heard, heard.is_corrected ? 0.0 : 0.2);
        to.push_back({stamp_s + heard.correction_s, heard.is_corrected, heard.name, streamable(text)});
    }
}

std::vector<std::string> StreamInlets::take_messages() { return std::exchange(messages_, {}); }

}  // namespace burin::session
