// SPDX-License-Identifier: MIT
#include "activities/wand/wand_stroke.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "activities/wand/wand_facts.hpp"
#include "activities/wand/wand_world.hpp"
#include "base/file_io.hpp"
#include "base/json.hpp"
#include "base/temporary_folder.hpp"
#include "base/try.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"
#include "record/motion.hpp"
#include "scene/world_digest.hpp"
#include "session/live/world_side.hpp"
#include "session/record/recordings.hpp"

namespace burin::activities {
namespace {

// Fails where a file is another one than was recorded: its ticks could not be the same.
Result<void> check_as_recorded(const record::RecordReader& reader, const std::string& file, const std::string& what,
                               const std::string& now, const char* fact) {
    const std::string recorded = reader.fact(fact);
    if (recorded.empty() || recorded == now) return {};
    return fail(file,
                "is another " + what + " than the one that was recorded: SHA-256 " + now + ", recorded: " + recorded,
                "put the recorded one back, or feel the motion in another world by --through");
}

}  // namespace

Result<std::unique_ptr<WandWorld>> open_wand_world(const WandStroke& options) {
    auto opened = std::make_unique<WandWorld>();
    BURIN_TRY(nature, devices::nature_of_device(options.device, &session::session_recordings()));
    if (!nature.handle) return fail("--device " + options.device, "has no handle with points", "name a wand");
    opened->feel.wand = std::move(*nature.handle);
    opened->feel.radius_m = options.radius_m;
    BURIN_TRY(points,
              devices::points_named(opened->feel.wand, options.points.empty() ? devices::usual_points(opened->feel.wand)
                                                                              : options.points));
    opened->feel.points = std::move(points);
    BURIN_TRY(stroke, sculpt::read_stroke(options.stroke));
    opened->stroke = std::move(stroke);
    BURIN_TRY(world, session::read_sound_world(options.world));
    for (const scene::SceneObject& object : world.objects) opened->ids.push_back(object.id);
    opened->digest = scene::world_digest(world.objects);
    BURIN_TRY(part, scene::MeshPart::create(std::move(world.objects), opened->materials));
    opened->part = std::move(part);
    return opened;
}

std::vector<std::pair<std::string, std::string>> facts_of_wand(const WandStroke& options, const WandWorld& opened,
                                                               std::vector<std::pair<std::string, std::string>> facts) {
    const Json settings{{"world", options.world},
                        {"stroke", options.stroke},
                        {"device", options.device},
                        {"points", options.points},
                        {"radius_m", options.radius_m}};
    facts.emplace_back("command", "world --stroke --device");
    facts.emplace_back("time", "simulated");
    facts.emplace_back("world", options.world);
    facts.emplace_back("stroke", options.stroke);
    facts.emplace_back("device", options.device);
    facts.emplace_back("activity", kWandActivity);
    facts.emplace_back("settings", settings.dump(-1, ' ', false, Json::error_handler_t::replace));
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

Result<record::Comparison> replay_wand(record::RecordReader& reader, const std::string& world,
                                       const std::string& stroke, const record::TickRange& range) {
    BURIN_TRY(recorded, recorded_wand_stroke(reader));
    WandStroke& options = recorded;
    if (!world.empty()) options.world = world;
    if (!stroke.empty()) options.stroke = stroke;
    BURIN_TRY_DO(check_wand_file(reader, options.device, "put the file back, unchanged, where it was"));
    BURIN_TRY(opened, open_wand_world(options));
    WandWorld& again = *opened;
    BURIN_TRY_DO(check_as_recorded(reader, options.world, "world", again.digest, record::kWorldDigestFact));
    if (const auto now = file_digest(options.stroke)) {
        BURIN_TRY_DO(check_as_recorded(reader, options.stroke, "stroke", *now, "stroke sha256"));
    }
    BURIN_TRY(folder, TemporaryFolder::create());
    again.feel.record = folder / "again.session";
    BURIN_TRY_DO(explore_with_wand(*again.part, again.materials, again.stroke, again.feel, {}));
    BURIN_TRY(other, record::RecordReader::open(again.feel.record));
    return record::compare(reader, other, {}, range);
}

}  // namespace burin::activities
