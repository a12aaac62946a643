// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>

#include "activities/train/simulated_stage.hpp"
#include "activities/train/simulated_study.hpp"
#include "app/bench/bench_command.hpp"
#include "app/cli/output_files.hpp"
#include "app/study/study_command.hpp"
#include "base/file_io.hpp"
#include "base/places.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "study/felt/felt_world.hpp"
#include "study/statistics/mann_whitney.hpp"
#include "study/statistics/spearman.hpp"

namespace burin::app {
namespace {

namespace fs = std::filesystem;

struct StudyBench {
    std::string protocol, folder, json;
    unsigned participants = 10, threads = 0;
    std::uint64_t seed = 1;
};

class Stopwatch {
public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
    }
    // Returns the processor time of all threads of the process: what the work takes, whoever else uses the cores.
    [[nodiscard]] double processor_s() const {
        return static_cast<double>(std::clock() - processor_begun_) / CLOCKS_PER_SEC;
    }

private:
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
    std::clock_t processor_begun_ = std::clock();
};

std::uintmax_t bytes_in(const fs::path& folder) {
    std::error_code error;
    std::uintmax_t sum = 0;
    for (const fs::path& entry : entries_below(folder).value_or(std::vector<fs::path>()))
        if (fs::is_regular_file(entry, error)) sum += fs::file_size(entry, error);
    return sum;
}

// The whole study in a folder of its own, which goes away.
Result<Json> whole_study(const StudyBench& options, const std::string& protocol, bool records) {
    const fs::path folder =
        fs::path(options.folder) / formatted("bench-study-%d-%d", static_cast<int>(::getpid()), records ? 1 : 0);
    if (const auto made = study::create_study(folder, protocol, {options.seed, options.participants, {}}); !made)
        return std::unexpected(made.error());
    Result<Json> figures = [&]() -> Result<Json> {
        BURIN_TRY(study, study::StudyFolder::open(folder, study::StudyAccess::write));
        activities::SimulationOptions simulation;
        simulation.threads = options.threads;
        simulation.records = records;
        const Stopwatch run;
        BURIN_TRY(went, activities::run_simulated(study, simulation));
        const double took_s = run.seconds(), processor_s = run.processor_s();
        Json json{{"motion_recorded", records},
                  {"simulated_s", went.simulated_s},
                  {"ticks", went.ticks},
                  {"wall_s", took_s},
                  {"times_real_time", went.simulated_s / took_s},
                  {"processor_s", processor_s},
                  {"us_a_tick_with_a_world", 1e6 * took_s / static_cast<double>(went.ticks)}};
        if (!records) return json;
        json["bytes"] = bytes_in(folder / "data");
        json["bytes_a_second_of_motion"] =
            static_cast<double>(bytes_in(folder / "data")) / (0.001 * static_cast<double>(went.ticks));
        const Stopwatch again;
        BURIN_TRY_DO(study_replay({folder.string(), "", options.threads, true}));
        json["replay_wall_s"] = again.seconds();
        return json;
    }();
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    return figures;
}

// Stages of the first group on one thread, without any file.
Result<Json> ticks_alone(const study::Protocol& protocol, std::uint64_t seed) {
    Json rows = Json::array();
    BURIN_TRY(worlds, activities::felt_worlds(protocol));
    for (const study::StagePlace& at : study::places_of(protocol)) {
        const study::Stage& stage = *at.stage;
        if (!worlds.contains(stage.world)) continue;
        study::Random random(seed);
        const study::LearnerPopulation population;
        const study::Learner learner = study::draw_learner(population, false, random);
        const Stopwatch run;
        BURIN_TRY(went, activities::simulate_stage({protocol, at, protocol.groups.front(), worlds, learner, population},
                                                   random, {}));
        const double took_s = run.seconds(), processor_s = run.processor_s();
        rows.push_back({{"stage", stage.name},
                        {"ticks", went.ticks},
                        {"us_a_tick", 1e6 * took_s / static_cast<double>(went.ticks)},
                        {"times_real_time", went.duration_s / took_s},
                        {"processor_us_a_tick", 1e6 * processor_s / static_cast<double>(went.ticks)}});
    }
    return rows;
}

Json statistics_bench() {
    study::Random random(3);
    std::vector<double> a, b;
    for (int i = 0; i < 10; ++i) {
        a.push_back(random.uniform());
        b.push_back(random.uniform());
    }
    const Stopwatch first;
    const study::Outcome u = study::mann_whitney(a, b);
    const double u_s = first.seconds();
    const Stopwatch second;
    const study::Outcome r = study::spearman(a, b);
    return {{"mann_whitney_10_10_s", u_s},
            {"mann_whitney_exact", u.exact},
            {"spearman_10_s", second.seconds()},
            {"spearman_exact", r.exact}};
}

void print_study_bench(const Json& json) {
    std::printf("one thread, no file:\n");
    for (const Json& row : json.at("stages"))
        std::printf("  %-14s %6.2f us a tick, %5.1f times real time\n", row.at("stage").get<std::string>().c_str(),
                    row.at("us_a_tick").get<double>(), row.at("times_real_time").get<double>());
    for (const char* key : {"without_motion", "with_motion"}) {
        const Json& run = json.at(key);
        std::printf("whole study %s: %.0f s in %.1f s, %.1f times real time; %.1f s of processor time\n",
                    run.at("motion_recorded").get<bool>() ? "with its motion recorded" : "without motion",
                    run.at("simulated_s").get<double>(), run.at("wall_s").get<double>(),
                    run.at("times_real_time").get<double>(), run.at("processor_s").get<double>());
    }
    const Json &with = json.at("with_motion"), &s = json.at("statistics");
    std::printf("recorded: %.1f MB, %.1f kB a second of motion; replayed in %.1f s\n",
                1e-6 * with.at("bytes").get<double>(), 1e-3 * with.at("bytes_a_second_of_motion").get<double>(),
                with.at("replay_wall_s").get<double>());
    std::printf("exact Mann-Whitney 10 + 10: %.3f s; exact Spearman n = 10: %.3f s\n",
                s.at("mann_whitney_10_10_s").get<double>(), s.at("spearman_10_s").get<double>());
}

Result<void> run_study_bench(const StudyBench& options) {
    BURIN_TRY_DO(check_places(std::array{options.json}, std::array{options.protocol}));
    BURIN_TRY(text, read_text_file(options.protocol, study::kMostProtocolBytes));
    const study::ParsedProtocol parsed = study::parse_protocol(text);
    if (!parsed.faults.empty())
        return fail(line_of(parsed.faults.front(), options.protocol), "the protocol has faults", "burin study check");
    Json json{{"participants", options.participants}, {"threads", options.threads}, {"statistics", statistics_bench()}};
    BURIN_TRY(stages, ticks_alone(parsed.protocol, options.seed));
    json["stages"] = stages;
    for (const bool records : {false, true}) {
        BURIN_TRY(figures, whole_study(options, text, records));
        json[records ? "with_motion" : "without_motion"] = figures;
    }
    if (options.json != kStandardOutput) print_study_bench(json);
    return write_output(options.json, json_text(json));
}

CommandAction add_study_bench(Command command) {
    const auto options = std::make_shared<StudyBench>();
    std::error_code ignored;
    options->folder = fs::temp_directory_path(ignored).string();
    command.option("PROTOCOL", options->protocol, "Such as assets/studies/kinesthetic-path/protocol.toml").required();
    command.option("--participants", options->participants, "How many learners").within(1, 1000).show_default();
    command.option("--threads", options->threads, "People at a time; 0: one for each core").within(0, 1024);
    command.option("--folder", options->folder, "Where it is recorded: the disk that is measured").show_default();
    command.option("--seed", options->seed, "Of allocation and learners").show_default();
    command.option("--json", options->json, "A file for the figures; - for standard output");
    return action([options] { return run_study_bench(*options); });
}

}  // namespace

CommandRow bench_study_row() {
    return {"study", "A whole simulated study: against real time, recorded and replayed", add_study_bench};
}

}  // namespace burin::app
