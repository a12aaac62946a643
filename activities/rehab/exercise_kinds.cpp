// SPDX-License-Identifier: MIT
#include "activities/rehab/exercise_kinds.hpp"

#include <algorithm>
#include <array>

#include "activities/rehab/assess/assess.hpp"
#include "activities/rehab/assess/scripted_fingers.hpp"
#include "activities/rehab/ball/ball.hpp"
#include "activities/rehab/ball/scripted_squeezes.hpp"
#include "activities/rehab/game/game.hpp"
#include "activities/rehab/game/scripted_throws.hpp"
#include "activities/rehab/putty/putty.hpp"
#include "activities/rehab/putty/scripted_kneads.hpp"

namespace burin::activities {
namespace {

constexpr std::string_view kPrefix = "rehab ";

std::span<const ExerciseKind> all_kinds() {
    static const std::array kinds{
        ExerciseKind{"assess", "Measure what a hand can do: range, strength, speed, each finger alone",
                     "worlds/assess.toml", "sessions/rehab-assess.txt", Assess::setting_kinds(), Assess::make,
                     scripted_assess, Assess::conflict, nullptr, assess_course},
        ExerciseKind{"ball", "Squeeze a ball, hold it so, and relax, again and again", "worlds/hand.toml",
                     "sessions/rehab-ball.txt", Ball::setting_kinds(), Ball::make, scripted_ball, Ball::conflict},
        ExerciseKind{"game", "Throw a ball at a wall above a line, and catch it", "worlds/game.toml",
                     "sessions/rehab-game.txt", Game::setting_kinds(), Game::make, scripted_game, Game::conflict},
        ExerciseKind{"putty", "Knead putty that keeps its dents, pinched or in the whole hand", "worlds/putty.toml",
                     "sessions/rehab-putty.txt", Putty::setting_kinds(), Putty::make, scripted_putty, Putty::conflict,
                     Putty::grip},
    };
    return kinds;
}

}  // namespace

std::span<const ExerciseKind> exercise_kinds() { return all_kinds(); }

const ExerciseKind* exercise_named(std::string_view name) {
    const auto kind = std::ranges::find(all_kinds(), name, &ExerciseKind::name);
    return kind != all_kinds().end() ? &*kind : nullptr;
}

unsigned levels_of(std::string_view exercise) {
    const ExerciseKind* const kind = exercise_named(exercise);
    if (kind == nullptr) return 0;
    const auto level = std::ranges::find(kind->settings, std::string_view("level"), &SettingKind::key);
    return level != kind->settings.end() ? static_cast<unsigned>(level->most) : 0;
}

Result<std::unique_ptr<Exercise>> exercise_of(std::string_view settings) {
    if (settings.starts_with(kPrefix)) {
        const std::string_view rest = settings.substr(kPrefix.size()), name = rest.substr(0, rest.find(' '));
        if (const ExerciseKind* const kind = exercise_named(name); kind != nullptr && rest.size() > name.size())
            if (const Result<SettingValues> values = values_of(rest.substr(name.size() + 1), kind->settings))
                return kind->make(*values);
    }
    return fail(std::string(settings), "are no settings of burin rehab", "replay it with the program that recorded it");
}

ReadSettings read_settings(std::string_view text, const std::string& name, const ExerciseKind& of) {
    ReadSettings read{SettingValues(of.settings), {}};
    const Result<toml::table> parsed = parse_toml(text, name);
    if (!parsed) {
        read.errors.push_back(parsed.error());
        return read;
    }
    TableReading reading{name};
    TableReader file(reading, &*parsed, "the file");
    for (const ExerciseKind& kind : all_kinds()) {
        SettingValues values = values_in(reading, file.table(kind.name), kind.name, kind.settings);
        if (std::string_view(kind.name) == of.name) read.values = std::move(values);
    }
    file.refuse_unknown();
    read.errors = std::move(reading.errors);
    return read;
}

}  // namespace burin::activities
