// SPDX-License-Identifier: MIT
#include "app/rehab/rehab_command.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/progress/baseline.hpp"
#include "activities/rehab/progress/page_texts.hpp"
#include "activities/rehab/rehab.hpp"
#include "app/cli/live_options.hpp"
#include "app/cli/new_folders.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/recorded_files.hpp"
#include "app/recordings/live_replay.hpp"
#include "app/rehab/rehab_pages.hpp"
#include "app/rehab/rehab_results.hpp"
#include "base/assets.hpp"
#include "base/file_io.hpp"
#include "base/temporary_folder.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "devices/gloves/glove_device.hpp"
#include "devices/gloves/glove_hand.hpp"
#include "devices/gloves/grip_shape.hpp"
#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"
#include "document/document_reader.hpp"
#include "document/journal.hpp"
#include "session/record/input_files.hpp"
#include "session/record/recordings.hpp"
#include "session/record/session_log.hpp"

namespace burin::app {
namespace {

using activities::ExerciseKind;
using activities::SettingKind;
using activities::SettingValues;

constexpr const char *kScriptedHand = "scripted", *kWeakHand = "weak";

Result<SettingValues> settings_in(const std::string& path, const ExerciseKind& kind) {
    if (path.empty()) return SettingValues(kind.settings);
    BURIN_TRY(text, read_text_file(path));
    activities::ReadSettings read = activities::read_settings(text, path, kind);
    if (read.errors.empty()) return std::move(read.values);
    if (read.errors.size() == 1) return std::unexpected(read.errors.front());
    for (const Error& error : read.errors) std::fprintf(stderr, "burin: %s\n", error.line().c_str());
    return fail(path, formatted("%zu mistakes", read.errors.size()), "correct them; they are listed above");
}

Result<void> check_glove(const session::SessionSetup& setup) {
    if (!setup.hands.named.empty())
        return fail("--device", "gives several hands, and one is drawn here", "name one device");
    BURIN_TRY(nature, devices::nature_of_device(setup.hands.device, &session::session_recordings()));
    if (nature.is_worn) return {};
    return fail("--device " + setup.hands.device, "is no glove",
                "name glove:PORT, or " + std::string(devices::kSimulatedGlove));
}

// Checks that the glove's pistons can give what the exercise asks for; a simulated hand gives way before that.
Result<void> check_target(const activities::Exercise& exercise, bool is_simulated) {
    const auto fingers = std::ranges::count(exercise.pressing_fingers(), true);
    const double of_each_N = is_simulated ? devices::Grip::kHolds_N : devices::kMostPistonForce_N;
    const double most_N = of_each_N * static_cast<double>(fingers);
    if (exercise.target_N() <= most_N) return {};
    return fail("--most-force",
                formatted("makes a target of %g N, and %td fingers of this glove give %g N each, %g N together",
                          exercise.target_N(), fingers, of_each_N, most_N),
                "give less, or a lower --level");
}

// Returns when the time begins by default. led: by a script, which presses no button unless it says so.
double usual_start(const ExerciseKind& kind, bool is_simulated, bool led) {
    const bool presses = kind.make(SettingValues(kind.settings))->target_N() > 0.0;
    if (!is_simulated && presses) return activities::kStartsPressed;
    return led ? activities::kStartsAtOnce : activities::kStartsAsked;
}

// Writes the script that a participant of that seed follows, and has the session follow it.
Result<TemporaryFolder> have_scripted(session::SessionSetup& setup, const ExerciseKind& kind,
                                      const SettingValues& values, const std::string& hand, std::uint64_t seed) {
    if (!setup.record.input.empty()) return fail("--hand " + hand, "is led by no --input", "leave one of them out");
    if (setup.hands.device != devices::kSimulatedGlove)
        return fail("--hand " + hand, "is a simulated hand, and --device names " + setup.hands.device,
                    "leave one of them out");
    BURIN_TRY(script, read_text_file(asset_path(kind.script)));
    BURIN_TRY(folder, TemporaryFolder::create());
    setup.record.input = folder / ("rehab-" + std::string(kind.name) + ".txt");
    if (setup.work.outputs.empty()) setup.work.outputs = "rehab-" + std::string(kind.name) + "-outputs";
    BURIN_TRY_DO(write_text(setup.record.input, kind.scripted(values, seed, script)));
    if (kind.course == nullptr) return std::move(folder);
    const std::string course = folder / (std::string(kind.name) + devices::kFingerCourseFiles);
    setup.hands.device += ":" + course;
    const auto person = hand == kWeakHand ? activities::SimulatedPerson::weak : activities::SimulatedPerson::healthy;
    BURIN_TRY_DO(write_text(course, kind.course(person)));
    return std::move(folder);
}

// Fits settings that nobody has given to the person by their baseline, and says so.
Result<void> fit_to_person(SettingValues& values, const ResultsOptions& options,
                           std::optional<Error> (*conflict)(const SettingValues&), Json& fitted_by) {
    BURIN_TRY(baseline, baseline_in(options));
    if (!baseline) return {};
    activities::FittedValues fitted = activities::fitted_by(values, *baseline);
    const std::string text = text_of(*baseline, fitted);
    if (!fitted.left_out.empty())
        std::fprintf(stderr, "burin: not taken of %s: %s\n", text.c_str(), fitted.left_out.c_str());
    if (fitted.taken.empty()) return {};
    if (const auto wrong = conflict(fitted.values)) {
        std::fprintf(stderr, "burin: not taken: %s: %s\n", text.c_str(), wrong->what.c_str());
        return {};
    }
    std::fprintf(stderr, "burin: fitted by %s\n", text.c_str());
    fitted_by = {{"text", text}, {"date", (baseline)->date}, {"time", (baseline)->time}, {"settings", fitted.taken}};
    values = std::move(fitted.values);
    return {};
}

// Has a force that adapts begin where the participant's last run ended, and says so.
Result<void> begin_where_it_ended(SettingValues& values, const ResultsOptions& options, const ExerciseKind& kind) {
    if (!values.has("success") || values.number("success") == 0.0 || values.was_set("begin_N")) return {};
    BURIN_TRY(target_N, adapted_target_in(options, kind.name));
    if (!target_N) return {};
    values.set("begin_N", *target_N);
    std::fprintf(stderr, "burin: begins with %.2f N, where the last run that adapted ended\n", *target_N);
    return {};
}

void print_score(const activities::Rehab& rehab) {
    const activities::Exercise& exercise = rehab.exercise();
    const activities::ExerciseCourse course = exercise.course();
    std::string counts;
    for (const auto& count : course.counts) {
        std::string name = count.name;
        name[0] = static_cast<char>(name[0] - 'A' + 'a');
        counts += count.wanted > 0 ? formatted("%u of %u %s, ", count.number, count.wanted, name.c_str())
                                   : formatted("%u %s, ", count.number, name.c_str());
    }
    std::string ended;
    if (course.end == activities::ExerciseEnd::not_yet) {
        const std::string why = rehab.failure();
        ended = std::string(text_of(course.end)) + (why.empty() ? "" : ", since " + why) + ": ";
    }
    std::printf("%s: %s%sscore %.0f of 100, in %.1f s\n", exercise.name(), ended.c_str(), counts.c_str(), course.score,
                course.time_s);
    for (const std::string& note : course.notes) std::printf("%s: %s\n", exercise.name(), note.c_str());
}

// An exercise, with what it was given on the command line.
struct AskedExercise {
    explicit AskedExercise(const ExerciseKind& of) : kind(of), numbers(of.settings.size()), words(numbers.size()) {}

