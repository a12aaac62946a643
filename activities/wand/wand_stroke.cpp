// SPDX-License-Identifier: MIT
#include "activities/wand/wand_stroke.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "activities/wand/wand_facts.hpp"
#include "activities/wand/wand_world.hpp"
#include "base/file_io.hpp"
#include "base/json.hpp"
#include "base/try.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"
#include "record/motion.hpp"
#include "scene/world_digest.hpp"
#include "scene/world_file.hpp"
#include "session/live/world_side.hpp"
#include "session/record/recordings.hpp"

namespace burin::activities {
namespace {

std::string points_of(const WandStroke& options, const devices::WandDescription& wand) {
    return options.points.empty() ? devices::usual_points(wand) : options.points;
}

}  // namespace

Result<std::unique_ptr<WandWorld>> open_wand_world(const WandStroke& options) {
    auto opened = std::make_unique<WandWorld>();
    BURIN_TRY(nature, devices::nature_of_device(options.device, &session::session_recordings()));
    if (!nature.handle) return fail("--device " + options.device, "has no handle with points", "name a wand");
    opened->feel.wand = std::move(*nature.handle);
    opened->feel.radius_m = options.radius_m;
    BURIN_TRY(points, devices::points_named(opened->feel.wand, points_of(options, opened->feel.wand)));
    opened->feel.points = std::move(points);
    BURIN_TRY(stroke, sculpt::read_stroke(options.stroke));
    opened->stroke = std::move(stroke);
    BURIN_TRY(world, session::read_sound_world(options.world));
    opened->digest = scene::world_digest(world.objects);
    opened->world = {options.world, std::make_shared<const scene::World>(std::move(world)), options.device,
                     points_of(options, opened->feel.wand)};
    return opened;
}

std::vector<std::pair<std::string, std::string>> facts_of_wand(const WandStroke& options, const WandWorld& opened,
                                                               std::vector<std::pair<std::string, std::string>> facts) {
    facts.emplace_back("command", "world --stroke --device");
    facts.emplace_back("time", "simulated");
    facts.emplace_back("world", options.world);
    facts.emplace_back("stroke", options.stroke);
    facts.emplace_back(record::kWandPointsFact, opened.world.points);
    facts.emplace_back(record::kWorldDigestFact, opened.digest);
    if (const auto digest = file_digest(options.stroke)) facts.emplace_back("stroke sha256", *digest);
    std::ranges::move(facts_of_wand_file(options.device), std::back_inserter(facts));
    return facts;
}

Result<WandStroke> recorded_wand_stroke(const record::RecordReader& reader) {
    const auto settings = reader.facts().find("settings");
    const Json json = settings == reader.facts().end() ? Json() : Json::parse(settings->second, nullptr, false);
    WandStroke options;
    const auto text = [&](const char* key, std::string& to) {
        if (!json.is_object() || !json.contains(key) || !json[key].is_string()) return false;
        to = json[key].get<std::string>();
        return true;
    };
    const bool sound = text("world", options.world) && text("stroke", options.stroke) &&
                       text("device", options.device) && text("points", options.points) && json.contains("radius_m") &&
                       json["radius_m"].is_number();
    if (!sound || !devices::has_handle(options.device, &session::session_recordings()))
        return fail(reader.path(), "has no sound settings of a stroke with a wand",
                    "replay what burin world --stroke --device simulated-wand --record has written");
    options.radius_m = json["radius_m"].get<double>();
    if (!(options.radius_m >= 1e-5 && options.radius_m <= 1.0))
        return fail(reader.path(), "has a radius out of range", "it was changed");
    return options;
}

}  // namespace burin::activities
