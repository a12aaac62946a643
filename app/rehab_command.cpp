// SPDX-License-Identifier: MIT
#include "app/rehab_command.hpp"

#include <array>
#include <cstdio>
#include <memory>

#include "activities/rehab/rehab.hpp"
#include "activities/rehab/scripted_squeezes.hpp"
#include "app/live_options.hpp"
#include "app/live_replay.hpp"
#include "app/output_files.hpp"
#include "app/temporary_folder.hpp"
#include "base/file_io.hpp"
#include "base/text.hpp"
#include "devices/gloves/glove_device.hpp"
#include "devices/registry/device_registry.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {
namespace {

using activities::BallSettings;

constexpr const char* kExerciseWorld = "assets/worlds/hand.toml";
constexpr const char* kExerciseScript =
    "assets/sessions/rehab-ball.txt";     // how the arm comes over the ball, and squeezes
constexpr double kFirstSqueeze_s = 2.85;  // when it is there

Result<BallSettings> settings_in(const std::string& path) {
    if (path.empty()) return BallSettings{};
    const Result<std::string> text = read_text_file(path);
    if (!text) return std::unexpected(text.error());
    const activities::ReadSettings read = activities::parse_rehab_settings(*text, path);
    if (read.errors.empty()) return read.settings.ball;
    if (read.errors.size() == 1) return std::unexpected(read.errors.front());
    for (const Error& error : read.errors) std::fprintf(stderr, "burin: %s\n", error.line().c_str());
    return fail(path, formatted("%zu mistakes", read.errors.size()), "correct them; they are listed above");
}

Result<void> check_glove(const session::LiveOptions& live) {
    if (!live.hands.empty()) return fail("--device", "gives several hands, and one is drawn here", "name one device");
    const Result<devices::DeviceNature> nature = devices::nature_of_device(live.device);
    if (!nature) return std::unexpected(nature.error());
    if (nature->is_worn) return {};
    return fail("--device " + live.device, "is no glove",
                "name glove:PORT, or " + std::string(devices::kSimulatedGlove));
}

void print_score(const activities::Rehab& exercise) {
    const activities::BallState& state = exercise.state();
    std::printf("ball: %u of %u squeezes, %u held too short, score %.0f of 100, in %.1f s\n", state.repetitions,
                exercise.ball().repetitions, state.too_short, activities::score_of(state, exercise.ball()),
                state.time_s());
}

}  // namespace

// The command's options; those of the exercise overrule the file of settings.
struct RehabCommand::Options {
    session::SculptOptions session;
    std::string settings, report, hand;
    std::string colour;
    std::optional<unsigned> level, repetitions;
    std::optional<double> hold_s, time_limit_s;
    std::uint64_t seed = 1;
    bool print_config = false;
};

RehabCommand::RehabCommand(Command app)
    : options_(std::make_unique<Options>()),
      command_(app.subcommand("rehab", "Exercises for a hand in a glove, with a score and a log")),
      ball_(command_.subcommand("ball", "Squeeze a ball, hold it so, and relax, again and again")) {
    Options& options = *options_;
    command_.require_subcommand();
    options.session.world = kExerciseWorld;
    options.session.no_workpiece = true;
    options.session.live.device = devices::kSimulatedGlove;
    options.session.tool.shape = "ball:0.006";  // around a fingertip's patch
    ball_.option("--settings", options.settings,
                 "A TOML file with the therapist's settings; what is given here goes before");
    ball_.option("--colour", options.colour, "How stiff the ball is, from soft to hard")
        .one_of({"yellow", "red", "green", "blue"});
    ball_.option("--level", options.level, "Of difficulty: with how much force to squeeze, 1 to 3");
    ball_.option("--repetitions", options.repetitions, "How many squeezes");
    ball_.option("--hold", options.hold_s, "How long each is held, in seconds");
    ball_.option("--time-limit", options.time_limit_s, "When the exercise ends, in seconds");
    ball_.flag("--print-config", options.print_config, "Print the settings as such a file, and do no more");
    ball_.option("--hand", options.hand, "scripted: a simulated hand squeezes, some squeezes too short")
        .one_of({"scripted"});
    ball_.option("--seed", options.seed, "Of the scripted hand").show_default();
    ball_.option("--report", options.report, "A JSON file for score, measures and events; - for standard output");
    add_live_options(ball_, options.session.live);
}

RehabCommand::~RehabCommand() = default;

Result<void> RehabCommand::run() const {
    const Options& options = *options_;
    Result<BallSettings> ball = settings_in(options.settings);
    if (!ball) return std::unexpected(ball.error());
    if (!options.colour.empty()) ball->colour = *activities::ball_named(options.colour);
    ball->level = options.level.value_or(ball->level);
    ball->repetitions = options.repetitions.value_or(ball->repetitions);
    ball->hold_s = options.hold_s.value_or(ball->hold_s);
    ball->time_limit_s = options.time_limit_s.value_or(ball->time_limit_s);
    if (const auto wrong = activities::problems(*ball); !wrong.empty()) return std::unexpected(wrong.front());
    if (options.print_config) {
        std::fputs(activities::settings_text({*ball}).c_str(), stdout);
        return {};
    }
    session::SculptOptions session = options.session;
    session::LiveOptions& live = session.live;
    if (const auto glove = check_glove(live); !glove) return glove;
    std::optional<TemporaryFolder> folder;
    if (!options.hand.empty()) {
        if (!live.input.empty()) return fail("--hand scripted", "is led by no --input", "leave one of them out");
        if (live.device != devices::kSimulatedGlove)
            return fail("--hand scripted", "is a simulated hand, and --device names " + live.device,
                        "leave one of them out");
        const Result<std::string> script = read_text_file(kExerciseScript);
        if (!script) return std::unexpected(script.error());
        Result<TemporaryFolder> made = TemporaryFolder::create();
        if (!made) return std::unexpected(made.error());
        folder.emplace(std::move(*made));
        live.input = *folder / "rehab-ball.txt";
        if (live.outputs.empty()) live.outputs = "rehab-ball-outputs";
        const auto squeezes = activities::drawn_squeezes(*ball, options.seed, kFirstSqueeze_s);
        if (const auto written = write_text(live.input, activities::with_squeezes(*script, squeezes)); !written)
            return written;
    }
    if (live.offscreen && live.input.empty()) live.input = kExerciseScript;
    if (const auto ok = check_places(std::array{options.report}, session::inputs_of(session).list()); !ok) return ok;
    const auto exercise = std::make_shared<activities::Rehab>(*ball);
    session.activity = exercise;
    const Result<void> done = run_recorded_session(session, "rehab");
    // What the person has done is kept, even where the session missed something else; one that never began leaves an
    // older report alone.
    if (!done && exercise->events().empty()) return done;
    print_score(*exercise);
    const Result<void> written = write_output(options.report, json_text(exercise->report()));
    return done ? written : done;
}

}  // namespace burin::app