    const ExerciseKind& kind;
    session::SessionSetup session;
    // Of each of the kind's settings; they overrule the file.
    std::vector<std::optional<double>> numbers;
    std::vector<std::string> words;
    std::string settings, report, hand, from;
    ResultsOptions results;
    RunRemarks remarks;
    std::uint64_t seed = 1;
    bool print_config = false;

    // Returns a mistake that names the options that were given in place of the settings' keys.
    [[nodiscard]] Error by_option(Error error) const {
        std::string named;
        for (std::string_view rest = error.where; !rest.empty();) {
            const std::string_view key = rest.substr(0, rest.find(", "));
            rest.remove_prefix(std::min(key.size() + 2, rest.size()));
            std::string name(key);
            for (std::size_t i = 0; i < numbers.size(); ++i)
                if (key == kind.settings[i].key && (numbers[i] || !words[i].empty() || settings.empty()))
                    name = kind.settings[i].option;
            named += (named.empty() ? "" : ", ") + name;
        }
        error.where = named;
        return error;
    }
    // Returns the settings of the file with what the command line says.
    [[nodiscard]] Result<SettingValues> values() const {
        Result<SettingValues> values = settings_in(settings, kind);
        if (!values) return values;
        // A recording that is done again has its own, of which the user need give none.
        const std::string repeated = settings.empty() ? repeated_activity(session) : "";
        if (repeated.starts_with("rehab " + std::string(kind.name) + " ")) {
            BURIN_TRY(recorded, activities::exercise_of(repeated));
            *values = recorded->settings();
        }
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (numbers[i]) values->set(kind.settings[i].key, *numbers[i]);
            if (words[i].empty()) continue;
            if (const auto set = values->set(kind.settings[i].key, words[i]); !set)
                return std::unexpected(by_option(set.error()));
        }
        if (const auto wrong = activities::problems(*values); !wrong.empty())
            return std::unexpected(by_option(wrong.front()));
        if (const auto conflict = kind.conflict(*values)) return std::unexpected(by_option(*conflict));
        return values;
    }
};

// Brings what a run begins with together: settings, of which some are fitted to the person. Of a recording nothing is
// fitted, since it is done again as it was.
struct FittedRun {
    SettingValues values;
    Json fitted;  // what was fitted by what; null: nothing
};
Result<FittedRun> fitted_run(SettingValues values, const AskedExercise& of, bool is_again) {
    FittedRun run{std::move(values), {}};
    if (is_again) return run;
    BURIN_TRY_DO(fit_to_person(run.values, of.results, of.kind.conflict, run.fitted));
    BURIN_TRY_DO(begin_where_it_ended(run.values, of.results, of.kind));
    return run;
}

// Has the session's glove be led as asked: by nobody's script, by the scripted hand, or by the script of the exercise
// where nobody sees it. Returns the folder of a script that was written; it must outlive the session.
Result<std::optional<TemporaryFolder>> lead_glove(session::SessionSetup& setup, const AskedExercise& of,
                                                  SettingValues& values, bool is_simulated) {
    const bool scripted = !of.hand.empty();
    std::optional<TemporaryFolder> folder;
    if (values.has("start") && values.number("start") == activities::kStartsByDevice)
        values.set("start",
                   usual_start(of.kind, is_simulated, scripted || setup.desk.offscreen || !setup.record.input.empty()));
    if (scripted) {
        BURIN_TRY(made, have_scripted(setup, of.kind, values, of.hand, of.seed));
        folder.emplace(std::move(made));
    }
    if (setup.desk.offscreen && setup.record.input.empty()) setup.record.input = asset_path(of.kind.script);
    if (is_simulated && of.kind.grip != nullptr) setup.hands.device += ":" + std::string(of.kind.grip(values));
    return folder;
}

// Names the hand of a run. A run that a script led is kept as the script's, so that it never counts as a person's.
std::string hand_of_run(const AskedExercise& of, const session::SessionSetup& setup) {
    if (of.hand == kWeakHand) return "scripted, a weak hand";
    if (!of.hand.empty()) return formatted("scripted, seed %llu", static_cast<unsigned long long>(of.seed));
    return !setup.record.input.empty() ? "scripted, " + setup.record.input : setup.hands.device;
}

// Keeps what the person has done, even where the session missed something else (`done`). One that never began leaves
// an older report alone, and a replay that went another way than its recording is nobody's run.
Result<void> keep_run(const AskedExercise& of, const activities::Rehab& exercise, ResultsOfRun& results, bool is_again,
                      const Result<void>& done) {
    const bool never_began = exercise.exercise().course().events.empty();
    if (!done && (is_again || never_began)) {
        results.discard();
        return done;
    }
    if (never_began && exercise.failure().empty()) {
        std::printf("%s: it was never begun, and nothing is kept of it\n", of.kind.name);
        results.discard();
        return done;
    }
    print_score(exercise);
    const Json report = exercise.report();
    const Result<void> written = write_output(of.report, json_text(report));
    const Result<void> kept = results.keep(report);
    return !done ? done : !written ? written : kept;
}

// Has the body of an exercise go on as a document has it, or the journal of a session that was killed. A recording
// would have to have it as well.
Result<void> go_on_from(const std::string& path, session::SessionSetup& setup, activities::Rehab& exercise) {
    setup.work.opened_by = std::string("burin rehab ") + exercise.exercise().name() + " --from";
    if (path.empty()) return {};
    if (!setup.record.path.empty() || session::is_database(setup.record.input))
        return fail("--from", "cannot be recorded: a recording does not hold the body that it began with",
                    "leave out --from, or the recording");
    BURIN_TRY(reader, document::DocumentReader::open(path));
    BURIN_TRY(pages, reader.pages_of(activities::Rehab::kBodyPart));
    const auto part = std::ranges::find(reader.parts(), activities::Rehab::kBodyPart, &document::PartPlace::kind);
    for (std::int64_t number = 1; number <= reader.changes(); ++number) {
        BURIN_TRY(change, reader.change(*part, number));
        for (auto& [name, bytes] : change.pages) pages.pages[name] = std::move(bytes);
    }
    if (reader.facts().contains(document::kJournalNameFact)) setup.work.goes_on_from = path;
    BURIN_TRY(found, reader.steps(*part));
    const scene::Steps steps = found.value_or(scene::Steps());
    std::vector<scene::Pages> each;
    for (std::int64_t number = steps.first; number <= steps.last; ++number) {
        if (each.size() > activities::Rehab::kMostDents) return fail(path, "has more dents than there can be");
        BURIN_TRY(step, reader.step(*part, number));
        each.push_back(std::move(step));
    }
    return exercise.load_body(pages, steps, each, path);
}

Result<void> run_exercise(const AskedExercise& of) {
    BURIN_TRY(given, of.values());
    // A recording is done again, and is whose it was; any other input is a script.
    const bool is_again = session::is_database(of.session.record.input);
    const std::string recording = is_again ? of.session.record.input : "";
    BURIN_TRY_DO(check_results(of.results, !of.hand.empty(), recording));
    BURIN_TRY_DO(check_remarks(of.remarks, !of.results.folder.empty()));
    BURIN_TRY(run, fitted_run(std::move(given), of, is_again));
    SettingValues& values = run.values;
    if (of.print_config) {
        std::fputs(activities::table_text(of.kind.name, values).c_str(), stdout);
        return {};
    }
    NewFolders folders(of.results.folders());  // before all that keeps files there, a lock among them
    session::SessionSetup session = of.session;
    session::SessionSetup& setup = session;
    BURIN_TRY_DO(check_glove(setup));
    const bool is_simulated = setup.hands.device == devices::kSimulatedGlove;
    BURIN_TRY(folder, lead_glove(setup, of, values, is_simulated));
    BURIN_TRY_DO(check_places(std::array{of.report}, session::inputs_of(session).list()));
    const auto exercise = std::make_shared<activities::Rehab>(of.kind.make(values));
    BURIN_TRY_DO(check_target(exercise->exercise(), is_simulated));
    exercise->describe(json_of(of.remarks));
    if (!run.fitted.is_null()) exercise->fitted_by(std::move(run.fitted));
    BURIN_TRY(results, is_again ? ResultsOfRun::again(of.results, recording)
                                : ResultsOfRun::begin(of.results, hand_of_run(of, setup), exercise));
    BURIN_TRY_DO(go_on_from(of.from, session, *exercise));
    session.activity = exercise;
    if (!repeated_activity(setup).empty()) leave_to_recording(session, false);
    const Result<void> done = run_recorded_session(session, "rehab");
    if (!exercise->exercise().course().events.empty()) folders.keep();
    return keep_run(of, *exercise, results, is_again, done);
}

// Adds an option for each of the kind's settings.
void add_setting_options(Command command, AskedExercise& of) {
    command.option("--settings", of.settings,
                   "A TOML file with the therapist's settings; what is given here goes before");
    for (std::size_t i = 0; i < of.kind.settings.size(); ++i) {
        const SettingKind& setting = of.kind.settings[i];
        if (setting.words.empty())
            command.option(setting.option, of.numbers[i], setting.help);
        else
            command.option(setting.option, of.words[i], setting.help).one_of(setting.words);
    }
}

void add_hand_option(Command command, AskedExercise& of) {
    if (of.kind.course == nullptr)
        command.option("--hand", of.hand, "scripted: a simulated hand does it, not always well")
            .one_of({kScriptedHand});
    else
        command
            .option("--hand", of.hand,
                    "scripted: a simulated hand does it; weak: one that goes half as far, whose index does not "
                    "press and whose fingers follow each other")
            .one_of({kScriptedHand, kWeakHand});
}

CommandAction add_exercise(Command command, const ExerciseKind& kind) {
    const auto asked = std::make_shared<AskedExercise>(kind);
    AskedExercise& of = *asked;
    of.session.scene.world = asset_path(kind.world);
    of.session.scene.no_workpiece = true;
    of.session.hands.device = devices::kSimulatedGlove;
    of.session.hands.tool.shape = "ball:0.006";  // around a fingertip's patch
    add_setting_options(command, of);
    command.flag("--print-config", of.print_config, "Print the settings as such a file, and do no more");
    add_hand_option(command, of);
    command.option("--seed", of.seed, "Of the scripted hand").show_default();
    if (kind.make(SettingValues(kind.settings))->has_body())
        command.option("--from", of.from, "A document of this body that was saved: it goes on with its dents");
    command.option("--report", of.report, "A JSON file for score, measures and events; - for standard output");
    add_results_options(command, of.results);
    add_remark_options(command, of.remarks);
    add_live_options(command, of.session);
    return action([asked] { return run_exercise(*asked); });
}

// The pages of a folder of results, and the language of all of them.
struct AskedPages {
    std::string folder, page, language;
};

CommandAction add_rehab_report(Command command) {
    const auto options = std::make_shared<AskedPages>();
    command.option("FOLDER", options->folder, "That --results was given").required();
    command.option("--out", options->page, "The page that leads to theirs, if not FOLDER/report.html");
    command.option("--language", options->language,
                   "Of all pages: " + activities::PageTexts::listed() + "; each participant's own if not given");
    return action([options] { return rehab_report(options->folder, options->page, options->language); });
}

CommandAction add_rehab_withdraw(Command command) {
    const auto options = std::make_shared<RehabWithdrawOptions>();
    command.option("FOLDER", options->folder, "That --results was given").required();
    command.option("--participant", options->participant, "By number, 1 to 999").required();
    command.flag("--erase", options->erase, "Erase all runs of the participant, too");
    return action([options] { return rehab_withdraw(*options); });
}

CommandAction add_rehab(Command command) {
    command.require_subcommand();
    std::vector<CommandRow> rows;
    for (const ExerciseKind& kind : activities::exercise_kinds())
        rows.push_back({kind.name, kind.help, [&kind](Command of_kind) { return add_exercise(of_kind, kind); }});
    rows.push_back({"report", "Write the pages of all participants' progress anew", add_rehab_report});
    rows.push_back({"withdraw", "Take a participant off all pages, who is exercised no more", add_rehab_withdraw});
    return add_commands(command, rows);
}

}  // namespace

CommandRow rehab_row() { return {"rehab", "Exercises for a hand in a glove, with a score and a log", add_rehab}; }

}  // namespace burin::app
