// SPDX-License-Identifier: MIT
// libFuzzer body of the input log's reader. Whatever the bytes: no fault, no hang, an error that names its line; and
// what is accepted is sensible, writes and reads back to the same events, and replays.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "session/input/input_line.hpp"
#include "session/record/input_log.hpp"
#include "session/record/input_source.hpp"

namespace {

void require(bool condition) {
    if (!condition) std::abort();
}

void check_round_trip(const burin::session::InputLog& log) {
    std::string text = "burin-input 1 " + log.settings + "\n";
    for (const burin::session::InputEvent& event : log.events) {
        require(burin::session::is_sensible(event.input));
        text += burin::line_of(event) + "\n";
    }
    const auto again = burin::session::parse_input_log(text, "again");
    require(again && again->settings == log.settings && again->events == log.events && !again->torn_line);
}

void check_replay(const burin::session::InputLog& log) {
    const auto is_frame = [](const burin::session::InputEvent& e) {
        return std::holds_alternative<burin::session::FrameStart>(e.input);
    };
    const auto frames = static_cast<std::size_t>(std::ranges::count_if(log.events, is_frame));
    if (frames == 0) return;  // made-up frames would be as many as the times claim
    burin::session::InputSource source = burin::session::InputSource::replay(log);
    std::size_t seen = 0;
    while (source.begin_frame(0, 0)) ++seen;
    require(seen == frames);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto log = burin::session::parse_input_log(text, "fuzz");
    if (!log) {
        require(!log.error().what.empty() && log.error().where.starts_with("fuzz:") && !log.error().remedy.empty());
        return 0;
    }
    require(log->events.size() <= size);
    check_round_trip(*log);
    check_replay(*log);
    return 0;
}
