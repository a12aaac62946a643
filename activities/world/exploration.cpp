// SPDX-License-Identifier: MIT
#include "activities/world/exploration.hpp"

#include <utility>

#include "base/try.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "devices/haptic/wand_file.hpp"
#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"
#include "haptics/tick_parameters.hpp"
#include "record/motion.hpp"
#include "session/record/recordings.hpp"
#include "session/record/session_recording.hpp"

namespace burin::activities {
namespace {

// The wand of a recording: as its text describes it, or as its device's name says.
Result<devices::WandDescription> wand_as_recorded(const session::RecordedFact& fact) {
    if (const std::string text = fact(record::kWandTextFact); !text.empty()) {
        devices::WandOrProblems wand = devices::parse_wand(text, record::kWandTextFact);
        if (!wand) return std::unexpected(wand.error().front());
        return std::move(*wand);
    }
    BURIN_TRY(nature, devices::nature_of_device(fact(session::kDeviceFact), &session::session_recordings()));
    return nature.handle.value_or(devices::WandDescription{});
}

}  // namespace

Exploration::Exploration(const ExplorationSettings& settings, session::BroughtHand hand, FeltBy felt_by)
    : settings_(settings), hand_(std::move(hand)), felt_by_(std::move(felt_by)) {
    session::PlacedHand& placed = hand_.placed.emplace();
    placed.scene_from_device = settings.scene_from_device;
    placed.begins_scene_m = settings.start_scene_m;
    placed.reach_m = settings.reach_m;
    if (!hand_.leads) return;
    const devices::HandTarget start = devices::target_of(*hand_.leads, 0.0);
    placed.rest_device = {start.position_device_m, start.orientation_device};
}

std::vector<std::pair<std::string, std::string>> Exploration::facts() const {
    return {{kExplorationFact, settings_text(settings_)}};
}

Result<void> Exploration::act(std::span<const std::string> /*words*/, session::ActivityOrders& /*orders*/) {
    return fail("do", "an exploration along a stroke takes no orders", "leave it out");
}

void Exploration::step(const session::ActivityView& view, session::ActivityOrders& orders) {
    const std::span<const haptics::TickRecord> ticks = view.first_part().ticks;
    if (felt_by_.on_tick)
        for (const haptics::TickRecord& tick : ticks) felt_by_.on_tick(tick);
    if (std::exchange(has_begun_, true) && ticks.empty()) return;
    if (!felt_by_.on_update || !outcome_) return;
    outcome_ = felt_by_.on_update();
    orders.quit = !outcome_;
}

void Exploration::adjust(session::PartOfHand /*of*/, haptics::TickParameters& parameters) const {
    haptics::TickParameters own = parameters_of(settings_);
    own.workspace.workspace_device_m = parameters.workspace.workspace_device_m;
    own.materials = parameters.materials;
    // Which there is no workpiece to have: a proxy that has touched nothing yet meets the first object's friction.
    own.materials.front() = own.materials[1];
    if (hand_.handle && !hand_.points.empty()) own.probe.count = 0;
    for (const devices::WandPoint& point : hand_.points)
        own.probe.points[own.probe.count++] = {devices::offset_device_m(*hand_.handle, point), settings_.tool_radius_m};
    parameters = std::move(own);
}

session::ActivityPanel Exploration::panel() const { return {.title = "Exploration"}; }

Result<ExplorationSettings> recorded_settings(const record::RecordReader& reader) {
    const bool is_old = reader.fact(kActivityFact) == kWorldActivity;
    const std::string text = reader.fact(is_old ? kSettingsFact : kExplorationFact);
    if (text.empty())
        return fail(reader.path(), "does not hold the settings of an exploration",
                    "replay a recording that burin world --record has written");
    return read_settings(text, reader.path());
}

Result<session::MadeActivity> exploration_as_recorded(const std::string& /*settings*/,
                                                      const session::RecordedFact& fact) {
    BURIN_TRY(settings, read_settings(fact(kExplorationFact), "the recording"));
    session::BroughtHand hand;
    if (const std::string points = fact(record::kWandPointsFact); !points.empty()) {
        BURIN_TRY(wand, wand_as_recorded(fact));
        BURIN_TRY(touching, devices::points_named(wand, points));
        hand.handle = std::move(wand);
        hand.points = std::move(touching);
    }
    return session::MadeActivity{std::make_shared<Exploration>(settings, std::move(hand)), nullptr};
}

}  // namespace burin::activities
