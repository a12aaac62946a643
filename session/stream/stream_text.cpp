// SPDX-License-Identifier: MIT
#include "session/stream/stream_text.hpp"

namespace burin::session {
namespace {

// Returns the bytes of the character that begins the text; 0: it is none (RFC 3629).
std::size_t bytes_of_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(i < text.size() ? text[i] : 0); };
    const auto follows = [&](std::size_t i) { return (byte(i) & 0xc0u) == 0x80u; };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80) return 1;
    if (first >= 0xc2 && first <= 0xdf) return follows(1) ? 2 : 0;
    if (first >= 0xe0 && first <= 0xef) {
        const bool is_short = first == 0xe0 && second < 0xa0;      // fewer bytes would do
        const bool is_surrogate = first == 0xed && second > 0x9f;  // half of a character of UTF-16
        return follows(1) && follows(2) && !is_short && !is_surrogate ? 3 : 0;
    }
    if (first >= 0xf0 && first <= 0xf4) {
        const bool is_short = first == 0xf0 && second < 0x90;
        const bool is_beyond = first == 0xf4 && second > 0x8f;
        return follows(1) && follows(2) && follows(3) && !is_short && !is_beyond ? 4 : 0;
    }
    return 0;
}

// Characters that XML 1.0 has no place for, or that no text has.
bool is_control(std::string_view character) {
    const auto first = static_cast<unsigned char>(character[0]);
    if (character.size() == 1) return first < 0x20 || first == 0x7f;
    return character == "\xef\xbf\xbe" || character == "\xef\xbf\xbf" ||
           (first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0);
}

}  // namespace

std::string streamable(std::string_view text, std::size_t most) {
    std::string clean;
    while (!text.empty()) {
        const std::size_t bytes = bytes_of_character(text);
        const std::string_view character = text.substr(0, bytes == 0 ? 1 : bytes);
        const bool is_kept = bytes > 0 && !is_control(character);
        if (clean.size() + (is_kept ? character.size() : 1) > most) break;
        clean += is_kept ? character : " ";
        text.remove_prefix(character.size());
    }
    return clean;
}

std::string marker_of(const EventMark& event) {
    return streamable(event.value.empty() ? event.name : event.name + ": " + event.value);
}

std::string marker_of(const TrialMark& trial) {
    return streamable(trial.name.empty() ? "trial ends: " + trial.state : "trial begins: " + trial.name);
}

Result<std::string> marker_predicate(const std::string& asked) {
    const std::string all = "type='Markers'";
    if (asked.empty()) return all;
    if (asked.find_first_of("=(") != std::string::npos) return all + " and (" + asked + ")";
    const char quote = asked.contains('\'') ? '"' : '\'';
    if (asked.contains(quote))
        return fail("--lsl-markers " + asked, "is a name with both kinds of quotes, which no predicate can hold",
                    "name the streams otherwise: --lsl-markers \"starts-with(name,'...')\"");
    return all + " and name=" + quote + asked + quote;
}

}  // namespace burin::session
