// SPDX-License-Identifier: MIT
#include "activities/rehab/progress/progress.hpp"

#include <algorithm>
#include <ranges>
#include <string>
#include <vector>

#include "activities/rehab/exercise_kinds.hpp"
#include "base/text.hpp"

namespace burin::activities {
namespace {

double score_of(const KeptRun& run) { return run.report.at("score").get<double>(); }

unsigned level_of(const KeptRun& run) {
    const Json* const level = find_value(run.report, "/settings/level");
    return level != nullptr && level->is_number() && *level >= 1.0 && *level <= 100.0
               ? static_cast<unsigned>(level->get<double>())
               : 0;
}

// Returns a run's settings. One that it lacks was not there yet when it was kept, and counts as its default.
Json settings_of(const KeptRun& run) {
    Json settings = run.report.at("settings");
    const ExerciseKind* const kind = exercise_named(run.report.at("exercise").get<std::string>());
    if (kind == nullptr) return settings;
    const SettingValues usual(kind->settings);
    for (const SettingKind& setting : kind->settings) {
        if (settings.contains(setting.key)) continue;
        if (setting.words.empty())
            settings[setting.key] = setting.usual;
        else
            settings[setting.key] = usual.word(setting.key);
    }
    return settings;
}

// Returns whether two runs had the same settings. A start by the device, the default, is the other run's.
bool have_same_settings(const KeptRun& one, const KeptRun& other) {
    Json first = settings_of(one), second = settings_of(other);
    const auto by_device = [](const Json& settings) {
        const auto start = settings.find("start");
        return start != settings.end() && *start == kStarts[static_cast<std::size_t>(kStartsByDevice)];
    };
    if (by_device(first) || by_device(second)) {
        first.erase("start");
        second.erase("start");
    }
    // A limit that was not reached, and where a force that adapts begins, make no other exercise.
    for (const char* key : {"time_limit_s", "begin_N"}) {
        first.erase(key);
        second.erase(key);
    }
    return first.size() == second.size() && std::ranges::all_of(first.items(), [&](const auto& setting) {
               return find_value(second, "/" + setting.key()) != nullptr && second.at(setting.key()) == setting.value();
           });
}

bool is_broken_off(const KeptRun* run) {
    const Json& ended = run->report.at("ended");
    return ended.is_string() && ended.get_ref<const std::string&>() == "broken off";
}

}  // namespace

std::optional<double> adapted_target_N(std::span<const KeptRun> runs, unsigned participant, std::string_view exercise) {
    for (const KeptRun& run : runs | std::views::reverse) {
        if (run.participant != participant || run.report.at("exercise") != std::string(exercise)) continue;
        const Json* const next = find_value(run.report, "/" + std::string(exercise) + "/next_target_N");
        if (next != nullptr && next->is_number()) return next->get<double>();
    }
    return std::nullopt;
}

Proposal proposed(std::span<const KeptRun* const> all, unsigned levels) {
    std::vector<const KeptRun*> runs(all.begin(), all.end());
    std::erase_if(runs, is_broken_off);
    const unsigned level = level_of(runs.empty() ? *all.back() : *runs.back());
    if (level == 0 || levels == 0) return {0, "The exercise has no levels that are known.", {}, 0, 0, {}};
    std::vector<double> last_scores;
    const auto made = [&](unsigned of, const std::string& reason, Proposal::Why why) {
        return Proposal{of, reason, why, level, runs.size(), last_scores};
    };
    const auto stays = [&](const std::string& reason, Proposal::Why why) {
        return made(0, formatted("Level %u stays: ", level) + reason, why);
    };
    if (runs.size() < Proposal::kRuns)
        return stays(formatted("a proposal takes %zu runs that were carried to an end, and there %s %zu.",
                               Proposal::kRuns, runs.size() == 1 ? "is" : "are", runs.size()),
                     Proposal::Why::few);
    const auto last = std::span(runs).last(Proposal::kRuns);
    const auto differs = [&](const KeptRun* run) { return !have_same_settings(*run, *runs.back()); };
    if (std::ranges::any_of(last, differs))
        return stays("the last three runs had different settings.", Proposal::Why::differ);
    std::string scores;
    for (const KeptRun* run : last) {
        scores += formatted(scores.empty() ? "%.0f" : ", %.0f", score_of(*run));
        last_scores.push_back(score_of(*run));
    }
    const bool well = std::ranges::all_of(last, [](const KeptRun* run) { return score_of(*run) >= Proposal::kWell; });
    const bool badly = std::ranges::all_of(last, [](const KeptRun* run) { return score_of(*run) <= Proposal::kBadly; });
    if (well && level < levels)
        return made(level + 1, formatted("Level %u is proposed: the last three scores were ", level + 1) + scores + ".",
                    Proposal::Why::up);
    if (badly && level > 1)
        return made(level - 1, formatted("Level %u is proposed: the last three scores were ", level - 1) + scores + ".",
                    Proposal::Why::up);
    return stays("the last three scores were " + scores + ".", Proposal::Why::scores);
}

std::vector<const KeptRun*> alike(std::span<const KeptRun* const> all) {
    std::vector<const KeptRun*> runs(all.begin(), all.end());
    std::erase_if(runs, is_broken_off);
    if (runs.empty()) return runs;
    const KeptRun* const newest = runs.back();
    std::erase_if(runs, [&](const KeptRun* run) { return !have_same_settings(*run, *newest); });
    return runs;
}

}  // namespace burin::activities
