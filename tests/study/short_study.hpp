// SPDX-License-Identifier: MIT
// The thesis' study, short enough for a test, and what is done with it.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/text.hpp"
#include "study/folder/journal.hpp"
#include "study/protocol/protocol.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::study {

inline const std::string kBurinStudy = std::string(kBurinCommand) + " study ";
inline const std::string kProtocolFile =
    std::filesystem::absolute("assets/studies/kinesthetic-path/protocol.toml").string();

// The thesis' study with stages short enough for a test.
inline std::string short_protocol() {
    std::ifstream in(kProtocolFile);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    for (const char* seconds : {"ends_after_s = 60", "ends_after_s = 300", "ends_after_s = 120"}) {
        for (std::size_t at = text.find(seconds); at != std::string::npos; at = text.find(seconds, at + 1))
            text.replace(at, std::string(seconds).size(), "ends_after_s = 1");
    }
    return text;
}

inline Workplace::Outcome make_study(const Workplace& place, const std::string& more = "--participants 4 --seed 7") {
    place.write("p.toml", short_protocol());
    return place.run(kBurinStudy + "init s --protocol p.toml " + more);
}

// The hand waits in the start cap, goes through the tube in three seconds and rests in the end cap.
inline std::string through_the_tube(double from_s) {
    const Protocol protocol = parse_protocol(short_protocol()).protocol;
    const std::vector<Vec3>& spine = protocol.worlds.at(0).spine_m;
    std::vector<Vec3> places{spine.front() + Vec3(-0.01, 0, 0), spine.front() + Vec3(-0.01, 0, 0)};
    places.insert(places.end(), spine.begin(), spine.end());
    places.push_back(spine.back() + Vec3(0.01, 0, 0));
    std::string text;
    for (std::size_t i = 0; i < places.size(); ++i)
        text += formatted("%.3f hand %.6f %.6f %.6f\n", from_s + static_cast<double>(i) * 0.06 + (i > 0 ? 0.5 : 0.0),
                          places[i].x, places[i].y, places[i].z);
    return text;
}

// The line by which a participant of this journal is erased.
inline std::string erasure_of(const char* id, const std::string& text) {
    const Json value{{"event", "withdrawn"}, {"participant", id}, {"erase", true}, {"time", "2026-11-25T11:00:00Z"}};
    return journal_line(parse_journal(text).last_digest, value);
}

}  // namespace burin::study
